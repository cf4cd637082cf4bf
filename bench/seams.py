#!/usr/bin/env python3
"""Seams of baked normal maps over several meshes: each is unwrapped, packed on the torus with a
wide padding, its own normals baked, and the error of what is read from the map measured in pictures
from around it (`wrapatlas_bench seams`): inside charts, along their borders, along the border of
the atlas, at mip levels 0 to 4; the same where the texture is clamped, and where nothing is
dilated; all borders of charts beside what filtering alone leaves of the surface's own normals, and
beside the inside of charts where these differ as much under the texels that are read; and the same
places of a second atlas, of charts that are cut to be shorter, wherever one has a border and the
other the inside of a chart. Markdown tables of means in degrees over all pixels of all meshes, and
per mesh for level 0. Needs nothing but Python and the release build. Progress goes to stderr."""

import argparse
import collections
import pathlib
import sys
import tempfile

import measure

PLACES = {
    "inside charts": "inside charts",
    "of these, 2 to 6 texels from the border": "of these, 2 to 6 texels from a border",
    "up to 1 texel from a chart's border": "at the border of a chart",
    "up to 1 texel from the border of the atlas": "at the border of the atlas",
}

# Of each table what its columns are, and of which the number of pixels is of interest: of a map, of
# borders beside the inside, and of two atlases.
TABLES = [
    ([*PLACES], []),
    (["at the border of a chart", "there, by filtering alone", "there, nothing around charts",
      "inside charts, where it bends as much", "inside, by filtering alone",
      "at borders that bend as no inside", "there, by filtering alone too"],
     ["at the border of a chart", "inside, of these classes",
      "at borders that bend as no inside"]),
    (["at the border of a chart", "the same places inside a chart of the other atlas",
      "at the border, nothing around charts"],
     ["at the border of a chart", "near borders of both, left out"]),
]
SHORTER = ["--max-extent", "0.8"]  # of the second atlas; 1.5 is the default


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+", type=pathlib.Path, help="meshes")
    measure.add_options(parser, padding="64")
    parser.add_argument("--time", default="1", help="of guided, seconds; default 1")
    parser.add_argument("--views", default="4", help="cameras around the model; default 4")
    parser.add_argument("--bench", type=pathlib.Path, help="default: the release build's",
                        default=measure.REPOSITORY / "build/release/bench/wrapatlas_bench")
    return parser.parse_args()


def tables_of(text):
    """{title: {(level, place): (mean, pixels)}}"""
    tables, title = collections.defaultdict(dict), None
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip("| ").split("|")]
        if line and not line.startswith("|"):
            title = line
        elif len(cells) == 5 and cells[0].isdigit():
            level, place, mean, _, pixels = cells
            tables[title][int(level), place] = (0 if mean == "-" else float(mean), int(pixels))
    return tables


def packed(options, source, folder, more):
    """The atlas of the mesh, its file in a new folder; `more` to unwrap."""
    folder.mkdir()
    flat = folder / "flat.obj"
    measure.run([options.wrapatlas, "unwrap", str(source), "-o", str(flat), "--stop-after", "flat",
                 "--quiet", *more], f"{source}: unwrap, {folder.name}")
    measure.pack(options, flat, folder, "guided", "uv", f"{source}, {folder.name}",
                 ["--time", options.time])
    return str(folder / "packed.obj")


def measured(options, source, folder):
    atlas = packed(options, source, folder / "atlas", [])
    other = packed(options, source, folder / "other", SHORTER)
    return tables_of(measure.run(
        [str(options.bench), "seams", atlas, other, str(source), "--resolution",
         options.resolution, "--views", options.views], f"{source}: seams"))


def mean_of(entries):
    pixels = sum(count for _, count in entries)
    return sum(mean * count for mean, count in entries) / pixels if pixels else None


def cell(value):
    return "-" if value is None else f"{value:.3f}"


def main():
    options = arguments()
    measure.print_origin(options, f"time {options.time}, {options.views} views")
    of_file = {}
    for number, source in enumerate(options.files, 1):
        measure.progress(f"[{number}/{len(options.files)}] {source}")
        with tempfile.TemporaryDirectory(prefix="wrapatlas_seams") as folder:
            of_file[source] = measured(options, source, pathlib.Path(folder))
    first = next(iter(of_file.values()))
    for title, entries in first.items():
        places, counted = next(table for table in TABLES
                               if all((0, place) in entries for place in table[0]))
        of_all = {key: [tables[title][key] for tables in of_file.values()] for key in entries}
        rows = [[level, *(cell(mean_of(of_all[level, place])) for place in places),
                 *(sum(count for _, count in of_all[level, place]) for place in counted)]
                for level in sorted({level for level, _ in entries})]
        shown = [PLACES.get(place, place) for place in places]
        print(f"\n{title}\n")
        print(measure.table(["level", *shown, *(f"pixels {place}" for place in counted)], rows))
    baked, clamped, bare = list(first)[:3]
    print(f"\nLevel 0, mesh by mesh: {baked}\n")
    rows = [[source.name, *(cell(tables[baked][0, place][0]) for place in PLACES),
             cell(tables[clamped][0, "up to 1 texel from the border of the atlas"][0]),
             cell(tables[bare][0, "up to 1 texel from a chart's border"][0])]
            for source, tables in of_file.items()]
    print(measure.table(["<mesh", *PLACES.values(), "clamped, at the border of the atlas",
                         "not dilated, at the border of a chart"], rows))


if __name__ == "__main__":
    sys.exit(measure.run_script(main))
