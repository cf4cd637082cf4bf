"""Shapes as cells of a grid: the slow and obvious way, for drawings."""
from math import cos, floor, hypot, pi, sin


def inside(loops, x, y):
    odd = False
    for loop in loops:
        for (ax, ay), (bx, by) in zip(loop, loop[1:] + loop[:1]):
            if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
                odd = not odd
    return odd


def to_segment(p, a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    square = dx * dx + dy * dy
    t = 0 if square == 0 else max(0, min(1, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square))
    return hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy)


def clipped(a, b, x, y):
    """Does the segment ab enter the open cell (x, y)?"""
    low, high = 0.0, 1.0
    for start, end, edge in ((a[0], b[0], x), (a[1], b[1], y)):
        d = end - start
        if d == 0:
            if not edge < start < edge + 1:
                return False
            continue
        t0, t1 = sorted(((edge - start) / d, (edge + 1 - start) / d))
        low, high = max(low, t0), min(high, t1)
    return low < high


def to_cell(a, b, x, y):
    """Distance of a segment to a cell."""
    if clipped(a, b, x, y):
        return 0
    corners = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)]
    ends = [hypot(max(x - p[0], 0, p[0] - x - 1), max(y - p[1], 0, p[1] - y - 1)) for p in (a, b)]
    return min([to_segment(c, a, b) for c in corners] + ends)


def window(loops, room):
    points = [p for loop in loops for p in loop]
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    for y in range(floor(min(ys) - room), floor(max(ys) + room) + 1):
        for x in range(floor(min(xs) - room), floor(max(xs) + room) + 1):
            yield x, y


def centre_cells(loops):
    return {(x, y) for x, y in window(loops, 0) if inside(loops, x + 0.5, y + 0.5)}


def entered_cells(loops, growth=0.0):
    """Cells that the shape, grown by a disc, enters: `conservative` coverage."""
    edges = [e for loop in loops for e in zip(loop, loop[1:] + loop[:1])]
    near = {(x, y) for x, y in window(loops, growth + 1)
            if any(to_cell(a, b, x, y) < max(growth, 1e-12) for a, b in edges)}
    return near | centre_cells(loops)


def turned(loops, turns, centre=(0.0, 0.0)):
    c, s = cos(2 * pi * turns), sin(2 * pi * turns)
    return [[(c * (x - centre[0]) - s * (y - centre[1]) + centre[0],
              s * (x - centre[0]) + c * (y - centre[1]) + centre[1]) for x, y in loop]
            for loop in loops]


def moved(loops, dx, dy):
    return [[(x + dx, y + dy) for x, y in loop] for loop in loops]


def at_origin(cells):
    left, low = min(x for x, _ in cells), min(y for _, y in cells)
    return {(x - left, y - low) for x, y in cells}


def shifted(cells, dx, dy):
    return {(x + dx, y + dy) for x, y in cells}


def swapped(cells):
    return {(y, x) for x, y in cells}


def lanes(cells):
    """Per column its first and last cell: the two horizons."""
    spans = {}
    for x, y in cells:
        low, high = spans.get(x, (y, y))
        spans[x] = min(low, y), max(high, y)
    return spans


def hollow(cells):
    return {(x, y) for x, (low, high) in lanes(cells).items()
            for y in range(low, high + 1)} - cells


def grown_outline(loop, growth, steps=8):
    """The curve at a distance around a counter-clockwise loop (its convex corners rounded)."""
    curve = []
    for i, p in enumerate(loop):
        a, b = loop[i - 1], loop[(i + 1) % len(loop)]
        normals = []
        for s, e in ((a, p), (p, b)):
            length = hypot(e[0] - s[0], e[1] - s[1])
            normals.append(((e[1] - s[1]) / length, -(e[0] - s[0]) / length))
        (nx, ny), (mx, my) = normals
        if nx * my - ny * mx < 0:  # a reflex corner: the two offset lines meet
            k = growth / (1 + nx * mx + ny * my)
            curve.append((p[0] + k * (nx + mx), p[1] + k * (ny + my)))
            continue
        for step in range(steps + 1):
            t = step / steps
            vx, vy = nx + t * (mx - nx), ny + t * (my - ny)
            length = hypot(vx, vy)
            curve.append((p[0] + growth * vx / length, p[1] + growth * vy / length))
    return curve
