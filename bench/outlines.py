"""What the generators of charts share: areas, ear clipping, laying apart, writing an OBJ."""

import math
import pathlib
import sys


def signed_area(polygon):
    """Positive if counter-clockwise."""
    return sum(a[0] * b[1] - a[1] * b[0]
               for a, b in zip(polygon, polygon[1:] + polygon[:1])) / 2


def turned(points, angle):
    c, s = math.cos(angle), math.sin(angle)
    return [(c * x - s * y, s * x + c * y) for x, y in points]


def cross(a, b, c):
    """Twice the signed area of the triangle: positive where a, b, c turn left."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def triangulate(polygon):
    """Ear clipping of a simple counter-clockwise polygon: triples of indices. Cubic at worst.

    Of all ears the one with the largest smallest angle is cut: slivers would make the areas of
    triangles, and with them the checks, depend on rounding.
    """
    left, triangles = list(range(len(polygon))), []
    quality = {}

    def ear(k):
        i, j, l = left[k - 1], left[k], left[(k + 1) % len(left)]
        if (i, j, l) not in quality:
            quality[i, j, l] = ear_quality(polygon, left, i, j, l)
        # An ear stays one when others are cut: that only removes corners that could be inside.
        return quality[i, j, l]

    while len(left) > 3:
        best = max(range(len(left)), key=ear)
        if ear(best) <= 0:
            raise ValueError("no ear: the polygon is not simple, or not counter-clockwise")
        triangles.append((left[best - 1], left[best], left[(best + 1) % len(left)]))
        del left[best]
        # What was no ear because of a corner within it may have become one.
        quality = {key: value for key, value in quality.items() if value > 0}
    return triangles + [tuple(left)]


def ear_quality(polygon, left, i, j, l):
    """0 where the corner is no ear, else its area by the square of its longest side."""
    a, b, c = polygon[i], polygon[j], polygon[l]
    area = cross(a, b, c)
    if area <= 0:
        return 0
    for k in left:
        p = polygon[k]
        if (k not in (i, j, l) and cross(a, b, p) >= 0 and cross(b, c, p) >= 0
                and cross(c, a, p) >= 0):
            return 0
    return area / max(math.dist(a, b), math.dist(b, c), math.dist(c, a)) ** 2


def laid_apart(charts, gap):
    """The charts, lists of points, in rows that make about a square; `gap` is between them."""
    boxes = [(min(x for x, _ in c), min(y for _, y in c), max(x for x, _ in c),
              max(y for _, y in c)) for c in charts]
    sizes = [(right - left + gap, top - bottom + gap) for left, bottom, right, top in boxes]
    width = max(max(w for w, _ in sizes), math.sqrt(sum(w * h for w, h in sizes)))
    placed, x, y, height = [None] * len(charts), 0.0, 0.0, 0.0
    for i in sorted(range(len(charts)), key=lambda i: (-sizes[i][1], i)):
        if x + sizes[i][0] > width and x > 0:
            x, y, height = 0.0, y + height, 0.0
        dx, dy = x - boxes[i][0], y - boxes[i][1]
        placed[i] = [(px + dx, py + dy) for px, py in charts[i]]
        x, height = x + sizes[i][0], max(height, sizes[i][1])
    return placed


def obj(charts, triangles, comment, digits=9):
    """The text of an OBJ with positions (u, v, 0); one list of points and of triples per chart."""
    lines, first = [f"# {comment}"], 1
    for points, faces in zip(charts, triangles):
        for u, v in points:
            lines.append(f"v {u:.{digits}g} {v:.{digits}g} 0\nvt {u:.{digits}g} {v:.{digits}g}")
        for a, b, c in faces:
            a, b, c = a + first, b + first, c + first
            lines.append(f"f {a}/{a} {b}/{b} {c}/{c}")
        first += len(points)
    return "\n".join(lines) + "\n"


def add_output(parser):
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True, help="OBJ to write")


def write(options, text):
    try:
        options.output.write_text(text)
    except OSError as error:
        sys.exit(f"{pathlib.Path(sys.argv[0]).name}: {error}")
