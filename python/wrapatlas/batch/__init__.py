"""Many assets through `wrapatlas`, on Dask: see `run`, and `python -m wrapatlas.batch --help`."""

from .engine import Summary, run
from .errors import BatchError, UsageError

__all__ = ["BatchError", "Summary", "UsageError", "run"]
