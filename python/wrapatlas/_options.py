"""The options of pack and unwrap: their names are the command's."""

from __future__ import annotations

import re
import warnings
from typing import TYPE_CHECKING, Any, Literal, Mapping, TypedDict

from . import _core
from ._errors import UsageError

if TYPE_CHECKING:
    from ._progress import ProgressLike

__all__ = ["PackingOptions", "UnwrappingOptions"]



class PackingOptions(TypedDict, total=False):
    """What pack takes beside the mesh; see its documentation."""

    resolution: int | tuple[int, int] | str
    aspect: str
    wrap: Literal["uv", "u", "v", "none"]
    export: Literal["continuous", "cut"]
    padding: float
    margin: float
    block: int
    density: float
    pages: int
    udim: bool
    method: Literal["guided", "modulo", "swg03", "zsgs04", "lprm02"]
    time: float
    moves: int
    rotations: int
    rotation_base: Literal["input", "box"]
    grid: int
    coverage: Literal["conservative", "center"]
    scale_start: float
    lambda_: float
    no_inner: bool
    all_sides: bool
    seed: int
    stacked: Literal["separate", "keep"]
    threads: int
    check: bool
    progress: ProgressLike
    on_interrupt: Literal["raise", "best"]


class UnwrappingOptions(PackingOptions, total=False):
    """What unwrap takes beside the mesh; see its documentation."""

    max_stretch: float
    stretch: Literal["l2", "linf"]
    max_charts: int
    max_extent: float
    flatten: Literal["labf", "lscm"]
    iterations: int
    hard_edges: float
    keep_seams: bool
    split_materials: bool


# Set as they are, if they are given.
_PLAIN = (
    "margin", "block", "density", "time", "moves", "rotations", "rotation_base", "grid",
    "coverage", "scale_start", "lambda_", "no_inner", "all_sides", "seed", "stacked", "threads",
    "check",
)  # fmt: skip
_UNWRAP = (
    "max_stretch", "stretch", "max_charts", "max_extent", "flatten", "iterations", "hard_edges",
    "keep_seams", "split_materials",
)  # fmt: skip
_OTHERS = (
    "resolution", "aspect", "wrap", "export", "padding", "pages", "udim", "method", "progress",
    "on_interrupt",
)  # fmt: skip
_FLAGS = ("no_inner", "all_sides", "check", "udim", "keep_seams", "split_materials")


def refuse_unknown(call: str, options: Mapping[str, Any], known: tuple[str, ...]) -> None:
    for name in options:
        if name not in known:
            raise TypeError(f"{call}() got an unexpected keyword argument '{name}'")
        if name in _FLAGS and not isinstance(options[name], bool):
            raise UsageError(f"{name}={options[name]!r}: not a truth value; give True or False")


def known_options(call: str) -> tuple[str, ...]:
    return _PLAIN + _OTHERS + (_UNWRAP if call == "unwrap" else ())


def width_and_height(resolution: object) -> tuple[object, object, bool]:
    """Texels, and whether both were given. The numbers are checked where they are set."""
    if isinstance(resolution, str):
        found = re.fullmatch(r"(\d+)(?:x(\d+))?", resolution)
        if not found:
            raise UsageError(
                f"resolution={resolution!r}: not a size in texels; give N, (W, H) or 'WxH'"
            )
        width, height = int(found[1]), int(found[2] or found[1])
        return width, height, found[2] is not None
    if isinstance(resolution, (tuple, list)):
        if len(resolution) != 2:
            raise UsageError(
                f"resolution={resolution!r}: not a size in texels; give N, (W, H) or 'WxH'"
            )
        return resolution[0], resolution[1], True
    return resolution, resolution, False


def set_size(settings: Any, resolution: object) -> bool:
    """Sets width and height; says whether both were given."""
    width, height, both = width_and_height(resolution)
    try:
        settings.width, settings.height = width, height
    except UsageError as error:
        text = re.sub(r"^(width|height)=.*?: ", f"resolution={resolution!r}: ", str(error))
        raise UsageError(text) from None
    return both


def pack_settings(options: Mapping[str, Any]) -> _core.PackSettings:
    """Refuses what contradicts itself and what would be ignored, as the command does."""
    settings = _core.PackSettings()
    settings.method = options.get("method", "guided")
    both = set_size(settings, options.get("resolution", 1024))
    for name in _PLAIN:
        if name in options:
            setattr(settings, name, options[name])
    if options.get("aspect") is not None:
        if both:
            raise UsageError(
                f"aspect={options['aspect']!r}: resolution of two sides already gives the shape; "
                "leave out aspect, or give resolution=N"
            )
        settings.set_aspect(str(options["aspect"]))
    udim = options.get("udim", False)
    settings.wrap = options.get("wrap", "uv" if settings.can_wrap and not udim else "none")
    if "padding" in options:
        settings.padding = options["padding"]
    else:
        settings.set_default_padding()
    if "pages" in options:
        settings.pages = options["pages"]
    elif "density" in options:
        settings.use_pages_as_needed()
    if settings.method == "lprm02":
        settings.rotations = 1
        if "rotations" in options:
            warnings.warn("lprm02 has one orientation a chart, whatever rotations says", stacklevel=4)
    settings.cut = choice("export", options.get("export", "continuous"), "continuous", "cut")
    _refuse_useless(settings, options)
    return settings


def choice(name: str, value: object, no: str, yes: str) -> bool:
    if value not in (no, yes):
        raise UsageError(f"{name}={value!r}: no such choice; give {no} or {yes}")
    return value == yes


def _refuse_useless(settings: _core.PackSettings, options: Mapping[str, Any]) -> None:
    wrap, method = settings.wrap, settings.method
    for name in options:
        readers = _core.readers_of(name.rstrip("_").replace("_", "-"))
        if method not in readers:
            raise UsageError(
                f"{name}={options[name]!r}: {method} has no use for it; leave it out, or use "
                f"method={readers[0]}"
            )
    if wrap != "none" and not settings.can_wrap:
        raise UsageError(
            f"wrap={wrap!r}: {method} cannot wrap around the border; use method=guided or modulo, "
            "or wrap=none"
        )
    if options.get("udim", False) and wrap != "none":
        raise UsageError(
            f"wrap={wrap!r}: a chart must not cross the border of a UDIM tile; leave it out, or udim"
        )
    if "margin" in options and wrap == "uv":
        raise UsageError(
            f"margin={options['margin']!r}: both axes wrap, so there are no sides to keep away "
            "from; leave it out, or give wrap=u, v or none"
        )
    if options.get("moves", 0) and "time" in options:
        raise UsageError("time: moves counts instead; give one of them")
    if options.get("moves", 0) and settings.pages != 1:
        raise UsageError(
            "moves: pages are filled by best fit, which counts no moves; leave it out, or give time"
        )


def unwrap_settings(
    options: Mapping[str, Any], packing: _core.PackSettings
) -> _core.UnwrapSettings:
    settings = _core.UnwrapSettings()
    settings.set_default_extent(packing)
    for name in _UNWRAP:
        if name in options and options[name] is not None:
            setattr(settings, name, options[name])
    return settings


def keep_best(options: Mapping[str, Any]) -> bool:
    return choice("on_interrupt", options.get("on_interrupt", "raise"), "raise", "best")


def set_given(settings: Any, given: Mapping[str, Any]) -> None:
    """Sets those that are not None."""
    for name, value in given.items():
        if value is not None:
            setattr(settings, name, value)
