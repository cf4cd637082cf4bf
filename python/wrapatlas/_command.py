"""The command `wrapatlas`, which is installed inside the package."""

from __future__ import annotations

import os
import sys
from pathlib import Path

__all__ = ["command"]


def command() -> str:
    """The path of the `wrapatlas` executable that came with this package.

    For subprocess: ``subprocess.run([wrapatlas.command(), "info", "model.glb"])``.
    """
    return str(Path(__file__).parent / "bin" / "wrapatlas")


def main() -> None:
    """Becomes the command: what the script `wrapatlas` of this package does."""
    path = command()
    try:
        os.execv(path, ["wrapatlas", *sys.argv[1:]])
    except OSError as error:
        sys.exit(f"wrapatlas: error: {path}: {error.strerror}; install the package again")
