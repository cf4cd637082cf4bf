"""The batch in one process with Dask: what is done, what is not, and what is done again."""

import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import threading
import unittest

import distributed
import fsspec
import wrapatlas.batch as batch
from batch_support import QUICK, ROOT, InFolder, box, results, table, textured_square
from wrapatlas.batch import command, evaluate, files, manifest, page, process, recipe, store


class WithDask(InFolder):
    @classmethod
    def setUpClass(cls):
        cls.client = distributed.Client(processes=False, n_workers=1, threads_per_worker=2, dashboard_address=None,
                                        set_as_default=False, memory_limit=0)

    @classmethod
    def tearDownClass(cls):
        cls.client.close()

    def run_batch(self, assets=None, options=QUICK, **how):
        how.setdefault("client", self.client)
        return batch.run(str(assets or self.meshes), str(how.pop("out", self.out)), how.pop("recipe", "unwrap"),
                         options, **how)

    def manifest(self, *rows, columns=("name", "input")):
        path = self.folder / "assets.csv"
        with open(path, "w", encoding="utf-8", newline="") as file:
            csv.writer(file).writerows([columns, *rows])
        return path


class Resuming(WithDask):
    def test_second_run_does_what_is_not_done(self):
        for width in (1, 2, 3):
            box(self.meshes / f"{width}.off", width)
        (self.meshes / "bad.off").write_text("garbage")
        first = self.run_batch()
        self.assertEqual((first.total, first.done, first.kept, first.failed), (4, 3, 0, 1))
        before = results(self.out)
        box(self.meshes / "bad.off", 4)
        second = self.run_batch()
        self.assertEqual((second.total, second.done, second.kept, second.failed), (4, 4, 3, 0))
        after = results(self.out)
        self.assertEqual(before, {name: after[name] for name in before})
        self.assertEqual(self.left_over(), [])

    def test_what_changed_is_done_again(self):
        box(self.meshes / "a.off", 1)
        textured_square(self.meshes / "b")
        self.assertEqual(self.run_batch().kept, 0)
        self.assertEqual(self.run_batch().kept, 2)
        box(self.meshes / "a.off", 2.5)
        self.assertEqual(self.run_batch().kept, 1)
        (self.meshes / "b/my square.mtl").write_text("newmtl red\nmap_Kd other.png\n")
        self.assertEqual(self.run_batch().kept, 1)
        self.assertEqual(self.run_batch(options=[*QUICK, "--padding", "3"]).kept, 0)
        shutil.rmtree(self.out / "assets/a.off")
        self.assertEqual(self.run_batch(options=[*QUICK, "--padding", "3"]).kept, 1)

    def test_another_command_does_all_again(self):
        box(self.meshes / "a.off")
        self.run_batch()
        own = command.find()
        other = self.folder / "other"
        other.write_text(f'#!/bin/sh\nexec "{own}" "$@"\n')
        other.chmod(0o755)
        before = os.environ.get("WRAPATLAS")
        self.addCleanup(os.environ.__setitem__, "WRAPATLAS", before or own)
        os.environ["WRAPATLAS"] = str(other)
        self.assertEqual(self.run_batch().kept, 0)

    def test_lost_state_is_found_again_in_the_results(self):
        box(self.meshes / "a.off")
        self.run_batch()
        shutil.rmtree(self.out / ".batch")
        self.assertEqual(self.run_batch().kept, 1)

    def test_keep_failed_leaves_failures_that_did_not_change(self):
        bad = self.meshes / "bad.off"
        bad.parent.mkdir()
        bad.write_text("garbage")
        self.run_batch()
        when = table(self.out)[0]["finished"]
        self.assertEqual(self.run_batch(keep_failed=True).failed, 1)
        self.assertEqual(table(self.out)[0]["finished"], when)
        box(bad)
        self.assertEqual(self.run_batch(keep_failed=True).done, 1)

    def test_a_smaller_manifest_leaves_the_other_results(self):
        one, two = box(self.meshes / "1.off"), box(self.meshes / "2.off")
        self.run_batch()
        self.assertEqual(self.run_batch(self.manifest(("1.off", one))).total, 1)
        self.assertEqual([row["name"] for row in table(self.out)], ["1.off"])
        self.assertTrue((self.out / "assets/2.off/2.glb").exists())
        self.assertTrue(two.exists())


class Manifests(WithDask):
    def test_results_are_no_assets(self):
        box(self.meshes / "a.off")
        (self.meshes / "._a.off").write_text("hidden")
        for out in (self.meshes / "out", self.meshes):
            self.out = out
            for kept in (0, 1):
                summary = self.run_batch()
                self.assertEqual((summary.total, summary.done, summary.kept), (1, 1, kept), out)
            shutil.rmtree(out / "assets")

    def test_results_are_no_assets_elsewhere(self):
        memory = fsspec.filesystem("memory")
        memory.put_file(str(box(self.folder / "a.off")), "/scans/a.off")
        memory.pipe("/scans/.old/b.off", b"hidden")
        self.addCleanup(memory.rm, "/scans", recursive=True)
        for kept in (0, 1):
            summary = self.run_batch("memory://scans", out="memory://scans/out", state=str(self.folder / "state"))
            self.assertEqual((summary.total, summary.done, summary.kept), (1, 1, kept))

    def test_names(self):
        box(self.meshes / "a b.off")
        rows = [("tä st/ 日本 é", "meshes/a b.off"), ("twice", "meshes/a b.off"), ("twice", "meshes/a b.off"),
                ("twice/within", "meshes/a b.off"), ("../out", "meshes/a b.off"), ("around/x", "meshes/a b.off"),
                ("around", "meshes/a b.off"), ("", "meshes/a b.off"), ("gone", "meshes/gone.off"), ("empty", "")]
        summary = self.run_batch(self.manifest(*rows))
        self.assertEqual((summary.total, summary.done, summary.failed), (10, 4, 6))
        failed = [row for row in table(self.out) if row["state"] == "failed"]
        self.assertEqual({row["status"] for row in failed}, {""})  # no command ended
        reasons = {row["name"]: row["reason"] for row in failed}
        self.assertEqual(summary.failures, [*reasons.items()][:3])
        self.assertEqual(reasons["twice (line 4)"], "the name is that of line 3 already")
        self.assertEqual(reasons["twice/within (line 5)"], "the name lies within that of line 3")
        self.assertEqual(reasons["../out (line 6)"], "the name cannot be that of a folder")
        self.assertEqual(reasons["around (line 8)"], "the name of line 7 lies within this")
        self.assertIn("no such file", reasons["gone"])
        self.assertTrue((self.out / "assets/tä st/ 日本 é/a b.glb").exists())
        self.assertTrue((self.out / "assets/meshes/a b.off/a b.glb").exists())

    def test_jsonl_with_a_bad_line(self):
        box(self.meshes / "a.off")
        path = self.folder / "assets.jsonl"
        path.write_text('{"input": "meshes/a.off"}\n{"input": \n\n[1]\n')
        summary = self.run_batch(path)
        self.assertEqual((summary.done, summary.failed), (1, 2))

    def test_what_is_no_manifest(self):
        (self.folder / "x.csv").write_text("path\na.off\n")
        (self.folder / "latin.csv").write_bytes("input\nä.off\n".encode("latin-1"))
        for where in ("x.csv", "none.csv", "none", "latin.csv"):
            with self.subTest(where=where), self.assertRaises(batch.UsageError):
                self.run_batch(self.folder / where)
        for where in ("nothing://x.csv", "nothing://x", "memory://none/x.csv"):
            with self.subTest(where=where), self.assertRaisesRegex(batch.UsageError, f"^{where}: "):
                self.run_batch(where)

    def test_values_of_a_row_that_are_no_text(self):
        path = self.folder / "a.jsonl"
        path.write_text('{"input": "a.off", "size": 512, "name": "x"}\n')
        self.assertEqual(next(manifest.read(str(path))).fields, {"size": "512"})


class Failures(WithDask):
    def test_limits(self):
        shutil.copy(ROOT / "samples/knot.off", self.folder / "knot.off")
        only = self.manifest(("knot", "knot.off"))
        for how, words in (({"time_limit": 0.5}, "limit of 0.5 s"), ({"memory_limit": 14}, "limit of 14 MB")):
            with self.subTest(how=how):
                self.run_batch(only, ["--time", "60", "--resolution", "4096"], **how)
                self.assertIn(words, table(self.out)[0]["reason"])
                self.assertEqual(table(self.out)[0]["attempts"], "1")
                self.assertFalse((self.out / "assets/knot").exists())

    def fake(self, body):
        """A command that does what a test needs instead of wrapatlas."""
        path = self.folder / "fake"
        path.write_text('#!/bin/sh\n[ "$1" = --version ] && echo fake 1 && exit\n' + body)
        path.chmod(0o755)
        before = os.environ.get("WRAPATLAS", command.find())
        self.addCleanup(os.environ.__setitem__, "WRAPATLAS", before)
        os.environ["WRAPATLAS"] = str(path)

    def test_a_crash_is_tried_again_and_a_refusal_is_not(self):
        count = self.folder / "count"
        for name in ("crash", "refuse", "late"):
            box(self.meshes / f"{name}.off")
        self.fake(f'case "$2" in *crash.off) echo crash >> "{count}"; kill -SEGV $$;;\n'
                  f'*refuse.off) echo refuse >> "{count}"; echo "wrapatlas: error: no thanks" >&2; exit 3;;\n'
                  f'*) echo late >> "{count}"; [ $(grep -c late "{count}") = 2 ] || kill -KILL $$; echo x > y.glb;;\n'
                  "esac\n")
        summary = self.run_batch(retries=2)
        self.assertEqual((summary.done, summary.failed), (1, 2))
        tried = count.read_text().split()
        self.assertEqual([tried.count(name) for name in ("crash", "refuse", "late")], [3, 1, 2])
        reasons = {row["name"]: row["reason"] for row in table(self.out)}
        self.assertEqual(reasons["crash.off"], "unwrap: killed by signal 11")
        self.assertEqual(reasons["refuse.off"], "unwrap: no thanks")

    def test_input_that_vanishes_in_the_middle(self):
        for name in ("a", "b", "c"):
            box(self.meshes / f"{name}.off")
        self.fake(f'rm -f "{self.meshes}/b.off" "{self.meshes}/c.off"; [ -e "$2" ] || exit 3; echo x > y.glb\n')
        with distributed.Client(processes=False, n_workers=1, threads_per_worker=1, dashboard_address=None,
                                set_as_default=False) as one_at_a_time:
            summary = self.run_batch(client=one_at_a_time)
        self.assertEqual((summary.done, summary.failed), (1, 2))
        self.assertIn("no such file", table(self.out)[0]["reason"])

    def test_wrong_options_stop_at_once(self):
        for number in range(30):
            box(self.meshes / f"{number}.off")
        with self.assertRaisesRegex(batch.UsageError, "the first 10"):
            self.run_batch(options=["--padding", "much"])

    def test_lock(self):
        box(self.meshes / "a.off")
        (self.out / ".batch").mkdir(parents=True)
        lock = store.Lock(str(self.out / ".batch/lock"))
        with self.assertRaisesRegex(batch.BatchError, f"another batch works here .process {os.getpid()}"):
            self.run_batch()
        with self.assertRaisesRegex(batch.BatchError, "another batch works here"):
            self.run_batch(state=str(self.folder / "state"))  # the results are the same
        lock.free()
        self.run_batch(state=str(self.folder / "state"))
        self.assertEqual(self.run_batch().done, 1)

    def test_output_that_is_no_folder(self):
        box(self.meshes / "a.off")
        self.out.write_text("a file")
        with self.assertRaisesRegex(batch.BatchError, "cannot be written to"):
            self.run_batch()

    def test_output_where_there_is_no_file_system(self):
        box(self.meshes / "a.off")
        with self.assertRaisesRegex(batch.UsageError, "^nothing://x: "):
            self.run_batch(out="nothing://x", state=str(self.folder / "state"))

    def test_a_command_ends_when_its_folder_is_taken_away(self):
        scratch = self.folder / "scratch"
        scratch.mkdir()
        threading.Timer(0.3, shutil.rmtree, [scratch]).start()
        with open(self.folder / "log", "wb") as log:
            ended = process.run_limited(["/bin/sleep", "60"], str(scratch), log, 30, None)
        self.assertEqual((ended.status, ended.stopped), (-9, "folder"))

    def test_page(self):
        box(self.meshes / "good.off")
        (self.meshes / "<b>.off").write_text("garbage")
        summary = self.run_batch()
        text = pathlib.Path(summary.page).read_text(encoding="utf-8")
        self.assertIn("1 failed", text)
        self.assertIn("&lt;b&gt;.off", text)
        self.assertNotIn("<b>", text)
        self.assertIn("data:image/png;base64,", text)
        self.assertNotRegex(text, r'(src|href)="(?!data:)')
        self.assertIn("<svg", text)


class Recipes(WithDask):
    def test_steps_in_order(self):
        shutil.copy(ROOT / "samples/knot.off", self.folder / "knot.off")
        path = self.folder / "recipe.json"
        path.write_text(json.dumps({
            "steps": ["wrapatlas unwrap {input} -o low.glb --method modulo --resolution {size}",
                      "bake low.glb {high} -o normal.png --resolution {size} --samples 1",
                      "render low.glb -o 'a view.png' --normal-map normal.png --size 64"],
            "files": ["high"], "drop": ["normal.png"]}))
        rows = self.manifest(("k", "knot.off", "knot.off", 64), ("without", "knot.off", "", 64),
                             columns=("name", "input", "high", "size"))
        summary = self.run_batch(rows, (), recipe=str(path))
        self.assertEqual((summary.done, summary.failed), (1, 1))
        self.assertEqual(sorted(results(self.out)), ["k/a view.png", "k/low.glb"])
        self.assertIn("no column 'high'", table(self.out)[0]["reason"])
        self.assertTrue((self.out / "assets/k/bake.json").exists())

    def test_toml(self):
        path = self.folder / "r.toml"
        path.write_text('steps = [["info", "{input}"], "check {input}"]\naccept = [0, 1]\n')
        if sys.version_info < (3, 11):
            self.skipTest("TOML takes Python 3.11")
        plan = recipe.load(str(path))
        self.assertEqual(plan.accept, [0, 1])
        lines = recipe.command_lines(plan, {"input": "/a b/c.OBJ", "name": "c"})
        self.assertEqual(lines[1], ["check", "/a b/c.OBJ", "--threads", "1", "--json", "check.json"])

    def test_options_with_their_values(self):
        plan = recipe.from_dict("", {"steps": ["unwrap {input} -o a.obj --threads=4 --json=r.json"]})
        line = recipe.command_lines(plan, {"input": "b.off", "name": "b"})[0]
        self.assertEqual(line[-2:], ["--threads=4", "--json=r.json"])
        self.assertEqual(recipe.given_value(line, "--json"), "r.json")
        self.assertEqual(recipe.given_value(line, "-o"), "a.obj")
        self.assertIsNone(recipe.given_value(line, "--image"))
        step = recipe.load("pack", ["--image=a.png"]).steps[0]
        self.assertNotIn("--image", step)

    def test_what_is_no_recipe(self):
        for text in ("{}", "[]", '{"steps": []}', '{"steps": ["rm -rf /"]}', '{"steps": ["info x"], "y": 1}', "{",
                     '{"steps": ["info \'x"]}', '{"steps": [3]}', '{"steps": ["info x"], "accept": 0}',
                     '{"steps": ["info x"], "accept": ["0"]}', '{"steps": ["info x"], "files": "high"}'):
            path = self.folder / "r.json"
            path.write_text(text)
            with self.subTest(text=text), self.assertRaises(batch.UsageError):
                recipe.load(str(path))
        with self.assertRaises(batch.UsageError):
            recipe.load("polish")


class Companions(WithDask):
    def test_materials_come_along(self):
        textured_square(self.meshes)
        self.assertEqual(self.run_batch(recipe="pack").done, 1)
        names = {pathlib.Path(name).name for name in results(self.out)}
        self.assertEqual(names, {"square.obj", "my square.mtl", "skin one.png", "atlas.png"})

    def test_from_and_to_memory(self):
        memory = fsspec.filesystem("memory")
        textured_square(self.folder / "in/deep", up=True)
        memory.put(str(self.folder / "in"), "/models/", recursive=True)
        self.addCleanup(memory.rm, "/models", recursive=True)
        top = "memory://models/in" if memory.exists("/models/in") else "memory://models"
        for times in (0, 1):
            summary = self.run_batch(top, recipe="pack", out="memory://results", state=str(self.folder / "state"))
            self.assertEqual((summary.done, summary.kept), (1, times))
        self.addCleanup(memory.rm, "/results", recursive=True)
        kept = json.loads(memory.cat_file("/results/assets/deep/square.obj/record.json"))
        self.assertEqual(sorted(pathlib.PurePosixPath(url).name for url in kept["marks"]),
                         ["my square.mtl", "skin one.png", "square.obj"])
        self.assertTrue(memory.exists("/results/assets/deep/square.obj/square.obj"))
        self.assertTrue(memory.exists("/results/index.html"))

    def test_file_urls(self):
        box(self.folder / "meshes/a.off")
        rows = self.manifest(("a", f"file://{self.meshes}/a.off"))
        self.assertEqual(self.run_batch(f"file://{rows}", out=f"file://{self.out}").done, 1)
        self.assertTrue((self.out / "assets/a/a.glb").exists())

    def test_remote_output_needs_a_state(self):
        box(self.meshes / "a.off")
        with self.assertRaisesRegex(batch.UsageError, "--state"):
            self.run_batch(out="memory://results")

    def test_gltf_with_a_buffer(self):
        memory = fsspec.filesystem("memory")
        scene = {"buffers": [{"uri": "my%20data.bin"}, {"uri": "data:xyz"}], "images": [{"uri": "p/a.png"}, {}]}
        memory.pipe({"/g/x.gltf": json.dumps(scene).encode(), "/g/my data.bin": b"1", "/g/p/a.png": b"2"})
        self.addCleanup(memory.rm, "/g", recursive=True)
        one = files.Input("memory://g/x.gltf", str(self.folder / "scratch"))
        self.assertEqual(sorted(one.beside), ["my data.bin", "p/a.png"])
        self.assertEqual((pathlib.Path(one.path).parent / "my data.bin").read_bytes(), b"1")

    def test_names_in_mtl(self):
        text = "map_Kd a b.png\n map_bump -bm 0.3 c.png\nbump -o 1 2 3 -clamp on d.png\nNs 3\nmap_Ka -imfchan r e.png\n"
        self.assertEqual(files.picture_names(text), ["a b.png", "c.png", "d.png", "e.png"])


class Evaluating(WithDask):
    def test_joined_is_what_bench_makes(self):
        shutil.copy(ROOT / "samples/knot.off", box(self.meshes / "box.off").parent)
        methods = ["modulo", "swg03"]
        small = ["--resolution", "64", "--rotations", "4"]
        _, joined = evaluate.evaluate(str(self.meshes), str(self.out), methods, small, client=self.client)
        self.assertEqual((joined.meshes, joined.missing), (2, []))
        whole = self.folder / "whole"
        program = command.find()
        subprocess.run([program, "bench", self.meshes, "-o", whole, "--methods", ",".join(methods), *small, "--quiet"],
                       check=True)

        def runs(folder):
            with open(pathlib.Path(folder) / "runs.csv", encoding="utf-8", newline="") as file:
                rows = [{k: v for k, v in row.items() if "seconds" not in k} for row in csv.DictReader(file)]
            return sorted(rows, key=lambda row: (row["mesh"], row["packer"]))

        self.assertEqual(runs(joined.folder), runs(whole))
        for folder in (joined.folder, whole):
            subprocess.run([program, "report", folder, "-o", self.folder / "page", "--quiet"], check=True)

    def test_a_folder_that_cannot_be_written_to(self):
        box(self.meshes / "a.off")
        self.out.write_text("a file")
        with self.assertRaisesRegex(batch.BatchError, str(self.out)):
            evaluate.evaluate(str(self.meshes), str(self.out), ["modulo"], [], client=self.client)

    def test_a_missing_part_leaves_the_mesh_out(self):
        for name in ("a", "b"):
            box(self.meshes / f"{name}.off")
        small = ["--resolution", "64", "--rotations", "4"]
        evaluate.evaluate(str(self.meshes), str(self.out), ["modulo", "swg03"], small, client=self.client)
        shutil.rmtree(self.out / "assets/a.off/swg03")
        joined = evaluate.join_parts(str(self.out), ["a.off", "b.off"], ["modulo", "swg03"])
        self.assertEqual(joined.meshes, 1)
        self.assertRegex(joined.missing[0], "^a.off: ")


class Parts(unittest.TestCase):
    def test_histogram_keeps_its_counts(self):
        bars = page.Histogram(0.01)
        for value in range(1000):
            bars.add(value / 7)
        self.assertEqual(sum(bars.counts), 1000)
        self.assertIn("<svg", bars.svg("t", "s"))

    def test_record_of_a_row(self):
        self.assertEqual(manifest.default_name("x/y.off"), "x/y.off")
        self.assertEqual(manifest.default_name("/x/y.off"), "y.off")
        self.assertEqual(manifest.default_name("s3://b/y.off"), "y.off")


if __name__ == "__main__":
    unittest.main()
