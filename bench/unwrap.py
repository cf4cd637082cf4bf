#!/usr/bin/env python3
"""Unwraps bare meshes (OBJ, OFF) and measures the results without the program's help: charts, their
stretch, seams, seconds by stage, as Markdown tables; with --xatlas beside xatlas on the same
meshes.

Held against wrapatlas, on every file: the mesh is the same but for its UVs, every face has them,
each chart is a disc, is stretched by no more than --max-stretch (L2), has no flipped triangle and
does not overlap itself, the report agrees with what is measured, `wrapatlas check` finds nothing.
What breaks is named, and gives exit status 1 after all files are done. unwrap_measures.py says
how it is measured. Needs numpy; for --xatlas also PyPI's `xatlas` (compare/README.md). Progress
goes to stderr.
"""

import argparse
import pathlib
import shlex
import sys
import tempfile

import measure

try:
    import unwrap_runs
    import unwrap_tables
except ImportError as error:
    sys.exit(f"unwrap.py: {error}; it needs numpy")

# psb files by the numbers they have: the last of each kind.
PSB = {20: "human", 40: "cup", 60: "glasses", 80: "airplane", 100: "ant", 120: "chair",
       140: "octopus", 160: "table", 180: "teddy", 200: "hand", 220: "plier", 240: "fish",
       260: "bird", 300: "armadillo", 320: "bust", 340: "mechanical part", 360: "bearing",
       380: "vase", 400: "four-legged"}

LEGEND = """
Stretch: Sander et al. 2001, of a chart; its two areas made equal, so that 1 is an isometry.
Angle: mean of (s/t + t/s)/2 for the singular values s and t of each triangle's map; 1 is
conformal. Border: length of all seams in space, each once, over the root of the area. In use:
share of the atlas that charts cover. Segment has flatten in it, whose own seconds are summed
over threads. If cut otherwise: polygons with a flipped triangle when they are cut by other
diagonals, as a viewer may. Folded: faces with a position twice, in no chart that is measured.
Thin: triangles no higher than what 32-bit floats on the atlas round to, left out of stretch;
touches: places where a border meets itself no deeper than that."""


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=pathlib.Path,
                        help="OBJ or OFF; those of a folder `psb` are grouped by kind")
    measure.add_options(parser)
    parser.add_argument("--max-stretch", type=float, default=2.0, help="of wrapatlas; default 2")
    parser.add_argument("--time", default="1", help="of packing, seconds; default 1")
    parser.add_argument("--limit", type=float, default=600.0,
                        help="seconds that a mesh may take; default 600")
    parser.add_argument("--extra", default="", help="further arguments of wrapatlas unwrap")
    parser.add_argument("--xatlas", action="store_true", help="measure xatlas too")
    parser.add_argument("--csv", type=pathlib.Path, help="also write every number to this file")
    options = parser.parse_args()
    missing = [str(path) for path in options.files if not path.exists()]
    if missing:
        parser.error(f"no such file: {missing[0]}")
    if options.xatlas and not unwrap_runs.has_xatlas():
        parser.error("there is no xatlas in this Python; see compare/README.md")
    return options


def group(path):
    """A kind of psb's meshes, or else the name of the file."""
    if path.resolve().parent.name == "psb" and path.stem.isdigit():
        return "psb " + next((kind for last, kind in PSB.items() if int(path.stem) <= last), "?")
    return path.stem


def in_order(path):
    return (path.parent, int(path.stem) if path.stem.isdigit() else -1, path.stem)


def measure_all(options):
    rows, files = [], sorted(options.files, key=in_order)
    more = ["--time", options.time, *shlex.split(options.extra)]
    with tempfile.TemporaryDirectory(prefix="wrapatlas_unwrap") as folder:
        for number, path in enumerate(files, 1):
            rows.append(unwrap_runs.by_wrapatlas(options, group(path), path, folder, more))
            report(f"[{number}/{len(files)}]", rows[-1])
            if options.xatlas:
                rows.append(unwrap_runs.by_xatlas(options, group(path), path, folder))
                report(f"[{number}/{len(files)}]", rows[-1])
            if options.csv:  # at once, so that an interrupted run leaves its numbers
                measure.write_csv(options.csv, rows)
    return rows


def report(count, row):
    result = f"{row.charts} charts, {row.total:.2f} s" if row.charts else "no result"
    measure.progress(f"{count} {row.file} {row.method}: {result}{row.failed and ': ' + row.failed}")


def print_failures(rows):
    """False if wrapatlas broke something."""
    ours = [row for row in rows if row.failed and row.method == "wrapatlas"]
    theirs = [row for row in rows if row.failed and row.method != "wrapatlas"]
    files = len({row.file for row in rows})
    print(f"\n### Files on which wrapatlas breaks a promise: {len(ours)} of {files}\n")
    for row in ours:
        print(f"- {row.file}: {row.failed}")
    if theirs:
        print("\n### Files without a result of xatlas\n")
        for row in theirs:
            print(f"- {row.file}: {row.failed.splitlines()[0]}")
    return not ours


def main():
    options = arguments()
    measure.print_origin(options, f"max-stretch {options.max_stretch:g}, time {options.time}, "
                         f"limit {options.limit:g} s, extra '{options.extra}'")
    rows = measure_all(options)
    print(LEGEND)
    unwrap_tables.print_all(rows)
    if not print_failures(rows):
        sys.exit(1)


if __name__ == "__main__":
    measure.run_script(main)
