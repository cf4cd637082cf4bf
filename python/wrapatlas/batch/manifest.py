"""Which assets: rows of a CSV or JSONL file, or the models in a folder."""

from __future__ import annotations

import csv
import json
import os
import re
from dataclasses import dataclass, field
from typing import Dict, Iterator, Tuple

from .errors import UsageError
from .files import file_system, fsspec, is_local, join, local_path, parent, told

MODELS = (".obj", ".ply", ".off", ".stl", ".gltf", ".glb")
UNUSABLE = re.compile(r"[\x00-\x1f\\]")


@dataclass
class Asset:
    """`name` is that of its folder of results; `line` where it stands in the manifest, from 1;
    `error` why it cannot be tried at all."""

    line: int
    name: str
    input: str
    fields: Dict[str, str] = field(default_factory=dict)
    error: str = ""


def read(where: str, results: str = "") -> Iterator[Asset]:
    """The assets of a manifest, one by one: there may be more than memory holds. A folder's own
    `results`, a folder in it, are none of them.

    Raises UsageError for a file that is no manifest."""
    ending = os.path.splitext(where)[1].lower()
    if ending == ".csv":
        return rows(where, csv_rows(where))
    if ending in (".jsonl", ".ndjson"):
        return rows(where, jsonl_rows(where))
    return models(where, results)


def models(folder: str, results: str) -> Iterator[Asset]:
    """Those in a folder and below, but for hidden ones and what is in `results`."""
    line = 0
    if is_local(folder):
        top = local_path(folder)
        if not os.path.isdir(top):
            raise UsageError(f"{folder}: neither a folder, nor a .csv or .jsonl file")
        apart = os.path.realpath(local_path(results)) if results and is_local(results) else ""
        for root, folders, names in os.walk(top):
            folders[:] = sorted(name for name in folders if not name.startswith(".")
                                and os.path.realpath(os.path.join(root, name)) != apart)
            for name in sorted(names):
                if name.lower().endswith(MODELS) and not name.startswith("."):
                    line += 1
                    path = os.path.join(root, name)
                    yield asset(line, os.path.relpath(path, top), path, {})
        return
    system, top = file_system(folder)
    other, beyond = (None, "") if not results or is_local(results) else file_system(results)
    with told(folder):
        for path in system.find(top):
            name = str(path)[len(top):].lstrip("/")
            is_result = system is other and str(path).startswith(beyond.rstrip("/") + "/")
            is_hidden = any(part.startswith(".") for part in name.split("/"))
            if name.lower().endswith(MODELS) and not is_result and not is_hidden:
                line += 1
                yield asset(line, name, join(folder, name), {})


def csv_rows(where: str) -> Iterator[Tuple[int, Dict[str, str], str]]:
    with fsspec.open(where, "rt", encoding="utf-8-sig", newline="") as file:
        table = csv.DictReader(file)
        if "input" not in (table.fieldnames or []):
            raise UsageError(f"{where}: its first line has no column `input`")
        for row in table:
            excess = "more fields than columns" if None in row else ""
            given = {key: value or "" for key, value in row.items() if isinstance(key, str)}
            yield table.line_num, given, excess


def jsonl_rows(where: str) -> Iterator[Tuple[int, Dict[str, str], str]]:
    with fsspec.open(where, "rt", encoding="utf-8-sig") as file:
        for line, text in enumerate(file, 1):
            if not text.strip():
                continue
            try:
                row = json.loads(text)
                if not isinstance(row, dict):
                    raise ValueError("not an object")
                yield line, {key: str(value) for key, value in row.items()}, ""
            except ValueError as error:
                yield line, {}, f"no JSON object ({error})"


def rows(where: str, found: Iterator[Tuple[int, Dict[str, str], str]]) -> Iterator[Asset]:
    folder = parent(where)
    with told(where):
        for line, row, error in found:
            given = row.pop("input", "")
            name = row.pop("name", "") or default_name(given)
            if not error and not given:
                error = "no `input`"
            one = asset(line, name, join(folder, given), row)
            one.error = error or one.error
            yield one


def default_name(path: str) -> str:
    """The path, if it leads down from the manifest; else the file's name."""
    down = "://" not in path and not os.path.isabs(path) and ".." not in path.split("/")
    return os.path.normpath(path) if down and path else path.rsplit("/", 1)[-1]


def asset(line: int, name: str, path: str, fields: Dict[str, str]) -> Asset:
    one = Asset(line, name, path, fields)
    parts = name.split("/")
    try:
        (name + path).encode("utf-8")
    except UnicodeEncodeError:
        one.name = name.encode("utf-8", "replace").decode()
        one.input = path.encode("utf-8", "replace").decode()
        one.error = "a name that is not UTF-8"
        return one
    if not name:
        one.name, one.error = f"(line {line})", "no name"
    elif UNUSABLE.search(name) or any(part.startswith(".") or not part for part in parts):
        one.error = "the name cannot be that of a folder"
    elif any(len(os.fsencode(part)) > 200 for part in parts):
        one.error = "the name is too long for a folder"
    return one
