"""bench and report: rows, going on after a stop, failures, and the page in a real browser."""

import csv
import html.parser
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time
import unittest

import support
from support import COMMAND

# Small on purpose; two shapes' worth of work for each packer would not show how they differ.
QUICK = ("--resolution", 128, "--grid", 64, "--padding", 1, "--rotations", 4)
TIMES = {"unwrap_seconds", "raster_seconds", "place_seconds", "seconds"}
BROWSER = shutil.which("chromium-headless-shell") or shutil.which("chromium")


class BenchTest(support.CommandTest):
    def meshes(self):
        """A bare one, three with UVs."""
        folder = self.folder / "meshes"
        folder.mkdir()
        for name in ("knot.off", "coral.glb", "machine.obj", "mosaic.ply"):
            shutil.copy(support.SAMPLES / name, folder)
        return "meshes"

    def rows(self, results="r"):
        with open(self.folder / results / "runs.csv", newline="") as file:
            return list(csv.DictReader(file))

    def timeless(self, results="r"):
        return [{key: value for key, value in row.items() if key not in TIMES}
                for row in self.rows(results)]

    def bench(self, *arguments, status=0):
        done = self.call("bench", *arguments)
        self.assertEqual(done.returncode, status, done.stderr)
        return done


class Bench(BenchTest):
    def test_a_row_for_each_packing(self):
        folder = self.meshes()
        (self.folder / folder / "mosaic.ply").unlink()  # many charts: guided takes long
        done = self.bench(folder, "-o", "r", *QUICK, "--methods", "lprm02,modulo,guided",
                          "--times", "0.1,0.2", "--aspect", "search")
        rows = self.rows()
        self.assertEqual(len({row["mesh"] for row in rows}), 3)
        self.assertIn("3 meshes", done.stderr)
        for mesh in {row["mesh"] for row in rows}:
            packers = [row["packer"] for row in rows if row["mesh"] == mesh]
            self.assertEqual({packer: packers.count(packer) for packer in packers},
                             {"lprm02": 31, "modulo": 31, "guided 0.1 s": 2, "guided 0.2 s": 2})
        for row in rows:
            self.assertEqual((row["error"], row["violations"]), ("", "0"), row)
            self.assertGreater(float(row["efficiency"]), 0)
            self.assertLess(float(row["efficiency"]), 1)
            area = int(row["width"]) * int(row["height"])
            self.assertAlmostEqual(area / 128 ** 2, 1, delta=0.1)
        knot = next(row for row in rows if row["mesh"] == "meshes-knot")
        self.assertEqual(knot["unwrapped"], "1")
        self.assertLessEqual(float(knot["l2"]), 2)
        self.assertTrue(list((self.folder / "r" / "charts").glob("meshes-knot-*.obj")))

    def test_every_column_is_explained(self):
        self.sample("coral.glb")
        self.bench("coral.glb", "-o", "r", *QUICK, "--methods", "lprm02")
        page = (support.SAMPLES.parent / "docs" / "reports.md").read_text()
        told = set(re.findall(r"`(\w+)`", page.split("## bench")[1]))
        self.assertEqual(set(self.rows()[0]) - told, set())

    def test_the_same_as_pack_finds(self):
        self.sample("machine.obj")
        self.bench("machine.obj", "-o", "r", *QUICK, "--methods", "swg03,modulo", "--wrap", "u")
        for row in self.rows():
            report = self.report("pack", "machine.obj", "-o", "p.obj", *QUICK, "--method",
                                 row["method"], "--wrap", row["wrap"])
            self.assertAlmostEqual(float(row["efficiency"]), report["efficiency"], places=8)
            self.assertEqual(int(row["packings"]), report["packings"])
        self.assertEqual({row["method"]: row["wrap"] for row in self.rows()},
                         {"swg03": "none", "modulo": "u"})

    def test_the_setting_of_the_paper(self):
        self.sample("knot.off")
        self.bench("knot.off", "-o", "r", "--paper")
        rows = self.rows()
        self.assertEqual(len(rows), 4 * 31)
        for row in rows:
            self.assertEqual((row["coverage"], row["padding"], row["rotations"], row["scale_start"]),
                             ("center", "0", "16", "0.9"))
            self.assertEqual((row["grid_width"], row["grid_height"]), (row["width"], row["height"]))
            self.assertLessEqual(float(row["efficiency"]), 0.81)
            self.assertEqual(row["error"], "", "that charts overlap a little is known, no failure")
        self.assertIn(("91", "724"), {(row["width"], row["height"]) for row in rows})
        self.assertTrue(any(int(row["violations"]) > 0 for row in rows))
        self.bench("knot.off", "-o", "r2", "--paper", "--scale-start", 1, "--methods", "modulo",
                   "--aspect", "square")
        self.assertEqual([row["scale_start"] for row in self.rows("r2")], ["1"])

    def test_failures_are_told_and_stop_nothing(self):
        folder = self.meshes()
        (self.folder / folder / "broken.obj").write_text("v 0 0\nf 1 2 3\n")
        (self.folder / folder / "flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")
        done = self.bench(folder, "-o", "r", *QUICK, "--methods", "lprm02", status=1)
        self.assertRegex(done.stderr, r"failed: .*broken\.obj")
        self.assertRegex(done.stderr, r"failed: .*flat\.obj")
        errors = {row["mesh"]: row["error"] for row in self.rows()}
        self.assertEqual(len(errors), 6)
        self.assertEqual({mesh for mesh, error in errors.items() if error},
                         {"meshes-broken", "meshes-flat"})
        self.succeed("report", "r", "-o", "page")
        page = (self.folder / "page" / "index.html").read_text()
        self.assertIn("What failed", page)
        self.assertIn("broken.obj", page)
        # Once more: what is done is not done again, and the failures are still told.
        again = self.bench(folder, "-o", "r", *QUICK, "--methods", "lprm02", status=1)
        self.assertIn("6 of them done before", again.stderr)

    def test_another_setting_needs_another_folder(self):
        self.sample("coral.glb")
        self.bench("coral.glb", "-o", "r", *QUICK, "--methods", "lprm02")
        before = self.timeless()
        self.refuse(2, ("r", "--padding: 1.0 there, 3.0 here"), "bench", "coral.glb", "-o", "r",
                    *QUICK[:-4], "--padding", 3, "--rotations", 4, "--methods", "lprm02")
        self.assertEqual(self.timeless(), before)
        (self.folder / "other").mkdir()
        self.write("other/mine.txt", "mine")
        self.refuse(2, ("other",), "bench", "coral.glb", "-o", "other", *QUICK)

    def test_refuses(self):
        self.sample("coral.glb")
        shutil.copy(self.path("coral.glb"), self.path("coral.gltf"))
        (self.folder / "empty").mkdir()
        self.write("junk.xyz", "1 2 3\n")
        for words, arguments in (
                (("none.obj", "no such file"), ("none.obj",)),
                (("empty", "without models"), ("empty",))):
            self.refuse(3, words, "bench", *arguments, "-o", "r", *QUICK)
        for words, arguments in (
                (("coral.gltf", "same name"), ("coral.glb", "coral.gltf")),
                (("swg04", "no such method"), ("coral.glb", "--methods", "swg04")),
                (("lprm02 is named twice",), ("coral.glb", "--methods", "lprm02,lprm02")),
                (("--times", "x"), ("coral.glb", "--times", "x")),
                (("junk.xyz",), ("junk.xyz",)),
                (("--seed", "lprm02, swg03 have no use"),
                 ("coral.glb", "--methods", "lprm02,swg03", "--seed", 3)),
                (("--times", "guided"), ("coral.glb", "--methods", "modulo", "--times", 3)),
                (("--aspect", "2:1"), ("coral.glb", "--aspect", "2:1")),
                (("--resolution",), ("coral.glb", "--aspect", "search", "--resolution", "64x32"))):
            self.refuse(2, words, "bench", *arguments, "-o", "r")
            self.assertFalse(self.path("r").exists())
        self.refuse(3, ("coral.glb",), "report", "coral.glb", "-o", "page")
        self.refuse(3, ("empty", "no results"), "report", "empty", "-o", "page")


class GoingOn(BenchTest):
    """A stopped run and a second one come to the table of one that was not stopped."""

    OPTIONS = ("--resolution", 256, "--grid", 128, "--methods", "swg03,modulo", "--threads", 1)

    def stopped(self, folder, how):
        """Starts bench and stops it once it has done a mesh, with others left."""
        arguments = map(str, (COMMAND, "bench", folder, "-o", "r", *self.OPTIONS))
        process = subprocess.Popen(arguments, cwd=self.folder, stderr=subprocess.DEVNULL)
        done = self.folder / "r" / "meshes"
        limit = time.monotonic() + 300
        while not list(done.glob("*.json")):
            self.assertIsNone(process.poll(), "it ended before it could be stopped")
            self.assertLess(time.monotonic(), limit)
            time.sleep(0.01)
        process.send_signal(how)
        status = process.wait(100)
        self.assertLess(len(list(done.glob("*.json"))), 4, "it was done already")
        return status

    def test_after_a_stop_of_any_kind(self):
        folder = self.meshes()
        self.bench(folder, "-o", "whole", *self.OPTIONS)
        for how, status in ((signal.SIGKILL, -signal.SIGKILL), (signal.SIGINT, 130)):
            with self.subTest(how):
                self.assertEqual(self.stopped(folder, how), status)
                done = self.bench(folder, "-o", "r", *self.OPTIONS)
                self.assertRegex(done.stderr, "4 meshes, [123] of them done before")
                self.assertEqual(self.timeless("r"), self.timeless("whole"))
                self.assertFalse(list((self.folder / "r").rglob("*.tmp*")))
                shutil.rmtree(self.folder / "r")


class Links(html.parser.HTMLParser):
    """What a page refers to."""

    def __init__(self):
        super().__init__()
        self.found = []

    def handle_starttag(self, tag, attributes):
        self.found += [value for name, value in attributes if name in ("src", "href")]


class Report(BenchTest):
    def setUp(self):
        super().setUp()
        folder = self.meshes()
        (self.folder / folder / "mosaic.ply").unlink()  # many charts: it takes most of the time
        self.bench(folder, "-o", "r", "--paper")
        self.succeed("report", "r", "-o", "page")
        self.page = (self.folder / "page" / "index.html").read_text()

    def test_has_all_in_it(self):
        links = Links()
        links.feed(self.page)
        pictures = [link for link in links.found if link.startswith("data:image/png;base64,")]
        self.assertGreaterEqual(len(pictures), 12)
        self.assertTrue(all(link.startswith("data:") for link in links.found))
        for part in ("Table 1", "The paper's claims", "By kind of mesh", "Figure 8", "Worst cases",
                     "Every mesh", "meshes-knot"):
            self.assertIn(part, self.page)
        names = {path.name for path in (self.folder / "page").iterdir()}
        self.assertEqual(names, {"index.html", "table1.md", "kinds.md", "figure8.svg", "charts.svg",
                                 "time.svg"})
        # The table is what the rows come to.
        squares = [float(row["efficiency"]) for row in self.rows()
                   if row["packer"] == "modulo" and row["shape"] == "square"]
        mean = f"{100 * sum(squares) / len(squares):.1f} (57)"
        self.assertIn(mean, (self.folder / "page" / "table1.md").read_text())

    def test_the_paper_stands_beside_its_own_setting_alone(self):
        self.bench("meshes", "-o", "other", *QUICK, "--methods", "lprm02,modulo")
        self.succeed("report", "other", "-o", "other_page")
        table = (self.folder / "other_page" / "table1.md").read_text()
        self.assertNotIn("(", table)
        self.assertNotIn("paper's four", table)
        page = (self.folder / "other_page" / "index.html").read_text()
        self.assertFalse("The paper's claims" in page)
        self.assertTrue("The paper's claims" in self.page)

    def test_in_a_browser(self):
        self.assertIsNotNone(BROWSER, "chromium is missing: run ./dev setup")
        # What a reader would see, told by the page itself.
        probe = """<script>addEventListener("load", () => {
          const broken = [...document.images].filter(i => !i.complete || i.naturalWidth == 0);
          const wide = document.documentElement.scrollWidth > innerWidth;
          const told = document.createElement("p");
          told.textContent = `images ${document.images.length} broken ${broken.length} ` +
            `plots ${[...document.querySelectorAll("svg")].filter(
               s => s.getBoundingClientRect().height > 50).length} wide ${wide}`;
          document.body.append(told); });</script></body>"""
        self.write("page/probe.html", self.page.replace("</body>", probe))
        for width in (1200, 390):  # a desk and a phone
            done = subprocess.run(
                [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                 "--enable-logging=stderr", f"--window-size={width},900",
                 f"--user-data-dir={self.folder}/profile", "--virtual-time-budget=5000",
                 "--dump-dom", (self.folder / "page" / "probe.html").as_uri()],
                capture_output=True, text=True, timeout=120,
                env=os.environ | {"HOME": str(self.folder)})
            told = re.search(r"images (\d+) broken (\d+) plots (\d+) wide (\w+)", done.stdout)
            self.assertTrue(told, done.stderr[-2000:])
            self.assertGreaterEqual(int(told[1]), 12)
            self.assertEqual((told[2], told[3], told[4]), ("0", "3", "false"), f"at {width}")
            self.assertNotIn("CONSOLE", done.stderr)


if __name__ == "__main__":
    unittest.main()
