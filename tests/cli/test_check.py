"""`wrapatlas check` from outside: what it finds, what it advises, what it says it cannot know."""

import json
import unittest

import support
from support import PACKABLE, obj, obj_lines, rectangle, square


class Hints(support.CommandTest):
    def hints(self, *arguments, status=1):
        """Of text and JSON, which have to be the same."""
        result = self.call("check", *arguments)
        self.assertEqual(result.returncode, status, result.stderr)
        told = [line.split(": hint: ")[1] for line in result.stderr.splitlines()
                if ": hint: " in line]
        self.call("check", *arguments, "--quiet", "--json", "report.json")
        self.assertEqual(self.read("report.json")["hints"], told)
        return told

    def read(self, name):
        return json.loads(self.path(name).read_text())

    def test_forgotten_wrap(self):
        for wrap, axes, chart in (("uv", "u and v", square(0.8, 0.8, 0.4)),
                                  ("u", "u", rectangle(0.8, 0.3, 0.4, 0.4)),
                                  ("v", "v", rectangle(0.3, 0.8, 0.4, 0.4))):
            self.write("a.obj", obj([chart]))
            for reference in ((), ("--ref", "a.obj")):
                with self.subTest(wrap, reference=reference):
                    self.assertEqual(
                        self.hints("a.obj", "--resolution", 256, "--padding", 2, *reference),
                        [f"UVs leave [0,1] along {axes}; if the atlas wraps there, give --wrap "
                         f"{wrap}: then every promise holds"])

    def test_wrap_that_does_not_mend_all(self):
        charts = [square(0.8, 0.8, 0.4), square(0.3, 0.3, 0.2), square(0.4, 0.4, 0.2)]
        self.write("a.obj", obj(charts))
        hint, = self.hints("a.obj", "--resolution", 256)
        self.assertIn("give --wrap uv: then 1 of 2 violations are left", hint)

    def test_too_much_wrap(self):
        sides = [rectangle(0, 0.3, 0.2, 0.2), rectangle(0.8, 0.3, 0.2, 0.2)]
        ends = [rectangle(0.3, 0, 0.2, 0.2), rectangle(0.3, 0.8, 0.2, 0.2)]
        for charts, hint in ((sides, "wraps along v only, give --wrap v"),
                             (ends, "wraps along u only, give --wrap u"),
                             (sides + ends, "does not wrap, give --wrap none")):
            self.write("a.obj", obj(charts))
            self.assertEqual(
                self.hints("a.obj", "--resolution", 256, "--padding", 2, "--wrap", "uv"),
                [f"if the atlas {hint}: then every promise holds"])

    def test_forgotten_resolution(self):
        """12 texels apart at 4096, 3 at 1024."""
        apart = 12 / 4096
        self.write("a.obj", obj([rectangle(0.2, 0.2, 0.3, 0.3),
                                 rectangle(0.5 + apart, 0.2, 0.3, 0.3)]))
        self.assertEqual(self.hints("a.obj", "--padding", 11.9),
                         ["--resolution was not given, so distances were measured at 1024 texels; "
                          "with --resolution 4096 every promise holds"])
        self.assertEqual(self.hints("a.obj", "--padding", 11.9, "--resolution", 1024), [])

    def test_forgotten_shape(self):
        """A square and a slanted bar, as they are on an atlas twice as wide as high."""
        charts = [square(), [(2, 0), (3, 1), (2.8, 1.2), (1.8, 0.2)]]
        squeezed = [[(0.1 * u, 0.2 * v) for u, v in chart] for chart in charts]
        self.write("a.obj", obj(charts))
        lines = obj_lines(obj(charts), "v") + obj_lines(obj(squeezed), "vt") + [
            line for line in obj(charts).splitlines() if line.startswith("f")]
        self.write("b.obj", "\n".join(lines) + "\n")
        self.succeed("check", "b.obj", "--ref", "a.obj", "--resolution", "512x256")
        hint, = self.hints("b.obj", "--ref", "a.obj")
        self.assertIn("sides are as 2 : 1, not 1 : 1; give its --resolution WxH", hint)

    def test_none_where_nothing_helps(self):
        self.write("a.obj", obj([square(0.1, 0.1, 0.5), square(0.3, 0.3, 0.5)]))
        self.assertEqual(self.hints("a.obj", "--resolution", 64), [])

    def test_none_where_all_is_well(self):
        self.write("a.obj", obj([square(0.1, 0.1, 0.5)]))
        self.assertEqual(self.hints("a.obj", status=0), [])


class Scope(support.CommandTest):
    """What was checked, and what was not."""

    def test_what_is_not_checked(self):
        self.write("a.obj", obj([square(0.1, 0.1, 0.5)]))
        for options, words in (((), ("--ref", "--padding")), (("--padding", 0), ("--ref",)),
                               (("--ref", "a.obj"), ("--padding",)),
                               (("--ref", "a.obj", "--padding", "1"), ())):
            with self.subTest(options):
                told = self.report("check", "a.obj", *options)["not_checked"]
                self.assertEqual(len(told), len(words))
                for text, word in zip(told, words):
                    self.assertIn(word, text)
                    self.assertIn(f"a.obj: not checked: {text}\n",
                                  self.succeed("check", "a.obj", *options).stderr)

    def test_last_line_says_what_was_promised(self):
        self.write("a.obj", obj([square(0.25, 0.25, 0.5)]))
        result = self.succeed("check", "a.obj", "--resolution", "64x32", "--padding", "1.5",
                              "--margin", "2", "--wrap", "u")
        self.assertEqual(result.stderr.splitlines()[-1],
                         "a.obj: ok: 1 chart, 25.0 % in use; 64 x 32 texels, wrap u, padding 1.5, "
                         "margin 2")

    def test_smallest_gap_is_null_beyond_what_is_looked_for(self):
        self.write("a.obj", obj([rectangle(0, 0, 0.25, 0.5), rectangle(0.5, 0, 0.25, 0.5)]))
        near, far = (self.report("check", "a.obj", "--resolution", 64, "--padding", padding)
                     for padding in (15.5, 1))
        self.assertAlmostEqual(near["smallest_gap"], 16, places=3)
        self.assertGreater(near["gaps_sought_below"], 16)
        self.assertIsNone(far["smallest_gap"])
        self.assertTrue(1 < far["gaps_sought_below"] <= 2)

    def test_cut_atlases_without_reference(self):
        for name in PACKABLE:
            for wrap in ("uv", "u", "v"):
                with self.subTest(name, wrap=wrap):
                    self.sample(name)
                    out = "cut." + name.split(".")[1]
                    report = self.pack_report(name, out, "--export", "cut", "--wrap", wrap)
                    judged = self.report("check", out, "--resolution", 256, "--padding", 2)
                    self.assertEqual((judged["ok"], judged["charts"]), (True, report["charts"]))

    def test_margin_of_a_cut_atlas(self):
        self.sample("machine.obj")
        for wrap in ("u", "v"):
            self.pack("machine.obj", "b.obj", "--export", "cut", "--wrap", wrap, "--margin", 9)
            promise = ("b.obj", "--ref", "machine.obj", "--resolution", 256, "--padding", 2)
            self.assertTrue(self.report("check", *promise, "--cut", wrap, "--margin", 9)["ok"])
            for options in (("--margin", 9), ("--cut", wrap, "--margin", 12),
                            ("--cut", "uv".replace(wrap, ""), "--margin", 9)):
                result = self.call("check", *promise, *options)
                self.assertEqual(result.returncode, 1)
                self.assertIn("of a side", result.stderr)


if __name__ == "__main__":
    unittest.main()
