"""Textures for an atlas: baked, moved there, and looked at."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Sequence, cast

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import indices, pixels
from ._errors import UsageError
from ._images import Picture, as_picture
from ._meshes import MeshLike, as_mesh
from ._options import set_given, set_size
from ._own import own
from ._progress import reported

if TYPE_CHECKING:
    from ._progress import ProgressLike

__all__ = ["Baking", "bake", "render", "transfer"]

Wrap = Literal["uv", "u", "v", "none"]
MapKind = Literal["tangent", "object", "position", "occlusion", "color"]


@dataclass(frozen=True, eq=False)
class Baking:
    """What bake returns. A notebook shows its first map."""

    maps: dict[str, Picture]
    """By kind: (height, width, channels) float32, 0 to 1, rows from the top."""
    inside: npt.NDArray[np.bool_]
    """(height, width): texels that lie on a chart; the others were filled by dilation."""
    texels_nearest: int
    """Texels from which no ray met the high mesh, so that its nearest point was taken."""
    faces_without_uv: int
    """Of the low mesh: not baked."""
    faces_outside: int
    """Of the low mesh, as triangles: partly outside [0, 1] on an axis that does not wrap, and not
    baked there."""
    distance: float
    """How far the high mesh was looked for, in units of the meshes."""
    position_origin: tuple[float, float, float]
    """Of the map "position": (p - origin) / extent is what it holds."""
    position_extent: float

    @property
    def image(self) -> Picture:
        """The first map."""
        return next(iter(self.maps.values()))

    def _repr_png_(self) -> bytes | None:
        return self.image._repr_png_()

    def __repr__(self) -> str:
        sizes = ", ".join(f"{kind} {one.shape[1]} x {one.shape[0]}" for kind, one in self.maps.items())
        return f"<wrapatlas.Baking: {sizes}>"


def bake(
    low: MeshLike,
    high: MeshLike,
    map: MapKind | Sequence[MapKind] = "tangent",
    *,
    resolution: int | tuple[int, int] | str | None = None,
    wrap: Wrap | None = None,
    samples: int = 2,
    fit: bool = True,
    bleed: float = 32,
    distance: float = 0,
    hard_edges: float | None = None,
    high_hard_edges: float | None = None,
    color_from: npt.ArrayLike | None = None,
    occlusion_rays: int = 64,
    occlusion_distance: float = 0,
    threads: int = 0,
    progress: ProgressLike = None,
) -> Baking:
    """Writes what a detailed mesh looks like into the atlas of a simpler one.

    low: with UVs; a Packing, Mesh, trimesh.Trimesh or path of a model. high: what is baked. Where
        nodes of a glTF move its meshes, give load(path, in_scene=True) for both.
    map: one kind, or several: "tangent" (normals along MikkTSpace's tangents, green up), "object"
        (normals along the axes), "position", "occlusion", "color" (of color_from).
    resolution: texels: N, (W, H) or "WxH". wrap: axes on which the atlas repeats. If low is a
        Packing both are as it was packed, if they are not given; else 1024 and "uv".
    samples: a texel looks at so many places, squared, and is the mean of what is seen there.
    fit: texels of normals, if samples > 1, come as near as they can to all samples when they are
        filtered, instead of being means.
    bleed: texels by which charts go on over their borders, along the surface, for mip levels to
        see; beyond, the nearest texel is repeated.
    distance: how far from the low mesh the high one is looked for, in their units; 0: twice the
        largest distance between them.
    hard_edges, high_hard_edges: degrees between faces from which on normals are not smooth.
    color_from: pixels, sRGB, on the high mesh's UVs.
    occlusion_rays, occlusion_distance: rays of each sample, and how far they go; 0: no end.
    progress: see pack; the stage is "bake".

    Raises UsageError and InputError (both ValueErrors), OSError for a path that cannot be read,
    KeyboardInterrupt, and wrapatlas.Error if `progress` stops it.
    """
    settings = _core.BakeSettings()
    known = own(low, "uv")
    set_size(settings, known.size if resolution is None else resolution)
    set_given(
        settings,
        {
            "wrap": known.wrap if wrap is None else wrap,
            "samples": samples,
            "fit": bool(fit),
            "bleed": bleed,
            "distance": distance,
            "hard_edges": hard_edges,
            "high_hard_edges": high_hard_edges,
            "occlusion_rays": occlusion_rays,
            "occlusion_distance": occlusion_distance,
            "threads": threads,
        },
    )
    kinds = [str(map)] if isinstance(map, str) else [str(kind) for kind in map]
    if not kinds:
        raise UsageError("map: there is none; give a kind, or several")
    if "color" in kinds and color_from is None:
        raise UsageError("map='color': there is no texture to take it from; give color_from=")
    color = None if color_from is None else pixels("color_from", color_from)
    with reported(progress) as report:
        baked = _core.bake(as_mesh(low, "low"), as_mesh(high, "high"), kinds, color, settings, report)
    mask = baked.take_inside(int(settings.width), int(settings.height))
    inside: npt.NDArray[np.bool_] = mask.astype(np.bool_)
    return Baking(
        maps={kind: as_picture(baked.take(i)) for i, kind in enumerate(kinds)},
        inside=inside,
        texels_nearest=baked.texels_nearest,
        faces_without_uv=baked.faces_without_uv,
        faces_outside=baked.faces_outside,
        distance=baked.distance,
        position_origin=baked.position_origin,
        position_extent=baked.position_extent,
    )


def transfer(
    texture: npt.ArrayLike | Sequence[npt.ArrayLike | None],
    before: MeshLike,
    after: MeshLike,
    *,
    role: Literal["color", "normals", "data"] = "color",
    face_texture: npt.ArrayLike | None = None,
    resolution: int | tuple[int, int] | str | None = None,
    wrap: Wrap | None = None,
    repeat: Literal["repeat", "mirror", "clamp"] = "repeat",
    keep_tangents: bool = False,
    bleed: float = 32,
    threads: int = 0,
    progress: ProgressLike = None,
) -> Picture:
    """Moves a texture to a new atlas, so that the mesh looks as before.

    texture: (height, width) or (height, width, channels), uint8, uint16 or floats from 0 to 1; with
        face_texture a list of them, and None for faces that have none.
    before, after: the same faces, with the old and with the new UVs. For a packing of a mesh m:
        ``transfer(texture, m, packing, ...)``. Not one that was made with export="cut".
    role: "color" (sRGB: resampled in linear light), "normals" (of tangent space: turned with the
        chart) or "data" (as it is).
    face_texture: (F,) integers: which of the textures each face has.
    resolution: texels of the new texture. wrap: axes on which the new atlas repeats. If after is a
        Packing both are as it was packed, if they are not given; else 1024 and "uv".
    repeat: what the old texture does outside [0, 1].
    keep_tangents: normals stay along tangents that the mesh has: they are not turned.
    bleed: as in bake.
    progress: see pack; the stage is "transfer".

    Returns (height, width, channels) float32, 0 to 1.

    Raises UsageError and InputError (both ValueErrors), OSError for a path that cannot be read,
    KeyboardInterrupt, and wrapatlas.Error if `progress` stops it.
    """
    settings = _core.TransferSettings()
    known = own(after, "uv")
    set_size(settings, known.size if resolution is None else resolution)
    set_given(settings, {"wrap": known.wrap if wrap is None else wrap, "threads": threads})
    set_given(settings, {"role": role, "repeat": repeat})
    settings.keep_tangents = keep_tangents
    settings.bleed = bleed
    textures: list[npt.NDArray[Any] | None]
    if face_texture is None:
        textures = [pixels("texture", cast(npt.ArrayLike, texture))]
        groups = None
    else:
        if isinstance(texture, np.ndarray) and texture.ndim < 4:
            raise UsageError("texture: one array; with face_texture pass a list of them")
        several = cast("Sequence[npt.ArrayLike | None]", texture)
        textures = [None if one is None else pixels("texture", one) for one in several]
        groups = indices("face_texture", face_texture)
    old, new = as_mesh(before, "before"), as_mesh(after, "after")
    with reported(progress) as report:
        return as_picture(_core.transfer(old, new, textures, groups, settings, report))


def render(
    mesh: MeshLike,
    texture: npt.ArrayLike | None = None,
    normal_map: npt.ArrayLike | None = None,
    *,
    size: int = 768,
    views: int = 2,
    azimuth: float | None = None,
    elevation: float | None = None,
    shade: Literal["smooth", "flat", "none"] = "smooth",
    space: Literal["tangent", "object"] = "tangent",
    filter: Literal["trilinear", "bilinear"] = "trilinear",
    wrap: Wrap | None = None,
    level: float | None = None,
    hard_edges: float | None = None,
    framed_as: MeshLike | None = None,
    threads: int = 0,
) -> Picture:
    """Draws a mesh, with textures as graphics cards show them.

    mesh: a Mesh, Packing, trimesh.Trimesh or path of a model. y is up.
    texture: its colours, sRGB: (height, width[, channels]), uint8, uint16 or floats from 0 to 1.
    normal_map: as bake makes it, along `space`.
    size: pixels of each view, square, 16 to 4096. views: side by side, from around the mesh, 1 to 64.
    azimuth, elevation: degrees; one view, from there, in place of those.
    shade: without a normal map: by smooth normals, by those of the faces, or no light.
    filter: how textures are read. wrap: axes on which they repeat; as the mesh was packed, if it is
        a Packing, else "uv". level: the mip level everywhere, in place of one by size.
    hard_edges: degrees between faces from which on normals are not smooth.
    framed_as: a mesh that the views are set up for instead.

    Returns (size, views * size, 3) uint8; a notebook shows it. Raises UsageError and InputError (both
    ValueErrors), OSError for a path that cannot be read. Ctrl-C is heeded when it is done.
    """
    settings = _core.RenderSettings()
    given = {"size": size, "views": views, "shade": shade, "space": space, "filter": filter}
    set_given(settings, given)
    set_given(settings, {"wrap": own(mesh, "uv").wrap if wrap is None else wrap, "level": level, "threads": threads})
    if azimuth is not None:
        settings.set_azimuth(azimuth)
    if elevation is not None:
        settings.set_elevation(elevation)
    if hard_edges is not None:
        settings.set_hard_edges(hard_edges)
    return as_picture(
        _core.render(
            as_mesh(mesh),
            settings,
            None if texture is None else pixels("texture", texture),
            None if normal_map is None else pixels("normal_map", normal_map),
            None if framed_as is None else as_mesh(framed_as, "framed_as"),
        )
    )
