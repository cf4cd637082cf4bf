"""wrapatlas transfer: a textured model gets a new atlas, and looks as before."""

import json
import struct
import unittest
import zlib

import gltf_maker
import support


def png(width, height, pixel):
    """An RGB picture; pixel(x, y) gives three numbers from 0 to 255."""
    rows = b"".join(b"\0" + bytes(value for x in range(width) for value in pixel(x, y))
                    for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I",
                                                                        zlib.crc32(kind + data))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0,
                                                              0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def smooth(x, y):
    return 255 * x // 63, 255 * y // 63, 128


def parts(path):
    """(JSON, binary) of a GLB."""
    data = path.read_bytes()
    size = struct.unpack("<I", data[12:16])[0]
    return json.loads(data[20:20 + size]), data[28 + size:]


class Transfer(support.CommandTest):
    def maker(self, picture=png(64, 64, smooth), transform=False, **slots):
        """The can with a picture as its base colour, and as what else is asked for."""
        maker = gltf_maker.textured(transform)
        # Of the one white pixel nothing is left.
        maker.json["images"] = [{"bufferView": maker.view(picture), "mimeType": "image/png"}]
        maker.json["materials"][0].update(slots)
        return maker

    def transfer(self, source, output, *options):
        report = self.report("transfer", source, "-o", output, "--time", 0, "--padding", 2,
                             "--quiet", *options)
        self.assertTrue(all(self.report("info", output)["charts"][key] == 0
                            for key in ("self_overlapping", "faces_without_uv")))
        return report

    def picture_of(self, name):
        gltf, binary = parts(self.path(name))
        view = gltf["bufferViews"][gltf["images"][0]["bufferView"]]
        self.path(name + ".png").write_bytes(
            binary[view["byteOffset"]:view["byteOffset"] + view["byteLength"]])
        return name + ".png"

    def likeness(self, before, after, wrap):
        """PSNR of the two as they are seen; the first one's sampler clamps."""
        for name, more in ((before, ("--wrap", "none")),
                           (after, ("--wrap", wrap, "--compare", before + ".view.png"))):
            report = self.report("render", name, "-o", name + ".view.png", "--texture",
                                 self.picture_of(name), "--shade", "none", "--size", 128,
                                 "--quiet", *more)
        return report["psnr"]

    def as_drawn(self, before, after):
        """PSNR of the two, each with the textures that it names."""
        view = ("--shade", "none", "--size", 128, "--quiet")
        self.report("render", before, "-o", "before.png", *view)
        return self.report("render", after, "-o", "after.png", *view, "--compare",
                           "before.png")["psnr"]

    def test_a_turned_texture(self):
        maker = self.maker(transform=True)
        info = maker.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]
        info["extensions"]["KHR_texture_transform"] = {"rotation": 0.7, "scale": [0.5, 0.8],
                                                       "offset": [0.1, 0.2]}
        self.write("a.glb", maker.glb())
        self.transfer("a.glb", "b.glb")
        self.assertGreater(self.as_drawn("a.glb", "b.glb"), 35)

    def test_uses_that_repeat_otherwise_are_apart(self):
        """Base colour and emission: one picture, but one of them clamps."""
        maker = self.maker(emissiveTexture={"index": 1})
        maker.json["samplers"].append({"wrapS": 10497, "wrapT": 10497})
        maker.json["textures"].append({"source": 0,
                                       "sampler": len(maker.json["samplers"]) - 1})
        self.write("a.glb", maker.glb())
        self.assertEqual(self.transfer("a.glb", "b.glb")["images"], 2)

    def test_variants_are_refused(self):
        maker = self.maker()
        maker.json["extensionsUsed"] = ["KHR_materials_variants"]
        maker.json["extensions"] = {"KHR_materials_variants": {"variants": [{"name": "v"}]}}
        maker.json["meshes"][0]["primitives"][0]["extensions"] = {
            "KHR_materials_variants": {"mappings": [{"material": 0, "variants": [0]}]}}
        self.write("a.glb", maker.glb())
        self.refuse(3, ("a.glb", "KHR_materials_variants"), "transfer", "a.glb", "-o", "b.glb")

    def test_looks_as_before(self):
        self.write("a.glb", self.maker().glb())
        report = self.transfer("a.glb", "b.glb")
        atlas, = report["atlases"]
        self.assertGreaterEqual(atlas["texel_scale"], 1)
        self.assertEqual(atlas["width"] % 4, 0)
        self.assertGreater(self.likeness("a.glb", "b.glb", "uv"), 40)
        gltf, _ = parts(self.path("b.glb"))
        self.assertEqual(len(gltf["images"]), 1)
        used = gltf["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"]
        self.assertEqual(gltf["samplers"][gltf["textures"][used]["sampler"]],
                         {"wrapS": 10497, "wrapT": 10497})
        self.assertEqual(gltf["nodes"][0]["extras"], {"kept": 1})

    def test_a_size_and_no_wrap(self):
        self.write("a.glb", self.maker().glb())
        report = self.transfer("a.glb", "b.glb", "--resolution", "256x128", "--wrap", "none",
                               "--image", "atlas.png")
        atlas, = report["atlases"]
        self.assertEqual((atlas["width"], atlas["height"], report["wrap"]), (256, 128, "none"))
        self.assertGreater(self.likeness("a.glb", "b.glb", "none"), 40)
        self.assertTrue(self.path("atlas.png").exists())
        low, high = (self.report("info", "b.glb")["charts"][key] for key in ("uv_min", "uv_max"))
        self.assertGreaterEqual(min(low), 0)
        self.assertLessEqual(max(high), 1)

    def test_a_texture_transform_goes_into_the_texture(self):
        self.write("a.glb", self.maker(transform=True).glb())
        self.transfer("a.glb", "b.glb")
        self.assertGreater(self.as_drawn("a.glb", "b.glb"), 40)
        gltf, _ = parts(self.path("b.glb"))
        self.assertNotIn("extensions", gltf["materials"][0]["pbrMetallicRoughness"]
                         ["baseColorTexture"])
        self.assertNotIn("extensionsUsed", gltf)

    def test_what_is_read_alike_is_one_texture(self):
        maker = self.maker(occlusionTexture={"index": 0}, emissiveTexture={"index": 0})
        maker.json["materials"][0]["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {
            "index": 0}
        self.write("a.glb", maker.glb())
        report = self.transfer("a.glb", "b.glb")
        # Base colour and emission are colours, the others data.
        self.assertEqual(report["images"], 2)
        gltf, _ = parts(self.path("b.glb"))
        material = gltf["materials"][0]
        metal = material["pbrMetallicRoughness"]
        self.assertEqual(metal["baseColorTexture"]["index"], material["emissiveTexture"]["index"])
        self.assertEqual(metal["metallicRoughnessTexture"]["index"],
                         material["occlusionTexture"]["index"])
        self.assertEqual(len(gltf["images"]), 2)
        self.assertEqual(len(gltf["textures"]), 2)

    def test_what_stays_keeps_its_texture(self):
        other = {"index": 1, "texCoord": 1}
        maker = self.maker(occlusionTexture=other, emissiveTexture={"index": 0})
        attributes = maker.json["meshes"][0]["primitives"][0]["attributes"]
        attributes["TEXCOORD_1"] = attributes["TEXCOORD_0"]
        maker.json["images"].append({"bufferView": maker.view(png(8, 8, smooth)),
                                     "mimeType": "image/png"})
        maker.json["textures"].append({"source": 1, "name": "stays"})
        self.write("a.glb", maker.glb())
        self.transfer("a.glb", "b.glb")
        gltf, _ = parts(self.path("b.glb"))
        material = gltf["materials"][0]
        stays = gltf["textures"][material["occlusionTexture"]["index"]]
        self.assertEqual(stays["name"], "stays")
        self.assertEqual(material["occlusionTexture"]["texCoord"], 1)
        moved = material["pbrMetallicRoughness"]["baseColorTexture"]["index"]
        self.assertEqual(material["emissiveTexture"]["index"], moved)
        self.assertEqual((len(gltf["textures"]), len(gltf["images"])), (2, 2))
        self.assertNotEqual(gltf["textures"][moved]["source"], stays["source"])

    def test_textures_that_stay_keep_their_numbers(self):
        # An extension that is not looked into may name them.
        maker = self.maker(extensions={"MOZ_lightmap": {"index": 1, "texCoord": 1}})
        maker.json["extensionsUsed"] = ["MOZ_lightmap"]
        maker.json["textures"].append({"source": 0, "name": "stays"})
        self.write("a.glb", maker.glb())
        self.transfer("a.glb", "b.glb")
        gltf, _ = parts(self.path("b.glb"))
        self.assertEqual([texture.get("name") for texture in gltf["textures"]], [None, "stays"])

    def test_of_a_clamped_texture_no_clone_stays(self):
        maker = self.maker(occlusionTexture={"index": 0, "texCoord": 1})
        attributes = maker.json["meshes"][0]["primitives"][0]["attributes"]
        attributes["TEXCOORD_1"] = attributes["TEXCOORD_0"]
        maker.json["samplers"] = [{"wrapS": 33071, "wrapT": 33071}]
        maker.json["textures"] = [{"source": 0, "sampler": 0}]
        self.write("a.glb", maker.glb())
        self.transfer("a.glb", "b.glb")
        gltf, _ = parts(self.path("b.glb"))
        self.assertEqual((len(gltf["textures"]), len(gltf["images"])), (2, 2))

    def two_materials(self, first=png(64, 64, smooth),
                      second=png(16, 16, lambda x, y: (200, 10, 10))):
        maker = self.maker(picture=first)
        other = maker.view(second)
        maker.json["images"].append({"bufferView": other, "mimeType": "image/png"})
        maker.json["textures"].append({"source": 1})
        maker.json["materials"].append(
            {"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}})
        first = maker.json["meshes"][0]["primitives"][0]
        maker.node(mesh=maker.mesh({**first, "material": 1}), translation=[5, 0, 0])
        self.write("a.glb", maker.glb())

    def test_materials_keep_atlases_of_their_own(self):
        self.two_materials()
        report = self.transfer("a.glb", "b.glb", "--image", "atlas.png")
        self.assertEqual((report["images_before"], report["images"]), (2, 2))
        self.assertEqual(len(report["atlases"]), 2)
        self.assertTrue(all(atlas["texel_scale"] >= 1 for atlas in report["atlases"]))
        self.assertTrue(self.path("atlas-1.png").exists() and self.path("atlas-2.png").exists())
        gltf, _ = parts(self.path("b.glb"))
        indices = [material["pbrMetallicRoughness"]["baseColorTexture"]["index"]
                   for material in gltf["materials"]]
        self.assertEqual([gltf["images"][gltf["textures"][index]["source"]]["name"]
                          for index in indices], ["1-baseColorTexture", "2-baseColorTexture"])

    def test_pictures_of_several_atlases_overwrite_no_input(self):
        self.two_materials()
        gltf, binary = parts(self.path("a.glb"))
        view = gltf["bufferViews"][gltf["images"][0].pop("bufferView")]
        gltf["images"][0] = {"uri": "atlas-1.png"}
        picture = binary[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]
        self.write("atlas-1.png", picture)
        self.write("c.bin", binary)
        self.write("c.gltf", json.dumps({**gltf, "buffers": [{**gltf["buffers"][0], "uri": "c.bin"}]}))
        self.refuse(2, ("atlas-1.png",), "transfer", "c.gltf", "-o", "d.glb", "--image", "atlas.png")
        self.assertEqual(self.path("atlas-1.png").read_bytes(), picture)
        self.refuse(2, ("atlas-2.png",), "transfer", "a.glb", "-o", "d.glb", "--image", "atlas.png",
                    "--json", "atlas-2.png")

    def test_materials_with_the_same_textures_share_an_atlas(self):
        self.two_materials()
        gltf, binary = parts(self.path("a.glb"))
        gltf["materials"][1]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0
        gltf["textures"].pop()
        gltf["images"].pop()
        self.write("b.gltf", json.dumps({**gltf, "buffers": [
            {**gltf["buffers"][0], "uri": "b.bin"}]}))
        self.write("b.bin", binary)
        report = self.transfer("b.gltf", "c.glb")
        self.assertEqual(report["images"], 1)

    def test_materials_share_the_new_texture(self):
        self.two_materials()
        report = self.transfer("a.glb", "b.glb", "--merge")
        self.assertEqual((report["images_before"], report["images"]), (2, 1))
        gltf, _ = parts(self.path("b.glb"))
        indices = {material["pbrMetallicRoughness"]["baseColorTexture"]["index"]
                   for material in gltf["materials"]}
        self.assertEqual(len(indices), 1)
        self.assertEqual(len(gltf["images"]), 1)

    def test_side_files(self):
        maker = self.maker()
        maker.json["images"] = [{"uri": "a%20b.png"}]
        self.path("a b.png").write_bytes(png(64, 64, smooth))
        self.write("a.bin", bytes(maker.binary))
        self.write("a.gltf", maker.document("a.bin"))
        self.transfer("a.gltf", "b.glb")
        self.transfer("a.gltf", "c.gltf")
        self.assertEqual(self.report("info", "c.gltf")["charts"],
                         self.report("info", "b.glb")["charts"])
        self.path("a b.png").write_bytes(b"no picture")
        self.refuse(3, ("image 0", "PNG"), "transfer", "a.gltf", "-o", "d.glb")
        self.path("a b.png").unlink()
        self.refuse(3, ("a b.png",), "transfer", "a.gltf", "-o", "d.glb")

    def obj(self, library="newmtl a b\nKd 1 1 1\nmap_Kd -clamp on pic ture.png\n", picture=None,
            name="a.mtl"):
        """Two triangles of a square, of a material with a picture."""
        self.write("a.obj", f"mtllib {name}\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\n"
                            "vt 1 1\nvt 0 1\nusemtl a b\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n")
        self.write(name, library)
        self.path("pic ture.png").write_bytes(picture or png(64, 64, smooth))

    def views(self, before, picture, after, wrap, *options):
        self.report("render", before, "-o", "before.png", "--texture", picture, "--shade", "none",
                    "--size", 128, "--quiet", "--wrap", "none")
        return self.report("render", after, "-o", "after.png", "--texture",
                           after[:-4] + "-map_Kd.png", "--shade", "none", "--size", 128, "--quiet",
                           "--wrap", wrap, "--compare", "before.png")["psnr"]

    def test_obj_with_its_materials(self):
        self.obj()
        report = self.transfer("a.obj", "b.obj")
        self.assertEqual((report["images_before"], report["images"]), (1, 1))
        self.assertIn("mtllib b.mtl\n", self.path("b.obj").read_text())
        self.assertEqual(self.path("b.mtl").read_text(),
                         "newmtl a b\nKd 1 1 1\nmap_Kd b-map_Kd.png\n")
        self.assertGreater(self.views("a.obj", "pic ture.png", "b.obj", "uv"), 40)

    def test_obj_whose_library_is_damaged(self):
        self.obj(library="newmtl a b\nmap_Kd gone.png\n")
        self.refuse(3, ("a.mtl", "map_Kd", "gone.png"), "transfer", "a.obj", "-o", "b.obj")
        self.obj(library="map_Kd pic ture.png\n")
        self.refuse(3, ("a.obj", "no face has a texture"), "transfer", "a.obj", "-o", "b.obj")
        self.path("a.mtl").unlink()
        self.refuse(3, ("a.mtl",), "transfer", "a.obj", "-o", "b.obj")
        self.obj(library="newmtl a b\nmap_Kd C:\\work\\pic ture.png\n")
        self.transfer("a.obj", "b.obj")

    def test_obj_in_another_folder(self):
        self.path("out").mkdir()
        self.obj(library="newmtl a b\nmap_Kd -clamp on pic ture.png\nrefl pic ture.png\n")
        self.transfer("a.obj", "out/b.obj")
        self.assertEqual(self.path("out/b.mtl").read_text(),
                         "newmtl a b\nmap_Kd b-map_Kd.png\nrefl ../pic ture.png\n")

    def test_obj_does_not_write_over_its_own_files(self):
        self.obj(name="b.mtl")
        self.refuse(2, ("b.mtl", "input"), "transfer", "a.obj", "-o", "b.obj")
        self.assertFalse(self.path("b.obj").exists())
        self.assertFalse(self.path("b-map_Kd.png").exists())

    def test_new_charts(self):
        """Two triangles that lie apart in the old atlas are one chart in the new one."""
        self.obj()
        text = self.path("a.obj").read_text()
        self.write("a.obj", text.replace("usemtl", "vt 0.1 0.3\nvt 0.7 0.9\nvt 0.1 0.9\nusemtl")
                   .replace("f 1/1 3/3 4/4", "f 1/5 3/6 4/7"))
        kept = self.transfer("a.obj", "b.obj")["atlases"][0]
        cut = self.transfer("a.obj", "c.obj", "--unwrap")["atlases"][0]
        self.assertEqual((kept["charts"], cut["charts"]), (2, 1))
        self.assertGreaterEqual(cut["texel_scale"], 1)
        self.assertGreater(self.views("a.obj", "pic ture.png", "c.obj", "uv"), 40)

    def test_new_charts_of_a_gltf(self):
        picture = png(512, 512, lambda x, y: (x // 2, y // 2, 128))
        self.write("a.glb", self.maker(picture).glb())
        self.transfer("a.glb", "b.glb", "--unwrap")
        # Across the old seams, which now lie within charts, colours blend over a texel.
        self.assertGreater(self.likeness("a.glb", "b.glb", "uv"), 30)

    def test_refuses(self):
        self.write("a.glb", self.maker().glb())
        self.write("plain.glb", gltf_maker.plain().glb())
        self.sample("machine.obj")
        self.write("machine.mtl", "newmtl grey\nKd 0.5 0.5 0.5\n")
        self.refuse(3, ("plain.glb", "no face has a texture"), "transfer", "plain.glb", "-o", "b.glb")
        self.refuse(3, ("machine.obj", "no face has a texture"), "transfer", "machine.obj", "-o",
                    "b.obj")
        self.refuse(2, ("b.obj", "format"), "transfer", "a.glb", "-o", "b.obj")
        self.write("c.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        self.refuse(2, ("c.off", "no textures"), "transfer", "c.off", "-o", "b.obj")
        for options in (("--density", 5), ("--pages", 2), ("--udim",), ("--export", "cut"),
                        ("--aspect", "2:1"), ("--bits", 12)):
            with self.subTest(options=options):
                self.refuse(2, (options[0],), "transfer", "a.glb", "-o", "b.glb", *options)
        self.refuse(2, ("overwrite", "--json"), "transfer", "a.glb", "-o", "b.glb", "--json",
                    "a.glb")
        self.refuse(3, ("nowhere",), "transfer", "a.glb", "-o", "nowhere/b.glb")
        # Repeated so often that each place's own texels would be too many.
        tiled = self.maker(picture=png(1024, 1024, lambda x, y: (x % 256, y % 256, 0)),
                           transform=True)
        info = tiled.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]
        for times in (50, 1e7):
            info["extensions"]["KHR_texture_transform"]["scale"] = [times, times]
            self.write("tiled.glb", tiled.glb())
            self.refuse(4, ("tiled.glb", "--resolution"), "transfer", "tiled.glb", "-o", "b.glb")
        self.assertFalse(self.path("b.glb").exists())


if __name__ == "__main__":
    unittest.main()
