#!/usr/bin/env python3
"""The most of a square atlas that can be in use without wrap: no chart may be longer than its side.

For each file the largest scale at which every chart by itself fits into the square at some angle, as
the efficiency at that scale. What a packer reaches cannot be more. With --pairs also the scale at
which the two largest charts fit together (pair_square.py: an estimate; some ten seconds a file).
"""

import argparse
import math
import pathlib
import statistics

import measure
from outlines import cross
from union_find import UnionFind

CELLS = 100  # of the grid of a pair, along a square of the area of all charts


def read_charts(path):
    """Triangles of each chart (faces that share UVs) of an OBJ."""
    uvs, faces = [], []
    for line in path.read_text().splitlines():
        if line.startswith("vt "):
            uvs.append(tuple(map(float, line.split()[1:3])))
        elif line.startswith("f "):
            faces.append([uvs[int(corner.split("/")[1]) - 1] for corner in line.split()[1:]])
    connected = UnionFind(uvs)
    for face in faces:
        for uv in face[1:]:
            connected.join(uv, face[0])
    charts = {}
    for face in faces:
        fan = [(face[0], face[k], face[k + 1]) for k in range(1, len(face) - 1)]
        charts.setdefault(connected.root(face[0]), []).extend(fan)
    return list(charts.values())


def area(chart):
    return sum(abs(cross(*triangle)) for triangle in chart) / 2


def smallest_square(chart, angles=180):
    """Side of the smallest square around a chart, over so many angles."""
    points = {point for triangle in chart for point in triangle}
    least = math.inf
    for k in range(angles):
        c, s = math.cos(math.pi / 2 * k / angles), math.sin(math.pi / 2 * k / angles)
        across = [c * x - s * y for x, y in points]
        up = [s * x + c * y for x, y in points]
        least = min(least, max(max(across) - min(across), max(up) - min(up)))
    return least


def pair_bound(charts, whole):
    """Of the two largest charts; `whole`: the area of all."""
    import pair_square  # needs more than Python  # pylint: disable=import-outside-toplevel

    a, b = sorted(charts, key=area, reverse=True)[:2]
    return whole / pair_square.smallest_square(a, b, whole**0.5 / CELLS) ** 2


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="+", type=pathlib.Path, help="OBJ files with UVs")
    parser.add_argument("--below", type=float, default=0.8, help="list files with less than this")
    parser.add_argument("--pairs", action="store_true",
                        help="also estimate what the two largest charts leave; needs numpy, scipy")
    options = parser.parse_args()
    rows, singles, both = [], [], []
    for path in options.files:
        charts = read_charts(path)
        whole = sum(map(area, charts))
        single = min(1, whole / max(map(smallest_square, charts)) ** 2)
        pair = min(1, pair_bound(charts, whole)) if options.pairs and len(charts) > 1 else 1
        singles.append(single)
        both.append(min(single, pair))
        measure.progress(f"{path.name} {both[-1]:.3f}")
        if both[-1] < options.below:
            rows.append([f"{path.parent.name}/{path.name}", len(charts), single, pair, both[-1]])
    print(f"{len(singles)} files, mean of the bounds {statistics.mean(singles):.3f}")
    header = ["<file", "charts", "at most, by its longest chart"]
    if options.pairs:
        print(f"with those of the two largest charts, about {statistics.mean(both):.3f}")
        header.append("by its two largest, about")
    print("\n" + measure.table(header, [
        [name, count, f"{single:.3f}", f"{pair:.3f}"][:len(header)]
        for name, count, single, pair, _ in sorted(rows, key=lambda row: row[-1])]))


if __name__ == "__main__":
    main()
