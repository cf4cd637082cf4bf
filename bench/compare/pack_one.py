"""Packs one OBJ by one of the other packers: what with_others.py runs in a process of its own, since
some of them end it when they fail. Writes UVs per vertex, scale and seconds, as .npz."""

import importlib
import json
import pathlib
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from obj_charts import Charts, Obj  # noqa: E402


def main():
    path, output, options = sys.argv[1], sys.argv[2], json.loads(sys.argv[3])
    charts = Charts(Obj(path), options.pop("resolution"))
    packer = importlib.import_module(options.pop("module"))
    try:
        placed, scale, seconds, last = packer.pack(charts, **options)
    except ValueError as error:
        sys.exit(str(error))
    numpy.savez(output, placed=placed, scale=numpy.nan if scale is None else scale, seconds=seconds,
                last=last)


if __name__ == "__main__":
    main()
