"""One asset: what a worker does."""

from __future__ import annotations

import errno
import hashlib
import json
import os
import shutil
import socket
import time
from dataclasses import asdict, dataclass, field
from typing import Any, Dict, List, Optional, Tuple

from . import command, output
from .errors import BatchError
from .files import Input, complete, join, mark
from .manifest import Asset
from .process import Ended, run_limited
from .recipe import Recipe, command_lines, given_value

STATUS = {1: "a check failed", 2: "usage", 3: "unusable input or output", 4: "no packing found",
          130: "interrupted"}
KEPT_OF_LOG = 4000  # characters of a failure's log that the table of states keeps
MEASURES = ("efficiency", "charts", "faces", "width", "height", "pages")


@dataclass
class Order:
    """All that a worker is told about an asset; small, it goes over the network."""

    asset: Asset
    out: str
    base: str
    recipe: Recipe
    identity: str
    time_limit: Optional[float] = None
    memory_mb: Optional[int] = None
    retries: int = 1

    def key(self) -> str:
        """Differs whenever the result may for another reason than a changed file."""
        fields = {name: self.asset.fields.get(name) for name in self.recipe.columns()}
        told = [self.identity, asdict(self.recipe), self.asset.input, self.asset.name, fields]
        return hashlib.sha256(json.dumps(told).encode()).hexdigest()


@dataclass
class Outcome:
    """`state` is done, or failed for the `reason`; `marks` those of the files that were read;
    `seconds` of all its commands, `status` the last one's, None if none ended."""

    name: str
    state: str
    reason: str = ""
    key: str = ""
    kept: bool = False
    status: Optional[int] = None
    attempts: int = 1
    seconds: float = 0.0
    peak_mb: float = 0.0
    worker: str = ""
    finished: float = 0.0
    marks: Dict[str, Optional[str]] = field(default_factory=dict)
    files: List[str] = field(default_factory=list)
    measures: Dict[str, float] = field(default_factory=dict)
    log: str = ""


def unchanged(marks: Dict[str, Optional[str]]) -> bool:
    """Are files as they were? Of an asset that had none, nobody knows."""
    try:
        return bool(marks) and all(mark(url) == was for url, was in marks.items())
    except OSError:
        return False


def work(order: Order) -> Outcome:
    """Does an asset, or finds it done. Never raises an Exception: what fails is an outcome."""
    key = order.key()
    record = output.read_record(order.out, order.asset.name)
    if record and record.get("key") == key and unchanged(record.get("marks", {})):
        try:
            return Outcome(**{**record, "kept": True})
        except TypeError:
            pass  # a record of another version of this package
    outcome = Outcome(order.asset.name, "failed", key=key)
    for attempt in range(1, order.retries + 2):
        again = False
        outcome = Outcome(order.asset.name, "failed", key=key, attempts=attempt,
                          worker=f"{socket.gethostname()}:{os.getpid()}")
        try:
            again = try_once(order, outcome)
        except FileNotFoundError as error:
            outcome.reason = f"no such file: {error.filename or error}"
        except (BatchError, KeyError) as error:
            outcome.reason = f"no column {error}" if isinstance(error, KeyError) else str(error)
        except OSError as error:
            outcome.reason = f"{error.strerror or error}: {error.filename or order.out}"
            again = error.errno not in (errno.EACCES, errno.EPERM, errno.EROFS)
        except Exception as error:  # of a remote file system's library, of any kind
            outcome.reason = f"{type(error).__name__}: {error}"
            again = True
        outcome.finished = time.time()
        if not again:
            break
        if attempt <= order.retries:
            time.sleep(min(30.0, 0.5 * 2 ** (attempt - 1)))  # what was busy may be free by then
    return outcome


def try_once(order: Order, outcome: Outcome) -> bool:
    """Fills `outcome`; says whether another attempt may end otherwise."""
    program = command.find()
    if command.identity(program) != order.identity:
        raise BatchError(f"{program} on {socket.gethostname()} is {command.identity(program)}, "
                         f"the batch was started with {order.identity}")
    scratch = output.temporary_folder(order.out)
    try:
        folder = os.path.join(scratch, "results")
        os.mkdir(folder)
        inputs, values = fetch(order, scratch)
        for one in inputs:
            outcome.marks.update(one.marks)
        ended = run_steps(order, program, values, folder, outcome)
        with open(os.path.join(scratch, output.LOG), encoding="utf-8", errors="replace") as file:
            log = file.read()
        if outcome.reason:
            outcome.log = log[-KEPT_OF_LOG:]
            return ended.status < 0 and not ended.stopped
        shutil.move(os.path.join(scratch, output.LOG), os.path.join(folder, output.LOG))
        for name in order.recipe.drop:
            if os.path.exists(os.path.join(folder, name)):
                os.unlink(os.path.join(folder, name))
        complete(folder, inputs)
        outcome.state = "done"
        outcome.files = output.files_in(folder)
        outcome.finished = time.time()
        output.publish(folder, order.out, order.asset.name, asdict(outcome))
        return False
    except BaseException:
        outcome.state = "failed"
        raise
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


def fetch(order: Order, scratch: str) -> Tuple[List[Input], Dict[str, str]]:
    asset = order.asset
    values = {**asset.fields, "name": asset.name}
    inputs = [Input(asset.input, os.path.join(scratch, "input"))]
    values["input"] = inputs[0].path
    for column in order.recipe.files:
        if not asset.fields.get(column):
            raise KeyError(column)
        url = join(order.base, asset.fields[column])
        inputs.append(Input(url, os.path.join(scratch, column)))
        values[column] = inputs[-1].path
    return inputs, values


def run_steps(order: Order, program: str, values: Dict[str, str], folder: str, outcome: Outcome) -> Ended:
    """Runs the steps until one fails, all within the limit of time."""
    ended = Ended(0, 0.0, 0.0)
    with open(os.path.join(os.path.dirname(folder), output.LOG), "ab") as log:
        for line in command_lines(order.recipe, values):
            left = None if order.time_limit is None else order.time_limit - outcome.seconds
            begin = log.tell()
            ended = run_limited([program, *line], folder, log, left, order.memory_mb)
            log.seek(0, os.SEEK_END)  # the command wrote by a descriptor of its own
            outcome.seconds += ended.seconds
            outcome.peak_mb = max(outcome.peak_mb, ended.peak_mb)
            outcome.status = ended.status
            if ended.stopped or ended.status not in order.recipe.accept:
                outcome.reason = why(order, ended, line[0], log.name, begin)
                break
            read_measures(folder, line, outcome.measures)
    return ended


def why(order: Order, ended: Ended, step: str, log: str, begin: int) -> str:
    """One line about a step that failed."""
    if ended.stopped == "time":
        return f"{step}: over the limit of {order.time_limit:g} s"
    if ended.stopped == "memory":
        return f"{step}: over the limit of {order.memory_mb} MB"
    if ended.stopped:
        return f"{step}: the batch ended before it did"
    if ended.status < 0:
        return f"{step}: killed by signal {-ended.status}"
    with open(log, "rb") as file:
        file.seek(begin)
        lines = file.read().decode("utf-8", "replace").strip().splitlines()
    errors = [line for line in lines if line.startswith("wrapatlas: error: ")]
    last = errors[-1][len("wrapatlas: error: "):] if errors else " ".join(lines[-1:])
    meaning = STATUS.get(ended.status, f"exit status {ended.status}")
    return f"{step}: {last or meaning}"[:500]


def read_measures(folder: str, line: List[str], measures: Dict[str, float]) -> None:
    """From a step's report what the table shows."""
    name = given_value(line, "--json")
    if not name:
        return
    report: Any = None
    try:
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            report = json.load(file)
    except (OSError, ValueError):
        return
    for name in MEASURES:
        if isinstance(report, dict) and isinstance(report.get(name), (int, float)):
            measures[name] = report[name]
