"""The scale search, attempt by attempt."""
from figures.svg import AMBER, FAINT, GREEN, INK, RED, Svg


def attempts(upper, success, lower=0.1, sigma=3, tolerance=0.01):
    """(l, u, f, success) of each attempt: section 2.2.3 of the paper."""
    best = None
    while True:
        factor = (lower + upper) / 2
        good = success(factor)
        yield lower, upper, factor, good
        if good:
            best, lower = max(best or 0, factor), factor
        else:
            upper = factor + (upper - factor) / sigma
        if upper - lower < tolerance and best:
            return


def scale_search():
    svg = Svg(900, 470)

    def success(f):  # made up, and not monotone: what fails at 0.66 succeeds a little higher
        return f < 0.64 or 0.68 < f < 0.71

    steps = list(attempts(1.0, success))
    left, right, top, line = 90, 850, 84, 27

    def at(f):
        return left + (right - left) * f

    svg.text(30, 34, "An extended binary search, success not being monotone", bold=True)
    bottom = top + line * len(steps)
    for begin, end in ((0, 0.64), (0.68, 0.71)):
        svg.rect(at(begin), top - 14, at(end) - at(begin), bottom - top + 4, fill="#e4f5e8")
    svg.text(at(0.3), top - 22, "green ground: scales at which this example succeeds", size=13,
             anchor="middle", colour="#555c68")
    best = max(f for *_, f, good in steps if good)
    for i, (lower, upper, factor, good) in enumerate(steps):
        y = top + line * i
        svg.text(30, y + 5, f"{i + 1}", size=13, colour=FAINT)
        svg.path([(at(lower), y), (at(upper), y)], stroke=INK, line=2)
        for x in (lower, upper):
            svg.path([(at(x), y - 6), (at(x), y + 6)], stroke=INK, line=2)
        ring = f' stroke="{AMBER}" stroke-width="4"' if factor == best else ""
        svg.add(f'<circle cx="{at(factor):.2f}" cy="{y}" r="6" fill="{GREEN if good else RED}"{ring}/>')
    for tick in range(11):
        svg.path([(at(tick / 10), bottom), (at(tick / 10), bottom + 6)], stroke=FAINT, line=1)
        svg.text(at(tick / 10), bottom + 22, f"{tick / 10:g}", size=12, anchor="middle")
    svg.path([(at(0), bottom), (at(1), bottom)], stroke=FAINT, line=1)
    svg.text(at(0.5), bottom + 46, "f, the share of the scale at which the charts would fill the "
             "texture", size=13, anchor="middle")
    svg.text(30, bottom + 72, "bar: l to u; green dot: all charts placed; red dot: not; ringed: the "
             "largest success, which is the result", size=13, colour="#555c68")
    svg.height = int(bottom + 90)
    return svg.document()
