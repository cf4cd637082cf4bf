"""`wrapatlas pack` from outside: every promise, judged by `check` and by this file's own eyes."""

import itertools
import json
import random
import struct
import subprocess
import sys
import unittest
import xml.etree.ElementTree
import zlib

import gltf_maker
import support
from support import COMMAND, PACKABLE, obj, obj_lines, obj_uvs, quick, rectangle, square

RUNS = [("modulo", wrap) for wrap in ("uv", "u", "v", "none")]
RUNS += [(method, "none") for method in ("lprm02", "swg03", "zsgs04")]


def polygon_area(points):
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(points, points[1:] + points[:1])) / 2


def obj_polygons(path):
    """The UVs of each face."""
    uvs = obj_uvs(path)
    return [[uvs[int(corner.split("/")[1]) - 1] for corner in line.split()[1:]]
            for line in obj_lines(path.read_text(), "f")]


def random_triangles(count, seed=5):
    chance = random.Random(seed)
    triangles = []
    while len(triangles) < count:
        points = [(chance.random() + 2 * len(triangles), chance.random()) for _ in range(3)]
        if polygon_area(points) > 0.05:
            triangles.append(points)
    return triangles


def meets_box(triangle, left, bottom, side):
    """Whether interiors meet: no axis separates them (normals of the box, normals of the edges)."""
    box = [(left + dx, bottom + dy) for dx in (0, side) for dy in (0, side)]
    edges = zip(triangle, triangle[1:] + triangle[:1])
    for x, y in [(1, 0), (0, 1)] + [(a[1] - b[1], b[0] - a[0]) for a, b in edges]:
        one = [x * px + y * py for px, py in triangle]
        other = [x * px + y * py for px, py in box]
        if min(max(one), max(other)) - max(min(one), min(other)) <= 1e-6 * (abs(x) + abs(y)):
            return False
    return True


class Promises(support.CommandTest):
    def test_every_sample_method_and_wrap(self):
        for name, (method, wrap) in itertools.product(PACKABLE, RUNS):
            with self.subTest(name, method=method, wrap=wrap):
                self.sample(name)
                out = "out." + name.split(".")[1]
                options = ("--method", method, "--wrap", wrap)
                report = self.pack_report(name, out, *options)
                self.assertEqual((report["method"], report["wrap"]), (method, wrap))
                judged = self.check(out, name, "--wrap", wrap, "--margin",
                                    "0" if wrap == "uv" else "1")
                self.assertEqual((judged["ok"], judged["charts"]), (True, report["charts"]))
                self.assertAlmostEqual(judged["scale"] / report["scale"], 1, places=3)
                self.assertGreater(judged["gaps_sought_below"], 2)
                if judged["smallest_gap"] is not None:
                    self.assertGreaterEqual(judged["smallest_gap"], 2 - 1e-3)

    def test_check_fails_for_more_padding_than_was_packed(self):
        for name in PACKABLE:
            with self.subTest(name):
                self.sample(name)
                self.pack(name, "out.obj")
                result = self.call("check", "out.obj", "--ref", name, "--resolution", "256",
                                   "--wrap", "uv", "--padding", "12", "--json", "-")
                self.assertEqual(result.returncode, 1)
                findings = json.loads(result.stdout)["findings"]
                self.assertEqual({finding["kind"] for finding in findings}, {"gap"})
                self.assertIn("out.obj: ", result.stderr)

    def test_check_fails_after_a_uv_is_moved_into_a_neighbour(self):
        self.sample("machine.obj")
        self.pack("machine.obj", "out.obj", "--wrap", "none")
        text = self.path("out.obj").read_text()
        uvs = obj_lines(text, "vt")
        moved = text.replace(uvs[0] + "\n", uvs[-1] + "\n", 1)
        self.write("moved.obj", moved)
        for reference in ((), ("--ref", "machine.obj")):
            result = self.call("check", "moved.obj", "--resolution", "256", "--json", "-",
                               *reference)
            self.assertEqual(result.returncode, 1)
            kinds = {f["kind"] for f in json.loads(result.stdout)["findings"]}
            self.assertIn("overlap", kinds)
            self.assertEqual("not_similar" in kinds, bool(reference))

    def test_check_fails_for_less_wrap_than_was_packed(self):
        self.sample("mosaic.ply")
        self.pack("mosaic.ply", "out.ply")
        result = self.call("check", "out.ply", "--resolution", "256", "--wrap", "u", "--json", "-")
        self.assertEqual(result.returncode, 1)
        self.assertIn("bounds", {f["kind"] for f in json.loads(result.stdout)["findings"]})

    def test_margin(self):
        self.sample("machine.obj")
        self.pack("machine.obj", "out.obj", "--wrap", "none", "--margin", "9")
        self.assertTrue(self.check("out.obj", "machine.obj", "--margin", "9")["ok"])
        for uv in obj_uvs(self.path("out.obj")):
            for x in uv:
                self.assertTrue(9 - 1e-4 <= 256 * x <= 247 + 1e-4)

    def test_block(self):
        triangles = random_triangles(25)
        self.write("a.obj", obj(triangles))
        for block, padding in ((4, 0), (8, 1)):
            self.pack("a.obj", "b.obj", "--block", block, "--resolution", "128", "--padding",
                      padding)
            owner, count = {}, 128 // block
            for chart, polygon in enumerate(obj_polygons(self.path("b.obj"))):
                texels = [(128 * u, 128 * v) for u, v in polygon]
                low, high = ([int(f(p[k] for p in texels) // block) for k in (0, 1)]
                             for f in (min, max))
                for x in range(low[0], high[0] + 1):
                    for y in range(low[1], high[1] + 1):
                        if meets_box(texels, block * x, block * y, block):
                            cell = x % count, y % count
                            self.assertEqual(owner.setdefault(cell, chart), chart)
            self.assertEqual(set(owner.values()), set(range(len(triangles))))

    def test_stacked_charts_go_on_sharing_texels(self):
        bend = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]
        self.write("a.obj", obj([bend, bend, rectangle(5, 0, 2, 1), square(8)]))
        report = self.pack_report("a.obj", "kept.obj", "--stacked", "keep")
        self.assertEqual((report["charts"], report["stacked"]), (3, 2))
        first, second, *_ = obj_polygons(self.path("kept.obj"))
        self.assertEqual(first, second)
        self.assertTrue(self.check("kept.obj", "a.obj", "--wrap", "uv", "--stacked", "keep")["ok"])
        apart = self.call("check", "kept.obj", "--ref", "a.obj", "--wrap", "uv")
        self.assertEqual(apart.returncode, 1)
        self.pack("a.obj", "apart.obj")
        self.assertTrue(self.check("apart.obj", "a.obj", "--wrap", "uv")["ok"])


class Shapes(support.CommandTest):
    def test_two_sided_resolution(self):
        for name in PACKABLE:
            self.sample(name)
            report = self.pack_report(name, "b.obj", "--resolution", "512x256")
            self.assertEqual((report["width"], report["height"]), (512, 256))
            judged = self.check("b.obj", name, "--wrap", "uv", resolution="512x256")
            self.assertTrue(judged["ok"])

    def test_aspect_ratio(self):
        self.sample("coral.glb")
        report = self.pack_report("coral.glb", "b.glb", "--aspect", "2:1")
        self.assertEqual((report["width"], report["height"]), (362, 181))
        self.assertTrue(self.check("b.glb", "coral.glb", "--wrap", "uv",
                                   resolution="362x181")["ok"])

    def test_searched_aspect_ratio(self):
        """A long strip without rotations wants a long texture."""
        self.write("a.obj", obj([rectangle(0, 0, 8, 1)]))
        report = self.pack_report("a.obj", "b.obj", "--rotations", "1", "--aspect",
                             "search", "--wrap", "none")
        width, height = report["width"], report["height"]
        self.assertGreater(width, 4 * height)
        self.assertAlmostEqual(width * height / 256**2, 1, delta=0.15)
        self.assertTrue(self.check("b.obj", "a.obj", resolution=f"{width}x{height}")["ok"])

    def test_cut_export(self):
        for name in PACKABLE:
            with self.subTest(name):
                self.sample(name)
                out = "cut." + name.split(".")[1]
                report = self.pack_report(name, out, "--export", "cut")
                self.assertEqual((report["wrap"], report["export"]), ("uv", "cut"))
                judged = self.check(out, name)
                self.assertTrue(judged["ok"])
                self.pack(name, "cut.obj", "--export", "cut")
                for uv in obj_uvs(self.path("cut.obj")):
                    self.assertTrue(0 <= min(uv) and max(uv) <= 1)
                info = self.report("info", out)["charts"]
                self.assertTrue(min(info["uv_min"]) >= 0 and max(info["uv_max"]) <= 1)

    def test_cut_export_leaves_nothing_out(self):
        """The whole area is still there, and some face was cut."""
        self.sample("machine.obj")
        self.pack("machine.obj", "whole.obj")
        self.pack("machine.obj", "cut.obj", "--export", "cut")
        whole, cut = (obj_polygons(self.path(name)) for name in ("whole.obj", "cut.obj"))
        self.assertGreater(len(cut), len(whole))
        self.assertAlmostEqual(sum(map(polygon_area, cut)), sum(map(polygon_area, whole)), places=6)


class SameBytes(support.CommandTest):
    def test_charts_that_hold_each_other_on_a_coarse_grid(self):
        """Hooks in rings and combs in frames, where cells are as large as they are thick."""
        self.sample("machine.obj")
        pack = ("pack", "machine.obj", "--quiet", "--padding", 2, "--resolution", 1024, "--time", 0)
        report = self.report(*pack, "-o", "out.obj", "--threads", 1)
        self.assertGreater(report["efficiency"], 0.53)
        self.succeed(*pack, "-o", "again.obj", "--threads", 2)
        self.assertEqual(self.path("out.obj").read_bytes(), self.path("again.obj").read_bytes())
        self.assertTrue(self.check("out.obj", "machine.obj", "--wrap", "uv", resolution=1024)["ok"])

    def test_runs_and_threads(self):
        for name in PACKABLE:
            self.sample(name)
            ending = name.split(".")[1]
            for more in ((), ("--aspect", "search", "--resolution", "64", "--grid", "32",
                              "--padding", "0.5")):
                with self.subTest(name, options=more):
                    outputs = set()
                    for threads in ("1", "1", "2"):
                        self.pack(name, f"b.{ending}", "--threads", threads, *more)
                        outputs.add(self.path(f"b.{ending}").read_bytes())
                    self.assertEqual(len(outputs), 1)

    def test_pictures(self):
        self.sample("coral.glb")
        pictures = set()
        for threads in ("1", "2"):
            self.pack("coral.glb", "b.glb", "--image", "b.svg", "--threads", threads)
            pictures.add(self.path("b.svg").read_bytes())
        self.assertEqual(len(pictures), 1)


class Outputs(support.CommandTest):
    def test_obj_differs_only_in_texture_coordinates(self):
        source = (support.SAMPLES / "machine.obj").read_text()
        for text in (source, source.replace("\n", "\r\n")):
            self.write("a.obj", text.encode())
            self.pack("a.obj", "b.obj")
            packed = self.path("b.obj").read_bytes().decode()
            self.assertEqual(packed.count("\r\n"), text.count("\r\n"))
            self.assertEqual(packed.count("\n") - packed.count("\r\n"),
                             text.count("\n") - text.count("\r\n"))
            for lines in (packed, text):
                self.assertGreater(len(obj_lines(lines, "vt")), 1000)
            old, new = ([line for line in lines.split("\n") if not line.startswith("vt ")]
                        for lines in (text, packed))
            self.assertEqual(len(new), len(old))
            for before, after in zip(old, new):
                if before.startswith("f "):
                    before, after = ([corner.split("/")[::2] for corner in line.split()]
                                     for line in (before, after))
                self.assertEqual(after, before)

    def test_all_between_all_formats(self):
        self.sample("machine.obj")
        self.sample("mosaic.ply")
        self.sample("coral.glb")
        self.pack("coral.glb", "coral.gltf")
        for source in ("machine.obj", "mosaic.ply", "coral.glb", "coral.gltf"):
            faces = self.report("info", source)["faces"]
            for ending in ("obj", "ply", "glb", "gltf"):
                with self.subTest(source, ending=ending):
                    out = f"out.{ending}"
                    self.pack(source, out)
                    judged = self.check(out, source, "--wrap", "uv")
                    self.assertTrue(judged["ok"])
                    info = self.report("info", out)
                    if ending in ("obj", "ply") or source != "machine.obj":
                        self.assertEqual(info["faces"], faces)  # glTF has triangles alone
                    self.assertEqual(info["charts"]["faces_without_uv"], 0)

    def test_in_place(self):
        self.sample("mosaic.ply")
        self.pack("mosaic.ply", "b.ply")
        self.pack("mosaic.ply", "mosaic.ply")
        self.assertEqual(self.path("mosaic.ply").read_bytes(), self.path("b.ply").read_bytes())

    def test_uv_set_that_is_not_there(self):
        self.write("a.glb", gltf_maker.two_uv_sets().glb())
        self.refuse_pack(3, ("a.glb", "TEXCOORD_5", "TEXCOORD_0, TEXCOORD_1", "--texcoord"),
                         "a.glb", "--texcoord", "5", output="new.glb")
        self.refuse(3, ("TEXCOORD_0, TEXCOORD_1",), "info", "a.glb", "--texcoord", "2")

    def test_materials_that_stay_behind(self):
        """An OBJ in another folder does not find them, and is told to."""
        self.sample("machine.obj")
        self.sample("machine.mtl")
        self.path("there").mkdir()
        for output, missed in (("b.obj", False), ("there/b.obj", True), ("there/b.glb", False)):
            result = self.succeed("pack", "machine.obj", "-o", output, *quick())
            self.assertEqual("there/machine.mtl: copy machine.mtl there\n" in result.stderr, missed)
        self.path("machine.mtl").rename(self.path("there/machine.mtl"))
        result = self.succeed("pack", "machine.obj", "-o", "there/b.obj", *quick())
        self.assertNotIn("machine.mtl", result.stderr)

    def test_second_uv_set(self):
        maker = gltf_maker.two_uv_sets()
        self.write("a.glb", maker.glb())
        self.pack("a.glb", "b.glb", "--texcoord", "1")
        self.assertTrue(self.check("b.glb", "a.glb", "--texcoord", "1", "--wrap", "uv")["ok"])
        first, second = (self.report("info", name, "--texcoord", str(k))["charts"]
                         for name in ("a.glb", "b.glb") for k in (0,))
        self.assertEqual(first, second)

    def test_peak_memory_is_not_that_of_the_parent(self):
        self.sample("machine.obj")
        script = ("import subprocess, sys; big = bytearray(400 << 20); sys.stdout.write("
                  "subprocess.run(sys.argv[1:], capture_output=True, text=True).stdout)")
        command = [COMMAND, "check", "machine.obj", "--quiet", "--json", "-"]
        done = subprocess.run([sys.executable, "-c", script, *command], cwd=self.folder,
                              capture_output=True, text=True)
        self.assertLess(json.loads(done.stdout)["peak_memory_mb"], 400)

    def test_report(self):
        self.sample("machine.obj")
        report = self.pack_report("machine.obj", "b.obj", "--threads", "2", "--padding", "3")
        told = {key: report[key] for key in ("command", "input", "output", "method", "wrap",
                                              "export", "width", "height", "pages", "charts",
                                              "placed", "padding", "rotations", "grid", "seed",
                                              "threads", "valid", "interrupted", "stacked",
                                              "self_overlapping", "faces_without_uv", "coverage")}
        self.assertEqual(told, {
            "command": "pack", "input": "machine.obj", "output": "b.obj", "method": "modulo",
            "wrap": "uv", "export": "continuous", "width": 256, "height": 256, "pages": 1,
            "charts": 83, "placed": 83, "padding": 3, "rotations": 4, "grid": [64, 64], "seed": 0,
            "threads": 2, "valid": True, "interrupted": False, "stacked": 0, "self_overlapping": 0,
            "faces_without_uv": 0, "coverage": "conservative"})
        version = self.succeed("--version").stdout.split()[1]
        self.assertEqual(report["version"], version)
        used = sum(map(polygon_area, obj_polygons(self.path("b.obj"))))
        self.assertAlmostEqual(report["efficiency"], used, places=6)
        before = sum(map(polygon_area, obj_polygons(self.path("machine.obj"))))
        self.assertAlmostEqual(report["scale"], (used / before) ** 0.5 * 256, places=3)
        self.assertTrue(used < report["raster_efficiency"] <= 1)
        self.assertGreater(report["packings"], 1)
        self.assertGreater(report["peak_memory_mb"], 1)
        seconds = report["seconds"]
        parts = ("read", "charts", "pack", "validate", "write")
        self.assertEqual(set(seconds), {"total", "raster", "place", *parts})
        self.assertLessEqual(sum(seconds[part] for part in parts), seconds["total"] + 1e-6)
        self.assertGreaterEqual(min(seconds.values()), 0)

    def test_report_of_what_padding_costs(self):
        for method in ("lprm02", "swg03", "zsgs04", "modulo", "guided"):
            for wrap in ("none", "u", "uv") if method in ("modulo", "guided") else ("none",):
                with self.subTest(f"{method} {wrap}"):
                    options = ["--method", method, "--wrap", wrap, "--padding", "8",
                               "--resolution", "256"]
                    options += ["--time", "0"] if method == "guided" else ["--grid", "64"]
                    self.write("a.obj", obj([square()]))
                    report = self.report("pack", "a.obj", "-o", "b.obj", "--quiet", *options)
                    # Until it meets itself, or a border, about its centre.
                    factors = []
                    for name, axis in zip("uv", zip(*obj_uvs(self.path("b.obj")))):
                        low, high = min(axis), max(axis)
                        room = 1 if name in wrap else min(low + high, 2 - low - high)
                        factors.append(room / (high - low))
                    self.assertGreater(min(factors), 1)
                    self.assertAlmostEqual(report["unpadded_efficiency"],
                                           report["efficiency"] * min(factors) ** 2, 5)
                    self.sample("coral.glb")
                    report = self.report("pack", "coral.glb", "-o", "b.glb", "--quiet", *options)
                    self.assertLess(report["efficiency"], report["unpadded_efficiency"])
                    self.assertLess(report["unpadded_efficiency"], 1)

    def test_guided_is_denser_than_modulo_where_separation_cannot_begin(self):
        self.sample("machine.obj")
        options = ("--wrap", "none", "--margin", 0, "--padding", 2)
        modulo, guided = (self.report("pack", "machine.obj", "-o", "a.obj", *options, "--method",
                                      *method)["efficiency"]
                          for method in (("modulo",), ("guided", "--time", 0)))
        self.assertGreater(guided, 1.2 * modulo)

    def test_report_of_what_was_asked(self):
        self.write("a.glb", gltf_maker.two_uv_sets().glb())
        keys = ("padding", "margin", "block", "aspect", "stacked_mode", "texcoord", "rotations")
        for options, told in (
                ((), (2, None, 1, None, "separate", 0, 4)),
                (("--aspect", "2:1", "--wrap", "u", "--block", "4", "--texcoord", "1"),
                 (2, 1, 4, "2:1", "separate", 1, 4)),
                (("--wrap", "none", "--margin", "5", "--stacked", "keep", "--padding", "3"),
                 (3, 5, 1, None, "keep", 0, 4)),
                (("--method", "lprm02"), (2, 1, 1, None, "separate", 0, 1))):
            with self.subTest(options):
                report = self.pack_report("a.glb", "b.glb", *options)
                self.assertEqual(tuple(report[key] for key in keys), told)
                self.assertGreaterEqual(report["threads"], 1)

    def test_rotations_of_a_method_with_one(self):
        self.sample("coral.glb")
        for method, noted in (("lprm02", True), ("swg03", False)):
            result = self.succeed("pack", "coral.glb", "-o", "b.glb", *quick("--method", method))
            self.assertEqual("coral.glb: note: lprm02 has one orientation" in result.stderr, noted)

    def test_report_as_a_file(self):
        self.sample("coral.glb")
        self.pack("coral.glb", "b.glb", "--json", "b.json")
        self.assertEqual(json.loads(self.path("b.json").read_text())["charts"], 5)

    def test_pictures(self):
        self.sample("coral.glb")
        self.pack("coral.glb", "b.glb", "--image", "b.png", "--resolution", "512x256")
        data = self.path("b.png").read_bytes()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        width, height, depth, colour = struct.unpack(">IIBB", data[16:26])
        self.assertEqual((width, height, depth, colour), (1024, 512, 8, 2))
        at, pixels = 8, b""
        while at < len(data):
            size, kind = struct.unpack(">I4s", data[at : at + 8])
            body = data[at + 8 : at + 8 + size]
            self.assertEqual(struct.unpack(">I", data[at + 8 + size : at + 12 + size])[0],
                             zlib.crc32(kind + body))
            pixels += body if kind == b"IDAT" else b""
            at += 12 + size
        self.assertEqual(len(zlib.decompress(pixels)), height * (1 + 3 * width))
        for tiles, size in (((), "1024"), (("--image-tiles",), "2048"),
                            (("--image-size", "300"), "300"),
                            (("--image-size", "300", "--image-tiles"), "600")):
            self.pack("coral.glb", "b.glb", "--image", "b.svg", *tiles)
            root = xml.etree.ElementTree.parse(self.path("b.svg")).getroot()
            self.assertTrue(root.tag.endswith("svg"))
            self.assertEqual((root.get("width"), root.get("height")), (size, size))

    def test_streams(self):
        """Standard output has the JSON alone, standard error the rest, and --quiet stops that."""
        self.sample("coral.glb")
        loud = self.succeed("pack", "coral.glb", "-o", "b.glb", *quick("--json", "-"))
        json.loads(loud.stdout)
        self.assertRegex(loud.stderr, r"\Acoral.glb: 5 charts on 256 x 256 texels, [\d.]+ % in "
                                      r"use, [\d.]+ texels per unit, [\d.]+ s -> b.glb\n\Z")
        quiet = self.pack("coral.glb", "b.glb")
        self.assertEqual((quiet.stdout, quiet.stderr), ("", ""))
        checked = self.succeed("check", "b.glb", "--wrap", "uv", "--quiet")
        self.assertEqual((checked.stdout, checked.stderr), ("", ""))
        verbose = self.succeed("pack", "coral.glb", "-o", "b.glb", *quick("--verbose"))
        self.assertIn("grid 64 x 64", verbose.stderr)
        self.assertRegex(verbose.stderr, r"[\d.]+ % in use if the charts grew in place until two touch")

    def test_what_was_meant(self):
        self.refuse(2, ("did you mean --padding? else see wrapatlas pack --help",), "pack", "a.obj",
                    "-o", "b.obj", "--wrap", "uv", "--paddings=3")
        self.refuse(2, ("pakc", "did you mean pack?"), "pakc", "a.obj")
        for words in (("pack", "a.obj", "-o", "b.obj", "--frobnicate"), ("frobnicate", "a.obj")):
            self.assertNotIn("mean", self.refuse(2, ("frobnicate",), *words).stderr)

    def test_help(self):
        for command in ((), ("pack",), ("check",), ("info",)):
            result = self.succeed(*command, "--help")
            self.assertEqual(result.stderr, "")
            self.assertIn("--help", result.stdout)
        status = self.succeed("--help").stdout
        for words in ("0 done", "1 a check failed", "2 usage", "3 unusable", "4 no packing", "130"):
            self.assertIn(words, status)


if __name__ == "__main__":
    unittest.main()
