"""Samples cut at the border of the atlas, as the command saves them and reads them again."""

import os
import pathlib
import subprocess
import tempfile
import unittest

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


if __name__ == "__main__":
    unittest.main()
