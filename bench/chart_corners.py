"""The charts of a mesh by its UVs, and which of them are discs.

Charts are faces joined over edges at both of whose ends position and UV agree by value.
"""

import collections

import numpy

from groups import connected, numbered


def folded(mesh):
    """Per face, whether it has a position twice. Such a face can be no disc."""
    point, _ = numbered(*mesh.corner_positions().T)
    face = numpy.repeat(numpy.arange(len(mesh.sizes())), mesh.sizes())
    own, count = numbered(face, point)
    seen = numpy.bincount(own, minlength=count)[own] > 1
    return numpy.bincount(face, seen, len(mesh.sizes())) > 0


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
