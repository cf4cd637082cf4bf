#!/usr/bin/env python3
"""Makes an atlas as photogrammetry has them: a few large ragged charts and very many tiny ones.

Areas are drawn from a Pareto distribution, P(area > a) = a^-EXPONENT, clipped at a = CLIP; with the
exponent of 1 every decade of sizes holds about as much area as the next. A chart is a connected
set of triangles of an irregular mesh, grown from one triangle by random neighbours, so outlines are
ragged, and large charts may have holes. A chart of area a has about a triangles, but no more than
--most-triangles (larger triangles then), so that files stay modest. Charts are stretched and turned
at random and laid apart. Same options, same bytes.
"""

import argparse
import math
import random

import outlines

EXPONENT, CLIP = 1.0, 1e4
MOST_TRIANGLES = 400
UNIT = math.sqrt(3) / 4  # area of a triangle of the lattice before it is made irregular
JITTER = 0.25  # of the lattice's edge; below sqrt(3) / 4 no triangle turns over


def neighbours(face):
    x, y, down = face
    if down:
        return (x, y, 0), (x + 1, y, 0), (x, y + 1, 0)
    return (x, y, 1), (x - 1, y, 1), (x, y - 1, 1)


def corners(face):
    """Counter-clockwise lattice points; the lattice's axes are at 60 degrees."""
    x, y, down = face
    if down:
        return (x + 1, y), (x + 1, y + 1), (x, y + 1)
    return (x, y), (x + 1, y), (x, y + 1)


def grown(count, rng):
    """A connected set of so many triangles of the lattice, in the order in which they came."""
    faces = {(0, 0, rng.randrange(2)): None}
    border = [face for start in faces for face in neighbours(start)]
    while len(faces) < count:
        k = rng.randrange(len(border))
        border[k], border[-1] = border[-1], border[k]
        face = border.pop()
        if face not in faces:
            faces[face] = None
            border += [other for other in neighbours(face) if other not in faces]
    return list(faces)


def chart(area, most_triangles, rng):
    """Points and triangles of one chart of about this area."""
    faces = grown(max(1, min(round(area), most_triangles)), rng)
    stretch, angle = math.exp(rng.gauss(0, 0.25)), rng.uniform(0, 2 * math.pi)
    size = math.sqrt(area / (len(faces) * UNIT))
    c, s = size * math.cos(angle), size * math.sin(angle)
    index, points, triangles = {}, [], []
    for face in faces:
        for x, y in corners(face):
            if (x, y) not in index:
                index[x, y] = len(points)
                turn, far = rng.uniform(0, 2 * math.pi), JITTER * math.sqrt(rng.random())
                u = (x + y / 2 + far * math.cos(turn)) * stretch
                v = (y * math.sqrt(3) / 2 + far * math.sin(turn)) / stretch
                points.append((c * u - s * v, s * u + c * v))
        triangles.append(tuple(index[corner] for corner in corners(face)))
    return points, triangles


def photogrammetry(charts, seed=0, most_triangles=MOST_TRIANGLES):
    """The text of an OBJ with so many charts."""
    rng = random.Random(f"photogrammetry {charts} {seed}")
    points, triangles = [], []
    for _ in range(charts):
        area = min(rng.paretovariate(EXPONENT), CLIP)
        own_points, own_triangles = chart(area, most_triangles, rng)
        points.append(own_points)
        triangles.append(own_triangles)
    return outlines.obj(outlines.laid_apart(points, 0.2), triangles,
                        f"{charts} charts with areas of Pareto exponent {EXPONENT:g} up to "
                        f"{CLIP:g}, seed {seed}", digits=7)


def arguments():
    parser = argparse.ArgumentParser(
        description=__doc__.replace("EXPONENT", f"{EXPONENT:g}").replace("CLIP", f"{CLIP:g}"),
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--charts", type=int, default=1000, help="default 1000")
    parser.add_argument("--seed", type=int, default=0, help="another number, another atlas")
    parser.add_argument("--most-triangles", type=int, default=MOST_TRIANGLES,
                        help=f"of one chart; default {MOST_TRIANGLES}")
    outlines.add_output(parser)
    options = parser.parse_args()
    if options.charts < 1 or options.most_triangles < 1:
        parser.error("--charts and --most-triangles have to be 1 or more")
    return options


def main():
    options = arguments()
    text = photogrammetry(options.charts, options.seed, options.most_triangles)
    outlines.write(options, text)


if __name__ == "__main__":
    main()
