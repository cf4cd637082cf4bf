"""xatlas' packer on the charts of an OBJ, by PyPI's `xatlas`: the charts go in as they are
(add_uv_mesh: no segmentation, no parametrization), the largest scale that fits on one page is
searched, and the result is written as the same OBJ with other UVs.

What xatlas does, from its source (version 0.0.11 of the binding):
- Padding: each chart is rasterized conservatively and dilated by `padding` texels, and the dilated
  images must not meet. Two charts are thus 2 x padding texels apart; the half of what is wanted is
  right. Its `bilinear` would add about another texel to each chart; it is off.
- Border: charts may reach the border of the page, to half a texel.
- Charts are stretched along both axes of their box to whole texels (always up).
- A chart that is longer than the page is shrunk on its own; that does not count as fitting.
- A chart is turned into its box and by a swap of x and y, which mirrors it.
- Faces without area are left out.
"""

import math
import time

import numpy
import xatlas


def packed(charts, scale, padding, brute_force):
    """(UVs in [0, 1], seconds), or (None, seconds) where the charts do not fit at the scale."""
    options = xatlas.PackOptions()
    options.resolution, options.texels_per_unit = charts.resolution, scale
    options.padding, options.bilinear = math.ceil(padding / 2), False
    options.bruteForce, options.create_image = brute_force, False
    atlas = xatlas.Atlas()
    # Materials keep charts that overlap or touch in the input apart.
    atlas.add_uv_mesh(charts.uvs.astype(numpy.float32), charts.triangles, charts.materials)
    begin = time.monotonic()
    atlas.generate(xatlas.ChartOptions(), options)
    seconds = time.monotonic() - begin
    if atlas.atlas_count != 1:
        return None, seconds
    source, _, uvs = atlas.get_mesh(0)
    placed = numpy.full((len(charts.uvs), 2), numpy.nan)
    placed[source] = uvs
    # Stretching only makes charts larger; one that is smaller was shrunk to fit the page.
    areas = charts.areas_of(placed) * charts.resolution ** 2
    if (areas < charts.areas * scale ** 2 * 0.999 - 0.01).any():
        return None, seconds
    return placed, seconds


def pack(charts, padding, precision, brute_force=False, **_):
    """The densest packing on one page, by bisection over the scale.

    Gives (UVs, scale, seconds of all tries, seconds of the one that is given)."""
    best, best_scale, best_seconds, total = None, 0.0, 0.0, 0.0
    low, high = 0.0, 1.0  # at 1 the charts would fill the page
    while best is None or high - low > precision * low:
        scale = (low + high) / 2
        if scale < 1e-3:
            raise ValueError("does not fit at any scale")
        placed, seconds = packed(charts, scale, padding, brute_force)
        total += seconds
        if placed is None:
            high = scale
        else:
            low, best, best_scale, best_seconds = scale, placed, scale, seconds
    return best, best_scale, total, best_seconds
