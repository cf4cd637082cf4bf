"""Every glTF that the command writes is free of errors in the eyes of the Khronos validator."""

import json
import pathlib
import shutil
import subprocess
import unittest

import gltf_maker
import support

VALIDATOR = pathlib.Path(__file__).resolve().parents[1] / "gltf"


class ValidatorTest(support.CommandTest):
    def setUp(self):
        super().setUp()
        self.assertIsNotNone(shutil.which("node"), "node is missing: run ./dev setup")
        self.assertTrue((VALIDATOR / "node_modules" / "gltf-validator").is_dir(),
                        "the glTF validator is missing: run ./dev setup, or npm ci in tests/gltf")

    def validate(self, *names):
        """One run for many files; every one of them has to be judged."""
        result = subprocess.run(["node", VALIDATOR / "validate.mjs", *names], cwd=self.folder,
                                capture_output=True, text=True, timeout=120)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        for name in names:
            self.assertIn(f"{name}: 0 errors", result.stdout)

    def test_the_validator_finds_errors(self):
        maker = gltf_maker.plain()
        maker.json["accessors"][0]["max"] = [0, 0, 0]
        self.write("bad.glb", maker.glb())
        result = subprocess.run(["node", VALIDATOR / "validate.mjs", self.path("bad.glb")],
                                capture_output=True, text=True, timeout=120)
        self.assertEqual(result.returncode, 1)
        self.assertIn("ACCESSOR_MAX_MISMATCH", result.stdout)

    def test_made_models(self):
        names = []
        for name, make in gltf_maker.MODELS.items():
            maker = make()
            self.write(f"{name}.glb", maker.glb())
            self.write(f"{name}.bin", bytes(maker.binary))
            self.write(f"{name}.gltf", maker.document(f"{name}.bin"))
            names += [f"{name}.glb", f"{name}.gltf"]
            for ending in ("glb", "gltf"):
                source = f"{name}.{ending}"
                for export in ("continuous", "cut"):
                    out = f"{name}_{export}.{ending}"
                    with self.subTest(out):
                        self.pack(source, out, "--export", export)
                        wrap = "none" if export == "cut" else "uv"
                        self.assertTrue(self.check(out, source, "--wrap", wrap)["ok"])
                        names.append(out)
        self.validate(*names)

    def test_uvs_in_a_buffer_of_their_own(self):
        """All that was in that buffer is replaced, and an empty one is not allowed."""
        maker = gltf_maker.plain()
        uvs = maker.json["accessors"][2]["bufferView"]
        view = maker.json["bufferViews"][uvs]
        end = view["byteOffset"] + view["byteLength"]
        self.write("a0.bin", bytes(maker.binary))
        self.write("a1.bin", bytes(maker.binary[view["byteOffset"]:end]))
        buffers = [{"byteLength": len(maker.binary), "uri": "a0.bin"},
                   {"byteLength": view["byteLength"], "uri": "a1.bin"}]
        view.update(buffer=1, byteOffset=0)
        self.write("a.gltf", json.dumps({**maker.json, "buffers": buffers}))
        names = ["a.gltf"]
        for export in ("continuous", "cut"):
            for ending in ("gltf", "glb"):
                names.append(f"b_{export}.{ending}")
                self.pack("a.gltf", names[-1], "--export", export)
                self.succeed("info", names[-1])
        self.validate(*names)
        self.assertEqual(sorted(path.name for path in self.folder.glob("*.bin")),
                         ["a0.bin", "a1.bin", "b_continuous.bin", "b_cut.bin"])

    def test_second_uv_set(self):
        self.write("a.glb", gltf_maker.two_uv_sets().glb())
        names = []
        for export in ("continuous", "cut"):
            names.append(f"b_{export}.glb")
            self.pack("a.glb", names[-1], "--texcoord", "1", "--export", export)
        self.validate(*names)

    def test_uv_sets_that_unwrap_adds(self):
        makers = {"plain": gltf_maker.plain, "skinned": gltf_maker.skinned,
                  "textured": gltf_maker.textured, "two": gltf_maker.two_uv_sets}
        names = []
        for name, make in makers.items():
            self.write(f"{name}.glb", make().glb())
            names.append(f"{name}_more.glb")
            self.succeed("unwrap", f"{name}.glb", "-o", names[-1], "--time", 0, "--texcoord",
                         2 if name == "two" else 1)
        self.succeed("unwrap", self.sample("knot.off"), "-o", "bare.glb", "--stop-after", "charts")
        self.succeed("unwrap", "bare.glb", "-o", "first.glb", "--time", 0)
        self.validate(*names, "bare.glb", "first.glb")

    def test_moved_textures(self):
        names = []
        for name, maker in (("a", gltf_maker.textured()), ("t", gltf_maker.textured(True))):
            self.write(f"{name}.glb", maker.glb())
            for ending in ("glb", "gltf"):
                names.append(f"{name}_moved.{ending}")
                self.succeed("transfer", f"{name}.glb", "-o", names[-1], "--time", 0)
        self.validate(*names)

    def test_samples_and_other_formats(self):
        names = []
        for source in support.PACKABLE:
            self.sample(source)
            stem = source.split(".")[0]
            for ending in ("glb", "gltf"):
                for export in ("continuous", "cut"):
                    names.append(f"{stem}_{export}.{ending}")
                    self.pack(source, names[-1], "--export", export)
        self.validate("coral.glb", *names)

    def test_from_one_container_to_the_other(self):
        self.write("a.glb", gltf_maker.skinned().glb())
        maker = gltf_maker.textured()
        self.write("b.bin", bytes(maker.binary))
        self.write("b.gltf", maker.document("b.bin"))
        self.pack("a.glb", "a2.gltf")
        self.pack("b.gltf", "b2.glb")
        self.validate("a.glb", "b.gltf", "a2.gltf", "b2.glb")


if __name__ == "__main__":
    unittest.main()
