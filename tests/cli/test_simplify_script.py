"""bench/simplify.py: what it measures, on meshes where that is known. Without numpy and scipy, no test."""

import csv
import importlib.util
import pathlib
import subprocess
import sys
import unittest

from support import COMMAND, CommandTest

BENCH = pathlib.Path(__file__).resolve().parents[2] / "bench"
CUBE = """OFF
8 6 0
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
4 3 2 1 0
4 4 5 6 7
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
"""


@unittest.skipUnless(all(map(importlib.util.find_spec, ("numpy", "scipy"))),
                     "there is no numpy or no scipy")
class SimplifyScript(CommandTest):
    def test_what_it_measures(self):
        self.write("cube.off", CUBE)
        self.sample("knot.off")
        done = subprocess.run([sys.executable, BENCH / "simplify.py", "cube.off", "knot.off",
                               "--faces", "12", "--samples", "500", "--runs", "1", "--csv", "a.csv",
                               "--wrapatlas", COMMAND],
                              cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        cube, knot = csv.DictReader(self.path("a.csv").read_text().splitlines())
        self.assertEqual((cube["before"], cube["after"]), ("12", "12"))  # written as it is
        self.assertLess(float(cube["hausdorff"]), 1e-9)
        self.assertLess(float(knot["volume"]), 1e-9)
        self.assertGreater(float(knot["hausdorff"]), float(knot["mean"]))
        self.assertGreater(float(knot["mean"]), 1)

    def test_distances(self):
        sys.path.insert(0, str(BENCH))
        import numpy
        import simplify
        a, b, c = (numpy.array([p], dtype=float) for p in ((0, 0, 0), (4, 0, 0), (0, 4, 0)))
        for point, distance in (((1, 1, 3), 3), ((1, -2, 0), 2), ((-3, -4, 0), 5),
                                ((4, 4, 0), 8 ** 0.5), ((7, -4, 0), 5)):
            found = simplify.to_triangle(numpy.array([point], dtype=float), a, b, c)
            self.assertAlmostEqual(float(found[0]), distance)


if __name__ == "__main__":
    unittest.main()
