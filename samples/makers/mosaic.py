"""Mosaic: several hundred charts, large and tiny."""

import heapq
import math
import random

from makers.layout import lay_out
from makers.vectors import cross, unit


def icosphere(frequency):
    """A unit sphere of 20 * frequency^2 triangles."""
    g = (1 + math.sqrt(5)) / 2
    corners = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g),
               (0, -1, -g), (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
             (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
             (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    positions, index, triangles = [], {}, []

    def point(weights):
        key = tuple(sorted((k, w) for k, w in weights if w > 0))
        if key not in index:
            p = [sum(w * corners[k][axis] for k, w in key) for axis in range(3)]
            index[key] = len(positions)
            positions.append(tuple(unit(p)))
        return index[key]

    n = frequency
    for a, b, c in faces:
        def at(i, j):
            return point(((a, n - i - j), (b, i), (c, j)))
        for i in range(n):
            for j in range(n - i):
                triangles.append((at(i, j), at(i + 1, j), at(i, j + 1)))
                if i + j < n - 1:
                    triangles.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
    return positions, triangles


def make_mosaic():
    positions, triangles = icosphere(24)
    centres = [tuple(sum(positions[k][axis] for k in t) / 3 for axis in range(3))
               for t in triangles]
    by_edge = {}
    for index, t in enumerate(triangles):
        for k in range(3):
            by_edge.setdefault(frozenset((t[k], t[(k + 1) % 3])), []).append(index)
    neighbours = [[] for _ in triangles]
    for a, b in (by_edge[edge] for edge in sorted(by_edge, key=sorted)):
        neighbours[a].append(b)
        neighbours[b].append(a)

    chance = random.Random(2011)
    roughness = [chance.random() for _ in triangles]
    # Seeds crowd towards one side, so that charts range from one face to hundreds.
    crowd = []
    for index, c in enumerate(centres):
        crowd.append((chance.random() / math.exp(2.8 * (0.8 * c[2] + 0.6 * c[0])), index))
    seeds = [index for _, index in sorted(crowd)[:360]]
    # Each chart has an axis; growing around that axis is cheap, so charts become arcs and hooks.
    axes = []
    for _ in seeds:
        axis = [chance.uniform(-1, 1) for _ in range(3)]
        axes.append(unit(axis))
    owner, heap = [None] * len(triangles), []
    for chart, seed in enumerate(seeds):
        heapq.heappush(heap, (0.0, seed, chart))
    while heap:
        cost, face, chart = heapq.heappop(heap)
        if owner[face] is not None:
            continue
        owner[face] = chart
        for other in neighbours[face]:
            if owner[other] is None:
                step = [q - p for p, q in zip(centres[face], centres[other])]
                size = math.sqrt(sum(x * x for x in step))
                against = abs(sum(x * y for x, y in zip(step, axes[chart]))) / size
                price = size * (0.06 + 4.0 * against * against + 0.6 * roughness[other])
                heapq.heappush(heap, (cost + price, other, chart))

    faces, charts = [], []
    for chart in range(len(seeds)):
        own = [t for t, o in zip(triangles, owner) if o == chart]
        local, points = {}, []
        middle = [sum(positions[k][axis] for t in own for k in t) for axis in range(3)]
        east, north, up = frame_at(middle)
        for t in own:
            for k in t:
                if k in local:
                    continue
                # Lambert's azimuthal projection keeps areas.
                x, y, z = (sum(p * q for p, q in zip(positions[k], v)) for v in (east, north, up))
                stretch = math.sqrt(2 / (1 + z))
                local[k] = len(points)
                points.append((stretch * x, stretch * y))
            faces.append((t, chart, tuple(local[k] for k in t)))
        charts.append(points)
    return positions, faces, lay_out(charts)


def frame_at(direction):
    up = unit(direction)
    side = [0.0, 0.0, 1.0] if abs(up[2]) < 0.9 else [1.0, 0.0, 0.0]
    east = unit(cross(side, up))
    return east, cross(up, east), up
