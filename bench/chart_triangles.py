"""The triangles of a mesh with UVs: their areas, and how the plane is stretched onto them.

A polygon counts as the fan of triangles, from one of its corners, that is best in space and in the
plane.
"""

import numpy

from border_crossings import cross


def fans(mesh, plane=None):
    """(triangles, as rows of three corners, of all faces, of each its best fan by its places in
    space and, if given, in the plane; how many faces have a triangle turned over in the plane by
    another fan that is as good in space)."""
    result, otherwise, sizes = [numpy.zeros((0, 3), dtype=numpy.int64)], 0, mesh.sizes()
    for size in numpy.unique(sizes[sizes > 2]):
        first = mesh.begins[:-1][sizes == size]
        corners = first[:, None] + numpy.arange(size)
        choices = numpy.stack([corners[:, (numpy.arange(size) + start) % size]
                               for start in range(size if size > 3 else 1)])
        space = numpy.stack([least_share_in_space(mesh, choice) for choice in choices])
        flat = space if plane is None else numpy.stack(
            [least_share_in_plane(plane[choice]) for choice in choices])
        quality = numpy.minimum(space, flat)
        best = choices[quality.argmax(axis=0), numpy.arange(len(first))]
        result += [best[:, [0, k, k + 1]] for k in range(1, size - 1)]
        otherwise += ((quality.max(axis=0) > 0) & ((space > 0) & (flat < 0)).any(axis=0)).sum()
    return numpy.concatenate(result), int(otherwise)


def least_share_in_space(mesh, corners):
    """Of each face, given as a fan from its first corner, the part that its smallest triangle is of
    it; negative if one is wound against the whole."""
    space = mesh.positions[mesh.corners[corners]]
    normals = numpy.cross(space[:, 1:-1] - space[:, :1], space[:, 2:] - space[:, :1])
    return shares((normals * normals.sum(axis=1, keepdims=True)).sum(axis=2))


def least_share_in_plane(flat):
    return shares(cross(flat[:, 1:-1] - flat[:, :1], flat[:, 2:] - flat[:, :1]))


def shares(parts):
    whole = parts.sum(axis=1, keepdims=True)
    return (parts / numpy.where(whole == 0, 1, whole)).min(axis=1)


class Triangles:
    """Of each triangle the areas, positive in the plane where it is wound as most of its chart, and
    its metric tensor (a, b, c) as in Sander et al. 2001."""

    def __init__(self, mesh, corners, turned):
        self.corners, self.otherwise = fans(mesh, corners.plane)
        face = corners.face[self.corners[:, 0]]
        self.chart = corners.face_chart[face]
        q, p = corners.space[self.corners], corners.plane[self.corners]
        self.centre = p.mean(axis=1)
        u, v = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
        x, y = q[:, 1] - q[:, 0], q[:, 2] - q[:, 0]
        self.area3 = numpy.linalg.norm(numpy.cross(x, y), axis=1) / 2
        twice = cross(u, v)
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
