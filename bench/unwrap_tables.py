"""The tables of unwrap.py."""

import statistics

import measure
from unwrap_runs import STAGES

QUALITY = ["<", "<method", "files", "faces, median", "charts: min", "median", "max", "L2: median",
           "max", "L∞: median", "max", "angle, mean", "border, median", "in use, mean"]
BROKEN = ["<", "<method", "no result", "charts that are no discs", "that overlap themselves",
          "triangles flipped", "if cut otherwise", "collapsed", "without UVs", "folded", "thin",
          "of these flipped", "deepest, texels", "touches", "deepest, texels "]


def known(rows, name):
    return [getattr(row, name) for row in rows if getattr(row, name) is not None]


def cell(function, values, form):
    return format(function(values), form) if values else ""


def quality(label, rows):
    def of(name, function, form):
        return cell(function, known(rows, name), form)

    return [label, rows[0].method, len(rows), of("faces", statistics.median, ".0f"),
            of("charts", min, ""), of("charts", statistics.median, "g"), of("charts", max, ""),
            of("l2", statistics.median, ".3f"), of("l2", max, ".3f"),
            of("linf", statistics.median, ".1f"), of("linf", max, ".1f"),
            of("angle", statistics.mean, ".4f"), of("boundary", statistics.median, ".2f"),
            of("efficiency", statistics.mean, ".3f")]


def times(label, rows):
    cells = []
    for stage in STAGES:
        seconds = known(rows, stage)
        cells.append(seconds and f"{statistics.median(seconds):.2f} / {max(seconds):.2f}" or "")
    return [label, rows[0].method, len(known(rows, "total")), *cells,
            cell(max, known(rows, "megabytes"), ".0f")]


def broken(label, rows):
    sums = ["not_discs", "crossing_charts", "flipped", "otherwise_flipped", "collapsed",
            "left_out", "folded", "thin", "thin_flipped"]
    return [label, rows[0].method, sum(row.charts is None for row in rows),
            *(sum(known(rows, name)) for name in sums),
            cell(max, known(rows, "thin_depth"), ".2g"), sum(known(rows, "touches")),
            cell(max, known(rows, "touch_depth"), ".2g")]


def sections(rows):
    """Yields (label, rows of one method): each group, then all of psb, then all."""
    together = [(name, [row for row in rows if row.group == name])
                for name in dict.fromkeys(row.group for row in rows)]
    psb = [row for row in rows if row.group.startswith("psb ")]
    if psb and len(psb) < len(rows):
        together.append(("**all of psb**", psb))
    if len(together) > 1:
        together.append(("**all**", rows))
    for label, group in together:
        for method in dict.fromkeys(row.method for row in group):
            yield label, [row for row in group if row.method == method]


def print_all(rows):
    parts = list(sections(rows))
    print("\n### Charts and their distortion\n")
    print(measure.table(QUALITY, [quality(*part) for part in parts]))
    print("\n### Seconds, median / max\n")
    titles = ["<", "<method", "files", *STAGES, "MiB, max"]
    print(measure.table(titles, [times(*part) for part in parts]))
    print("\n### What is broken, and what is rounding\n")
    print(measure.table(BROKEN, [broken(*part) for part in parts]))
