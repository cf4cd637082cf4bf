#!/usr/bin/env python3
"""Compares the packing methods over model files: efficiency and time, as Markdown tables.

Every packing is checked by `wrapatlas check` against its source; the first that fails ends the
comparison with exit status 1. Progress goes to stderr.
"""

import argparse
import collections
import csv
import json
import os
import pathlib
import platform
import shlex
import statistics
import subprocess
import sys
import tempfile

REPOSITORY = pathlib.Path(__file__).resolve().parents[1]
TIE = 1e-9  # efficiencies closer than this are equal

Method = collections.namedtuple("Method", "name method wrap")
METHODS = [
    Method("lprm02", "lprm02", "none"),
    Method("swg03", "swg03", "none"),
    Method("zsgs04", "zsgs04", "none"),
    Method("modulo, no wrap", "modulo", "none"),
    Method("modulo, wrap uv", "modulo", "uv"),
]
Row = collections.namedtuple("Row", "group file method charts efficiency pack total")


class Failure(Exception):
    """A packing or its check went wrong."""


def default_files():
    """(group, file) of the data beside the repository, or else of the samples."""
    data = REPOSITORY.parent / "shared" / "data"
    files = [(path.parent.name, path) for path in sorted(data.glob("charts/*/*.obj"))]
    models = [data / "models" / name for name in ("spot.obj", "beast.obj")]
    files += [("models", path) for path in models if path.exists()]
    if not files:
        files = [("samples", REPOSITORY / "samples" / name)
                 for name in ("coral.glb", "machine.obj", "mosaic.ply")]
    return files


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="*", type=pathlib.Path,
                        help="models with UVs, grouped by their folder; default: the data beside "
                        "the repository, else the samples")
    parser.add_argument("--resolution", default="1024")
    parser.add_argument("--padding", default="2")
    parser.add_argument("--threads", default="1")
    parser.add_argument("--csv", type=pathlib.Path, help="also write every number to this file")
    parser.add_argument("--guided", metavar="SECONDS",
                        help="also measure guided with this --time, without wrap and with")
    parser.add_argument("--extra", default="", help="further arguments of wrapatlas pack")
    parser.add_argument("--wrapatlas", default=os.environ.get(
        "WRAPATLAS", str(REPOSITORY / "build/release/cli/wrapatlas")), help="the command to run")
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


def machine():
    name = platform.processor() or platform.machine()
    try:
        lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
        name = next(line.split(": ", 1)[1] for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    return f"{name}, {os.cpu_count()} cores"


def commit():
    command = ["git", "-C", str(REPOSITORY), "describe", "--always", "--dirty", "--abbrev=10"]
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def run(command, what):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise Failure(f"{what}: exit status {done.returncode} of {shlex.join(command)}\n"
                      f"{done.stderr.strip()}")
    return done.stdout


def own_options(method, options):
    if method.method == "guided":
        return ["--time", options.guided]
    return shlex.split(options.extra)


def measure(group, path, method, options, folder):
    """Packs one file by one method, checks the result, and gives the row of numbers."""
    what = f"{path}: {method.name}"
    ending = path.suffix if path.suffix.lower() not in (".off", ".stl") else ".obj"
    packed = str(pathlib.Path(folder) / ("packed" + ending))
    report = json.loads(run(
        [options.wrapatlas, "pack", str(path), "-o", packed, "--method", method.method,
         "--wrap", method.wrap, "--resolution", options.resolution, "--padding", options.padding,
         "--threads", options.threads, "--json", "-", *own_options(method, options)], what))
    # The atlas may have another shape than asked for, where its aspect was searched.
    run([options.wrapatlas, "check", packed, "--ref", str(path),
         "--resolution", f"{report['width']}x{report['height']}", "--padding", options.padding,
         "--wrap", method.wrap, "--threads", options.threads], what)
    seconds = report["seconds"]
    return Row(group, str(path), method.name, report["charts"], report["efficiency"],
               seconds["pack"], seconds["total"])


def measure_all(options):
    rows, jobs = [], len(options.inputs) * len(options.methods)
    with tempfile.TemporaryDirectory(prefix="wrapatlas_methods") as folder:
        for group, path in options.inputs:
            for method in options.methods:
                print(f"[{len(rows) + 1}/{jobs}] {path} {method.name}", file=sys.stderr)
                rows.append(measure(group, path, method, options, folder))
    return rows


def by_file(rows):
    files = {}
    for row in rows:
        files.setdefault(row.file, {})[row.method] = row
    return files


def is_best(row, of_file):
    return row.efficiency >= max(other.efficiency for other in of_file.values()) - TIE


def print_group(name, rows, methods):
    files = by_file(rows)
    print(f"\n### {name}: {len(files)} {'file' if len(files) == 1 else 'files'}\n")
    print("| method | mean | min | max | best on | pack, median s | total, median s |")
    print("|---|---:|---:|---:|---:|---:|---:|")
    for method in methods:
        mine = [row for row in rows if row.method == method.name]
        efficiency = [row.efficiency for row in mine]
        best = sum(is_best(row, files[row.file]) for row in mine)
        print(f"| {method.name} | {statistics.mean(efficiency):.3f} | {min(efficiency):.3f} "
              f"| {max(efficiency):.3f} | {100 * best / len(mine):.0f} % "
              f"| {statistics.median(row.pack for row in mine):.3f} "
              f"| {statistics.median(row.total for row in mine):.3f} |")


def print_defeats(rows, methods):
    ours = methods[-1]
    lost = [(file, of_file) for file, of_file in by_file(rows).items()
            if not is_best(of_file[ours.name], of_file)]
    print(f"\n### Files on which {ours.name} is not the best: {len(lost)}\n")
    if not lost:
        return
    print("| file | charts | " + " | ".join(method.name for method in methods) + " |")
    print("|---|---:|" + "---:|" * len(methods))
    for file, of_file in lost:
        numbers = [f"{of_file[method.name].efficiency:.4f}" for method in methods]
        print(f"| {file} | {of_file[ours.name].charts} | " + " | ".join(numbers) + " |")


def main():
    options = arguments()
    missing = [str(path) for _, path in options.inputs if not path.exists()]
    if missing:
        sys.exit(f"methods.py: no such file: {missing[0]}")
    print(f"machine: {machine()}; commit: {commit()}; options: resolution {options.resolution}, "
          f"padding {options.padding}, threads {options.threads}, extra '{options.extra}'; "
          f"command: {shlex.join(sys.argv)}")
    try:
        rows = measure_all(options)
    except Failure as failure:
        print(f"methods.py: {failure}", file=sys.stderr)
        sys.exit(1)
    print("\nEfficiency: share of the atlas that charts cover, exact areas. Best on: share of the "
          "files; of equals, each counts.\nEvery packing passed `wrapatlas check`.")
    groups = list(dict.fromkeys(row.group for row in rows))
    for group in groups:
        print_group(group, [row for row in rows if row.group == group], options.methods)
    if len(groups) > 1:
        print_group("all", rows, options.methods)
    print_defeats(rows, options.methods)
    if options.csv:
        with open(options.csv, "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(Row._fields)
            writer.writerows(rows)


if __name__ == "__main__":
    main()
