"""What an unwrapped mesh keeps of its promises, measured from its positions and UVs alone.

Charts are faces joined over edges at both of whose ends position and UV agree by value. Stretch is
that of Sander et al. 2001, "Texture mapping progressive meshes", with the areas of each chart in
the plane and in space made equal, so that 1 is an isometry. A polygon counts as the fan of
triangles, from one of its corners, that is best in space and in the plane.

UVs are 32-bit floats. What their rounding alone can do (a triangle of hardly any height turned over,
a border that crosses itself by that much) is counted apart, and its depth is given.
"""

import collections
import dataclasses

import numpy

import border_crossings
from groups import connected, numbered

THIN_IN_SPACE = 64  # a triangle is thin there if its height, in texels, is less than so many roundings


@dataclasses.dataclass
class Measures:
    """Per chart where it is an array; lengths in texels unless said otherwise."""
    charts: int = 0
    l2: numpy.ndarray = None
    linf: numpy.ndarray = None
    angle: float = 0.0  # mean over the area in space of (s/t + t/s)/2 for singular values: 1 conformal
    boundary: float = 0.0  # length of seams in space, each once, over the root of the area in space
    not_discs: dict = dataclasses.field(default_factory=dict)  # chart: why
    flipped: int = 0  # triangles
    collapsed: int = 0  # triangles with area in space and none in the plane
    crossing_charts: int = 0  # whose border crosses itself beyond rounding, or covers a place twice
    crossing_depth: float = 0.0  # the largest of those
    rounding: float = 0.0  # how far a point may be off by the rounding of its UVs, twice
    thin: int = 0  # triangles of no more height than that, left out of stretch
    thin_flipped: int = 0  # those among them that are turned over
    thin_depth: float = 0.0  # the largest height of those
    touches: int = 0  # places where a border touches or crosses itself by rounding
    touch_depth: float = 0.0


def measured(mesh, width=1, height=1):
    """Measures of a mesh with UVs at all corners, on an atlas of so many texels."""
    scale = numpy.array([width, height], dtype=numpy.float64)
    result = Measures()
    result.rounding = 2 * scale.max() * float(numpy.spacing(numpy.float32(numpy.abs(mesh.uvs).max())))
    corners = Corners(mesh, scale)
    result.charts = corners.charts
    result.not_discs = not_discs(corners)
    turned = turns(corners)
    triangles = Triangles(mesh, corners, turned)
    measure_triangles(result, triangles, corners.charts)
    measure_borders(result, corners, triangles, turned)
    result.boundary = seam_length(corners) / max(1e-300, triangles.area3.sum()) ** 0.5
    return result


class Corners:
    """Per corner of the mesh: what it and the edge to the next corner of its face are."""

    def __init__(self, mesh, scale):
        sizes = mesh.sizes()
        self.face = numpy.repeat(numpy.arange(len(sizes)), sizes)
        self.next = numpy.arange(len(self.face)) + 1
        self.next[mesh.begins[1:] - 1] = mesh.begins[:-1]
        self.space, self.plane = mesh.corner_positions(), mesh.uvs * scale
        self.point, _ = numbered(*self.space.T)
        self.place, _ = numbered(self.point, *mesh.uvs.T)
        self.edge, edges = self.edges(self.place)
        first_face = numpy.zeros(edges, dtype=numpy.int64)
        first_face[self.edge] = self.face
        joins = self.place != self.place[self.next]
        self.face_chart, self.charts = connected(
            len(sizes), self.face[joins], first_face[self.edge[joins]])
        self.chart = self.face_chart[self.face]
        self.edge_faces = numpy.bincount(self.edge, minlength=edges)  # per edge
        self.border = joins & (self.edge_faces[self.edge] == 1)

    def edges(self, end):
        other = end[self.next]
        return numbered(numpy.minimum(end, other), numpy.maximum(end, other))


def count_in(charts, chart, *things):
    """Per chart, how many different things it has; `chart`: of each."""
    pair, count = numbered(chart, *things)
    of_pair = numpy.zeros(count, dtype=numpy.int64)
    of_pair[pair] = chart
    return numpy.bincount(of_pair, minlength=charts)


def not_discs(corners):
    """{chart: what it is instead of a disc with one border}."""
    charts, chart = corners.charts, corners.chart
    euler = (count_in(charts, chart, corners.place) - count_in(charts, chart, corners.edge)
             + numpy.bincount(corners.face_chart, minlength=charts))
    crowded = numpy.bincount(chart, corners.edge_faces[corners.edge] > 2, charts)
    border = numpy.flatnonzero(corners.border)
    vertex, vertices = numbered(numpy.tile(chart[border], 2), numpy.concatenate(
        [corners.place[border], corners.place[corners.next[border]]]))
    begin, end = vertex[:len(border)], vertex[len(border):]
    loop, _ = connected(vertices, begin, end)
    loops = count_in(charts, chart[border], loop[begin])
    pinched = numpy.bincount(vertex, minlength=vertices)[begin] != 2
    pinches = numpy.bincount(chart[border], pinched, charts)
    found = {}
    for k in numpy.flatnonzero((euler != 1) | (crowded > 0) | (loops != 1) | (pinches > 0)):
        found[int(k)] = (f"V - E + F = {euler[k]}, border loops: {loops[k]}"
                         + (", an edge in three faces" if crowded[k] else "")
                         + (", a border that meets itself at a vertex" if pinches[k] else ""))
    return found


def turns(corners):
    """Per face 1, or -1 where it is wound against the first face of its chart."""
    inner = numpy.flatnonzero(corners.edge_faces[corners.edge] == 2)
    inner = inner[numpy.argsort(corners.edge[inner], kind="stable")].reshape(-1, 2)
    same_way = corners.place[inner[:, 0]] == corners.place[inner[:, 1]]
    turned = numpy.ones(len(corners.face_chart), dtype=numpy.int64)
    odd = numpy.isin(corners.chart[inner[:, 0]], corners.chart[inner[same_way, 0]])
    neighbours = collections.defaultdict(list)
    for (a, b), same in zip(corners.face[inner[odd]].tolist(), same_way[odd].tolist()):
        neighbours[a].append((b, -1 if same else 1))
        neighbours[b].append((a, -1 if same else 1))
    known = set()
    for start in neighbours:
        waiting = [] if start in known else [start]
        known.add(start)
        while waiting:
            face = waiting.pop()
            for other, sign in neighbours[face]:
                if other not in known:
                    known.add(other)
                    turned[other] = sign * turned[face]
                    waiting.append(other)
    return turned


def fans(mesh, plane=None):
    """Triangles, as rows of three corners, of all faces: of each face its best fan, by its places
    in space and, if given, in the plane."""
    result, sizes = [], mesh.sizes()
    for size in numpy.unique(sizes[sizes > 2]):
        first = mesh.begins[:-1][sizes == size]
        corners = first[:, None] + numpy.arange(size)
        choices = [corners[:, (numpy.arange(size) + start) % size] for start in range(size)]
        choices = choices[:1] if size == 3 else choices
        quality = numpy.stack([fan_quality(mesh, plane, choice) for choice in choices])
        best = numpy.stack(choices)[quality.argmax(axis=0), numpy.arange(len(first))]
        result += [best[:, [0, k, k + 1]] for k in range(1, size - 1)]
    return numpy.concatenate(result)


def fan_quality(mesh, plane, corners):
    """The smallest share that a triangle has of its face, in space or in the plane."""
    space = mesh.positions[mesh.corners[corners]]
    normals = numpy.cross(space[:, 1:-1] - space[:, :1], space[:, 2:] - space[:, :1])
    whole = normals.sum(axis=1, keepdims=True)
    least = shares((normals * whole).sum(axis=2))
    if plane is None:
        return least
    flat = plane[corners]
    areas = border_crossings.cross(flat[:, 1:-1] - flat[:, :1], flat[:, 2:] - flat[:, :1])
    return numpy.minimum(least, shares(areas))


def shares(parts):
    whole = parts.sum(axis=1, keepdims=True)
    return (parts / numpy.where(whole == 0, 1, whole)).min(axis=1)


class Triangles:
    """Of each triangle the areas, positive in the plane where it is wound as most of its chart, and
    its metric tensor (a, b, c) as in Sander et al. 2001."""

    def __init__(self, mesh, corners, turned):
        self.corners = fans(mesh, corners.plane)
        face = corners.face[self.corners[:, 0]]
        self.chart = corners.face_chart[face]
        q, p = corners.space[self.corners], corners.plane[self.corners]
        self.centre = p.mean(axis=1)
        u, v = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
        x, y = q[:, 1] - q[:, 0], q[:, 2] - q[:, 0]
        self.area3 = numpy.linalg.norm(numpy.cross(x, y), axis=1) / 2
        twice = border_crossings.cross(u, v)
        self.majority = numpy.where(numpy.bincount(
            self.chart, twice * turned[face], corners.charts) < 0, -1, 1)
        self.area2 = twice * turned[face] * self.majority[self.chart] / 2
        self.height = numpy.abs(twice) / longest(p)
        self.height3 = 2 * self.area3 / longest(q)
        with numpy.errstate(divide="ignore", invalid="ignore", over="ignore"):
            along = (x * v[:, 1:] - y * u[:, 1:]) / twice[:, None]
            across = (y * u[:, :1] - x * v[:, :1]) / twice[:, None]
            self.a, self.b, self.c = ((s * t).sum(axis=1) for s, t in (
                (along, along), (along, across), (across, across)))


def longest(triangles):
    sides = triangles - numpy.roll(triangles, 1, axis=1)
    return numpy.maximum(numpy.linalg.norm(sides, axis=2).max(axis=1), 1e-300)


def measure_triangles(result, triangles, charts):
    def total(values):
        return numpy.bincount(triangles.chart, values, charts)

    scale = numpy.sqrt(total(triangles.area2) / numpy.maximum(total(triangles.area3), 1e-300))
    small = triangles.height3 * scale[triangles.chart] < THIN_IN_SPACE * result.rounding
    thin = (triangles.height <= result.rounding) & small
    flipped = (triangles.area2 < 0) & ~thin
    collapsed = (triangles.height <= result.rounding) & ~small & ~flipped
    turned = thin & (triangles.area2 < 0)
    result.flipped, result.collapsed = int(flipped.sum()), int(collapsed.sum())
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
