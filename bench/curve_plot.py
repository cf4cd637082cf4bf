"""The plot of curve.py: mean efficiency over time, on a logarithmic axis of time."""

import math
import sys

import measure

sys.path.insert(0, str(measure.REPOSITORY / "docs" / "figures"))
import svg  # noqa: E402

LEFT, RIGHT, TOP, BOTTOM = 70, 690, 56, 420
COLOURS = {"uv": svg.BLUE, "none": svg.AMBER}
NAMES = {"uv": "on the torus", "none": "without wrap"}


def decades(values):
    """The powers of ten that enclose the values."""
    return (10.0 ** math.floor(math.log10(min(values))), 10.0 ** math.ceil(math.log10(max(values))))


class Axes:
    def __init__(self, points):
        self.first, self.last = decades([max(seconds, 1e-4) for seconds, *_ in points])
        self.low = math.floor(min(efficiency for _, efficiency, _ in points) * 20) / 20
        self.high = math.ceil(max(efficiency for _, efficiency, _ in points) * 20 + 0.2) / 20

    def at(self, seconds, efficiency):
        x = math.log(max(seconds, 1e-4) / self.first) / math.log(self.last / self.first)
        y = (efficiency - self.low) / (self.high - self.low)
        return LEFT + x * (RIGHT - LEFT), BOTTOM - y * (BOTTOM - TOP)

    def draw(self, canvas):
        for tick in range(round(self.low * 20), round(self.high * 20) + 1):
            _, y = self.at(self.first, tick / 20)
            canvas.path([(LEFT, y), (RIGHT, y)], stroke=svg.GRID, line=1)
            canvas.text(LEFT - 8, y + 4, f"{tick / 20:.2f}", size=12, anchor="end")
        for power in range(round(math.log10(self.first)), round(math.log10(self.last)) + 1):
            x, _ = self.at(10.0 ** power, self.low)
            canvas.path([(x, TOP), (x, BOTTOM)], stroke=svg.GRID, line=1)
            canvas.text(x, BOTTOM + 18, f"{10.0 ** power:g} s", size=12, anchor="middle")
            for step in range(2, 10):
                x, _ = self.at(step * 10.0 ** power, self.low)
                if x < RIGHT:
                    canvas.path([(x, BOTTOM - 4), (x, BOTTOM)], stroke=svg.FAINT, line=1)
        canvas.path([(LEFT, TOP), (LEFT, BOTTOM), (RIGHT, BOTTOM)], stroke=svg.INK, line=1.2)


def dot(canvas, place, colour, words="", fill=None):
    x, y = map(svg.number, place)
    canvas.add(f'<circle cx="{x}" cy="{y}" r="4" fill="{fill or colour}" stroke="{colour}" '
               'stroke-width="1.5"/>')
    canvas.text(place[0] + 9, place[1] + 4, words, size=12)


def label(canvas, taken, place, words):
    """Beside its point, on the first side where nothing else is."""
    width = 6.8 * len(words)
    sides = [(9, 4, "start", 0), (-9, 4, "end", -width), (0, -10, "middle", -width / 2),
             (0, 19, "middle", -width / 2), (-7, -8, "end", -width), (8, 17, "start", 0)]
    boxes = [(place[0] + dx + left, place[1] + dy - 11, place[0] + dx + left + width,
              place[1] + dy + 3) for dx, dy, _, left in sides]
    k = next((k for k, box in enumerate(boxes)
              if not any(overlap(box, other) for other in taken)), 0)
    taken.append(boxes[k])
    dx, dy, anchor, _ = sides[k]
    canvas.text(place[0] + dx, place[1] + dy, words, size=12, anchor=anchor)


def overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def along(places):
    """Small boxes on a line through the places, one every few pixels; on a point if it is one."""
    boxes = []
    for a, b in zip(places, places[1:] or places):
        steps = max(1, round(math.dist(a, b) / 6))
        for k in range(steps + 1):
            x, y = (a[i] + k / steps * (b[i] - a[i]) for i in (0, 1))
            boxes.append((x - 4, y - 4, x + 4, y + 4))
    return boxes


def plot(series):
    """`series` is {(method, wrap): [(seconds, efficiency, --time)]}; a curve goes through the
    points that were given a time, all others stand alone."""
    axes = Axes([point for points in series.values() for point in points])
    canvas, taken = svg.Svg(760, 470), []
    axes.draw(canvas)
    canvas.text(LEFT, 26, "Mean share of the atlas in use, by the time packing takes", bold=True)
    canvas.text((LEFT + RIGHT) / 2, BOTTOM + 40, "mean time to pack a file", size=13,
                anchor="middle")
    for k, wrap in enumerate(("uv", "none")):
        dot(canvas, (LEFT + 8 + 130 * k, 42), COLOURS[wrap], NAMES[wrap])
    labels = []
    for (method, wrap), points in series.items():
        curve = sorted(point for point in points if point[2] not in ("", "0"))
        places = [axes.at(seconds, efficiency) for seconds, efficiency, _ in curve]
        if places:
            canvas.path(places, stroke=COLOURS[wrap], line=2)
            taken += along(places)
            labels.append((places[-1], method))
        for place in places:
            dot(canvas, place, COLOURS[wrap])
        for seconds, efficiency, budget in points:
            if budget in ("", "0"):
                place = axes.at(seconds, efficiency)
                dot(canvas, place, COLOURS[wrap], fill=svg.PAPER if budget else None)
                taken += along([place])
                labels.append((place, method + (budget and " --time 0")))
    for place, words in labels:
        label(canvas, taken, place, words)
    return canvas.document()
