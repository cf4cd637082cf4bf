"""The package itself: the command in it, its types, its examples, its version."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from importlib import metadata
from pathlib import Path

import wrapatlas

ROOT = Path(__file__).parents[2]


class Command(unittest.TestCase):
    def test_it_runs(self):
        self.assertTrue(os.access(wrapatlas.command(), os.X_OK))
        script = Path(sys.executable).parent / "wrapatlas"
        for path in (wrapatlas.command(), script):
            run = subprocess.run([path, "--version"], capture_output=True, text=True, check=True)
            self.assertEqual(run.stdout, f"wrapatlas {wrapatlas.__version__}\n")
        self.assertEqual(subprocess.run([script, "info", "nothing.obj"], capture_output=True)
                         .returncode, 3)

    def test_versions(self):
        cmake = re.search(r"project\(wrapatlas VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())
        self.assertEqual(wrapatlas.__version__, cmake[1])
        self.assertEqual(metadata.version("wrapatlas"), cmake[1])


class Types(unittest.TestCase):
    def test_mypy_strict(self):
        folder = Path(wrapatlas.__file__).parent
        self.assertTrue((folder / "py.typed").exists() and (folder / "_core.pyi").exists())
        user = """
import numpy as np
import wrapatlas
from typing_extensions import assert_type

packing = wrapatlas.unwrap(np.zeros((3, 3)), [[0, 1, 2]], padding=4, wrap="none", max_stretch=1.5)
assert_type(packing, wrapatlas.Packing)
vmapping, indices, uvs = wrapatlas.parametrize([[0.0, 0, 0]], [[0, 0, 0]])
x: float = packing.efficiency
ok: bool = wrapatlas.check(packing, padding=2).ok
wrapatlas.pack(packing, paddding=2)  # error: no such option
wrapatlas.pack(packing, wrap="w")  # error: no such choice
"""
        with tempfile.TemporaryDirectory() as cache:
            Path(cache, "user.py").write_text(user)
            run = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", cache,
                                  "-p", "wrapatlas"], capture_output=True, text=True, cwd=cache)
            self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
            run = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", cache,
                                  "user.py"], capture_output=True, text=True, cwd=cache)
            wrong = [line.split(":")[1] for line in run.stdout.splitlines() if ": error:" in line]
            lines = [str(i + 1) for i, line in enumerate(user.splitlines()) if "# error" in line]
            self.assertEqual(wrong, lines, run.stdout)

    def test_everything_public_is_documented(self):
        for name in wrapatlas.__all__:
            thing = getattr(wrapatlas, name)
            if callable(thing):
                self.assertTrue(thing.__doc__, name)
            if isinstance(thing, type) and thing.__module__.startswith("wrapatlas"):
                for member, value in vars(thing).items():
                    if member[0] != "_" and (callable(value) or isinstance(value, property)):
                        self.assertTrue(value.__doc__, f"{name}.{member}")


class Examples(unittest.TestCase):
    def test_they_run_and_draw(self):
        examples = sorted((ROOT / "python" / "examples").glob("*.py"))
        self.assertTrue(examples)
        for example in examples:
            with self.subTest(example.name), tempfile.TemporaryDirectory() as folder:
                run = subprocess.run([sys.executable, example, folder], capture_output=True, text=True)
                self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
                self.assertGreaterEqual(len(list(Path(folder).glob("*.png"))), 3)


class Wheel(unittest.TestCase):
    """Of `./dev wheel`, if this is what is installed: nothing but libc and libstdc++ is needed."""

    ALLOWED = re.compile(r"lib(c|m|stdc\+\+|gcc_s|pthread|dl|rt)\.so|ld-linux|linux-vdso")

    def test_what_it_links_to(self):
        folder = Path(wrapatlas.__file__).parent
        libraries = folder.parent / "wrapatlas.libs"
        if not libraries.exists():
            self.skipTest("this is not a repaired wheel")
        parts = [*folder.glob("_core*.so"), folder / "bin" / "wrapatlas", *libraries.glob("*.so*")]
        self.assertGreater(len(parts), 4)
        self.assertTrue(list((folder / "licenses").glob("*.txt")))
        for part in parts:
            run = subprocess.run(["ldd", part], capture_output=True, text=True, check=True)
            for line in run.stdout.splitlines():
                name, _, where = line.strip().partition(" => ")
                path = Path(where.split(" (")[0])
                inside = libraries.resolve() in path.resolve().parents
                self.assertTrue(inside or self.ALLOWED.search(name), f"{part.name}: {line}")


if __name__ == "__main__":
    unittest.main()
