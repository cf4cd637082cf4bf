"""Several meshes as one that is packed, and back: what is behind the Atlas of xatlas-python."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._errors import InputError, NoPacking, UsageError
from ._meshes import core_mesh
from ._packing import Packing, pack, unwrap
from ._xatlas_options import BRUTE_FORCE_TIME, ChartOptions, PackOptions


@dataclass(frozen=True)
class Input:
    """A mesh that was added."""

    positions: npt.NDArray[Any]
    faces: npt.NDArray[Any]
    uvs: npt.NDArray[Any] | None
    materials: npt.NDArray[Any] | None
    has_space: bool


@dataclass(frozen=True)
class Output:
    """What became of it."""

    vmapping: npt.NDArray[np.uint32]
    faces: npt.NDArray[np.uint32]
    uvs: npt.NDArray[np.float32]
    vertex_atlas: npt.NDArray[np.uint32]
    vertex_chart: npt.NDArray[np.uint32]
    face_chart: npt.NDArray[np.uint32]
    materials: npt.NDArray[Any] | None


def merge(inputs: list[Input], how: ChartOptions) -> _core.Mesh:
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


def generate(
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
        if how.max_extent is not None:
            cut["max_extent"] = how.max_extent
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


def divide(packing: Packing, inputs: list[Input]) -> list[Output]:
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
            outputs.append(empty(mesh))
            continue
        end_face = first_face + len(mesh.faces)
        end_vertex = int(faces[first_face:end_face].max()) + 1
        rows = slice(first_vertex, end_vertex)
        outputs.append(
            Output(
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


def empty(mesh: Input) -> Output:
    none = np.zeros(0, np.uint32)
    return Output(
        none, np.zeros((0, 3), np.uint32), np.zeros((0, 2), np.float32), none, none, none, None
    )


def utilization_of(packing: Packing) -> list[float]:
    corners = packing.uv.astype(np.float64)[packing.faces]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
    pages = packing.chart_pages[packing.face_chart]
    return [float(areas[pages == page].sum()) for page in range(packing.pages)]
