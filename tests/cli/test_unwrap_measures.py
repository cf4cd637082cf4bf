"""What bench/unwrap.py measures, on meshes whose answers are known. Without numpy nothing is tested."""

import importlib.util
import math
import pathlib
import sys
import unittest

BENCH = pathlib.Path(__file__).resolve().parents[2] / "bench"
sys.path.insert(0, str(BENCH))
HAS_NUMPY = importlib.util.find_spec("numpy") is not None
if HAS_NUMPY:
    import numpy
    import mesh_files
    import unwrap_measures


def mesh(points, faces, uvs=None):
    """`uvs` per point, or per corner of all faces; default: x and y of the points."""
    corners = numpy.array([p for face in faces for p in face])
    positions = numpy.array(points, dtype=float)
    if uvs is None:
        uvs = positions[:, :2]
    uvs = numpy.array(uvs, dtype=float)
    if len(uvs) == len(positions) != len(corners):
        uvs = uvs[corners]
    begins = mesh_files.begins_of(numpy.array([len(face) for face in faces]))
    return mesh_files.Mesh(positions, begins, corners, uvs)


SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
TWO = [(0, 1, 2), (0, 2, 3)]


@unittest.skipUnless(HAS_NUMPY, "numpy is not there")
class UnwrapMeasures(unittest.TestCase):
    def test_an_isometry(self):
        found = unwrap_measures.measured(mesh(SQUARE, TWO), 64, 64)
        self.assertEqual((found.charts, found.flipped, found.crossing_charts), (1, 0, 0))
        self.assertEqual(found.not_discs, {})
        self.assertAlmostEqual(found.l2[0], 1)
        self.assertAlmostEqual(found.linf[0], 1)
        self.assertAlmostEqual(found.boundary, 0)  # the mesh's own border is no seam

    def test_a_square_drawn_out(self):
        """Twice as long in space along x: singular values 2 and 1, of area 2."""
        points = [(2 * x, y, z) for x, y, z in SQUARE]
        found = unwrap_measures.measured(mesh(points, TWO, [p[:2] for p in SQUARE]), 64, 64)
        self.assertAlmostEqual(found.l2[0], math.sqrt(2.5) / math.sqrt(2))
        self.assertAlmostEqual(found.linf[0], 2 / math.sqrt(2))
        self.assertAlmostEqual(found.angle, (2 + 0.5) / 2)

    def test_a_seam(self):
        uvs = [(0, 0), (1, 0), (1, 1), (5, 0), (6, 1), (5, 1)]
        found = unwrap_measures.measured(mesh(SQUARE, TWO, uvs), 64, 64)
        self.assertEqual(found.charts, 2)
        self.assertAlmostEqual(found.boundary, math.sqrt(2))

    def test_a_flipped_triangle(self):
        points = [*SQUARE, (0.5, -1, 0), (2, 0.5, 0)]
        faces = [*TWO, (1, 0, 4), (2, 1, 5)]
        uvs = [p[:2] for p in points]
        uvs[5] = (0.5, 0.4)  # folded in
        found = unwrap_measures.measured(mesh(points, faces, uvs), 64, 64)
        self.assertEqual(found.flipped, 1)

    def test_a_ring_is_no_disc(self):
        ring = [(r * math.cos(a), r * math.sin(a), 0) for r in (1, 2)
                for a in (k * math.pi / 4 for k in range(8))]
        faces = [(k, 8 + k, 8 + (k + 1) % 8, (k + 1) % 8) for k in range(8)]
        found = unwrap_measures.measured(mesh(ring, faces), 64, 64)
        self.assertEqual(list(found.not_discs), [0])

    def test_a_spiral_overlaps_itself(self):
        """A strip that goes round once and a half: no triangle is flipped, the border crosses."""
        steps = [k * math.pi / 8 for k in range(25)]
        points = [(a, side, 0) for side in (0, 1) for a in steps]
        uvs = [(r * math.cos(a), r * math.sin(a)) for r in (2, 1) for a in steps]
        faces = [(k, k + 1, 26 + k, 25 + k) for k in range(24)]
        found = unwrap_measures.measured(mesh(points, faces, uvs), 64, 64)
        self.assertEqual((found.charts, found.flipped, found.crossing_charts), (1, 0, 1))
        self.assertEqual(found.not_discs, {})


if __name__ == "__main__":
    unittest.main()
