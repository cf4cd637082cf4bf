"""A line on stderr that says how far a batch is."""

from __future__ import annotations

import sys
import time


class Progress:
    """`settled`: how many of all need not be tried, as their lines in the manifest are no good."""

    def __init__(self, total: int, shown: bool, settled: int = 0) -> None:
        self._total, self._shown = total, shown
        self._begin = self._said = time.monotonic()
        self._pause = 0.5 if sys.stderr.isatty() else 15.0
        self.done = self.kept = self.failed = 0
        self.settled = settled

    def add(self, state: str, kept: bool) -> None:
        self.kept += state == "done" and kept
        self.settled += 1
        self.done += state == "done" and not kept
        self.failed += state == "failed" and not kept
        if time.monotonic() - self._said > self._pause:
            self.say()

    def say(self, last: bool = False) -> None:
        self._said = time.monotonic()
        if not self._shown:
            return
        worked = self.done + self.failed
        rate = worked / max(self._said - self._begin, 1e-9)
        left = self._total - self.settled
        line = (f"{self.settled}/{self._total}: {self.done} done, {self.failed} failed, "
                f"{self.kept} as they were, {rate:.1f}/s")
        if left and rate:
            line += f", {in_words(left / rate)} left"
        tty = sys.stderr.isatty()
        print(f"\r\033[K{line}" if tty else line, end="\n" if last or not tty else "", file=sys.stderr, flush=True)


def in_words(seconds: float) -> str:
    for size, unit in ((86400, "d"), (3600, "h"), (60, "min")):
        if seconds >= 2 * size:
            return f"{seconds / size:.0f} {unit}"
    return f"{seconds:.0f} s"
