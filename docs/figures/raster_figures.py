"""How a chart becomes cells: coverage, horizons, padding and margin."""
from figures.cells import centre_cells, entered_cells, grown_outline, hollow, lanes, swapped
from figures.svg import AMBER, BLUE, CHARTS, FAINT, GREEN, INK, Panel, RED, Svg

HOOK = [[(1.3, 1.6), (4.6, 0.8), (9.2, 1.5), (11.4, 4.2), (11.1, 8.1), (8.2, 10.4), (4.4, 10.1),
         (4.9, 7.6), (7.7, 7.5), (8.4, 5.4), (6.6, 4.3), (4.2, 5.6), (2.0, 5.0)],
        [(9.6, 5.2), (9.3, 2.4), (6.6, 2.1), (6.9, 3.5)]]
SOLID = HOOK[:1]
COVER, BOUNDARY = "#cfe0f8", "#8ab4f0"


def draw_outline(panel, loops, line=2.0):
    for loop in loops:
        panel.path(loop, stroke=INK, line=line, closed=True)


def coverage():
    svg = Svg(900, 330)
    panels = [Panel(svg, 30 + 290 * i, 46, 13, 12, 20) for i in range(3)]
    centre, entered, grown = (centre_cells(SOLID), entered_cells(SOLID), entered_cells(SOLID, 0.75))
    words = [("center", "cells whose centre is inside"),
             ("conservative", "all cells that the chart enters"),
             ("conservative, grown", "all that it enters, grown by padding / 2")]
    for panel, cells, (title, line) in zip(panels, (centre, entered, grown), words):
        panel.cells(centre, BOUNDARY)
        panel.cells(cells - centre, COVER)
        panel.grid()
        panel.caption(title, [line])
    for x, y in sorted(centre):
        cx, cy = panels[0].at(x + 0.5, y + 0.5)
        svg.add(f'<circle cx="{cx}" cy="{cy}" r="1.6" fill="{INK}"/>')
    panels[2].path(grown_outline(SOLID[0], 0.75), stroke=RED, line=1.5, closed=True,
                   extra='stroke-dasharray="5 3"')
    for panel in panels:
        draw_outline(panel, SOLID)
    return svg.document()


def staircase(spans, side):
    """The stepped line along the first (0) or last (1) cells of the columns."""
    line = []
    for x in sorted(spans):
        y = spans[x][side] + side
        line += [(x, y), (x + 1, y)]
    return line


def horizons():
    svg = Svg(900, 400)
    shape = [[(1.65 * x, 1.65 * y) for x, y in loop] for loop in HOOK]
    cells = entered_cells(shape)
    for i, (title, words) in enumerate((
            ("columns: bottom and top horizon", "first (green) and last (red) cell of each column"),
            ("rows: left and right horizon", "first (blue) and last (amber) cell of each row"))):
        panel = Panel(svg, 60 + 420 * i, 46, 21, 18, 17)
        seen = cells if i == 0 else swapped(cells)
        inner = hollow(seen) if i == 0 else swapped(hollow(seen))
        panel.cells(inner, "#fbe7a1")
        panel.cells(cells, COVER)
        panel.grid()
        draw_outline(panel, shape, line=1.2)
        for side, colour in enumerate((GREEN, RED) if i == 0 else (BLUE, AMBER)):
            line = staircase(lanes(seen), side)
            panel.path(line if i == 0 else [(y, x) for x, y in line], stroke=colour, line=4)
        panel.caption(title, [words, "hollow (yellow): free cells between the two"])
    return svg.document()


def padding():
    """A grid on a texture without wrap, and what the promise is made of."""
    svg = Svg(900, 440)
    panel = Panel(svg, 40, 46, 24, 16, 23)
    unit, growth, inset = 2.0, 1.0, 1.0  # texels drawn at one square each; cells of two texels
    panel.box(0, 0, 24, 16, fill="#f4f5f7", stroke=INK, line=2.5)
    left = [[(3.2, 3.4), (8.4, 2.6), (9.9, 7.0), (7.2, 12.6), (3.0, 11.0)]]
    right = [[(14.4, 12.2), (12.3, 7.4), (14.2, 3.2), (20.4, 3.6), (19.5, 10.4)]]
    for loops, fill, cover in ((left, CHARTS[0], "#cfe0f8"), (right, CHARTS[1], "#fbe0c6")):
        in_cells = [[((x - inset) / unit, (y - inset) / unit) for x, y in loops[0]]]
        for x, y in sorted(entered_cells(in_cells, growth / unit)):
            panel.box(inset + unit * x, inset + unit * y, unit, unit, fill=cover)
        panel.path(loops[0], fill=fill, stroke=INK, line=1.5, closed=True)
        panel.path(grown_outline(loops[0], growth), stroke=RED, line=1.5, closed=True,
                   extra='stroke-dasharray="5 3"')
    strokes = Panel(svg, *panel.at(inset, 16 - inset), 11, 7, unit * 23)
    strokes.grid(colour="#b9c0ca")
    # The margin is measured at the chart's lowest point, the padding at the narrowest place.
    panel.arrow((8.4, 0), (8.4, 2.6), both=True)
    panel.text(8.75, 0.32, "margin, at least", size=13)
    panel.arrow((9.9, 7.0), (12.3, 7.35), both=True)
    panel.text(10.1, 13.6, "padding, at least", size=13)
    panel.path([(11.1, 13.2), (11.1, 7.5)], stroke=FAINT, line=1)
    svg.text(40, 34, "A texture without wrap and the search grid on it", bold=True)
    x = 622
    for i, (colour, dash, words) in enumerate((
            (INK, "", "border of the texture"), ("#b9c0ca", "", "search grid, inset by"),
            (None, "", "margin − padding / 2"), (RED, "5 3", "chart grown by padding / 2"),
            ("#cfe0f8", "", "cells that the grown"), (None, "", "chart enters: its own"))):
        y = 90 + 26 * i - (6 if colour is None else 0)
        if colour:
            svg.path([(x, y - 5), (x + 26, y - 5)], stroke=colour, line=3,
                     extra=f'stroke-dasharray="{dash}"' if dash else "")
        svg.text(x + 36, y, words, size=13)
    for i, line in enumerate(("Two charts that share no cell have", "grown shapes that share no cell:",
                              "they lie padding apart. A cell inside", "the grid keeps the grown chart,",
                              "and so the margin, inside as well.")):
        svg.text(x, 290 + 19 * i, line, size=13, colour="#555c68")
    return svg.document()
