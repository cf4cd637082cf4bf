#!/usr/bin/env python3
"""The wheel errors that `wrapatlas_bench flatten` prints, as a plot over the number of solves:
wheels.py FOLDER --svg FILE [--stride N]. Needs ./dev bench to have been run once, or its build."""

import argparse
import pathlib
import re

import log_plot
import measure


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="models, with or without UVs")
    parser.add_argument("--stride", default="1", help="take every N-th file alone")
    parser.add_argument("--bench", default=str(measure.REPOSITORY /
                                               "build/release/bench/wrapatlas_bench"))
    parser.add_argument("--svg", type=pathlib.Path, required=True)
    options = parser.parse_args()
    text = measure.run([options.bench, "flatten", options.folder, "--stride", options.stride],
                       "wrapatlas_bench", None)
    print(text, end="")
    series = {"largest": [], "median of charts": []}
    for solves, median, largest in re.findall(r"labf, (\d) solves?.*?(\S+e-?\+?\d+)\s+(\S+e\S+)",
                                              text):
        series["largest"].append((int(solves), float(largest)))
        series["median of charts"].append((int(solves), float(median)))
    options.svg.write_text(log_plot.plot("Largest wheel error of a chart", "solves", series,
                                         logarithmic_across=False))


if __name__ == "__main__":
    measure.run_script(main)
