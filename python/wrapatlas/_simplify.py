"""The same shape in fewer triangles."""

from __future__ import annotations

from typing import TYPE_CHECKING

from . import _core
from ._errors import UsageError
from ._meshes import Mesh, MeshLike, as_mesh
from ._progress import reported

if TYPE_CHECKING:
    from ._progress import ProgressLike

__all__ = ["simplify"]


def simplify(
    mesh: MeshLike, faces: int | str, *, keep_seams: bool = False, progress: ProgressLike = None
) -> Mesh:
    """Makes a mesh of fewer triangles, of the same volume; its topology stays.

    mesh: a Mesh, Packing, trimesh.Trimesh or path of a model.
    faces: triangles to end with, or a share of those that there are, as "10%". More remain where no
        edge is left that may go.
    keep_seams: keep the UVs, and their seams. Else the result has no UVs.
    progress: see pack; the stage is "simplify", its detail the triangles that are left.

    Raises UsageError and InputError (both ValueErrors), OSError for a path that cannot be read,
    KeyboardInterrupt, and wrapatlas.Error if `progress` stops it.
    """
    source = as_mesh(mesh)
    target = _target(faces, len(source.corner_position) - 2 * source.face_count)
    with reported(progress) as report:
        return Mesh(_core.simplify(source, target, keep_seams, report))


def _target(faces: int | str, triangles: int) -> int:
    wrong = UsageError(
        f"faces={faces!r}: not a number of triangles; give one from 1 to 4000000000, or a share as "
        "'10%'"
    )
    if isinstance(faces, str):
        try:
            percent = float(faces.removesuffix("%")) if faces.endswith("%") else -1
        except ValueError:
            percent = -1
        if not 0 < percent <= 100:
            raise wrong
        return max(1, round(percent / 100 * triangles))
    try:
        count = int(faces)
    except (TypeError, ValueError, OverflowError):
        raise wrong from None
    if count != faces or not 1 <= count <= 4000000000:
        raise wrong
    return count
