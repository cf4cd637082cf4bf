"""Samples cut at the border of the atlas, as the command saves them and reads them again."""

import os
import pathlib
import subprocess
import tempfile
import unittest

import support

SAMPLES = pathlib.Path(__file__).resolve().parents[2] / "samples"
WRAPATLAS = os.environ.get("WRAPATLAS", "wrapatlas")


class CutSamples(unittest.TestCase):
    def check_cut(self, name, resolution, padding, ending):
        with tempfile.TemporaryDirectory() as folder:
            packed = pathlib.Path(folder) / ("packed" + ending)
            sizes = ["--resolution", str(resolution), "--padding", str(padding)]
            for command in (
                ["pack", SAMPLES / name, "-o", packed, "--export", "cut", "--grid", "128", "--quiet", *sizes],
                ["check", packed, "--ref", SAMPLES / name, "--wrap", "none", *sizes],
            ):
                run = subprocess.run([WRAPATLAS, *command], capture_output=True, text=True)
                self.assertEqual(run.returncode, 0, (command, run.stdout, run.stderr))

    def test_every_sample(self):
        for name in ("coral.glb", "mosaic.ply", "machine.obj"):
            for resolution, padding in ((512, 1), (1024, 2), (2048, 8)):
                with self.subTest(name=name, resolution=resolution):
                    self.check_cut(name, resolution, padding, pathlib.Path(name).suffix)

    def test_other_formats(self):
        for ending in (".obj", ".ply"):
            with self.subTest(ending=ending):
                self.check_cut("mosaic.ply", 1024, 4, ending)

    def test_textures_of_every_size(self):
        for name in ("coral.glb", "mosaic.ply", "machine.obj"):
            for resolution in (16384, 32768, 65536):
                with self.subTest(name=name, resolution=resolution):
                    self.check_cut(name, resolution, resolution // 256, pathlib.Path(name).suffix)


class CutOddPlaces(support.CommandTest):
    """Faces whose places in space hardly tell their corners apart, or not at all."""

    def cut_and_check(self, content, *endings):
        self.write("a.obj", content)
        for ending in endings or (".obj", ".ply", ".glb"):
            with self.subTest(ending=ending):
                self.pack("a.obj", "b" + ending, "--export", "cut")
                self.assertTrue(self.check("b" + ending, "a.obj", "--cut", "uv")["ok"])

    def test_face_without_area_in_space(self):
        self.cut_and_check("v 0 0 0\nv 0 0 0\nv 0 1 0\nvt .1 .2\nvt .5 .2\nvt .5 .9\n"
                           "f 1/1 2/2 3/3\n")

    def test_corners_of_a_face_at_one_place(self):
        places = ("5 4 4", "6 6 0", "0 0 4", "4 5 6", "6 6 0")
        texcoords = (".0830425 .055713", ".00131097 .0299713", "-.0140067 .0990142",
                     "-.0218158 -.020593", "-.115624 -.276823")
        self.cut_and_check("".join(f"v {p}\n" for p in places) +
                           "".join(f"vt {t}\n" for t in texcoords) + "f 1/1 2/2 3/3 4/4 5/5\n")

    def test_one_corner_very_far_out(self):
        for far in ("1e9", "-1e10", "1e11"):
            self.cut_and_check(f"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 {far}\nvt 0 0\nvt .5 0\n"
                               "vt .5 .6\nvt 0 .7\nf 1/1 2/2 3/3 4/4\n", ".obj", ".ply")

    def test_georeferenced_places(self):
        """Triangles of five centimetres, 5000 kilometres from the origin."""
        lines = [f"v {451234 + 0.05 * i:.3f} {5412345 + 0.05 * j:.3f} 120\nvt {i / 10} {j / 5}"
                 for i in range(9) for j in range(2)]
        for k in range(1, 17, 2):
            lines += [f"f {k}/{k} {k + 2}/{k + 2} {k + 1}/{k + 1}",
                      f"f {k + 1}/{k + 1} {k + 2}/{k + 2} {k + 3}/{k + 3}"]
        self.cut_and_check("\n".join(lines) + "\n")


if __name__ == "__main__":
    unittest.main()
