"""How far long work has come."""

from __future__ import annotations

from contextlib import contextmanager
from typing import Any, Callable, Iterator, Optional, Union

CoreProgress = Optional[Callable[[str, float, float], object]]
ProgressLike = Union[bool, None, Callable[[str, float, float], object]]

__all__ = ["ProgressLike"]

_DETAILS = {
    "unwrap": lambda detail: f"{detail:.0f} charts",
    "pack": lambda detail: f"{100 * detail:.1f} % in use",
    "simplify": lambda detail: f"{detail:.0f} triangles",
}


@contextmanager
def reported(progress: ProgressLike) -> Iterator[CoreProgress]:
    """A function for the library: the caller's, or for True one that draws bars."""
    if progress is None or progress is False:
        yield None
    elif progress is not True:
        yield progress
    else:
        bars = _Bars()
        try:
            yield bars
        finally:
            bars.close()


class _Bars:
    """A tqdm bar for each stage; without tqdm nothing is drawn."""

    def __init__(self) -> None:
        self._stage = ""
        self._bar: Any = None
        try:
            from tqdm.auto import tqdm  # type: ignore[import-untyped,unused-ignore]
        except ImportError:
            self._make: Any = None
        else:
            self._make = tqdm

    def __call__(self, stage: str, fraction: float, detail: float) -> None:
        if self._make is None:
            return
        if stage != self._stage:
            self.close()
            self._stage = stage
            self._bar = self._make(total=100, desc=stage, unit="%", leave=False)
        words = _DETAILS.get(stage)
        if words:
            self._bar.set_postfix_str(words(detail), refresh=False)
        self._bar.update(max(0, round(100 * fraction) - self._bar.n))

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
        self._bar = None
