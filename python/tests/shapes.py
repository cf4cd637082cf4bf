"""Meshes to try things on."""

import numpy as np


def square():
    positions = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], np.float64)
    return positions, np.array([[0, 1, 2], [0, 2, 3]])


def box():
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], np.float64)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return corners, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


def sphere(triangles=2000):
    """Bumpy, so that no two charts are alike."""
    columns = max(4, round(triangles**0.5))
    rows = max(3, triangles // (2 * columns))
    around = np.arange(columns) / columns * 2 * np.pi
    up = (np.arange(1, rows) / rows - 0.5) * np.pi
    u, v = np.meshgrid(around, up)
    points = np.stack([np.cos(v) * np.cos(u), np.sin(v), np.cos(v) * np.sin(u)], -1).reshape(-1, 3)
    points = np.vstack([points, [[0, -1, 0], [0, 1, 0]]])
    points *= 1 + 0.1 * np.sin(5 * points[:, :1]) + 0.1 * np.cos(4 * points[:, 1:2])
    ring = np.arange(columns)
    faces = []
    for row in range(rows - 2):
        a, b = row * columns + ring, row * columns + (ring + 1) % columns
        c, d = a + columns, b + columns
        faces += [np.stack([a, d, b], 1), np.stack([a, c, d], 1)]
    low, high, last = len(points) - 2, len(points) - 1, (rows - 2) * columns
    faces.append(np.stack([np.full(columns, low), ring, (ring + 1) % columns], 1))
    faces.append(np.stack([np.full(columns, high), last + (ring + 1) % columns, last + ring], 1))
    return points, np.vstack(faces)


def scattered_squares(count=12):
    """UVs of squares of several sizes, each a chart: (4 count, 2), (2 count, 3)."""
    uv, faces = [], []
    for i in range(count):
        side = 0.05 + 0.01 * (i % 5)
        corners = np.array([[0, 0], [side, 0], [side, side], [0, side]]) + [0.2 * i, 0.1]
        uv.append(corners)
        faces += [[4 * i, 4 * i + 1, 4 * i + 2], [4 * i, 4 * i + 2, 4 * i + 3]]
    return np.vstack(uv), np.array(faces)


def checker(size=64):
    """(size, size, 3) uint8, squares of two colours."""
    rows, columns = np.mgrid[0:size, 0:size] // (size // 8)
    light = (rows + columns) % 2 == 0
    return np.where(light[..., None], [230, 200, 120], [40, 60, 130]).astype(np.uint8)
