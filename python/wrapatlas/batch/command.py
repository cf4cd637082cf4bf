"""The `wrapatlas` executable: where it is, and which it is."""

from __future__ import annotations

import functools
import hashlib
import importlib
import os
import shutil
import subprocess

from .errors import BatchError


def find() -> str:
    """The executable's absolute path: of $WRAPATLAS, else the package's own, else on PATH."""
    named = os.environ.get("WRAPATLAS")
    if named:
        found = shutil.which(named)
        if not found:
            raise BatchError(f"WRAPATLAS={named}: there is no such program")
        return os.path.abspath(found)
    own = str(importlib.import_module("wrapatlas").command())
    if os.access(own, os.X_OK):
        return own
    found = shutil.which("wrapatlas")
    if not found:
        raise BatchError("there is no program wrapatlas: install it, or say where it is in WRAPATLAS")
    return os.path.abspath(found)


def identity(path: str) -> str:
    """Version and content of the executable: two builds of one version may differ in results."""
    try:
        is_now = os.stat(path)
    except OSError as error:
        raise BatchError(f"{path}: cannot be run ({error})") from error
    return _identity(path, is_now.st_mtime_ns, is_now.st_size)


@functools.lru_cache(maxsize=8)
def _identity(path: str, _modified: int, _size: int) -> str:
    try:
        version = subprocess.run([path, "--version"], capture_output=True, text=True, check=True)
        with open(path, "rb") as file:
            content = hashlib.sha256(file.read()).hexdigest()
    except (OSError, subprocess.CalledProcessError) as error:
        raise BatchError(f"{path}: cannot be run ({error})") from error
    return f"{version.stdout.strip()} {content[:12]}"
