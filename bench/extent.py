#!/usr/bin/env python3
"""What shorter charts bring: unwraps meshes with several --max-extent, with wrap and without.

Every atlas is checked by `wrapatlas unwrap` before it is written. Border: the length of all seams in
space, each once, over the root of the area; a mean over the files, as the other numbers.
"""

import argparse
import json
import math
import pathlib
import statistics
import subprocess
import tempfile

import measure


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="+", type=pathlib.Path, help="meshes")
    measure.add_options(parser)
    parser.add_argument("--extents", default="0,1.5,1.25,1,0.8,0.6",
                        help="of --max-extent; default 0,1.5,1.25,1,0.8,0.6")
    parser.add_argument("--time", default="1", help="of packing, seconds; default 1")
    return parser.parse_args()


def unwrapped(options, file, extent, wrap, folder):
    report = folder / "report.json"
    subprocess.run([options.wrapatlas, "unwrap", file, "-o", folder / "out.obj", "--quiet", "--json",
                    report, "--max-extent", extent, "--wrap", wrap, "--time", options.time,
                    "--resolution", options.resolution, "--padding", options.padding, "--threads",
                    options.threads], check=True)
    return json.loads(report.read_text())


def border_of(report):
    area = sum(chart["area"] for chart in report["unwrapped"])
    return sum(chart["border_length"] for chart in report["unwrapped"]) / 2 / math.sqrt(area)


def main():
    options = arguments()
    measure.print_origin(options, f"time {options.time}")
    print(f"\n{len(options.files)} meshes:\n")
    print("| --max-extent | charts, mean | median | border | in use, no wrap | min | in use, wrap uv "
          "| min |\n|---:|---:|---:|---:|---:|---:|---:|---:|")
    with tempfile.TemporaryDirectory() as name:
        for extent in options.extents.split(","):
            reports = {wrap: [unwrapped(options, file, extent, wrap, pathlib.Path(name))
                              for file in options.files] for wrap in ("none", "uv")}
            charts = [len(report["unwrapped"]) for report in reports["uv"]]
            used = [[report["efficiency"] for report in reports[wrap]] for wrap in ("none", "uv")]
            print(f"| {extent} | {statistics.mean(charts):.1f} | {statistics.median(charts):g} | "
                  f"{statistics.mean(map(border_of, reports['uv'])):.2f} | "
                  + " | ".join(f"{statistics.mean(values):.3f} | {min(values):.3f}"
                               for values in used) + " |", flush=True)


if __name__ == "__main__":
    main()
