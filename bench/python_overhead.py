#!/usr/bin/env python3
"""What the Python package costs beside the command: both read a mesh, unwrap it, pack it, check it and
write it, one after the other, several times. Run by a Python that has the package and numpy; the command
is the one in the package."""

import argparse
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import large_mesh

import wrapatlas

IN_PYTHON = """
import sys, wrapatlas
wrapatlas.unwrap(sys.argv[1], method="modulo", threads=int(sys.argv[3])).save(sys.argv[2])
"""


def cost(call):
    """Seconds by the clock, and of processors: on a machine that is busy the second tells more."""
    begin, before = time.monotonic(), os.times()
    call()
    return time.monotonic() - begin, sum(os.times()[:4]) - sum(before[:4])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--triangles", type=int, default=100_000, help="default 100000")
    parser.add_argument("--repeat", type=int, default=5, help="default 5")
    parser.add_argument("--threads", type=int, default=2, help="default 2")
    options = parser.parse_args()
    points, faces = large_mesh.sphere(options.triangles)
    print(f"{len(faces)} triangles, {options.threads} threads, wrapatlas {wrapatlas.__version__}, "
          f"Python {sys.version.split()[0]}, medians of {options.repeat}")
    threads = str(options.threads)
    with tempfile.TemporaryDirectory(prefix="wrapatlas_python") as folder:
        source, a, b = (str(pathlib.Path(folder) / name) for name in ("a.off", "a.obj", "b.obj"))
        large_mesh.write_off(source, points, faces)
        command = [wrapatlas.command(), "unwrap", source, "-o", a, "--method", "modulo", "--threads",
                   threads, "--quiet"]
        python = [sys.executable, "-c", IN_PYTHON, source, b, threads]
        runs = {
            "the command": lambda: subprocess.run(command, check=True),
            "a Python of its own": lambda: subprocess.run(python, check=True),
            "in a running Python": lambda: wrapatlas.unwrap(
                source, method="modulo", threads=options.threads).save(b),
            "arrays in, arrays out": lambda: wrapatlas.unwrap(points, faces, method="modulo",
                                                              threads=options.threads),
        }
        taken = {name: [] for name in runs}
        for _ in range(options.repeat):
            for name, call in runs.items():
                taken[name].append(cost(call))
        same = pathlib.Path(a).read_bytes() == pathlib.Path(b).read_bytes()
    for what, index in (("by the clock", 0), ("of processors", 1)):
        print(what)
        base = statistics.median(cost[index] for cost in taken["the command"])
        for name, costs in taken.items():
            times = [cost[index] for cost in costs]
            middle = statistics.median(times)
            print(f"  {name:22} {middle:7.2f} s  {100 * (middle / base - 1):+6.1f} %  "
                  f"({min(times):.2f} to {max(times):.2f})")
    print("the files are the same" if same else "the files differ")


if __name__ == "__main__":
    main()
