"""pack: charts that are there."""

import json
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
import shapes

import wrapatlas

SAMPLES = Path(__file__).parents[2] / "samples"


class Pack(unittest.TestCase):
    def setUp(self):
        self.uv, self.faces = shapes.scattered_squares()

    def test_what_comes_back(self):
        packing = wrapatlas.pack(self.uv, self.faces, time=0.1, resolution=256)
        self.assertEqual(packing.chart_count, 12)
        self.assertEqual((packing.width, packing.height, packing.wrap), (256, 256, "uv"))
        self.assertEqual(packing.uv.shape, (48, 2))
        self.assertEqual((packing.uv.dtype, packing.faces.dtype, packing.vmapping.dtype),
                         (np.float32, np.uint32, np.uint32))
        np.testing.assert_array_equal(packing.vmapping[packing.faces], self.faces)
        self.assertEqual(packing.placements.shape, (12, 2, 3))
        self.assertEqual(packing.wraps.shape, (12, 2))
        self.assertTrue(0.2 < packing.efficiency <= 1)
        self.assertTrue(packing.report.ok)
        self.assertIn("12 charts on 256 x 256", repr(packing))

    def test_placements_give_the_uvs(self):
        packing = wrapatlas.pack(self.uv, self.faces, time=0.1, resolution=256, wrap="none")
        for face, chart in enumerate(packing.face_chart):
            matrix = packing.placements[chart]
            for corner in range(3):
                texel = matrix @ [*self.uv[self.faces[face, corner]], 1]
                uv = packing.uv[packing.faces[face, corner]]
                np.testing.assert_allclose(texel / 256, uv, atol=1e-6)

    def test_no_wrap_stays_inside_and_wrap_is_said(self):
        inside = wrapatlas.pack(self.uv, self.faces, time=0.1, wrap="none")
        self.assertTrue((inside.uv >= 0).all() and (inside.uv <= 1).all())
        self.assertFalse(inside.wraps.any())
        torus = wrapatlas.pack(self.uv, self.faces, time=0.3, wrap="uv")
        beyond = np.zeros((12, 2), bool)
        np.logical_or.at(beyond, np.repeat(torus.face_chart, 3), torus.uv[torus.faces.ravel()] > 1)
        np.testing.assert_array_equal(torus.wraps, beyond)

    def test_cut_has_all_uvs_inside_and_covers_the_same(self):
        positions = np.column_stack([self.uv, np.zeros(len(self.uv))])
        whole = wrapatlas.pack(self.uv, self.faces, positions, moves=2000)
        cut = wrapatlas.pack(self.uv, self.faces, positions, moves=2000, export="cut")
        self.assertTrue(whole.wraps.any(), "or there is nothing to see")
        self.assertTrue((cut.uv >= 0).all() and (cut.uv <= 1).all())
        self.assertGreater(len(cut.face_begin), len(whole.face_begin))
        areas = np.abs(areas_of(cut.positions, polygons(cut)))
        whole_areas = np.abs(areas_of(whole.positions, polygons(whole)))
        self.assertAlmostEqual(areas.sum(), whole_areas.sum(), places=9)
        np.testing.assert_allclose(cut.interpolate(positions), cut.positions)
        self.assertTrue(wrapatlas.check(cut, resolution=1024, padding=4, cut="uv").ok)
        self.assertTrue(wrapatlas.check(cut, padding=4).ok)  # its own setting
        self.assertFalse(wrapatlas.check(cut, padding=400).ok)

    def test_charts_hang_together_by_index_or_by_value(self):
        soup = self.uv[self.faces.ravel()]
        corners = np.arange(len(soup)).reshape(-1, 3)
        self.assertEqual(wrapatlas.pack(soup, corners, time=0).chart_count, 24)
        positions = np.column_stack([soup, np.zeros(len(soup))])
        self.assertEqual(wrapatlas.pack(soup, corners, positions, time=0).chart_count, 12)

    def test_separate_indices_of_positions(self):
        positions = np.column_stack([self.uv[::-1], np.ones(len(self.uv))])
        turned = len(self.uv) - 1 - self.faces
        packing = wrapatlas.pack(self.uv, self.faces, positions, turned, time=0)
        np.testing.assert_allclose(packing.positions[packing.faces], positions[turned])
        self.assertEqual(packing.chart_count, 12)

    def test_density_and_pages(self):
        positions = 10 * np.column_stack([self.uv, np.zeros(len(self.uv))])
        packing = wrapatlas.pack(self.uv, self.faces, positions, density=100, resolution=128,
                                 time=0.2, udim=True)
        self.assertAlmostEqual(packing.density, 100)
        self.assertGreater(packing.pages, 1)
        self.assertEqual(set(packing.chart_pages), set(range(packing.pages)))
        self.assertEqual(packing.image(64).shape[2], 3)

    def test_any_dtype_order_and_stride(self):
        wanted = wrapatlas.pack(self.uv, self.faces, moves=500)
        wide = np.zeros((len(self.uv), 5))
        wide[:, 1::2] = self.uv
        variants = {
            "lists": (self.uv.tolist(), self.faces.tolist()),
            "Fortran": (np.asfortranarray(self.uv), np.asfortranarray(self.faces)),
            "strides": (wide[:, 1::2], np.repeat(self.faces, 2, axis=1)[:, ::2]),
            "backwards": (self.uv[::-1], len(self.uv) - 1 - self.faces),
            "big endian": (self.uv.astype(">f8"), self.faces.astype(">i4")),
            "int16": (self.uv, self.faces.astype(np.int16)),
            "uint64": (self.uv, self.faces.astype(np.uint64)),
            "whole floats": (self.uv, self.faces.astype(np.float32)),
            "longdouble": (self.uv.astype(np.longdouble), self.faces),
        }
        for name, (uv, faces) in variants.items():
            with self.subTest(name):
                packing = wrapatlas.pack(uv, faces, moves=500)
                np.testing.assert_array_equal(packing.uv, wanted.uv)
        frozen = self.uv.copy()
        frozen.flags.writeable = False
        np.testing.assert_array_equal(wrapatlas.pack(frozen, self.faces, moves=500).uv, wanted.uv)

    def test_arrays_outlive_what_they_are_of(self):
        uv = wrapatlas.pack(self.uv, self.faces, moves=500).uv
        again = wrapatlas.pack(self.uv, self.faces, moves=500)
        np.testing.assert_array_equal(uv, again.uv)
        with self.assertRaises(ValueError):
            uv[0] = 0

    def test_methods_and_aspects(self):
        for method in ("modulo", "swg03", "zsgs04", "lprm02"):
            self.assertEqual(wrapatlas.pack(self.uv, self.faces, method=method).method, method)
        wide = wrapatlas.pack(self.uv, self.faces, aspect="2:1", method="modulo", resolution=256)
        self.assertAlmostEqual(wide.width / wide.height, 2, places=1)
        sized = wrapatlas.pack(self.uv, self.faces, resolution=(64, 128), time=0)
        self.assertEqual((sized.width, sized.height), (64, 128))
        self.assertEqual(wrapatlas.pack(self.uv, self.faces, resolution="64x32", time=0).width, 64)

    def test_the_same_as_the_command(self):
        path = SAMPLES / "coral.glb"
        with tempfile.TemporaryDirectory() as folder:
            by_command, by_python = Path(folder) / "a.glb", Path(folder) / "b.glb"
            subprocess.run([wrapatlas.command(), "pack", path, "-o", by_command, "--moves", "2000",
                            "--resolution", "512", "--quiet"], check=True)
            packing = wrapatlas.pack(path, moves=2000, resolution=512)
            packing.save(by_python)
            self.assertEqual(by_command.read_bytes(), by_python.read_bytes())
            report = subprocess.run([wrapatlas.command(), "check", by_python, "--ref", path,
                                     "--resolution", "512", "--wrap", "uv", "--padding", "2",
                                     "--json", "-", "--quiet"], check=True, capture_output=True)
            self.assertTrue(json.loads(report.stdout)["ok"])

    def test_picture(self):
        packing = wrapatlas.pack(self.uv, self.faces, time=0)
        image = packing.image(200)
        self.assertEqual((image.shape, image.dtype), ((200, 200, 3), np.uint8))
        self.assertEqual(packing.image(200, tiles=True).shape, (400, 400, 3))
        self.assertTrue(packing._repr_png_().startswith(b"\x89PNG"))
        self.assertTrue(image._repr_png_().startswith(b"\x89PNG"))
        with tempfile.TemporaryDirectory() as folder:
            packing.save_image(folder + "/a.svg")
            packing.save_image(folder + "/a.png", 64)
            self.assertEqual(wrapatlas.load_image(folder + "/a.png").shape, (64, 64, 3))
            self.assertIn("<svg", Path(folder, "a.svg").read_text())


def polygons(packing):
    """Rings of new vertices."""
    ends = packing.face_begin
    return [packing.corner_vertex[a:b] for a, b in zip(ends[:-1], ends[1:])]


def areas_of(points, rings):
    """In the plane z = 0."""
    areas = []
    for ring in rings:
        x, y = points[ring, 0], points[ring, 1]
        areas.append(0.5 * (x * np.roll(y, -1) - np.roll(x, -1) * y).sum())
    return np.array(areas)


if __name__ == "__main__":
    unittest.main()
