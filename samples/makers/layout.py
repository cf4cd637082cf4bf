"""Charts side by side."""

import math


def lay_out(charts):
    """Puts charts (lists of points) on shelves, in their order, and scales all into [0, 1]."""
    boxes = []
    for points in charts:
        xs, ys = [p[0] for p in points], [p[1] for p in points]
        boxes.append((min(xs), min(ys), max(xs) - min(xs), max(ys) - min(ys)))
    area = sum(w * h for _, _, w, h in boxes)
    width = max(1.5 * math.sqrt(area), max(w for _, _, w, _ in boxes))
    gap = 0.06 * math.sqrt(area / len(charts))
    places, x, y, shelf = [], gap, gap, 0.0
    for _, _, w, h in boxes:
        if x > gap and x + w > width:
            x, y, shelf = gap, y + shelf + gap, 0.0
        places.append((x, y))
        x, shelf = x + w + gap, max(shelf, h)
    size = max(width + 2 * gap, y + shelf + gap)
    return [
        [((p[0] - box[0] + place[0]) / size, (p[1] - box[1] + place[1]) / size) for p in points]
        for points, box, place in zip(charts, boxes, places)
    ]
