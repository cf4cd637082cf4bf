"""What the tests of the command share: calling it, models made on the spot, what an error owes."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SAMPLES = pathlib.Path(__file__).resolve().parents[2] / "samples"
PACKABLE = ("coral.glb", "machine.obj", "mosaic.ply")
COMMAND = os.environ.get("WRAPATLAS", "")
# Coarse on purpose: these tests ask whether results are right, not how dense they are.
QUICK = {"--resolution": 256, "--padding": 2, "--rotations": 4, "--grid": 64}


def quick(*options):
    """Options of `pack` with those of QUICK that are not among them; by default for modulo."""
    if "--method" not in options:
        options = (*options, "--method", "modulo")
    return *options, *(x for item in QUICK.items() if item[0] not in options for x in item)


def square(left=0.0, bottom=0.0, size=1.0):
    return rectangle(left, bottom, size, size)


def rectangle(left, bottom, width, height):
    return [(left, bottom), (left + width, bottom), (left + width, bottom + height),
            (left, bottom + height)]


def obj(polygons):
    """An OBJ in which each polygon of UVs is a face, and a chart, of its own."""
    lines, corner = [], 1
    for number, polygon in enumerate(polygons):
        lines += [f"v {u:.9g} {v:.9g} {number}" for u, v in polygon]
        lines += [f"vt {u:.9g} {v:.9g}" for u, v in polygon]
        indices = range(corner, corner + len(polygon))
        lines.append("f " + " ".join(f"{k}/{k}" for k in indices))
        corner += len(polygon)
    return "\n".join(lines) + "\n"


def obj_lines(text, keyword):
    return [line for line in text.splitlines() if line.split()[:1] == [keyword]]


def obj_uvs(path):
    return [tuple(map(float, line.split()[1:3])) for line in obj_lines(path.read_text(), "vt")]


class CommandTest(unittest.TestCase):
    """Each test has a folder of its own; `call` runs the command in it."""

    def setUp(self):
        if not pathlib.Path(COMMAND).is_file():
            self.fail(f"WRAPATLAS has to name the command; it is '{COMMAND}'")
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="wrapatlas_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, content):
        path = self.folder / name
        if isinstance(content, bytes):
            path.write_bytes(content)
        else:
            path.write_text(content)
        return name

    def sample(self, name):
        shutil.copy(SAMPLES / name, self.folder)
        return name

    def path(self, name):
        return self.folder / name

    def call(self, *arguments, timeout=400, **options):
        return subprocess.run([COMMAND, *map(str, arguments)], cwd=self.folder, timeout=timeout,
                              capture_output=True, text=True, stdin=subprocess.DEVNULL, **options)

    def succeed(self, *arguments, **options):
        result = self.call(*arguments, **options)
        self.assertEqual(result.returncode, 0, f"{arguments}\n{result.stdout}{result.stderr}")
        return result

    def pack(self, source, output, *options):
        return self.succeed("pack", source, "-o", output, "--quiet", *quick(*options))

    def pack_report(self, source, output, *options):
        return self.report("pack", source, "-o", output, "--quiet", *quick(*options))

    def report(self, *arguments):
        """What the command says with --json -, which must be all of its standard output."""
        return json.loads(self.succeed(*arguments, "--json", "-").stdout)

    def check(self, output, source, *options, resolution=256, padding=2):
        """`check` against the model it was packed from, by default as `pack` above packs."""
        return self.report("check", output, "--ref", source, "--resolution", resolution,
                           "--padding", padding, "--quiet", *options)

    def contents(self):
        return {str(path.relative_to(self.folder)):
                path.read_bytes() if path.is_file() and not path.is_symlink() else None
                for path in self.folder.rglob("*")}

    def assert_error(self, result, status, *words):
        """One line on stderr with where, what and the way out; nothing on stdout."""
        self.assertEqual(result.returncode, status, result.stderr[-1000:])
        self.assertEqual(result.stdout, "")
        self.assertRegex(result.stderr, r"\Awrapatlas: error: [^\n]*[^\n; ]; [^\n ][^\n]*\n\Z")
        for word in words:
            self.assertIn(word, result.stderr)

    def refuse(self, status, words, *arguments, **options):
        """The call fails as assert_error says and leaves every file as it was."""
        before = self.contents()
        result = self.call(*arguments, **options)
        self.assert_error(result, status, *words)
        self.assertEqual(self.contents(), before)
        return result

    def refuse_pack(self, status, words, source, *options, output="new.obj"):
        """Also with all outputs asked for, and with an older output in the way."""
        rest = ("--json", "new.json", "--image", "new.png", *options)
        self.refuse(status, words, "pack", source, "-o", output, *rest)
        existing = self.folder / output
        if existing.parent.is_dir() and not existing.exists():
            existing.write_text("older\n")
            self.refuse(status, words, "pack", source, "-o", output, *rest)
            existing.unlink()
