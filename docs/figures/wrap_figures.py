"""A chart across the border: continuous and cut."""
from figures.svg import CHARTS, FAINT, INK, Panel, RED, Svg

RIM = [(2.1, 4.6), (4.4, 3.2), (7.4, 3.9), (8.9, 6.2), (8.0, 8.6), (5.4, 9.4), (2.9, 8.2)]
HUB = (5.5, 5.5)
TILE = 6.4


def triangles():
    return [[HUB, a, b] for a, b in zip(RIM, RIM[1:] + RIM[:1])]


def cut_at(polygon, axis, value):
    """The parts of a convex polygon below and above a line."""
    parts = [[], []]
    for a, b in zip(polygon, polygon[1:] + polygon[:1]):
        below, next_below = a[axis] < value, b[axis] < value
        parts[0 if below else 1].append(a)
        if below != next_below:
            t = (value - a[axis]) / (b[axis] - a[axis])
            point = (a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]))
            parts[0].append(point)
            parts[1].append(point)
    return parts


def pieces():
    """Pieces of all triangles with the whole periods that bring each into the tile."""
    for triangle in triangles():
        for i, column in enumerate(cut_at(triangle, 0, TILE)):
            for j, piece in enumerate(cut_at(column, 1, TILE) if column else ([], [])):
                if len(piece) > 2:
                    yield piece, (i, j)


def wrap_and_cut():
    svg = Svg(900, 390)
    cell = 27
    first = Panel(svg, 30, 60, 9.5, 10, cell)
    first.box(0, 0, TILE, TILE, fill="#f4f5f7", stroke=INK, line=2)
    for dx, dy in ((TILE, 0), (0, TILE)):
        first.box(dx, dy, 9.5 - TILE if dx else TILE, 10 - TILE if dy else TILE, stroke=FAINT,
                  extra='stroke-dasharray="5 4"')
    for triangle in triangles():
        first.path(triangle, fill=CHARTS[0], stroke=INK, line=1, closed=True)
    first.text(0.25, 0.3, "[0,1]²", size=13)
    second = Panel(svg, 340, 60 + (10 - TILE) * cell, TILE, TILE, cell)
    third = Panel(svg, 640, 60 + (10 - TILE) * cell, TILE, TILE, cell)
    for panel in (second, third):
        panel.box(0, 0, TILE, TILE, fill="#f4f5f7", stroke=INK, line=2)
    for panel, line in ((second, 0), (third, 1)):
        for piece, (i, j) in pieces():
            placed = [(x - i * TILE, y - j * TILE) for x, y in piece]
            fill = CHARTS[0] if (i, j) == (0, 0) else "#b9d2f6"
            panel.path(placed, fill=fill, stroke=INK if line else fill, line=1, closed=True)
    new = set()
    for piece, (i, j) in pieces():
        for x, y in piece:
            if abs(x - TILE) < 1e-9 or abs(y - TILE) < 1e-9:
                new.add((round(x - i * TILE, 6), round(y - j * TILE, 6)))
    for x, y in sorted(new):
        cx, cy = third.at(x, y)
        svg.add(f'<circle cx="{cx:.2f}" cy="{cy:.2f}" r="3.5" fill="{RED}"/>')
    for panel, title, small in (
            (first, "--export continuous", ["whole triangles; some UVs exceed 1"]),
            (second, "what the sampler reads", ["REPEAT: the same texels"]),
            (third, "--export cut", ["split at the border; new vertices red", "all UVs in [0,1]"])):
        panel.caption(title, small)
    return svg.document()
