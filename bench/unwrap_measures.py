"""What an unwrapped mesh keeps of its promises, measured from its positions and UVs alone.

Stretch is that of Sander et al. 2001, "Texture mapping progressive meshes", with the areas of each
chart in the plane and in space made equal, so that 1 is an isometry.

UVs are 32-bit floats. What their rounding alone can do (a triangle of hardly any height turned
over, a border that crosses itself by that much) is counted apart, and its depth is given.
"""

import dataclasses

import numpy

import border_crossings
from chart_corners import Corners, not_discs, turns
from chart_triangles import Triangles

THIN_IN_SPACE = 64  # roundings: a triangle with less height in space, as texels, is thin there


@dataclasses.dataclass
class Measures:
    """Per chart where it is an array; lengths in texels unless said otherwise."""
    charts: int = 0
    l2: numpy.ndarray = None
    linf: numpy.ndarray = None
    angle: float = 0.0  # mean over the area in space of (s/t + t/s)/2 for singular values s, t
    boundary: float = 0.0  # length of seams in space, each once, over the root of the area there
    not_discs: dict = dataclasses.field(default_factory=dict)  # chart: why
    flipped: int = 0  # triangles
    collapsed: int = 0  # triangles with area in space and none in the plane
    otherwise_flipped: int = 0  # polygons with a flipped triangle if cut by another diagonal
    crossing_charts: int = 0  # whose border crosses itself beyond rounding, or covers a place twice
    crossing_depth: float = 0.0  # the largest of those
    rounding: float = 0.0  # how far a point may be off by the rounding of its UVs, twice
    thin: int = 0  # triangles of no more height than that, left out of stretch
    thin_flipped: int = 0  # those among them that are turned over
    thin_depth: float = 0.0  # the largest height of those
    touches: int = 0  # places where a border touches or crosses itself by rounding
    touch_depth: float = 0.0


def measured(mesh, width=1, height=1):
    """Measures of a mesh with UVs at all corners, on an atlas of so many texels. No face may be
    folded()."""
    scale = numpy.array([width, height], dtype=numpy.float64)
    result = Measures()
    largest = numpy.float32(numpy.abs(mesh.uvs).max())
    result.rounding = 2 * scale.max() * float(numpy.spacing(largest))
    corners = Corners(mesh, scale)
    result.charts = corners.charts
    result.not_discs = not_discs(corners)
    turned = turns(corners)
    triangles = Triangles(mesh, corners, turned)
    measure_triangles(result, triangles, corners.charts)
    measure_borders(result, corners, triangles, turned)
    result.boundary = float(seam_length(corners) / max(1e-300, triangles.area3.sum()) ** 0.5)
    return result


def measure_triangles(result, triangles, charts):
    def total(values):
        return numpy.bincount(triangles.chart, values, charts)

    scale = numpy.sqrt(total(triangles.area2) / numpy.maximum(total(triangles.area3), 1e-300))
    density = (triangles.area2.sum() / max(triangles.area3.sum(), 1e-300)) ** 0.5
    small = triangles.height3 * density < THIN_IN_SPACE * result.rounding
    thin = (triangles.height <= result.rounding) & small
    flipped = (triangles.area2 < 0) & ~thin
    collapsed = (triangles.height <= result.rounding) & ~small & ~flipped
    turned = thin & (triangles.area2 < 0)
    result.flipped, result.collapsed = int(flipped.sum()), int(collapsed.sum())
    result.otherwise_flipped = triangles.otherwise
    result.thin, result.thin_flipped = int(thin.sum()), int(turned.sum())
    result.thin_depth = triangles.height[turned].max(initial=0)

    good = ~(thin | flipped | collapsed)
    half = numpy.where(good, (triangles.a + triangles.c) / 2, 0)
    with numpy.errstate(invalid="ignore"):
        spread = numpy.sqrt((triangles.a - triangles.c) ** 2 / 4 + triangles.b ** 2)
        largest = numpy.sqrt(numpy.where(good, half + spread, 0))
    area3 = numpy.where(good, triangles.area3, 0)
    result.l2 = numpy.sqrt(total(half * area3) / numpy.maximum(total(area3), 1e-300)) * scale
    result.linf = numpy.zeros(charts)
    numpy.maximum.at(result.linf, triangles.chart, largest)
    result.linf *= scale
    broken = total(flipped | collapsed) > 0
    result.l2[broken] = result.linf[broken] = numpy.inf
    # (s/t + t/s)/2 times the area in space is (s*s + t*t)/2 times that in the plane.
    bent = half * numpy.where(good, triangles.area2, 0)
    result.angle = float(bent.sum() / max(1e-300, area3.sum()))


def measure_borders(result, corners, triangles, turned):
    border = numpy.flatnonzero(corners.border)
    chart = corners.chart[border]
    ends = numpy.stack([border, corners.next[border]])
    backwards = turned[corners.face[border]] * triangles.majority[chart] < 0
    ends[:, backwards] = ends[::-1, backwards]
    begin, end = corners.plane[ends[0]], corners.plane[ends[1]]
    one, _, depth = border_crossings.crossings(begin, end, chart, corners.place[ends])
    slight = depth <= result.rounding
    result.touches, result.touch_depth = int(slight.sum()), depth[slight].max(initial=0)
    crossed = set(chart[one[~slight]].tolist())
    # Touches alone may hide that a place is covered twice.
    for k in set(chart[one].tolist()) - crossed:
        mine = chart == k
        inside = triangles.centre[(triangles.chart == k) & (triangles.height > result.rounding)]
        if (border_crossings.windings(inside, begin[mine], end[mine]) != 1).any():
            crossed.add(k)
    result.crossing_charts = len(crossed)
    result.crossing_depth = depth.max(initial=0)


def seam_length(corners):
    """In space; edges that have one face in the whole mesh are no seams."""
    edge, edges = corners.edges(corners.point)
    seams = numpy.zeros(edges, dtype=bool)
    seams[edge[corners.border]] = True
    seams &= numpy.bincount(edge, minlength=edges) > 1
    length = numpy.zeros(edges)
    length[edge] = numpy.linalg.norm(corners.space - corners.space[corners.next], axis=1)
    return length[seams].sum()
