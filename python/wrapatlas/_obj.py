"""OBJ files of plain arrays."""

from __future__ import annotations

import contextlib
import os
import uuid
from typing import Any

import numpy as np
import numpy.typing as npt

from ._arrays import rows, triangles

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
    points = rows("positions", positions, 3)
    text = [_lines("v", points)]
    if normals is not None:
        text.append(_lines("vn", rows("normals", normals, 3, len(points))))
    if uvs is not None:
        text.append(_lines("vt", rows("uvs", uvs, 2, len(points))))
    if indices is not None:
        faces = triangles("indices", indices, len(points))
        corner = {
            (False, False): "%d",
            (True, False): "%d/%d",
            (False, True): "%d//%d",
            (True, True): "%d/%d/%d",
        }[uvs is not None, normals is not None]
        repeated = np.repeat(faces.astype(np.int64) + 1, corner.count("%"), axis=1)
        text.append((f"f {corner} {corner} {corner}\n" * len(faces)) % tuple(repeated.ravel()))
    _write(os.fspath(path), "".join(text))


def _lines(keyword: str, values: npt.NDArray[Any]) -> str:
    line = keyword + " %.9g" * values.shape[1] + "\n"
    text: str = (line * len(values)) % tuple(values.ravel().tolist())
    return text


def _write(path: str, text: str) -> None:
    beside = f"{path}.{uuid.uuid4().hex[:12]}.tmp"
    try:
        with open(beside, "x", encoding="ascii") as file:
            file.write(text)
        os.replace(beside, path)
    except BaseException:
        with contextlib.suppress(FileNotFoundError):
            os.unlink(beside)
        raise
