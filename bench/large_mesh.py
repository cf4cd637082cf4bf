#!/usr/bin/env python3
"""Time of cutting and flattening against the number of triangles, on bumpy spheres and tori of growing
size, with --xatlas beside xatlas as far as it gets within --limit; table, and a plot with --svg.
Nothing is packed by wrapatlas (`unwrap --stop-after flat`); xatlas cannot stop there. Needs numpy."""

import argparse
import json
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


def write_off(path, points, faces):
    with open(path, "w") as file:
        file.write(f"OFF\n{len(points)} {len(faces)} 0\n")
        numpy.savetxt(file, points, fmt="%.7g")
        numpy.savetxt(file, numpy.hstack([numpy.full((len(faces), 1), 3), faces]), fmt="%d")


def by_wrapatlas(options, path):
    report = json.loads(measure.run(
        [options.wrapatlas, "unwrap", str(path), "-o", str(path.with_suffix(".obj")), "--quiet",
         "--threads", options.threads, "--stop-after", "flat", "--json", "-"], str(path),
        options.limit))
    seconds = report["seconds"]["repair"] + report["seconds"]["segment"]
    return report["faces"], report["charts"], seconds, report["peak_memory_mb"], report


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    measure.add_options(parser)
    parser.add_argument("--triangles", default="10000,30000,100000,300000,1000000",
                        help="comma-separated; default %(default)s")
    parser.add_argument("--limit", type=float, default=600.0, help="seconds a mesh; default 600")
    parser.add_argument("--xatlas", action="store_true", help="measure xatlas too")
    parser.add_argument("--svg", type=pathlib.Path, help="write the plot to this file")
    options = parser.parse_args()
    measure.print_origin(options, f"limit {options.limit:g} s")
    rows, series = [], {}
    with tempfile.TemporaryDirectory(prefix="wrapatlas_large") as folder:
        for name, make in (("sphere", sphere), ("torus", torus)):
            beaten = False
            for count in map(int, options.triangles.split(",")):
                path = pathlib.Path(folder) / f"{name}.off"
                write_off(path, *make(count))
                faces, charts, seconds, megabytes, report = by_wrapatlas(options, path)
                rows.append((name, "wrapatlas", faces, charts, f"{seconds:.2f}", f"{megabytes:.0f}",
                             f"{report['stretch']['l2_max']:.2f}"))
                series.setdefault(f"wrapatlas, {name}", []).append((faces, seconds))
                measure.progress(" ".join(map(str, rows[-1])))
                if not options.xatlas or beaten:
                    continue
                row = unwrap_runs.by_xatlas(options, name, path, folder)
                beaten = not row.charts
                total = f"{row.total:.2f}" if row.charts else f"> {options.limit:g}"
                stretch = "" if beaten else f"{row.l2:.2f}"
                memory = "" if beaten else f"{row.megabytes:.0f}"
                rows.append((name, "xatlas", faces, row.charts or "", total, memory, stretch))
                if row.charts:
                    series.setdefault(f"xatlas, {name}", []).append((faces, row.total))
                measure.progress(" ".join(map(str, rows[-1])))
    print(measure.table(("<mesh", "<by", "triangles", "charts", "seconds", "MiB", "L2, largest"),
                        rows))
    if options.svg:
        options.svg.write_text(log_plot.plot("Seconds to cut and flatten", "triangles", series))


if __name__ == "__main__":
    measure.run_script(main)
