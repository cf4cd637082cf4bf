#!/usr/bin/env python3
"""The most of a square atlas that can be in use without wrap: no chart may be longer than its side.

For each file the largest scale at which every chart by itself fits into the square at some angle, as
the efficiency at that scale. What a packer reaches cannot be more.
"""

import argparse
import math
import pathlib
import statistics

import measure
from union_find import UnionFind


def read_charts(path):
    """Points of each chart (faces that share UVs), and the area of all, of an OBJ."""
    uvs, faces = [], []
    for line in path.read_text().splitlines():
        if line.startswith("vt "):
            uvs.append(tuple(map(float, line.split()[1:3])))
        elif line.startswith("f "):
            faces.append([uvs[int(corner.split("/")[1]) - 1] for corner in line.split()[1:]])
    connected, area = UnionFind(uvs), 0
    for face in faces:
        for uv in face[1:]:
            connected.join(uv, face[0])
        area += abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(face, face[1:] + face[:1]))) / 2
    return connected.sets(), area


def smallest_square(points, angles=180):
    """Side of the smallest square around the points, over so many angles."""
    least = math.inf
    for k in range(angles):
        c, s = math.cos(math.pi / 2 * k / angles), math.sin(math.pi / 2 * k / angles)
        across = [c * x - s * y for x, y in points]
        up = [s * x + c * y for x, y in points]
        least = min(least, max(max(across) - min(across), max(up) - min(up)))
    return least


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="+", type=pathlib.Path, help="OBJ files with UVs")
    parser.add_argument("--below", type=float, default=0.8, help="list files with less than this")
    options = parser.parse_args()
    bounds = {}
    for path in options.files:
        charts, area = read_charts(path)
        bounds[path] = min(1, area / max(map(smallest_square, charts)) ** 2)
    print(f"{len(bounds)} files, mean of the bounds {statistics.mean(bounds.values()):.3f}\n")
    rows = [[f"{path.parent.name}/{path.name}", f"{bound:.3f}"]
            for path, bound in sorted(bounds.items(), key=lambda item: item[1])
            if bound < options.below]
    print(measure.table(["<file", "at most"], rows))


if __name__ == "__main__":
    main()
