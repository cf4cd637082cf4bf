"""The folder of results of one asset: it appears whole or not at all."""

from __future__ import annotations

import json
import os
import shutil
import tempfile
from typing import Any, Dict, List, Optional

from .files import file_system, is_local, join, local_path

RECORD = "record.json"  # what was done, with what; on remote storage written last
LOG = "log.txt"


def asset_folder(out: str, name: str) -> str:
    return join(join(out, "assets"), name)


def scratch_folder(home: str) -> str:
    """The folder of what is under way. The batch makes it and takes it away: a worker that still goes on
    then finds no place for more."""
    return os.path.join(home, ".batch", "tmp")


def temporary_folder(out: str) -> str:
    """Where results come about: beside their place if that is local, so that a rename suffices."""
    if not is_local(out):
        return tempfile.mkdtemp(prefix="wrapatlas-batch-")
    return tempfile.mkdtemp(dir=scratch_folder(local_path(out)))


def read_record(out: str, name: str) -> Optional[Dict[str, Any]]:
    """The record of an asset that is done; None if it is not."""
    where = join(asset_folder(out, name), RECORD)
    try:
        if is_local(where):
            with open(local_path(where), encoding="utf-8") as file:
                record = json.load(file)
        else:
            system, path = file_system(where)
            record = json.loads(system.cat_file(path))
        return record if isinstance(record, dict) else None
    except (OSError, ValueError):
        return None


def publish(folder: str, out: str, name: str, record: Dict[str, Any]) -> None:
    """Moves `folder` to its place, in place of what is there."""
    with open(os.path.join(folder, RECORD), "w", encoding="utf-8") as file:
        json.dump(record, file, ensure_ascii=False, indent=1)
    place = asset_folder(out, name)
    if is_local(out):
        move(folder, local_path(place), temporary_folder(out))
    else:
        upload(folder, place)


def move(folder: str, place: str, aside: str) -> None:
    os.makedirs(os.path.dirname(place), exist_ok=True)
    try:
        # Killed between the two, the asset is not done, and done again by the next run.
        if os.path.lexists(place):
            os.rename(place, os.path.join(aside, "old"))
        os.rename(folder, place)
    finally:
        shutil.rmtree(aside, ignore_errors=True)


def upload(folder: str, place: str) -> None:
    system, path = file_system(place)
    if system.exists(path + "/" + RECORD):
        system.rm_file(path + "/" + RECORD)  # from here on it is not done
    kept = set(files_in(folder))
    if system.exists(path):
        for old in system.find(path):
            if str(old)[len(path):].lstrip("/") not in kept:
                system.rm_file(old)
    for name in sorted(kept, key=lambda name: name == RECORD):
        target = f"{path}/{name}"
        system.makedirs(target.rsplit("/", 1)[0], exist_ok=True)
        system.put_file(os.path.join(folder, name), target)


def files_in(folder: str) -> List[str]:
    found = []
    for root, _, names in os.walk(folder):
        found += [os.path.relpath(os.path.join(root, name), folder) for name in names]
    return sorted(name.replace(os.sep, "/") for name in found)
