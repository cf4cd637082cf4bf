"""Packing the charts of an atlas, and cutting meshes into charts."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, cast

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import floats
from ._errors import UsageError
from ._images import Picture, as_picture
from ._meshes import Mesh, MeshLike, as_mesh, core_mesh, to_trimesh
from ._options import (
    keep_best,
    known_options,
    pack_settings,
    refuse_unknown,
    unwrap_settings,
)
from ._progress import reported

if TYPE_CHECKING:
    import trimesh
    from typing_extensions import Unpack

    from ._options import PackingOptions, UnwrappingOptions

__all__ = ["Packing", "pack", "unwrap"]


class Packing(_core.PackedMesh):
    """A packed atlas: what pack and unwrap return.

    ``vmapping, faces, uv`` are the mesh as graphics cards want it: new vertex i is vertex
    vmapping[i] of the mesh that was given, at uv[i] of the atlas. Vertices are repeated along
    seams. A notebook shows the atlas as a picture.
    """

    @property
    def positions(self) -> npt.NDArray[np.float64]:
        """(N, 3) float64: each new vertex in space. UsageError where pack was given none."""
        if not self.source._has_space:
            raise UsageError("positions: none were given; pass positions= to pack")
        return self.interpolate(self.source.positions)

    @property
    def mesh(self) -> Mesh:
        """The mesh with its new UVs; made anew each time."""
        return Mesh(self._mesh)

    @property
    def source(self) -> Mesh:
        """The mesh that was given."""
        return Mesh(self._source)

    @property
    def wraps(self) -> npt.NDArray[np.bool_]:
        """(charts, 2) bool: does the chart go on over the border of the atlas, along u, along v?

        All False where nothing wraps, and where there are several pages. With export="cut": did it,
        before it was cut there?
        """
        found: npt.NDArray[np.bool_] = self._wraps.astype(np.bool_)
        return found

    @property
    def report(self) -> _core.CheckReport | None:
        """What the check of the result found; None with check=False."""
        return self._report if self._report.charts > 0 else None

    def interpolate(self, values: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Any attribute of the source's vertices, at the new vertices.

        values: (P,) or (P, k), one row for each position of the source.
        Returns (N,) or (N, k) float64. With export="cut" new vertices on cuts get means.
        UsageError for values of another shape, or not numbers.
        """
        rows = np.asarray(floats("values", values), np.float64)
        if rows.ndim not in (1, 2) or len(rows) != len(self.source.positions):
            raise UsageError(
                f"values: its shape is {rows.shape}; pass a row for each of the "
                f"{len(self.source.positions)} positions of the source"
            )
        if not self.is_cut:
            return rows[self.vmapping]
        weights = self.weights.reshape(-1, 3, *([1] * (rows.ndim - 1)))
        means: npt.NDArray[np.float64] = (weights * rows[self.sources]).sum(axis=1)
        return means

    def image(self, size: int = 1024, tiles: bool = False) -> Picture:
        """Draws the atlas: (height, width, 3) uint8, charts in colours of their own, numbered.

        size: pixels along the longer side of a page, 16 to 8192; fewer where the picture would be
            longer than 16384.
        tiles: draw it twice along each axis that wraps, to show how it goes on.
        UsageError for a size out of range.
        """
        return as_picture(self._draw(_picture_size(size), tiles))

    def save_image(
        self, path: str | os.PathLike[str], size: int = 1024, tiles: bool = False
    ) -> None:
        """Draws the atlas to a file, .png or .svg; see image. OSError if it cannot be written."""
        self._save_picture(os.fspath(path), _picture_size(size), tiles)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes .obj, .ply, .gltf or .glb.

        A loaded mesh keeps what else its file held, in its own format. The file appears at once, or
        not at all. OSError if it cannot be written.
        """
        self._save(os.fspath(path))

    def to_trimesh(self) -> trimesh.Trimesh:
        """A trimesh.Trimesh with the new UVs, its vertices in the order of vmapping. Needs trimesh.

        With UVs beyond 1 (where the atlas wraps) textures have to repeat, which is what renderers
        of trimesh's exports do. ImportError without trimesh, UsageError without positions.
        """
        uv = np.array(self.uv, np.float64)
        if self.source.v_points_down:
            uv[:, 1] = 1 - uv[:, 1]
        return to_trimesh(self.positions, self.faces, uv)

    def _repr_png_(self) -> bytes:
        return _core.encode_png(self._draw(512, False), 8)

    def __repr__(self) -> str:
        pages = f" x {self.pages} pages" if self.pages > 1 else ""
        return (
            f"<wrapatlas.Packing: {self.chart_count} charts on {self.width} x {self.height} "
            f"texels{pages}, wrap {self.wrap}, {100 * self.efficiency:.1f} % in use>"
        )


def _picture_size(size: int) -> int:
    if not isinstance(size, (int, np.integer)) or not 16 <= size <= 8192:
        raise UsageError(f"size={size!r}: out of range; give a number of pixels from 16 to 8192")
    return int(size)


def pack(
    uv: npt.ArrayLike | MeshLike,
    faces: npt.ArrayLike | None = None,
    positions: npt.ArrayLike | None = None,
    position_faces: npt.ArrayLike | None = None,
    **options: Unpack[PackingOptions],
) -> Packing:
    """Packs the charts of an atlas anew: one scale for all, and a rotation and place for each.

    uv: (T, 2) float32 or float64; or a Mesh, trimesh.Trimesh or path of a model with UVs, and no
        more arrays.
    faces: (F, 3) integers into uv; (F, k) for polygons. Faces are of one chart if they share two
        indices; with positions, if they share two corners of equal position and equal UV.
    positions: (T, 3), for each uv, or (P, 3) with position_faces. For density, and for what is
        done with the result: saving, baking.
    position_faces: (F, 3) integers into positions.

    The options are those of the command `wrapatlas pack`, with its defaults:

    resolution: texels of the atlas: N, (W, H) or "WxH"; 1024.
    aspect: its shape at the area of resolution=N: "square", "W:H", "search" or "pow2".
    wrap: axes on which charts may go on over the border: "uv" (the default), "u", "v" or "none".
        Then UVs may exceed 1, and textures have to repeat.
    export: "continuous", or "cut": faces are split at the border, so that all UVs are in [0, 1].
    padding: texels between charts, kept exactly; max(2, resolution / 256).
    margin: texels to a side that does not wrap; half the padding.
    block: no two charts share a block of so many texels a side; 1.
    density: texels per unit of surface, kept exactly, on as many pages as that takes.
    pages: pages that may be used; 1, or as many as needed with density. udim: pages are UDIM tiles,
        and nothing wraps.
    method: "guided" (the densest), "modulo", "swg03", "zsgs04" or "lprm02".
    time: seconds that guided searches, 1; 0: until it is stuck once. moves: so many moves instead,
        so that the result is the same on every machine.
    rotations, rotation_base, grid, coverage, scale_start, lambda_, no_inner, all_sides, seed: how
        charts are tried; see `wrapatlas pack --help`.
    stacked: "separate" charts that lie on each other in the input, or "keep" them together.
    threads: 0: as many as the machine has.
    check: check the result exactly before it is returned; True.
    progress: True for bars (by tqdm, if it is there), or a function that is called with (stage,
        fraction, detail): "pack", a share from 0 to 1, the efficiency so far. If it returns False
        the search ends, with the best packing so far.
    on_interrupt: "raise": Ctrl-C raises KeyboardInterrupt; "best": it ends the search with the best
        packing so far, whose `interrupted` is True, if there is one.

    Raises UsageError and InputError (both ValueErrors), NoPacking if nothing fits, CheckFailed if a
    promise is broken (a bug of ours): all a wrapatlas.Error. OSError for a path that cannot be read,
    TypeError for an unknown option, KeyboardInterrupt (see on_interrupt). Takes as long as `time`,
    and some for the check.
    """
    refuse_unknown("pack", options, known_options("pack"))
    if faces is None:
        if positions is not None or position_faces is not None:
            raise UsageError("faces: there are none; pass the corners of each")
        mesh = as_mesh(_as_mesh_like(uv), "uv")
    else:
        mesh = _mesh_of_uvs(cast(npt.ArrayLike, uv), faces, positions, position_faces)
    settings = pack_settings(options)
    with reported(options.get("progress")) as progress:
        return Packing(_core.pack(mesh, settings, progress, keep_best(options)))


def _as_mesh_like(value: Any) -> MeshLike:
    if isinstance(value, (np.ndarray, list, tuple)):
        raise UsageError("faces: there are none; pass the corners of each, or a mesh")
    return cast(MeshLike, value)


def _mesh_of_uvs(
    uv: npt.ArrayLike,
    faces: npt.ArrayLike,
    positions: npt.ArrayLike | None,
    position_faces: npt.ArrayLike | None,
) -> _core.Mesh:
    if positions is None:
        if position_faces is not None:
            raise UsageError("position_faces: there are no positions; pass them, or leave it out")
        return core_mesh(None, faces, uv)
    if position_faces is None:
        return core_mesh(positions, faces, uv)
    return core_mesh(positions, position_faces, uv, faces)


def unwrap(
    vertices: npt.ArrayLike | MeshLike,
    faces: npt.ArrayLike | None = None,
    **options: Unpack[UnwrappingOptions],
) -> Packing:
    """Cuts a mesh into few charts, flattens them and packs them.

    vertices: (P, 3) float32 or float64; or a Mesh, trimesh.Trimesh or path of a model, and no faces.
    faces: (F, 3) integers into vertices; (F, k) for polygons. Faces are neighbours if they share two
        positions, by value.

    max_stretch: no chart is stretched more, by the measure of `stretch`; 2.
    stretch: "l2", the root mean square over a chart, or "linf", the largest at any place of it.
    max_charts: join charts beyond max_stretch until there are no more; 0: no limit.
    max_extent: cut charts that do not fit into a square of so many times the side of one that has the
        area of the whole surface; 0: no limit. Default: 1.5; with wrap="none" 0.8, as a page that
        does not wrap holds long charts badly.
    flatten: "labf" or "lscm". iterations: linear solves of labf; 2.
    hard_edges: cut along edges whose faces differ by more than so many degrees.
    keep_seams: cut wherever the UVs that the mesh has are cut. split_materials: and between
        materials, if it is a loaded model.

    All options of pack, too. progress is also called with stage "unwrap" and the number of charts so
    far. Ctrl-C while charts are cut raises KeyboardInterrupt in any case.

    Raises what pack raises.
    """
    refuse_unknown("unwrap", options, known_options("unwrap"))
    if faces is None:
        mesh = as_mesh(_as_mesh_like(vertices), "vertices")
    else:
        mesh = core_mesh(cast(npt.ArrayLike, vertices), faces)
    packing = pack_settings(options)
    cutting = unwrap_settings(options, packing)
    with reported(options.get("progress")) as progress:
        return Packing(_core.unwrap(mesh, cutting, packing, progress, keep_best(options)))
