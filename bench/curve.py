#!/usr/bin/env python3
"""Mean efficiency against time: `guided` at several --times, with wrap and without, as curves;
`modulo` and the earlier packers as points. Writes every number as CSV and the plot as SVG.

Points stand at the mean time that packing took (reading, checking and writing files left out),
which for `guided` may differ from the --time it was given. Every packing is checked by `wrapatlas
check`; the first that fails gives exit status 1. Progress goes to stderr. With all files and times
it takes some hours; --stride 4 takes every fourth file.
"""

import argparse
import collections
import csv
import pathlib
import statistics
import tempfile

import curve_plot
import measure

Packing = collections.namedtuple("Packing", "file method wrap time efficiency pack total")
POINTS = [("lprm02", "none"), ("swg03", "none"), ("zsgs04", "none"), ("modulo", "none"),
          ("modulo", "uv")]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    measure.add_options(parser)
    parser.add_argument("--folder", type=pathlib.Path, default=measure.CHARTS / "uvatlas",
                        help="its .obj files are packed; default: ../shared/data/charts/uvatlas")
    parser.add_argument("--stride", type=int, default=1, help="take every so many files; default 1")
    parser.add_argument("--times", default="0,0.1,0.5,1,2,5,10,30,60",
                        help="of guided, seconds; default 0,0.1,0.5,1,2,5,10,30,60")
    parser.add_argument("--csv", type=pathlib.Path, default=pathlib.Path("curve.csv"),
                        help="default curve.csv")
    parser.add_argument("--svg", type=pathlib.Path, default=pathlib.Path("curve.svg"),
                        help="default curve.svg")
    parser.add_argument("--from-csv", type=pathlib.Path, metavar="CSV",
                        help="measure nothing, draw the numbers of an earlier run")
    options = parser.parse_args()
    options.files = sorted(options.folder.glob("*.obj"))[::options.stride]
    if not options.files and not options.from_csv:
        parser.error(f"no .obj files in {options.folder}")
    return options


def measured(options):
    """Yields Packings, the quick ones first."""
    jobs = [(method, wrap, "") for method, wrap in POINTS]
    jobs += [("guided", wrap, seconds) for seconds in options.times.split(",")
             for wrap in ("none", "uv")]
    with tempfile.TemporaryDirectory(prefix="wrapatlas_curve") as folder:
        for number, (method, wrap, seconds) in enumerate(jobs, 1):
            measure.progress(f"[{number}/{len(jobs)}] {method} {seconds} wrap {wrap}")
            for path in options.files:
                report = measure.pack(options, path, folder, method, wrap,
                                      f"{path}: {method} {seconds}, wrap {wrap}",
                                      ["--time", seconds] if seconds else [])
                yield Packing(path.name, method, wrap, seconds, report["efficiency"],
                              report["seconds"]["pack"], report["seconds"]["total"])


def measure_to_csv(options):
    """Each line is written when it is known, so that an interrupted run leaves its numbers."""
    with open(options.csv, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(Packing._fields)
        for packing in measured(options):
            writer.writerow(packing)
            file.flush()


def read(path):
    with open(path, newline="") as file:
        return [Packing(**{**row, "efficiency": float(row["efficiency"]),
                           "pack": float(row["pack"]), "total": float(row["total"])})
                for row in csv.DictReader(file)]


def means(packings):
    """{(method, wrap): [(seconds, efficiency, --time)]}, in the order of the file."""
    groups, result = {}, {}
    for packing in packings:
        groups.setdefault((packing.method, packing.wrap, packing.time), []).append(packing)
    for (method, wrap, budget), group in groups.items():
        result.setdefault((method, wrap), []).append(
            (statistics.mean(packing.pack for packing in group),
             statistics.mean(packing.efficiency for packing in group), budget))
    return result


def main():
    options = arguments()
    if not options.from_csv:
        measure.print_origin(options, f"{len(options.files)} files of {options.folder}, "
                             f"stride {options.stride}, times {options.times}")
        measure_to_csv(options)
    packings = read(options.from_csv or options.csv)
    series = means(packings)
    print("\nEvery packing passed `wrapatlas check`. Means over "
          f"{len({packing.file for packing in packings})} files.\n")
    print(measure.table(["<method", "<wrap", "--time", "pack, s", "efficiency"],
                        [[*key, budget, f"{seconds:.3f}", f"{efficiency:.3f}"]
                         for key, points in series.items()
                         for seconds, efficiency, budget in points]))
    options.svg.write_text(curve_plot.plot(series))


if __name__ == "__main__":
    measure.run_script(main)
