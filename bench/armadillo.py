#!/usr/bin/env python3
"""The paper's Figure 13 for any mesh: it is simplified, unwrapped once, packed by several methods,
its detail baked into a normal map of each packing, and what that looks like compared with the mesh
itself from several sides, and with what a much larger map of the same packing looks like, which
shows the map's own error without that of the simplified shape; Markdown tables, and pictures on request. The methods get the same charts,
resolution and padding. Every packing goes through `wrapatlas check`. Progress goes to stderr."""

import argparse
import collections
import json
import pathlib
import statistics
import sys
import tempfile

import measure

METHODS = ("lprm02", "modulo", "guided")
Row = collections.namedtuple(
    "Row", "file method faces efficiency texels psnr ssim map_psnr simplify bake")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+", type=pathlib.Path, help="meshes")
    measure.add_options(parser, resolution="256")
    parser.add_argument("--faces", default="1%", help="of the simplified mesh; default 1%%")
    parser.add_argument("--time", default="10", help="of guided, seconds; default 10")
    parser.add_argument("--views", default="12", help="cameras around the model; default 12")
    parser.add_argument("--size", default="512", help="pixels of each view; default 512")
    parser.add_argument("--fine", default="2048",
                        help="texels a side of the larger map; default 2048")
    parser.add_argument("--images", type=pathlib.Path, metavar="DIR",
                        help="write the maps and the views there")
    options = parser.parse_args()
    if not options.resolution.isdigit():
        parser.error("--resolution has to be a whole number: lprm02 packs it as a square")
    return options


def command(options, what, *arguments):
    return measure.run([options.wrapatlas, *map(str, arguments)], what)


def report(options, what, *arguments):
    return json.loads(command(options, what, *arguments, "--quiet", "--json", "-"))


def measured(options, source, folder):
    """A row for each method."""
    low, flat = folder / "low.obj", folder / "flat.obj"
    simplified = report(options, f"{source}: simplify", "simplify", source, "-o", low, "--faces",
                        options.faces)
    report(options, f"{source}: unwrap", "unwrap", low, "-o", flat, "--stop-after", "flat")
    view = ["--views", options.views, "--size", options.size]
    truth = folder / "truth.png"
    command(options, f"{source}: render", "render", source, "-o", truth, *view, "--quiet")
    for method in METHODS:
        what = f"{source}: {method}"
        wrap = "none" if method == "lprm02" else "uv"
        more = ["--time", options.time] if method == "guided" else []
        packed = measure.pack(options, flat, folder, method, wrap, what, more, margin="0")
        atlas, normals, image = folder / "packed.obj", folder / "n.png", folder / f"{method}.png"
        def bake(output, resolution):
            return report(options, what, "bake", atlas, source, "-o", output, "--map", "object",
                          "--resolution", resolution, "--wrap", wrap)

        def look(output, other):
            return report(options, what, "render", atlas, "-o", output, "--normal-map", normals,
                          "--space", "object", *view, "--framed-as", source, "--compare", other)

        bake(normals, options.fine)
        fine = folder / "fine.png"
        look(fine, truth)
        baked = bake(normals, options.resolution)
        seen, beside_fine = look(image, truth), look(image, fine)
        if options.images:
            keep(options.images, source, method, normals, image)
        yield Row(str(source), method, simplified["faces"], packed["efficiency"],
                  baked["texels_used"], seen["psnr"], seen["ssim"], beside_fine["psnr"],
                  simplified["seconds"]["simplify"], baked["seconds"]["bake"])
    if options.images:
        keep(options.images, source, "original", None, truth)


def keep(folder, source, name, normals, image):
    folder.mkdir(parents=True, exist_ok=True)
    image.replace(folder / f"{source.stem}-{name}.png")
    if normals:
        normals.replace(folder / f"{source.stem}-{name}-normals.png")


def main():
    options = arguments()
    measure.print_origin(options, f"faces {options.faces}, time {options.time}, views "
                         f"{options.views} of {options.size} pixels")
    rows = []
    for number, source in enumerate(options.files, 1):
        measure.progress(f"[{number}/{len(options.files)}] {source}")
        with tempfile.TemporaryDirectory(prefix="wrapatlas_armadillo") as folder:
            rows += measured(options, source, pathlib.Path(folder))
    print(measure.table(
        ["<file", "<method", "faces", "efficiency", "texels in use", "PSNR, dB", "SSIM",
         "PSNR to the larger map, dB"],
        [[pathlib.Path(row.file).name, row.method, row.faces, f"{row.efficiency:.3f}", row.texels, f"{row.psnr:.2f}",
          f"{row.ssim:.4f}", f"{row.map_psnr:.2f}"] for row in rows]))
    print_means(rows)


def print_means(rows):
    of_file = collections.defaultdict(dict)
    for row in rows:
        of_file[row.file][row.method] = row
    first = METHODS[0]
    lines = []
    for method in METHODS:
        mine = [row for row in rows if row.method == method]
        lines.append([method, *(f"{statistics.mean(getattr(row, name) for row in mine):{form}}"
                                for name, form in (("efficiency", ".3f"), ("texels", ".0f"),
                                                   ("psnr", ".2f"), ("ssim", ".4f"),
                                                   ("map_psnr", ".2f"))),
                      sum(one[method].texels > one[first].texels for one in of_file.values()),
                      sum(one[method].psnr > one[first].psnr for one in of_file.values()),
                      sum(one[method].map_psnr > one[first].map_psnr for one in of_file.values()),
                      f"{statistics.median(row.bake for row in mine):.2f}"])
    print(f"\nMeans over {len(of_file)} meshes:\n")
    print(measure.table(["<method", "efficiency", "texels in use", "PSNR, dB", "SSIM",
                         "PSNR to the larger map, dB", f"more texels than {first} on", f"higher PSNR than {first} on", "to the larger map",
                         "bake, median s"], lines))


if __name__ == "__main__":
    sys.exit(measure.run_script(main))
