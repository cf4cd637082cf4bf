#!/usr/bin/env python3
"""What each part of the packers is worth: `wrapatlas bench` on the same charts with one thing changed
at a time, in the square; mean efficiency and time as Markdown tables. Charts of bare meshes are best
made once (`wrapatlas bench DIR -o r --paper`, then r/charts/*.obj). Progress goes to stderr."""

import argparse
import csv
import pathlib
import statistics
import sys
import tempfile

import measure

PAPER = ["--paper", "--aspect", "square", "--methods", "modulo"]
SAFE = ["--methods", "modulo"]


def guided(times, *more):
    return ["--methods", "guided", "--times", times, *more]


# Title, [(name, options of bench)]; the first of each is what the others are held against.
TABLES = {
    "modulo in the paper's setting": [
        ("as printed", PAPER),
        ("scale search from u = 1.0", [*PAPER, "--scale-start", "1"]),
        ("no wrap", [*PAPER, "--wrap", "none"]),
        ("wrap along u alone", [*PAPER, "--wrap", "u"]),
        ("outer strategies alone (Figure 5)", [*PAPER, "--no-inner"]),
        ("inner ones not favoured, lambda 1.0 (Figure 6)", [*PAPER, "--lambda", "1"]),
        ("lambda 1.5", [*PAPER, "--lambda", "1.5"]),
        ("4 rotations", [*PAPER, "--rotations", "4"]),
        ("64 rotations", [*PAPER, "--rotations", "64"]),
        ("angles from the smallest box", [*PAPER, "--rotation-base", "box"]),
    ],
    "Grid of 4096 / factor cells for a texture of 4096, by cell centres": [
        (f"factor {factor}", [*PAPER, "--resolution", "4096", "--grid", str(4096 // factor)])
        for factor in (16, 4, 8, 32)],
    "The same, safe (conservative coverage, no padding)": [
        (f"factor {factor}", [*SAFE, "--resolution", "4096", "--padding", "0", "--grid",
                              str(4096 // factor)]) for factor in (16, 4, 8, 32)],
    "Safe packing at 1024, padding 4": [
        ("modulo, horizons", SAFE),
        ("modulo, no wrap", [*SAFE, "--wrap", "none"]),
        ("guided, until it is stuck once (0 s)", guided("0")),
        ("guided, 0 s, no wrap", guided("0", "--wrap", "none")),
        ("guided, 0 s, 4 rotations in best fit", guided("0", "--rotations", "4")),
        ("guided, 0 s, 64 rotations in best fit", guided("0", "--rotations", "64")),
        ("guided, 1 s", guided("1")),
        ("guided, 1 s, no wrap", guided("1", "--wrap", "none")),
        ("guided, 10 s", guided("10")),
        ("guided, 10 s, no wrap", guided("10", "--wrap", "none")),
    ],
}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+", type=pathlib.Path, help="models with UVs")
    measure.add_options(parser)
    parser.add_argument("--guided-stride", type=int, default=4,
                        help="the table with guided takes every so many files; default 4")
    parser.add_argument("--only", default="", help="the tables whose title has this in it")
    options = parser.parse_args()
    options.tables = {title: rows for title, rows in TABLES.items() if options.only in title}
    if not options.tables:
        parser.error(f"no table has {options.only!r} in its title: {'; '.join(TABLES)}")
    return options


def measured(options, files, more, folder):
    """Rows of runs.csv."""
    measure.run([options.wrapatlas, "bench", *map(str, files), "-o", str(folder), "--threads",
                 options.threads, "--quiet", *more], " ".join(more))
    with open(folder / "runs.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    failed = [row for row in rows if row["error"]]
    if failed:
        raise measure.Failure(f"{failed[0]['mesh']}: {failed[0]['error']}")
    return {row["mesh"]: row for row in rows}


def main():
    options = arguments()
    measure.print_origin(options, f"guided stride {options.guided_stride}; resolution and padding "
                         "as each table says")
    for title, variants in options.tables.items():
        files = options.files
        if any("guided" in more for _, more in variants):
            files = files[::options.guided_stride]
        lines, first = [], None
        for name, more in variants:
            measure.progress(f"{title}: {name}")
            with tempfile.TemporaryDirectory(prefix="wrapatlas_ablation") as folder:
                rows = measured(options, files, more, pathlib.Path(folder) / "r")
            efficiency = {mesh: float(row["efficiency"]) for mesh, row in rows.items()}
            first = first or efficiency
            lines.append([
                name, f"{statistics.mean(efficiency.values()):.3f}",
                f"{100 * statistics.mean(efficiency[m] - first[m] for m in first):+.1f}",
                f"{sum(efficiency[m] > first[m] + measure.TIE for m in first)}/"
                f"{sum(efficiency[m] < first[m] - measure.TIE for m in first)}",
                f"{statistics.median(float(row['seconds']) for row in rows.values()):.3f}"])
        print(f"\n### {title}: {len(files)} files\n")
        print(measure.table(["<", "mean efficiency", "points", "better / worse on", "median s"],
                            lines), flush=True)


if __name__ == "__main__":
    measure.run_script(main)
