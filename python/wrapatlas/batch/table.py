"""The table of results: results.csv, and results.parquet where pyarrow is."""

from __future__ import annotations

import csv
import importlib
import itertools
import os
from typing import Any, Dict, Iterator, List

from .store import COLUMNS, Store

INTEGERS = ("line", "status", "attempts", "charts", "faces", "width", "height", "pages")
NUMBERS = ("seconds", "peak_mb", "efficiency", "finished")
ROWS_AT_ONCE = 20_000


def write_tables(store: Store, folder: str) -> List[str]:
    """Writes them, each at once; the paths."""
    paths = [os.path.join(folder, "results.csv")]
    with open(paths[0] + ".tmp", "w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, COLUMNS, extrasaction="ignore", lineterminator="\n")
        table.writeheader()
        for row in store.rows():
            table.writerow({name: rounded(value) for name, value in row.items()})
    os.replace(paths[0] + ".tmp", paths[0])
    try:
        arrow: Any = importlib.import_module("pyarrow")
        parquet: Any = importlib.import_module("pyarrow.parquet")
    except ImportError:
        return paths
    paths.append(os.path.join(folder, "results.parquet"))
    write_parquet(arrow, parquet, store.rows(), paths[1] + ".tmp")
    os.replace(paths[1] + ".tmp", paths[1])
    return paths


def rounded(value: Any) -> Any:
    return f"{value:.6g}" if isinstance(value, float) and value < 1e9 else value


def write_parquet(arrow: Any, parquet: Any, rows: Iterator[Dict[str, Any]], path: str) -> None:
    def kind(name: str) -> Any:
        return arrow.int64() if name in INTEGERS else arrow.float64() if name in NUMBERS else arrow.string()

    schema = arrow.schema([(name, kind(name)) for name in COLUMNS])
    with parquet.ParquetWriter(path, schema) as writer:
        while True:
            some = list(itertools.islice(rows, ROWS_AT_ONCE))
            if not some:
                return
            named = [{name: row.get(name) for name in COLUMNS} for row in some]
            writer.write_table(arrow.Table.from_pylist(named, schema))
