"""Lengths, areas and products of points given as tuples."""

import math


def distance(a, b):
    return math.sqrt(sum((x - y) ** 2 for x, y in zip(a, b)))


def signed_area2(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def area_in_space(a, b, c):
    ab, ac = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
    return math.sqrt(sum(x * x for x in cross(ab, ac))) / 2


def unit(v):
    size = math.sqrt(sum(x * x for x in v))
    return [x / size for x in v]
