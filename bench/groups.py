"""Numbering equal things and finding connected ones, in numpy."""

import numpy


def numbered(*columns):
    """(per row a number, how many there are): rows that are equal in all columns share theirs."""
    order = numpy.lexsort(columns)
    starts = numpy.zeros(len(order), dtype=bool)
    for column in columns:
        in_order = column[order]
        starts[1:] |= in_order[1:] != in_order[:-1]
    number = numpy.empty(len(order), dtype=numpy.int64)
    number[order] = numpy.cumsum(starts)
    return number, int(starts.sum()) + (len(order) > 0)


def connected(count, a, b):
    """Per thing the number of its set, where a[k] and b[k] are of one set, and how many sets."""
    root = numpy.arange(count)
    while len(a):
        low, high = numpy.minimum(root[a], root[b]), numpy.maximum(root[a], root[b])
        apart = low != high
        a, b, low, high = a[apart], b[apart], low[apart], high[apart]
        numpy.minimum.at(root, high, low)
        while (root[root] != root).any():
            root = root[root]
    return numbered(root)


def pairs_within(group):
    """(a, b): all pairs of rows that share their group, in pieces of some million pairs."""
    order = numpy.argsort(group, kind="stable")
    sorted_group = group[order]
    first = numpy.searchsorted(sorted_group, sorted_group)
    before = numpy.arange(len(order)) - first  # how many of its group come before it
    piece = numpy.cumsum(before) // 4_000_000
    cuts = numpy.flatnonzero(numpy.diff(piece)) + 1
    for rows in numpy.split(numpy.arange(len(order)), cuts):
        a = numpy.repeat(rows, before[rows])
        ends = numpy.cumsum(before[rows])
        step = numpy.arange(len(a)) - numpy.repeat(ends - before[rows], before[rows])
        yield order[a], order[first[a] + step]
