"""Becomes another program, with limits: launch.py PARENT MEMORY_MB COMMAND...

A program of its own, because code between fork and exec (`preexec_fn`) may hang where there are
threads, and Dask's workers have some. It imports nothing of the package, to start quickly.
"""

import ctypes
import os
import resource
import signal
import sys


def main() -> None:
    parent, memory_mb, command = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3:]
    if sys.platform == "linux":
        # A worker that is killed takes its command with it; else it would go on beside its successor.
        set_death_signal = 1
        ctypes.CDLL(None).prctl(set_death_signal, signal.SIGKILL)
        if os.getppid() != parent:
            sys.exit("the worker ended before its command began")
    if memory_mb:
        # The watch over the resident set looks every few hundredths of a second; this is what
        # holds in between. Some more, so that it is the watch that says why.
        most = (memory_mb + 512) << 20
        resource.setrlimit(resource.RLIMIT_DATA, (most, most))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    os.execv(command[0], command)


if __name__ == "__main__":
    main()
