#!/usr/bin/env python3
"""wrapatlas beside xatlas' packer on the same charts: same resolution, same padding, no margin, one
page, density and time in one run, as Markdown tables. Needs PyPI's `xatlas` (README.md here).

xatlas packs at a given scale; its largest scale that fits on one page is bisected (--precision).
xatlas cannot wrap: compare it with the rows without wrap, and see what the torus adds. What it is
handed, and how its padding is made the same, is in xatlas_packer.py. Every result is judged by
`wrapatlas check`. One of wrapatlas that fails gives exit status 1; what fails of xatlas' is counted
below the tables. Progress goes to stderr.
"""

import argparse
import collections
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import measure  # noqa: E402

try:
    import xatlas_packer
except ImportError as error:
    sys.exit(f"with_xatlas.py: {error}; see the README.md beside it for how to install it")

MARGIN = "0"  # xatlas lets charts reach the border of the page
PROMISES = ("overlap", "self_overlap", "gap", "bounds", "margin", "missing_face")

Row = collections.namedtuple("Row", "group file charts method efficiency seconds last")
Judged = collections.namedtuple("Judged", "broken mirrored stretched most scale_efficiency")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=pathlib.Path,
                        help="OBJ files, grouped by their folder; default: all of "
                        "../shared/data/charts")
    measure.add_options(parser)
    parser.add_argument("--stride", type=int, default=1, help="take every so many files; default 1")
    parser.add_argument("--times", default="0,1,10", help="of guided, seconds; default 0,1,10")
    parser.add_argument("--precision", type=float, default=0.001,
                        help="of xatlas' scale, relative; default 0.001")
    parser.add_argument("--no-brute-force", action="store_true",
                        help="leave out xatlas' brute force, which takes most of the time")
    parser.add_argument("--csv", type=pathlib.Path, help="also write every number to this file")
    options = parser.parse_args()
    options.files = (options.files or sorted(measure.CHARTS.glob("*/*.obj")))[::options.stride]
    if not options.files:
        parser.error("no files: give some, the data beside the repository is not there")
    if not options.resolution.isdigit() or not options.padding.isdigit():
        parser.error("--resolution and --padding have to be whole numbers: xatlas packs squares")
    return options


def judged(options, text, path, scale, folder):
    """What `wrapatlas check` says of an atlas by xatlas, and its efficiency."""
    packed = pathlib.Path(folder) / "xatlas.obj"
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
    return report["efficiency"], Judged(broken, kinds["mirrored"], kinds["not_similar"],
                                        max(off, default=0), scale ** 2)


def by_xatlas(options, path, brute_force, folder):
    """(efficiency, seconds, seconds of the last try, what check found, charts)."""
    obj = xatlas_packer.Obj(path)
    charts = xatlas_packer.Charts(obj, int(options.resolution))
    placed, scale, seconds, last = charts.searched(int(options.padding), brute_force,
                                                   options.precision)
    efficiency, found = judged(options, charts.obj_text(placed), path, scale, folder)
    return efficiency, seconds, last, found, len(charts.areas)


def measured(options):
    """Rows, and for each packing of xatlas what was found of it."""
    ours = [("modulo", "none", ""), ("modulo", "uv", "")]
    ours += [("guided", wrap, time) for time in options.times.split(",") for wrap in ("none", "uv")]
    rows, found = [], collections.defaultdict(list)
    with tempfile.TemporaryDirectory(prefix="wrapatlas_xatlas") as folder:
        for number, path in enumerate(options.files, 1):
            measure.progress(f"[{number}/{len(options.files)}] {path}")
            group = path.resolve().parent.name
            for brute_force in (False, True)[:1 if options.no_brute_force else 2]:
                name = "xatlas, brute force" if brute_force else "xatlas"
                *numbers, judgement, charts = by_xatlas(options, path, brute_force, folder)
                rows.append(Row(group, str(path), charts, name, *numbers))
                found[name].append((charts, judgement))
            for method, wrap, time in ours:
                name = f"{method}{time and f' {time} s'}, {wrap_name(wrap)}"
                report = measure.pack(options, path, folder, method, wrap, f"{path}: {name}",
                                      ["--time", time] if time else [], margin=MARGIN)
                if report["charts"] != charts:
                    raise measure.Failure(f"{path}: {charts} charts were handed to xatlas, "
                                          f"{report['charts']} to wrapatlas")
                rows.append(Row(group, str(path), charts, name, report["efficiency"],
                                report["seconds"]["pack"], None))
    return rows, found


def wrap_name(wrap):
    return "no wrap" if wrap == "none" else f"wrap {wrap}"


def print_group(title, rows):
    of_file = collections.defaultdict(dict)
    for row in rows:
        of_file[row.file][row.method] = row.efficiency
    methods = list(dict.fromkeys(row.method for row in rows))
    theirs = [method for method in methods if method.startswith("xatlas")]
    lines = []
    for method in methods:
        mine = [row for row in rows if row.method == method]
        efficiency = [row.efficiency for row in mine]
        best = sum(e[method] >= max(e.values()) - measure.TIE for e in of_file.values())
        beats = sum(e[method] > max(e[x] for x in theirs) + measure.TIE for e in of_file.values())
        lines.append([method, f"{statistics.mean(efficiency):.3f}",
                      f"{statistics.median(efficiency):.3f}", f"{min(efficiency):.3f}",
                      best, "" if method in theirs else beats,
                      f"{statistics.median(row.seconds for row in mine):.3f}",
                      f"{statistics.median(row.last for row in mine):.3f}" if method in theirs
                      else ""])
    print(f"\n### {title}\n")
    print(measure.table(["<method", "mean", "median", "min", "best on",
                         "denser than all of xatlas'", "median s", "one try, median s"], lines))


def print_found(found):
    print("\n### What `wrapatlas check` says of xatlas' results\n")
    for name, judgements in found.items():
        charts = sum(count for count, _ in judgements)
        broken = [each.broken for _, each in judgements if each.broken]
        kinds = collections.Counter(kind for each in broken for kind in each)
        detail = "".join(f", {kind} in {count}" for kind, count in kinds.items())
        print(f"- {name}: padding, overlap or border broken in {len(broken)} of "
              f"{len(judgements)} files{detail}. Of {charts} charts "
              f"{sum(each.mirrored for _, each in judgements)} are mirrored, and "
              f"{sum(each.stretched for _, each in judgements)} more stretched (to whole "
              f"texels), by {max(each.most for _, each in judgements):.2f} texels at most. At "
              f"the scale it was asked for, without the stretching, its mean efficiency is "
              f"{statistics.mean(each.scale_efficiency for _, each in judgements):.3f}.")


def main():
    options = arguments()
    measure.print_origin(options, f"margin {MARGIN}, times {options.times}, xatlas' precision "
                         f"{options.precision:g}, stride {options.stride}")
    rows, found = measured(options)
    print("\nEfficiency: share of the atlas that charts cover, exact areas as written. Time: "
          "packing with the search of the\nscale, without files; xatlas packs on one thread. Every "
          "packing of wrapatlas passed `wrapatlas check`.\nxatlas cannot wrap.")
    for title, group in measure.by_group(rows):
        print_group(title, group)
    print_found(found)
    if options.csv:
        measure.write_csv(options.csv, rows)


if __name__ == "__main__":
    measure.run_script(main)
