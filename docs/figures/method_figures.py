"""The placing methods at work on small grids, by slow copies of their rules."""
from math import atan2, pi

from figures.cells import (at_origin, centre_cells, hollow, lanes, shifted, swapped, turned)
from figures.svg import AMBER, BLUE, CHARTS, FAINT, GREEN, INK, Panel, RED, Svg

WIDTH, HEIGHT = 22, 16
ELL = [[(0, 0), (7, 0), (7, 2.6), (3, 2.6), (3, 7.2), (0, 7.2)]]
ARC = [[(0, 3), (2, 0.6), (6, 0), (9, 1.5), (10, 4), (7.6, 4.6), (6.4, 2.8), (3.4, 3), (2, 5.6)]]
RING = [[(1, 0), (7, 0), (8, 2), (8, 6), (6, 8), (2, 8), (0, 6), (0, 2)],
        [(2.1, 2.1), (2.1, 5.9), (5.9, 5.9), (5.9, 2.1)]]
WEDGE = [[(0, 0), (4.2, 0.4), (5, 4), (2.2, 3.2)]]
GAP, HOLLOW, BUSY = "#9ed8ae", "#fbe28a", "#b9bfc9"


def folded(cells, width=WIDTH, height=HEIGHT):
    return {(x % width, y % height) for x, y in cells}


def board():
    """A packing so far: three charts, of which two cross the border."""
    charts = [(RING, 3, 4), (ARC, 14, 5), (ELL, 9, 12)]
    return set().union(*(folded(shifted(centre_cells(c), x, y)) for c, x, y in charts))


def find_channels(cells, width, height):
    """Per column the outer and the inner channel, as src/pack/modulo.cpp reads the paper."""
    outer, inner = [], []
    for x in range(width):
        column = sorted(y for cx, y in cells if cx == x)
        if not column:
            outer.append((0, 2 * height))
            inner.append((0, 2 * height))
            continue
        first, last = column[0], column[-1]
        outer.append((last + 1, height + first))
        gaps = [(a + 1, b) for a, b in zip(column, column[1:]) if b > a + 1]
        if gaps:
            inner.append(max(gaps, key=lambda gap: gap[1] - gap[0]))
        else:
            inner.append((0, first) if first > height - last - 1 else (last + 1, height))
    return outer, inner


def rest(channel, chart, low_side, shifts):
    """(gap, shift, position) of the first shift with the least gap, or None."""
    spans, best = lanes(chart), None
    for shift in shifts:
        at = {x: channel[(shift + x) % len(channel)] for x in spans}
        lowest = max(at[x][0] - spans[x][0] for x in spans)
        highest = min(at[x][1] - 1 - spans[x][1] for x in spans)
        if lowest > highest:
            continue
        y = lowest if low_side else highest
        gap = sum(y + spans[x][0] - at[x][0] if low_side else at[x][1] - 1 - y - spans[x][1]
                  for x in spans)
        if best is None or gap < best[0]:
            best = gap, shift, y
    return best


def channels():
    svg = Svg(940, 880)
    cells, side = board(), 15
    for row, along_y in enumerate((True, False)):
        seen = cells if along_y else swapped(cells)
        width, height = (WIDTH, HEIGHT) if along_y else (HEIGHT, WIDTH)
        for name, channel in zip(("outer", "inner"), find_channels(seen, width, height)):
            beyond = 0 if name == "inner" else 7 if along_y else 10  # the border, drawn
            length = height + beyond
            x = 40 if name == "outer" else 565
            y = (80 if name == "outer" else 80 + 7 * side) if along_y else 550
            panel = Panel(svg, x, y, *((width, length) if along_y else (length, width)), side)
            draw_channel(panel, seen, channel, length, along_y)
            svg.text(x, y - 12, f"{name}: {'charts move along y' if along_y else 'charts move along x'}",
                     bold=True)
    svg.text(40, 36, "Two kinds of channels, two directions, two ends to rest against: eight "
             "strategies", size=17, bold=True)
    for i, line in enumerate((
            "Grey: the packing so far, folded into the canvas (black), light grey where it repeats. "
            "Green: the channel of each lane.",
            "Blue: a chart at rest against the lower end (normal); red: against the upper end "
            "(mirrored), each with the least gap.")):
        svg.text(40, 830 + 20 * i, line, size=13, colour="#555c68")
    return svg.document()


def draw_channel(panel, cells, channel, length, along_y):
    """Lanes are columns here; `cells` are swapped if they are rows in the drawing."""
    width, height = len(channel), HEIGHT if along_y else WIDTH
    orient = (lambda c: c) if along_y else swapped
    panel.cells(orient(cells), BUSY)
    panel.cells(orient({(x, y + height) for x, y in cells if y + height < length}), "#dde0e5")
    panel.cells(orient({(x, y) for x, (low, high) in enumerate(channel)
                        for y in range(low, min(high, length))}), "#d9f2df")
    panel.grid(colour="#eceef1")
    for turn in range(8):  # the first rotation whose two places can be told apart
        shape = at_origin(orient(centre_cells(turned(WEDGE, turn / 8))))
        placed = []
        for low_side in (True, False):
            gap, shift, position = rest(channel, shape, low_side, range(width))
            placed.append({((x + shift) % width, y + position) for x, y in shape})
        if not placed[0] & placed[1] and max(y for c in placed for _, y in c) < length:
            break
    for cells, colour in zip(placed, (BLUE, RED)):
        panel.cells(orient(cells), colour, extra='fill-opacity="0.85"')
    panel.box(0, 0, WIDTH, HEIGHT, stroke=INK, line=2)


def drop():
    """A chart dropped onto a horizon, judged without and with its own hollow."""
    svg = Svg(900, 370)
    heights = [3, 3, 4, 6, 6, 7, 4, 3, 2, 2, 2, 3, 5, 5, 6, 6, 5, 3, 1, 1]
    top = [(h, 15) for h in heights]
    chart = [[(0, 0), (5, 0), (5, 2.1), (2.2, 2.1), (2.2, 6.4), (5, 6.4), (5, 8.5), (0, 8.5)]]
    lean = atan2(8.5, 5) / (2 * pi)  # of the longest diameter
    upright = at_origin(centre_cells(turned(chart, 0.25 - lean)))
    turns = [at_origin(centre_cells(turned(chart, k / 8))) for k in range(8)]
    for i, (title, words, shapes, count_hollow) in enumerate((
            ("lprm02: one orientation", "waste = gap (green)", [upright], False),
            ("swg03: every rotation", "waste = gap (green) + hollow (yellow)", turns, True))):
        panel = Panel(svg, 40 + 430 * i, 46, 20, 14, 20)
        best = None
        for number, shape in enumerate(shapes):
            found = rest(top, shape, True, range(20 - max(x for x, _ in shape)))
            waste = found[0] + (len(hollow(shape)) if count_hollow else 0)
            if best is None or waste < best[0]:
                best = waste, shape, found
        waste, shape, (gap, shift, y) = best
        placed = shifted(shape, shift, y)
        panel.cells({(x, row) for x, h in enumerate(heights) for row in range(h)}, BUSY)
        panel.cells({(x, row) for x, (low, _) in lanes(placed).items()
                     for row in range(heights[x], low)}, GAP)
        panel.cells(hollow(placed), HOLLOW)
        panel.cells(placed, CHARTS[0])
        panel.grid()
        line = [p for x, h in enumerate(heights) for p in ((x, h), (x + 1, h))]
        panel.path(line, stroke=RED, line=3)
        panel.caption(title, [f"{words}: {waste} cells"])
    return svg.document()


def four_sides():
    svg = Svg(900, 400)
    panel = Panel(svg, 60, 56, 40, 30, 11)
    domain_w, domain_h = 24, 18
    packing = set().union(*(shifted(centre_cells(c), x, y) for c, x, y in (
        (RING, 15, 10), (ELL, 23.2, 10), (ARC, 15, 18.2))))
    left, right = min(x for x, _ in packing), max(x for x, _ in packing) + 1
    low, high = min(y for _, y in packing), max(y for _, y in packing) + 1
    panel.box(right - domain_w, high - domain_h, 2 * domain_w - (right - left),
              2 * domain_h - (high - low), fill="#f4f5f7", stroke=FAINT, line=1.5,
              extra='stroke-dasharray="6 4"')
    panel.cells(packing, BUSY)
    panel.box(left, low, right - left, high - low, stroke=INK, line=2.5)
    middle_x, middle_y = (left + right) / 2, (low + high) / 2
    for start, end, colour in (
            ((middle_x, low - 6), (middle_x, low - 0.6), GREEN),
            ((middle_x, high + 6), (middle_x, high + 0.6), RED),
            ((left - 6, middle_y), (left - 0.6, middle_y), BLUE),
            ((right + 6, middle_y), (right + 0.6, middle_y), AMBER)):
        panel.arrow(start, end, colour=colour, line=3)
    svg.text(60, 36, "zsgs04: charts come from four sides", bold=True)
    for i, (line, colour) in enumerate((
            ("black: extent of the packing so far, wₚ × hₚ", INK),
            ("dashed: as far as the extent may reach,", INK),
            ("since it must stay within w × h", INK), ("", INK),
            ("hₚ · w ≤ wₚ · h: from below or above,", INK),
            ("otherwise from left or right;", INK), ("the better side of the pair.", INK),
            ("", INK), ("--all-sides: the best of all four.", INK))):
        svg.text(540, 110 + 22 * i, line, size=14, colour=colour)
    return svg.document()
