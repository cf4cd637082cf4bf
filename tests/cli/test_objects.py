"""Objects that lie at the same place with the same UVs are kept apart, in every format."""

import unittest

from gltf_maker import GltfMaker
from support import CommandTest, obj_lines

CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0.5, 0)]
UVS = [(0.1, 0.1), (0.5, 0.1), (0.5, 0.5), (0.1, 0.5), (0.9, 0.3)]
FACES = [(0, 1, 2), (0, 2, 3), (1, 4, 2)]


def obj(*lines):
    """One set of vertices; each line is of the file, each number stands for that face."""
    rows = [f"v {x} {y} {z}" for x, y, z in CORNERS] + [f"vt {u} {v}" for u, v in UVS]
    for line in lines:
        corners = FACES[line] if isinstance(line, int) else None
        rows.append("f " + " ".join(f"{k + 1}/{k + 1}" for k in corners) if corners else line)
    return "\n".join(rows) + "\n"


ALL = (0, 1, 2)
TWICE = obj("o left", *ALL, "o right", *ALL)


class Objects(CommandTest):
    def charts(self, name):
        return self.report("info", name)["charts"]["count"]

    def test_what_separates_in_an_obj(self):
        for text, charts in ((obj(*ALL, *ALL), 1), (TWICE, 2),
                             (obj("g left", *ALL, "g right", *ALL), 1),
                             (obj("usemtl a", *ALL, "usemtl b", *ALL), 1),
                             (obj("o one", 0, "o one", 1, 2), 1),
                             (obj("o one", 0, "o two", 1, "o one", 2), 2),
                             (obj("o one thing", *ALL, "o one other", *ALL), 2),
                             (obj(*ALL, "o named", *ALL), 2)):
            with self.subTest(text=text):
                self.write("source.obj", text)
                self.assertEqual(self.charts("source.obj"), charts)

    def test_every_format_and_export(self):
        self.write("source.obj", TWICE)
        for ending in (".obj", ".ply", ".glb", ".gltf"):
            for wrap, export in (("none", "continuous"), ("uv", "continuous"), ("uv", "cut")):
                with self.subTest(ending=ending, wrap=wrap, export=export):
                    out = "out" + ending
                    self.pack("source.obj", out, "--wrap", wrap, "--export", export)
                    wraps = "none" if export == "cut" else wrap
                    report = self.check(out, "source.obj", "--wrap", wraps)
                    self.assertEqual(report["charts"], 2)

    def test_there_and_back(self):
        """The number of objects lives on where the format can hold it."""
        self.write("source.obj", TWICE)
        self.pack("source.obj", "there.glb", "--wrap", "uv")
        self.assertEqual(self.charts("there.glb"), 2)
        self.pack("there.glb", "back.obj", "--wrap", "uv")
        self.check("back.obj", "there.glb", "--wrap", "uv")
        self.assertEqual(len(obj_lines(self.path("back.obj").read_text(), "o")), 2)

    def test_stacked_objects_may_go_on_sharing(self):
        """Then a format without objects has them at one place, and the judge knows better."""
        self.write("source.obj", TWICE)
        for ending in (".obj", ".ply", ".glb"):
            with self.subTest(ending=ending):
                out = "out" + ending
                self.pack("source.obj", out, "--stacked", "keep", "--wrap", "uv")
                report = self.check(out, "source.obj", "--stacked", "keep", "--wrap", "uv")
                self.assertEqual(report["charts"], 2)
                result = self.call("check", out, "--ref", "source.obj", "--resolution", 256,
                                   "--wrap", "uv")
                self.assertEqual(result.returncode, 1, "without --stacked keep they overlap")

    def test_an_object_that_is_taken_up_again(self):
        self.write("source.obj", obj("o one", 0, "o two", *ALL, "o one", 1, 2))
        for ending in (".obj", ".ply", ".glb"):
            for export, wrap in (("continuous", "uv"), ("cut", "none")):
                with self.subTest(ending=ending, export=export):
                    out = "out" + ending
                    self.pack("source.obj", out, "--wrap", "uv", "--export", export)
                    report = self.check(out, "source.obj", "--wrap", wrap)
                    self.assertEqual(report["charts"], 2)

    def test_a_reference_without_objects(self):
        """A PLY cannot tell its two layers apart: they are one chart, and stay one."""
        self.write("source.obj", TWICE)
        self.pack("source.obj", "same.ply", "--stacked", "keep", "--wrap", "none")
        self.assertEqual(self.charts("same.ply"), 1)
        self.pack("same.ply", "out.glb", "--wrap", "none")
        self.check("out.glb", "same.ply")
        # And the other way round: what keeps objects apart is judged by what does not.
        self.pack("source.obj", "kept.glb", "--stacked", "keep", "--wrap", "none")
        self.check("kept.glb", "same.ply", "--stacked", "keep")

    def test_meshes_of_a_gltf(self):
        """Meshes are objects, though they share accessors; primitives of one mesh are not."""
        maker = GltfMaker()
        attributes = {"POSITION": maker.positions(CORNERS), "TEXCOORD_0": maker.accessor(UVS)}

        def primitive(*faces):
            corners = [k for face in faces for k in FACES[face]]
            return {"attributes": attributes, "indices": maker.indices(corners)}

        first = maker.mesh(primitive(0, 1), primitive(2))
        second = maker.mesh(primitive(*ALL))
        for mesh in (first, second, first):
            maker.node(mesh=mesh)
        self.write("source.glb", maker.glb())
        self.assertEqual(self.charts("source.glb"), 2)
        for ending in (".glb", ".obj", ".ply"):
            for export in ("continuous", "cut"):
                with self.subTest(ending=ending, export=export):
                    out = "out" + ending
                    self.pack("source.glb", out, "--wrap", "uv", "--export", export)
                    wraps = "none" if export == "cut" else "uv"
                    # In a format without nodes the one that is shown twice is there twice.
                    charts = 2 if ending == ".glb" else 3
                    self.assertEqual(
                        self.check(out, "source.glb", "--wrap", wraps)["charts"], charts)

    def test_faces_that_are_there_twice_in_one_object(self):
        self.write("source.obj", obj(*ALL, *ALL, 0))
        for ending in (".obj", ".ply", ".glb"):
            for wrap, export in (("none", "continuous"), ("uv", "cut")):
                with self.subTest(ending=ending, export=export):
                    out = "out" + ending
                    self.pack("source.obj", out, "--wrap", wrap, "--export", export)
                    report = self.check(out, "source.obj")
                    self.assertEqual(report["charts"], 1)
                    self.assertGreaterEqual(report["faces"], 7)


if __name__ == "__main__":
    unittest.main()
