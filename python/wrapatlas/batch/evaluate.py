"""The evaluation of the paper as a batch: each mesh by each method is a task of its own.

    python -m wrapatlas.batch.evaluate MESHES -o OUT [--methods M,...] [options of the batch] -- --paper
    wrapatlas report OUT/joined -o page

A task is `wrapatlas bench MESH --methods M`, whose folder has what that bench writes for one mesh and
one method. Nothing is computed here: the parts are put into one folder as bench itself would have.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import shutil
import sys
from dataclasses import dataclass, field
from typing import Any, Dict, List, Optional, Set, Tuple

from . import manifest
from .engine import Summary, run
from .errors import BatchError, UsageError
from .files import is_local, local_path
from .options import add_cluster_options, split_words

METHODS = "lprm02,swg03,zsgs04,modulo"


@dataclass
class Joined:
    """`missing` names each mesh that is not in the joined results, and why."""

    folder: str
    meshes: int = 0
    missing: List[str] = field(default_factory=list)


def evaluate(meshes: str, out: str, methods: List[str], options: List[str], **batch: Any) -> Tuple[Summary, Joined]:
    """Runs `bench` with `options` on each mesh by each method, `batch` as for `run`; joins the parts.

    Raises UsageError (wrong arguments, `out` not local) and BatchError (what cannot be read or written).
    """
    if not is_local(out):
        raise UsageError(f"{out}: the results of an evaluation are joined in a local folder")
    out = local_path(out)
    try:
        return run_and_join(meshes, out, methods, options, **batch)
    except OSError as error:
        raise BatchError(f"{error.filename or out}: {error.strerror or error}; what is done stays done") from error


def run_and_join(meshes: str, out: str, methods: List[str], options: List[str], **batch: Any) -> Tuple[Summary, Joined]:
    os.makedirs(out, exist_ok=True)
    recipe, tasks = os.path.join(out, "recipe.json"), os.path.join(out, "tasks.jsonl")
    step = ["bench", "{input}", "-o", "bench", "--methods", "{method}", *options]
    with open(recipe, "w", encoding="utf-8") as file:
        json.dump({"steps": [step], "accept": [0, 1]}, file)  # 1: a failed packing, which counts as such
    names = []
    with open(tasks, "w", encoding="utf-8") as file:
        for mesh in manifest.read(meshes):
            names.append(mesh.name)
            for method in methods:
                task = {"name": f"{mesh.name}/{method}", "input": mesh.input, "method": method}
                file.write(json.dumps(task) + "\n")
    summary = run(tasks, out, recipe, **batch)
    return summary, join_parts(out, names, methods)


def join_parts(out: str, names: List[str], methods: List[str]) -> Joined:
    """Puts the results of all tasks into OUT/joined, for `wrapatlas report`. A mesh that lacks a
    method is left out, since the tables compare methods on the same meshes."""
    joined = Joined(os.path.join(out, "joined"))
    new = joined.folder + ".tmp"
    shutil.rmtree(new, ignore_errors=True)
    os.makedirs(os.path.join(new, "meshes"))
    os.makedirs(os.path.join(new, "charts"))
    setting: Optional[Dict[str, Any]] = None
    taken: Set[str] = set()
    with open(os.path.join(new, "runs.csv"), "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        for name in names:
            try:
                parts = [read_part(os.path.join(out, "assets", name, method, "bench")) for method in methods]
                setting = same_setting(setting, parts)
                result = join_mesh(parts)
                if result["mesh"]["id"] in taken:
                    raise ValueError(f"another mesh is {result['mesh']['id']} too: folder and name are the same")
            except (OSError, ValueError, KeyError) as error:
                joined.missing.append(f"{name}: {error}")
                continue
            write_mesh(new, result, parts)
            for number, part in enumerate(parts):
                skipped = 0 if joined.meshes == 0 and number == 0 else 1  # one header for all
                writer.writerows(part["rows"][skipped:])
            taken.add(result["mesh"]["id"])
            joined.meshes += 1
    if setting is None:
        raise BatchError(f"{out}: no mesh has results by all of {', '.join(methods)}")
    with open(os.path.join(new, "settings.json"), "w", encoding="utf-8") as file:
        json.dump(setting, file, indent=1)
    shutil.rmtree(joined.folder, ignore_errors=True)
    os.rename(new, joined.folder)
    return joined


def read_part(folder: str) -> Dict[str, Any]:
    """What bench wrote for one mesh and one method."""
    meshes = sorted(os.listdir(os.path.join(folder, "meshes")))
    if len(meshes) != 1:
        raise ValueError(f"{folder} has {len(meshes)} meshes, not one")
    with open(os.path.join(folder, "settings.json"), encoding="utf-8") as file:
        setting = json.load(file)
    with open(os.path.join(folder, "meshes", meshes[0]), encoding="utf-8") as file:
        result = json.load(file)
    with open(os.path.join(folder, "runs.csv"), encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    return {"folder": folder, "setting": setting, "result": result, "rows": rows}


def same_setting(setting: Optional[Dict[str, Any]], parts: List[Dict[str, Any]]) -> Dict[str, Any]:
    """The setting of the parts, with the contenders of all; it must be that of the meshes before."""
    here = dict(parts[0]["setting"])
    for part in parts:
        if {**part["setting"], "contenders": 0} != {**here, "contenders": 0}:
            raise ValueError(f"{part['folder']} was made in another setting")
    here["contenders"] = [one for part in parts for one in part["setting"]["contenders"]]
    if setting is not None and here != setting:
        raise ValueError("made in another setting than the meshes before")
    return here


def join_mesh(parts: List[Dict[str, Any]]) -> Dict[str, Any]:
    """One mesh by all methods: each must have seen the same charts."""
    def facts(part: Dict[str, Any]) -> Dict[str, Any]:
        return {**part["result"]["mesh"], "unwrap_seconds": 0}

    for part in parts:
        if facts(part) != facts(parts[0]):
            raise ValueError(f"{part['folder']} has other charts")
    joined = dict(parts[0]["result"])
    joined["error"] = next((p["result"]["error"] for p in parts if p["result"].get("error")), "")
    joined["runs"] = [one for part in parts for one in part["result"]["runs"]]
    return joined


def write_mesh(folder: str, result: Dict[str, Any], parts: List[Dict[str, Any]]) -> None:
    path = os.path.join(folder, "meshes", result["mesh"]["id"] + ".json")
    with open(path, "w", encoding="utf-8") as file:
        json.dump(result, file)
    shutil.copytree(os.path.join(parts[0]["folder"], "charts"), os.path.join(folder, "charts"), dirs_exist_ok=True)


def main(given: Optional[List[str]] = None) -> int:
    words, options = split_words(given)
    parser = argparse.ArgumentParser(prog="python -m wrapatlas.batch.evaluate",
                                     description="wrapatlas bench as a batch, a task for each mesh and method.")
    add = parser.add_argument
    add("meshes", help="folder of models, or a manifest")
    add("-o", "--output", required=True, help="folder of the results; OUT/joined is for wrapatlas report")
    add("--methods", default=METHODS, help=f"as of bench ({METHODS})")
    add_cluster_options(parser)
    told = parser.parse_args(words)
    try:
        summary, joined = evaluate(told.meshes, told.output, told.methods.split(","), options, workers=told.workers,
                                   scheduler=told.scheduler, time_limit=told.time_limit,
                                   memory_limit=told.memory_limit, progress=True)
    except BatchError as error:
        print(f"wrapatlas.batch: error: {error}", file=sys.stderr)
        return error.status
    for reason in joined.missing:
        print(f"left out: {reason}", file=sys.stderr)
    print(f"{joined.meshes} meshes in {joined.folder}, {len(joined.missing)} left out, {summary.seconds:.1f} s",
          file=sys.stderr)
    return 130 if summary.interrupted else 1 if joined.missing else 0


if __name__ == "__main__":
    sys.exit(main())
