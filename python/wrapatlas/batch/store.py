"""Which asset is in what state: one SQLite file, so that a million rows need no memory."""

from __future__ import annotations

import fcntl
import json
import os
import sqlite3
from typing import IO, Any, Dict, Iterable, Iterator, List, Optional, Tuple

from .errors import BatchError
from .manifest import Asset
from .task import MEASURES, Outcome

SCHEMA = """
CREATE TABLE IF NOT EXISTS assets (
  name TEXT PRIMARY KEY, number INTEGER, line INTEGER, input TEXT, fields TEXT, present INTEGER,
  state TEXT DEFAULT '', reason TEXT DEFAULT '', key TEXT DEFAULT '', status INTEGER,
  attempts INTEGER, seconds REAL, peak_mb REAL, worker TEXT, finished REAL, marks TEXT,
  files TEXT, measures TEXT DEFAULT '{}', log TEXT DEFAULT '', settled INTEGER DEFAULT 0);
CREATE INDEX IF NOT EXISTS by_number ON assets (present, number);
CREATE INDEX IF NOT EXISTS by_state ON assets (present, state);
"""
STATE = "CASE settled WHEN 1 THEN state ELSE 'not reached' END"
COLUMNS = ("name", "line", "input", "state", "reason", "status", "attempts", "seconds", "peak_mb",
           *MEASURES, "finished", "worker", "files")


class Lock:
    """One batch a folder. Freed by the system when the process ends, however it ends."""

    def __init__(self, path: str) -> None:
        self._file: IO[str] = open(path, "a+", encoding="utf-8")
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            self._file.seek(0)
            holder = self._file.read().strip() or "unknown"
            self._file.close()
            raise BatchError(f"{os.path.dirname(path)}: another batch works here (process {holder}); "
                             "wait for it, or give -o another folder") from error
        self._file.truncate(0)
        self._file.write(f"{os.getpid()}\n")
        self._file.flush()

    def free(self) -> None:
        self._file.close()


class Store:
    """`present` is 1 for assets of the manifest at hand; others stay, for a later one."""

    def __init__(self, path: str) -> None:
        self._base = sqlite3.connect(path)
        self._base.row_factory = sqlite3.Row
        self._base.executescript(SCHEMA)

    def close(self) -> None:
        self._base.commit()
        self._base.close()

    def take_manifest(self, assets: Iterable[Asset]) -> int:
        """Makes the manifest's assets those present; how many. What cannot be tried fails here."""
        run = self._base.execute
        run("UPDATE assets SET present = 0, settled = 0")
        number = 0
        for asset in assets:
            number += 1
            error = asset.error or self._clash(asset)
            if error:
                asset.name += f" (line {asset.line})"  # for the table alone: it gets no folder
            run("INSERT INTO assets (name) VALUES (?) ON CONFLICT DO NOTHING", (asset.name,))
            run("UPDATE assets SET number = ?, line = ?, input = ?, fields = ?, present = 1 WHERE name = ?",
                (number, asset.line, asset.input, json.dumps(asset.fields), asset.name))
            if error:
                self.put(Outcome(asset.name, "failed", error, attempts=0))
        self._base.commit()
        return number

    def _clash(self, asset: Asset) -> str:
        """Why its folder would be another's, or within or around another's."""
        parts = asset.name.split("/")
        for count in range(1, len(parts) + 1):
            line = self._line_of("name = ?", ("/".join(parts[:count]),))
            if line and count == len(parts):
                return f"the name is that of line {line} already"
            if line:
                return f"the name lies within that of line {line}"
        within = self._line_of("name > ? AND name < ?", (asset.name + "/", asset.name + "0"))
        return f"the name of line {within} lies within this" if within else ""

    def _line_of(self, where: str, values: Tuple[str, ...]) -> int:
        row = self._base.execute(f"SELECT line FROM assets WHERE present = 1 AND {where}", values).fetchone()
        return int(row[0]) if row else 0

    def unsettled(self) -> Iterator[sqlite3.Row]:
        """The assets that nothing was decided about in this run, in the manifest's order. The table
        may change meanwhile."""
        last = 0
        while True:
            rows = self._base.execute(
                "SELECT * FROM assets WHERE present = 1 AND settled = 0 AND number > ? "
                "ORDER BY number LIMIT 500", (last,)).fetchall()
            if not rows:
                return
            last = rows[-1]["number"]
            yield from rows

    def settle(self, row: sqlite3.Row) -> None:
        """Leaves an asset in the state that it is in."""
        self._base.execute("UPDATE assets SET settled = 1 WHERE name = ?", (row["name"],))

    def put(self, outcome: Outcome) -> None:
        told = (outcome.state, outcome.reason, outcome.key, outcome.status, outcome.attempts,
                outcome.seconds, outcome.peak_mb, outcome.worker, outcome.finished,
                json.dumps(outcome.marks), json.dumps(outcome.files, ensure_ascii=False),
                json.dumps(outcome.measures), outcome.log, outcome.name)
        self._base.execute(
            "UPDATE assets SET state = ?, reason = ?, key = ?, status = ?, attempts = ?, seconds = ?, "
            "peak_mb = ?, worker = ?, finished = ?, marks = ?, files = ?, measures = ?, log = ?, "
            "settled = 1 WHERE name = ?", told)

    def commit(self) -> None:
        self._base.commit()

    def counts(self) -> Dict[str, int]:
        rows = self._base.execute(f"SELECT {STATE}, COUNT(*) FROM assets WHERE present = 1 GROUP BY 1")
        return {row[0]: row[1] for row in rows}

    def rows(self) -> Iterator[Dict[str, Any]]:
        """The table's rows, failures first."""
        query = ("SELECT * FROM assets WHERE present = 1 ORDER BY "
                 f"CASE {STATE} WHEN 'failed' THEN 0 WHEN 'done' THEN 1 ELSE 2 END, number")
        for row in self._base.execute(query):
            yield table_row(row)

    def select(self, state: str, most: int) -> List[Dict[str, Any]]:
        query = f"SELECT * FROM assets WHERE present = 1 AND {STATE} = ? ORDER BY number LIMIT ?"
        return [table_row(row) for row in self._base.execute(query, (state, most))]


def marks_of(row: sqlite3.Row) -> Dict[str, Optional[str]]:
    marks: Dict[str, Optional[str]] = json.loads(row["marks"] or "{}")
    return marks


def table_row(row: sqlite3.Row) -> Dict[str, Any]:
    given = dict(row)
    if not row["settled"]:  # what it says is of an earlier run, and nobody has looked since
        given = {name: given[name] for name in ("name", "line", "input")}
    given["state"] = row["state"] if row["settled"] else "not reached"
    if row["settled"]:
        given.update(json.loads(row["measures"] or "{}"))
        given["files"] = " | ".join(json.loads(row["files"] or "[]"))
    return {name: given.get(name) for name in (*COLUMNS, "log")}
