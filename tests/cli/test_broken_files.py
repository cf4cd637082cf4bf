"""Broken files: one clear line that says where, and no trace."""

import random
import struct
import unittest

import support
from small_files import BINARY_STL, GOOD, PLY, STL, STOFF, gltf
from support import SAMPLES, obj, quick, square


class BrokenFiles(support.CommandTest):
    def refuse_file(self, name, content, *words):
        """`info` and `pack` both say what is wrong with this file."""
        self.write(name, content)
        self.refuse(3, (name, *words), "info", name)
        self.refuse_pack(3, (name, *words), name)

    def refuse_gltf(self, document, binary, *words):
        self.write("bad.bin", binary)
        self.refuse_file("bad.gltf", document, *words)

    def test_empty_file(self):
        for name in ("a.obj", "a.off", "a.ply", "a.stl", "a.gltf", "a.glb"):
            with self.subTest(name):
                self.refuse_file(name, b"")

    def test_binary_garbage(self):
        noise = random.Random(1)
        for name in ("a.obj", "a.off", "a.ply", "a.stl", "a.gltf", "a.glb"):
            for size in (7, 100, 20000):
                with self.subTest(name, size=size):
                    self.refuse_file(name, noise.randbytes(size))

    def test_one_format_with_the_ending_of_another(self):
        for name, content in (("a.glb", GOOD), ("a.ply", GOOD), ("a.gltf", GOOD), ("a.off", PLY),
                              ("a.stl", GOOD), ("a.obj", PLY)):
            with self.subTest(name):
                self.refuse_file(name, content)

    def test_cut_off_obj(self):
        self.refuse_file("a.obj", GOOD[: GOOD.index("v 1 0 0") + 5], "a.obj:2", "missing")
        self.refuse_file("a.obj", GOOD[: GOOD.rindex("f ") + 7], "a.obj:18", "three corners")
        self.refuse_file("a.obj", GOOD[: GOOD.rindex("/") + 1], "a.obj:18", "nothing follows")
        self.refuse_file("a.obj", GOOD[: GOOD.index("f ")], "no faces")

    def test_cut_off_off(self):
        self.refuse_file("a.off", STOFF[:20], "a.off:3", "missing")
        self.refuse_file("a.off", STOFF[:38], "a.off")
        self.refuse_file("a.off", STOFF[:-4], "a.off:6", "vertex number")

    def test_cut_off_ply(self):
        self.refuse_file("a.ply", PLY[:30], "a.ply:3")
        self.refuse_file("a.ply", PLY[: PLY.index("end_header")], "a.ply")
        self.refuse_file("a.ply", PLY[:-3], "a.ply")
        mosaic = (SAMPLES / "mosaic.ply").read_bytes()
        for size in (len(mosaic) // 3, len(mosaic) - 1):
            self.refuse_file("a.ply", mosaic[:size], "a.ply")

    def test_cut_off_stl(self):
        self.refuse_file("a.stl", STL[:60], "a.stl")
        for size in (50, 90, len(BINARY_STL) - 1):
            self.refuse_file("a.stl", BINARY_STL[:size], "a.stl", "cut short")
            self.refuse_file("a.stl", (b"solid a" + BINARY_STL[7:])[:size], "a.stl", "cut short")

    def test_cut_off_gltf(self):
        document, binary = gltf()
        self.refuse_gltf(document[: len(document) // 2], binary, "bad.gltf")
        self.refuse_gltf(document, binary[:-1], "buffer 0: it has 71 bytes but says 72")
        self.refuse_gltf(document, b"", "buffer 0")
        (self.folder / "bad.bin").unlink()
        self.refuse_file("bad.gltf", document, "bad.bin")

    def test_cut_off_glb(self):
        coral = (SAMPLES / "coral.glb").read_bytes()
        for size in (3, 11, 15, 500, len(coral) // 2, len(coral) - 1):
            with self.subTest(size=size):
                self.refuse_file("a.glb", coral[:size], "a.glb")

    def test_any_cut_is_refused_or_packed(self):
        """Text formats may end between two faces; what is left is a model."""
        for name, content in (("a.obj", GOOD), ("a.ply", PLY), ("a.off", STOFF)):
            for size in range(1, len(content), 5):
                self.write(name, content[:size])
                result = self.call("pack", name, "-o", "new.obj", *quick())
                if result.returncode == 0:
                    self.path("new.obj").unlink()
                else:
                    self.assert_error(result, 3, name)
                self.assertEqual(list(self.contents()), [name])
            (self.folder / name).unlink()

    def test_coordinates_that_are_no_numbers(self):
        for bad in ("nan", "-nan", "inf", "-inf", "1e300", "1e30", "1e999", "x", "1.2.3"):
            with self.subTest(bad):
                self.refuse_file("a.obj", GOOD.replace("v 1 0 0", f"v 1 {bad} 0"), "a.obj:2", bad)
                self.refuse_file("a.obj", GOOD.replace("vt 1 1", f"vt {bad} 1"), "a.obj:7", bad)
                self.refuse_file("a.ply", PLY.replace("1 0 0 1 0", f"1 0 0 1 {bad}"), "a.ply")
                self.refuse_file("a.off", STOFF.replace("1 0 0 1 0", f"1 0 {bad} 1 0"), "a.off:4")
                self.refuse_file("a.stl", STL.replace("vertex 1 0 0", f"vertex 1 {bad} 0"),
                                 "a.stl:5")
        for bad in (float("nan"), float("inf"), 3e38):
            with self.subTest(bad):
                self.refuse_gltf(*gltf(uvs=((0, 0), (1, bad), (0, 1))), "bad.gltf", "accessor")
                self.refuse_gltf(*gltf(positions=((0, 0, 0), (1, 0, bad), (0, 1, 0))), "accessor")
                self.refuse_file("a.stl", BINARY_STL[:100] + struct.pack("<f", bad)
                                 + BINARY_STL[104:], "a.stl: triangle 0")

    def test_huge_coordinates_that_are_numbers(self):
        """Two charts of which none can be seen at the other's scale, and single ones."""
        self.write("a.obj", obj([square(1e29, -1e29, 1e15), square(0, 0, 1e-29)]))
        self.refuse(1, ("a.obj", "nothing was written"), "pack", "a.obj", "-o", "b.obj", *quick())
        for size in (1e-25, 9e29):
            self.write("a.obj", obj([square(0, 0, size)]))
            self.pack("a.obj", "b.obj")
            self.assertTrue(self.check("b.obj", "a.obj", "--wrap", "uv")["ok"])

    def test_indices_out_of_range(self):
        for bad in ("9/9", "-9/-9", "0/0", "1/99", "4294967297/1", "99999999999999999999/1"):
            with self.subTest(bad):
                self.refuse_file("a.obj", GOOD.replace("f 1/1", f"f {bad}", 1), "a.obj:9")
        for bad in ("3", "-1", "4294967296", "99999999999999999999"):
            with self.subTest(bad):
                self.refuse_file("a.ply", PLY.replace("3 0 1 2", f"3 0 1 {bad}"), "a.ply")
                self.refuse_file("a.off", STOFF.replace("3 0 1 2", f"3 0 1 {bad}"), "a.off:6")
        for bad in (3, 2**32 - 2, 2**32 - 1):
            with self.subTest(bad):
                self.refuse_gltf(*gltf(indices=(0, 1, bad)), "bad.gltf")

    def test_counts_beyond_the_file(self):
        for bad in ("1000000000", "4294967295", "18446744073709551615", "-1"):
            with self.subTest(bad):
                self.refuse_file("a.ply", PLY.replace("vertex 3", f"vertex {bad}"), "a.ply")
                self.refuse_file("a.off", STOFF.replace("3 1 0", f"{bad} 1 0"), "a.off:2")
        self.refuse_file("a.ply", PLY.replace("face 1", "face 4000000000"), "a.ply")
        self.refuse_file("a.stl", b"\0" * 80 + b"\xff" * 54, "a.stl")
        document, binary = gltf()
        self.refuse_gltf(document.replace('"count": 3', '"count": 4000000000'), binary, "accessor")

    def test_no_uvs(self):
        for name in ("a.obj", "a.ply", "a.stl", "a.off"):
            content = {"a.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a.stl": STL,
                       "a.ply": PLY.replace("property float s\nproperty float t\n", "")
                       .replace("0 0 0 0 0", "0 0 0").replace("1 0 0 1 0", "1 0 0")
                       .replace("0 1 0 0 1", "0 1 0"),
                       "a.off": (SAMPLES / "knot.off").read_bytes()}[name]
            with self.subTest(name):
                self.write(name, content)
                self.succeed("info", name)
                self.refuse_pack(3, (name, "UV"), name)
        document, binary = gltf()
        self.write("bad.bin", binary)
        self.write("bad.gltf", document)
        self.refuse_pack(3, ("bad.gltf", "UV"), "bad.gltf", "--texcoord", "1")

    def test_no_charts(self):
        for name, content in (("a.obj", "# nothing\n"), ("b.obj", "v 0 0 0\nvt 0 0\n"),
                              ("a.off", "OFF\n0 0 0\n"), ("a.stl", "solid a\nendsolid a\n"),
                              ("a.gltf", '{"asset": {"version": "2.0"}}')):
            with self.subTest(name):
                self.refuse_file(name, content, "faces")

    def test_all_uvs_collapsed(self):
        for polygon in ([(0.5, 0.5)] * 3, [(0, 0), (1, 1), (2, 2)]):
            self.write("a.obj", obj([polygon]))
            self.refuse_pack(3, ("a.obj", "area", "unwrap"), "a.obj")


if __name__ == "__main__":
    unittest.main()
