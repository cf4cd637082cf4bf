"""What a packing knows of itself, so that nobody has to say it again."""

from __future__ import annotations

from typing import NamedTuple

from ._meshes import MeshLike


class Own(NamedTuple):
    """The defaults for a mesh: of a Packing its own."""

    size: int | tuple[int, int] | str
    wrap: str
    cut: str  # along these its faces were cut at the border
    pages: int


def own(mesh: MeshLike, wrap: str) -> Own:
    """wrap: of what is no Packing."""
    from ._packing import Packing

    if not isinstance(mesh, Packing):
        return Own(1024, wrap, "none", 1)
    size = (int(mesh.width), int(mesh.height))
    return Own(size, mesh.wrap, mesh.wrap if mesh.is_cut else "none", max(1, mesh.pages))
