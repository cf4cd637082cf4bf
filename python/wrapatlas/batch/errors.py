"""What stops a whole batch. What is wrong with one asset is a row of the table, never an exception."""

from __future__ import annotations


class BatchError(Exception):
    """A batch that cannot start or go on; `status` is the exit status of the command line."""

    def __init__(self, message: str, status: int = 3) -> None:
        super().__init__(message)
        self.status = status


class UsageError(BatchError):
    """Options, a recipe or a manifest that make no sense."""

    def __init__(self, message: str) -> None:
        super().__init__(message, 2)
