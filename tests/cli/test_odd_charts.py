"""Charts that a packing can live with although they are odd, and those that do not fit."""

import json
import unittest

import support
from small_files import GOOD, STOFF
from support import obj, obj_lines, quick, rectangle, square


class Repairs(support.CommandTest):
    """Defects that a packing can live with: all faces are still there and the check holds."""

    def pack_and_check(self, content, *options, stacked=False):
        keep = ("--stacked", "keep") if stacked else ()
        self.write("a.obj", content)
        report = self.pack_report("a.obj", "b.obj", *keep, *options)
        self.assertTrue(report["valid"])
        judged = self.check("b.obj", "a.obj", "--wrap", report["wrap"], *keep)
        self.assertTrue(judged["ok"])
        packed = self.path("b.obj").read_text()
        self.assertEqual(len(obj_lines(packed, "f")), len(obj_lines(content, "f")))
        return report

    def notes(self, content):
        self.write("a.obj", content)
        return self.succeed("pack", "a.obj", "-o", "b.obj", *quick()).stderr

    def test_triangles_of_no_area(self):
        good = [square(), square(2), [(4, 0), (5, 0), (4, 1)]]
        bad = [[(0, 0), (0, 0), (0, 0)], [(3, 3), (4, 4), (5, 5)], [(1, 1), (2, 2), (1, 1)]]
        report = self.pack_and_check(obj(good + bad))
        self.assertEqual(report["charts"], 6)

    def test_chart_with_a_sliver(self):
        points = [(0, 0), (1, 0), (1, 1), (0, 1), (0.5, 0)]
        lines = [f"v {u} {v} 0\nvt {u} {v}" for u, v in points]
        self.pack_and_check("\n".join(lines) + "\nf 1/1 5/5 2/2\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n")

    def test_nothing_but_lines(self):
        """A chart that is collinear but for rounding is no reason to ask for more texels."""
        for line in ([(0, 0), (0.5, 0), (1, 0)], [(0.1, 0.2), (0.3, 0.4), (0.4, 0.5)]):
            self.write("a.obj", obj([line]))
            self.refuse_pack(3, ("a.obj", "no area", "collapsed"), "a.obj")

    def test_mirrored_charts(self):
        bend = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]
        mirrored = [(8 - u, v) for u, v in bend]
        self.assertEqual(self.pack_and_check(obj([bend, mirrored, bend[::-1]]))["charts"], 3)

    def test_a_face_folded_over_its_neighbour(self):
        text = obj([square()]) + "f 1/1 3/3 2/2\n"
        self.pack_and_check(text)

    def test_overlapping_charts_are_taken_apart(self):
        report = self.pack_and_check(obj([square(), square(0.5, 0.25), square(0.7, 0.1)]))
        self.assertEqual((report["charts"], report["stacked"]), (3, 3))

    def test_overlapping_charts_may_stay_together(self):
        text = obj([square(), square(0.5, 0.25), square(3, 3)])
        self.assertEqual(self.pack_and_check(text, stacked=True)["charts"], 2)

    def test_a_chart_that_overlaps_itself_is_reported(self):
        fold = obj([square(), square(9)]) + "f 1/1 3/3 2/2\n"
        self.assertIn("a.obj: note: 1 chart overlaps itself in the input\n", self.notes(fold))
        self.pack_and_check(fold)

    def test_a_search_for_stacked_charts_that_ends_early_says_so(self):
        """Slanted strips side by side: all boxes overlap, no charts do."""
        strips = [[(0, y), (2000, y + 2000), (2000, y + 2000.5), (0, y + 0.5)]
                  for y in range(1000)]
        self.write("a.obj", obj(strips))
        self.write("few.obj", obj(strips[:50]))
        self.assertFalse(self.report("info", "a.obj")["charts"]["all_stacks_found"])
        self.assertTrue(self.report("info", "few.obj")["charts"]["all_stacks_found"])
        self.assertIn("0 or more", self.succeed("info", "a.obj").stdout)
        result = self.succeed("pack", "a.obj", "-o", "b.obj", "--method", "lprm02", "--resolution",
                              "2048", "--padding", "0", "--grid", "512", "--json", "b.json")
        self.assertIn("a.obj: note: not all charts that overlap others were", result.stderr)
        self.assertFalse(json.loads(self.path("b.json").read_text())["all_stacks_found"])
        self.assertTrue(self.pack_report("few.obj", "b.obj")["all_stacks_found"])

    def test_faces_that_cross_themselves_keep_their_hull(self):
        """However a program triangulates them, nothing else lies there."""
        star = [(0, 3), (2, -3), (-3, 1), (3, 1), (-2, -3)]
        zigzag = [(0.3, 0.4), (0.2, 0.2), (0.1, 0.3), (0.3, 0.2), (0, 0)]
        spike = [(6.3, 0.2), (6.6, 0.3), (6.6, 0.6), (6.6, 0.3), (6.6, 0.4)]
        self.assertIn("a.obj: note: face 1 crosses itself in UV: its convex hull is kept free for "
                      "it\n", self.notes(obj([square(9), star])))
        self.assertIn("2 faces cross themselves in UV (face 0 is the first)",
                      self.notes(obj([star, zigzag])))
        self.pack_and_check(obj([star, square(9)]))
        self.pack_and_check(obj([zigzag, [(1, 0), (1.3, 0), (1, 0.3)]]))
        self.pack_and_check(obj([spike, square(0.5), zigzag]))
        result = self.succeed("check", "b.obj", "--resolution", "256", "--wrap", "uv")
        self.assertIn("face 2 crosses itself in the texture", result.stderr)

    def test_triangles_of_a_gltf_stay_within_the_polygon(self):
        """Convex in space, bent in the texture: the triangles that look good would leave it."""
        bend = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]
        places = [(2, 0), (1, 2), (-1, 2), (-2, 0), (-1, -2), (1, -2)]
        lines = [f"v {x} {y} 0\nvt {u} {v}" for (x, y), (u, v) in zip(places, bend)]
        lines.append("f " + " ".join(f"{k}/{k}" for k in (1, 2, 3, 4, 5, 6)))
        self.write("a.obj", "\n".join(lines) + "\n")
        efficiency = self.pack_report("a.obj", "b.glb")["efficiency"]
        judged = self.check("b.glb", "a.obj", "--wrap", "uv")
        self.assertAlmostEqual(judged["efficiency"], efficiency, places=4)

    def test_many_small_charts(self):
        """Text of floats is no more exact than floats, and small charts show it in their scales."""
        charts = [[(i % 60, i // 60), (i % 60 + 0.3 + i % 7 / 10, i // 60),
                   (i % 60, i // 60 + 0.2 + i % 5 / 10)] for i in range(3000)]
        self.write("a.obj", obj(charts))
        size = ("--resolution", 4096, "--padding", 16)
        self.pack("a.obj", "b.obj", "--method", "lprm02", *size)
        self.assertTrue(self.check("b.obj", "a.obj", resolution=4096, padding=16)["ok"])

    def test_duplicate_faces(self):
        twice = GOOD + "\n".join(obj_lines(GOOD, "f")) + "\n"
        report = self.pack_and_check(twice)
        self.assertEqual(report["placed"], report["charts"])

    def test_faces_without_uvs_stay(self):
        text = GOOD + "f 1 2 3\n"
        self.assertEqual(self.pack_and_check(text)["faces_without_uv"], 1)
        self.assertEqual(obj_lines(self.path("b.obj").read_text(), "f")[-1], "f 1 2 3")
        self.assertIn("a.obj: note: 1 face has no UVs and stays as it is\n", self.notes(text))

    def test_far_off_and_negative_uvs(self):
        self.pack_and_check(obj([square(-1000, 500), square(2000, -3)]))

    def test_one_chart(self):
        report = self.pack_and_check(obj([square()]))
        self.assertEqual((report["charts"], report["placed"]), (1, 1))
        self.assertGreater(report["efficiency"], 0.8)

    def test_charts_of_very_different_size(self):
        report = self.pack_and_check(obj([square(0, 0, 1), square(2, 0, 1e-7)]))
        self.assertEqual(report["placed"], 2)

    def test_left_aside_faces_are_noted(self):
        self.write("a.off", STOFF.replace("3 1 0", "3 2 0") + "2 0 1\n")
        result = self.succeed("pack", "a.off", "-o", "b.obj", *quick())
        self.assertIn("a.off: note: left aside 1 faces", result.stderr)


class TooLarge(support.CommandTest):
    def test_padding_beyond_the_page(self):
        self.write("a.obj", GOOD)
        for padding in ("50", "64", "300"):
            for method in ("modulo", "swg03"):
                with self.subTest(padding, method=method):
                    self.refuse_pack(4, ("a.obj", "padding"), "a.obj", "--method", method,
                                     "--resolution", "64", "--padding", padding)

    def test_margin_beyond_the_page(self):
        self.write("a.obj", GOOD)
        self.refuse_pack(4, ("a.obj", "margin"), "a.obj", "--wrap", "none", "--resolution", "64",
                         "--margin", "32")

    def test_long_thin_chart(self):
        """Too long for the page along its side, so it lies small or winds around; nothing hangs."""
        self.write("a.obj", obj([rectangle(0, 0, 1000, 1)]))
        for wrap in ("none", "u", "uv"):
            with self.subTest(wrap):
                self.pack("a.obj", "b.obj", "--wrap", wrap)
                self.assertTrue(self.check("b.obj", "a.obj", "--wrap", wrap)["ok"])

    def test_one_texel(self):
        self.write("a.obj", GOOD)
        self.refuse_pack(4, ("a.obj", "resolution"), "a.obj", "--resolution", "1")

    def test_more_charts_than_texels(self):
        self.write("a.obj", obj([square(2 * i) for i in range(300)]))
        self.refuse_pack(4, ("a.obj", "300 charts", "padding"), "a.obj", "--resolution", "16",
                         "--grid", "16")

    def test_100000_charts(self):
        count, side = 100000, 317
        charts = [rectangle(i % side, i // side, 0.2 + 0.7 * (i % 7) / 7, 0.3 + 0.6 * (i % 5) / 5)
                  for i in range(count)]
        self.write("a.obj", obj(charts))
        report = self.report("pack", "a.obj", "-o", "b.obj", "--resolution", "4096", "--padding",
                             "1", "--method", "lprm02", "--grid", "1024", "--quiet")
        self.assertEqual((report["charts"], report["placed"]), (count, count))
        self.assertEqual(len(obj_lines(self.path("b.obj").read_text(), "f")), count)


if __name__ == "__main__":
    unittest.main()
