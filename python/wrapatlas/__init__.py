"""Texture atlases packed on the torus: charts may go on over the border of the atlas.

``unwrap`` cuts a mesh into charts and packs them, ``pack`` packs charts that are there, ``check``
judges any atlas, ``bake`` and ``transfer`` make textures for one, ``render`` looks at it.
``parametrize`` and ``Atlas`` are those of xatlas-python.
"""

from __future__ import annotations

from ._check import check
from ._command import command
from ._core import VERSION as __version__
from ._core import CheckReport, Finding
from ._errors import CheckFailed, Error, FileError, InputError, NoPacking, UsageError
from ._images import Picture, load_image, save_image
from ._meshes import Mesh, MeshLike, load
from ._packing import Packing, pack, unwrap
from ._simplify import simplify
from ._textures import Baking, bake, render, transfer
from ._xatlas import (
    Atlas,
    Chart,
    ChartOptions,
    ChartType,
    PackOptions,
    export,
    parametrize,
)

__all__ = [
    "Atlas",
    "Baking",
    "Chart",
    "ChartOptions",
    "ChartType",
    "CheckFailed",
    "CheckReport",
    "Error",
    "FileError",
    "Finding",
    "InputError",
    "Mesh",
    "MeshLike",
    "NoPacking",
    "PackOptions",
    "Packing",
    "Picture",
    "UsageError",
    "__version__",
    "bake",
    "check",
    "command",
    "export",
    "load",
    "load_image",
    "pack",
    "parametrize",
    "render",
    "save_image",
    "simplify",
    "transfer",
    "unwrap",
]
