#!/usr/bin/env python3
"""Draws the pictures of the documentation into docs/images.

  python3 docs/make_images.py [--wrapatlas build/release/cli/wrapatlas] [name ...]

Diagrams are SVG. Atlases are packed by the command itself, composed as SVG and, since captions need
fonts, turned into PNG by rsvg-convert (Debian: librsvg2-bin); without it they stay as they are.
Python's standard library alone; the same input gives the same bytes with the same rsvg-convert.
"""
import argparse
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.dont_write_bytecode = True
from figures import (atlas_figures, guided_figures, method_figures, raster_figures,  # noqa: E402
                     search_figures, wrap_figures)

DIAGRAMS = {
    "coverage": raster_figures.coverage,
    "horizons": raster_figures.horizons,
    "padding": raster_figures.padding,
    "configuration-space": guided_figures.configuration_space,
    "doubling": guided_figures.doubling,
    "channels": method_figures.channels,
    "drop": method_figures.drop,
    "four-sides": method_figures.four_sides,
    "scale-search": search_figures.scale_search,
    "wrap-and-cut": wrap_figures.wrap_and_cut,
}


def write_png(svg, path, width):
    subprocess.run(["rsvg-convert", "--width", str(width), "--output", str(path)],
                   input=svg.encode(), check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--wrapatlas", default=HERE.parent / "build/release/cli/wrapatlas")
    parser.add_argument("names", nargs="*", help="of the pictures to draw; all without")
    arguments = parser.parse_args()
    known = [*DIAGRAMS, *atlas_figures.PICTURES]
    for name in arguments.names:
        if name not in known:
            parser.error(f"no picture '{name}'; there are: {' '.join(known)}")
    wanted = arguments.names or known
    images = HERE / "images"
    images.mkdir(exist_ok=True)
    for name in wanted:
        if name in DIAGRAMS:
            (images / f"{name}.svg").write_text(DIAGRAMS[name](), encoding="utf-8")
        elif shutil.which("rsvg-convert"):
            picture, width = atlas_figures.PICTURES[name]
            write_png(picture(arguments.wrapatlas, HERE.parent), images / f"{name}.png", width)
        else:
            print(f"{name}.png stays as it is: apt-get install librsvg2-bin", file=sys.stderr)
            continue
        print(f"docs/images/{name}.{'svg' if name in DIAGRAMS else 'png'}")


if __name__ == "__main__":
    main()
