"""Where the borders of flattened charts cross themselves.

Of a disc without flipped triangles, a border that does not cross itself is enough for a map that
covers no place twice: how often a place is covered is how often the border winds around it.
"""

import numpy

from groups import numbered, pairs_within

CHUNK = 4_000_000  # points times segments at once


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def crossings(begin, end, chart, names):
    """(segment, segment, depth) of the segments of one chart that cross or touch each other.

    `names`: of the vertex at each begin and at each end; segments that share one are neighbours and
    may touch. Depth: how far an end of one would have to move for the two not to cross, 0 for a
    touch; the unit is that of the points."""
    found = [crossing(begin, end, *not_neighbours(a, b, names))
             for a, b in near_pairs(begin, end, chart)]
    first, second, depth = (numpy.concatenate(parts) for parts in zip(*found))
    pair, count = numbered(numpy.minimum(first, second), numpy.maximum(first, second))
    one_of = numpy.zeros(count, dtype=numpy.int64)
    one_of[pair] = numpy.arange(len(pair))  # they may meet in several cells
    return first[one_of], second[one_of], depth[one_of]


def not_neighbours(a, b, names):
    apart = numpy.ones(len(a), dtype=bool)
    for one in names:
        for two in names:
            apart &= one[a] != two[b]
    return a[apart], b[apart]


def crossing(begin, end, a, b):
    p, q, r, s = begin[a], end[a], begin[b], end[b]
    along, other = q - p, s - r
    sides = numpy.stack([cross(along, r - p), cross(along, s - p),
                         cross(other, p - r), cross(other, q - r)])
    meet = (sides[0] * sides[1] <= 0) & (sides[2] * sides[3] <= 0)
    # Four zeros: on one line, where they meet only if their boxes do.
    meet &= ((numpy.minimum(p, q) <= numpy.maximum(r, s))
             & (numpy.minimum(r, s) <= numpy.maximum(p, q))).all(axis=1)
    lengths = numpy.stack([numpy.hypot(*along[meet].T)] * 2 + [numpy.hypot(*other[meet].T)] * 2)
    depth = numpy.abs(sides[:, meet]) / numpy.maximum(lengths, 1e-300)
    return a[meet], b[meet], depth.min(axis=0)


def near_pairs(begin, end, chart):
    """Pairs of segments that lie in a common cell of a grid as fine as their chart's segments."""
    length = numpy.hypot(*(end - begin).T)
    charts = chart.max(initial=-1) + 1
    mean = numpy.bincount(chart, length, charts) / numpy.maximum(numpy.bincount(chart), 1)
    cell = 1.5 * numpy.maximum(mean, 1e-300)[chart]
    pieces = numpy.maximum(1, numpy.ceil(length / cell)).astype(numpy.int64)
    segment = numpy.repeat(numpy.arange(len(begin)), pieces)
    step = numpy.arange(len(segment)) - numpy.repeat(numpy.cumsum(pieces) - pieces, pieces)
    ends = [begin[segment] + ((step + k) / pieces[segment])[:, None] * (end - begin)[segment]
            for k in (0, 1)]
    slack = 1e-6 * cell[segment][:, None]
    low = numpy.floor((numpy.minimum(*ends) - slack) / cell[segment][:, None])
    high = numpy.floor((numpy.maximum(*ends) + slack) / cell[segment][:, None])
    # A piece is no longer than a cell, so its box is in four at most: those of its corners.
    corners = [numpy.stack([x[:, 0], y[:, 1]], axis=1) for x in (low, high) for y in (low, high)]
    at, segment = numpy.concatenate(corners), numpy.tile(segment, 4)
    entry, count = numbered(segment, at[:, 0], at[:, 1])
    one_of = numpy.zeros(count, dtype=numpy.int64)
    one_of[entry] = numpy.arange(len(entry))
    segment, at = segment[one_of], at[one_of]
    for a, b in pairs_within(numbered(chart[segment], at[:, 0], at[:, 1])[0]):
        yield segment[a], segment[b]


def windings(points, begin, end):
    """How often the closed polygon of the segments winds around each of the points."""
    result = numpy.zeros(len(points), dtype=numpy.int64)
    rows = max(1, CHUNK // max(1, len(begin)))
    for k in range(0, len(points), rows):
        p = points[k:k + rows, None]
        from_above, to_above = begin[:, 1] > p[..., 1], end[:, 1] > p[..., 1]
        left = cross(end - begin, p - begin) > 0
        result[k:k + rows] = ((~from_above & to_above & left).sum(axis=1)
                              - (from_above & ~to_above & ~left).sum(axis=1))
    return result
