"""What the measuring scripts share: packing and checking a file, saying where that was, tables."""

import csv
import json
import os
import pathlib
import platform
import shlex
import subprocess
import sys

REPOSITORY = pathlib.Path(__file__).resolve().parents[1]
CHARTS = REPOSITORY.parent / "shared" / "data" / "charts"  # beside the repository, not in it


TIE = 1e-9  # efficiencies closer than this are equal


class Failure(Exception):
    """A packing or its check went wrong."""


def default_command():
    return os.environ.get("WRAPATLAS", str(REPOSITORY / "build/release/cli/wrapatlas"))


def add_options(parser, resolution="1024", padding="2", threads="0"):
    """The options that every script has, with the script's own defaults."""
    parser.add_argument("--resolution", default=resolution,
                        help=f"texels of the atlas, N or WxH; default {resolution}")
    parser.add_argument("--padding", default=padding,
                        help=f"texels between charts; default {padding}")
    parser.add_argument("--threads", default=threads,
                        help=f"of wrapatlas; 0: as many as the machine has; default {threads}")
    parser.add_argument("--wrapatlas", default=default_command(),
                        help="the command to run; default: $WRAPATLAS, else the release build")


def add_packing_options(parser, time):
    """The options of scripts that pack with one method."""
    parser.add_argument("--method", default="guided", help="default guided")
    parser.add_argument("--time", default=time, help=f"of guided, seconds; default {time}")
    parser.add_argument("--images", type=pathlib.Path, metavar="DIR",
                        help="write a picture of each packing there")


def packing_arguments(options, image):
    """What add_packing_options() gives `wrapatlas pack`, with the name of the picture."""
    more = ["--time", options.time] if options.method == "guided" else []
    if options.images:
        options.images.mkdir(parents=True, exist_ok=True)
        more += ["--image", str(options.images / f"{image}.png")]
    return more


def machine():
    name = platform.processor() or platform.machine()
    try:
        lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
        name = next(line.split(": ", 1)[1] for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    usable = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    limit = f" ({usable} usable)" if usable != os.cpu_count() else ""
    return f"{name}, {os.cpu_count()} cores{limit}"


def commit():
    command = ["git", "-C", str(REPOSITORY), "describe", "--always", "--dirty", "--abbrev=10"]
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def print_origin(options, more=""):
    """One line: the machine, the commit, the options in force and the command line."""
    print(f"machine: {machine()}; commit: {commit()}; options: resolution {options.resolution}, "
          f"padding {options.padding}, threads {options.threads}{more and ', ' + more}; "
          f"command: {shlex.join(sys.argv)}", flush=True)


def progress(text):
    print(text, file=sys.stderr, flush=True)


def run(command, what, limit=None):
    """Its standard output. Raises Failure, also after `limit` seconds."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        raise Failure(f"{what}: not done after {limit:g} s") from None
    if done.returncode != 0:
        raise Failure(f"{what}: exit status {done.returncode} of {shlex.join(command)}\n"
                      f"{done.stderr.strip()}")
    return done.stdout


def pack(options, source, folder, method, wrap, what, more=(), margin=None):
    """Packs `source` into `folder`, checks the result against it, and gives pack's report.

    `margin` counts only where the atlas does not wrap on both axes. Raises Failure.
    """
    source = pathlib.Path(source)
    ending = source.suffix if source.suffix.lower() not in (".off", ".stl") else ".obj"
    packed = str(pathlib.Path(folder) / ("packed" + ending))
    promise = ["--padding", options.padding, "--wrap", wrap, "--threads", options.threads]
    if margin is not None and wrap != "uv":
        promise += ["--margin", margin]
    report = json.loads(run([options.wrapatlas, "pack", str(source), "-o", packed, "--method",
                             method, "--resolution", options.resolution, *promise, "--json", "-",
                             *more], what))
    # The atlas may have another shape than asked for, where its aspect was searched.
    run([options.wrapatlas, "check", packed, "--ref", str(source),
         "--resolution", f"{report['width']}x{report['height']}", *promise], what)
    return report


def table(titles, rows):
    """Markdown. Titles that begin with '<' are of columns aligned to the left."""
    lines = ["| " + " | ".join(title.lstrip("<") for title in titles) + " |",
             "|" + "|".join("---" if title.startswith("<") else "---:" for title in titles) + "|"]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines)


def by_group(rows):
    """Yields ("name: N files", its rows) for each group of rows, in their order."""
    for name in dict.fromkeys(row.group for row in rows):
        group = [row for row in rows if row.group == name]
        yield title(name, group), group


def title(name, rows):
    files = len({row.file for row in rows})
    return f"{name}: {files} {'file' if files == 1 else 'files'}"


def write_csv(path, rows):
    """Named tuples, all of a kind."""
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(rows[0]._fields)
        writer.writerows(rows)


def numbers(text):
    """'10,30,100' as a list of integers, for argparse."""
    return [int(part) for part in text.split(",")]


def run_script(body):
    """Runs a script; a packing or check that fails is named and gives exit status 1."""
    try:
        body()
    except Failure as failure:
        sys.exit(f"{pathlib.Path(sys.argv[0]).name}: {failure}")
