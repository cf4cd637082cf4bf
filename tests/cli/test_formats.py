"""Every format that holds UVs into every other: the copy answers to its source in `check --ref`."""

import unittest

from support import CommandTest, obj, square

ENDINGS = (".obj", ".ply", ".glb", ".gltf")
# Without symmetry, so that none of them is its own mirror image.
HOOKS = [[(0, 0), (0.35, 0), (0.3, 0.1), (0.1, 0.1), (0.1, 0.2), (0, 0.2)],
         [(0.5, 0.5), (0.9, 0.6), (0.55, 0.7)]]


# glTF has triangles alone: its copy of a polygon is no source of a file that keeps the polygon.
TRIANGLES = [hook[:3] for hook in HOOKS]


class Formats(CommandTest):
    def sources(self, polygons=HOOKS):
        """The same model in all formats, as `pack` writes them from the OBJ."""
        self.write("source.obj", obj(polygons))
        for ending in ENDINGS[1:]:
            self.pack("source.obj", "source" + ending, "--wrap", "none")
        return ["source" + ending for ending in ENDINGS]

    def test_all_pairs(self):
        for source in self.sources():
            for ending in ENDINGS:
                for wrap, export in (("none", "continuous"), ("uv", "continuous"), ("uv", "cut")):
                    with self.subTest(source=source, ending=ending, wrap=wrap, export=export):
                        self.pack(source, "out" + ending, "--wrap", wrap, "--export", export)
                        wraps = "none" if export == "cut" else wrap
                        report = self.check("out" + ending, source, "--wrap", wraps)
                        self.assertEqual(report["charts"], 2)

    def test_mirrored_charts_are_found_in_all_pairs(self):
        """The judge must not be blind to what the formats' two v axes could hide."""
        sources = self.sources(TRIANGLES)
        lines = self.path("source.obj").read_text().splitlines()
        self.write("mirrored.obj", "\n".join(
            f"vt {1 - float(line.split()[1]):.9g} {line.split()[2]}"
            if line.startswith("vt ") else line for line in lines) + "\n")
        for ending in ENDINGS:
            self.pack("mirrored.obj", "out" + ending, "--wrap", "none")
            for source in sources:
                with self.subTest(source=source, ending=ending):
                    result = self.call("check", "out" + ending, "--ref", source,
                                       "--resolution", 256)
                    self.assertEqual(result.returncode, 1, result.stderr)
                    self.assertEqual(result.stderr.count("is mirrored"), 2, result.stderr)

    def test_plys_of_other_programs(self):
        """UVs on vertices, under each of the names in use."""
        for names in ("s t", "u v", "texture_u texture_v"):
            u, v = names.split()
            rows = [f"{x} {y} 0 {x} {y}" for x, y in HOOKS[0]]
            self.write("source.ply", "\n".join(
                ["ply", "format ascii 1.0", f"element vertex {len(rows)}"]
                + [f"property float {name}" for name in ("x", "y", "z", u, v)]
                + ["element face 1", "property list uchar int vertex_indices", "end_header", *rows,
                   "6 0 1 2 3 4 5"]) + "\n")
            for ending in ENDINGS:
                with self.subTest(names=names, ending=ending):
                    self.pack("source.ply", "out" + ending, "--wrap", "uv")
                    self.check("out" + ending, "source.ply", "--wrap", "uv")

    def test_the_sample_of_a_ply(self):
        self.sample("mosaic.ply")
        self.pack("mosaic.ply", "out.glb", "--wrap", "uv", "--resolution", "1024")
        self.check("out.glb", "mosaic.ply", "--wrap", "uv", resolution=1024)

    def test_faces_without_uvs_in_between(self):
        lines = obj([square(), *HOOKS]).splitlines()
        faces = [line for line in lines if line.startswith("f ")]
        bare = "f " + " ".join(word.split("/")[0] for word in faces[0].split()[1:])
        self.write("source.obj", "\n".join(
            [line for line in lines if not line.startswith("f ")]
            + [faces[1], bare, faces[2]]) + "\n")
        for ending in ENDINGS:
            with self.subTest(ending=ending):
                self.pack("source.obj", "out" + ending, "--wrap", "none")
                report = self.check("out" + ending, "source.obj")
                self.assertGreaterEqual(report["faces_without_uv"], 1)


if __name__ == "__main__":
    unittest.main()
