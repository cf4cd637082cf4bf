"""What xatlas-python calls its options and its charts."""

from __future__ import annotations

import enum
import warnings
from dataclasses import dataclass, fields

import numpy as np
import numpy.typing as npt

DEFAULT_TIME = 1.0
BRUTE_FORCE_TIME = 5.0


@dataclass
class ChartOptions:
    """How charts are cut. Those of xatlas that mean nothing here are kept, so that code runs: a
    warning says so where they are set to other values."""

    max_chart_area: float = 0.0
    max_boundary_length: float = 0.0
    normal_deviation_weight: float = 2.0
    roundness_weight: float = 0.01
    straightness_weight: float = 6.0
    normal_seam_weight: float = 4.0
    texture_seam_weight: float = 0.5
    max_cost: float = 2.0
    max_iterations: int = 1
    use_input_mesh_uvs: bool = False
    """Pack the charts of the uvs that meshes were added with; all need them then."""
    fix_winding: bool = False
    """Nothing to do: no chart is mirrored, however its faces are wound."""
    max_stretch: float = 2.0
    """Ours: no chart is stretched more; see wrapatlas.unwrap."""
    max_charts: int = 0
    """Ours: join charts beyond max_stretch until there are no more; 0: no limit."""
    max_extent: float | None = None
    """Ours: how long charts may be; see wrapatlas.unwrap, whose default it has."""


@dataclass
class PackOptions:
    """How charts are packed."""

    max_chart_size: int = 0
    """Means nothing here: all charts have one scale."""
    padding: int = 0
    """Texels between charts."""
    texels_per_unit: float = 0.0
    """If not 0, charts keep this scale: on one atlas that is large enough, or with `resolution` on as
    many square ones of that size as it takes; NoPacking if a chart is larger than one."""
    resolution: int = 0
    """The atlas has about so many texels, squared; 0: 1024, or what texels_per_unit takes. Its shape
    is chosen, but with both given."""
    bilinear: bool = True
    """A texel more between charts, for bilinear filters."""
    blockAlign: bool = False  # noqa: N815
    """No two charts share a block of 4 x 4 texels."""
    bruteForce: bool = False  # noqa: N815
    """Search for 5 seconds, in place of `time`."""
    create_image: bool = False
    """Pictures can be drawn in any case."""
    rotate_charts_to_axis: bool = True
    rotate_charts: bool = True
    """Without one of the two, or both, charts are turned by quarters alone, to the axes of their
    boxes alone, or not at all; and packed by the method "modulo", which is less dense."""
    wrap: str = "none"
    """Ours: "uv": charts may go on over the border, which packs denser; UVs may exceed 1."""
    time: float = DEFAULT_TIME
    """Ours: seconds to search. With texels_per_unit and no resolution for each of up to 20 sizes
    that are tried."""
    threads: int = 0
    """Ours: 0: as many as the machine has."""


class ChartType(enum.IntEnum):
    """How a chart was flattened. Here all are LSCM: conformal."""

    Planar = 0
    Ortho = 1
    LSCM = 2
    Piecewise = 3
    Invalid = 4


@dataclass(frozen=True, eq=False)
class Chart:
    """A chart of one mesh."""

    faces: npt.NDArray[np.uint32]
    """Faces of the mesh."""
    atlas_index: int
    material: int
    type: ChartType = ChartType.LSCM


_IGNORED_CHART = (
    "max_chart_area", "max_boundary_length", "normal_deviation_weight", "roundness_weight",
    "straightness_weight", "normal_seam_weight", "texture_seam_weight", "max_cost",
    "max_iterations",
)  # fmt: skip


def warn_useless(how: ChartOptions, where: PackOptions) -> None:
    defaults = {field.name: field.default for field in fields(ChartOptions)}
    ignored = [name for name in _IGNORED_CHART if getattr(how, name) != defaults[name]]
    if where.max_chart_size:
        ignored.append("max_chart_size")
    if where.texels_per_unit and not (where.rotate_charts and where.rotate_charts_to_axis):
        ignored.append("rotate_charts beside texels_per_unit")
    if ignored:
        warnings.warn(
            f"wrapatlas has no use for {', '.join(ignored)}; see docs/python.md", stacklevel=3
        )
