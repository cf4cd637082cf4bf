"""unwrap: meshes without UVs; files and trimesh in and out."""

import json
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
import shapes

import wrapatlas

SAMPLES = Path(__file__).parents[2] / "samples"


class Unwrap(unittest.TestCase):
    def test_a_sphere(self):
        positions, faces = shapes.sphere()
        packing = wrapatlas.unwrap(positions, faces, time=0.2, resolution=512)
        np.testing.assert_array_equal(packing.vmapping[packing.faces], faces)
        np.testing.assert_array_equal(packing.positions, positions[packing.vmapping])
        self.assertEqual(packing.face_stretch.shape, (len(faces),))
        self.assertTrue(1 <= packing.stretch_l2 <= 2.0001)
        self.assertEqual(packing.charts_beyond_limits, 0)
        self.assertTrue(wrapatlas.check(packing, resolution=512, wrap="uv", padding=2).ok)

    def test_options(self):
        positions, faces = shapes.box()
        few = wrapatlas.unwrap(positions, faces, time=0)
        each = wrapatlas.unwrap(positions, faces, time=0, hard_edges=45)
        self.assertEqual(each.chart_count, 6)
        self.assertLess(few.chart_count, 6)
        self.assertAlmostEqual(each.stretch_l2, 1, places=6)
        lscm = wrapatlas.unwrap(positions, faces, time=0, flatten="lscm", max_stretch=1.5)
        self.assertLessEqual(lscm.stretch_l2, 1.5)

    def test_polygons(self):
        corners, _ = shapes.box()
        quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        packing = wrapatlas.unwrap(corners, quads, time=0)
        self.assertEqual(packing.mesh.faces.shape, (6, 4))
        self.assertEqual(packing.mesh.triangulated().faces.shape, (12, 3))
        with self.assertRaisesRegex(ValueError, "not all are triangles"):
            packing.faces

    def test_as_the_command_does_it(self):
        path = SAMPLES / "knot.off"
        with tempfile.TemporaryDirectory() as folder:
            by_command, by_python = Path(folder) / "a.obj", Path(folder) / "b.obj"
            subprocess.run([wrapatlas.command(), "unwrap", path, "-o", by_command, "--moves", "1000",
                            "--quiet"], check=True)
            wrapatlas.unwrap(path, moves=1000).save(by_python)
            self.assertEqual(by_command.read_bytes(), by_python.read_bytes())

    def test_files(self):
        mesh = wrapatlas.load(SAMPLES / "coral.glb")
        self.assertTrue(mesh.v_points_down)
        self.assertEqual(mesh.faces.shape[1], 3)
        self.assertEqual(mesh.uv_faces.shape, mesh.faces.shape)
        with tempfile.TemporaryDirectory() as folder:
            mesh.save(folder + "/coral.obj")
            again = wrapatlas.load(folder + "/coral.obj")
            self.assertEqual(again.face_count, mesh.face_count)
            np.testing.assert_allclose(np.sort(again.uv[:, 1]), np.sort(1 - mesh.uv[:, 1]), atol=1e-6)
            with self.assertRaisesRegex(OSError, "nowhere"):
                mesh.save(folder + "/nowhere/coral.obj")
            with self.assertRaises(FileNotFoundError):
                wrapatlas.load(folder + "/missing.obj")
            Path(folder, "bad.obj").write_text("v 0 0 0\nf 1 2 3\n")
            with self.assertRaisesRegex(wrapatlas.InputError, "bad.obj"):
                wrapatlas.load(folder + "/bad.obj")

    def test_in_its_scene(self):
        data = (SAMPLES / "coral.glb").read_bytes()
        size = int.from_bytes(data[12:16], "little")
        document = json.loads(data[20:20 + size])
        at = [{"mesh": 0, "translation": [10, 0, 0]}, {"mesh": 0, "scale": [2, 2, 2]}]
        document.update(nodes=at, scenes=[{"nodes": [0, 1]}], scene=0)
        text = json.dumps(document).encode()
        text += b" " * (-len(text) % 4)
        whole = len(data) + len(text) - size
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "moved.glb")
            path.write_bytes(data[:8] + whole.to_bytes(4, "little") + len(text).to_bytes(4, "little")
                             + data[16:20] + text + data[20 + size:])
            plain, placed = wrapatlas.load(path), wrapatlas.load(path, in_scene=True)
            self.assertEqual(placed.face_count, 2 * plain.face_count)
            once = plain.positions[plain.faces]
            np.testing.assert_allclose(placed.positions[placed.faces],
                                       np.concatenate([once + [10, 0, 0], 2 * once]), atol=1e-5)
            placed.save(path)
            again = wrapatlas.load(path)
            np.testing.assert_allclose(again.positions[again.faces],
                                       placed.positions[placed.faces], atol=1e-5)

    def test_trimesh(self):
        import trimesh

        positions, faces = shapes.sphere(800)
        mesh = trimesh.Trimesh(positions, faces, process=False)
        packing = wrapatlas.unwrap(mesh, time=0.1)
        back = packing.to_trimesh()
        self.assertIsInstance(back, trimesh.Trimesh)
        self.assertEqual(len(back.faces), len(faces))
        self.assertAlmostEqual(back.area, mesh.area, places=9)
        np.testing.assert_array_equal(back.visual.uv, packing.uv)
        repacked = wrapatlas.pack(back, time=0.1, wrap="none")
        self.assertEqual(repacked.chart_count, packing.chart_count)
        split = packing.mesh.to_trimesh()
        self.assertAlmostEqual(split.area, mesh.area, places=9)
        self.assertEqual(len(split.visual.uv), len(split.vertices))
        with tempfile.TemporaryDirectory() as folder:
            back.export(folder + "/a.obj")
            self.assertEqual(wrapatlas.load(folder + "/a.obj").face_count, len(faces))

    def test_simplify(self):
        positions, faces = shapes.sphere()
        mesh = wrapatlas.Mesh(positions, faces)
        self.assertLessEqual(wrapatlas.simplify(mesh, 500).face_count, 500)
        share = wrapatlas.simplify(mesh, "10%").face_count
        self.assertTrue(0.09 * len(faces) < share <= 0.101 * len(faces))
        for bad in (0, "x%", "0%", 1.5, None, "200%"):
            with self.assertRaisesRegex(ValueError, "faces="):
                wrapatlas.simplify(mesh, bad)


if __name__ == "__main__":
    unittest.main()
