#!/usr/bin/env python3
"""The same call of two libraries: xatlas.parametrize and wrapatlas.parametrize, both at their defaults.

Of what they return: share of the atlas that triangles cover, charts (by shared vertices), length of
all seams in space, each once, over the root of the area, faces left without area in UV, seconds. Needs
both packages: build/python/test-3.11/bin/python bench/compare/parametrize.py FILES, after
./dev python-test.
"""

import argparse
import pathlib
import statistics
import sys
import time

import numpy
import wrapatlas
import xatlas

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import measure  # noqa: E402  (of the folder above)
from union_find import UnionFind  # noqa: E402


def chart_count(vertices, faces):
    """Sets of faces that share vertices."""
    sets = UnionFind(range(vertices))
    for a, b, c in faces.tolist():
        sets.join(a, b)
        sets.join(b, c)
    return len({sets.root(face[0]) for face in faces.tolist()})


def seam_length(positions, vmapping, faces):
    """Edges whose two faces have other vertices there, half of each; borders of the mesh too."""
    ends = numpy.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    _, inverse, count = numpy.unique(numpy.sort(ends, axis=1), axis=0, return_inverse=True,
                                     return_counts=True)
    lone = ends[count[inverse.ravel()] == 1]
    points = positions[vmapping]
    return 0.5 * numpy.linalg.norm(points[lone[:, 0]] - points[lone[:, 1]], axis=1).sum()


def measured(library, positions, faces):
    start = time.perf_counter()
    vmapping, indices, uvs = library.parametrize(positions, faces)
    seconds = time.perf_counter() - start
    a, b, c = (uvs[indices[:, k]].astype(float) for k in range(3))
    doubled = numpy.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    p, q, r = (positions[faces[:, k]] for k in range(3))
    area = 0.5 * numpy.linalg.norm(numpy.cross(q - p, r - p), axis=1)
    return {"used": 0.5 * doubled.sum(), "charts": chart_count(len(uvs), indices),
            "border": seam_length(positions, vmapping, indices) / area.sum() ** 0.5,
            "flat": int(((doubled == 0) & (area > 0)).sum()), "seconds": seconds}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="+", type=pathlib.Path, help="meshes")
    options = parser.parse_args()
    print(f"machine: {measure.machine()}; commit: {measure.commit()}\n")
    print("| mesh | faces | by | in use | charts | border | faces without area | s |\n"
          "|---|---:|---|---:|---:|---:|---:|---:|")
    rows = {"xatlas": [], "wrapatlas": []}
    for file in options.files:
        mesh = wrapatlas.load(str(file)).triangulated()
        positions, faces = numpy.array(mesh.positions), numpy.array(mesh.corner_position).reshape(-1, 3)
        for name, library in (("xatlas", xatlas), ("wrapatlas", wrapatlas)):
            row = measured(library, positions, faces)
            rows[name].append(row)
            print(f"| {file.stem} | {len(faces)} | {name} | {row['used']:.3f} | {row['charts']} | "
                  f"{row['border']:.2f} | {row['flat']} | {row['seconds']:.2f} |", flush=True)
    print("\n| mean of all | in use | min | charts, median | border | faces without area | s |\n"
          "|---|---:|---:|---:|---:|---:|---:|")
    for name, found in rows.items():
        column = {key: [row[key] for row in found] for key in found[0]}
        print(f"| {name} | {statistics.mean(column['used']):.3f} | {min(column['used']):.3f} | "
              f"{statistics.median(column['charts']):g} | {statistics.mean(column['border']):.2f} | "
              f"{sum(column['flat'])} | {statistics.mean(column['seconds']):.2f} |")


if __name__ == "__main__":
    main()
