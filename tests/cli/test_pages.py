"""Several pages and a given texel density, from outside."""

import math
import unittest

import support
from support import obj, obj_uvs, square

GUIDED = ("--method", "guided", "--time", 0)


def tiles(polygons, v_points_down=False):
    """The page of each polygon of UVs, by its smallest corner."""
    pages = []
    for polygon in polygons:
        u = min(x for x, _ in polygon)
        v = min(1 - y if v_points_down else y for _, y in polygon)
        pages.append((math.floor(u), math.floor(v)))
    return pages


def squares(path, corners=4):
    """The UVs of an OBJ as support.obj writes it, a polygon for each of its faces."""
    uvs = obj_uvs(path)
    return [uvs[i:i + corners] for i in range(0, len(uvs), corners)]


class Pages(support.CommandTest):
    def pack_report(self, source, output, *options):
        return self.report("pack", source, "-o", output, "--quiet", "--padding", 2,
                           "--resolution", 256, *GUIDED, *options)

    def test_density_is_texels_along_a_unit_of_the_surface(self):
        # Faces of side 1 in space, of side 0.25 in UV.
        text = obj([square(k % 4 / 4, k // 4 / 4, 0.25) for k in range(12)])
        lines = [line if not line.startswith("v ") else "v " + " ".join(
            str(4 * float(x)) for x in line.split()[1:]) for line in text.splitlines()]
        self.write("in.obj", "\n".join(lines) + "\n")
        report = self.pack_report("in.obj", "out.obj", "--density", 100, "--wrap", "none")
        self.assertAlmostEqual(report["density"], 100, 9)
        self.assertAlmostEqual(report["scale"], 400, 9)
        self.assertEqual(report["pages"], 3)
        self.assertEqual(len(report["page_efficiency"]), 3)
        for share in report["page_efficiency"]:
            self.assertAlmostEqual(share, 4 * 100 ** 2 / 256 ** 2, 9)
        for polygon in squares(self.path("out.obj")):
            width = math.dist(polygon[0], polygon[1])
            self.assertAlmostEqual(256 * width, 100, 3)
        self.assertEqual(sorted(tiles(squares(self.path("out.obj")))),
                         [(0, 0)] * 4 + [(1, 0)] * 4 + [(2, 0)] * 4)

    def test_samples_pass_the_check(self):
        for source, output, density in (("coral.glb", "out.glb", 22), ("coral.glb", "out.obj", 22),
                                        ("machine.obj", "out.obj", 30),
                                        ("machine.obj", "out.glb", 30),
                                        ("mosaic.ply", "out.ply", 170)):
            self.sample(source)
            # Without wrap a page holds shorter strips.
            within = 14 if source == "machine.obj" else density
            for options, wrap, cut in (((), "uv", ()), (("--export", "cut"), "none", ("--cut", "uv")),
                                       (("--udim",), "none", ())):
                with self.subTest(f"{source} {output} {options}"):
                    density = within if options == ("--udim",) else density
                    report = self.pack_report(source, output, "--density", density, *options)
                    self.assertGreater(report["pages"], 1)
                    self.assertEqual(report["udim"], options == ("--udim",))
                    self.assertAlmostEqual(report["density"], density, 9)
                    self.assertAlmostEqual(sum(report["page_efficiency"]) / report["pages"],
                                           report["efficiency"], 9)
                    check = self.check(output, source, "--pages", report["pages"], "--wrap", wrap,
                                       *cut)
                    self.assertEqual(check["pages"], report["pages"])
                    self.assertAlmostEqual(check["efficiency"], report["efficiency"], 3)
                    without = self.call("check", output, "--ref", source, "--resolution", 256,
                                        "--padding", 2, "--wrap", wrap, *cut)
                    self.assertEqual(without.returncode, 1, "one page cannot hold them")

    def test_udim_tiles_hold_their_charts(self):
        self.write("in.obj", obj([square(0, 0, 1 / (1 + k % 7)) for k in range(60)]))
        report = self.pack_report("in.obj", "out.obj", "--density", 140, "--udim")
        self.assertGreater(report["pages"], 4)
        self.assertEqual(report["wrap"], "none")
        used = set()
        for polygon in squares(self.path("out.obj")):
            column, row = tiles([polygon])[0]
            used.add(1001 + column + 10 * row)
            self.assertIn(column, range(10))
            for u, v in polygon:
                self.assertTrue(column <= u <= column + 1 and row <= v <= row + 1)
        self.assertEqual(used, set(range(1001, 1001 + report["pages"])))

    def test_rows_of_tiles_go_up_in_every_format(self):
        self.write("in.obj", obj([square(0, 0, 1) for _ in range(14)]))
        report = self.pack_report("in.obj", "out.obj", "--density", 200, "--udim")
        self.assertEqual(report["pages"], 14)
        expected = [(k % 10, k // 10) for k in range(14)]
        self.assertEqual(sorted(tiles(squares(self.path("out.obj")))), sorted(expected))
        self.pack_report("in.obj", "one.glb", "--density", 200, "--udim")
        self.pack_report("one.glb", "two.glb", "--density", 200, "--udim")
        self.pack_report("two.glb", "back.obj", "--density", 200, "--udim")
        for name in ("one.glb", "two.glb", "back.obj"):
            self.assertEqual(self.check(name, "in.obj", "--pages", 14)["pages"], 14)
        self.assertEqual(sorted(tiles(squares(self.path("back.obj")))), sorted(expected))

    def test_pages_raise_the_density(self):
        self.sample("mosaic.ply")
        before = 0
        for pages in (1, 2, 4):
            report = self.pack_report("mosaic.ply", "out.ply", "--pages", pages)
            self.assertLessEqual(report["pages"], pages)
            self.assertGreater(report["density"], 1.2 * before)
            before = report["density"]
            self.check("out.ply", "mosaic.ply", "--pages", pages, "--wrap", "uv")

    def test_one_page_is_what_it_was(self):
        self.sample("mosaic.ply")
        self.pack_report("mosaic.ply", "a.ply")
        self.pack_report("mosaic.ply", "b.ply", "--pages", 1)
        self.assertEqual(self.path("a.ply").read_bytes(), self.path("b.ply").read_bytes())

    def test_threads_do_not_change_the_result(self):
        self.sample("mosaic.ply")
        for options in (("--density", 170), ("--pages", 3)):
            self.pack_report("mosaic.ply", "a.ply", *options, "--threads", 1)
            self.pack_report("mosaic.ply", "b.ply", *options, "--threads", 3)
            self.assertEqual(self.path("a.ply").read_bytes(), self.path("b.ply").read_bytes())

    def test_what_does_not_fit(self):
        self.write("in.obj", obj([square(0, 0, 1), square(0, 0, 0.5), square(0, 0, 0.25)]))
        pack = ("pack", "in.obj", "-o", "out.obj", *GUIDED, "--resolution", 256, "--padding", 2,
                "--wrap", "none", "--density")
        result = self.refuse(4, ("in.obj", "chart 0", "256 x 256", "--density"), *pack, 300)
        fits = float(result.stderr.split("--density ")[1].split()[0])
        self.assertTrue(240 < fits < 254)
        self.succeed(*pack, fits)
        self.refuse(4, ("in.obj", "chart 0"), *pack, 1.01 * fits)
        self.refuse(4, ("in.obj", "1 page of 256 x 256", "2 do"), *pack, fits, "--pages", 1)
        self.succeed(*pack, fits, "--pages", 2)
        self.refuse(4, ("in.obj", "3 charts", "page"), "pack", "in.obj", "-o", "out.obj", *GUIDED,
                    "--resolution", 16, "--padding", 40, "--pages", 2)

    def test_a_surface_without_area_has_no_density(self):
        flat = "\n".join("v 0 0 0" if line.startswith("v ") else line
                         for line in obj([square()]).splitlines())
        self.write("in.obj", flat + "\n")
        self.refuse(3, ("in.obj", "density"), "pack", "in.obj", "-o", "out.obj", *GUIDED,
                    "--density", 5)
        self.assertIsNone(self.pack_report("in.obj", "out.obj")["density"])

    def test_refusals(self):
        self.write("in.obj", obj([square()]))
        pack = ("pack", "in.obj", "-o", "out.obj")
        for method in ("modulo", "swg03", "zsgs04", "lprm02"):
            for option in (("--pages", 2), ("--pages", 1), ("--density", 5), ("--udim",)):
                self.refuse(2, (option[0], method, "guided"), *pack, "--method", method, *option)
        guided = (*pack, *GUIDED)
        for wrap in ("u", "v", "uv"):
            self.refuse(2, (f"--wrap {wrap}", "UDIM"), *guided, "--udim", "--wrap", wrap)
        self.succeed(*guided, "--udim", "--wrap", "none")
        self.path("out.obj").unlink()
        for words, options in ((("--pages 0",), ("--pages", 0)),
                               (("--pages 1001",), ("--pages", 1001)),
                               (("--pages 1.5",), ("--pages", 1.5)),
                               (("--density 0",), ("--density", 0)),
                               (("--density -1",), ("--density", -1)),
                               (("--density nan",), ("--density", "nan")),
                               (("--margin",), ("--pages", 2, "--margin", 3))):
            self.refuse(2, words, *guided, *options)
        self.refuse(2, ("--pages",), "check", "in.obj", "--pages", 0)

    def test_check_hints_at_pages(self):
        self.sample("mosaic.ply")
        report = self.pack_report("mosaic.ply", "out.ply", "--density", 170, "--udim")
        result = self.call("check", "out.ply", "--ref", "mosaic.ply", "--resolution", 256,
                           "--padding", 2)
        self.assertEqual(result.returncode, 1)
        self.assertIn(f"--pages {report['pages']}: then every promise holds", result.stderr)

    def test_pictures(self):
        self.sample("mosaic.ply")
        report = self.pack_report("mosaic.ply", "out.ply", "--density", 170, "--image", "out.svg",
                                  "--image-size", 64)
        svg = self.path("out.svg").read_text()
        self.assertEqual(svg.count("<svg"), report["pages"] + 1)


if __name__ == "__main__":
    unittest.main()
