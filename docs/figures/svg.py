"""A canvas for diagrams: SVG elements with y up within panels, as in UV space."""

INK, FAINT, GRID, PAPER = "#1f2430", "#8a919c", "#dfe3e8", "#ffffff"
CHARTS = ["#8ab4f0", "#f2a35e", "#7ec27e", "#c9a0e6", "#ef8f9f"]
RED, GREEN, BLUE, AMBER = "#d6383f", "#1f9d55", "#2f6fde", "#e0a100"
FONT = 'font-family="Helvetica,Arial,sans-serif"'


def number(value):
    return f"{value:.2f}".rstrip("0").rstrip(".") or "0"


def escaped(text):
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


class Svg:
    def __init__(self, width, height):
        self.width, self.height = width, height
        self.parts = []

    def add(self, element):
        self.parts.append(element)

    def text(self, x, y, words, size=15, anchor="start", colour=INK, bold=False):
        weight = ' font-weight="bold"' if bold else ""
        self.add(f'<text x="{number(x)}" y="{number(y)}" font-size="{size}" fill="{colour}" '
                 f'text-anchor="{anchor}"{weight}>{escaped(words)}</text>')

    def rect(self, x, y, width, height, fill="none", stroke="none", line=1.0, extra=""):
        self.add(f'<rect x="{number(x)}" y="{number(y)}" width="{number(width)}" '
                 f'height="{number(height)}" fill="{fill}" stroke="{stroke}" '
                 f'stroke-width="{number(line)}" {extra}/>')

    def path(self, points, fill="none", stroke=INK, line=1.5, closed=False, extra=""):
        d = "M" + "L".join(f"{number(x)} {number(y)}" for x, y in points) + ("Z" if closed else "")
        self.add(f'<path d="{d}" fill="{fill}" stroke="{stroke}" stroke-width="{number(line)}" '
                 f'stroke-linejoin="round" {extra}/>')

    def arrow(self, start, end, colour=INK, line=1.8, both=False):
        (x0, y0), (x1, y1) = start, end
        length = max(1e-9, ((x1 - x0) ** 2 + (y1 - y0) ** 2) ** 0.5)
        ux, uy = (x1 - x0) / length, (y1 - y0) / length
        self.path([start, end], stroke=colour, line=line)
        heads = [(x1, y1, ux, uy)] + ([(x0, y0, -ux, -uy)] if both else [])
        for x, y, dx, dy in heads:
            back = 8
            self.path([(x, y), (x - back * dx - 4 * dy, y - back * dy + 4 * dx),
                       (x - back * dx + 4 * dy, y - back * dy - 4 * dx)],
                      fill=colour, stroke=colour, line=1, closed=True)

    def document(self):
        return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{self.width}" '
                f'height="{self.height}" viewBox="0 0 {self.width} {self.height}" {FONT}>\n'
                f'<rect width="100%" height="100%" rx="6" fill="{PAPER}"/>\n'
                + "\n".join(self.parts) + "\n</svg>\n")


class Panel:
    """A window of `columns` x `rows` cells; cell (0, 0) is at the bottom left."""

    def __init__(self, svg, x, y, columns, rows, cell):
        self.svg, self.x, self.y, self.columns, self.rows, self.cell = svg, x, y, columns, rows, cell

    def at(self, x, y):
        return self.x + x * self.cell, self.y + (self.rows - y) * self.cell

    def box(self, x, y, width, height, **style):
        left, top = self.at(x, y + height)
        self.svg.rect(left, top, width * self.cell, height * self.cell, **style)

    def cells(self, cells, fill, stroke="none", extra=""):
        """Cells of one colour: runs of a row become one rectangle."""
        rows = {}
        for x, y in cells:
            rows.setdefault(y, []).append(x)
        for y in sorted(rows):
            run = []
            for x in sorted(rows[y]) + [None]:
                if run and (x is None or x != run[-1] + 1):
                    self.box(run[0], y, len(run), 1, fill=fill, stroke=stroke, line=0.5, extra=extra)
                    run = []
                if x is not None:
                    run.append(x)

    def grid(self, width=None, height=None, colour=GRID):
        width, height = width or self.columns, height or self.rows
        strokes = [f"M{number(self.at(x, 0)[0])} {number(self.at(0, 0)[1])}V"
                   f"{number(self.at(0, height)[1])}" for x in range(width + 1)]
        strokes += [f"M{number(self.at(0, y)[0])} {number(self.at(0, y)[1])}H"
                    f"{number(self.at(width, 0)[0])}" for y in range(height + 1)]
        self.svg.add(f'<path d="{"".join(strokes)}" stroke="{colour}" stroke-width="1" fill="none"/>')

    def path(self, points, **style):
        self.svg.path([self.at(x, y) for x, y in points], **style)

    def arrow(self, start, end, **style):
        self.svg.arrow(self.at(*start), self.at(*end), **style)

    def text(self, x, y, words, **style):
        self.svg.text(*self.at(x, y), words, **style)

    def caption(self, words, small=()):
        self.svg.text(self.x, self.y - 12, words, bold=True)
        for i, line in enumerate(small):
            self.svg.text(self.x, self.at(0, 0)[1] + 22 + 18 * i, line, size=13, colour="#555c68")
