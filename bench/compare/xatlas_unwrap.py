#!/usr/bin/env python3
"""Cuts, flattens and packs one mesh with xatlas (PyPI), at its own defaults, in a process of its
own, so that it can be given a limit: xatlas_unwrap.py IN.npz OUT.npz.

IN: `positions` (32-bit floats), `triangles`. OUT: `uvs`, a row of (u, v) for each corner, in [0,
1]; `placed`, per triangle whether it is in a chart (xatlas leaves out those it finds degenerate);
`size`, texels of the atlas; `charts`; `seconds` without files; `megabytes`, the peak of the
process.
"""

import pathlib
import sys
import time

import numpy
import xatlas


def own_peak():
    """MiB of this process; what getrusage() says begins with the peak of its parent."""
    for line in pathlib.Path("/proc/self/status").read_text().splitlines():
        if line.startswith("VmHWM:"):
            return float(line.split()[1]) / 1024
    return 0.0


def unwrapped(positions, triangles):
    """As xatlas.parametrize(), which does not tell the size of the atlas; stretch needs it."""
    atlas = xatlas.Atlas()
    begin = time.monotonic()
    atlas.add_mesh(positions, triangles)
    atlas.generate()
    seconds = time.monotonic() - begin
    source, indices, uvs = atlas.get_mesh(0)
    if (source[indices] != triangles).any():
        raise ValueError("xatlas changed the order of the triangles")
    placed = numpy.zeros(len(triangles), dtype=bool)
    for chart in range(atlas.get_mesh_chart_count(0)):
        placed[list(atlas.get_mesh_chart(0, chart).faces)] = True
    return {"uvs": uvs[indices.ravel()], "placed": placed, "size": [atlas.width, atlas.height],
            "charts": atlas.chart_count, "seconds": seconds, "megabytes": own_peak()}


if __name__ == "__main__":
    data = numpy.load(sys.argv[1])
    numpy.savez(sys.argv[2], **unwrapped(data["positions"], data["triangles"]))
