"""bench/jigsaw.py: pieces are discs that fill the domain, the same ones each time, and pack."""

import pathlib
import subprocess
import sys
import unittest

from support import CommandTest, obj, obj_lines

BENCH = pathlib.Path(__file__).resolve().parents[2] / "bench"
sys.path.insert(0, str(BENCH))
import jigsaw  # noqa: E402
import outlines  # noqa: E402

CASES = [(2, 0, True, 0.5), (7, 1, True, 0.9), (12, 2, True, 0.05), (30, 3, True, 0.5),
         (2, 0, False, 0.5), (7, 1, False, 0.9), (30, 3, False, 0.5)]


def crosses(a, b, c, d):
    """Whether the segments ab and cd have a point in common."""
    side = outlines.cross
    return side(a, b, c) * side(a, b, d) <= 0 and side(c, d, a) * side(c, d, b) <= 0


def is_simple(polygon):
    sides = list(zip(polygon, polygon[1:] + polygon[:1]))
    return not any(crosses(*sides[i], *sides[j]) for i in range(len(sides))
                   for j in range(i + 2, len(sides)) if (i, j) != (0, len(sides) - 1))


class Jigsaw(CommandTest):
    def test_pieces_are_discs_whose_areas_add_up(self):
        for case in CASES:
            with self.subTest(case=case):
                pieces = jigsaw.cut(*case)
                self.assertEqual(len(pieces), case[0])
                self.assertTrue(all(map(is_simple, pieces)))
                self.assertTrue(all(outlines.signed_area(piece) > 0 for piece in pieces))
                self.assertAlmostEqual(sum(map(outlines.signed_area, pieces)), 1, delta=1e-12)

    def test_put_together_they_fill_the_atlas(self):
        for case in CASES:
            with self.subTest(case=case):
                self.write("solved.obj", obj(jigsaw.cut(*case)))
                report = self.report("check", "solved.obj", "--resolution", 256, "--wrap",
                                     "uv" if case[2] else "none", "--quiet")
                self.assertEqual(report["charts"], case[0])
                self.assertAlmostEqual(report["efficiency"], 1, delta=1e-6)

    def test_triangles_make_up_the_piece(self):
        for piece in jigsaw.cut(12, 1):
            triangles = outlines.triangulate(piece)
            self.assertEqual(len(triangles), len(piece) - 2)
            areas = [outlines.signed_area([piece[k] for k in t]) for t in triangles]
            self.assertGreater(min(areas), 0)
            self.assertAlmostEqual(sum(areas), outlines.signed_area(piece), delta=1e-12)

    def test_same_options_same_bytes(self):
        for number in "12":
            subprocess.run([sys.executable, BENCH / "jigsaw.py", "--pieces", "8", "--seed", "5",
                            "-o", self.path(f"{number}.obj")], check=True)
        first = self.path("1.obj").read_text()
        self.assertEqual(first, self.path("2.obj").read_text())
        self.assertEqual(first, jigsaw.jigsaw(8, 5))
        for other in (jigsaw.jigsaw(8, 6), jigsaw.jigsaw(8, 5, wrap=False),
                      jigsaw.jigsaw(8, 5, roughness=0.2)):
            self.assertNotEqual(obj_lines(other, "vt"), obj_lines(first, "vt"))

    def test_guided_puts_a_jigsaw_together(self):
        for wrap in (True, False):
            with self.subTest(wrap=wrap):
                self.write("jigsaw.obj", jigsaw.jigsaw(9, 4, wrap))
                axes = "uv" if wrap else "none"
                report = self.report("pack", "jigsaw.obj", "-o", "packed.obj", "--method",
                                     "guided", "--time", 4, "--resolution", 512, "--wrap", axes,
                                     "--padding", 0, "--quiet")
                self.assertGreater(report["efficiency"], 0.92)
                self.check("packed.obj", "jigsaw.obj", "--wrap", axes, resolution=512, padding=0)

    def test_a_jigsaw_packs(self):
        for wrap in (True, False):
            with self.subTest(wrap=wrap):
                self.write("jigsaw.obj", jigsaw.jigsaw(10, 1, wrap))
                axes = "uv" if wrap else "none"
                report = self.pack_report("jigsaw.obj", "packed.obj", "--method", "modulo",
                                          "--wrap", axes, "--padding", 0)
                self.assertEqual(report["charts"], 10)
                self.assertAlmostEqual(report["efficiency"], (report["scale"] / 256) ** 2,
                                       delta=1e-6)  # the charts' areas add up to 1
                self.check("packed.obj", "jigsaw.obj", "--wrap", axes, padding=0)


if __name__ == "__main__":
    unittest.main()
