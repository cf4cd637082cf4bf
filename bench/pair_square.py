"""The smallest square around two charts that do not overlap. Needs numpy and scipy.

They are put together in every way: all relative angles, all translations at which they touch, all
rotations of the two. An estimate, to about a hundredth: charts are drawn on a grid.
"""

import numpy
from scipy.signal import fftconvolve
from scipy.spatial import ConvexHull

FINE = 3  # samples per cell and axis
ANGLES = 120  # of one chart against the other
TURNS = 96  # rotations of a pair; a multiple of four


class Shape:
    """A chart as points: samples of its inside, and its hull. Lengths in cells."""

    def __init__(self, triangles, cell):
        triangles = numpy.array(triangles) / cell
        self.samples = numpy.concatenate([inside(t) for t in triangles])
        corners = triangles.reshape(-1, 2)
        self.hull = corners[ConvexHull(corners).vertices]

    def drawn(self, angle):
        """Cells covered by half at least, as an array, and the place of its first cell."""
        samples = self.samples @ rotation(angle)
        first = numpy.floor(samples.min(axis=0)).astype(int)
        cells = numpy.floor(samples).astype(int) - first
        width, height = cells.max(axis=0) + 1
        counts = numpy.bincount(cells[:, 1] * width + cells[:, 0], minlength=width * height)
        return (2 * counts >= FINE * FINE).reshape(height, width).astype(float), first

    def extents(self, angle, directions):
        return (self.hull @ rotation(angle) @ directions.T).max(axis=0)


def rotation(angle):
    """For points as rows."""
    c, s = numpy.cos(angle), numpy.sin(angle)
    return numpy.array([[c, s], [-s, c]])


def inside(triangle):
    """The points of a grid, FINE to a cell, that lie in the triangle."""
    lo, hi = numpy.floor(FINE * triangle.min(axis=0)), numpy.ceil(FINE * triangle.max(axis=0))
    x, y = numpy.meshgrid(numpy.arange(lo[0], hi[0]) + 0.5, numpy.arange(lo[1], hi[1]) + 0.5)
    points = numpy.stack([x.ravel(), y.ravel()], axis=1) / FINE
    sides = []
    for a, b in zip(triangle, numpy.roll(triangle, -1, axis=0)):
        along, to = b - a, points - a
        sides.append(along[0] * to[:, 1] - along[1] * to[:, 0])
    sides = numpy.array(sides)
    return points[(sides >= 0).all(axis=0) | (sides <= 0).all(axis=0)]


def contacts(a, b):
    """Translations of `b` at which it does not lie on `a` but would, a cell further."""
    free = fftconvolve(a, b[::-1, ::-1]) < 0.5
    padded = numpy.pad(free, 1, constant_values=True)
    beside = padded[:-2, 1:-1] & padded[2:, 1:-1] & padded[1:-1, :-2] & padded[1:-1, 2:]
    y, x = numpy.nonzero(free & ~beside)
    return numpy.stack([x - (b.shape[1] - 1), y - (b.shape[0] - 1)], axis=1)


def smallest_square(chart_a, chart_b, cell):
    """Its side. `chart_a`, `chart_b`: their triangles; `cell`: side of a cell of the grid."""
    a, b = Shape(chart_a, cell), Shape(chart_b, cell)
    turns = 2 * numpy.pi * numpy.arange(TURNS) / TURNS
    directions = numpy.stack([numpy.cos(turns), numpy.sin(turns)], axis=1)
    cells_a, first_a = a.drawn(0)
    of_a, least = a.extents(0, directions), numpy.inf
    for k in range(ANGLES):
        angle = 2 * numpy.pi * k / ANGLES
        cells_b, first_b = b.drawn(angle)
        shifts = contacts(cells_a, cells_b) + first_a - first_b
        reach = numpy.maximum(of_a, b.extents(angle, directions) + shifts @ directions.T)
        across = reach + numpy.roll(reach, TURNS // 2, axis=1)
        least = min(least, numpy.maximum(across, numpy.roll(across, TURNS // 4, axis=1)).min())
    return least * cell
