"""The measuring scripts of bench/ in their smallest settings. methods.py has a test of its own."""

import csv
import os
import pathlib
import stat
import subprocess
import sys
import unittest

from support import COMMAND, CommandTest

BENCH = pathlib.Path(__file__).resolve().parents[2] / "bench"
sys.path.insert(0, str(BENCH))
import photogrammetry  # noqa: E402

FAILING_CHECK = '#!/bin/sh\n[ "$1" = check ] && { echo "charts overlap" >&2; exit 1; }\n' \
                'exec "$REAL_WRAPATLAS" "$@"\n'


class BenchScripts(CommandTest):
    def script(self, name, *arguments, status=0, **environment):
        done = subprocess.run([sys.executable, BENCH / name, *map(str, arguments)],
                              cwd=self.folder, capture_output=True, text=True,
                              env={**os.environ, **environment})
        self.assertEqual(done.returncode, status, done.stderr)
        if status == 0:
            for word in ("machine: ", "commit: ", "options: ", "command: "):
                self.assertIn(word, done.stdout.splitlines()[0])
        return done

    def failing_command(self):
        self.write("failing", FAILING_CHECK)
        path = self.path("failing")
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return str(path)

    def test_jigsaws(self):
        done = self.script("jigsaws.py", "--pieces", "4,6", "--seeds", "1", "--wrap", "uv,none",
                           "--time", "0", "--resolution", "64", "--images", "pictures")
        self.assertIn("| 6 | none | 1 | 0.", done.stdout)
        self.assertEqual(len(list(self.path("pictures").glob("*.png"))), 4)

    def test_scale(self):
        done = self.script("scale.py", "--charts", "5,1000,1100", "--method", "modulo",
                           "--resolution", "512", "--padding", "1")
        self.assertRegex(done.stdout, r"\| 1100 \| 0\.\d+ \| [\d.]+ \| [\d.]+ \| \d+ \|")
        self.assertRegex(done.stdout, r"time grows as n\^-?\d")

    def test_curve_and_its_plot_from_the_numbers(self):
        self.write("charts.obj", photogrammetry.photogrammetry(6))
        self.script("curve.py", "--folder", ".", "--times", "0,0.1,0.2", "--resolution", "64")
        with open(self.path("curve.csv"), newline="") as file:
            self.assertEqual(len(list(csv.DictReader(file))), 5 + 2 * 3)
        drawn = self.path("curve.svg").read_text()
        for word in ("modulo", "zsgs04", "guided --time 0"):
            self.assertIn(word, drawn)
        subprocess.run([sys.executable, BENCH / "curve.py", "--from-csv", "curve.csv", "--svg",
                        "again.svg"], cwd=self.folder, check=True, capture_output=True)
        self.assertEqual(self.path("again.svg").read_text(), drawn)

    def test_ablation(self):
        self.sample("coral.glb")
        done = self.script("ablation.py", "coral.glb", "--only", "the paper's setting")
        rows = [line for line in done.stdout.splitlines() if line.startswith("| ")]
        self.assertEqual(len(rows), 1 + 10)
        self.assertRegex(rows[1], r"\| as printed \| 0\.\d+ \| \+0\.0 \| 0/0 \|")
        efficiency = {row.split("|")[1].strip(): float(row.split("|")[2]) for row in rows[1:]}
        self.assertLess(efficiency["4 rotations"], efficiency["64 rotations"])
        self.assertIn("no table has", self.script("ablation.py", "coral.glb", "--only", "nothing",
                                                  status=2).stderr)

    def test_a_failed_check_ends_them(self):
        self.write("charts.obj", photogrammetry.photogrammetry(6))
        for name, *arguments in (("jigsaws.py", "--pieces", "4", "--time", "0"),
                                 ("scale.py", "--charts", "5"), ("curve.py", "--folder", ".")):
            with self.subTest(script=name):
                done = self.script(name, *arguments, "--resolution", "64", "--wrapatlas",
                                   self.failing_command(), status=1, REAL_WRAPATLAS=COMMAND)
                self.assertIn("charts overlap", done.stderr)
                self.assertNotIn("passed", done.stdout)


class Photogrammetry(CommandTest):
    def test_charts_are_as_many_as_asked_for_and_heavy_tailed(self):
        self.write("scan.obj", photogrammetry.photogrammetry(2000, seed=3))
        charts = self.report("info", "scan.obj")["charts"]
        self.assertEqual(charts["count"], 2000)
        self.assertEqual((charts["stacked"], charts["degenerate"]), (0, 0))
        self.assertGreater(charts["area_largest"], 100 * charts["area_median"])

    def test_same_options_same_bytes(self):
        first = photogrammetry.photogrammetry(50)
        self.assertEqual(first, photogrammetry.photogrammetry(50))
        self.assertNotEqual(first, photogrammetry.photogrammetry(50, seed=1))
        subprocess.run([sys.executable, BENCH / "photogrammetry.py", "--charts", "50", "-o",
                        self.path("scan.obj")], check=True)
        self.assertEqual(first, self.path("scan.obj").read_text())


if __name__ == "__main__":
    unittest.main()
