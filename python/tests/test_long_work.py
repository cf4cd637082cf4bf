"""Progress, Ctrl-C, other threads, memory."""

import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
import unittest

import numpy as np
import shapes

import wrapatlas

UV, FACES = shapes.scattered_squares(40)


class Progress(unittest.TestCase):
    def test_stages(self):
        seen = []
        wrapatlas.unwrap(*shapes.sphere(5000), time=0.3,
                         progress=lambda stage, share, detail: seen.append((stage, share, detail)))
        self.assertEqual({stage for stage, _, _ in seen} - {"unwrap"}, {"pack"})
        self.assertEqual(seen[-1][:2], ("pack", 1.0))
        self.assertTrue(all(0 <= share <= 1 for _, share, _ in seen))

    def test_false_ends_the_search_with_the_best(self):
        begin = time.monotonic()
        packing = wrapatlas.pack(UV, FACES, time=100,
                                 progress=lambda stage, share, best: best == 0)
        self.assertLess(time.monotonic() - begin, 60)
        self.assertTrue(packing.interrupted)
        self.assertTrue(packing.report.ok)

    def test_what_it_raises_comes_out(self):
        def fail(stage, share, detail):
            raise KeyError("mine")

        for call, arguments in ((wrapatlas.pack, (UV, FACES)), (wrapatlas.unwrap, shapes.sphere())):
            with self.assertRaisesRegex(KeyError, "mine"):
                call(*arguments, time=20, progress=fail)

    def test_bars(self):
        wrapatlas.pack(UV, FACES, time=0.1, progress=True)

    def test_of_bake_and_transfer(self):
        mesh = wrapatlas.unwrap(*shapes.sphere(), time=0)
        stages = set()

        def note(stage, share, detail):
            stages.add(stage)

        wrapatlas.bake(mesh, mesh, progress=note, resolution=64)
        wrapatlas.transfer(shapes.checker(), mesh, mesh, progress=note, resolution=64)
        wrapatlas.simplify(mesh, 100, progress=note)
        self.assertEqual(stages, {"bake", "transfer", "simplify"})


class Interrupt(unittest.TestCase):
    def press(self, call, after=0.5):
        """Ctrl-C, as it comes from the terminal."""
        timer = threading.Timer(after, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        begin = time.monotonic()
        try:
            return call()
        finally:
            timer.join()
            self.assertLess(time.monotonic() - begin, 60)

    def test_it_raises(self):
        with self.assertRaises(KeyboardInterrupt):
            self.press(lambda: wrapatlas.pack(UV, FACES, time=100))

    def test_or_the_best_is_kept(self):
        packing = self.press(lambda: wrapatlas.pack(UV, FACES, time=100, on_interrupt="best"))
        self.assertTrue(packing.interrupted)
        self.assertTrue(packing.report.ok)

    def test_while_charts_are_cut(self):
        mesh = wrapatlas.Mesh(*shapes.sphere(60_000))
        with self.assertRaises(KeyboardInterrupt):
            self.press(lambda: wrapatlas.unwrap(mesh, time=100, max_stretch=1.01,
                                                on_interrupt="best"))

    def test_bake(self):
        mesh = wrapatlas.unwrap(*shapes.sphere(), time=0)
        with self.assertRaises(KeyboardInterrupt):
            self.press(lambda: wrapatlas.bake(mesh, mesh, "occlusion", resolution=4096,
                                              samples=4))


class Threads(unittest.TestCase):
    def test_others_run_meanwhile(self):
        counted, stop = [0], threading.Event()

        def count():
            while not stop.is_set():
                counted[0] += 1
                time.sleep(0.001)

        counter = threading.Thread(target=count)
        counter.start()
        wrapatlas.pack(UV, FACES, time=1)
        stop.set()
        counter.join()
        self.assertGreater(counted[0], 100)

    def test_several_calls_at_once(self):
        wanted = wrapatlas.pack(UV, FACES, moves=300).uv
        found = [None] * 6

        def call(i):
            found[i] = wrapatlas.pack(UV, FACES, moves=300).uv

        threads = [threading.Thread(target=call, args=(i,)) for i in range(len(found))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for uv in found:
            np.testing.assert_array_equal(uv, wanted)


LEAKS = """
    import gc, sys
    import numpy as np
    import shapes, wrapatlas

    def megabytes():
        gc.collect()
        for line in open("/proc/self/status"):
            if line.startswith("VmRSS:"):
                return int(line.split()[1]) / 1024

    positions, faces = shapes.sphere(150)
    uv, uv_faces = shapes.scattered_squares()
    image = shapes.checker()

    def once(i):
        packing = wrapatlas.unwrap(positions, faces, method="modulo", resolution=64, grid=32, rotations=1)
        wrapatlas.check(packing, resolution=64, wrap="uv")
        packing.image(64)._repr_png_()
        packing.positions.sum()
        wrapatlas.transfer(image, packing, packing, resolution=16)
        wrapatlas.render(packing, image, size=16)
        if i % 10 == 0:
            wrapatlas.bake(packing, packing, resolution=16)
        try:
            wrapatlas.pack(uv, uv_faces + 1, time=0)
        except ValueError:
            pass

    marks = []
    for i in range(1001):
        once(i)
        if i % 100 == 0:
            marks.append(megabytes())
    print(*[f"{m:.1f}" for m in marks])
    grown = max(marks[6:]) - max(marks[2:5])
    sys.exit(0 if grown < 3 else f"grew by {grown:.1f} MiB")
"""


class Memory(unittest.TestCase):
    def test_a_thousand_calls(self):
        run = subprocess.run([sys.executable, "-c", textwrap.dedent(LEAKS)], text=True,
                             capture_output=True, cwd=os.path.dirname(__file__))
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)


if __name__ == "__main__":
    unittest.main()
