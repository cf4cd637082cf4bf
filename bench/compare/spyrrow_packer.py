"""The strip packer `sparrow` on the outlines of an OBJ's charts, by PyPI's `spyrrow`.

It packs polygons, at any angle, into a strip of fixed height that is as short as it can make it. The
page is a square, so the height is sought at which the strip is no longer than high: each try has an
equal part of the time. A chart is its longest outline: holes are filled, and parts of a chart that
only touch are lost, so charts of several outlines make it fail. Separation of items is its own
option; the strip's ends and sides owe none."""

import math
import time

import numpy
import spyrrow

TRIES = 5
LATER_TRIES = 3  # where those found no square


def outline_of(charts, triangles):
    """The vertices of the one loop of edges that are of one triangle alone, or the longest of it."""
    uses = {}
    for a, b, c in triangles:
        for edge in ((a, b), (b, c), (c, a)):
            uses[edge] = uses.get(edge, 0) + 1
    after = {}
    for (a, b), count in uses.items():
        if count > uses.get((b, a), 0):
            after.setdefault(a, []).append(b)
    loops = []
    while after:
        start = next(iter(after))
        loop, at = [], start
        while at in after:
            loop.append(at)
            following = after[at].pop()
            if not after[at]:
                del after[at]
            at = following
        loops.append(loop)
    return max(loops, key=lambda loop: abs(area_of(charts.uvs[loop])))


def area_of(points):
    x, y = points[:, 0], points[:, 1]
    return 0.5 * float(x @ numpy.roll(y, -1) - numpy.roll(x, -1) @ y)


def pack(charts, padding, seconds=20.0, seed=0, threads=2, **_):
    """(UVs, None, seconds of all tries, seconds of the one that is given)."""
    outlines = []
    for chart in range(len(charts.areas)):
        outline = outline_of(charts, charts.triangles[charts.materials[:, 0] == chart].tolist())
        points = charts.uvs[outline]
        outlines.append(points if area_of(points) > 0 else points[::-1])
    side = charts.resolution / math.sqrt(0.75)
    best, total = None, 0.0
    low, high = charts.resolution, 4.0 * charts.resolution
    for number in range(TRIES + LATER_TRIES):
        if best is not None and number >= TRIES:
            break
        begin = time.monotonic()
        solution = solved_or_none(outlines, side, padding * side / charts.resolution,
                                  seconds / TRIES, seed, threads)
        took = time.monotonic() - begin
        total += took
        if solution is None:
            low, side = side, 1.3 * side
            continue
        if solution.width <= side:
            high = min(high, side)
            best = (solution, side, took)
        else:
            low = max(low, side)
        # The strip's area changes little with its height: aim at where it would be a square, and a
        # little above while there is none.
        aim = math.sqrt(solution.width * side) * (1 if best is not None else 1.01)
        side = aim if low < aim < high else (low + high) / 2
        if high - low < 1e-3 * high:
            break
    if best is None:
        raise ValueError("no square was found")
    return placed_uvs(charts, *best[:2]), None, total, best[2]


def solved_or_none(outlines, height, *more):
    """None where a chart is longer than the strip is high: then the program panics."""
    try:
        return solved(outlines, height, *more)
    except BaseException as panic:  # pyo3's PanicException is no Exception
        if type(panic).__name__ != "PanicException":
            raise
        return None


def solved(outlines, height, separation, seconds, seed, threads):
    items = [spyrrow.Item(str(number), [tuple(p) for p in points.tolist()], demand=1, allowed_orientations=None)
             for number, points in enumerate(outlines)]
    instance = spyrrow.StripPackingInstance("charts", strip_height=height, items=items)
    config = spyrrow.StripPackingConfig(
        early_termination=True, total_computation_time=max(1, round(seconds)), seed=seed,
        num_workers=threads, min_items_separation=separation)
    return instance.solve(config)


def placed_uvs(charts, solution, side):
    placed = numpy.full(charts.uvs.shape, numpy.nan)
    for item in solution.placed_items:
        of_chart = numpy.unique(charts.triangles[charts.materials[:, 0] == int(item.id)])
        angle = math.radians(item.rotation)
        turn = numpy.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
        placed[of_chart] = (charts.uvs[of_chart] @ turn + numpy.array(item.translation)) / side
    return placed
