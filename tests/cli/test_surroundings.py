"""Files that are not there, cannot be read or cannot be written: one clear line and no trace."""

import os
import resource
import shutil
import subprocess
import unittest

import gltf_maker
import support
from small_files import GOOD
from support import COMMAND, obj, quick, square


def file_size_limit(size):
    """For `call`: makes a write fail half-way, as on a full disk; needs no rights."""
    return {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)),
            "restore_signals": False}


class Surroundings(support.CommandTest):
    """Files that are not there, cannot be read, or cannot be written."""

    def setUp(self):
        super().setUp()
        self.write("a.obj", GOOD)

    def test_missing_input(self):
        for name in ("none.obj", "none/a.glb", "a.obj/b.obj"):
            self.refuse(3, (name, "cannot open"), "info", name)
            self.refuse_pack(3, (name, "cannot open"), name)
        self.refuse(3, ("none.obj",), "check", "none.obj")
        self.refuse(3, ("none.obj",), "check", "a.obj", "--ref", "none.obj")

    def test_folder_as_input(self):
        self.path("folder.obj").mkdir()
        self.refuse_pack(3, ("folder.obj", "cannot read"), "folder.obj")

    def test_unreadable_input(self):
        """Root may read all but what the kernel itself refuses to hand out."""
        if os.geteuid() != 0:
            self.path("a.obj").chmod(0)
            self.refuse_pack(3, ("a.obj", "cannot open (Permission denied)"), "a.obj")
        else:
            os.symlink("/proc/self/mem", self.path("m.obj"))
            self.refuse(3, ("m.obj", "cannot read"), "info", "m.obj")

    def test_unknown_input_ending(self):
        for name in ("a.fbx", "a", "a.obj.gz"):
            self.write(name, GOOD)
            self.refuse_pack(2, (name, ".obj"), name)

    def test_unknown_output_ending(self):
        for name in ("b.fbx", "b", "b.png"):
            self.refuse_pack(2, (name, "write .obj, .ply, .gltf or .glb"), "a.obj", output=name)

    def test_formats_without_uvs_as_output(self):
        for name in ("b.stl", "b.off"):
            self.refuse_pack(2, (name, "cannot hold UVs"), "a.obj", output=name)

    def test_output_where_none_can_be(self):
        good = ("pack", "a.obj", *quick())
        for bad in ("none/b", "a.obj/b", "/proc/b"):
            with self.subTest(bad):
                self.refuse(3, (bad, "cannot write"), *good, "-o", bad + ".obj")
                self.refuse(3, (bad, "cannot write"), *good, "-o", bad + ".gltf")
        self.path("folder.obj").mkdir()
        self.refuse(3, ("folder.obj", "cannot write"), *good, "-o", "folder.obj")

    def test_outputs_are_tried_before_the_search(self):
        for outputs in (("-o", "none/b.obj"), ("-o", "b.obj", "--image", "none/b.png"),
                        ("-o", "b.obj", "--json", "none/b.json")):
            self.refuse(3, ("none/b", "cannot write"), "pack", "a.obj", "--time", "1000", *outputs)

    def test_unwritable_folder(self):
        if os.geteuid() == 0:
            self.skipTest("root may write everywhere; test_output_where_none_can_be has the rest")
        (self.folder / "closed").mkdir(mode=0o500)
        self.refuse(3, ("closed/b.obj", "cannot write"), "pack", "a.obj", "-o", "closed/b.obj",
                    *quick())

    def test_full_device(self):
        os.symlink("/dev/full", self.path("full.obj"))
        self.refuse(3, ("full.obj", "No space left", "disk space"), "pack", "a.obj", "-o",
                    "full.obj", *quick())
        with open("/dev/full", "w") as full:
            result = subprocess.run([COMMAND, "info", "a.obj", "--json", "-"], cwd=self.folder,
                                    stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(result.returncode, 3)
        self.assertRegex(result.stderr, r"\Awrapatlas: error: standard output: [^\n]+; [^\n]+\n\Z")

    def test_full_disk(self):
        text = obj([square(2 * i) for i in range(100)])
        for name in ("big.obj", "big.glb"):
            self.write("big.obj", text)
            self.pack("big.obj", "big.glb")
            before = self.contents()
            result = self.call("pack", name, "-o", name, *quick(), **file_size_limit(2000))
            self.assert_error(result, 3, name, "disk space")
            self.assertEqual(self.contents(), before)

    def test_full_file_system(self):
        """The real thing: a tiny file system in a mount name space of its own."""
        disk = self.folder / "disk"
        disk.mkdir()
        self.write("big.obj", obj([square(2 * i) for i in range(1000)]))
        script = ('mount -t tmpfs -o size=16k tmpfs "$1" || exit 99; echo old > "$1/b.obj"; shift;'
                  ' "$@"; status=$?; cat disk/*; ls -A disk; exit $status')
        result = subprocess.run(
            ["unshare", "--mount", "sh", "-c", script, "sh", disk, COMMAND, "pack", "big.obj", "-o",
             "disk/b.obj", *map(str, quick())], cwd=self.folder, capture_output=True, text=True) \
            if shutil.which("unshare") else None
        if result is None or "unshare" in result.stderr or result.returncode == 99:
            self.skipTest("mounting a small file system takes root")
        self.assertEqual(result.stdout, "old\nb.obj\n")
        self.assertEqual(result.returncode, 3)
        self.assertRegex(result.stderr, r"\Awrapatlas: error: disk/b.obj: cannot write \(No space left on "
                                        r"device\); [^\n]+\n\Z")


class AllOutputsOrNone(support.CommandTest):
    """Model, picture and report appear together or not at all."""

    def setUp(self):
        super().setUp()
        self.write("a.obj", GOOD)

    def test_unknown_picture_ending(self):
        self.refuse(2, ("b.jpg", ".png"), "pack", "a.obj", "-o", "b.obj", "--image", "b.jpg",
                    *quick())

    def test_picture_where_none_can_be(self):
        self.refuse(3, ("none/b.svg", "cannot write"), "pack", "a.obj", "-o", "b.obj", "--image",
                    "none/b.svg", *quick())

    def test_report_where_none_can_be(self):
        self.refuse(3, ("none/b.json", "cannot write"), "pack", "a.obj", "-o", "b.obj", "--json",
                    "none/b.json", *quick())

    def test_report_to_a_full_device(self):
        self.refuse(3, ("/dev/full", "No space left"), "pack", "a.obj", "-o", "b.obj", "--json",
                    "/dev/full", *quick())

    def test_gltf_and_its_bin(self):
        """There is room for the .bin and not for the .gltf; the older .bin must stay as it is."""
        self.pack("a.obj", "a.glb")
        self.pack("a.glb", "b.gltf")
        self.assertLess(self.path("b.bin").stat().st_size, 400)
        self.assertGreater(self.path("b.gltf").stat().st_size, 400)
        self.refuse(3, ("b.gltf", "cannot write"), "pack", "a.glb", "-o", "b.gltf", "--wrap",
                    "none", "--quiet", *quick(), **file_size_limit(400))

    def test_gltf_in_the_way_of_a_folder(self):
        self.path("b.gltf").mkdir()
        self.write("b.bin", b"older")
        self.refuse(3, ("b.gltf", "cannot write"), "pack", "a.obj", "-o", "b.gltf", *quick())


class OutputsApart(support.CommandTest):
    """No output may take the place of another one, or of what is read; only the model may."""

    def setUp(self):
        super().setUp()
        self.write("a.obj", "mtllib a.mtl\n" + GOOD)
        self.write("a.mtl", "newmtl m\n")
        (self.folder / "sub").mkdir()

    def test_two_outputs_of_one_name(self):
        pack = ("pack", "a.obj", *quick())
        for outputs in (("-o", "b.obj", "--json", "b.obj"),
                        ("-o", "a.obj", "--json", "a.obj"),
                        ("-o", "b.obj", "--image", "c.svg", "--json", "c.svg"),
                        ("-o", "b.obj", "--image", "sub/c.svg", "--json", "./sub/../sub/c.svg"),
                        ("-o", "b.obj", "--json", self.folder / "b.obj")):
            self.refuse(2, ("names the same file", "a name of its own"), *pack, *outputs)
        self.write("b.obj", "older\n")
        os.symlink("b.obj", self.path("link.obj"))
        self.refuse(2, ("--json b.obj", "-o names the same file"), *pack, "-o", "link.obj",
                    "--json", "b.obj")

    def test_report_and_bin(self):
        self.write("a.glb", gltf_maker.plain().glb())
        self.refuse(2, ("b.bin", "two outputs"), "pack", "a.glb", "-o", "b.gltf", "--quiet",
                    "--json", "./b.bin", *quick())

    def test_inputs_are_kept(self):
        pack = ("pack", "a.obj", "-o", "b.obj", *quick())
        self.refuse(2, ("--json a.obj", "overwrite the input"), *pack, "--json", "a.obj")
        self.refuse(2, ("a.mtl", "a file of the input"), *pack, "--json", "./a.mtl")
        self.refuse(2, ("overwrite the input",), "info", "a.obj", "--json", "sub/../a.obj")
        self.pack("a.obj", "b.obj")
        for report in ("a.obj", "b.obj"):
            self.refuse(2, (report, "overwrite the input"), "check", "b.obj", "--ref", "a.obj",
                        "--json", report)

    def test_files_of_a_gltf_are_kept(self):
        maker = gltf_maker.textured()
        maker.json["images"] = [{"uri": "a%20b.png"}]
        self.write("a b.png", gltf_maker.PNG)
        self.write("a.bin", bytes(maker.binary))
        self.write("a.gltf", maker.document("a.bin"))
        pack = ("pack", "a.gltf", "-o", "sub/b.gltf", *quick())
        self.refuse(2, ("a.bin", "a file of the input"), *pack, "--json", "a.bin")
        self.refuse(2, ("a b.png", "a file of the input"), *pack, "--image", "a b.png")
        self.succeed(*pack, "--image", "sub/a b.png")

    def test_what_may_be_equal(self):
        self.pack("a.obj", "a.obj", "--json", "-")
        self.pack("a.obj", "a.obj", "--json", "/dev/null", "--image", "a.svg")
        self.succeed("info", "a.obj", "--json", "/dev/stdout")


if __name__ == "__main__":
    unittest.main()
