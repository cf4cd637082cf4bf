"""The batch on a cluster of processes, some of which are killed; on disks that are full or closed.

With WRAPATLAS_BATCH_PSB=FOLDER the kill of a worker is also tried on all meshes of a folder (the
Princeton Segmentation Benchmark), which takes minutes; WRAPATLAS_BATCH_OPTIONS are those of the command (`--time 0`),
WRAPATLAS_BATCH_OUT=FOLDER keeps the results.
"""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import threading
import time
import unittest

import distributed
import psutil
from batch_support import QUICK, ROOT, InFolder, batch, box, command_line, record, results, states, table
from wrapatlas.batch import run

BROKEN = {"broken garbage.off": b"garbage\n", "broken empty.off": b"",
          "broken cut short.off": b"OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n"}
NOBODY = 65534


def finished(out):
    return len(list((out / "assets").rglob("record.json"))) if (out / "assets").exists() else 0


def wait_until(true, seconds=120.0):
    end = time.monotonic() + seconds
    while not true():
        if time.monotonic() > end:
            raise AssertionError("it did not come about")
        time.sleep(0.01)


class Killer(threading.Thread):
    """Kills one worker by its pid, while it works, as soon as so many assets are done."""

    def __init__(self, client, out, when):
        super().__init__(daemon=True)
        self.pids = sorted(client.run(os.getpid).values())
        self.out, self.when, self.killed, self.command = out, when, 0, None

    def run(self):
        wait_until(lambda: finished(self.out) >= self.when, 3600)
        worker = psutil.Process(self.pids[0])
        commands = []  # a second look may come too late
        wait_until(lambda: commands.extend(worker.children()) or commands)
        self.command = commands[0]
        worker.kill()
        self.killed = worker.pid


class KilledWorker(InFolder):
    def compare(self, meshes, options, out):
        """A batch with a worker killed in the middle against one without."""
        good = sorted(path.name for path in meshes.glob("*.*") if path.name not in BROKEN)
        for name, content in BROKEN.items():
            (meshes / name).write_bytes(content)
        with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, memory_limit=0,
                                      silence_logs=50) as cluster:
            with distributed.Client(cluster, set_as_default=False) as client:
                killer = Killer(client, out / "killed", len(good) // 2)
                killer.start()
                summary = run(str(meshes), str(out / "killed"), "unwrap", options, client=client)
                killer.join(5)
                after = sorted(client.run(os.getpid).values())
        self.assertTrue(killer.killed, "the batch was over before a worker was killed")
        self.assertNotIn(killer.killed, after)
        self.assertFalse(killer.command.is_running() and killer.command.status() != psutil.STATUS_ZOMBIE)
        whole = batch(meshes, "-o", out / "whole", "--workers", "2", "--", *options)
        self.assertEqual(whole.returncode, 1, whole.stderr)
        print(f"\n{len(good)} + {len(BROKEN)} meshes: {summary.seconds:.1f} s with worker {killer.killed} killed; "
              f"without: {whole.stderr.splitlines()[-1]}", file=sys.stderr)

        for folder in (out / "killed", out / "whole"):
            rows = table(folder)
            self.assertEqual(sorted(row["name"] for row in rows), sorted([*good, *BROKEN]))  # each once
            self.assertEqual({row["name"] for row in rows if row["state"] == "failed"}, set(BROKEN))
            self.assertEqual([row["name"] for row in rows if row["state"] == "done"],
                             [row["name"] for row in sorted(rows, key=lambda r: int(r["line"]))
                              if row["name"] not in BROKEN])
            self.assertTrue(all(row["reason"] for row in rows if row["state"] == "failed"))
            self.assertEqual(sorted(p.name for p in (folder / "assets").iterdir()), good)
            self.assertFalse((folder / ".batch/tmp").exists())
        one, other = results(out / "killed"), results(out / "whole")
        self.assertEqual(sorted(one), sorted(other))
        self.assertEqual([name for name in one if one[name] != other[name]], [])

    def test_quick(self):
        self.meshes.mkdir()
        for name in ("knot.off", "coral.glb", "mosaic.ply"):
            shutil.copy(ROOT / "samples" / name, self.meshes)
        for width in range(1, 13):
            box(self.meshes / f"box {width}.off", width)
        self.compare(self.meshes, ["--moves", "2000", "--resolution", "256"], self.out)

    @unittest.skipUnless(os.environ.get("WRAPATLAS_BATCH_PSB"), "WRAPATLAS_BATCH_PSB is not set")
    def test_all_of_a_benchmark(self):
        self.meshes.mkdir()
        for path in pathlib.Path(os.environ["WRAPATLAS_BATCH_PSB"]).glob("*.off"):
            (self.meshes / path.name).symlink_to(path)
        out = pathlib.Path(os.environ.get("WRAPATLAS_BATCH_OUT", self.out))
        self.compare(self.meshes, os.environ.get("WRAPATLAS_BATCH_OPTIONS", "--time 0").split(), out)


class Stopped(InFolder):
    def start(self):
        for width in range(40):
            box(self.meshes / f"{width}.off", 1 + width)
        # Moves enough for some tenths of a second each.
        self.words = (self.meshes, "-o", self.out, "--workers", "2", "--", "--moves", "3000")
        return subprocess.Popen(command_line(*self.words), stderr=subprocess.PIPE, text=True,
                                start_new_session=True)

    def go_on(self, least):
        again = batch(*self.words)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(set(states(self.out).values()), {"done"})
        self.assertEqual(len(table(self.out)), 40)
        kept = int(again.stderr.split(" of them before")[0].split("(")[-1])
        self.assertGreaterEqual(kept, least)
        self.assertEqual(self.left_over(), [])

    def test_interrupted(self):
        for name in ("SIGTERM", "SIGINT"):
            with self.subTest(signal=name):
                shutil.rmtree(self.out, ignore_errors=True)
                program = self.start()
                wait_until(lambda: finished(self.out) >= 5)
                os.killpg(program.pid, getattr(signal, name))  # as a terminal does: to all of them
                _, told = program.communicate(timeout=60)
                self.assertEqual(program.returncode, 130, told)
                self.assertNotIn("Traceback", told)
                rows = table(self.out)
                self.assertEqual(len(rows), 40)
                done = [row["name"] for row in rows if row["state"] == "done"]
                self.assertEqual({row["state"] for row in rows}, {"done", "not reached"})
                for one in done:
                    self.assertEqual(record(self.out, one)["state"], "done")
                self.assertEqual(self.left_over(), [])
                self.go_on(len(done))

    def test_killed_outright(self):
        program = self.start()
        wait_until(lambda: finished(self.out) >= 5)
        children = psutil.Process(program.pid).children(recursive=True)
        program.kill()
        program.communicate()
        wait_until(lambda: not any(c.is_running() and c.status() != psutil.STATUS_ZOMBIE for c in children), 30)
        self.go_on(5)

    def test_two_at_once(self):
        program = self.start()
        wait_until(lambda: finished(self.out) >= 1)
        second = batch(*self.words)
        self.assertEqual(second.returncode, 3)
        self.assertIn(f"another batch works here (process {program.pid})", second.stderr)
        _, told = program.communicate(timeout=120)
        self.assertEqual(program.returncode, 0, told)


class OwnScheduler(InFolder):
    def start(self, tool, *words):
        program = subprocess.Popen([sys.executable, "-m", f"distributed.cli.{tool}", *map(str, words), "--no-dashboard",
                                    "--scheduler-file", str(self.folder / "scheduler.json")],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(program.wait)
        self.addCleanup(program.terminate)

    def test_of_the_command_line(self):
        for width in range(6):
            box(self.meshes / f"{width}.off", 1 + width)
        (self.meshes / "broken.off").write_text("garbage")
        self.start("dask_scheduler", "--port", "0")
        wait_until((self.folder / "scheduler.json").exists)
        self.start("dask_worker", "--nworkers", "2", "--nthreads", "1", "--memory-limit", "0")
        address = json.loads((self.folder / "scheduler.json").read_text(encoding="utf-8"))["address"]
        ended = batch(self.meshes, "-o", self.out, "--scheduler", address, "--", *QUICK)
        self.assertEqual(ended.returncode, 1, ended.stderr)
        self.assertRegex(ended.stderr, "(?m)^broken.off: failed: unwrap: .*broken.off")
        self.assertEqual(states(self.out), {"broken.off": "failed", **{f"{i}.off": "done" for i in range(6)}})
        self.assertEqual(self.left_over(), [])


@unittest.skipUnless(os.geteuid() == 0, "takes root, to be somebody else and to mount")
class Storage(InFolder):
    def as_nobody(self, *words):
        """The batch by somebody who has no rights here."""
        try:
            return batch(*words, user=NOBODY)
        except PermissionError:
            self.skipTest(f"{sys.executable} is in a folder that is root's alone")

    def test_no_permission_at_all(self):
        box(self.meshes / "a.off")
        self.folder.chmod(0o755)
        ended = self.as_nobody(self.meshes, "-o", self.out)
        self.assertEqual(ended.returncode, 3, ended.stderr)
        self.assertIn("cannot be written to (Permission denied)", ended.stderr)

    def test_no_permission_for_some(self):
        for name in ("a", "shut/b"):
            box(self.meshes / f"{name}.off")
        self.folder.chmod(0o755)
        (self.out / "assets/shut").mkdir(parents=True)
        for folder in (self.out, self.out / "assets"):
            os.chown(folder, NOBODY, NOBODY)
        ended = self.as_nobody(self.meshes, "-o", self.out, "--workers", "1", "--", *QUICK)
        self.assertEqual(ended.returncode, 1, ended.stderr)
        self.assertEqual(states(self.out), {"shut/b.off": "failed", "a.off": "done"})
        self.assertIn("Permission denied", table(self.out)[0]["reason"])

    def test_full_disk(self):
        for width in range(20):
            box(self.meshes / f"{width}.off", 1 + width)
        self.out.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=400k", "tmpfs", self.out]).returncode:
            self.skipTest("no right to mount")
        self.addCleanup(subprocess.run, ["umount", "-l", self.out])
        words = (self.meshes, "-o", self.out, "--workers", "2", "--retries", "0", "--", "--method", "modulo")
        first = batch(*words)
        self.assertIn(first.returncode, (1, 3), first.stderr)
        self.assertRegex(first.stderr, "failed|disk|space")
        self.assertNotIn("Traceback", first.stderr)
        done = finished(self.out)
        self.assertLess(done, 20)
        subprocess.run(["mount", "-o", "remount,size=16m", self.out], check=True)
        second = batch(*words)
        self.assertEqual(second.returncode, 0, second.stderr)
        self.assertIn(f"20 done ({done} of them before)", second.stderr)


if __name__ == "__main__":
    unittest.main()
