"""wrapatlas bake: maps of a detailed model on the atlas of a simpler one."""

import json
import math
import struct
import unittest

import gltf_maker
import support
from png_files import read_png, rgb_png

SQUARE = """v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
f 1/1 2/2 3/3 4/4
"""
# Above it, and tilted: its normal is (-0.6, 0, 0.8).
TILTED = "v -1 -1 -0.7\nv 2 -1 1.55\nv 2 2 1.55\nv -1 2 -0.7\nf 1 2 3 4\n"


def one_colour(factor, textured=False, tangent=None, diffuse=None, **node):
    """The square, of a material with a factor."""
    made = gltf_maker.GltfMaker()
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    if textured:
        made.textured_material()
    else:
        made.json["materials"] = [{"pbrMetallicRoughness": {}}]
    made.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = factor
    if diffuse:
        made.json["materials"][0]["extensions"] = {
            "KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": diffuse}}
    attributes = {"POSITION": made.positions(corners),
                  "TEXCOORD_0": made.accessor([(x, y) for x, y, _ in corners])}
    if tangent:
        attributes["TANGENT"] = made.accessor([tangent] * 4)
    made.node(mesh=made.mesh({"attributes": attributes, "material": 0,
                              "indices": made.indices([0, 1, 2, 0, 2, 3])}), **node)
    return made.glb()


class Bake(support.CommandTest):
    def setUp(self):
        super().setUp()
        self.write("low.obj", SQUARE)
        self.write("high.obj", TILTED)

    def bake(self, *options, low="low.obj", high="high.obj", output="n.png"):
        return self.report("bake", low, high, "-o", output, "--quiet", *options)

    def test_normals_of_a_tilted_plane(self):
        for space in ("object", "tangent"):  # of this square they are the same
            report = self.bake("--map", space, "--resolution", "16x8")
            self.assertEqual((report["width"], report["height"]), (16, 8))
            self.assertEqual(report["texels_used"], 128)
            width, height, bits, channels, rows = read_png(self.path("n.png"))
            self.assertEqual((width, height, bits, channels), (16, 8, 8, 3))
            for value, expected in zip(rows[4][:3], (0.2 * 255, 127.5, 0.9 * 255)):
                self.assertAlmostEqual(value, expected, delta=1)

    def test_along_the_tangents_of_the_file(self):
        """A viewer uses them as they are, whatever the UVs. The plane's normal is (-0.6, 0, 0.8)."""
        for tangent, node, stored in (
                ((0, 1, 0, 1), {}, (0, 0.6, 0.8)), ((0, 1, 0, -1), {}, (0, -0.6, 0.8)),
                ((1, 0, 0, 1), {"rotation": (0, 0, math.sqrt(0.5), math.sqrt(0.5)),
                                "translation": (1, 0, 0)}, (0, 0.6, 0.8)),
                ((1, 0, 0, 1), {"scale": (-1, 1, 1), "translation": (1, 0, 0)}, (0.6, 0, 0.8))):
            self.write("low.glb", one_colour((1, 1, 1, 1), tangent=tangent, **node))
            self.bake("--resolution", 8, low="low.glb")
            pixel = read_png(self.path("n.png"))[4][3][:3]
            for value, expected in zip(pixel, stored):
                self.assertAlmostEqual(value, 127.5 * (1 + expected), delta=1.5, msg=str(tangent))
        self.write("low.glb", one_colour((1, 1, 1, 1), tangent=(0, 1, 0, 1)))
        self.bake("--resolution", 8, "--hard-edges", 60, low="low.glb")  # its own axes are not wanted
        self.assertAlmostEqual(read_png(self.path("n.png"))[4][3][0], 0.2 * 255, delta=1)

    def test_sixteen_bits(self):
        self.bake("--map", "object", "--resolution", 8, "--bits", 16)
        *_, bits, channels, rows = read_png(self.path("n.png"))
        self.assertEqual((bits, channels), (16, 3))
        values = struct.unpack(">3H", rows[3][:6])
        for value, expected in zip(values, (0.2, 0.5, 0.9)):
            self.assertAlmostEqual(value / 65535, expected, delta=1e-4)

    def test_fit(self):
        self.assertIs(self.bake("--resolution", 8)["fit"], True)
        self.assertIs(self.bake("--resolution", 8, "--no-fit")["fit"], False)
        same = ("bake", "low.obj", "high.obj", "-o", "n.png", "--no-fit")
        self.refuse(2, ("--no-fit", "no normals"), *same, "--map", "position")
        self.assertIs(self.bake("--resolution", 8, "--no-fit", "--samples", 1)["fit"], False)

    def test_several_maps_in_one_run(self):
        report = self.bake("--resolution", 8, "--also", "occlusion=ao.png", "--also",
                           "position=p.png")
        self.assertEqual([one["kind"] for one in report["maps"]],
                         ["tangent", "occlusion", "position"])
        self.assertEqual(read_png(self.path("ao.png"))[3], 1)
        self.assertEqual(read_png(self.path("p.png"))[3], 3)

    def test_mips(self):
        self.bake("--resolution", "8x4", "--mips")
        sizes = [read_png(self.path(name))[:2]
                 for name in ("n.png", "n.1.png", "n.2.png", "n.3.png")]
        self.assertEqual(sizes, [(8, 4), (4, 2), (2, 1), (1, 1)])
        self.assertFalse(self.path("n.4.png").exists())
        same = ("bake", "low.obj", "high.obj", "-o", "n.png", "--resolution", "8x4", "--mips")
        self.refuse(2, ("--mips n.2.png", "same file"), *same, "--also", "occlusion=n.2.png")
        self.refuse(2, ("n.1.png", "--color-from"), *same, "--map", "color", "--color-from",
                    "n.1.png")

    def test_colour_of_a_texture(self):
        # What is baked on the same UVs at the same size is the texture itself.
        self.bake("--map", "object", "--resolution", 8, output="t.png")
        self.write("same.obj", SQUARE)
        self.bake("--map", "color", "--color-from", "t.png", "--resolution", 8, high="same.obj")
        self.assertEqual(read_png(self.path("n.png"))[4], read_png(self.path("t.png"))[4])

    def colours(self, high):
        """Of the corner texels at (0, 0) and (1, 1)."""
        self.bake("--map", "color", "--resolution", 64, high=high)
        *_, rows = read_png(self.path("n.png"))
        return tuple(rows[-1][:3]), tuple(rows[0][-3:])

    def test_colour_of_vertices(self):
        self.write("painted.obj", "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 1 1 0 0 0 1\nv 0 1 0 0 0 1\n"
                                  "f 1 2 3 4\n")
        (red, none, _), (_, _, blue) = self.colours("painted.obj")
        self.assertGreater(min(red, blue), 245)
        self.assertEqual(none, 0)

    def test_colour_of_a_material_without_a_texture(self):
        self.write("same.obj", "mtllib a.mtl\nusemtl a\n" + SQUARE)
        self.write("a.mtl", "newmtl a\nKd 1 0.2158605 0\n")
        for high in ("same.obj", "same.glb"):
            self.write("same.glb", one_colour((1, 0.2158605, 0, 1)))
            self.bake("--map", "color", "--resolution", 8, high=high)
            self.assertEqual(tuple(read_png(self.path("n.png"))[4][3][:3]), (255, 128, 0), high)

    def test_a_factor_multiplies_the_texture_of_a_gltf_alone(self):
        """Kd beside a map_Kd is what its exporter left there."""
        self.write("white.png", gltf_maker.PNG)
        self.write("same.obj", "mtllib a.mtl\nusemtl a\n" + SQUARE)
        self.write("a.mtl", "newmtl a\nKd 0.2158605 0 0\nmap_Kd white.png\n")
        self.write("same.glb", one_colour((1, 0.2158605, 0, 1), textured=True))
        for high, colour in (("same.obj", (255, 255, 255)), ("same.glb", (255, 128, 0))):
            self.bake("--map", "color", "--resolution", 8, high=high)
            self.assertEqual(tuple(read_png(self.path("n.png"))[4][3][:3]), colour, high)

    def test_one_colour_of_a_gltf_material_that_has_two(self):
        self.write("same.glb", one_colour((0, 0, 1, 1), textured=True, diffuse=(1, 0.2158605, 0, 1)))
        self.bake("--map", "color", "--resolution", 8, high="same.glb")
        self.assertEqual(tuple(read_png(self.path("n.png"))[4][3][:3]), (255, 128, 0))

    def test_colours_by_the_high_models_second_uvs(self):
        maker = gltf_maker.two_uv_sets()
        maker.textured_material()
        base = maker.json["materials"][0]["pbrMetallicRoughness"]
        base["baseColorTexture"]["texCoord"] = 1
        maker.json["meshes"][0]["primitives"][0]["material"] = 0
        self.write("can.glb", maker.glb())
        bake = ("bake", "can.glb", "can.glb", "-o", "n.png", "--map", "color", "--resolution", 16)
        self.refuse(3, ("can.glb", "UV set 0", "--high-texcoord"), *bake)
        self.succeed(*bake, "--high-texcoord", 1)
        self.assertEqual(tuple(read_png(self.path("n.png"))[4][3][:3]), (255, 255, 255))
        self.refuse(3, ("can.glb", "no UV set TEXCOORD_2", "by --high-texcoord"), *bake,
                    "--high-texcoord", 2)

    def test_keywords_of_an_obj_in_any_case(self):
        self.write("red.png", rgb_png(1, 1, lambda x, y: (255, 0, 0)))
        self.write("same.obj", "mtllib a.mtl\nusemtl a\n" + SQUARE)
        self.write("a.mtl", "newmtl a\nkd 0 1 0\nmap_kd red.png\n")
        self.bake("--map", "color", "--resolution", 8, high="same.obj")
        self.assertEqual(tuple(read_png(self.path("n.png"))[4][3][:3]), (255, 0, 0))

    def test_faces_without_uvs_below_a_texture(self):
        """They have the colours of their vertices."""
        self.write("red.png", rgb_png(1, 1, lambda x, y: (255, 0, 0)))
        self.write("a.mtl", "newmtl a\nmap_Kd red.png\n")
        self.write("high.obj", "mtllib a.mtl\nusemtl a\nvt 0 0\n" + "".join(
            f"v {x} {y} 0 0 0 1\n" for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
            + "f 1/1 2/1 3/1\nf 1 3 4\n")
        self.bake("--map", "color", "--resolution", 8)
        rows = read_png(self.path("n.png"))[4]
        self.assertEqual(tuple(rows[6][18:21]), (255, 0, 0))
        self.assertEqual(tuple(rows[1][3:6]), (0, 0, 255))

    def test_models_that_do_not_lie_over_each_other(self):
        self.write("far.obj", TILTED.replace("v -1", "v 9").replace("v 2", "v 12"))
        self.refuse(3, ("low.obj", "no ray", "far.obj", "--distance"), "bake", "low.obj", "far.obj",
                    "-o", "n.png", "--distance", 0.5)
        self.assertFalse(self.path("n.png").exists())

    def test_faces_outside_an_atlas_that_does_not_wrap(self):
        self.write("low.obj", SQUARE.replace("vt 1 ", "vt 1.5 "))
        for wrap, count in (("none", 2), ("v", 2), ("u", 0), ("uv", 0)):
            done = self.call("bake", "low.obj", "high.obj", "-o", "n.png", "--resolution", 8, "--wrap",
                             wrap, "--json", "r.json")
            self.assertEqual(done.returncode, 0)
            self.assertEqual(json.loads(self.path("r.json").read_text())["faces_outside"], count)
            self.assertEqual("2 faces lie partly outside" in done.stderr, count == 2, wrap)

    def test_a_gltf_packed_into_an_obj_lies_where_its_scene_has_it(self):
        self.write("moved.glb", one_colour((1, 1, 1, 1), translation=[5, 0, 0]))
        for command in ("pack", "unwrap"):
            self.succeed(command, "moved.glb", "-o", "u.obj", "--resolution", 64, "--time", 0,
                         "--quiet")
            self.assertIn("v 6 1 0", self.path("u.obj").read_text())
            report = self.bake("--resolution", 64, low="u.obj", high="moved.glb")
            self.assertEqual(report["texels_nearest"], 0)
        self.succeed("pack", "moved.glb", "-o", "u.obj", "--resolution", 64, "--time", 0, "--quiet")
        self.succeed("check", "u.obj", "--reference", "moved.glb", "--resolution", 64, "--wrap", "uv")

    def test_mips_of_colours_are_means_of_light(self):
        """From black to white, evenly in light: its mean is half the light."""
        self.write("painted.obj", "v 0 0 0 0 0 0\nv 1 0 0 1 1 1\nv 1 1 0 1 1 1\nv 0 1 0 0 0 0\n"
                                  "f 1 2 3 4\n")
        self.bake("--map", "color", "--resolution", 8, "--wrap", "none", "--mips",
                  high="painted.obj")
        *_, rows = read_png(self.path("n.3.png"))
        self.assertAlmostEqual(rows[0][0], 188, delta=1)  # sRGB of 0.5

    def test_colour_of_the_models_own_materials(self):
        self.bake("--map", "object", "--resolution", 8, output="t.png")
        self.write("same.obj", "mtllib a.mtl\nusemtl a\n" + SQUARE)
        self.write("a.mtl", "newmtl a\nmap_Kd t.png\n")
        self.bake("--map", "color", "--resolution", 8, high="same.obj")
        self.assertEqual(read_png(self.path("n.png"))[4], read_png(self.path("t.png"))[4])

    def test_normals_of_the_file(self):
        """A flat square whose file says that it is tilted, as high model and as low one."""
        tilted = SQUARE.replace("f 1/1 2/2 3/3 4/4", "vn -0.6 0 0.8\nf 1/1/1 2/2/1 3/3/1 4/4/1")
        self.write("tilted.obj", tilted)
        self.bake("--map", "object", "--resolution", 8, high="tilted.obj")
        for value, expected in zip(read_png(self.path("n.png"))[4][4][:3],
                                   (0.2 * 255, 127.5, 0.9 * 255)):
            self.assertAlmostEqual(value, expected, delta=1)
        self.bake("--map", "tangent", "--resolution", 8, low="tilted.obj", high="tilted.obj")
        for value, expected in zip(read_png(self.path("n.png"))[4][4][:3], (127.5, 127.5, 255)):
            self.assertAlmostEqual(value, expected, delta=1)
        self.bake("--map", "object", "--resolution", 8, "--high-hard-edges", 30, high="tilted.obj")
        self.assertAlmostEqual(read_png(self.path("n.png"))[4][4][2], 255, delta=1)

    def test_a_packed_model(self):
        source = self.sample("knot.off")
        self.succeed("unwrap", source, "-o", "low.glb", "--resolution", 256, "--time", 0,
                     "--quiet")
        report = self.bake("--resolution", 256, low="low.glb", high=source)
        self.assertEqual(report["texels_nearest"], 0)
        self.assertGreater(report["texels_used"], 256 * 256 * 0.4)
        *_, rows = read_png(self.path("n.png"))
        blues = [row[i] for row in rows for i in range(2, len(row), 3)]
        # The model on itself, but for the diagonals of its quads: normals are straight up everywhere.
        self.assertGreater(min(blues), 235)

    def test_same_bytes_for_any_number_of_threads(self):
        for threads in (1, 3):
            self.bake("--also", "occlusion=ao.png", "--resolution", 32, "--threads", threads)
            for name in ("n", "ao"):
                self.path(f"{name}.png").rename(self.path(f"{name}-{threads}.png"))
        for name in ("n", "ao"):
            self.assertEqual(self.path(f"{name}-1.png").read_bytes(),
                             self.path(f"{name}-3.png").read_bytes(), name)

    def test_says_what_was_left_out(self):
        self.write("low.obj", SQUARE + "f 1 2 3\n")
        done = self.call("bake", "low.obj", "high.obj", "-o", "n.png", "--resolution", 8,
                         "--distance", 0.3)  # x of a third and less are nearer
        self.assertEqual(done.returncode, 0)
        self.assertIn("1 face has no UVs", done.stderr)
        self.assertIn("warning: at 48 texels no ray met high.obj within 0.3", done.stderr)
        self.assertIn("-> n.png", done.stderr)

    def test_refuses(self):
        self.write("bare.obj", TILTED)
        self.write("empty.obj", "")
        self.write("junk.png", "no picture")
        usage = (
            (("--also", "tangent=a.png"), "asked for twice"),
            (("--also", "shine=a.png"), "not a kind"),
            (("--also", "occlusion"), "not a kind"),
            (("--also", "occlusion=a.jpg"), "PNG"),
            (("--also", "occlusion=n.png"), "same file"),
            (("--color-from", "junk.png"), "no colour is baked"),
            (("--occlusion-rays", 5), "no occlusion is baked"),
            (("--bits", 9), "8 or 16"),
            (("--samples", 0), "out of range"),
            (("--texcoord", 1), "glTF"),
            (("--high-texcoord", 1), "no colour is baked"),
            (("--map", "color", "--high-texcoord", 1), "high.obj can hold one UV set only"),
        )
        for options, word in usage:
            with self.subTest(options=options):
                self.refuse(2, (word,), "bake", "low.obj", "high.obj", "-o", "n.png", *options)
        self.refuse(2, ("PNG",), "bake", "low.obj", "high.obj", "-o", "n.jpg")
        self.refuse(2, ("--json", "overwrite"), "bake", "low.obj", "high.obj", "-o", "n.png",
                    "--json", "high.obj")
        self.refuse(3, ("bare.obj", "UVs"), "bake", "bare.obj", "high.obj", "-o", "n.png")
        self.refuse(3, ("empty.obj", "no faces"), "bake", "low.obj", "empty.obj", "-o", "n.png")
        self.refuse(3, ("none.obj",), "bake", "low.obj", "none.obj", "-o", "n.png")
        self.refuse(3, ("nowhere",), "bake", "low.obj", "high.obj", "-o", "nowhere/n.png")
        self.refuse(3, ("junk.png",), "bake", "low.obj", "high.obj", "-o", "n.png", "--map",
                    "color", "--color-from", "junk.png")
        self.refuse(3, ("high.obj", "--color-from"), "bake", "low.obj", "high.obj", "-o", "n.png",
                    "--map", "color")
        self.assertFalse(self.path("n.png").exists())


if __name__ == "__main__":
    unittest.main()
