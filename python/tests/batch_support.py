"""What the tests of the batch share: small models, and a look at what a batch left."""

import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
QUICK = ["--method", "modulo", "--resolution", "64"]  # a few milliseconds a mesh
# Beside every result, and with times in them: not the same from run to run.
OF_THE_RUN = ("record.json", "log.txt", "unwrap.json", "bake.json", "render.json", "pack.json")
CUBE = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]


def box(path, width=1.0):
    """An OFF file of a box."""
    points = [(0, 0, 0), (width, 0, 0), (width, 1, 0), (0, 1, 0), (0, 0, 1), (width, 0, 1), (width, 1, 1), (0, 1, 1)]
    lines = ["OFF", "8 6 0", *(" ".join(map(str, p)) for p in points)]
    lines += ["4 " + " ".join(map(str, face)) for face in CUBE]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def textured_square(folder, up=False):
    """An OBJ with UVs, its .mtl and a picture; with `up` these lie in the folder above."""
    lead = "../" if up else ""
    home = folder.parent if up else folder
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "square.obj").write_text(
        f"mtllib {lead}my square.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
        "usemtl red\nf 1/1 2/2 3/3 4/4\n", encoding="utf-8")
    (home / "my square.mtl").write_text("newmtl red\nmap_Kd -bm 0.5 skin one.png\n", encoding="utf-8")
    (home / "skin one.png").write_bytes(b"not looked at by pack")
    return folder / "square.obj"


def table(out):
    with open(out / "results.csv", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def states(out):
    return {row["name"]: row["state"] for row in table(out)}


def results(out):
    """Path → bytes of all results that are the same from run to run."""
    assets = out / "assets"
    return {str(path.relative_to(assets)): path.read_bytes() for path in sorted(assets.rglob("*"))
            if path.is_file() and path.name not in OF_THE_RUN}


def record(out, name):
    return json.loads((out / "assets" / name / "record.json").read_text(encoding="utf-8"))


def command_line(*words, **how):
    return [sys.executable, "-m", "wrapatlas.batch", *map(str, words)]


def batch(*words, **how):
    """The batch as a program."""
    return subprocess.run(command_line(*words), capture_output=True, text=True, timeout=600, **how)


class InFolder(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        keeper = tempfile.TemporaryDirectory(prefix="wrapatlas batch ü ")
        self.addCleanup(keeper.cleanup)
        self.folder = pathlib.Path(keeper.name)
        self.out = self.folder / "out"
        self.meshes = self.folder / "meshes"

    def left_over(self):
        """What a batch must not leave behind."""
        return [path.name for path in (self.out / ".batch").iterdir() if path.name not in ("lock", "state.sqlite")]
