#!/usr/bin/env python3
"""Makes the sample models of this folder: make_samples.py [FOLDER]

Python's standard library alone; the same bytes on every run. Coordinates are rounded before they
are written, so that the last bit of a machine's sine does not show. How each model is made, and
what it is for, stands in README.md.
"""

import pathlib
import sys

from makers import files
from makers.coral import make_coral
from makers.knot import make_knot
from makers.machine import make_machine
from makers.mosaic import make_mosaic


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
    makers = {
        "coral.glb": lambda: files.glb_bytes("coral", *make_coral()),
        "machine.obj": lambda: files.obj_bytes("machine.mtl", *make_machine()),
        "machine.mtl": files.mtl_bytes,
        "mosaic.ply": lambda: files.ply_bytes(*make_mosaic()),
        "knot.off": lambda: files.off_bytes(*make_knot()),
    }
    for name, make in makers.items():
        (folder / name).write_bytes(make())


if __name__ == "__main__":
    main()
