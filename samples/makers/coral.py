"""Coral: branching, curled, in few charts."""

import math

from makers.flatten import as_rigid_as_possible
from makers.layout import lay_out
from makers.region import connected, mesh_region, split_chords
from makers.vectors import area_in_space, signed_area2


def branch_line(start, heading, length, bend, radii, steps=16):
    """A planar curve whose curvature goes from bend[0] to bend[1]; points with radii."""
    x, y = start
    line = []
    for i in range(steps + 1):
        t = i / steps
        line.append((x, y, radii[0] + t * (radii[1] - radii[0])))
        heading += (bend[0] + t * (bend[1] - bend[0])) * length / steps
        x += math.cos(heading) * length / steps
        y += math.sin(heading) * length / steps
    return line


def coral_branches():
    """Lines of (x, y, radius), the part of the underside each belongs to, and its box."""
    # parent, place on it (0-16), turn in degrees, length, curvature at both ends, radii, part
    plan = [
        (None, 0, 90, 4.6, (0.0, -0.25), (0.50, 0.34), 0),
        (0, 4, 58, 4.4, (-0.35, 0.10), (0.36, 0.24), 1),
        (0, 9, -56, 9.4, (0.30, -1.55), (0.34, 0.14), 2),
        (0, 16, 46, 9.4, (-0.40, 1.55), (0.32, 0.14), 0),
        (0, 16, -46, 2.9, (0.35, 0.20), (0.28, 0.20), 0),
        (1, 9, 46, 3.4, (0.1, 1.9), (0.24, 0.13), 1),
        (1, 16, -20, 5.6, (1.1, -1.9), (0.24, 0.13), 1),
        (0, 2, -78, 5.4, (0.45, -1.5), (0.30, 0.15), 2),
        (4, 16, -46, 3.6, (-0.1, -1.9), (0.20, 0.13), 0),
        (4, 16, 30, 3.4, (0.2, 1.0), (0.20, 0.14), 0),
        (3, 3, -62, 1.6, (0.3, 0.3), (0.20, 0.15), 0),
    ]
    lines = []
    for parent, place, turn, length, bend, radii, _ in plan:
        start, heading = (0.0, 0.0), math.radians(turn)
        if parent is not None:
            line = lines[parent]
            start = line[place][:2]
            a, b = line[max(0, place - 1)], line[min(16, place + 1)]
            heading += math.atan2(b[1] - a[1], b[0] - a[0])
        lines.append(branch_line(start, heading, length, bend, radii))
    reach = 1.2
    boxes = [
        (min(p[0] for p in line) - reach, min(p[1] for p in line) - reach,
         max(p[0] for p in line) + reach, max(p[1] for p in line) + reach)
        for line in lines
    ]
    return [(line, row[6], box) for line, row, box in zip(lines, plan, boxes)]


def branch_field(branches, x, y):
    """Smooth signed distance to the union of the branches, blended radius, nearest part."""
    sharpness, total, radius, nearest = 14.0, 0.0, 0.0, (1e9, 0)
    for line, part, (left, bottom, right, top) in branches:
        if not (left < x < right and bottom < y < top):
            continue
        best, best_radius = 1e9, 0.0
        for (ax, ay, ar), (bx, by, br) in zip(line, line[1:]):
            dx, dy = bx - ax, by - ay
            t = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)
            t = min(1.0, max(0.0, t))
            r = ar + t * (br - ar)
            d = math.hypot(x - ax - t * dx, y - ay - t * dy) - r
            if d < best:
                best, best_radius = d, r
        weight = math.exp(-sharpness * min(best, 40.0))
        total += weight
        radius += weight * best_radius
        nearest = min(nearest, (best, part))
    if total == 0.0:
        return 1.0, 0.0, 0
    return -math.log(total) / sharpness, radius / total, nearest[1]


def make_coral():
    branches = coral_branches()
    xs = [p[0] for line, _, _ in branches for p in line]
    ys = [p[1] for line, _, _ in branches for p in line]
    plane, triangles = mesh_region(
        lambda x, y: branch_field(branches, x, y)[0],
        (min(xs) - 0.7, min(ys) - 0.7), (max(xs) + 0.7, max(ys) + 0.7), 0.135)
    triangles, border = split_chords(plane, triangles)
    used = sorted({k for t in triangles for k in t})
    positions, top, bottom = [], {}, {}
    for k in used:
        x, y = plane[k]
        value, radius, _ = branch_field(branches, x, y)
        height = 0.0 if k in border else math.sqrt(max(0.002, -value * (2 * radius + value)))
        wave = 0.5 * math.sin(0.7 * x + 0.4) + 0.35 * math.sin(0.9 * y)
        top[k] = bottom[k] = len(positions)
        positions.append((x, y, wave + height))
        if k not in border:
            bottom[k] = len(positions)
            positions.append((x, y, wave - 0.85 * height))
    groups = [[] for _ in range(4)]
    for t in triangles:
        groups[0].append(tuple(top[k] for k in t))
        x, y = (sum(plane[k][axis] for k in t) / 3 for axis in (0, 1))
        groups[1 + branch_field(branches, x, y)[2]].append(tuple(bottom[k] for k in reversed(t)))
    faces, charts = [], []
    for number, group in enumerate(groups):
        for piece in connected(group):
            corners = sorted({k for t in piece for k in t})
            local = {k: i for i, k in enumerate(corners)}
            side = 1 if number == 0 else -1  # the underside is seen from below
            start = [(side * positions[k][0], positions[k][1]) for k in corners]
            small = [tuple(local[k] for k in t) for t in piece]
            flat = as_rigid_as_possible([positions[k] for k in corners], small, start)
            faces += [(t, len(charts), s) for t, s in zip(piece, small)]
            space = sum(area_in_space(*(positions[k] for k in t)) for t in piece)
            scale = math.sqrt(2 * space / sum(signed_area2(*(flat[k] for k in t)) for t in small))
            charts.append([(scale * x, scale * y) for x, y in flat])
    return positions, faces, lay_out(charts)
