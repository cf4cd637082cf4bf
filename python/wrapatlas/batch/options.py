"""What the command lines of the batch and of its evaluation have in common."""

from __future__ import annotations

import argparse
import sys
from typing import List, Optional, Tuple


def split_words(given: Optional[List[str]]) -> Tuple[List[str], List[str]]:
    """Ours, and those after "--", which are the command's; of the program itself if none are given."""
    words = sys.argv[1:] if given is None else given
    if "--" not in words:
        return words, []
    cut = words.index("--")
    return words[:cut], words[cut + 1:]


def add_cluster_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--workers", type=int, help="processes of the local cluster (one a core)")
    add("--scheduler", help="tcp://...: a Dask scheduler, instead of a local cluster")
    add("--time-limit", type=float, metavar="S", help="seconds that a task may take")
    add("--memory-limit", type=int, metavar="MB", help="MiB that a command may hold")
