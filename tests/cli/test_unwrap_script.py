"""bench/unwrap.py: its tables, and what it says of a command that breaks its promises. Without
numpy, no test."""

import csv
import importlib.util
import os
import pathlib
import subprocess
import sys
import unittest

from support import COMMAND, CommandTest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "bench" / "unwrap.py"
CUBE = """OFF
8 12 0
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
3 2 1 0
3 3 2 0
3 4 5 6
3 4 6 7
3 0 1 5
3 0 5 4
3 1 2 6
3 1 6 5
3 2 3 7
3 2 7 6
3 3 0 4
3 3 4 7
"""
# Runs the command, then a line of Python on the OBJ that it wrote, as a list of lines.
SPOILT = """#!/bin/sh
"$REAL_WRAPATLAS" "$@" || exit
[ "$1" = unwrap ] || exit 0
"$PYTHON" - "$4" <<'END'
import sys
lines = open(sys.argv[1]).read().splitlines()
{change}
open(sys.argv[1], "w").write("\\n".join(lines) + "\\n")
END
"""
CHANGES = {
    "faces became 11": "lines.pop()",
    "corners are at other positions": "lines[lines.index('v 0 0 0')] = 'v 0 0 0.5'",
    "faces without UVs": "lines[-1] = ' '.join(w.split('/')[0] for w in lines[-1].split())",
    "flipped triangles": "lines = [l if l[:2] != 'vt' or k % 5 else 'vt 0.123 0.456'"
                         " for k, l in enumerate(lines)]",
    "reports L2 stretch": "lines = [' '.join(['vt', str(9 * float(l.split()[1])), l.split()[2]])"
                          " if l[:2] == 'vt' else l for l in lines]",
    "check: exit status 1": "lines = [' '.join(['vt', *(str(3 * float(x)) for x in l.split()[1:])])"
                            " if l[:2] == 'vt' else l for l in lines]",
}


@unittest.skipUnless(importlib.util.find_spec("numpy"), "numpy is not there")
class UnwrapScript(CommandTest):
    def run_script(self, *arguments, command=COMMAND):
        self.write("cube.off", CUBE)
        return subprocess.run([sys.executable, SCRIPT, *arguments, "--time", "0.01", "--resolution",
                               "64", "--wrapatlas", command], cwd=self.folder, capture_output=True,
                              text=True, env={**os.environ, "REAL_WRAPATLAS": COMMAND,
                                              "PYTHON": sys.executable})

    def spoilt_command(self, change):
        self.write("spoilt", SPOILT.format(change=change))
        self.path("spoilt").chmod(0o755)
        return str(self.path("spoilt"))

    def test_tables_and_numbers(self):
        done = self.run_script("cube.off", "--csv", "numbers.csv")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("machine: ", done.stdout.splitlines()[0])
        self.assertIn("breaks a promise: 0 of 1", done.stdout)
        with open(self.path("numbers.csv"), newline="") as file:
            row, = csv.DictReader(file)
        self.assertEqual((row["faces"], row["failed"], row["not_discs"]), ("12", "", "0"))
        self.assertLessEqual(float(row["l2"]), 2)
        self.assertIn(f"| cube | wrapatlas | 1 | 12 | {row['charts']} |", done.stdout)

    def test_broken_promises_are_named(self):
        for words, change in CHANGES.items():
            with self.subTest(words=words):
                done = self.run_script("cube.off", command=self.spoilt_command(change))
                self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
                self.assertRegex(done.stdout, rf"\n- cube\.off: .*{words}")

    def test_other_files_go_on_after_one_without_a_result(self):
        self.write("empty.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n")
        done = self.run_script("empty.off", "cube.off")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stdout, r"\n- empty\.off: exit status 3")
        self.assertIn("| cube | wrapatlas | 1 | 12 |", done.stdout)

    def test_the_limit_of_time(self):
        self.write("slow", "#!/bin/sh\nexec sleep 20\n")
        self.path("slow").chmod(0o755)
        done = self.run_script("cube.off", "--limit", "0.2", command=str(self.path("slow")))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("- cube.off: not done after 0.2 s", done.stdout)

    def test_folded_faces_are_counted_apart(self):
        lines = CUBE.splitlines()
        lines[1] = "8 14 0"
        self.write("folded.off", "\n".join([*lines, "3 0 0 1", "3 2 2 2"]) + "\n")
        done = self.run_script("folded.off")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
