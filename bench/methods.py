#!/usr/bin/env python3
"""Compares the packing methods over model files: efficiency and time, as Markdown tables.

Every packing is checked by `wrapatlas check` against its source; the first that fails ends the
comparison with exit status 1. Progress goes to stderr.
"""

import argparse
import collections
import pathlib
import shlex
import statistics
import sys
import tempfile

import measure

Method = collections.namedtuple("Method", "name method wrap")
METHODS = [
    Method("lprm02", "lprm02", "none"),
    Method("swg03", "swg03", "none"),
    Method("zsgs04", "zsgs04", "none"),
    Method("modulo, no wrap", "modulo", "none"),
    Method("modulo, wrap uv", "modulo", "uv"),
]
Row = collections.namedtuple("Row", "group file method charts efficiency pack total")


def default_files():
    """(group, file) of the data beside the repository, or else of the samples."""
    files = [(path.parent.name, path) for path in sorted(measure.CHARTS.glob("*/*.obj"))]
    models = [measure.CHARTS.parent / "models" / name for name in ("spot.obj", "beast.obj")]
    files += [("models", path) for path in models if path.exists()]
    if not files:
        files = [("samples", measure.REPOSITORY / "samples" / name)
                 for name in ("coral.glb", "machine.obj", "mosaic.ply")]
    return files


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="*", type=pathlib.Path,
                        help="models with UVs, grouped by their folder; default: the data beside "
                        "the repository, else the samples")
    measure.add_options(parser, threads="1")
    parser.add_argument("--csv", type=pathlib.Path, help="also write every number to this file")
    parser.add_argument("--guided", metavar="SECONDS",
                        help="also measure guided with this --time, without wrap and with")
    parser.add_argument("--aspect", metavar="square|W:H|search|pow2",
                        help="shape of the atlas, for all methods; default: as --resolution says")
    parser.add_argument("--extra", default="",
                        help="further arguments of wrapatlas pack for the paper's methods")
    options = parser.parse_args()
    options.methods = list(METHODS)
    if options.guided is not None:
        options.methods += [Method(f"guided {options.guided} s, {name}", "guided", wrap)
                            for name, wrap in (("no wrap", "none"), ("wrap uv", "uv"))]
    if options.files:
        options.inputs = [(path.resolve().parent.name, path) for path in options.files]
    else:
        options.inputs = default_files()
    return options


def own_options(method, options):
    own = ["--time", options.guided] if method.method == "guided" else shlex.split(options.extra)
    return [*(["--aspect", options.aspect] if options.aspect else []), *own]


def measured(group, path, method, options, folder):
    """The row of numbers of one file packed by one method."""
    report = measure.pack(options, path, folder, method.method, method.wrap,
                          f"{path}: {method.name}", own_options(method, options))
    seconds = report["seconds"]
    return Row(group, str(path), method.name, report["charts"], report["efficiency"],
               seconds["pack"], seconds["total"])


def measure_all(options):
    rows, jobs = [], len(options.inputs) * len(options.methods)
    with tempfile.TemporaryDirectory(prefix="wrapatlas_methods") as folder:
        for group, path in options.inputs:
            for method in options.methods:
                measure.progress(f"[{len(rows) + 1}/{jobs}] {path} {method.name}")
                rows.append(measured(group, path, method, options, folder))
    return rows


def by_file(rows):
    files = {}
    for row in rows:
        files.setdefault(row.file, {})[row.method] = row
    return files


def is_best(row, of_file):
    return row.efficiency >= max(other.efficiency for other in of_file.values()) - measure.TIE


def print_group(title, rows, methods):
    files, lines = by_file(rows), []
    for method in methods:
        mine = [row for row in rows if row.method == method.name]
        efficiency = [row.efficiency for row in mine]
        best = sum(is_best(row, files[row.file]) for row in mine)
        lines.append([method.name, f"{statistics.mean(efficiency):.3f}", f"{min(efficiency):.3f}",
                      f"{max(efficiency):.3f}", f"{100 * best / len(mine):.0f} %",
                      f"{statistics.median(row.pack for row in mine):.3f}",
                      f"{statistics.median(row.total for row in mine):.3f}"])
    print(f"\n### {title}\n")
    print(measure.table(["<method", "mean", "min", "max", "best on", "pack, median s",
                         "total, median s"], lines))


def print_defeats(rows, methods):
    ours = methods[-1]
    lost = [(file, of_file) for file, of_file in by_file(rows).items()
            if not is_best(of_file[ours.name], of_file)]
    print(f"\n### Files on which {ours.name} is not the best: {len(lost)}\n")
    if not lost:
        return
    lines = [[file, of_file[ours.name].charts,
              *(f"{of_file[method.name].efficiency:.4f}" for method in methods)]
             for file, of_file in lost]
    print(measure.table(["<file", "charts", *(method.name for method in methods)], lines))


def main():
    options = arguments()
    missing = [str(path) for _, path in options.inputs if not path.exists()]
    if missing:
        sys.exit(f"methods.py: no such file: {missing[0]}")
    measure.print_origin(options, f"aspect {options.aspect}, extra '{options.extra}'")
    rows = measure_all(options)
    print("\nEfficiency: share of the atlas that charts cover, exact areas. Best on: share of the "
          "files; of equals, each counts.\nEvery packing passed `wrapatlas check`.")
    groups = list(measure.by_group(rows))
    if len(groups) > 1:
        groups.append((measure.title("all", rows), rows))
    for title, group in groups:
        print_group(title, group, options.methods)
    print_defeats(rows, options.methods)
    if options.csv:
        measure.write_csv(options.csv, rows)


if __name__ == "__main__":
    measure.run_script(main)
