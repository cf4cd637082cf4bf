#!/usr/bin/env python3
"""Makes a jigsaw: charts that fill the torus, or the square, without a gap. Packed perfectly they
would cover 100 % of it (with no padding), at as many texels per UV unit as the atlas has a side.

The unit torus is cut into the Voronoi cells of random points, and every border between two cells
is bent, on both sides alike. Cell i is the fan of the triangles (its point, one of its borders), so
the two triangles at a border belong to it alone; a bent border is a graph over the straight one
that stays within the two, and therefore meets no other border and not itself. Pieces are then
turned at random and laid apart. Same options, same bytes.
"""

import argparse
import math
import random

import outlines

SIDES = ((-1, 0), (1, 0), (0, -1), (0, 1))  # outward normals of the square that is not wrapped
POINTS_PER_CELL = 12  # corners of a bent border that is as long as a cell is wide


def random_points(count, rng):
    return [(rng.random(), rng.random()) for _ in range(count)]


def clipped(cell, normal, offset, label):
    """The part of a convex cell where normal . p <= offset; the new side gets `label`.

    A cell is a list of (corner, label of the side that begins there).
    """
    depth = [p[0] * normal[0] + p[1] * normal[1] - offset for p, _ in cell]
    result = []
    for k, (p, side) in enumerate(cell):
        (q, _), here, there = cell[(k + 1) % len(cell)], depth[k], depth[(k + 1) % len(cell)]
        if here <= 0:
            result.append((p, side))
        if (here <= 0) != (there <= 0):
            t = here / (here - there)
            cut = (p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]))
            result.append((cut, label if here <= 0 else side))
    return result


def voronoi_cell(points, i, wrap):
    """Cell i, with sides labelled (j, x, y): point j moved by (x, y); or (-1 - side, 0, 0)."""
    own = points[i]
    if wrap:  # no cell reaches further than half way to its own images
        box = [(own[0] + x, own[1] + y) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        images = [(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1)]
    else:
        box, images = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)], [(0, 0)]
    others = [(j, x, y) for j in range(len(points)) for x, y in images if (j, x, y) != (i, 0, 0)]
    others.sort(key=lambda o: math.dist(own, moved(points[o[0]], o[1:])))
    cell = [(corner, (-1 - side, 0, 0)) for corner, side in zip(box, (2, 1, 3, 0))]
    reach = 2 * max(math.dist(own, corner) for corner in box)
    for other in others:
        q = moved(points[other[0]], other[1:])
        if math.dist(own, q) > reach:
            break
        normal = (q[0] - own[0], q[1] - own[1])
        offset = (q[0] ** 2 + q[1] ** 2 - own[0] ** 2 - own[1] ** 2) / 2
        cell = clipped(cell, normal, offset, other)
        reach = 2 * max(math.dist(own, corner) for corner, _ in cell)
    return cell


def moved(point, by):
    return point[0] + by[0], point[1] + by[1]


def centroid(polygon):
    area, x, y = outlines.signed_area(polygon), 0.0, 0.0
    for a, b in zip(polygon, polygon[1:] + polygon[:1]):
        weight = (a[0] * b[1] - a[1] * b[0]) / (6 * area)
        x, y = x + weight * (a[0] + b[0]), y + weight * (a[1] + b[1])
    return x, y


def relaxed(points, wrap):
    """Each point in the middle of its cell (Lloyd): evens out the sizes, removes splinters."""
    middles = [centroid([corner for corner, _ in voronoi_cell(points, i, wrap)])
               for i in range(len(points))]
    return [(x % 1.0, y % 1.0) for x, y in middles] if wrap else middles


def meeting_point(members):
    """A name for the corner at which cells (and sides) meet, whichever cell it is seen from.

    Also gives what it has to be moved by to be seen from the cell that asks.
    """
    return min((tuple(sorted((j, x - ox, y - oy) if j >= 0 else (j, 0, 0)
                             for j, x, y in members)), (ox, oy))
               for j, ox, oy in members if j >= 0)


def bend(a, b, left, right, spacing, roughness, rng):
    """The points between a and b of a border that stays between the points of the two cells."""
    length = math.dist(a, b)
    along = ((b[0] - a[0]) / length, (b[1] - a[1]) / length)
    up = (-along[1], along[0])
    apexes = [((p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1],
               abs((p[0] - a[0]) * up[0] + (p[1] - a[1]) * up[1])) for p in (left, right)]
    waves = [(rng.uniform(0.4, 1), rng.uniform(0.5, 2.5) * length / (POINTS_PER_CELL * spacing),
              rng.uniform(0, 2 * math.pi)) for _ in range(4)]
    steps, points = max(2, round(length / spacing)), []
    for k in range(1, steps):
        s = length * k / steps
        wave = sum(h * math.sin(2 * math.pi * f * k / steps + phase) for h, f, phase in waves)
        wave = roughness * math.tanh(wave)  # within (-1, 1)
        foot, height = apexes[0] if wave > 0 else apexes[1]
        room = height * min(s / foot if foot > 0 else math.inf,
                            (length - s) / (length - foot) if foot < length else math.inf)
        points.append((a[0] + s * along[0] + wave * room * up[0],
                       a[1] + s * along[1] + wave * room * up[1]))
    return points


class Borders:
    """Corners and bent borders, made when a cell first asks; its neighbours get the same."""

    def __init__(self, points, roughness, rng):
        self.points, self.roughness, self.rng = points, roughness, rng
        self.spacing = 1 / (POINTS_PER_CELL * math.sqrt(len(points)))
        self.corners, self.bends = {}, {}

    def corner(self, members, seen_at):
        name, by = meeting_point(members)
        if name not in self.corners:
            self.corners[name] = (seen_at[0] - by[0], seen_at[1] - by[1])
        return moved(self.corners[name], by)

    def between(self, i, other, a, b):
        """The border of cell i with `other` from a to b, without its ends."""
        j, x, y = other
        if j < 0:
            return []
        if (j, x, y) < (i, -x, -y):  # as seen from the other side
            back = self.between(j, (i, -x, -y), moved(b, (-x, -y)), moved(a, (-x, -y)))
            return [moved(p, (x, y)) for p in reversed(back)]
        if (i, other) not in self.bends:  # cells are counter-clockwise: i lies to the left
            self.bends[i, other] = bend(a, b, self.points[i], moved(self.points[j], (x, y)),
                                        self.spacing, self.roughness, self.rng)
        return self.bends[i, other]


def cut(pieces, seed=0, wrap=True, roughness=0.3, relaxations=2):
    """The pieces where they belong: counter-clockwise polygons that cover the unit torus
    (their corners may lie outside [0, 1]) or the unit square."""
    rng = random.Random(f"jigsaw {pieces} {seed} {wrap}")
    points = random_points(pieces, rng)
    for _ in range(relaxations):
        points = relaxed(points, wrap)
    borders, polygons = Borders(points, roughness, rng), []
    for i in range(pieces):
        cell = voronoi_cell(points, i, wrap)
        corners = [borders.corner([(i, 0, 0), cell[k - 1][1], side], corner)
                   for k, (corner, side) in enumerate(cell)]
        polygon = []
        for k, (_, side) in enumerate(cell):
            a, b = corners[k], corners[(k + 1) % len(cell)]
            polygon += [a, *borders.between(i, side, a, b)]
        polygons.append(polygon)
    return polygons


def shuffled(polygons, seed=0):
    """Turned at random and laid apart."""
    rng = random.Random(f"shuffle {seed}")
    return outlines.laid_apart([outlines.turned(p, rng.uniform(0, 2 * math.pi)) for p in polygons],
                               0.2 / math.sqrt(len(polygons)))


def jigsaw(pieces, seed=0, wrap=True, roughness=0.3):
    """The text of an OBJ with one chart per piece."""
    charts = shuffled(cut(pieces, seed, wrap, roughness), seed)
    domain = "torus" if wrap else "square"
    return outlines.obj(charts, [outlines.triangulate(chart) for chart in charts],
                        f"jigsaw of the {domain}: {pieces} pieces, seed {seed}, "
                        f"roughness {roughness:g}; fills 1 x 1 UV units")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pieces", type=int, default=30, help="2 or more; default 30")
    parser.add_argument("--seed", type=int, default=0, help="another number, another jigsaw")
    parser.add_argument("--no-wrap", action="store_true", help="cut the square, not the torus")
    parser.add_argument("--roughness", type=float, default=0.3, help="how far borders bend, in "
                        "parts of the room they have: 0 (straight) to 0.9; default 0.3")
    outlines.add_output(parser)
    options = parser.parse_args()
    if options.pieces < 2 or not 0 <= options.roughness <= 0.9:
        parser.error("--pieces has to be 2 or more, --roughness between 0 and 0.9")
    return options


def main():
    options = arguments()
    text = jigsaw(options.pieces, options.seed, not options.no_wrap, options.roughness)
    outlines.write(options, text)


if __name__ == "__main__":
    main()
