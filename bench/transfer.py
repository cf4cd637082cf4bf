#!/usr/bin/env python3
"""Textured models by `wrapatlas transfer`: texels before and after, and how like the original the
result looks, its base colours rendered without light from several sides, as a Markdown table. Every
glTF that is written is read by the Khronos validator (./dev test installs it). Models that cannot
be moved are named below the table. Those that come to more texels than before are moved once more,
to no more than they had (--resolution, all their atlases alike), in a second table, unless a
resolution is given for all. Needs nothing but Python. Progress goes to stderr."""

import argparse
import json
import math
import pathlib
import shutil
import statistics
import sys
import tempfile

import measure

HEADS = ["<model", "charts", "images", "million texels", "images after", "of", "million texels",
         "change", "scale", "PSNR, dB", "SSIM", "s"]
GLTF = (".glb", ".gltf")
VALIDATOR = measure.REPOSITORY / "tests" / "gltf" / "validate.mjs"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+", type=pathlib.Path, help="glTF or OBJ files")
    measure.add_options(parser, resolution="", padding="4")
    parser.add_argument("--time", default="1", help="of guided, seconds; default 1")
    parser.add_argument("--size", default="512", help="pixels of a view; default 512")
    parser.add_argument("--views", default="6", help="default 6")
    parser.add_argument("--unwrap", dest="how", action="append_const", const="--unwrap",
                        default=[], help="into new charts")
    parser.add_argument("--merge", dest="how", action="append_const", const="--merge",
                        help="all materials into one atlas")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the pictures")
    return parser.parse_args()


def rendered(options, model, image, *more):
    report = measure.run([options.wrapatlas, "render", str(model), "-o", str(image), "--shade",
                          "none", "--views", options.views, "--size", options.size, "--quiet",
                          "--json", "-", *more], str(model))
    return json.loads(report)


def row(options, source, folder, resolution):
    """(entries of the table, side): if there are more texels than before, the side of as many
    square pictures that have no more, else None."""
    moved = folder / f"moved{source.suffix}"
    size = ["--resolution", resolution] if resolution else []
    report = json.loads(measure.run(
        [options.wrapatlas, "transfer", str(source), "-o", str(moved), "--padding",
         options.padding, "--time", options.time, "--threads", options.threads, "--quiet",
         "--json", "-", *size, *options.how], str(source)))
    if source.suffix in GLTF:
        measure.run(["node", str(VALIDATOR), str(moved)], f"{source}: the validator")
    rendered(options, source, folder / "before.png")
    likeness = rendered(options, moved, folder / "after.png", "--compare",
                        str(folder / "before.png"))
    name = source.name if source.stem not in ("left", "right", "none") else \
        f"{source.parent.name}/{source.stem}"
    if options.keep:
        kept = "-".join([*name.split("/"), *([resolution] if resolution else [])])
        for picture in ("before.png", "after.png"):
            shutil.copy(folder / picture, options.keep / f"{kept}.{picture}")
    atlases = report["atlases"]
    psnr = likeness["psnr"]
    before, after = report["texels_before"], report["texels"]
    equal_side = max(4, math.isqrt(before // report["images"]) // 4 * 4) if after > before else None
    return [name, sum(atlas["charts"] for atlas in atlases), report["images_before"],
            f"{before / 1e6:.2f}", report["images"],
            ", ".join(f"{atlas['width']} x {atlas['height']}" for atlas in atlases),
            f"{after / 1e6:.2f}", f"{100 * (after / before - 1):+.0f} %",
            f"{min(atlas['texel_scale'] for atlas in atlases):.2f}",
            "equal" if psnr is None else f"{psnr:.1f}", f"{likeness['ssim']:.4f}",
            f"{report['seconds']['total']:.1f}"], equal_side


def move_all(options, files, resolutions):
    """Rows of the table; {file: side} of those with more texels than before; failures."""
    rows, larger, failures = [], {}, []
    for number, source in enumerate(files, 1):
        measure.progress(f"[{number}/{len(files)}] {source}")
        with tempfile.TemporaryDirectory(prefix="wrapatlas_transfer") as folder:
            try:
                entries, side = row(options, source, pathlib.Path(folder), resolutions.get(source))
            except measure.Failure as failure:
                failures.append(str(failure))
                continue
        rows.append(entries)
        if side:
            larger[source] = str(side)
    return rows, larger, failures


def totals(rows):
    before, after = (sum(float(row[i]) for row in rows) for i in (3, 6))
    psnr = [float(row[9]) for row in rows if row[9] != "equal"]
    changes = [float(row[7].split()[0]) for row in rows]
    if not psnr:
        return f"{len(rows)} moved"
    return (f"{len(rows)} moved; PSNR at least {min(psnr):.1f}, median {statistics.median(psnr):.1f} dB, "
            f"{len(rows) - len(psnr)} equal; {100 * (after / before - 1):+.0f} % texels in all, "
            f"{statistics.median(changes):+.0f} % in the median, more on {sum(c > 0 for c in changes)}")


def main():
    options = arguments()
    measure.print_origin(options, f"time {options.time}, {options.views} views of {options.size}")
    if options.keep:
        options.keep.mkdir(parents=True, exist_ok=True)
    has_validator = (VALIDATOR.parent / "node_modules" / "gltf-validator").is_dir()
    if not has_validator and any(source.suffix in GLTF for source in options.files):
        raise measure.Failure("the Khronos validator is not installed; ./dev test does that")
    resolutions = {source: options.resolution for source in options.files}
    rows, larger, failures = move_all(options, options.files, resolutions)
    print(measure.table(HEADS, rows))
    print(totals(rows))
    if larger and not options.resolution:
        print("\nAt no more texels than before:\n")
        rows, _, failed = move_all(options, larger, larger)
        print(measure.table(HEADS, rows))
        print(totals(rows))
        failures += [f"at no more texels: {failure}" for failure in failed]
    for failure in failures:
        print(f"not moved: {failure}")


if __name__ == "__main__":
    sys.exit(measure.run_script(main))
