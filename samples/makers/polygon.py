"""Triangles of polygons with holes.

Choices compare rounded lengths: symmetric shapes have ties, which the last bit must not decide.
"""

from makers.vectors import distance, signed_area2


def segments_cross(a, b, c, d):
    return (signed_area2(a, b, c) > 0) != (signed_area2(a, b, d) > 0) and (
        signed_area2(c, d, a) > 0) != (signed_area2(c, d, b) > 0)


def bridge_holes(points, outline, holes):
    """One loop of indices around the outline and, over bridges, around all holes."""
    loop = list(outline)
    waiting = sorted(holes, key=lambda hole: round(-max(points[k][0] for k in hole), 6))
    while waiting:
        hole = waiting.pop(0)
        start = max(range(len(hole)), key=lambda i: points[hole[i]])
        h = hole[start]
        walls = [ring + ring[:1] for ring in [loop, hole] + waiting]
        away = [round(distance(points[k], points[h]), 6) for k in loop]
        for at in sorted(range(len(loop)), key=away.__getitem__):
            o = loop[at]
            blocked = any(
                segments_cross(points[h], points[o], points[a], points[b])
                for ring in walls
                for a, b in zip(ring, ring[1:])
                if not {a, b} & {h, o}
            )
            if not blocked:
                loop = loop[: at + 1] + hole[start:] + hole[: start + 1] + loop[at:]
                break
    return loop


def triangulate(points, loop):
    """Ear clipping, shortest new edge first."""
    ring = list(loop)

    def ear(i):
        a, b, c = ring[i - 1], ring[i], ring[(i + 1) % len(ring)]
        pa, pb, pc = points[a], points[b], points[c]
        if signed_area2(pa, pb, pc) <= 1e-9:
            return None
        for k in ring:
            p = points[k]
            if p in (pa, pb, pc):
                continue
            sides = signed_area2(pa, pb, p), signed_area2(pb, pc, p), signed_area2(pc, pa, p)
            if min(sides) > -1e-9:
                return None
        return round(distance(pa, pc), 6)

    triangles, ears = [], [ear(i) for i in range(len(ring))]
    while len(ring) > 3:
        best = min((e, i) for i, e in enumerate(ears) if e is not None)[1]
        triangles.append((ring[best - 1], ring[best], ring[(best + 1) % len(ring)]))
        del ring[best], ears[best]
        if len(ring) % 16 == 0:
            ears = [ear(i) for i in range(len(ring))]
        for i in (best - 1, best % len(ring)):
            ears[i] = ear(i)
        if all(e is None for e in ears):
            ears = [ear(i) for i in range(len(ring))]
    return triangles + [tuple(ring)]
