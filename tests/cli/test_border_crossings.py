"""bench/border_crossings.py against exact arithmetic on every pair. Without numpy, no test."""

import fractions
import importlib.util
import itertools
import math
import pathlib
import random
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench"))
HAS_NUMPY = importlib.util.find_spec("numpy") is not None
if HAS_NUMPY:
    import border_crossings
    import numpy


def side(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def meet(a, b, c, d):
    """Do the segments ab and cd have a point in common?"""
    boxes = all(max(min(a[k], b[k]), min(c[k], d[k])) <= min(max(a[k], b[k]), max(c[k], d[k]))
                for k in (0, 1))
    return (boxes and side(a, b, c) * side(a, b, d) <= 0 and side(c, d, a) * side(c, d, b) <= 0)


def polygons():
    """Corners of closed polygons: scattered, on a small grid, of edges of very unequal length."""
    numbers = random.Random(7)
    for trial in range(60):
        count = numbers.randint(4, 40)
        if trial % 3 == 0:
            yield [(numbers.random(), numbers.random()) for _ in range(count)]
        elif trial % 3 == 1:
            yield [(float(numbers.randrange(6)), float(numbers.randrange(6))) for _ in range(count)]
        else:
            steps = [(numbers.gauss(0, 1) * 10.0 ** numbers.randint(-3, 1),
                      numbers.gauss(0, 1)) for _ in range(count)]
            yield list(zip(*(itertools.accumulate(axis) for axis in zip(*steps))))


@unittest.skipUnless(HAS_NUMPY, "numpy is not there")
class BorderCrossings(unittest.TestCase):
    def test_pairs_that_meet(self):
        for corners in polygons():
            begin = numpy.float32(corners).astype(float)
            here = numpy.arange(len(begin))
            names = numpy.stack([here, (here + 1) % len(begin)])
            chart = (here > len(begin) // 2).astype(int)
            a, b, depth = border_crossings.crossings(begin, begin[names[1]], chart, names)
            exact = [tuple(map(fractions.Fraction, point)) for point in begin.tolist()]
            ends = [(k, (k + 1) % len(exact)) for k in range(len(exact))]
            expected = {(i, j) for i, j in itertools.combinations(range(len(exact)), 2)
                        if chart[i] == chart[j] and not set(ends[i]) & set(ends[j])
                        and meet(*(exact[k] for k in ends[i] + ends[j]))}
            found = zip(numpy.minimum(a, b).tolist(), numpy.maximum(a, b).tolist())
            self.assertEqual(sorted(found), sorted(expected))
            self.assertTrue((depth >= 0).all())

    def test_depth(self):
        begin = numpy.array([(0, 0), (5, -3), (9, -1)], dtype=float)
        end = numpy.array([(10, 0), (5, 0.25), (9, 0)], dtype=float)
        names = numpy.arange(6).reshape(2, 3)
        a, b, depth = border_crossings.crossings(begin, end, numpy.zeros(3, dtype=int), names)
        self.assertEqual({tuple(sorted(pair)): d for *pair, d in zip(a, b, depth)},
                         {(0, 1): 0.25, (0, 2): 0.0})

    def test_windings(self):
        twice = numpy.array([(math.cos(k * 0.4 * math.pi), math.sin(k * 0.4 * math.pi))
                             for k in (0, 2, 4, 6, 8)])  # a star
        points = numpy.array([(0, 0), (0.9, 0), (2, 0), (-0.9, 0)], dtype=float)
        after = numpy.roll(twice, -1, axis=0)
        self.assertEqual(border_crossings.windings(points, twice, after).tolist(), [2, 1, 0, 0])
        self.assertEqual(border_crossings.windings(points, after, twice).tolist(), [-2, -1, 0, 0])


if __name__ == "__main__":
    unittest.main()
