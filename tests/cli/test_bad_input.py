"""Bad input and bad surroundings: one clear line and no trace, or repaired with nothing lost."""

import json
import os
import random
import resource
import shutil
import struct
import subprocess
import unittest

import support
from support import COMMAND, SAMPLES, obj, obj_lines, quick, rectangle, square

GOOD = obj([square(), square(2)])
PLY_HEADER = ("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
              "property float z\nproperty float s\nproperty float t\nelement face 1\n"
              "property list uchar int vertex_indices\nend_header\n")
PLY = PLY_HEADER + "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n"
STOFF = "STOFF\n3 1 0\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n"
STL = ("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
       "endloop\nendfacet\nendsolid a\n")
BINARY_STL = bytes(80) + struct.pack("<I12fH", 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)


def gltf(positions=((0, 0, 0), (1, 0, 0), (0, 1, 0)), uvs=((0, 0), (1, 0), (0, 1)),
         indices=(0, 1, 2)):
    """A glTF and its .bin."""
    parts = [struct.pack(f"<{3 * len(positions)}f", *sum(positions, ())),
             struct.pack(f"<{2 * len(uvs)}f", *sum(uvs, ())),
             struct.pack(f"<{len(indices)}I", *indices)]
    views, offset = [], 0
    for part in parts:
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": len(part)})
        offset += len(part)
    document = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": offset, "uri": "bad.bin"}],
        "bufferViews": views,
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(positions), "type": "VEC3",
             "min": [0, 0, 0], "max": [1, 1, 0]},
            {"bufferView": 1, "componentType": 5126, "count": len(uvs), "type": "VEC2"},
            {"bufferView": 2, "componentType": 5125, "count": len(indices), "type": "SCALAR"}],
        "meshes": [{"primitives": [
            {"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2}]}],
    }
    return json.dumps(document), b"".join(parts)


def file_size_limit(size):
    """For `call`: makes a write fail half-way, as on a full disk; needs no rights."""
    return {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)),
            "restore_signals": False}


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
        ring = [(0, 0), (4, 0), (4, 2), (1, 2), (1, -1), (2, -1), (2, 1), (3, 1), (3, 1.5), (0, 1)]
        self.assertIn("a.obj: note: 1 charts overlap themselves", self.notes(obj([ring])))
        self.pack_and_check(obj([ring, square(9)]))

    def test_duplicate_faces(self):
        twice = GOOD + "\n".join(obj_lines(GOOD, "f")) + "\n"
        report = self.pack_and_check(twice)
        self.assertEqual(report["placed"], report["charts"])

    def test_faces_without_uvs_stay(self):
        text = GOOD + "f 1 2 3\n"
        self.assertEqual(self.pack_and_check(text)["faces_without_uv"], 1)
        self.assertEqual(obj_lines(self.path("b.obj").read_text(), "f")[-1], "f 1 2 3")
        self.assertIn("a.obj: note: 1 faces have no UVs and stay as they are", self.notes(text))

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


class Surroundings(support.CommandTest):
    """Files that are not there, cannot be read, or cannot be written."""

    def setUp(self):
        super().setUp()
        self.write("a.obj", GOOD)

    def test_missing_input(self):
        for name in ("none.obj", "none/a.glb", "a.obj/b.obj"):
            self.refuse(3, (name, "cannot open"), "info", name)
            self.refuse_pack(3, (name, "cannot open"), name)
        self.refuse(3, ("none.obj",), "check", "none.obj")
        self.refuse(3, ("none.obj",), "check", "a.obj", "--ref", "none.obj")

    def test_folder_as_input(self):
        self.path("folder.obj").mkdir()
        self.refuse_pack(3, ("folder.obj", "cannot read"), "folder.obj")

    def test_unreadable_input(self):
        """Root may read all but what the kernel itself refuses to hand out."""
        if os.geteuid() != 0:
            self.path("a.obj").chmod(0)
            self.refuse_pack(3, ("a.obj", "cannot open (Permission denied)"), "a.obj")
        else:
            os.symlink("/proc/self/mem", self.path("m.obj"))
            self.refuse(3, ("m.obj", "cannot read"), "info", "m.obj")

    def test_unknown_input_ending(self):
        for name in ("a.fbx", "a", "a.obj.gz"):
            self.write(name, GOOD)
            self.refuse_pack(2, (name, ".obj"), name)

    def test_unknown_output_ending(self):
        for name in ("b.fbx", "b", "b.png"):
            self.refuse_pack(2, (name, ".glb"), "a.obj", output=name)

    def test_formats_without_uvs_as_output(self):
        for name in ("b.stl", "b.off"):
            self.refuse_pack(2, (name, "cannot hold UVs"), "a.obj", output=name)

    def test_output_where_none_can_be(self):
        good = ("pack", "a.obj", *quick())
        for bad in ("none/b", "a.obj/b", "/proc/b"):
            with self.subTest(bad):
                self.refuse(3, (bad, "cannot write"), *good, "-o", bad + ".obj")
                self.refuse(3, (bad, "cannot write"), *good, "-o", bad + ".gltf")
        self.path("folder.obj").mkdir()
        self.refuse(3, ("folder.obj", "cannot write"), *good, "-o", "folder.obj")

    def test_unwritable_folder(self):
        if os.geteuid() == 0:
            self.skipTest("root may write everywhere; test_output_where_none_can_be has the rest")
        (self.folder / "closed").mkdir(mode=0o500)
        self.refuse(3, ("closed/b.obj", "cannot write"), "pack", "a.obj", "-o", "closed/b.obj",
                    *quick())

    def test_full_device(self):
        os.symlink("/dev/full", self.path("full.obj"))
        self.refuse(3, ("full.obj", "No space left", "disk space"), "pack", "a.obj", "-o",
                    "full.obj", *quick())
        with open("/dev/full", "w") as full:
            result = subprocess.run([COMMAND, "info", "a.obj", "--json", "-"], cwd=self.folder,
                                    stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(result.returncode, 3)
        self.assertRegex(result.stderr, r"\Awrapatlas: error: standard output: [^\n]+; [^\n]+\n\Z")

    def test_full_disk(self):
        text = obj([square(2 * i) for i in range(100)])
        for name in ("big.obj", "big.glb"):
            self.write("big.obj", text)
            self.pack("big.obj", "big.glb")
            before = self.contents()
            result = self.call("pack", name, "-o", name, *quick(), **file_size_limit(2000))
            self.assert_error(result, 3, name, "disk space")
            self.assertEqual(self.contents(), before)

    def test_full_file_system(self):
        """The real thing: a tiny file system in a mount name space of its own."""
        disk = self.folder / "disk"
        disk.mkdir()
        self.write("big.obj", obj([square(2 * i) for i in range(1000)]))
        script = ('mount -t tmpfs -o size=16k tmpfs "$1" || exit 99; echo old > "$1/b.obj"; shift;'
                  ' "$@"; status=$?; cat disk/*; ls -A disk; exit $status')
        result = subprocess.run(
            ["unshare", "--mount", "sh", "-c", script, "sh", disk, COMMAND, "pack", "big.obj", "-o",
             "disk/b.obj", *map(str, quick())], cwd=self.folder, capture_output=True, text=True) \
            if shutil.which("unshare") else None
        if result is None or "unshare" in result.stderr or result.returncode == 99:
            self.skipTest("mounting a small file system takes root")
        self.assertEqual(result.stdout, "old\nb.obj\n")
        self.assertEqual(result.returncode, 3)
        self.assertRegex(result.stderr, r"\Awrapatlas: error: disk/b.obj: cannot write \(No space left on "
                                        r"device\); [^\n]+\n\Z")


class AllOutputsOrNone(support.CommandTest):
    """Model, picture and report appear together or not at all."""

    def setUp(self):
        super().setUp()
        self.write("a.obj", GOOD)

    def test_unknown_picture_ending(self):
        self.refuse(2, ("b.jpg", ".png"), "pack", "a.obj", "-o", "b.obj", "--image", "b.jpg",
                    *quick())

    def test_picture_where_none_can_be(self):
        self.refuse(3, ("none/b.svg", "cannot write"), "pack", "a.obj", "-o", "b.obj", "--image",
                    "none/b.svg", *quick())

    def test_report_where_none_can_be(self):
        self.refuse(3, ("none/b.json", "cannot write"), "pack", "a.obj", "-o", "b.obj", "--json",
                    "none/b.json", *quick())

    def test_report_to_a_full_device(self):
        self.refuse(3, ("/dev/full", "No space left"), "pack", "a.obj", "-o", "b.obj", "--json",
                    "/dev/full", *quick())

    def test_gltf_and_its_bin(self):
        """There is room for the .bin and not for the .gltf; the older .bin must stay as it is."""
        self.pack("a.obj", "a.glb")
        self.pack("a.glb", "b.gltf")
        self.assertLess(self.path("b.bin").stat().st_size, 400)
        self.assertGreater(self.path("b.gltf").stat().st_size, 400)
        self.refuse(3, ("b.gltf", "cannot write"), "pack", "a.glb", "-o", "b.gltf", "--wrap",
                    "none", "--quiet", *quick(), **file_size_limit(400))

    def test_gltf_in_the_way_of_a_folder(self):
        self.path("b.gltf").mkdir()
        self.write("b.bin", b"older")
        self.refuse(3, ("b.gltf", "cannot write"), "pack", "a.obj", "-o", "b.gltf", *quick())


class BadOptions(support.CommandTest):
    def test_each_is_refused(self):
        self.write("a.obj", GOOD)
        pack = ("pack", "a.obj", "-o", "b.obj")
        for words, arguments in (
                (("subcommand",), ()),
                (("frob",), ("frob",)),
                (("input",), ("pack",)),
                (("--output",), ("pack", "a.obj")),
                (("extra",), (*pack, "extra")),
                (("--frob",), (*pack, "--frob")),
                (("--method",), (*pack, "--method", "guess")),
                (("--method",), (*pack, "--method")),
                (("--wrap",), (*pack, "--wrap", "w")),
                (("lprm02", "--wrap"), (*pack, "--method", "lprm02", "--wrap", "uv")),
                (("swg03", "--wrap"), (*pack, "--method", "swg03", "--wrap", "u")),
                (("zsgs04", "--wrap"), (*pack, "--method", "zsgs04", "--wrap", "v")),
                (("--export",), (*pack, "--export", "whole")),
                (("--stacked",), (*pack, "--stacked", "maybe")),
                (("--coverage",), (*pack, "--coverage", "most")),
                (("--rotation-base",), (*pack, "--rotation-base", "x")),
                (("--resolution",), (*pack, "--resolution", "0")),
                (("--resolution",), (*pack, "--resolution", "-5")),
                (("--resolution",), (*pack, "--resolution", "1x")),
                (("--resolution",), (*pack, "--resolution", "64x64x64")),
                (("--resolution",), (*pack, "--resolution", "65537")),
                (("--resolution",), (*pack, "--resolution", "99999999999")),
                (("--resolution",), (*pack, "--resolution", "1e3")),
                (("--aspect",), (*pack, "--aspect", "0:1")),
                (("--aspect",), (*pack, "--aspect", "wide")),
                (("--aspect",), (*pack, "--aspect", "1:")),
                (("--aspect",), (*pack, "--aspect", "nan:1")),
                (("--aspect",), (*pack, "--aspect", "1:1e9")),
                (("--aspect",), (*pack, "--aspect", "2:1", "--resolution", "64x32")),
                (("--aspect",), (*pack, "--aspect", "search", "--resolution", "64x32")),
                (("padding",), (*pack, "--padding", "-1")),
                (("padding",), (*pack, "--padding", "nan")),
                (("padding",), (*pack, "--padding", "1e9")),
                (("padding",), (*pack, "--padding", "two")),
                (("margin",), (*pack, "--margin", "nan")),
                (("margin",), (*pack, "--margin", "-1")),
                (("margin",), (*pack, "--margin", "1e9")),
                (("block",), (*pack, "--block", "0")),
                (("block",), (*pack, "--block", "65")),
                (("rotations",), (*pack, "--rotations", "0")),
                (("rotations",), (*pack, "--rotations", "100000")),
                (("grid",), (*pack, "--grid", "-1")),
                (("grid",), (*pack, "--grid", "1000000")),
                (("--texcoord",), (*pack, "--texcoord", "-1")),
                (("--threads",), (*pack, "--threads", "-1")),
                (("--seed",), (*pack, "--seed", "-1")),
                (("scale",), (*pack, "--scale-start", "0")),
                (("scale",), (*pack, "--scale-start", "1.5")),
                (("scale",), (*pack, "--scale-start", "nan")),
                (("lambda",), (*pack, "--lambda", "-1")),
                (("lambda",), (*pack, "--lambda", "nan")),
                (("input",), ("check",)),
                (("--wrap",), ("check", "a.obj", "--wrap", "x")),
                (("--padding",), ("check", "a.obj", "--padding", "-1")),
                (("padding",), ("check", "a.obj", "--padding", "nan")),
                (("--margin",), ("check", "a.obj", "--margin", "-1")),
                (("--resolution",), ("check", "a.obj", "--resolution", "none")),
                (("--tolerance",), ("check", "a.obj", "--tolerance", "-1")),
                (("input",), ("info",)),
                (("--texcoord",), ("info", "a.obj", "--texcoord", "99"))):
            with self.subTest(" ".join(arguments)):
                self.refuse(2, words, *arguments)

    def test_ranges_name_option_value_and_range(self):
        self.write("a.obj", GOOD)
        for command in (("pack", "a.obj", "-o", "b.obj"), ("check", "a.obj")):
            result = self.refuse(2, (), *command, "--padding", "70000")
            self.assertRegex(result.stderr, r"--padding 70000: out of range; give a number of "
                                            r"texels from 0 to \d+\n")
        result = self.refuse(2, (), "pack", "a.obj", "-o", "b.obj", "--rotations", "2.5")
        self.assertIn("--rotations 2.5: not a whole number; give", result.stderr)
        self.refuse(2, ("--padding 64:", "64 x 128"), "check", "a.obj", "--resolution", "64x128",
                    "--padding", "64")

    def test_what_would_be_ignored(self):
        self.write("a.obj", GOOD)
        pack = ("pack", "a.obj", "-o", "b.obj")
        for words, arguments in (
                (("--image-tiles:", "--image"), (*pack, "--image-tiles")),
                (("--image-size:", "--image"), (*pack, "--image-size", "64")),
                (("--image-tiles:", "wraps"), (*pack, "--image", "b.png", "--image-tiles", "--wrap",
                                               "none")),
                (("--texcoord 1:", "a.obj"), (*pack, "--texcoord", "1")),
                (("--texcoord 1:", "a.obj"), ("check", "a.obj", "--texcoord", "1")),
                (("--texcoord 1:", "a.obj"), ("info", "a.obj", "--texcoord", "1")),
                (("--margin:", "--wrap"), (*pack, "--margin", "3")),
                (("--margin:", "--wrap"), ("check", "a.obj", "--wrap", "uv", "--margin", "3")),
                (("--tolerance:", "--ref"), ("check", "a.obj", "--tolerance", "1")),
                (("--verbose:", "--quiet"), (*pack, "--quiet", "--verbose")),
                (("--verbose:", "--quiet"), ("check", "a.obj", "--quiet", "--verbose")),
                (("--all-sides:", "zsgs04"), (*pack, "--all-sides")),
                (("--all-sides:", "zsgs04"), (*pack, "--method", "swg03", "--all-sides")),
                (("--lambda:", "modulo"), (*pack, "--method", "zsgs04", "--lambda", "1")),
                (("--no-inner:", "modulo"), (*pack, "--method", "lprm02", "--no-inner")),
                (("--rotation-base:", "lprm02"), (*pack, "--method", "lprm02", "--rotation-base",
                                                  "box"))):
            with self.subTest(" ".join(arguments)):
                self.refuse(2, words, *arguments)


if __name__ == "__main__":
    unittest.main()
