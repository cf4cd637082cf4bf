"""What a worker of the batch's own cluster does first; Dask imports it (`preload`)."""

import signal
from typing import Any


def dask_setup(worker: Any) -> None:
    """A terminal's Ctrl-C goes to all processes: the batch ends its workers itself, in order."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
