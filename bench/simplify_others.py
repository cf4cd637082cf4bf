"""Simplifiers of other people, from PyPI, on positions and triangles (README.md)."""

import numpy

try:
    import fast_simplification
    import meshoptimizer.simplifier
except ImportError:
    fast_simplification = meshoptimizer = None


def are_there():
    return meshoptimizer is not None


def by_meshoptimizer(positions, faces, target):
    """Its vertices stay where they are; without a limit of error."""
    made = numpy.empty(faces.size, dtype=numpy.uint32)
    count = meshoptimizer.simplifier.simplify(
        made, faces.ravel().astype(numpy.uint32), positions.astype(numpy.float32),
        target_index_count=3 * target, target_error=1e9)
    return positions, made[:count].reshape(-1, 3).astype(numpy.int64)


def by_fast_simplification(positions, faces, target):
    """Quadric errors (Garland & Heckbert 1997)."""
    points, triangles = fast_simplification.simplify(
        positions.astype(numpy.float32), faces.astype(numpy.int32), target_count=target)
    return points.astype(numpy.float64), triangles.astype(numpy.int64)


ALL = {"meshoptimizer": by_meshoptimizer, "fast-simplification": by_fast_simplification}
