"""Triangle meshes of planar regions, and their pieces."""

import math

from makers.vectors import distance


def mesh_region(field, low, high, step):
    """Triangles of {field < 0}: a triangular lattice, snapped to the border and cut along it."""
    rows = int((high[1] - low[1]) / (step * math.sqrt(0.75))) + 2
    columns = int((high[0] - low[0]) / step) + 2
    points, values = [], []
    for j in range(rows):
        for i in range(columns):
            x = low[0] + step * (i + 0.5 * (j % 2))
            y = low[1] + step * math.sqrt(0.75) * j
            value = field(x, y)
            if abs(value) < 0.3 * step:
                for _ in range(4):
                    e = 1e-4
                    gx = (field(x + e, y) - value) / e
                    gy = (field(x, y + e) - value) / e
                    x -= value * gx / (gx * gx + gy * gy)
                    y -= value * gy / (gx * gx + gy * gy)
                    value = field(x, y)
                value = 0.0
            points.append((x, y))
            values.append(value)
    cuts = {}

    def cut(a, b):
        key = (min(a, b), max(a, b))
        if key not in cuts:
            (p, q), (fp, fq) = (points[a], points[b]), (values[a], values[b])
            lo, hi = (p, q) if fp < 0 else (q, p)
            for _ in range(40):
                middle = ((lo[0] + hi[0]) / 2, (lo[1] + hi[1]) / 2)
                if field(*middle) < 0:
                    lo = middle
                else:
                    hi = middle
            cuts[key] = len(points)
            points.append(lo)
            values.append(0.0)
        return cuts[key]

    triangles = []
    for j in range(rows - 1):
        for i in range(columns - 1):
            a, b = j * columns + i, j * columns + i + 1
            c, d = a + columns, b + columns
            cell = [(a, b, c), (b, d, c)] if j % 2 == 0 else [(a, b, d), (a, d, c)]
            for corners in cell:
                if min(values[k] for k in corners) >= 0:
                    continue
                polygon = []
                for k in range(3):
                    p, q = corners[k], corners[(k + 1) % 3]
                    if values[p] <= 0:
                        polygon.append(p)
                    if values[p] * values[q] < 0:
                        polygon.append(cut(p, q))
                if len(polygon) == 4:
                    one, other = (distance(points[polygon[k]], points[polygon[k + 2]])
                                  for k in (0, 1))
                    if round(other, 6) < round(one, 6):
                        polygon = polygon[1:] + polygon[:1]
                    triangles.append((polygon[0], polygon[2], polygon[3]))
                triangles.append(tuple(polygon[:3]))
    return points, triangles


def split_chords(points, triangles):
    """Halves each inner edge with both ends on the border, so that two copies of the region that
    are sewn together along the border share no other edge. Returns triangles and the border."""
    while True:
        opposite = {(t[k], t[(k + 1) % 3]): t for t in triangles for k in range(3)}
        border = {k for a, b in opposite if (b, a) not in opposite for k in (a, b)}
        chords = [(a, b) for a, b in opposite
                  if a < b and (b, a) in opposite and a in border and b in border]
        if not chords:
            return triangles, border
        halved = {}
        for a, b in chords:
            pair = opposite[a, b], opposite[b, a]
            if pair[0] in halved or pair[1] in halved:
                continue
            points.append(tuple((x + y) / 2 for x, y in zip(points[a], points[b])))
            for t in pair:
                halved[t] = [tuple(len(points) - 1 if k == end else k for k in t) for end in (a, b)]
        triangles = [half for t in triangles for half in halved.get(t, [t])]


def connected(triangles):
    """The pieces of a set of triangles that hang together by edges."""
    by_edge = {}
    for index, t in enumerate(triangles):
        for k in range(3):
            by_edge.setdefault(frozenset((t[k], t[(k + 1) % 3])), []).append(index)
    seen, pieces = set(), []
    for seed in range(len(triangles)):
        if seed in seen:
            continue
        seen.add(seed)
        stack, piece = [seed], []
        while stack:
            index = stack.pop()
            piece.append(index)
            t = triangles[index]
            for k in range(3):
                for other in by_edge[frozenset((t[k], t[(k + 1) % 3]))]:
                    if other not in seen:
                        seen.add(other)
                        stack.append(other)
        pieces.append([triangles[i] for i in sorted(piece)])
    return pieces
