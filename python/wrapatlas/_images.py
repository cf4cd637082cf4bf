"""Pictures: arrays that notebooks show."""

from __future__ import annotations

import os
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import pixels
from ._errors import UsageError

__all__ = ["Picture", "load_image", "save_image"]


class Picture(np.ndarray[Any, Any]):
    """An array of pixels, (height, width, channels), that a notebook shows as a picture.

    A numpy.ndarray in all else. uint8 if it was drawn, float32 from 0 to 1 if it was baked or
    moved.
    """

    def _repr_png_(self) -> bytes | None:
        if self.ndim not in (2, 3) or 0 in self.shape:
            return None
        try:
            return _core.encode_png(pixels("image", self), 8)
        except UsageError:  # of a type or a number of channels that no picture has
            return None

    def save(self, path: str | os.PathLike[str], bits: int = 8) -> None:
        """Writes it as PNG, with 8 or 16 `bits` a value. OSError if that cannot be done."""
        save_image(path, self, bits)


def as_picture(array: npt.NDArray[Any]) -> Picture:
    return cast(Picture, array.view(Picture))


def save_image(path: str | os.PathLike[str], image: npt.ArrayLike, bits: int = 8) -> None:
    """Writes pixels as PNG.

    path: ends in .png.
    image: (height, width) or (height, width, channels), 1 to 4 channels; uint8, uint16, or floats
        of which 0 to 1 is black to white.
    bits: of each value, 8 or 16.
    """
    _core.save_image(os.fspath(path), pixels("image", image), bits)


def load_image(path: str | os.PathLike[str]) -> Picture:
    """Reads a PNG or JPEG file: (height, width, channels) float32, 0 to 1, as it is in the file."""
    with open(path, "rb"):  # for the system's own error
        pass
    return as_picture(_core.load_image(os.fspath(path)))
