"""What callers pass as arrays, as the library reads them: without a copy where that can be."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._errors import InputError, UsageError

__all__ = ["floats", "indices", "pixels", "rows", "triangles"]


def _array(name: str, value: npt.ArrayLike) -> npt.NDArray[Any]:
    if np.ma.is_masked(value):
        raise UsageError(f"{name}: some of it is masked; fill it, or leave those rows out")
    try:
        array = np.asarray(value)
    except ValueError:  # rows of unequal lengths
        raise UsageError(f"{name}: its rows differ in length; pass an array of numbers") from None
    return array


def _refuse(name: str, array: npt.NDArray[Any], wanted: str) -> UsageError:
    return UsageError(f"{name}: its dtype is {array.dtype}; pass {wanted}")


def _readable(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """In the machine's order of bytes, and on whole items."""
    native = array.astype(array.dtype.newbyteorder("="), copy=False)
    whole = all(stride % native.itemsize == 0 for stride in native.strides)
    return native if whole and native.flags.aligned else native.copy()


def floats(name: str, value: npt.ArrayLike) -> npt.NDArray[Any]:
    """float32 or float64 as they are; other real numbers as float64."""
    array = _array(name, value)
    if array.size == 0 and array.ndim < 2:
        raise InputError(f"{name}: it is empty; pass at least one row")
    if array.dtype.kind not in "fiu":
        raise _refuse(name, array, "float32 or float64")
    if array.dtype.kind != "f" or array.dtype.itemsize not in (4, 8):
        array = array.astype(np.float64)
    return _readable(array)


def indices(name: str, value: npt.ArrayLike) -> npt.NDArray[Any]:
    """Integers; floats that are whole numbers, as some readers make them, as int64."""
    array = _array(name, value)
    if array.size == 0 and array.ndim < 2:
        raise InputError(f"{name}: there are no faces; pass at least one")
    if array.dtype.kind == "f" and bool(np.all(array == np.floor(array))):
        with np.errstate(invalid="ignore"):
            whole = array.astype(np.int64)
        if not bool(np.all(whole == array)):
            raise InputError(f"{name}: an index is infinite or too large; pass indices of vertices")
        array = whole
    if array.dtype.kind not in "iu":
        raise _refuse(name, array, "integers")
    if array.dtype.itemsize not in (4, 8):
        array = array.astype(np.int64)
    return _readable(array)


def rows(
    name: str, value: npt.ArrayLike, columns: int, count: int | None = None
) -> npt.NDArray[Any]:
    """(N, columns) finite floats; N as many as `count` positions, if that is given."""
    array = floats(name, value)
    if array.ndim != 2 or array.shape[1] != columns:
        raise UsageError(f"{name}: its shape is {array.shape}; pass (N, {columns})")
    if count is not None and len(array) != count:
        raise UsageError(f"{name}: there are {len(array)} for {count} positions; pass one for each")
    if not np.isfinite(array).all():
        bad = int(np.argwhere(~np.isfinite(array))[0, 0])
        raise InputError(f"{name}[{bad}]: NaN or infinite; pass finite numbers")
    return array


def triangles(name: str, value: npt.ArrayLike, count: int) -> npt.NDArray[Any]:
    """(F, 3) indices of `count` vertices."""
    array = indices(name, value)
    if array.ndim != 2 or array.shape[1] != 3:
        raise UsageError(f"{name}: its shape is {array.shape}; pass (F, 3): triangles")
    if array.size and (array.min() < 0 or array.max() >= count):
        face = int(np.argwhere((array < 0) | (array >= count))[0, 0])
        raise InputError(
            f"{name}[{face}]: {array[face].tolist()} is out of range; there are {count} vertices, "
            "numbered from 0"
        )
    return array


def pixels(name: str, value: npt.ArrayLike) -> npt.NDArray[Any]:
    """uint8, uint16, float32 or float64; bool as black and white."""
    array = _array(name, value)
    if array.dtype == np.bool_:
        array = array.astype(np.float32)
    if array.dtype.kind == "f" and array.dtype.itemsize not in (4, 8):
        array = array.astype(np.float32)
    if array.dtype not in (np.uint8, np.uint16, np.float32, np.float64):
        raise _refuse(name, array, "uint8, uint16, or floats from 0 to 1")
    return _readable(array)
