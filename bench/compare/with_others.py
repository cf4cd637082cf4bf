#!/usr/bin/env python3
"""wrapatlas beside other packers on the same charts: same resolution, same padding, no margin, one
page, density and time in one run, as Markdown tables. Needs what README.md here says.

None of the others can wrap: compare them with the rows without wrap, and see what the torus adds.
How each is asked the same question is in its own *_packer.py. Every result is judged by `wrapatlas
check`. One of wrapatlas that fails gives exit status 1; what fails of the others is counted below
the tables, and counts as the efficiency that it has. Progress goes to stderr.
"""

import argparse
import collections
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import measure  # noqa: E402

try:
    import numpy
    from obj_charts import Charts, Obj
except ImportError as error:
    sys.exit(f"with_others.py: {error}; see the README.md beside it for how to install it")

HERE = pathlib.Path(__file__).resolve().parent
MARGIN = "0"  # the others let charts reach the border of the page
PROMISES = ("overlap", "self_overlap", "gap", "bounds", "margin", "missing_face")

Row = collections.namedtuple("Row", "group file charts method efficiency seconds last failed")
Judged = collections.namedtuple("Judged", "charts broken mirrored stretched most scale_efficiency")

# Names, modules and options of the others.
OTHERS = {"xatlas": ("xatlas_packer", {}),
          "xatlas, brute force": ("xatlas_packer", {"brute_force": True}),
          "Blender": ("blender_packer", {}),
          "spyrrow": ("spyrrow_packer", {})}
SHORT = {"xatlas": "xatlas", "xatlas-brute-force": "xatlas, brute force", "blender": "Blender",
         "spyrrow": "spyrrow"}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=pathlib.Path,
                        help="OBJ files, grouped by their folder; default: all of "
                        "../shared/data/charts")
    measure.add_options(parser)
    parser.add_argument("--stride", type=int, default=1, help="take every so many files; default 1")
    parser.add_argument("--packers", default="xatlas,xatlas-brute-force",
                        help=f"comma-separated, of {', '.join(SHORT)}; default %(default)s")
    parser.add_argument("--times", default="0,1,10", help="of guided, seconds; default 0,1,10")
    parser.add_argument("--spyrrow-time", type=float, default=20,
                        help="of spyrrow, seconds; default 20")
    parser.add_argument("--precision", type=float, default=0.001,
                        help="of xatlas' scale, relative; default 0.001")
    parser.add_argument("--limit", type=float, default=600,
                        help="seconds that one packing of the others may take; default 600")
    parser.add_argument("--csv", type=pathlib.Path, help="also write every number to this file")
    options = parser.parse_args()
    options.files = (options.files or sorted(measure.CHARTS.glob("*/*.obj")))[::options.stride]
    if not options.files:
        parser.error("no files: give some, the data beside the repository is not there")
    if not options.resolution.isdigit() or not options.padding.isdigit():
        parser.error("--resolution and --padding have to be whole numbers: xatlas packs squares")
    unknown = set(options.packers.split(",")) - set(SHORT)
    if unknown:
        parser.error(f"no such packer: {unknown.pop()}")
    options.others = [SHORT[name] for name in options.packers.split(",")]
    return options


def judged(options, text, path, scale, folder, charts):
    """What `wrapatlas check` says of an atlas by another packer, and its efficiency."""
    packed = pathlib.Path(folder) / "other.obj"
    packed.write_text(text)
    command = [options.wrapatlas, "check", str(packed), "--ref", str(path), "--resolution",
               options.resolution, "--padding", options.padding, "--margin", MARGIN,
               "--wrap", "none", "--findings", "1000000", "--json", "-"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in (0, 1):
        raise measure.Failure(f"{path}: {done.stderr.strip()}")
    report = json.loads(done.stdout)
    kinds = collections.Counter(finding["kind"] for finding in report["findings"])
    off = [finding["amount"] for finding in report["findings"] if finding["kind"] == "not_similar"]
    broken = {kind: kinds[kind] for kind in PROMISES if kinds[kind]}
    return report["efficiency"], Judged(charts, broken, kinds["mirrored"], kinds["not_similar"],
                                        max(off, default=0), scale ** 2)


def by_other(options, name, path, charts, folder):
    """(efficiency, seconds, seconds of the last try, what check found)."""
    module, more = OTHERS[name]
    output = pathlib.Path(folder) / "placed.npz"
    given = {"module": module, "resolution": int(options.resolution),
             "padding": int(options.padding), "precision": options.precision,
             "seconds": options.spyrrow_time, "threads": int(options.threads) or 2} | more
    measure.run([sys.executable, str(HERE / "pack_one.py"), str(path), str(output),
                 json.dumps(given)], f"{path}: {name}", options.limit)
    data = numpy.load(output)
    efficiency, found = judged(options, charts.obj_text(data["placed"]), path, float(data["scale"]),
                               folder, len(charts.areas))
    return efficiency, float(data["seconds"]), float(data["last"]), found


def measured(options):
    """Rows, and for each packing of the others what was found of it."""
    ours = [("modulo", "none", ""), ("modulo", "uv", "")]
    ours += [("guided", wrap, time) for time in options.times.split(",") for wrap in ("none", "uv")]
    rows, found = [], collections.defaultdict(list)
    with tempfile.TemporaryDirectory(prefix="wrapatlas_others") as folder:
        for number, path in enumerate(options.files, 1):
            measure.progress(f"[{number}/{len(options.files)}] {path}")
            group = path.resolve().parent.name
            charts = Charts(Obj(path), int(options.resolution))
            count = len(charts.areas)
            for name in options.others:
                try:
                    *numbers, judgement = by_other(options, name, path, charts, folder)
                except measure.Failure as failure:
                    measure.progress(str(failure))
                    why = str(failure).strip().splitlines()[-1]
                    rows.append(Row(group, str(path), count, name, 0, math.nan, math.nan, why))
                    continue
                rows.append(Row(group, str(path), count, name, *numbers, ""))
                found[name].append(judgement)
            for method, wrap, time in ours:
                name = f"{method}{time and f' {time} s'}, {wrap_name(wrap)}"
                report = measure.pack(options, path, folder, method, wrap, f"{path}: {name}",
                                      ["--time", time] if time else [], margin=MARGIN)
                if report["charts"] != count:
                    raise measure.Failure(f"{path}: {count} charts were handed to the others, "
                                          f"{report['charts']} to wrapatlas")
                rows.append(Row(group, str(path), count, name, report["efficiency"],
                                report["seconds"]["pack"], math.nan, ""))
            if options.csv:  # at once, so that an interrupted run leaves its numbers
                measure.write_csv(options.csv, rows)
    return rows, found


def wrap_name(wrap):
    return "no wrap" if wrap == "none" else f"wrap {wrap}"


def print_group(title, rows, others):
    of_file = collections.defaultdict(dict)
    for row in rows:
        of_file[row.file][row.method] = row.efficiency
    lines = []
    for method in dict.fromkeys(row.method for row in rows):
        mine = [row for row in rows if row.method == method]
        efficiency = [row.efficiency for row in mine]
        best = sum(e[method] >= max(e.values()) - measure.TIE for e in of_file.values())
        beats = sum(e[method] > max(e[x] for x in others) + measure.TIE for e in of_file.values())
        lines.append([method, f"{statistics.mean(efficiency):.3f}",
                      f"{statistics.median(efficiency):.3f}", f"{min(efficiency):.3f}",
                      best, "" if method in others else beats, median(row.seconds for row in mine),
                      median(row.last for row in mine) if method in others else ""])
    print(f"\n### {title}\n")
    print(measure.table(["<method", "mean", "median", "min", "best on", "denser than all others",
                         "median s", "last try, median s"], lines))


def median(seconds):
    known = [value for value in seconds if not math.isnan(value)]
    return f"{statistics.median(known):.3f}" if known else ""


def print_found(found, rows):
    print("\n### What `wrapatlas check` says of the others' results\n")
    for name, judgements in found.items():
        broken = [each.broken for each in judgements if each.broken]
        kinds = collections.Counter(kind for each in broken for kind in each)
        detail = "".join(f", {kind} in {count}" for kind, count in kinds.items())
        text = (f"- {name}: padding, overlap or border broken in {len(broken)} of "
                f"{len(judgements)} files{detail}. Of {sum(each.charts for each in judgements)} "
                f"charts {sum(each.mirrored for each in judgements)} are mirrored, and "
                f"{sum(each.stretched for each in judgements)} more no similarity copies, off by "
                f"{max(each.most for each in judgements):.3f} texels at most.")
        scales = [each.scale_efficiency for each in judgements
                  if not math.isnan(each.scale_efficiency)]
        if scales:
            text += (" At the scale it was asked for, without stretching to whole texels, its mean "
                     f"efficiency is {statistics.mean(scales):.3f}.")
        print(text)
    for row in rows:
        if row.failed:
            print(f"- {row.method} on {row.file}: {row.failed}")


def main():
    options = arguments()
    measure.print_origin(options, f"margin {MARGIN}, times {options.times}, precision "
                         f"{options.precision:g}, spyrrow time {options.spyrrow_time:g}, stride "
                         f"{options.stride}")
    rows, found = measured(options)
    print("\nEfficiency: share of the atlas that charts cover, exact areas as written; 0 where "
          "there is no result. Time:\npacking with the search of the scale, without files; xatlas "
          "and Blender pack on one thread. Every packing of\nwrapatlas passed `wrapatlas check`. "
          "None of the others can wrap.")
    for title, group in measure.by_group(rows):
        print_group(title, group, options.others)
    print_found(found, rows)


if __name__ == "__main__":
    measure.run_script(main)
