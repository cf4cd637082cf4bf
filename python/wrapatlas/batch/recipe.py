"""What is done to each asset: command lines of wrapatlas, in order."""

from __future__ import annotations

import importlib
import json
import os
import re
import shlex
from dataclasses import dataclass, field
from typing import Any, Dict, List, Mapping, Optional, Sequence

from .errors import UsageError

COMMANDS = ("unwrap", "pack", "simplify", "bake", "transfer", "render", "check", "info", "bench")
WITHOUT_THREADS = ("simplify", "info")
WITHOUT_JSON = ("bench",)
WRITABLE = (".obj", ".ply", ".gltf", ".glb")
OWN_NAMES = ("input", "name", "stem", "out")
PLACEHOLDER = re.compile(r"\{(\w+)\}")

PICTURE = " --image atlas.png --image-size 256"
BUILT_IN: Dict[str, Dict[str, Any]] = {
    "unwrap": {"steps": ["unwrap {input} -o {stem}{out}"]},
    "pack": {"steps": ["pack {input} -o {stem}{out}"]},
    "transfer": {"steps": ["transfer {input} -o {stem}{out}"]},
    "bake": {"steps": ["bake {input} {high} -o normal.png"], "files": ["high"]},
}


@dataclass
class Recipe:
    """`steps`  command lines, without the `wrapatlas` before them
    `files`   columns of the manifest that are files of the asset, as its input is
    `drop`    files that later steps need and nobody else
    `accept`  exit statuses that count as success
    """

    steps: List[List[str]]
    files: List[str] = field(default_factory=list)
    drop: List[str] = field(default_factory=list)
    accept: List[int] = field(default_factory=lambda: [0])

    def columns(self) -> List[str]:
        """The columns of the manifest that it uses, beside `input` and `name`."""
        used = [name for step in self.steps for word in step for name in PLACEHOLDER.findall(word)]
        return sorted({*used, *self.files} - set(OWN_NAMES))


def load(name: str, options: Sequence[str] = ()) -> Recipe:
    """A built-in recipe with the command's own `options`, or one from a .json or .toml file.

    Raises UsageError for one that makes no sense."""
    if name in BUILT_IN:
        recipe = from_dict(name, BUILT_IN[name])
        step = recipe.steps[0]
        if name in ("unwrap", "pack") and given_value(options, "--image") is None:
            step += PICTURE.split()
        step += options
        return recipe
    if not name.lower().endswith((".json", ".toml")):
        raise UsageError(f"{name}: no recipe; give {', '.join(BUILT_IN)}, or a .json or .toml file")
    if options:
        raise UsageError(f"{name} has its options in it; leave out those after --")
    try:
        with open(name, "rb") as file:
            content = file.read().decode("utf-8")
        given = json.loads(content) if name.lower().endswith(".json") else toml(content)
    except (OSError, ValueError) as error:
        raise UsageError(f"{name}: cannot be read as a recipe ({error})") from error
    return from_dict(name, given)


def toml(content: str) -> Any:
    for module in ("tomllib", "tomli"):  # of Python 3.11; the same for older ones
        try:
            return importlib.import_module(module).loads(content)
        except ImportError:
            continue
    raise UsageError("a recipe in TOML takes Python 3.11 or the package tomli; or write it as JSON")


def from_dict(where: str, given: Any) -> Recipe:
    if not isinstance(given, Mapping) or not isinstance(given.get("steps"), list) or not given["steps"]:
        raise UsageError(f'{where}: a recipe has "steps", a list of command lines')
    unknown = set(given) - {"steps", "files", "drop", "accept"}
    if unknown:
        raise UsageError(f"{where}: unknown: {', '.join(sorted(unknown))}")
    steps = []
    for line in given["steps"]:
        if not isinstance(line, (str, list)):
            raise UsageError(f"{where}: {line!r} is no command line")
        try:
            words = shlex.split(line) if isinstance(line, str) else [str(word) for word in line]
        except ValueError as error:
            raise UsageError(f"{where}: {line!r}: {error}") from error
        if words[:1] == ["wrapatlas"]:
            words = words[1:]
        if not words or words[0] not in COMMANDS:
            raise UsageError(f"{where}: {line!r} does not begin with one of {', '.join(COMMANDS)}")
        steps.append(words)
    files, drop, accept = given.get("files", []), given.get("drop", []), given.get("accept", [0])
    if not all(isinstance(names, list) and all(isinstance(name, str) for name in names) for names in (files, drop)):
        raise UsageError(f'{where}: "files" and "drop" are lists of names')
    if not isinstance(accept, list) or not all(isinstance(status, int) for status in accept):
        raise UsageError(f'{where}: "accept" is a list of exit statuses, numbers')
    return Recipe(steps, files, drop, accept)


def given_value(line: Sequence[str], option: str) -> Optional[str]:
    """What a command line gives for an option, as `--option value` or `--option=value`; None: nothing."""
    for number, word in enumerate(line):
        if word == option:
            return line[number + 1] if number + 1 < len(line) else ""
        if word.startswith(option + "="):
            return word[len(option) + 1:]
    return None


def command_lines(recipe: Recipe, values: Mapping[str, str]) -> List[List[str]]:
    """The command lines of one asset. They run one beside another, so each has one thread unless it
    says otherwise, and leaves its report as COMMAND.json unless it names another file.

    Raises KeyError for a value that is not there."""
    path = values["input"]
    stem, ending = os.path.splitext(os.path.basename(path))
    own = {**values, "stem": stem, "out": ending if ending.lower() in WRITABLE else ".glb"}
    lines = []
    seen: List[str] = []
    for step in recipe.steps:
        line = [PLACEHOLDER.sub(lambda found: own[found.group(1)], word) for word in step]
        name = line[0]
        seen.append(name)
        if name not in WITHOUT_THREADS and given_value(line, "--threads") is None:
            line += ["--threads", "1"]
        if name not in WITHOUT_JSON and given_value(line, "--json") is None:
            again = f"-{seen.count(name)}" if seen.count(name) > 1 else ""
            line += ["--json", f"{name}{again}.json"]
        lines.append(line)
    return lines
