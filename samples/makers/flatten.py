"""Flattening a curved piece of surface with little distortion."""

import math

from makers.vectors import distance, signed_area2


def as_rigid_as_possible(rest, triangles, start, rounds=8):
    """Flattens triangles with 3D corners `rest`, from the planar `start`, as isometrically as can
    be: Liu et al. 2008, "A Local/Global Approach to Mesh Parameterization" (ARAP)."""
    corners, matrix = [], [{} for _ in start]
    for t in triangles:
        a, b, c = (rest[k] for k in t)
        ab, ac, bc = distance(a, b), distance(a, c), distance(b, c)
        x = (ab * ab + ac * ac - bc * bc) / (2 * ab)
        flat = [(0.0, 0.0), (ab, 0.0), (x, math.sqrt(max(1e-12, ac * ac - x * x)))]
        area2 = signed_area2(*flat)
        weights = []
        for k in range(3):
            o, p, q = flat[k], flat[(k + 1) % 3], flat[(k + 2) % 3]
            dot = (p[0] - o[0]) * (q[0] - o[0]) + (p[1] - o[1]) * (q[1] - o[1])
            w = max(0.02, dot / area2)
            i, j = t[(k + 1) % 3], t[(k + 2) % 3]
            weights.append((i, j, w, q[0] - p[0], q[1] - p[1]))
            for m, n in ((i, j), (j, i)):
                matrix[m][m] = matrix[m].get(m, 0.0) + w
                matrix[m][n] = matrix[m].get(n, 0.0) - w
        corners.append(weights)
    matrix[0][0] += 1.0  # one point is held, or the whole could drift
    rows = [sorted(row.items()) for row in matrix]
    diagonal = [row[k] for k, row in enumerate(matrix)]
    axes = [[p[0] for p in start], [p[1] for p in start]]
    for _ in range(rounds):
        right = [[0.0] * len(start), [0.0] * len(start)]
        right[0][0], right[1][0] = start[0]
        us, vs = axes
        for weights in corners:
            cosine = sine = 0.0
            for i, j, w, x, y in weights:
                du, dv = us[j] - us[i], vs[j] - vs[i]
                cosine += w * (x * du + y * dv)
                sine += w * (x * dv - y * du)
            size = math.hypot(cosine, sine) or 1.0
            cosine, sine = cosine / size, sine / size
            for i, j, w, x, y in weights:
                tx, ty = w * (cosine * x - sine * y), w * (sine * x + cosine * y)
                right[0][j] += tx
                right[0][i] -= tx
                right[1][j] += ty
                right[1][i] -= ty
        axes = [conjugate_gradients(rows, diagonal, b, x, 25) for b, x in zip(right, axes)]
    return list(zip(*axes))


def conjugate_gradients(rows, diagonal, b, x, steps):
    def times(v):
        return [sum(value * v[k] for k, value in row) for row in rows]

    residual = [p - q for p, q in zip(b, times(x))]
    direction = [r / d for r, d in zip(residual, diagonal)]
    size = sum(r * d for r, d in zip(residual, direction))
    for _ in range(steps):
        if size < 1e-14:
            break
        image = times(direction)
        alpha = size / sum(p * q for p, q in zip(direction, image))
        x = [p + alpha * q for p, q in zip(x, direction)]
        residual = [r - alpha * q for r, q in zip(residual, image)]
        scaled = [r / d for r, d in zip(residual, diagonal)]
        before, size = size, sum(r * s for r, s in zip(residual, scaled))
        direction = [s + size / before * d for s, d in zip(scaled, direction)]
    return x
