"""A plot with a logarithmic axis of values, and of places too if they span decades, as SVG."""

import itertools
import math
import sys

import measure

sys.path.insert(0, str(measure.REPOSITORY / "docs" / "figures"))
import svg  # noqa: E402

LEFT, RIGHT, TOP, BOTTOM = 70, 600, 56, 420
COLOURS = [svg.BLUE, svg.AMBER, svg.GREEN, svg.RED, "#8a4fc7", "#00a0a8"]


class Axis:
    """A logarithmic axis over whole decades, or one of whole numbers."""

    def __init__(self, values, begin, end, logarithmic=True):
        self.begin, self.end, self.logarithmic = begin, end, logarithmic
        low, high = min(values), max(values)
        if logarithmic:
            self.low, self.high = math.floor(math.log10(low)), math.ceil(math.log10(high))
            self.ticks = [10.0 ** power for power in range(self.low, self.high + 1)]
        else:
            self.low, self.high = low, high
            self.ticks = list(range(round(low), round(high) + 1))
        self.high += self.high == self.low

    def at(self, value):
        place = math.log10(value) if self.logarithmic else value
        share = (place - self.low) / (self.high - self.low)
        return self.begin + share * (self.end - self.begin)


def tick_text(value):
    return f"{value:g}" if 1e-3 <= value < 1e7 else f"{value:.0e}"


def plot(title, across, series, logarithmic_across=True):
    """`series`: {name: [(place, value)]}, all values above 0; `across` names the places."""
    points = [point for line in series.values() for point in line]
    x = Axis([place for place, _ in points], LEFT, RIGHT, logarithmic_across)
    y = Axis([value for _, value in points], BOTTOM, TOP)
    canvas = svg.Svg(760, 470)
    canvas.text(LEFT, 26, title, bold=True)
    canvas.text((LEFT + RIGHT) / 2, BOTTOM + 40, across, size=13, anchor="middle")
    for tick in y.ticks:
        canvas.path([(LEFT, y.at(tick)), (RIGHT, y.at(tick))], stroke=svg.GRID, line=1)
        canvas.text(LEFT - 8, y.at(tick) + 4, tick_text(tick), size=12, anchor="end")
    for tick in x.ticks:
        canvas.path([(x.at(tick), TOP), (x.at(tick), BOTTOM)], stroke=svg.GRID, line=1)
        canvas.text(x.at(tick), BOTTOM + 18, tick_text(tick), size=12, anchor="middle")
    canvas.path([(LEFT, TOP), (LEFT, BOTTOM), (RIGHT, BOTTOM)], stroke=svg.INK, line=1.2)
    labels = []  # where there is text already
    for colour, (name, line) in zip(itertools.cycle(COLOURS), series.items()):
        places = [(x.at(place), y.at(value)) for place, value in line]
        canvas.path(places, stroke=colour, line=2)
        for a, b in places:
            canvas.add(f'<circle cx="{svg.number(a)}" cy="{svg.number(b)}" r="4" fill="{colour}"/>')
        left, middle = places[-1]
        while any(abs(left - a) < 100 and abs(middle - b) < 13 for a, b in labels):
            middle += 1
        labels.append((left, middle))
        canvas.text(left + 9, middle + 4, name, size=12)
    return canvas.document()
