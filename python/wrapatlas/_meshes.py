"""Meshes: of arrays, of files, and of trimesh."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import floats, indices
from ._errors import UsageError

if TYPE_CHECKING:
    import trimesh

    from ._packing import Packing

__all__ = ["Mesh", "MeshLike", "load"]


class Mesh(_core.Mesh):
    """Polygons with a position and, maybe, a UV at each corner.

    positions: (P, 3), float32 or float64; finite.
    faces: (F, 3) integers into positions; (F, k) for polygons of k corners.
    uv: (P, 2) with one for each position, or with uv_faces (T, 2); v points up, as in OBJ.
    uv_faces: like faces, but into uv.

    Raises UsageError (a ValueError) for arrays of a wrong shape or type, InputError (a ValueError)
    for what is in them: an index out of range, NaN, no faces.
    """

    def __init__(
        self,
        positions: npt.ArrayLike | _core.Mesh,
        faces: npt.ArrayLike | None = None,
        uv: npt.ArrayLike | None = None,
        uv_faces: npt.ArrayLike | None = None,
    ) -> None:
        if isinstance(positions, _core.Mesh):
            super().__init__(positions)
            return
        if faces is None:
            raise UsageError("faces: there are none; pass the corners of each")
        super().__init__(core_mesh(positions, faces, uv, uv_faces))

    def triangulated(self) -> Mesh:
        """The same with all faces cut into triangles."""
        return Mesh(self._triangulated())

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes .obj, .ply, .gltf or .glb.

        A loaded mesh keeps what else its file held, in its own format. The file appears at once, or
        not at all. OSError if it cannot be written.
        """
        self._save(os.fspath(path))

    def to_trimesh(self) -> trimesh.Trimesh:
        """A trimesh.Trimesh with these UVs: vertices are repeated along seams. Needs trimesh.

        trimesh has v up, so that of a mesh from glTF is turned round. ImportError without trimesh.
        """
        triangles = self.triangulated()
        if len(self.uv) == 0:
            return to_trimesh(triangles.positions, triangles.faces, None)
        pairs = np.stack([triangles.corner_position, triangles.corner_uv], axis=1)
        used, corner = np.unique(pairs, axis=0, return_inverse=True)
        has_uv = used[:, 1] < len(self.uv)
        uv = np.zeros((len(used), 2))
        uv[has_uv] = self.uv[used[has_uv, 1]]
        if self.v_points_down:
            uv[:, 1] = 1 - uv[:, 1]
        return to_trimesh(self.positions[used[:, 0]], corner.reshape(-1, 3), uv)

    def __repr__(self) -> str:
        uvs = f", {len(self.uv)} UVs" if len(self.uv) else ""
        return f"<wrapatlas.Mesh: {len(self.positions)} positions, {self.face_count} faces{uvs}>"


if TYPE_CHECKING:
    MeshLike = Union[_core.Mesh, "Packing", "trimesh.Trimesh", str, os.PathLike[str]]
else:
    MeshLike = Any


def core_mesh(
    positions: npt.ArrayLike | None,
    faces: npt.ArrayLike,
    uv: npt.ArrayLike | None = None,
    uv_faces: npt.ArrayLike | None = None,
    objects: npt.ArrayLike | None = None,
) -> _core.Mesh:
    return _core.mesh_from_arrays(
        None if positions is None else floats("positions", positions),
        indices("faces", faces),
        None if uv is None else floats("uv", uv),
        None if uv_faces is None else indices("uv_faces", uv_faces),
        None if objects is None else indices("objects", objects),
    )


def load(path: str | os.PathLike[str], texcoord: int = 0, in_scene: bool = False) -> Mesh:
    """Reads a model: .obj .off .ply .stl .gltf .glb.

    What is packed of it and saved in the same format keeps all that the file held.
    texcoord: which set of UVs of a glTF.
    in_scene: the meshes of a glTF where its nodes have them, each as often as they do; for models
        that are to lie over others (bake), or to be saved in another format. Saved as glTF it is a
        new file, with geometry and UVs alone.
    Raises OSError if it cannot be opened, InputError (a ValueError) if it cannot be used.
    """
    with open(path, "rb"):  # for the system's own error
        pass
    return Mesh(_core.load(os.fspath(path), texcoord, in_scene))


def as_mesh(value: MeshLike, name: str = "mesh") -> _core.Mesh:
    """Whatever stands for a mesh."""
    from ._packing import Packing

    if isinstance(value, _core.Mesh):
        return value
    if isinstance(value, Packing):
        return value.mesh
    if isinstance(value, (str, os.PathLike)):
        return load(value)
    if is_trimesh(value):
        return from_trimesh(value)
    raise UsageError(
        f"{name}: {type(value).__name__} is no mesh; pass a wrapatlas.Mesh, a trimesh.Trimesh, a "
        "Packing or the path of a model"
    )


def is_trimesh(value: object) -> bool:
    """Without importing trimesh for those who do not use it."""
    return all(hasattr(value, name) for name in ("vertices", "faces", "visual"))


def from_trimesh(mesh: Any) -> _core.Mesh:
    uv = getattr(mesh.visual, "uv", None)
    if uv is not None and len(uv) != len(mesh.vertices):
        uv = None
    return core_mesh(mesh.vertices, mesh.faces, uv)


def to_trimesh(
    vertices: npt.NDArray[Any], faces: npt.NDArray[Any], uv: npt.NDArray[Any] | None
) -> trimesh.Trimesh:
    import trimesh

    visual = None
    if uv is not None:
        make_visual: Any = trimesh.visual.TextureVisuals
        visual = make_visual(uv=np.array(uv, np.float64))
    return trimesh.Trimesh(
        vertices=np.array(vertices), faces=np.array(faces, np.int64), visual=visual, process=False
    )
