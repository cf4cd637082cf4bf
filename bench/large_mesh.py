#!/usr/bin/env python3
"""Time of cutting and flattening against the number of triangles, on bumpy spheres, tori and plates
with three holes of growing size, each result measured as unwrap.py does; with --xatlas beside
xatlas as far as it gets within --limit. A table, and a plot with --svg. Nothing is packed by
wrapatlas (`unwrap --stop-after flat`); xatlas cannot stop there. Needs numpy."""

import argparse
import pathlib
import sys
import tempfile

import measure

try:
    import numpy
    import unwrap_runs
except ImportError as error:
    sys.exit(f"large_mesh.py: {error}; it needs numpy")
import log_plot


def bumps(points):
    """How far each point of a surface lies out: smooth waves, the same for every size."""
    waves = numpy.random.default_rng(1)
    out = numpy.ones(len(points))
    for wave in range(1, 6):
        for _ in range(3):
            direction, phase = waves.normal(size=3), waves.uniform(0, 6)
            out += 0.125 / wave * numpy.sin(2 * wave * points @ direction + phase)
    return out[:, None]


def grid_faces(columns, rows, closed):
    """Two triangles to each square of a grid whose columns close to a ring; its rows do if `closed`."""
    i, j = numpy.meshgrid(numpy.arange(columns), numpy.arange(rows if closed else rows - 1))
    a, b = j * columns + i, j * columns + (i + 1) % columns
    above = (j + 1) % rows
    c, d = above * columns + (i + 1) % columns, above * columns + i
    return numpy.vstack([numpy.stack(face, -1).reshape(-1, 3) for face in ((a, b, c), (a, c, d))])


def sphere(triangles):
    columns = round(triangles ** 0.5)
    rows = max(3, triangles // (2 * columns))
    around = numpy.arange(columns) / columns * 2 * numpy.pi
    up = (numpy.arange(1, rows) / rows - 0.5) * numpy.pi
    u, v = numpy.meshgrid(around, up)
    points = numpy.stack([numpy.cos(v) * numpy.cos(u), numpy.cos(v) * numpy.sin(u), numpy.sin(v)], -1)
    points = numpy.vstack([points.reshape(-1, 3), [[0, 0, -1], [0, 0, 1]]])
    low, high, ring = len(points) - 2, len(points) - 1, numpy.arange(columns)
    last = (rows - 2) * columns
    faces = [grid_faces(columns, rows - 1, False),
             numpy.stack([numpy.full(columns, low), (ring + 1) % columns, ring], -1),
             numpy.stack([numpy.full(columns, high), last + ring, last + (ring + 1) % columns], -1)]
    return bumps(points) * points, numpy.vstack(faces)


def torus(triangles):
    rows = max(3, round((triangles / 6) ** 0.5))
    columns = max(3, triangles // (2 * rows))
    u, v = numpy.meshgrid(numpy.arange(columns) / columns * 2 * numpy.pi,
                          numpy.arange(rows) / rows * 2 * numpy.pi)
    middle = numpy.stack([numpy.cos(u), numpy.sin(u), 0 * u], -1).reshape(-1, 3)
    out = numpy.stack([numpy.cos(v) * numpy.cos(u), numpy.cos(v) * numpy.sin(u), numpy.sin(v)],
                      -1).reshape(-1, 3)
    return middle + 0.35 * bumps(middle + 0.35 * out) * out, grid_faces(columns, rows, True)


def plate(triangles):
    """A plate of 7 x 3 x 1 cubes of lattice cells, three of its cubes missing: genus 3, sharp edges."""
    n = max(1, round((triangles / 136) ** 0.5))
    solid = numpy.pad(numpy.ones((7 * n, 3 * n, n), dtype=numpy.int8), 1)
    for hole in (1, 3, 5):
        solid[1 + hole * n:1 + (hole + 1) * n, 1 + n:1 + 2 * n] = 0
    quads = []
    for axis in range(3):
        step = numpy.diff(solid, axis=axis)
        up, u, v = numpy.roll(numpy.eye(3, dtype=numpy.int64), axis, axis=1)
        for leaving, order in ((-1, [0, 1, 2, 3]), (1, [3, 2, 1, 0])):
            low = numpy.argwhere(step == leaving) + up
            quads.append(numpy.stack([low, low + u, low + u + v, low + v], 1)[:, order])
    corners = numpy.vstack(quads).reshape(-1, 3)
    shape = numpy.array(solid.shape) + 1
    keys, corners = numpy.unique(numpy.ravel_multi_index(corners.T, shape), return_inverse=True)
    points = (numpy.stack(numpy.unravel_index(keys, shape), -1) - 1) / n - [3.5, 1.5, 0.5]
    corners = corners.reshape(-1, 4)
    points *= 1 + 0.2 * (bumps(points / 3.5) - 1)
    return points, numpy.vstack([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])


SHAPES = {"sphere": sphere, "torus": torus, "plate": plate}


def write_off(path, points, faces):
    with open(path, "w") as file:
        file.write(f"OFF\n{len(points)} {len(faces)} 0\n")
        numpy.savetxt(file, points, fmt="%.7g")
        numpy.savetxt(file, numpy.hstack([numpy.full((len(faces), 1), 3), faces]), fmt="%d")


def measure_all(options, folder):
    """Rows of the table, and {name: [(triangles, seconds)]}."""
    rows, series = [], {}

    def add(name, row, seconds):
        if row.charts:
            series.setdefault(f"{row.method}, {name}", []).append((row.faces, seconds))
            rows.append((name, row.method, row.faces, row.charts, f"{seconds:.2f}",
                         f"{row.megabytes:.0f}", f"{row.l2:.2f}", row.failed))
        else:
            rows.append((name, row.method, "", "", "", "", "", row.failed.splitlines()[0]))
        measure.progress(" ".join(map(str, rows[-1])))

    for name in options.shapes.split(","):
        make = SHAPES[name]
        xatlas = options.xatlas
        for count in map(int, options.triangles.split(",")):
            path = pathlib.Path(folder) / f"{name}.off"
            write_off(path, *make(count))
            row = unwrap_runs.by_wrapatlas(options, name, path, folder, ["--stop-after", "flat"])
            add(name, row, row.charts and row.repair + row.segment)
            if xatlas:
                row = unwrap_runs.by_xatlas(options, name, path, folder)
                add(name, row, row.total)
                xatlas = bool(row.charts)
    return rows, series


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    measure.add_options(parser)
    parser.add_argument("--triangles", default="10000,30000,100000,300000,1000000",
                        help="comma-separated; default %(default)s")
    parser.add_argument("--shapes", default=",".join(SHAPES),
                        help="comma-separated; default %(default)s")
    parser.add_argument("--max-stretch", type=float, default=2.0, help="of wrapatlas; default 2")
    parser.add_argument("--limit", type=float, default=600.0, help="seconds a mesh; default 600")
    parser.add_argument("--xatlas", action="store_true", help="measure xatlas too")
    parser.add_argument("--svg", type=pathlib.Path, help="write the plot to this file")
    options = parser.parse_args()
    unknown = set(options.shapes.split(",")) - set(SHAPES)
    if unknown:
        parser.error(f"no such shape: {unknown.pop()}")
    measure.print_origin(options, f"limit {options.limit:g} s")
    with tempfile.TemporaryDirectory(prefix="wrapatlas_large") as folder:
        rows, series = measure_all(options, folder)
    print(measure.table(("<mesh", "<by", "triangles", "charts", "seconds", "MiB", "L2, largest",
                         "<broken"), rows))
    if options.svg:
        options.svg.write_text(log_plot.plot("Seconds to cut and flatten", "triangles", series))
    if any(row[-1] for row in rows if row[1] == "wrapatlas"):
        sys.exit(1)


if __name__ == "__main__":
    measure.run_script(main)
