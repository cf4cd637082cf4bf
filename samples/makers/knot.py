"""Knot: a closed tube without UVs."""

import math

from makers.vectors import cross, unit


def make_knot(along=240, around=14):
    """A tube of varying width along the (2, 5) torus knot."""
    def centre(t):
        ring = 3.0 + 1.1 * math.cos(5 * t)
        return (ring * math.cos(2 * t), ring * math.sin(2 * t), 1.1 * math.sin(5 * t))

    positions, faces = [], []
    for i in range(along):
        t = 2 * math.pi * i / along
        ahead = unit([q - p for p, q in zip(centre(t - 1e-3), centre(t + 1e-3))])
        outward = [p - q for p, q in
                   zip(centre(t), (3.0 * math.cos(2 * t), 3.0 * math.sin(2 * t), 0.0))]
        shift = sum(p * q for p, q in zip(outward, ahead))
        outward = unit([p - shift * q for p, q in zip(outward, ahead)])
        side = cross(ahead, outward)
        for j in range(around):
            angle = 2 * math.pi * j / around
            radius = 0.34 + 0.07 * math.sin(15 * t) + 0.04 * math.cos(3 * angle)
            positions.append(tuple(
                p + radius * (math.cos(angle) * q + math.sin(angle) * r)
                for p, q, r in zip(centre(t), outward, side)))
            after = (i + 1) % along
            faces.append((i * around + j, i * around + (j + 1) % around,
                          after * around + (j + 1) % around, after * around + j))
    return positions, faces
