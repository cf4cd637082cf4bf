"""python -m wrapatlas.batch MANIFEST -o OUT [--recipe ...] [-- options of the command]"""

from __future__ import annotations

import argparse
import sys
from typing import List, Optional

from .engine import run
from .errors import BatchError
from .options import add_cluster_options, split_words

EPILOG = """exit status: 0 all are done, 1 some failed, 2 usage, 3 no batch was possible, 130 interrupted.
example: python -m wrapatlas.batch meshes/ -o out --recipe unwrap --time-limit 60 -- --resolution 2048"""


def main(given: Optional[List[str]] = None) -> int:
    words, options = split_words(given)
    parser = argparse.ArgumentParser(
        prog="python -m wrapatlas.batch", description="Does every asset of a manifest by a recipe, on Dask.",
        epilog=EPILOG, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("manifest", help=".csv or .jsonl file with a column `input`, or a folder of models; path or URL")
    add("-o", "--output", required=True, help="folder of the results, path or URL")
    add("--recipe", default="unwrap", help="unwrap, pack, transfer, bake, or a .json or .toml file (unwrap)")
    add_cluster_options(parser)
    add("--retries", type=int, default=1, metavar="K", help="further attempts after a crash or an error of storage (1)")
    add("--keep-failed", action="store_true", help="leave what failed before, unless something changed")
    add("--state", metavar="DIR", help="folder of table, page and state (the output, if that is local)")
    add("--quiet", action="store_true", help="no progress, no summary")
    told = parser.parse_args(words)
    try:
        summary = run(told.manifest, told.output, told.recipe, options, workers=told.workers,
                      scheduler=told.scheduler, time_limit=told.time_limit, memory_limit=told.memory_limit,
                      retries=told.retries, keep_failed=told.keep_failed, state=told.state, progress=not told.quiet)
    except BatchError as error:
        print(f"wrapatlas.batch: error: {error}", file=sys.stderr)
        return error.status
    if not told.quiet:
        for name, reason in summary.failures:
            print(f"{name}: failed: {reason}", file=sys.stderr)
        if summary.failed > len(summary.failures):
            print(f"... and {summary.failed - len(summary.failures)} more, in {summary.table}", file=sys.stderr)
        print(f"{summary.done} done ({summary.kept} of them before), {summary.failed} failed, {summary.not_reached} "
              f"not reached, {summary.seconds:.1f} s -> {summary.page}", file=sys.stderr)
    return 130 if summary.interrupted else 1 if summary.failed else 0


if __name__ == "__main__":
    sys.exit(main())
