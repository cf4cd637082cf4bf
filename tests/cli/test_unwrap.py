"""`wrapatlas unwrap`: bare models come out with UVs that keep every promise."""

import pathlib
import struct
import unittest

import support
from support import obj_lines

MODELS = pathlib.Path(__file__).resolve().parents[3] / "shared/data/models"
FAST = ("--resolution", 256, "--padding", 2, "--time", 0, "--quiet")

CUBE = """o cube
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
usemtl paint
f 4 3 2 1
f 5 6 7 8
usemtl steel
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
"""


class Unwrap(support.CommandTest):
    def unwrap(self, source, output, *options):
        return self.report("unwrap", source, "-o", output, *FAST, *options)

    def check_alone(self, output, report, padding=2):
        """The result for itself: no chart overlaps another or itself, padding holds."""
        result = self.report("check", output, "--resolution",
                             f"{report['width']}x{report['height']}", "--padding", padding,
                             "--wrap", report["wrap"], "--quiet")
        self.assertTrue(result["ok"])

    def test_a_bare_model(self):
        report = self.unwrap(self.sample("knot.off"), "a.obj")
        self.assertEqual(report["command"], "unwrap")
        self.assertTrue(report["valid"])
        self.assertLessEqual(report["stretch"]["l2_max"], 2)
        self.assertEqual(report["charts_beyond_limits"], 0)
        self.assertEqual(len(report["unwrapped"]), report["charts"])
        for stage in ("repair", "segment", "flatten", "pack"):
            self.assertIn(stage, report["seconds"])
        header = self.path("knot.off").read_text().split()[1:3]
        lines = self.path("a.obj").read_text()
        self.assertEqual(len(obj_lines(lines, "v")), int(header[0]))
        faces = obj_lines(lines, "f")
        self.assertEqual(len(faces), int(header[1]))
        self.assertTrue(all("/" in word for line in faces for word in line.split()[1:]))
        self.check_alone("a.obj", report)

    def test_each_format_goes_to_each(self):
        self.write("a.obj", CUBE)
        self.unwrap("a.obj", "b.ply")
        self.unwrap("b.ply", "c.glb")
        self.unwrap("c.glb", "d.gltf")
        report = self.unwrap("d.gltf", "e.obj")
        self.assertEqual(report["faces"], 12)  # glTF knows triangles only
        self.check_alone("e.obj", report)
        triangle = struct.pack("<12fH", *([0] * 3 + [0, 0, 0, 1, 0, 0, 0, 1, 0]), 0)
        self.write("t.stl", b"\0" * 80 + struct.pack("<I", 1) + triangle)
        self.check_alone("t.obj", self.unwrap("t.stl", "t.obj"))

    def test_the_rest_of_the_file_stays(self):
        self.write("a.obj", "# kept\nmtllib m.mtl\n" + CUBE)
        self.unwrap("a.obj", "b.obj")
        text = self.path("b.obj").read_text()
        for line in ("# kept", "mtllib m.mtl", "usemtl steel", "o cube"):
            self.assertIn(line + "\n", text)

    def test_unwrapped_again_from_its_own_result(self):
        self.write("a.obj", CUBE)
        one = self.unwrap("a.obj", "b.obj")
        two = self.unwrap("b.obj", "c.obj")
        self.assertEqual(one["unwrapped"], two["unwrapped"])
        self.check_alone("c.obj", two)

    def test_cuts_on_request(self):
        self.write("a.obj", CUBE)
        self.assertEqual(self.unwrap("a.obj", "b.obj", "--hard-edges", 45)["charts"], 6)
        self.assertEqual(self.unwrap("b.obj", "c.obj", "--keep-seams")["charts"], 6)
        self.assertEqual(self.unwrap("a.obj", "d.obj", "--split-materials")["charts"], 3)
        whole = self.unwrap("a.obj", "e.obj")["charts"]
        self.assertLess(whole, 3)

    def test_limits(self):
        source = self.sample("knot.off")
        loose = self.unwrap(source, "a.obj", "--max-extent", 0)["charts"]
        tight = self.unwrap(source, "b.obj", "--max-stretch", 1.05, "--max-extent", 0)
        self.assertGreater(tight["charts"], loose)
        self.assertLessEqual(tight["stretch"]["l2_max"], 1.05)
        few = self.unwrap(source, "c.obj", "--max-stretch", 1.05, "--max-charts", loose,
                          "--max-extent", 0)
        self.assertLessEqual(few["charts"], loose)
        linf = self.unwrap(source, "d.obj", "--stretch", "linf", "--max-stretch", 2)
        self.assertLessEqual(linf["stretch"]["linf_max"], 2)
        lscm = self.unwrap(source, "e.obj", "--flatten", "lscm")
        self.assertTrue(all(chart["lscm"] for chart in lscm["unwrapped"]))

    def test_charts_that_a_page_has_to_hold(self):
        """The knot is one long strip, which a square that does not wrap holds badly."""
        source = self.sample("knot.off")
        found = {extent: self.unwrap(source, "a.obj", "--wrap", "none", "--max-extent", extent)
                 for extent in (0, 1, 0.8)}
        self.assertGreater(found[1]["efficiency"], 2 * found[0]["efficiency"])
        self.assertGreater(found[1]["charts"], found[0]["charts"])
        self.assertEqual(found[1]["max_extent"], 1)
        for wrap, extent in (("none", 0.8), ("u", 1.5), ("uv", 1.5)):
            self.assertEqual(self.unwrap(source, "b.obj", "--wrap", wrap)["max_extent"], extent)
        self.assertEqual(self.unwrap(source, "b.obj", "--wrap", "none")["charts"],
                         found[0.8]["charts"])
        self.refuse(2, ("--max-extent", "0 to 1000"), "unwrap", source, "-o", "b.obj",
                    "--max-extent", -1)

    def test_stops_after_a_stage(self):
        source = self.sample("knot.off")
        report = self.report("unwrap", source, "-o", "a.obj", "--quiet", "--stop-after", "charts")
        text = self.path("a.obj").read_text()
        objects = obj_lines(text, "o")  # one run of faces each
        self.assertEqual(len(objects), report["charts"])
        self.assertEqual(len(set(objects)), report["charts"])
        self.assertEqual(len(obj_lines(text, "f")), report["faces"])
        self.assertEqual(obj_lines(text, "vt"), [])
        report = self.report("unwrap", source, "-o", "b.obj", "--quiet", "--stop-after", "flat")
        self.assertNotIn("efficiency", report)
        info = self.report("info", "b.obj")["charts"]
        self.assertEqual(info["count"], report["charts"])
        self.assertEqual(info["stacked"], 0)
        self.assertEqual(info["self_overlapping"], 0)
        for option in (("--resolution", 64), ("--method", "modulo"), ("--udim",), ("--time", 1)):
            self.refuse(2, (option[0], "nothing is packed"), "unwrap", source, "-o", "c.obj",
                        "--stop-after", "flat", *option)
        told = self.call("unwrap", source, "-o", "c.obj", "--stop-after", "flat")
        self.assertIn("-> c.obj", told.stderr)

    def test_a_gltf_without_uvs_gets_them(self):
        for name in ("bare.glb", "bare.gltf"):
            self.succeed("unwrap", self.sample("knot.off"), "-o", name, "--stop-after", "charts")
            self.assertIsNone(self.report("info", name)["charts"])
            report = self.unwrap(name, "a" + name)
            charts = self.report("info", "a" + name)["charts"]
            self.assertEqual(charts["count"], report["charts"])
            self.assertEqual(charts["faces_without_uv"], 0)
            self.check_alone("a" + name, report)

    def test_adds_a_uv_set(self):
        bare, coral = "bare.glb", self.sample("coral.glb")
        self.write("a.obj", CUBE)
        self.unwrap("a.obj", bare)
        report = self.unwrap(bare, "two.glb", "--texcoord", 1)
        self.assertEqual(self.report("info", "two.glb", "--texcoord", 1)["charts"]["count"],
                         report["charts"])
        self.assertEqual(self.report("info", "two.glb")["charts"],
                         self.report("info", bare)["charts"])
        self.refuse(3, ("coral.glb", "TEXCOORD_2"), "unwrap", coral, "-o", "c.glb",
                    "--texcoord", 2)
        self.refuse(3, ("coral.glb", "TEXCOORD_1"), "pack", coral, "-o", "c.glb", "--texcoord", 1)

    def test_broken_surfaces_are_mended_and_told(self):
        two = "f 1 2 3\nf 1 3 2\n"  # one face and its back
        bow = "f 1 2 3\nf 1 4 5\n"
        fin = "f 1 2 3\nf 2 1 4\nf 1 2 5\n"
        turned = "f 1 2 3\nf 2 3 4\n"
        folded = "f 1 2 3\nf 1 1 2\nf 2 2 2\n"
        flat = "f 1 2 3\nf 1 2 6\n"
        points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nv 0 -1 1\nv 0.5 0 0\n"
        cases = ((two, "duplicate_faces", 1), (bow, "shared_points", 1), (fin, "crowded_edges", 1),
                 (turned, "turned_faces", 1), (folded, "folded_faces", 2), (flat, "flat_faces", 1))
        for faces, repair, count in cases:
            with self.subTest(repair):
                self.write("a.obj", points + faces)
                report = self.unwrap("a.obj", "b.obj")
                self.assertEqual(report["repairs"][repair], count)
                written = obj_lines(self.path("b.obj").read_text(), "f")
                self.assertEqual(len(written), faces.count("f "))
                self.assertTrue(all(word.count("/") == 1 for line in written
                                    for word in line.split()[1:]))
                self.check_alone("b.obj", report)
                loud = self.call("unwrap", "a.obj", "-o", "c.obj", "--time", 0)
                self.assertRegex(loud.stderr, r"a\.obj: note: " + str(count))

    def test_says_when_charts_cannot_be_joined(self):
        self.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\n"
                   "f 1 2 3\nf 4 5 6\n")
        done = self.call("unwrap", "a.obj", "-o", "b.obj", "--max-charts", 1, "--time", 0)
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stderr, "note: 2 charts remain, more than --max-charts 1: .*parts")

    def test_says_when_an_option_cuts_nothing(self):
        self.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        done = self.call("unwrap", "a.obj", "-o", "b.obj", "--keep-seams", "--split-materials",
                         "--time", 0)
        self.assertIn("--keep-seams keeps none", done.stderr)
        self.assertIn("--split-materials cuts nowhere", done.stderr)

    def test_same_bytes_for_any_number_of_threads(self):
        source = self.sample("knot.off")
        for threads in (1, 2, 5):
            self.unwrap(source, f"{threads}.obj", "--threads", threads)
        self.assertEqual(self.path("1.obj").read_bytes(), self.path("2.obj").read_bytes())
        self.assertEqual(self.path("1.obj").read_bytes(), self.path("5.obj").read_bytes())

    def test_pictures(self):
        source = self.sample("knot.off")
        self.unwrap(source, "a.obj", "--view", "view.png", "--heat", "heat.png", "--image", "a.png")
        for name, width, height in (("view.png", 1536, 768), ("heat.png", 1024, 1024),
                                    ("a.png", 1024, 1024)):
            data = self.path(name).read_bytes()
            self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
            self.assertEqual(struct.unpack(">II", data[16:24]), (width, height))
        self.unwrap(source, "a.obj", "--heat", "small.png", "--image-size", 64)
        self.assertEqual(struct.unpack(">II", self.path("small.png").read_bytes()[16:24]), (64, 64))
        self.refuse(2, ("--image-size", "no picture"), "unwrap", source, "-o", "c.obj",
                    "--image-size", 64)
        self.succeed("unwrap", source, "-o", "b.obj", "--stop-after", "charts", "--view", "v.png")
        self.assertEqual(self.path("v.png").read_bytes(), self.path("view.png").read_bytes())
        # The seams are those of the new charts, not of UVs that the model had.
        self.succeed("unwrap", "a.obj", "-o", "b.obj", "--stop-after", "flat", "--view", "v2.png")
        self.assertEqual(self.path("v2.png").read_bytes(), self.path("view.png").read_bytes())
        refusals = ((("--heat", "v.png"), "nothing is packed", ("--stop-after", "flat")),
                    (("--view", "v.svg"), "pixels", ()), (("--view", "c.obj"), "", ()),
                    (("--view", "same.png", "--heat", "same.png"), "", ()),
                    (("--heat", "h.png", "--pages", 2, "--wrap", "none"), "one page", ()))
        for options, word, more in refusals:
            with self.subTest(options=options):
                self.refuse(2, (word,), "unwrap", source, "-o", "c.obj", *options, *more)

    def test_refuses(self):
        self.write("empty.obj", "")
        self.write("a.obj", CUBE)
        self.refuse(3, ("empty.obj", "no faces"), "unwrap", "empty.obj", "-o", "b.obj")
        self.refuse(3, ("none.obj",), "unwrap", "none.obj", "-o", "b.obj")
        self.refuse(2, ("--max-stretch", "1"), "unwrap", "a.obj", "-o", "b.obj",
                    "--max-stretch", 0.5)
        self.refuse(2, ("b.stl", "UVs"), "unwrap", "a.obj", "-o", "b.stl")
        self.refuse(3, ("nowhere",), "unwrap", "a.obj", "-o", "nowhere/b.obj")
        self.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")
        self.refuse(3, ("flat.obj", "no area"), "unwrap", "flat.obj", "-o", "b.obj")


@unittest.skipUnless(MODELS.is_dir(), "the data beside the repository is not there")
class RealModels(support.CommandTest):
    """Each kind of defect as real files have it."""

    DEFECTS = {"beetle.obj": ("crowded_edges", "shared_points"), "cow.obj": ("shared_points",),
               "suzanne.obj": ("shared_points",), "teapot.obj": ("shared_points",)}

    def test_every_face_in_charts_within_the_limits(self):
        for path in sorted(MODELS.glob("*.obj")):
            with self.subTest(path.name):
                report = self.report("unwrap", path, "-o", "a.obj", *FAST)
                self.assertTrue(report["valid"])
                self.assertEqual(report["charts_beyond_limits"], 0)
                self.assertLessEqual(report["stretch"]["l2_max"], 2)
                self.assertEqual(report["faces_without_uv"], 0)
                for repair in self.DEFECTS.get(path.name, ()):
                    self.assertGreater(report["repairs"][repair], 0)


if __name__ == "__main__":
    unittest.main()
