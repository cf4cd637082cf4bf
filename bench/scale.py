#!/usr/bin/env python3
"""Packs atlases of more and more charts (bench/photogrammetry.py): time, memory, efficiency, and
the exponent with which the time grows.

Every packing is checked by `wrapatlas check`; the first that fails gives exit status 1. Progress
goes to stderr.
"""

import argparse
import math
import pathlib
import tempfile
import time

import measure
import photogrammetry

FITTED_FROM = 1000  # charts: below, what does not depend on their number counts too much


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    measure.add_options(parser, resolution="4096")
    measure.add_packing_options(parser, time="0")
    parser.add_argument("--charts", type=measure.numbers, default=[100, 1000, 10000, 50000],
                        help="how many, in turn; default 100,1000,10000,50000")
    parser.add_argument("--seed", type=int, default=0, help="of the generator; default 0")
    parser.add_argument("--wrap", default="uv", help="uv, u, v, or none; default uv")
    return parser.parse_args()


def slope(points):
    """Of the line that fits the points best, by least squares."""
    mean_x = sum(x for x, _ in points) / len(points)
    mean_y = sum(y for _, y in points) / len(points)
    return (sum((x - mean_x) * (y - mean_y) for x, y in points)
            / sum((x - mean_x) ** 2 for x, _ in points))


def packed(options, charts, folder):
    source = pathlib.Path(folder) / f"photogrammetry-{charts}.obj"
    begin = time.monotonic()
    source.write_text(photogrammetry.photogrammetry(charts, options.seed))
    measure.progress(f"{charts} charts, made in {time.monotonic() - begin:.1f} s")
    more = measure.packing_arguments(options, f"{options.method}-{charts}")
    report = measure.pack(options, source, folder, options.method, options.wrap,
                          f"{charts} charts", more)
    if report["charts"] != charts:
        raise measure.Failure(f"{charts} charts: wrapatlas counts {report['charts']}")
    return report


def main():
    options = arguments()
    measure.print_origin(options, f"{options.method}, time {options.time}, wrap {options.wrap}, "
                         f"seed {options.seed}")
    rows, times = [], {"pack": [], "total": []}
    with tempfile.TemporaryDirectory(prefix="wrapatlas_scale") as folder:
        for charts in options.charts:
            report = packed(options, charts, folder)
            seconds = report["seconds"]
            rows.append([charts, f"{report['efficiency']:.3f}", f"{seconds['pack']:.2f}",
                         f"{seconds['total']:.2f}", f"{report['peak_memory_mb']:.0f}"])
            if charts >= FITTED_FROM:
                for part, points in times.items():
                    points.append((math.log(charts), math.log(seconds[part])))
    print("\nEvery packing passed `wrapatlas check`.\n")
    print(measure.table(["charts", "efficiency", "pack, s", "total, s", "peak memory, MiB"], rows))
    if len(times["pack"]) > 1:
        print(f"\nFrom {FITTED_FROM} charts on, time grows as n^{slope(times['pack']):.2f} (pack), "
              f"n^{slope(times['total']):.2f} (total).")


if __name__ == "__main__":
    measure.run_script(main)
