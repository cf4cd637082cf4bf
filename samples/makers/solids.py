"""Solids of planar faces and developable bands, with their exact unfoldings."""

import math

from makers.polygon import bridge_holes, triangulate
from makers.vectors import distance


class Solids:
    """Solids of several objects; faces are (positions, chart, points of the chart)."""

    def __init__(self):
        self.positions, self.charts, self.objects = [], [], []

    def start(self, name, material):
        self.objects.append((name, material, []))

    def face(self, corners, chart, local):
        self.objects[-1][2].append((tuple(corners), chart, tuple(local)))

    def add_points(self, points):
        self.positions += points
        return list(range(len(self.positions) - len(points), len(self.positions)))

    def strip(self, lower, upper):
        """A band of planar quads, outside to the viewer, rolled out edge by edge."""
        p = self.positions
        low, high = [(0.0, 0.0)], [(0.0, distance(p[lower[0]], p[upper[0]]))]
        for i in range(1, len(lower)):
            corner = beyond(low[-1], high[-1], distance(p[lower[i - 1]], p[lower[i]]),
                            distance(p[upper[i - 1]], p[lower[i]]))
            high.append(beyond(corner, high[-1], distance(p[lower[i]], p[upper[i]]),
                               distance(p[upper[i - 1]], p[upper[i]])))
            low.append(corner)
        for i in range(1, len(lower)):
            self.face((lower[i - 1], lower[i], upper[i], upper[i - 1]), len(self.charts),
                      (i - 1, i, len(low) + i, len(low) + i - 1))
        self.charts.append(low + high)

    def band(self, lower, upper, strips):
        """A closed band in `strips` pieces."""
        count = len(lower)
        cuts = [count * k // strips for k in range(strips + 1)]
        for a, b in zip(cuts, cuts[1:]):
            around = [i % count for i in range(a, b + 1)]
            self.strip([lower[i] for i in around], [upper[i] for i in around])

    def plate(self, name, material, loops, thickness, at, turn=0.0, strips=1):
        """A plate standing at `at`: loops[0] is its outline, the others are holes; all turn
        counter-clockwise. Up to 64 corners without holes it is one polygon above and below."""
        self.start(name, material)
        loops = [loops[0]] + [loop[::-1] for loop in loops[1:]]
        flat = [p for loop in loops for p in loop]
        rings, first = [], 0
        for loop in loops:
            rings.append(list(range(first, first + len(loop))))
            first += len(loop)
        c, s = math.cos(turn), math.sin(turn)
        below, above = (
            self.add_points([(at[0] + x, at[1] + c * y - s * z, at[2] + s * y + c * z)
                             for x, y in flat])
            for z in (0.0, thickness)
        )
        if len(loops) == 1 and len(flat) <= 64:
            pieces = [tuple(rings[0])]
        else:
            pieces = triangulate(flat, bridge_holes(flat, rings[0], rings[1:]))
        for piece in pieces:
            self.face([above[k] for k in piece], len(self.charts), piece)
        self.charts.append(flat)
        for piece in pieces:
            self.face([below[k] for k in reversed(piece)], len(self.charts), tuple(reversed(piece)))
        self.charts.append([(-x, y) for x, y in flat])
        for number, ring in enumerate(rings):
            self.band([below[k] for k in ring], [above[k] for k in ring],
                      strips if number == 0 else 1)

    def funnel(self, name, material, profile, count, at):
        """A ring solid turned around z from a closed profile of (radius, height), counter-
        clockwise; its cones roll out to circular arcs."""
        self.start(name, material)
        rings = [
            self.add_points([(at[0] + r * math.cos(2 * math.pi * i / count),
                              at[1] + r * math.sin(2 * math.pi * i / count), at[2] + z)
                             for i in range(count)])
            for r, z in profile
        ]
        for lower, upper in zip(rings, rings[1:] + rings[:1]):
            self.band(lower, upper, 1)


def beyond(a, b, from_a, from_b):
    """The point at the given distances from a and b, to the right of a -> b."""
    d = distance(a, b)
    along = (from_a ** 2 - from_b ** 2 + d * d) / (2 * d)
    aside = math.sqrt(max(0.0, from_a ** 2 - along * along))
    ux, uy = (b[0] - a[0]) / d, (b[1] - a[1]) / d
    return (a[0] + along * ux + aside * uy, a[1] + along * uy - aside * ux)
