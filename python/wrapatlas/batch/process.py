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
    that was passed, `time` or `memory`, or `folder`: it is gone."""

    status: int
    seconds: float
    peak_mb: float
    stopped: str = ""


def peak_resident_mb(pid: int) -> float:
    """The largest resident set of a process so far in MiB; 0 where the system does not say. Not that
    of getrusage, which also counts what the process was before it became the command."""
    try:
        with open(f"/proc/{pid}/status", encoding="ascii", errors="replace") as file:
            for line in file:
                if line.startswith("VmHWM:"):
                    return int(line.split()[1]) / 2**10
    except (OSError, IndexError, ValueError):
        pass
    return 0.0


def run_limited(command: Sequence[str], folder: str, log: IO[bytes], seconds: Optional[float],
                memory_mb: Optional[int]) -> Ended:
    """Runs `command` in `folder`, its output appended to `log`, for at most so long and so large, and
    while there is the folder: that is taken away from those whom the batch does not wait for."""
    begin = time.monotonic()
    launch = [sys.executable, "-I", "-S", LAUNCH, str(os.getpid()), str(memory_mb or 0)]
    process = subprocess.Popen([*launch, *command], cwd=folder, stdin=subprocess.DEVNULL, stdout=log,
                               stderr=subprocess.STDOUT, start_new_session=True)
    stopped = ""
    peak = 0.0
    pause = 0.005
    try:
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            now = time.monotonic() - begin
            if seconds is not None and now > seconds:
                stopped = stopped or "time"
            peak = peak_resident_mb(process.pid) or peak  # 0 when it has just ended
            if memory_mb is not None and peak > memory_mb:
                stopped = stopped or "memory"
            if not os.path.isdir(folder):
                stopped = stopped or "folder"
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
    if sys.platform == "darwin":
        peak = usage.ru_maxrss / 2**20
    return Ended(code, time.monotonic() - begin, peak, stopped)
