"""What goes wrong, as exceptions: all are Error, and ValueError or OSError where one expects that."""

from __future__ import annotations

import re

__all__ = ["CheckFailed", "Error", "FileError", "InputError", "NoPacking", "UsageError"]


class Error(Exception):
    """One line that says where it is, what is wrong, and the way out."""


class UsageError(Error, ValueError):
    """Options that contradict each other or are out of range, or arrays of another shape or type."""


class InputError(Error, ValueError):
    """An array or a file that cannot be used."""


class FileError(Error, OSError):
    """A file that cannot be written."""


class NoPacking(Error):
    """Nothing fits at any scale tried."""


class CheckFailed(Error):
    """A finished atlas breaks a promise: a bug of ours."""


_KINDS: dict[str, type[Error]] = {
    "usage": UsageError,
    "input": InputError,
    "output": FileError,
    "no_packing": NoPacking,
    "check": CheckFailed,
    "interrupted": Error,
}


def as_python(message: str) -> str:
    """Options as they are written here: padding= for the command's --padding."""

    def option(found: re.Match[str]) -> str:
        name = found[1].replace("-", "_")
        return {"lambda": "lambda_"}.get(name, name) + "="

    return re.sub(r"--([a-z][a-z-]*[a-z])(?: N\b)?", option, message)


def make(kind: str, message: str, where: str = "") -> Error:
    """For the library: the exception of an error. `where`, with which its message begins, is left as
    it is, unless it is an option: file names may look like some."""
    kept = where if message.startswith(where) and not where.startswith("--") else ""
    return _KINDS[kind](kept + as_python(message[len(kept):]))
