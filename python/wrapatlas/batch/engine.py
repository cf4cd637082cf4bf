"""`run`: a manifest through a recipe on Dask."""

from __future__ import annotations

import contextlib
import importlib
import json
import os
import shutil
import signal
import sqlite3
import threading
import time
from concurrent.futures import CancelledError
from dataclasses import asdict, dataclass
from typing import Any, Dict, Iterator, List, Optional, Sequence, Tuple

from . import command, manifest
from . import recipe as recipes
from .errors import BatchError, UsageError
from .files import file_system, is_local, join, local_path, parent, told
from .manifest import Asset
from .output import scratch_folder
from .page import write_page
from .progress import Progress
from .store import Lock, Store, marks_of
from .table import write_tables
from .task import Order, Outcome, unchanged, work

WINDOW = 3  # orders given to Dask for each thread of its workers; the rest waits in the manifest
COMMIT_EVERY = 1.0  # seconds
FAILURES_TOLD = 3  # in the summary; all are in the table
USAGE_FAILURES = 10  # if the first so many say so, it is the recipe


@dataclass
class Summary:
    """What came of a batch. `kept`: done by an earlier run, and still as it was (they count as
    `done` too). `failures`: name and reason of the first few that failed."""

    total: int
    done: int
    kept: int
    failed: int
    not_reached: int
    interrupted: bool
    seconds: float
    table: str
    page: str
    failures: List[Tuple[str, str]]


def run(assets: str, out: str, recipe: str = "unwrap", options: Sequence[str] = (), *,
        workers: Optional[int] = None, scheduler: Optional[str] = None, client: Optional[Any] = None,
        time_limit: Optional[float] = None, memory_limit: Optional[int] = None, retries: int = 1,
        keep_failed: bool = False, state: Optional[str] = None, progress: bool = False) -> Summary:
    """Does every asset of a manifest by a recipe, each in a process of its own, and says what came of it.

    assets        a .csv or .jsonl file with a column `input`, or a folder of models; path or URL
    out           folder of the results, path or URL: `assets/NAME/` for each asset that is done
    recipe        `unwrap`, `pack`, `transfer`, `bake`, or a .json or .toml file of steps
    options       further options of the command, for the recipes by name
    workers       processes of the local cluster; by default one a core
    scheduler     the address of a Dask scheduler instead, tcp://...; its workers see `out`, have this
                  package, and the same `wrapatlas`
    client        or a `distributed.Client` that is there; it is left open
    time_limit    seconds that an asset may take, all steps together
    memory_limit  MiB that a command may hold
    retries       further attempts after a crash or an error of storage; what the command itself refuses
                  and what passed a limit is not tried again
    keep_failed   leave what failed in an earlier run, unless something changed
    state         folder of the table, the page and the state; by default `out`, must be given if that is remote
    progress      say on stderr how far it is

    A second run with the same `out` does what is not done: new assets, failed ones, and those whose
    files, fields, recipe or `wrapatlas` changed. Ctrl-C, or SIGTERM, ends it with a table of what is there.

    Raises BatchError where there can be no batch: no command, no manifest, no folder to write to,
    another batch in it. What is wrong with an asset is in the table.
    """
    begin = time.time()
    plan = recipes.load(recipe, options)
    identity = command.identity(command.find())
    folder = state_folder(out, state)
    if retries < 0 or (workers is not None and workers < 1):
        raise UsageError("--retries is 0 or more, --workers 1 or more")
    if any(limit is not None and not limit > 0 for limit in (time_limit, memory_limit)):
        raise UsageError("--time-limit and --memory-limit are more than 0")
    if not is_local(out):
        file_system(out)  # or it raises what is wrong with that
    home = local_path(out) if is_local(out) else folder  # of what is under way, as output.py has it
    held = contextlib.ExitStack()
    try:
        for place in sorted({folder, home}):
            os.makedirs(os.path.join(place, ".batch"), exist_ok=True)
            held.callback(Lock(os.path.join(place, ".batch", "lock")).free)
    except OSError as error:
        held.close()
        raise BatchError(f"{place}: cannot be written to ({error.strerror})") from error
    except BatchError:
        held.close()
        raise
    try:
        shutil.rmtree(scratch_folder(home), ignore_errors=True)  # of a run that was killed
        os.makedirs(scratch_folder(home), exist_ok=True)
        store = Store(os.path.join(folder, ".batch", "state.sqlite"))
        try:
            total = store.take_manifest(manifest.read(assets, join(out, "assets")))
            batch = Batch(store, Progress(total, progress, store.counts().get("failed", 0)), plan, identity, out,
                          parent(assets), time_limit, memory_limit, retries, keep_failed)
            with interruptible() as stop:
                with connected(client, scheduler, workers) as connection:
                    batch.go(connection, stop)
                batch.progress.say(last=True)
                told = [("recipe", recipe_in_words(plan)), ("command", identity), ("manifest", assets),
                        ("begun", time.strftime("%Y-%m-%d %H:%M:%S UTC", time.gmtime(begin))),
                        ("took", f"{time.time() - begin:.1f} s"), ("kept", str(batch.progress.kept)),
                        ("interrupted", "yes" if stop.is_set() else "no")]
                paths = [*write_tables(store, folder), write_page(store, folder, out, told)]
                counts = store.counts()
                failures = [(row["name"], row["reason"]) for row in store.select("failed", FAILURES_TOLD)]
                publish(paths, out)
            return Summary(total, counts.get("done", 0), batch.progress.kept, counts.get("failed", 0),
                           counts.get("not reached", 0), stop.is_set(), time.time() - begin, paths[0], paths[-1], failures)
        finally:
            store.close()
    except sqlite3.Error as error:
        raise BatchError(f"{folder}: its state cannot be written ({error}); what is done stays done") from error
    except OSError as error:
        raise BatchError(f"{error.filename or folder}: {error.strerror or error}; what is done stays done") from error
    finally:
        shutil.rmtree(scratch_folder(home), ignore_errors=True)
        held.close()


def state_folder(out: str, state: Optional[str]) -> str:
    folder = state or out
    if not is_local(folder):
        raise UsageError(f"{folder}: is not local; give --state a folder for the table and the state")
    return local_path(folder)


def recipe_in_words(plan: recipes.Recipe) -> str:
    return json.dumps({name: value for name, value in asdict(plan).items() if value}, ensure_ascii=False)


def publish(paths: List[str], out: str) -> None:
    """Table and page beside results that are elsewhere."""
    if is_local(out):
        return
    system, top = file_system(out)
    with told(out):
        for path in paths:
            system.put_file(path, f"{top}/{os.path.basename(path)}")


@contextlib.contextmanager
def interruptible() -> Iterator[threading.Event]:
    """An event that Ctrl-C and SIGTERM set, instead of ending the program wherever it is. A second
    Ctrl-C does end it."""
    stop = threading.Event()
    if threading.current_thread() is not threading.main_thread():
        yield stop  # signals are the main thread's; who called from elsewhere has his own
        return

    def ask(number: int, frame: Any) -> None:
        if stop.is_set():
            raise KeyboardInterrupt
        stop.set()

    before = {number: signal.signal(number, ask) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield stop
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


@contextlib.contextmanager
def connected(client: Optional[Any], scheduler: Optional[str], workers: Optional[int]) -> Iterator[Any]:
    """A client of Dask: the one given, one of a scheduler, or one of a cluster made for the purpose."""
    if client is not None:
        yield client
        return
    try:
        distributed: Any = importlib.import_module("distributed")
    except ImportError as error:
        raise BatchError("the batch runs on Dask: pip install 'dask[distributed]'") from error
    if scheduler:
        try:
            joined = distributed.Client(scheduler, timeout=20, set_as_default=False)
        except (OSError, ValueError) as error:
            raise BatchError(f"{scheduler}: no scheduler answers ({error})") from error
        with joined:
            yield joined
        return
    # Its own limit of memory is off: it sees the worker, and what is large is the command.
    with distributed.LocalCluster(n_workers=workers or os.cpu_count() or 1, threads_per_worker=1, processes=True,
                                  memory_limit=0, dashboard_address=None, silence_logs=50,
                                  preload="wrapatlas.batch.worker") as cluster:
        with distributed.Client(cluster, set_as_default=False) as joined:
            yield joined


class Batch:
    """The loop between the table of states and Dask."""

    def __init__(self, store: Store, progress: Progress, plan: recipes.Recipe, identity: str, out: str,
                 base: str, time_limit: Optional[float], memory_mb: Optional[int], retries: int,
                 keep_failed: bool) -> None:
        self.store, self.progress = store, progress
        self._told = (out if not is_local(out) else local_path(out), base, plan, identity, time_limit,
                      memory_mb, retries)
        self._keep_failed = keep_failed
        self._usage = 0

    def orders(self) -> Iterator[Order]:
        for row in self.store.unsettled():
            asset = Asset(row["line"], row["name"], row["input"], json.loads(row["fields"] or "{}"))
            order = Order(asset, *self._told)
            if (self._keep_failed and row["state"] == "failed" and row["key"] == order.key()
                    and unchanged(marks_of(row))):
                self.store.settle(row)
                self.progress.add("failed", True)
                continue
            yield order

    def go(self, client: Any, stop: threading.Event) -> None:
        """All orders, a window of them at a time; until `stop` is set."""
        orders = self.orders()
        under_way: Dict[Any, str] = {}
        committed = time.monotonic()
        try:
            more = True
            while not stop.is_set():
                most = WINDOW * max(2, sum(client.nthreads().values()))
                while more and len(under_way) < most:
                    order = next(orders, None)
                    more = order is not None
                    if order is not None:
                        # Not pure: each is work of its own, even if two orders look the same.
                        under_way[client.submit(work, order, pure=False)] = order.asset.name
                if not under_way:
                    return
                finished = self.wait(client, list(under_way))
                for future in finished:
                    outcome = outcome_of(future, under_way[future])
                    if outcome is not None:
                        del under_way[future]
                        self.take(outcome)
                if time.monotonic() - committed > COMMIT_EVERY:
                    self.store.commit()
                    committed = time.monotonic()
        finally:
            if under_way:
                client.cancel(list(under_way), force=True)
            self.store.commit()

    @staticmethod
    def wait(client: Any, futures: List[Any]) -> List[Any]:
        """Those that ended, after at most a second: then it is time to look at `stop`."""
        distributed: Any = importlib.import_module("distributed")
        try:
            with client.as_current():
                distributed.wait(futures, timeout=1.0, return_when="FIRST_COMPLETED")
        except (TimeoutError, distributed.TimeoutError):
            pass
        return [future for future in futures if future.done()]

    def take(self, outcome: Outcome) -> None:
        self.store.put(outcome)
        self.progress.add(outcome.state, outcome.kept)
        if self._usage >= 0:
            self._usage = self._usage + 1 if outcome.state == "failed" and outcome.status == 2 else -1
        if self._usage >= USAGE_FAILURES:
            raise UsageError(f"the first {USAGE_FAILURES} assets failed alike, {outcome.reason}")


def outcome_of(future: Any, name: str) -> Optional[Outcome]:
    """What a worker says of an asset. None: it had ended, and the worker with it before it told us;
    Dask has it done again, which finds the results there."""
    distributed: Any = importlib.import_module("distributed")
    try:
        outcome: Outcome = future.result(timeout=2.0)
        return outcome
    except (TimeoutError, distributed.TimeoutError):
        return None
    except CancelledError as error:
        raise BatchError("the scheduler of Dask went away; what is done stays done") from error
    except Exception as error:  # above all KilledWorker: it took several workers down
        return Outcome(name, "failed", f"its workers died ({type(error).__name__})")
