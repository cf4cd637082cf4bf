"""Ctrl-C: the best packing so far is written, or nothing at all."""

import json
import os
import pty
import signal
import subprocess
import threading
import time
import unittest

import support
from support import COMMAND

SEARCH = ("--method", "modulo", "--resolution", "1024", "--padding", "2", "--aspect", "search", "--grid", "1024")


class Interrupt(support.CommandTest):
    def interrupt(self, arguments, seen, signals=1):
        """Sends SIGINT once the progress shown on a terminal contains `seen`."""
        terminal, end = pty.openpty()
        process = subprocess.Popen([COMMAND, *arguments], cwd=self.folder, stderr=end,
                                   stdout=subprocess.PIPE, text=True)
        os.close(end)
        timer = threading.Timer(300, process.kill)
        timer.start()
        text = ""
        try:
            while True:
                try:
                    text += os.read(terminal, 1000).decode()
                except OSError:  # the other end is closed
                    break
                if signals and seen in text:
                    process.send_signal(signal.SIGINT)
                    asked = time.monotonic()
                    signals -= 1
            output = process.communicate()[0]
        finally:
            timer.cancel()
            os.close(terminal)
        self.assertEqual(signals, 0, f"'{seen}' was never shown: {text[-1000:]}")
        self.assertLess(time.monotonic() - asked, 100)
        return process.returncode, output, text.split("\033[K")[-1]

    def test_after_a_packing_was_found(self):
        self.sample("machine.obj")
        self.write("b.obj", "older\n")
        status, output, message = self.interrupt(
            ("pack", "machine.obj", "-o", "b.obj", *SEARCH, "--json", "b.json"), "best so far")
        self.assertEqual((status, output), (130, ""))
        self.assertIn("machine.obj: 83 charts", message)
        self.assertEqual(set(self.contents()), {"machine.obj", "b.obj", "b.json"})
        width, height = self.size_in("b.json")
        self.assertTrue(self.check("b.obj", "machine.obj", "--wrap", "uv",
                                   resolution=f"{width}x{height}")["ok"])

    def size_in(self, name):
        report = json.loads(self.path(name).read_text())
        self.assertTrue(report["interrupted"] and report["valid"])
        return report["width"], report["height"]

    def test_before_a_packing_was_found(self):
        self.sample("mosaic.ply")
        self.write("b.ply", "older\n")
        before = self.contents()
        status, output, message = self.interrupt(
            ("pack", "mosaic.ply", "-o", "b.ply", *SEARCH, "--json", "b.json", "--image", "b.png"),
            "packing   0 %")
        self.assertEqual((status, output), (130, ""))
        self.assertRegex(message, r"\Awrapatlas: error: [^\n]+\n\Z")
        self.assertEqual(self.contents(), before)


if __name__ == "__main__":
    unittest.main()
