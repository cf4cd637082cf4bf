"""One command in a process of its own, under a limit of time and of memory."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Optional, Sequence

LAUNCH = str(Path(__file__).with_name("launch.py"))


@dataclass
class Ended:
    """How a command ended: its exit status, or minus the signal's number; `stopped` is the limit
    that was passed, `time` or `memory`."""

    status: int
    seconds: float
    peak_mb: float
    stopped: str = ""


def resident_mb(pid: int) -> float:
    """The resident set of a process in MiB; 0 where the system does not say."""
    try:
        with open(f"/proc/{pid}/statm", encoding="ascii") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20
    except (OSError, IndexError, ValueError):
        return 0.0


def run_limited(command: Sequence[str], folder: str, log: IO[bytes], seconds: Optional[float],
                memory_mb: Optional[int]) -> Ended:
    """Runs `command` in `folder`, its output appended to `log`, for at most so long and so large."""
    begin = time.monotonic()
    launch = [sys.executable, "-I", "-S", LAUNCH, str(os.getpid()), str(memory_mb or 0)]
    process = subprocess.Popen([*launch, *command], cwd=folder, stdin=subprocess.DEVNULL, stdout=log,
                               stderr=subprocess.STDOUT, start_new_session=True)
    stopped = ""
    pause = 0.005
    try:
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            now = time.monotonic() - begin
            if seconds is not None and now > seconds:
                stopped = stopped or "time"
            if memory_mb is not None and resident_mb(process.pid) > memory_mb:
                stopped = stopped or "memory"
            if stopped:
                os.killpg(process.pid, signal.SIGKILL)
            time.sleep(pause)
            pause = min(0.03, pause * 1.5)
    except BaseException:
        process.kill()
        process.wait()
        raise
    code = os.WEXITSTATUS(status) if os.WIFEXITED(status) else -os.WTERMSIG(status)
    process.returncode = code  # we waited for it ourselves, for its memory
    unit = 2**20 if sys.platform == "darwin" else 2**10
    return Ended(code, time.monotonic() - begin, usage.ru_maxrss / unit, stopped)
