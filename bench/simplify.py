#!/usr/bin/env python3
"""Simplifies meshes (OBJ, OFF) and measures what comes out without the program's help: triangles,
seconds, change of volume, distance to the mesh given; as a Markdown table. With --others beside
meshoptimizer and fast-simplification, at the number of triangles that wrapatlas came to.

Distances are of random points, spread evenly over one surface, to the other, and the other way
round: for each point the exact distance to the triangles on which the 12 nearest of many points
spread over that surface lie. "mean" is over both directions, "Hausdorff" the largest of all, both
in thousandths of the diagonal of the mesh's box. Needs numpy and scipy; see README.md.
"""

import argparse
import json
import pathlib
import shlex
import sys
import tempfile
import time
import typing

import measure

try:
    import numpy
    import scipy.spatial

    import mesh_files
    import simplify_others
    from unwrap import PSB
except ImportError as error:
    sys.exit(f"simplify.py: {error}; it needs numpy and scipy")

NEAREST = 12


class Row(typing.NamedTuple):
    file: str
    kind: str
    method: str
    before: int
    after: int
    seconds: float
    volume: float  # change, percent; NaN if the mesh is open
    mean: float
    hausdorff: float


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=pathlib.Path, help="OBJ or OFF")
    parser.add_argument("--faces", default="1%", help="of wrapatlas simplify; default 1%%")
    parser.add_argument("--samples", type=int, default=100000,
                        help="points to measure from, on either surface; default 100000")
    parser.add_argument("--runs", type=int, default=3, help="the fastest counts; default 3")
    parser.add_argument("--others", action="store_true", help="measure them too")
    parser.add_argument("--csv", type=pathlib.Path, help="also write every number to this file")
    parser.add_argument("--wrapatlas", default=measure.default_command(),
                        help="the command to run; default: $WRAPATLAS, else the release build")
    options = parser.parse_args()
    missing = [str(path) for path in options.files if not path.exists()]
    if missing:
        parser.error(f"no such file: {missing[0]}")
    if options.others and not simplify_others.are_there():
        parser.error("meshoptimizer or fast-simplification is not in this Python; see README.md")
    return options


def triangles(mesh):
    """Corners of triangles, three a row, of positions that are welded by value."""
    sizes = mesh.sizes()
    first = numpy.repeat(mesh.begins[:-1], sizes - 2)
    step = numpy.concatenate([numpy.arange(1, size - 1) for size in sizes]) if (
        sizes != 3).any() else numpy.ones(len(sizes), dtype=numpy.int64)
    corners = numpy.stack([first, first + step, first + step + 1], axis=1)
    positions, welded = numpy.unique(mesh.positions, axis=0, return_inverse=True)
    return positions, welded.reshape(-1)[mesh.corners[corners]]


def volume(positions, faces):
    """NaN if an edge has not exactly one face on either side."""
    edges = numpy.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    codes = edges[:, 0] * len(positions) + edges[:, 1]
    back = edges[:, 1] * len(positions) + edges[:, 0]
    if len(numpy.unique(codes)) != len(codes) or not numpy.isin(back, codes).all():
        return numpy.nan
    a, b, c = (positions[faces[:, i]] - positions.mean(axis=0) for i in range(3))
    return float(numpy.einsum("ij,ij->", a, numpy.cross(b, c)) / 6)


def spread(positions, faces, count, random):
    """Points on the surface, and the face that each is on."""
    a, b, c = (positions[faces[:, i]] for i in range(3))
    area = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1)
    at = (numpy.arange(count) + random.random(count)) / count * area.sum()
    face = numpy.minimum(numpy.searchsorted(numpy.cumsum(area), at), len(faces) - 1)
    s, t = random.random(count)[:, None], random.random(count)[:, None]
    s = numpy.sqrt(s)
    return (1 - s) * a[face] + s * (1 - t) * b[face] + s * t * c[face], face


def to_segment(p, a, b):
    """Squared distances."""
    along = b - a
    square = numpy.maximum((along * along).sum(-1), 1e-300)
    share = numpy.clip(((p - a) * along).sum(-1) / square, 0, 1)
    off = p - a - share[..., None] * along
    return (off * off).sum(-1)


def to_triangle(p, a, b, c):
    """Distances of points to triangles, row by row."""
    normal = numpy.cross(b - a, c - a)
    square = numpy.maximum((normal * normal).sum(-1), 1e-300)
    inside = True
    for start, end in ((a, b), (b, c), (c, a)):
        inside = inside & ((numpy.cross(end - start, p - start) * normal).sum(-1) >= 0)
    height = ((p - a) * normal).sum(-1) ** 2 / square
    sides = numpy.minimum(numpy.minimum(to_segment(p, a, b), to_segment(p, b, c)),
                          to_segment(p, c, a))
    return numpy.sqrt(numpy.where(inside, numpy.minimum(height, sides), sides))


def distances(points, positions, faces, random):
    """Of points to a surface."""
    targets, face = spread(positions, faces, 4 * len(points), random)
    _, nearest = scipy.spatial.cKDTree(targets).query(points, NEAREST)
    a, b, c = (positions[faces[face[nearest], i]] for i in range(3))
    return to_triangle(points[:, None, :], a, b, c).min(axis=1)


def measured(options, path, method, given, made, seconds):
    random = numpy.random.default_rng(1)
    diagonal = numpy.linalg.norm(given[0].max(axis=0) - given[0].min(axis=0))
    there = distances(spread(*given, options.samples, random)[0], *made, random)
    back = distances(spread(*made, options.samples, random)[0], *given, random)
    kind = (next((kind for last, kind in PSB.items() if int(path.stem) <= last), "")
            if path.stem.isdigit() else "")
    return Row(path.stem, kind, method, len(given[1]), len(made[1]), seconds,
               100 * (volume(*made) / volume(*given) - 1),
               1000 * (there.mean() + back.mean()) / 2 / diagonal,
               1000 * max(there.max(), back.max()) / diagonal)


def by_wrapatlas(options, path, folder):
    """The mesh that it makes, and the seconds without reading and writing."""
    output, seconds = pathlib.Path(folder) / "simplified.obj", numpy.inf
    for _ in range(options.runs):
        report = json.loads(measure.run(
            [options.wrapatlas, "simplify", str(path), "-o", str(output), "--faces",
             options.faces, "--quiet", "--json", "-"], path.name))
        seconds = min(seconds, report["seconds"]["simplify"])
    return triangles(mesh_files.read(output)), seconds


def measure_all(options):
    rows = []
    with tempfile.TemporaryDirectory(prefix="wrapatlas_simplify") as folder:
        for path in options.files:
            measure.progress(path.name)
            given = triangles(mesh_files.read(path))
            made, seconds = by_wrapatlas(options, path, folder)
            rows.append(measured(options, path, "wrapatlas", given, made, seconds))
            for name, simplifier in simplify_others.ALL.items() if options.others else ():
                seconds = numpy.inf
                for _ in range(options.runs):
                    start = time.perf_counter()
                    other = simplifier(*given, len(made[1]))
                    seconds = min(seconds, time.perf_counter() - start)
                rows.append(measured(options, path, name, given, other, seconds))
            if options.csv:
                measure.write_csv(options.csv, rows)
    return rows


def cells(row):
    change = "" if numpy.isnan(row.volume) else f"{row.volume:+.2g}"
    return (f"{row.file} {row.kind}".strip(), row.method, row.before, row.after,
            f"{row.seconds:.3f}", f"{(row.before - row.after) / row.seconds / 1000:.0f}", change,
            f"{row.mean:.2f}", f"{row.hausdorff:.2f}")


def main():
    options = arguments()
    print(f"machine: {measure.machine()}; commit: {measure.commit()}; command: "
          f"{shlex.join(sys.argv)}\n", flush=True)
    rows = measure_all(options)
    print(measure.table(("<mesh", "<by", "triangles", "left", "seconds", "thousand gone a second",
                         "volume, %", "mean, ‰", "Hausdorff, ‰"), map(cells, rows)))
    own = [row for row in rows if row.method == "wrapatlas"]
    rate = sum(row.before - row.after for row in own) / sum(row.seconds for row in own)
    print(f"\nwrapatlas over all: {rate / 1000:.0f} thousand gone a second")


if __name__ == "__main__":
    measure.run_script(main)
