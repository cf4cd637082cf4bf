"""The interface of xatlas-python 0.0.11, on this library: only the import changes.

What differs is listed in docs/python.md.
"""

from __future__ import annotations

from typing import Iterator

import numpy as np
import numpy.typing as npt

from ._arrays import rows, triangles
from ._errors import UsageError
from ._images import Picture, as_picture
from ._obj import export
from ._packing import Packing
from ._xatlas_meshes import (
    Input,
    Output,
    divide,
    empty,
    generate,
    merge,
    utilization_of,
)
from ._xatlas_options import Chart, ChartOptions, ChartType, PackOptions, warn_useless

__all__ = ["Atlas", "Chart", "ChartOptions", "ChartType", "PackOptions", "export", "parametrize"]

Arrays = tuple[npt.NDArray[np.uint32], npt.NDArray[np.uint32], npt.NDArray[np.float32]]


class Atlas:
    """Several meshes in one atlas, as xatlas.Atlas."""

    def __init__(self) -> None:
        self._inputs: list[Input] = []
        self._outputs: list[Output] = []
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
        points = rows("positions", positions, 3)
        if normals is not None:
            rows("normals", normals, 3, len(points))
        coordinates = None if uvs is None else rows("uvs", uvs, 2, len(points))
        faces = triangles("indices", indices, len(points))
        self._add(Input(points, faces, coordinates, None, True))

    def add_uv_mesh(
        self,
        uvs: npt.ArrayLike,
        indices: npt.ArrayLike,
        face_materials: npt.ArrayLike | None = None,
    ) -> None:
        """Adds a mesh whose charts are to be packed again.

        uvs: (N, 2). indices: (F, 3). face_materials: (F,) or (F, 1): faces of different ones are
        of different charts. Faces hang together where their UVs are equal. UsageError for arrays of
        other shapes, indices out of range, and where the atlas has meshes added by add_mesh.
        """
        coordinates = rows("uvs", uvs, 2)
        faces = triangles("indices", indices, len(coordinates))
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
        self._add(Input(flat, faces, coordinates, materials, False))

    def _add(self, mesh: Input) -> None:
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
        warn_useless(how, where)
        inputs = [mesh for mesh in self._inputs if len(mesh.faces)]
        if not inputs:
            self._outputs = [empty(mesh) for mesh in self._inputs]
            return
        merged = merge(inputs, how)
        is_unwrapped = inputs[0].has_space and not how.use_input_mesh_uvs
        self._packing = generate(merged, is_unwrapped, how, where, verbose)
        self._outputs = divide(self._packing, self._inputs)
        self._utilization = utilization_of(self._packing)

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

    def _output(self, index: int) -> Output:
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
        meshes. Raises IndexError."""
        mesh = self._output(mesh_index)
        return mesh.vertex_atlas.copy(), mesh.vertex_chart.copy()

    def get_mesh_chart_count(self, mesh_index: int) -> int:
        """Charts of a mesh. Raises IndexError."""
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
