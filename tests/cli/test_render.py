"""wrapatlas render: pictures of textured models, and how like others they are."""

import math
import unittest

import gltf_maker
import support
from png_files import read_png, rgb_png

SQUARE = """v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
f 1/1 2/2 3/3 4/4
"""

# The same square, but its texture begins in the middle.
SHIFTED = SQUARE.replace("vt 0", "vt 0.5").replace("vt 1", "vt 1.5")


class Render(support.CommandTest):
    FRONT = ("--azimuth", 0, "--size", 100)

    def setUp(self):
        super().setUp()
        self.write("square.obj", SQUARE)
        self.write("halves.png", rgb_png(8, 8, lambda x, y: (255, 0, 0) if x < 4 else (0, 0, 255)))
        self.write("up.png", rgb_png(1, 1, lambda x, y: (128, 128, 255)))

    def render(self, *options, source="square.obj", output="view.png"):
        return self.report("render", source, "-o", output, "--quiet", *options)

    def pixel(self, x, y, name="view.png"):
        *_, rows = read_png(self.path(name))
        return tuple(rows[y][3 * x:3 * x + 3])

    def test_a_textured_square(self):
        report = self.render(*self.FRONT, "--shade", "none", "--texture", "halves.png")
        self.assertEqual((report["width"], report["height"], report["views"]), (100, 100, 1))
        self.assertEqual(report["covered"], 94 * 94)
        self.assertEqual(read_png(self.path("view.png"))[:4], (100, 100, 8, 3))
        self.assertEqual(self.pixel(20, 50), (255, 0, 0))
        self.assertEqual(self.pixel(80, 50), (0, 0, 255))

    def test_repeats_or_is_clamped(self):
        self.write("shifted.obj", SHIFTED)
        options = (*self.FRONT, "--shade", "none", "--texture", "halves.png")
        self.render(*options, source="shifted.obj")
        self.assertEqual(self.pixel(80, 50), (255, 0, 0))
        self.render(*options, "--wrap", "v", source="shifted.obj")
        self.assertEqual(self.pixel(80, 50), (0, 0, 255))

    def test_the_models_own_textures(self):
        """Two materials, one of which clamps; the third has no picture."""
        self.write("own.obj", "mtllib own.mtl\nusemtl a\n" + SHIFTED +
                   "v 1 -1 0\nv 3 -1 0\nv 3 1 0\nv 1 1 0\nusemtl b\nf 5/1 6/2 7/3 8/4\n"
                   "v 3 -1 0\nv 5 -1 0\nv 5 1 0\nv 3 1 0\nusemtl c\nf 9/1 10/2 11/3 12/4\n")
        self.write("own.mtl", "newmtl a\nmap_Kd halves.png\nnewmtl b\nmap_Kd -clamp on halves.png\n"
                              "newmtl c\nKd 1 1 1\n")
        self.render("--azimuth", 0, "--size", 300, "--shade", "none", source="own.obj")
        places = (35, 80, 130, 175, 240)
        colours = [self.pixel(x, 150) for x in places]
        red, blue = (255, 0, 0), (0, 0, 255)
        # u from 0.5 to 1.5: blue and, repeated, red; clamped it stays blue.
        self.assertEqual(colours[:4], [blue, red, blue, blue])
        self.assertEqual(len(set(colours[4])), 1)
        self.render("--azimuth", 0, "--size", 300, "--shade", "none", "--no-textures",
                    source="own.obj")
        self.assertEqual(self.pixel(35, 150), colours[4])
        self.write("own.mtl", "newmtl a\nmap_Kd none.png\n")
        done = self.call("render", "own.obj", "-o", "view.png", "--size", 40)
        self.assertEqual(done.returncode, 0)
        self.assertIn("drawn without its textures", done.stderr)
        self.assertIn("none.png", done.stderr)

    def test_does_not_write_over_its_own_pictures(self):
        self.write("own.obj", "mtllib own.mtl\nusemtl a\n" + SQUARE)
        self.write("own.mtl", "newmtl a\nmap_Kd halves.png\n")
        before = self.path("halves.png").read_bytes()
        self.refuse(2, ("overwrite", "halves.png"), "render", "own.obj", "-o", "halves.png")
        self.assertEqual(self.path("halves.png").read_bytes(), before)

    def test_nodes_place_their_meshes(self):
        """What is twice as high has another shape on the picture."""
        plain = gltf_maker.plain()
        covered = []
        for scale in (1, 2):
            for node in plain.json["nodes"]:
                node["scale"] = [1, scale, 1]
            self.write("scene.glb", plain.glb())
            report = self.render("--azimuth", 0, "--size", 100, source="scene.glb")
            covered.append(report["covered"])
        self.assertNotEqual(covered[0], covered[1])

    def test_views_side_by_side(self):
        report = self.render("--size", 40, "--views", 3)
        self.assertEqual((report["width"], report["height"]), (120, 40))
        self.assertEqual(read_png(self.path("view.png"))[:2], (120, 40))

    def test_a_picture_is_equal_to_itself(self):
        options = ("--size", 64, "--views", 2)
        self.render(*options, source=self.sample("knot.off"), output="one.png")
        report = self.render(*options, "--compare", "one.png", source="knot.off")
        self.assertIsNone(report["psnr"])
        self.assertEqual(report["ssim"], 1)
        self.assertEqual(self.path("one.png").read_bytes(), self.path("view.png").read_bytes())

    def test_compares_where_the_model_is(self):
        self.write("white.png", rgb_png(1, 1, lambda x, y: (255, 255, 255)))
        self.render(*self.FRONT, "--shade", "none", "--texture", "white.png",
                    output="white-one.png")
        self.write("grey.png", rgb_png(1, 1, lambda x, y: (204, 204, 204)))
        report = self.render(*self.FRONT, "--shade", "none", "--texture", "grey.png", "--compare",
                             "white-one.png")
        self.assertEqual(report["other"], "white-one.png")
        self.assertAlmostEqual(report["psnr"], -20 * math.log10(0.2), places=4)
        said = self.succeed("render", "square.obj", "-o", "view.png", *self.FRONT, "--shade",
                            "none", "--texture", "grey.png", "--compare", "white-one.png").stderr
        self.assertRegex(said, r"PSNR 13\.98 dB, SSIM 0\.\d{4}")

    def test_a_baked_map_makes_a_simple_model_look_like_the_detailed_one(self):
        scan = self.sample("knot.off")
        self.succeed("unwrap", scan, "-o", "low.glb", "--resolution", 256, "--time", 0, "--quiet")
        self.succeed("bake", "low.glb", scan, "-o", "object.png", "--map", "object",
                     "--resolution", 256, "--also", "tangent=tangent.png", "--quiet")
        views = ("--size", 128, "--views", 2, "--framed-as", scan)
        self.render("--size", 128, "--views", 2, source=scan, output="scan.png")
        flat = self.render(*views, "--shade", "flat", "--compare", "scan.png", source="low.glb")
        for space in ("object", "tangent"):
            baked = self.render(*views, "--normal-map", f"{space}.png", "--space", space,
                                "--compare", "scan.png", source="low.glb")
            self.assertGreater(baked["psnr"], flat["psnr"] + 5)
            self.assertGreater(baked["ssim"], flat["ssim"])

    def test_same_bytes_for_any_number_of_threads(self):
        self.render("--size", 64, "--threads", 1, source=self.sample("knot.off"), output="1.png")
        self.render("--size", 64, "--threads", 3, source="knot.off", output="3.png")
        self.assertEqual(self.path("1.png").read_bytes(), self.path("3.png").read_bytes())

    def test_refuses(self):
        usage = (
            (("--space", "object"), "no normal map"),
            (("--no-textures", "--filter", "bilinear"), "no texture is drawn"),
            (("--no-textures", "--level", 1), "no texture is drawn"),
            (("--no-textures", "--texture", "halves.png"), "takes their place"),
            (("--wrap", "u"), "repeat as it says"),
            (("--texture", "halves.png", "--filter", "bilinear", "--level", 1), "level 0"),
            (("--normal-map", "up.png", "--shade", "flat"), "normal map"),
            (("--normal-map", "up.png", "--space", "object", "--hard-edges", 9), "object space"),
            (("--shade", "flat", "--hard-edges", 9), "nothing is smooth"),
            (("--azimuth", 9, "--views", 2), "single view"),
            (("--size", 4096, "--views", 17), "65536"),
            (("--size", 15), "out of range"),
            (("--elevation", 91), "out of range"),
            (("--texcoord", 1), "glTF"),
            (("--json", "view.png"), "same file"),
            (("--json", "square.obj"), "overwrite"),
            (("--texture", "halves.png", "--json", "halves.png"), "overwrite"),
        )
        for options, word in usage:
            with self.subTest(options=options):
                self.refuse(2, (word,), "render", "square.obj", "-o", "view.png", *options)
        self.refuse(2, (".png",), "render", "square.obj", "-o", "view.svg")

    def test_refuses_files(self):
        self.write("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.write("junk.png", "no picture")
        self.write("small.png", rgb_png(9, 9, lambda x, y: (0, 0, 0)))
        self.write("empty.obj", "")
        self.write("textured.obj", "mtllib other.mtl\n" + SQUARE)
        self.write("other.mtl", "")
        self.succeed("bake", "square.obj", "square.obj", "-o", "grey.png", "--map", "occlusion",
                     "--resolution", 4, "--quiet")
        unusable = (
            ("bare.obj", ("--texture", "halves.png"), "UVs"),
            ("square.obj", ("--texture", "junk.png"), "junk.png"),
            ("square.obj", ("--normal-map", "grey.png"), "grey.png"),
            ("square.obj", ("--compare", "small.png"), "9 x 9"),
            ("square.obj", ("--framed-as", "none.obj"), "none.obj"),
            ("none.obj", (), "none.obj"),
        )
        for source, options, word in unusable:
            with self.subTest(source=source, options=options):
                self.refuse(3, (word,), "render", source, "-o", "view.png", "--size", 32, *options)
        self.refuse(3, ("nowhere",), "render", "square.obj", "-o", "nowhere/view.png")
        self.refuse(2, ("other.mtl",), "render", "square.obj", "-o", "view.png", "--framed-as",
                    "textured.obj", "--json", "other.mtl")
        self.assertFalse(self.path("view.png").exists())


if __name__ == "__main__":
    unittest.main()
