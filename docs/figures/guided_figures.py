"""The configuration space of a piece, and the tables that it is made of."""
from figures.svg import CHARTS, FAINT, GREEN, Panel, Svg

WIDTH, HEIGHT = 16, 12
TAKEN = {(x, y) for x in range(2, 9) for y in range(1, 4)} | {(x, y) for x in range(3, 5)
        for y in range(4, 9)} | {(x, y) for x in range(10, 15) for y in range(6, 10)} | {
        (14, 5), (15, 5), (0, 5)}
PIECE = {(0, 0), (1, 0), (2, 0), (3, 0), (0, 1), (1, 1), (0, 2), (1, 2)}


def wrapped(x, y):
    return x % WIDTH, y % HEIGHT


def is_free(x, y):
    return all(wrapped(x + a, y + b) not in TAKEN for a, b in PIECE)


def free_cells():
    return {(x, y) for x in range(WIDTH) for y in range(HEIGHT) if is_free(x, y)}


def blocked_neighbours(x, y):
    return sum(not is_free(x + a, y + b) for a, b in ((1, 0), (-1, 0), (0, 1), (0, -1)))


def configuration_space():
    svg = Svg(900, 380)
    cell = 24
    board = Panel(svg, 24, 44, WIDTH, HEIGHT, cell)
    board.cells({(x, y) for x in range(WIDTH) for y in range(HEIGHT)}, "#f4f5f7")
    board.cells(TAKEN, "#9aa3af")
    place = max(free_cells(), key=lambda p: (blocked_neighbours(*p), -p[1], -p[0]))
    board.cells({wrapped(place[0] + a, place[1] + b) for a, b in PIECE}, CHARTS[0])
    board.grid()
    board.caption("taken, and the piece at a tight place", [])
    space = Panel(svg, 490, 44, WIDTH, HEIGHT, cell)
    space.cells({(x, y) for x in range(WIDTH) for y in range(HEIGHT)}, "#e3b7b9")
    free = free_cells()
    shades = ("#d8eee0", "#b5dfc4", "#6fc08f", GREEN, "#0d5c33")
    for count, colour in enumerate(shades):
        space.cells({p for p in free if blocked_neighbours(*p) == count}, colour)
    space.grid()
    space.caption("its configuration space, around the border", [
        "green: free translations, darker with each blocked neighbour"])
    return svg.document()


def doubling():
    svg = Svg(900, 250)
    taken = [0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0]
    count, cell = len(taken), 26

    def table(level):
        return [any(taken[(x + k) % count] for k in range(2 ** level)) for x in range(count)]

    for row, (label, bits) in enumerate([("taken", table(0)), ("of 2 from x on", table(1)),
                                         ("of 4 from x on", table(2))]):
        panel = Panel(svg, 200, 24 + row * 40, count, 1, cell)
        svg.text(186, 42 + row * 40, label, anchor="end")
        panel.cells({(x, 0) for x in range(count)}, "#f4f5f7")
        panel.cells({(x, 0) for x in range(count) if bits[x]}, "#9aa3af")
    run = 7
    panel = Panel(svg, 200, 24 + 3 * 40 + 16, count, 1, cell)
    svg.text(186, 42 + 3 * 40 + 16, f"a run of {run} is free", anchor="end")
    fours = table(2)
    panel.cells({(x, 0) for x in range(count)}, "#e3b7b9")
    panel.cells({(x, 0) for x in range(count)
                 if not fours[x] and not fours[(x + run - 4) % count]}, "#6fc08f")
    svg.text(200, 24 + 3 * 40 + 76, "where neither the 4 cells from x on nor those from x + 3 on have "
             "one that is taken", size=13, colour=FAINT)
    return svg.document()
