"""Machine parts: charts with holes, thin rings and frames, combs, spirals, long strips."""

import math

from makers.layout import lay_out
from makers.solids import Solids


def circle(radius, count, centre=(0.0, 0.0), first=0.0):
    return [(centre[0] + radius * math.cos(first + 2 * math.pi * i / count),
             centre[1] + radius * math.sin(first + 2 * math.pi * i / count)) for i in range(count)]


def toothed(teeth, low, high, widths):
    """A gear's outline; `widths` are four places in a tooth's turn, root to root."""
    loop = []
    for tooth in range(teeth):
        for radius, place in zip((low, high, high, low), widths):
            angle = 2 * math.pi * (tooth + place) / teeth
            loop.append((radius * math.cos(angle), radius * math.sin(angle)))
    return loop


def thick_line(line, half):
    """The outline of a smooth open curve given as (x, y, heading), `half` to both sides."""
    left = [(x - half * math.sin(a), y + half * math.cos(a)) for x, y, a in line]
    right = [(x + half * math.sin(a), y - half * math.cos(a)) for x, y, a in line]
    return right + left[::-1]


def curve(start, heading, length, bend, steps):
    """A curve whose curvature goes from bend[0] to bend[1], as (x, y, heading)."""
    (x, y), line = start, []
    for i in range(steps + 1):
        line.append((x, y, heading))
        heading += (bend[0] + (i + 0.5) / steps * (bend[1] - bend[0])) * length / steps
        x += math.cos(heading) * length / steps
        y += math.sin(heading) * length / steps
    return line


def spiral(inner, outer, turns, steps):
    """A spiral of Archimedes from inside out, as (x, y, heading)."""
    growth = (outer - inner) / (2 * math.pi * turns)
    length = math.pi * turns * (inner + outer)
    line = []
    for i in range(steps + 1):
        radius = math.sqrt(inner * inner + 2 * growth * length * i / steps)
        angle = (radius - inner) / growth
        line.append((radius * math.cos(angle), radius * math.sin(angle),
                     angle + math.atan2(radius, growth)))
    return line


def make_machine():
    m = Solids()
    spokes = [circle(0.62, 20, (2.1 * math.cos(k * math.pi / 3), 2.1 * math.sin(k * math.pi / 3)))
              for k in range(6)]
    m.plate("gear", "steel", [toothed(22, 3.2, 3.75, (0.0, 0.18, 0.42, 0.6)), circle(0.8, 28)]
            + spokes, 0.6, (0, 0, 0), strips=4)
    m.plate("pinion", "brass", [toothed(11, 1.5, 2.05, (0.0, 0.18, 0.42, 0.6)), circle(0.5, 20)],
            0.9, (5.9, 0, 0), strips=2)
    teeth = [p for k in range(11) for p in
             ((0.55 * k + 0.3, 0.5), (0.55 * k + 0.3, 3.2), (0.55 * k, 3.3), (0.55 * k, 0.5))]
    m.plate("comb", "steel", [[(-0.25, 0.0), (6.1, 0.1), (6.0, 0.5)]
                              + sorted_comb(teeth) + [(-0.2, 0.52)]], 0.25, (9, -1.6, 0),
            strips=5)
    m.plate("spring", "brass", [thick_line(spiral(0.5, 2.7, 4.6, 170), 0.12)], 0.5,
            (-4, 6, 0), strips=9)
    m.plate("circlip", "steel", [thick_line(curve((0, 0), 0.0, 11.0, (0.52, 0.52), 48), 0.28)], 0.2,
            (5, 6, 0), turn=0.5)
    frame = [(0, 0), (7.0, 0), (7.0, 4.4), (0, 4.4)]
    m.plate("frame", "paint", [frame, [(0.3, 0.3), (6.7, 0.3), (6.7, 4.1), (0.3, 4.1)]], 0.3,
            (9, 4, 0), turn=1.2)
    half = curve((0, 0), 1.2, 5.0, (-0.2, -1.5), 24)
    other = [(-x, -y, a) for x, y, a in half[:0:-1]]
    m.plate("hook", "paint", [thick_line(other + half, 0.3)], 0.35, (0, -7.5, 0))
    m.plate("bracket", "steel", [
        [(0, 0), (5.2, 0), (5.2, 1.5), (1.6, 1.6), (1.5, 5.6), (0, 5.6)],
        circle(0.34, 16, (0.75, 4.8)), circle(0.34, 16, (4.4, 0.75)),
        slot((0.75, 1.9), (0.75, 3.6), 0.25, 8), slot((1.5, 0.75), (3.4, 0.75), 0.25, 8)], 0.4,
        (5.5, -8.5, 0), turn=-0.4)
    m.plate("knob", "brass", [toothed(7, 0.9, 2.2, (0.0, 0.46, 0.54, 0.98)), circle(0.4, 16)],
            0.8, (-6, -1, 0))
    m.plate("tie_bar", "steel", [slot((0, 0), (13.0, 0), 0.22, 8), circle(0.12, 12),
                                 circle(0.12, 12, (13.0, 0.0))], 0.15, (-3, -11.5, 0), turn=0.8,
            strips=2)
    for k, (outer, inner) in enumerate(((0.9, 0.45), (0.7, 0.5), (0.45, 0.2), (0.35, 0.25))):
        m.plate(f"washer_{k + 1}", "brass", [circle(outer, 24), circle(inner, 20)], 0.08,
                (-6 + 2.0 * k, -5, 0))
    m.funnel("funnel", "paint", [(1.0, 0.0), (2.6, 2.6), (2.45, 2.6), (0.85, 0.0)], 36,
             (14, -7, 0))
    return m, lay_out(m.charts)


def sorted_comb(teeth):
    """From right to left along the teeth."""
    loop = []
    for k in range(len(teeth) // 4 - 1, -1, -1):
        loop += teeth[4 * k : 4 * k + 4]
    return loop


def slot(a, b, half, steps):
    """The outline of a line with round ends."""
    heading = math.atan2(b[1] - a[1], b[0] - a[0])
    loop = []
    for centre, first in ((b, heading - math.pi / 2), (a, heading + math.pi / 2)):
        loop += [(centre[0] + half * math.cos(first + math.pi * i / steps),
                  centre[1] + half * math.sin(first + math.pi * i / steps))
                 for i in range(steps + 1)]
    return loop
