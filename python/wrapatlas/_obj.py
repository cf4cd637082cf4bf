"""OBJ files of plain arrays."""

from __future__ import annotations

import os
import tempfile
from typing import Any

import numpy as np
import numpy.typing as npt

from ._arrays import floats
from ._arrays import indices as read_indices
from ._errors import UsageError

__all__ = ["export"]


def export(
    path: str | os.PathLike[str],
    positions: npt.ArrayLike,
    indices: npt.ArrayLike | None = None,
    uvs: npt.ArrayLike | None = None,
    normals: npt.ArrayLike | None = None,
) -> None:
    """Writes an OBJ file, as xatlas.export.

    positions: (N, 3). indices: (F, 3), or None for points alone. uvs: (N, 2). normals: (N, 3). One
    index stands for a position, its UV and its normal. The file appears at once, or not at all.

    Raises ValueError for arrays that cannot be used, OSError if the file cannot be written.
    """
    points = _rows("positions", positions, 3, None)
    text = [_lines("v", points)]
    if normals is not None:
        text.append(_lines("vn", _rows("normals", normals, 3, len(points))))
    if uvs is not None:
        text.append(_lines("vt", _rows("uvs", uvs, 2, len(points))))
    if indices is not None:
        faces = read_indices("indices", indices)
        if faces.ndim != 2 or faces.shape[1] != 3:
            raise UsageError(f"indices: its shape is {faces.shape}; pass (F, 3): triangles")
        if faces.size and (faces.min() < 0 or faces.max() >= len(points)):
            raise UsageError(f"indices: some are out of range; there are {len(points)} positions")
        corner = {
            (False, False): "%d",
            (True, False): "%d/%d",
            (False, True): "%d//%d",
            (True, True): "%d/%d/%d",
        }[uvs is not None, normals is not None]
        repeated = np.repeat(faces.astype(np.int64) + 1, corner.count("%"), axis=1)
        text.append((f"f {corner} {corner} {corner}\n" * len(faces)) % tuple(repeated.ravel()))
    _write(os.fspath(path), "".join(text))


def _rows(name: str, value: npt.ArrayLike, columns: int, count: int | None) -> npt.NDArray[Any]:
    array = floats(name, value)
    if array.ndim != 2 or array.shape[1] != columns:
        raise UsageError(f"{name}: its shape is {array.shape}; pass (N, {columns})")
    if count is not None and len(array) != count:
        raise UsageError(f"{name}: there are {len(array)} for {count} positions; pass one for each")
    return array


def _lines(keyword: str, rows: npt.NDArray[Any]) -> str:
    line = keyword + " %.9g" * rows.shape[1] + "\n"
    text: str = (line * len(rows)) % tuple(rows.ravel().tolist())
    return text


def _write(path: str, text: str) -> None:
    folder, name = os.path.split(path)
    with tempfile.NamedTemporaryFile(
        "w", encoding="ascii", dir=folder or ".", prefix=name + ".", delete=False
    ) as file:
        try:
            file.write(text)
            file.close()
            mask = os.umask(0)
            os.umask(mask)
            os.chmod(file.name, 0o666 & ~mask)  # as open() would have made it
            os.replace(file.name, path)
        except BaseException:
            os.unlink(file.name)
            raise
