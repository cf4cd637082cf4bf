"""`wrapatlas simplify`: fewer triangles, the same shape, and what cannot be kept is told."""

import json
import os
import pathlib
import pty
import signal
import subprocess
import unittest

import gltf_maker
import support
from support import COMMAND, obj_lines

DATA = pathlib.Path(__file__).resolve().parents[3] / "shared/data"
CUBE = """mtllib m.mtl
o cube
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
usemtl paint
f 4 3 2 1
f 5 6 7 8
usemtl steel
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
"""


def counts(path):
    text = path.read_text()
    return len(obj_lines(text, "v")), len(obj_lines(text, "f"))


def shown_twice():
    """A triangle that two nodes show."""
    made = gltf_maker.GltfMaker()
    mesh = made.mesh({"attributes": {"POSITION": made.positions([(0, 0, 0), (1, 0, 0), (0, 1, 0)])}})
    made.node(mesh=mesh)
    made.node(mesh=mesh, translation=[0, 0, 5])
    return made


class Simplify(support.CommandTest):
    def simplify(self, source, output, faces, *options):
        return self.report("simplify", source, "-o", output, "--faces", faces, "--quiet", *options)

    def test_what_has_few_faces_stays_as_it_is(self):
        made = shown_twice()
        self.write("in.glb", made.glb())
        report = self.simplify("in.glb", "out.glb", 1000)
        self.assertEqual((report["faces_before"], report["faces"]), (2, 2))
        data = self.path("out.glb").read_bytes()
        document = json.loads(data[20:20 + int.from_bytes(data[12:16], "little")])
        for key in ("nodes", "meshes", "scenes"):
            self.assertEqual(document[key], made.json[key])
        self.simplify("in.glb", "out.obj", 1000)  # which has no nodes
        self.assertEqual(counts(self.path("out.obj")), (6, 2))

    def test_a_share_or_a_number(self):
        source = self.sample("knot.off")
        faces = 2 * int(self.path(source).read_text().split()[2])  # it has quads
        report = self.simplify(source, "a.obj", "10%")
        self.assertEqual(report["command"], "simplify")
        self.assertEqual(report["faces_before"], faces)
        self.assertLessEqual(abs(report["faces"] - faces / 10), 1.5)
        self.assertAlmostEqual(report["volume"] / report["volume_before"], 1, delta=1e-9)
        self.assertEqual(report["border_edges"], 0)
        vertices, written = counts(self.path("a.obj"))
        self.assertEqual(written, report["faces"])
        self.assertEqual(2 * vertices, written)  # closed, and of genus 1, as it was
        again = self.simplify("a.obj", "b.obj", 100)
        self.assertEqual(again["faces"], 100)
        self.assertEqual(again["target"], 100)
        self.assertLessEqual(again["seconds"]["simplify"], again["seconds"]["total"])

    def test_every_format_goes_to_each(self):
        source = self.sample("knot.off")
        faces = 800
        for output in ("a.obj", "b.ply", "c.glb", "d.gltf", "e.obj"):
            faces -= 100
            self.assertEqual(self.simplify(source, output, faces)["faces"], faces)
            self.assertEqual(self.report("info", output)["faces"], faces)
            source = output
        for ending in ("off", "stl"):
            self.refuse(2, (f"x.{ending}", "not written"), "simplify", source, "-o",
                        f"x.{ending}", "--faces", 100)

    def test_uvs_go_or_stay(self):
        source = self.sample("coral.glb")
        done = self.succeed("simplify", source, "-o", "a.glb", "--faces", "50%")
        self.assertIn("note: its UVs are not kept", done.stderr)
        self.assertIn("no UVs", done.stderr)
        self.assertIsNone(self.report("info", "a.glb")["charts"])
        before = self.report("info", source)["charts"]
        report = self.simplify(source, "b.glb", "50%", "--keep-seams")
        self.assertTrue(report["uvs"])
        self.assertLess(report["faces"], report["faces_before"])
        after = self.report("info", "b.glb")["charts"]
        self.assertEqual(after["count"], before["count"])
        self.assertEqual(after["faces_without_uv"], 0)
        self.assertAlmostEqual(after["area"] / before["area"], 1, delta=0.05)
        packed = self.report("pack", "b.glb", "-o", "c.glb", "--quiet", *support.quick())
        self.assertTrue(packed["valid"])

    def test_what_is_not_kept_is_told(self):
        self.write("a.obj", CUBE)
        done = self.succeed("simplify", "a.obj", "-o", "b.obj", "--faces", 8, "--keep-seams")
        self.assertIn("a.obj: note: --keep-seams keeps none", done.stderr)
        self.assertIn("a.obj: note: its materials, textures and normals are not kept", done.stderr)
        self.assertRegex(done.stderr, r"a\.obj: 8 of 12 triangles, volume .* -> b\.obj")
        self.assertEqual(counts(self.path("b.obj")), (6, 8))
        quiet = self.succeed("simplify", "a.obj", "-o", "b.obj", "--faces", 8, "--quiet")
        self.assertEqual(quiet.stderr, "")

    def test_enough_is_written_as_it_is(self):
        self.write("a.obj", CUBE)
        done = self.succeed("simplify", "a.obj", "-o", "b.obj", "--faces", 12)
        self.assertIn("note: it has 12 triangles", done.stderr)
        self.assertEqual(self.path("b.obj").read_text(), CUBE)

    def test_as_few_as_there_can_be(self):
        self.write("a.obj", CUBE)
        done = self.succeed("simplify", "a.obj", "-o", "b.obj", "--faces", 1)
        self.assertRegex(done.stderr, r"note: 4 triangles remain, more than the 1 of --faces")
        self.assertEqual(counts(self.path("b.obj")), (4, 4))

    def test_the_model_may_take_its_own_place(self):
        self.write("a.obj", CUBE)
        self.succeed("simplify", "a.obj", "-o", "a.obj", "--faces", 8)
        self.assertEqual(counts(self.path("a.obj")), (6, 8))
        self.refuse(2, ("--json a.obj", "overwrite"), "simplify", "a.obj", "-o", "b.obj",
                    "--faces", 8, "--json", "a.obj")
        self.refuse(2, ("same file",), "simplify", "a.obj", "-o", "b.obj", "--faces", 8,
                    "--json", "b.obj")

    def test_broken_surfaces(self):
        points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nv 0 -1 1\nv 0.5 0 0\n"
        for faces, key, count in (("f 1 2 3\nf 2 3 4\n", "turned_faces", 1),
                                  ("f 1 2 3\nf 2 1 4\nf 1 2 5\n", "fixed_vertices", 4),
                                  ("f 1 2 3\nf 2 4 3\nf 1 1 2\nf 2 2 2\n", "dropped_faces", 2)):
            with self.subTest(key):
                self.write("a.obj", points + faces)
                self.assertEqual(self.simplify("a.obj", "b.obj", 1)[key], count)
                loud = self.succeed("simplify", "a.obj", "-o", "b.obj", "--faces", 1)
                self.assertRegex(loud.stderr, rf"a\.obj: note: {count} ")

    def test_refuses(self):
        self.write("a.obj", CUBE)
        self.write("empty.obj", "")
        self.write("bad.obj", CUBE + "f 1 2 99\n")
        self.write("none.off", "OFF\n2 1 0\n0 0 0\n1 0 0\n3 0 1 1\n")
        to = ("-o", "b.obj", "--faces")
        for faces in ("0", "-3", "1.5", "x", "", "%", "0%", "101%", "-1%", "nan%", "1e99"):
            with self.subTest(faces):
                self.refuse(2, ("--faces",), "simplify", "a.obj", *to, faces)
        self.refuse(2, ("--faces",), "simplify", "a.obj", "-o", "b.obj")
        self.refuse(2, ("--output",), "simplify", "a.obj", "--faces", 3)
        self.refuse(2, ("input",), "simplify", *to, 3)
        self.refuse(2, ("b.xyz",), "simplify", "a.obj", "-o", "b.xyz", "--faces", 3)
        self.refuse(3, ("nowhere",), "simplify", "a.obj", "-o", "nowhere/b.obj", "--faces", 3)
        self.refuse(3, ("missing.obj",), "simplify", "missing.obj", *to, 3)
        self.refuse(3, ("empty.obj", "no faces"), "simplify", "empty.obj", *to, 3)
        self.refuse(3, ("bad.obj:19", "99"), "simplify", "bad.obj", *to, 3)
        self.refuse(3, ("none.off", "three points"), "simplify", "none.off", *to, 3)

    def test_interrupted(self):
        self.write_sphere("a.obj", 150)
        before = self.contents()
        terminal, end = pty.openpty()
        process = subprocess.Popen([COMMAND, "simplify", "a.obj", "-o", "b.obj", "--faces", "4"],
                                   cwd=self.folder, stderr=end)
        os.close(end)
        text = ""
        while "simplifying" not in text:
            text += os.read(terminal, 1000).decode()
        process.send_signal(signal.SIGINT)
        try:
            while True:
                text += os.read(terminal, 1000).decode()
        except OSError:  # the other end is closed
            pass
        os.close(terminal)
        self.assertEqual(process.wait(timeout=100), 130)
        self.assertRegex(text.split("\033[K")[-1],
                         r"\Awrapatlas: error: a\.obj: [^\n]*; nothing was written\s*\Z")
        self.assertEqual(self.contents(), before)

    def write_sphere(self, name, n):
        """n squares on each side of a cube, blown up."""
        lines, corner = [], 1
        for axis in range(3):
            for side in (-1, 1):
                for j in range(n + 1):
                    for i in range(n + 1):
                        point = [2 * i / n - 1, side * (2 * j / n - 1), side]
                        size = sum(x * x for x in point) ** 0.5
                        x, y, z = (x / size for x in point[axis:] + point[:axis])
                        lines.append(f"v {x:.9f} {y:.9f} {z:.9f}")
                for j in range(n):
                    for i in range(n):
                        at = corner + j * (n + 1) + i
                        lines.append(f"f {at} {at + 1} {at + n + 2} {at + n + 1}")
                corner += (n + 1) ** 2
        self.write(name, "\n".join(lines) + "\n")

    def test_same_bytes_every_time(self):
        source = self.sample("knot.off")
        for name in ("a.obj", "b.obj"):
            self.simplify(source, name, "5%")
        self.assertEqual(self.path("a.obj").read_bytes(), self.path("b.obj").read_bytes())


@unittest.skipUnless(DATA.is_dir(), "the data beside the repository is not there")
class RealModels(support.CommandTest):
    def test_to_one_percent(self):
        paths = [*sorted((DATA / "models").glob("*.obj")), *sorted((DATA / "psb").glob("*7.off"))]
        self.assertGreater(len(paths), 10)
        for path in paths:
            with self.subTest(path.name):
                report = self.report("simplify", path, "-o", "a.obj", "--faces", "1%", "--quiet")
                self.assertEqual(counts(self.path("a.obj"))[1], report["faces"])
                if report["border_edges"] == 0:
                    self.assertAlmostEqual(report["volume"] / report["volume_before"], 1,
                                           delta=1e-9)
                if report["fixed_vertices"] == 0 and report["components"] < 3:
                    self.assertLessEqual(report["faces"], report["target"])
                self.assertEqual(self.report("info", "a.obj")["faces"], report["faces"])


if __name__ == "__main__":
    unittest.main()
