"""The interface of xatlas-python 0.0.11, on this library: only the import changes.

What differs is listed in docs/python.md.
"""

from __future__ import annotations

import enum
import math
import warnings
from dataclasses import dataclass, fields
from typing import Any, Iterator

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import floats, indices
from ._errors import InputError, NoPacking, UsageError
from ._images import Picture, as_picture
from ._meshes import core_mesh
from ._obj import export
from ._packing import Packing, pack, unwrap

__all__ = ["Atlas", "Chart", "ChartOptions", "ChartType", "PackOptions", "export", "parametrize"]

Arrays = tuple[npt.NDArray[np.uint32], npt.NDArray[np.uint32], npt.NDArray[np.float32]]

DEFAULT_TIME = 1.0
BRUTE_FORCE_TIME = 5.0


@dataclass
class ChartOptions:
    """How charts are cut. Those of xatlas that mean nothing here are kept, so that code runs: a
    warning says so where they are set to other values."""

    max_chart_area: float = 0.0
    max_boundary_length: float = 0.0
    normal_deviation_weight: float = 2.0
    roundness_weight: float = 0.01
    straightness_weight: float = 6.0
    normal_seam_weight: float = 4.0
    texture_seam_weight: float = 0.5
    max_cost: float = 2.0
    max_iterations: int = 1
    use_input_mesh_uvs: bool = False
    """Pack the charts of the uvs that meshes were added with; all need them then."""
    fix_winding: bool = False
    """Nothing to do: no chart is mirrored, however its faces are wound."""
    max_stretch: float = 2.0
    """Ours: no chart is stretched more; see wrapatlas.unwrap."""
    max_charts: int = 0
    """Ours: join charts beyond max_stretch until there are no more; 0: no limit."""


@dataclass
class PackOptions:
    """How charts are packed."""

    max_chart_size: int = 0
    """Means nothing here: all charts have one scale."""
    padding: int = 0
    """Texels between charts."""
    texels_per_unit: float = 0.0
    """If not 0, charts keep this scale: on one atlas that is large enough, or with `resolution` on as
    many square ones of that size as it takes; NoPacking if a chart is larger than one."""
    resolution: int = 0
    """The atlas has about so many texels, squared; 0: 1024, or what texels_per_unit takes. Its shape
    is chosen, but with both given."""
    bilinear: bool = True
    """A texel more between charts, for bilinear filters."""
    blockAlign: bool = False  # noqa: N815
    """No two charts share a block of 4 x 4 texels."""
    bruteForce: bool = False  # noqa: N815
    """Search for 5 seconds, in place of `time`."""
    create_image: bool = False
    """Pictures can be drawn in any case."""
    rotate_charts_to_axis: bool = True
    rotate_charts: bool = True
    """Without one of the two, or both, charts are turned by quarters alone, to the axes of their
    boxes alone, or not at all; and packed by the method "modulo", which is less dense."""
    wrap: str = "none"
    """Ours: "uv": charts may go on over the border, which packs denser; UVs may exceed 1."""
    time: float = DEFAULT_TIME
    """Ours: seconds to search."""
    threads: int = 0
    """Ours: 0: as many as the machine has."""


class ChartType(enum.IntEnum):
    """How a chart was flattened. Here all are LSCM: conformal."""

    Planar = 0
    Ortho = 1
    LSCM = 2
    Piecewise = 3
    Invalid = 4


@dataclass(frozen=True)
class Chart:
    """A chart of one mesh."""

    faces: npt.NDArray[np.uint32]
    """Faces of the mesh."""
    atlas_index: int
    material: int
    type: ChartType = ChartType.LSCM


@dataclass(frozen=True)
class _Input:
    """A mesh that was added."""

    positions: npt.NDArray[Any]
    faces: npt.NDArray[Any]
    uvs: npt.NDArray[Any] | None
    materials: npt.NDArray[Any] | None
    has_space: bool


@dataclass(frozen=True)
class _Output:
    """What became of it."""

    vmapping: npt.NDArray[np.uint32]
    faces: npt.NDArray[np.uint32]
    uvs: npt.NDArray[np.float32]
    vertex_atlas: npt.NDArray[np.uint32]
    vertex_chart: npt.NDArray[np.uint32]
    face_chart: npt.NDArray[np.uint32]
    materials: npt.NDArray[Any] | None


class Atlas:
    """Several meshes in one atlas, as xatlas.Atlas."""

    def __init__(self) -> None:
        self._inputs: list[_Input] = []
        self._outputs: list[_Output] = []
        self._packing: Packing | None = None
        self._utilization: list[float] = []

    def add_mesh(
        self,
        positions: npt.ArrayLike,
        indices: npt.ArrayLike,
        normals: npt.ArrayLike | None = None,
        uvs: npt.ArrayLike | None = None,
    ) -> None:
        """Adds a mesh that is to be unwrapped.

        positions: (N, 3). indices: (F, 3), triangles. normals: (N, 3), not looked at. uvs: (N, 2),
        for ChartOptions.use_input_mesh_uvs. Raises ValueError for arrays that cannot be used.
        """
        points = _rows("positions", positions, 3)
        if normals is not None:
            _rows("normals", normals, 3, len(points))
        coordinates = None if uvs is None else _rows("uvs", uvs, 2, len(points))
        faces = _triangles(indices, len(points))
        self._add(_Input(points, faces, coordinates, None, True))

    def add_uv_mesh(
        self,
        uvs: npt.ArrayLike,
        indices: npt.ArrayLike,
        face_materials: npt.ArrayLike | None = None,
    ) -> None:
        """Adds a mesh whose charts are to be packed again.

        uvs: (N, 2). indices: (F, 3). face_materials: (F,) or (F, 1): faces of different ones are of different
        charts. Faces hang together where their UVs are equal.
        """
        coordinates = _rows("uvs", uvs, 2)
        faces = _triangles(indices, len(coordinates))
        materials = None
        if face_materials is not None:
            materials = np.asarray(face_materials)
            if materials.ndim == 2 and materials.shape[1] == 1:  # what xatlas asks for
                materials = materials[:, 0]
            if materials.shape != (len(faces),):
                raise UsageError(
                    f"face_materials: its shape is {materials.shape}; pass ({len(faces)},): one for "
                    "each face"
                )
        flat = np.column_stack([coordinates, np.zeros(len(coordinates), coordinates.dtype)])
        self._add(_Input(flat, faces, coordinates, materials, False))

    def _add(self, mesh: _Input) -> None:
        if any(one.has_space != mesh.has_space for one in self._inputs):
            raise UsageError("atlas: it cannot hold meshes and UV meshes; use an atlas for each")
        self._inputs.append(mesh)
        self._outputs, self._packing, self._utilization = [], None, []

    def generate(
        self,
        chart_options: ChartOptions | None = None,
        pack_options: PackOptions | None = None,
        verbose: bool = False,
    ) -> None:
        """Unwraps and packs all that was added. verbose: with bars of progress, if tqdm is there.

        Raises ValueError for meshes without any area, wrapatlas.NoPacking, KeyboardInterrupt.
        """
        how, where = chart_options or ChartOptions(), pack_options or PackOptions()
        _warn_useless(how, where)
        inputs = [mesh for mesh in self._inputs if len(mesh.faces)]
        if not inputs:
            self._outputs = [_empty(mesh) for mesh in self._inputs]
            return
        merged = _merge(inputs, how)
        is_unwrapped = inputs[0].has_space and not how.use_input_mesh_uvs
        self._packing = _generate(merged, is_unwrapped, how, where, verbose)
        self._outputs = _divide(self._packing, self._inputs)
        self._utilization = _utilization(self._packing)

    @property
    def mesh_count(self) -> int:
        """Meshes; 0 before generate."""
        return len(self._outputs)

    def __len__(self) -> int:
        return len(self._outputs)

    def __iter__(self) -> Iterator[Arrays]:
        return (self.get_mesh(i) for i in range(len(self)))

    def get_mesh(self, mesh_index: int) -> Arrays:
        """(vmapping, indices, uvs) of a mesh.

        vmapping: (N,) uint32, the vertex of the mesh that was added. indices: (F, 3) uint32, in the
        order of its faces. uvs: (N, 2) float32. Raises IndexError.
        """
        mesh = self._output(mesh_index)
        return mesh.vmapping.copy(), mesh.faces.copy(), mesh.uvs.copy()

    __getitem__ = get_mesh

    def _output(self, index: int) -> _Output:
        if not 0 <= index < len(self._outputs):
            raise IndexError(
                f"Mesh index {index} out of bounds for atlas with {len(self._outputs)} meshes."
            )
        return self._outputs[index]

    def _check_atlas(self, index: int) -> Packing:
        if self._packing is None or not 0 <= index < self._packing.pages:
            raise IndexError(f"Atlas index {index} out of bounds.")
        return self._packing

    @property
    def width(self) -> int:
        """Texels of each atlas; 0 before generate."""
        return 0 if self._packing is None else self._packing.width

    @property
    def height(self) -> int:
        """Texels of each atlas; 0 before generate."""
        return 0 if self._packing is None else self._packing.height

    @property
    def atlas_count(self) -> int:
        """Atlases (pages); 0 before generate."""
        return 0 if self._packing is None else self._packing.pages

    @property
    def chart_count(self) -> int:
        """Charts of all meshes."""
        return 0 if self._packing is None else self._packing.chart_count

    @property
    def texels_per_unit(self) -> float:
        """Texels per unit of surface (of UVs, for UV meshes), a mean."""
        return 0.0 if self._packing is None else self._packing.density

    @property
    def utilization(self) -> float:
        """Share of the first atlas that charts cover. Not of texels, as xatlas has it, but exact."""
        return self.get_utilization(0)

    def get_utilization(self, atlas_index: int) -> float:
        """Share of an atlas that charts cover. Raises IndexError."""
        self._check_atlas(atlas_index)
        return self._utilization[atlas_index]

    @property
    def chart_image(self) -> Picture:
        """A picture of the first atlas."""
        return self.get_chart_image(0)

    def get_chart_image(self, atlas_index: int) -> Picture:
        """A picture of an atlas: (height, width, 3) uint8; row 0 is at v = 0, as xatlas has it.

        Atlases of more than 8192 texels a side, or many of them, are drawn smaller. Raises
        IndexError.
        """
        packing = self._check_atlas(atlas_index)
        size = min(8192, max(16, packing.width, packing.height))
        image = packing.image(size)[::-1]
        columns = min(packing.pages, 10)
        rows = -(-packing.pages // 10)
        height, width = image.shape[0] // rows, image.shape[1] // columns
        row, column = divmod(atlas_index, 10)
        part = image[row * height : (row + 1) * height, column * width : (column + 1) * width]
        return as_picture(part)

    def get_mesh_vertex_assignment(
        self, mesh_index: int
    ) -> tuple[npt.NDArray[np.uint32], npt.NDArray[np.uint32]]:
        """(N,) uint32 each: the atlas and the chart of each vertex. Charts are numbered over all
        meshes."""
        mesh = self._output(mesh_index)
        return mesh.vertex_atlas.copy(), mesh.vertex_chart.copy()

    def get_mesh_chart_count(self, mesh_index: int) -> int:
        """Charts of a mesh."""
        return len(np.unique(self._output(mesh_index).face_chart))

    def get_mesh_chart(self, mesh_index: int, chart_index: int) -> Chart:
        """A chart of a mesh, numbered from 0 in each mesh. Raises IndexError."""
        mesh = self._output(mesh_index)
        numbers = np.unique(mesh.face_chart)
        if not 0 <= chart_index < len(numbers):
            raise IndexError(
                f"Chart index {chart_index} out of bounds for mesh with {len(numbers)} charts."
            )
        number = numbers[chart_index]
        faces = np.flatnonzero(mesh.face_chart == number).astype(np.uint32)
        page = 0 if self._packing is None else int(self._packing.chart_pages[number])
        material = 0 if mesh.materials is None else int(mesh.materials[faces[0]])
        return Chart(faces, page, material)


def parametrize(
    positions: npt.ArrayLike,
    indices: npt.ArrayLike,
    normals: npt.ArrayLike | None = None,
    uvs: npt.ArrayLike | None = None,
) -> Arrays:
    """Unwraps a mesh: (vmapping, indices, uvs), as xatlas.parametrize.

    positions: (P, 3) floats. indices: (F, 3) integers. normals: (P, 3), not looked at. uvs: (P, 2),
    not looked at.

    vmapping: (N,) uint32, the original vertex of each new vertex. indices: (F, 3) uint32, the new
    vertices of each face, in the order given. uvs: (N, 2) float32 in [0, 1]: nothing wraps.

    For more than that use wrapatlas.unwrap, or an Atlas. Raises ValueError for arrays that cannot be
    used, KeyboardInterrupt. Searches for a second.
    """
    atlas = Atlas()
    atlas.add_mesh(positions, indices, normals, uvs)
    atlas.generate()
    return atlas.get_mesh(0)


def _rows(
    name: str, value: npt.ArrayLike, columns: int, count: int | None = None
) -> npt.NDArray[Any]:
    array = np.asarray(value)
    if array.ndim != 2 or array.shape[1] != columns:
        raise UsageError(f"{name}: its shape is {array.shape}; pass (N, {columns})")
    if count is not None and len(array) != count:
        raise UsageError(f"{name}: there are {len(array)} for {count} positions; pass one for each")
    array = floats(name, array)
    if not np.isfinite(array).all():
        bad = int(np.argwhere(~np.isfinite(array))[0, 0])
        raise InputError(f"{name}[{bad}]: NaN or infinite; pass finite numbers")
    return array


def _triangles(value: npt.ArrayLike, count: int) -> npt.NDArray[Any]:
    array = np.asarray(value)
    if array.ndim != 2 or array.shape[1] != 3:
        raise UsageError(f"indices: its shape is {array.shape}; pass (F, 3): triangles")
    array = indices("indices", array)
    if array.size and (array.min() < 0 or array.max() >= count):
        face = int(np.argwhere((array < 0) | (array >= count))[0, 0])
        raise InputError(
            f"indices[{face}]: {array[face].tolist()} is out of range; there are {count} vertices, "
            "numbered from 0"
        )
    return array


_IGNORED_CHART = (
    "max_chart_area", "max_boundary_length", "normal_deviation_weight", "roundness_weight",
    "straightness_weight", "normal_seam_weight", "texture_seam_weight", "max_cost",
    "max_iterations",
)  # fmt: skip


def _warn_useless(how: ChartOptions, where: PackOptions) -> None:
    defaults = {field.name: field.default for field in fields(ChartOptions)}
    ignored = [name for name in _IGNORED_CHART if getattr(how, name) != defaults[name]]
    if where.max_chart_size:
        ignored.append("max_chart_size")
    if where.texels_per_unit and not (where.rotate_charts and where.rotate_charts_to_axis):
        ignored.append("rotate_charts beside texels_per_unit")
    if ignored:
        warnings.warn(
            f"wrapatlas has no use for {', '.join(ignored)}; see docs/python.md", stacklevel=3
        )


def _merge(inputs: list[_Input], how: ChartOptions) -> _core.Mesh:
    """One mesh, of an object for each mesh (and material)."""
    offset, objects = 0, 0
    faces, face_objects = [], []
    for mesh in inputs:
        faces.append(mesh.faces.astype(np.int64) + offset)
        offset += len(mesh.positions)
        if mesh.materials is None:
            numbers = np.zeros(len(mesh.faces), np.int64)
        else:
            numbers = np.unique(mesh.materials, return_inverse=True)[1].reshape(-1)
        face_objects.append(numbers + objects)
        objects += int(numbers.max()) + 1
    uvs = None
    if how.use_input_mesh_uvs or not inputs[0].has_space:
        if any(mesh.uvs is None for mesh in inputs):
            raise UsageError("use_input_mesh_uvs: a mesh was added without uvs; pass them")
        uvs = np.concatenate([mesh.uvs for mesh in inputs if mesh.uvs is not None])
    return core_mesh(
        np.concatenate([mesh.positions for mesh in inputs]),
        np.concatenate(faces),
        uvs,
        objects=np.concatenate(face_objects),
    )


def _generate(
    mesh: _core.Mesh, is_unwrapped: bool, how: ChartOptions, where: PackOptions, verbose: bool
) -> Packing:
    options: dict[str, Any] = {
        "wrap": where.wrap,
        "padding": where.padding + (1 if where.bilinear else 0),
        "threads": where.threads,
        "progress": verbose,
        "block": 4 if where.blockAlign else 1,
        "resolution": where.resolution or 1024,
    }
    if (where.rotate_charts and where.rotate_charts_to_axis) or where.texels_per_unit:
        options["time"] = BRUTE_FORCE_TIME if where.bruteForce else where.time
    else:
        options["method"] = "modulo"
        options["rotations"] = 4 if where.rotate_charts else 1
        options["rotation_base"] = "box" if where.rotate_charts_to_axis else "input"
    unit = where.texels_per_unit
    if unit and where.resolution:
        options["density"] = unit
    else:
        options["aspect"] = "search"  # as xatlas, which chooses the shape, too
    if is_unwrapped:
        cut: dict[str, Any] = {"max_stretch": how.max_stretch, "max_charts": how.max_charts}
        packing = unwrap(mesh, **options, **cut)
    else:
        packing = pack(mesh, **options)
    return _at_scale(packing, unit, options) if unit and not where.resolution else packing


def _at_scale(packing: Packing, unit: float, options: dict[str, Any]) -> Packing:
    """The same charts on one atlas, as small as it can be at so many texels per unit."""
    if packing.density == 0:
        raise InputError("texels_per_unit: the meshes have no area, so there is no such scale")
    charts = packing.mesh
    larger = unit / packing.density
    del options["aspect"]
    for _ in range(20):
        sides = [max(1, math.ceil(larger * side)) for side in (packing.width, packing.height)]
        if max(sides) > 65536:
            break
        try:
            return pack(charts, **{**options, "resolution": tuple(sides)}, density=unit, pages=1)
        except NoPacking:
            larger *= 1.02
    raise NoPacking(f"texels_per_unit={unit:g}: no atlas is large enough; give less")


def _divide(packing: Packing, inputs: list[_Input]) -> list[_Output]:
    """Vertices are numbered as faces meet them, so those of a mesh are in a row."""
    faces, face_chart = packing.faces, packing.face_chart
    vertex_chart = np.zeros(len(packing.vmapping), np.uint32)
    vertex_chart[faces] = face_chart[:, None]
    pages = packing.chart_pages[vertex_chart]
    tile = np.stack([pages % 10, pages // 10], axis=1).astype(np.float32)
    uvs = packing.uv - tile
    outputs = []
    first_face = first_vertex = first_source = 0
    for mesh in inputs:
        if len(mesh.faces) == 0:
            outputs.append(_empty(mesh))
            continue
        end_face = first_face + len(mesh.faces)
        end_vertex = int(faces[first_face:end_face].max()) + 1
        rows = slice(first_vertex, end_vertex)
        outputs.append(
            _Output(
                packing.vmapping[rows] - np.uint32(first_source),
                faces[first_face:end_face] - np.uint32(first_vertex),
                uvs[rows],
                pages[rows].astype(np.uint32),
                vertex_chart[rows],
                face_chart[first_face:end_face],
                mesh.materials,
            )
        )
        first_face, first_vertex = end_face, end_vertex
        first_source += len(mesh.positions)
    return outputs


def _empty(mesh: _Input) -> _Output:
    none = np.zeros(0, np.uint32)
    return _Output(
        none, np.zeros((0, 3), np.uint32), np.zeros((0, 2), np.float32), none, none, none, None
    )


def _utilization(packing: Packing) -> list[float]:
    corners = packing.uv.astype(np.float64)[packing.faces]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
    pages = packing.chart_pages[packing.face_chart]
    return [float(areas[pages == page].sum()) for page in range(packing.pages)]

