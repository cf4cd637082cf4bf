"""The exact check of a finished atlas."""

from __future__ import annotations

from typing import Literal

from . import _core
from ._meshes import MeshLike, as_mesh
from ._options import choice, set_given, set_size
from ._own import own

__all__ = ["check"]


def check(
    atlas: MeshLike,
    reference: MeshLike | None = None,
    *,
    resolution: int | tuple[int, int] | str | None = None,
    wrap: Literal["uv", "u", "v", "none"] | None = None,
    cut: Literal["uv", "u", "v", "none"] | None = None,
    padding: float = 0,
    margin: float = 0,
    pages: int | None = None,
    tolerance: float = 1e-3,
    stacked: Literal["separate", "keep"] = "separate",
    findings: int = 20,
    threads: int = 0,
) -> _core.CheckReport:
    """Checks any finished atlas by its exact triangles: ours, or another program's.

    atlas: a Mesh, Packing, trimesh.Trimesh or path of a model, with UVs.
    reference: what it was packed from. Then every face has to be there, every chart to be a copy at
        one common scale, none mirrored.
    resolution: texels of the atlas: N, (W, H) or "WxH". wrap: axes on which it wraps. cut: axes
        along which it was cut (export="cut"). Of a Packing they are its own if they are not given,
        and so is pages; else 1024, "none", "none" and 1.
    padding: texels that must lie between charts. margin: and to a side that does not wrap.
    pages: how many UV tiles it may have, as UDIM numbers them.
    tolerance: texels by which a chart may differ from a similar copy of its source.
    stacked: "keep": charts that overlap in the reference may overlap here.
    findings: how many violations to describe.

    Returns a CheckReport, which is true if all holds. Raises InputError (a ValueError) if there is
    no atlas, or if the meshes cannot be compared, UsageError (another) for options, OSError for a
    path that cannot be read. Ctrl-C is heeded when it is done.
    """
    settings = _core.CheckSettings()
    known = own(atlas, "none")
    set_size(settings, known.size if resolution is None else resolution)
    own_wrap = "none" if known.cut != "none" else known.wrap
    set_given(
        settings,
        {
            "wrap": own_wrap if wrap is None else wrap,
            "cut": known.cut if cut is None else cut,
            "padding": padding,
            "margin": margin,
            "pages": known.pages if pages is None else pages,
            "tolerance": tolerance,
            "findings": findings,
            "threads": threads,
        },
    )
    settings.stacked_ok = choice("stacked", stacked, "separate", "keep")
    other = None if reference is None else as_mesh(reference, "reference")
    return _core.check(as_mesh(atlas, "atlas"), other, settings)
