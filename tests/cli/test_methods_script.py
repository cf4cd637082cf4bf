"""bench/methods.py: its tables over two tiny models, and what it does when a check fails."""

import csv
import os
import pathlib
import stat
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "bench" / "methods.py"
METHODS = ["lprm02", "swg03", "zsgs04", "modulo, no wrap", "modulo, wrap uv"]


def squares(sides):
    """An OBJ file of separate square charts."""
    lines = []
    for i, side in enumerate(sides):
        for x, y in ((0, 0), (side, 0), (side, side), (0, side)):
            lines += [f"v {3 * i + x} {y} 0", f"vt {x} {y}"]
        lines.append("f " + " ".join(f"{k}/{k}" for k in range(4 * i + 1, 4 * i + 5)))
    return "\n".join(lines) + "\n"


def table_rows(text):
    return [[cell.strip() for cell in line.strip("|").split("|")]
            for line in text.splitlines() if line.startswith("|")]


class MethodsScript(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.files = []
        for group, sides in (("even", [1, 1, 1]), ("mixed", [2, 1, 1, 0.5, 0.5])):
            path = pathlib.Path(self.folder.name) / group / "squares.obj"
            path.parent.mkdir()
            path.write_text(squares(sides))
            self.files.append(path)

    def run_script(self, *arguments, **environment):
        return subprocess.run([sys.executable, SCRIPT, *map(str, self.files), *arguments],
                              capture_output=True, text=True, env={**os.environ, **environment})

    def test_tables_agree_with_the_numbers(self):
        numbers = pathlib.Path(self.folder.name) / "numbers.csv"
        done = self.run_script("--resolution", "128", "--csv", str(numbers),
                               "--extra", "--grid 64 --rotations 4")
        self.assertEqual(done.returncode, 0, done.stderr)
        first = done.stdout.splitlines()[0]
        for word in ("machine: ", "commit: ", "options: resolution 128", "command: "):
            self.assertIn(word, first)
        with open(numbers, newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 2 * len(METHODS))
        sections = done.stdout.split("\n### ")[1:]
        self.assertEqual([section.split("\n")[0] for section in sections[:3]],
                         ["even: 1 file", "mixed: 1 file", "all: 2 files"])
        for section, groups in zip(sections, (["even"], ["mixed"], ["even", "mixed"])):
            table = table_rows(section)[2:]
            self.assertEqual([row[0] for row in table], METHODS)
            for method, mean, least, most, best, *_ in table:
                mine = [float(row["efficiency"]) for row in rows
                        if row["method"] == method and row["group"] in groups]
                tops = [max(float(row["efficiency"]) for row in rows if row["group"] == group)
                        for group in groups]
                wins = sum(a >= b - 1e-9 for a, b in zip(mine, tops))
                self.assertEqual(mean, f"{sum(mine) / len(mine):.3f}")
                self.assertEqual((least, most), (f"{min(mine):.3f}", f"{max(mine):.3f}"))
                self.assertEqual(best, f"{100 * wins / len(mine):.0f} %")
        ours = {row["file"]: float(row["efficiency"]) for row in rows if row["method"] == METHODS[4]}
        lost = [file for file in ours if any(
            float(row["efficiency"]) > ours[file] + 1e-9 for row in rows if row["file"] == file)]
        self.assertIn(f"is not the best: {len(lost)}", sections[3])
        self.assertEqual([row[0] for row in table_rows(sections[3])[2:]], lost)

    def test_guided_is_measured_on_request(self):
        done = self.run_script("--resolution", "64", "--guided", "0")
        self.assertEqual(done.returncode, 0, done.stderr)
        table = table_rows(done.stdout.split("\n### ")[1])[2:]
        self.assertEqual([row[0] for row in table],
                         [*METHODS, "guided 0 s, no wrap", "guided 0 s, wrap uv"])

    def test_a_failed_check_ends_it_and_is_named(self):
        fake = pathlib.Path(self.folder.name) / "wrapatlas"
        fake.write_text('#!/bin/sh\n'
                        'case "$1 $*" in\n'
                        '  "check "*"--wrap uv"*) echo "charts overlap" >&2; exit 1 ;;\n'
                        'esac\n'
                        'exec "$REAL_WRAPATLAS" "$@"\n')
        fake.chmod(fake.stat().st_mode | stat.S_IXUSR)
        done = self.run_script("--resolution", "64", "--wrapatlas", str(fake),
                               REAL_WRAPATLAS=os.environ["WRAPATLAS"])
        self.assertEqual(done.returncode, 1)
        self.assertIn(f"{self.files[0]}: modulo, wrap uv", done.stderr)
        self.assertIn("charts overlap", done.stderr)
        self.assertNotIn("###", done.stdout)


if __name__ == "__main__":
    unittest.main()
