#!/usr/bin/env python3
"""Tangents as Blender makes them, whose code is MikkTSpace's own: what tests/unit/tangents_test.cpp
compares ours with. Prints that test's data file; needs PyPI's bpy (see README.md)."""

import math

import bpy

SIDE = 6


def height(x, y):
    return 0.35 * math.sin(2.1 * x + 0.3) * math.cos(1.7 * y) + 0.1 * math.sin(5 * x * y)


def corner_uv(face, position):
    """Three charts: the second is mirrored, the third is turned."""
    x, y = position[0], position[1]
    column = (face // 2) % SIDE
    if column < 2:
        return 0.1 + 0.3 * x, 0.1 + 0.25 * y + 0.05 * x
    if column < 4:
        return 0.9 - 0.3 * x, 0.1 + 0.3 * y
    return 0.5 + 0.1 * x - 0.25 * y, 0.5 + 0.25 * x + 0.1 * y


def main():
    points = [(i / 2, j / 2, height(i / 2, j / 2))
              for j in range(SIDE + 1) for i in range(SIDE + 1)]
    triangles = []
    for j in range(SIDE):
        for i in range(SIDE):
            a = j * (SIDE + 1) + i
            b, c, d = a + 1, a + SIDE + 2, a + SIDE + 1
            triangles += [(a, b, c), (a, c, d)] if (i + j) % 2 else [(a, b, d), (b, c, d)]
    mesh = bpy.data.meshes.new("sheet")
    mesh.from_pydata(points, [], triangles)
    mesh.polygons.foreach_set("use_smooth", [True] * len(triangles))
    layer = mesh.uv_layers.new(name="UVMap")
    for loop in mesh.loops:
        layer.data[loop.index].uv = corner_uv(loop.index // 3, points[loop.vertex_index])
    mesh.calc_tangents(uvmap="UVMap")
    print("# corners of triangles, from bench/compare/tangents.py with Blender "
          f"{bpy.app.version_string}")
    print("# position, UV, normal, tangent, sign")
    for loop in mesh.loops:
        position = points[loop.vertex_index]
        values = (*position, *corner_uv(loop.index // 3, position), *loop.normal,
                  *loop.tangent, loop.bitangent_sign)
        print(" ".join(f"{value:.9g}" for value in values))


main()
