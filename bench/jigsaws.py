#!/usr/bin/env python3
"""Packs jigsaws (bench/jigsaw.py), whose optimum is 100 %, and prints how much `guided` gets.

Every packing is checked by `wrapatlas check`; the first that fails gives exit status 1. Progress
goes to stderr. Padding is 0 by default, because only without padding is 100 % possible.
"""

import argparse
import pathlib
import statistics
import tempfile

import jigsaw
import measure


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    measure.add_options(parser, padding="0")
    measure.add_packing_options(parser, time="20")
    parser.add_argument("--pieces", type=measure.numbers, default=[10, 30, 100],
                        help="default 10,30,100")
    parser.add_argument("--seeds", type=measure.numbers, default=[1, 2, 3], help="default 1,2,3")
    parser.add_argument("--wrap", default="uv",
                        help="uv: the torus is cut; none: the square; uv,none: both; default uv")
    parser.add_argument("--roughness", type=float, default=0.3, help="see jigsaw.py; default 0.3")
    options = parser.parse_args()
    options.wraps = options.wrap.split(",")
    if not set(options.wraps) <= {"uv", "none"}:
        parser.error("--wrap has to be uv, none, or both with a comma")
    return options


def packed(options, pieces, seed, wrap, folder):
    name = f"jigsaw-{pieces}-{seed}-{wrap}"
    source = pathlib.Path(folder) / f"{name}.obj"
    source.write_text(jigsaw.jigsaw(pieces, seed, wrap == "uv", options.roughness))
    more = measure.packing_arguments(options, name)
    # The domain is known to hold the pieces: a margin would only take the optimum away.
    return measure.pack(options, source, folder, options.method, wrap, name, more, margin="0")


def main():
    options = arguments()
    measure.print_origin(options, f"{options.method}, time {options.time}, "
                         f"roughness {options.roughness:g}, margin 0")
    rows, means = [], []
    with tempfile.TemporaryDirectory(prefix="wrapatlas_jigsaws") as folder:
        for wrap in options.wraps:
            for pieces in options.pieces:
                efficiencies = []
                for seed in options.seeds:
                    measure.progress(f"{pieces} pieces, seed {seed}, wrap {wrap}")
                    report = packed(options, pieces, seed, wrap, folder)
                    efficiencies.append(report["efficiency"])
                    rows.append([pieces, wrap, seed, f"{report['efficiency']:.3f}",
                                 f"{report['seconds']['pack']:.2f}"])
                means.append([pieces, wrap, f"{statistics.mean(efficiencies):.3f}",
                              f"{min(efficiencies):.3f}", f"{max(efficiencies):.3f}"])
    print("\nEfficiency; the optimum is 1. Every packing passed `wrapatlas check`.\n")
    print(measure.table(["pieces", "<wrap", "mean", "min", "max"], means))
    print("\n" + measure.table(["pieces", "<wrap", "seed", "efficiency", "pack, s"], rows))


if __name__ == "__main__":
    measure.run_script(main)
