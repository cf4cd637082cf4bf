#!/usr/bin/env python3
"""Textured models by `wrapatlas transfer`: texels before and after, and how like the original the
result looks, rendered without light from several sides, as a Markdown table. The base colour is
compared, of models that have one picture of it; every result is read by the Khronos validator
(./dev test installs it). Needs nothing but Python. Progress goes to stderr."""

import argparse
import json
import pathlib
import struct
import sys
import tempfile

import measure

VALIDATOR = measure.REPOSITORY / "tests" / "gltf" / "validate.mjs"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+", type=pathlib.Path, help="GLB files")
    measure.add_options(parser, resolution="", padding="4")
    parser.add_argument("--time", default="1", help="of guided, seconds; default 1")
    parser.add_argument("--size", default="512", help="pixels of a view; default 512")
    parser.add_argument("--views", default="6", help="default 6")
    return parser.parse_args()


def glb_parts(path):
    """(JSON, bytes of the BIN chunk)."""
    data = path.read_bytes()
    size = struct.unpack("<I", data[12:16])[0]
    return json.loads(data[20:20 + size]), data[28 + size:]


def base_colours(path):
    """The bytes of each picture of a base colour."""
    gltf, binary = glb_parts(path)
    pictures = {}
    for material in gltf.get("materials", []):
        info = material.get("pbrMetallicRoughness", {}).get("baseColorTexture")
        if info is None:
            continue
        source = gltf["textures"][info["index"]]["source"]
        view = gltf["bufferViews"][gltf["images"][source]["bufferView"]]
        begin = view.get("byteOffset", 0)
        pictures[source] = binary[begin:begin + view["byteLength"]]
    return list(pictures.values())


def rendered(options, model, picture, folder, name, *more):
    texture, image = folder / f"{name}.picture", folder / f"{name}.png"
    texture.write_bytes(picture)
    report = measure.run([options.wrapatlas, "render", str(model), "-o", str(image), "--texture",
                          str(texture), "--shade", "none", "--views", options.views, "--size",
                          options.size, "--quiet", "--json", "-", *more], str(model))
    return image, json.loads(report)


def row(options, source, folder):
    moved = folder / "moved.glb"
    size = ["--resolution", options.resolution] if options.resolution else []
    report = json.loads(measure.run(
        [options.wrapatlas, "transfer", str(source), "-o", str(moved), "--padding",
         options.padding, "--time", options.time, "--threads", options.threads, "--quiet",
         "--json", "-", *size], str(source)))
    measure.run(["node", str(VALIDATOR), str(moved)], f"{source}: the validator")
    before, after = base_colours(source), base_colours(moved)
    likeness = {"psnr": None, "ssim": None}
    if len(before) == 1 and len(after) == 1:
        truth, _ = rendered(options, source, before[0], folder, "before")
        _, likeness = rendered(options, moved, after[0], folder, "after", "--compare", str(truth))
    show = lambda value, form: "" if value is None else f"{value:{form}}"
    return [source.name if source.stem not in ("left", "right", "none") else
            f"{source.parent.name}/{source.stem}", report["charts"], report["images_before"],
            f"{report['texels_before'] / 1e6:.2f}", len(report["textures"]),
            f"{report['width']} x {report['height']}", f"{report['texels'] / 1e6:.2f}",
            f"{100 * (report['texels'] / report['texels_before'] - 1):+.0f} %",
            f"{report['texel_scale']:.2f}", show(likeness["psnr"], ".1f"),
            show(likeness["ssim"], ".4f"), f"{report['seconds']['total']:.1f}"]


def main():
    options = arguments()
    measure.print_origin(options, f"time {options.time}, {options.views} views of {options.size}")
    rows = []
    for number, source in enumerate(options.files, 1):
        measure.progress(f"[{number}/{len(options.files)}] {source}")
        with tempfile.TemporaryDirectory(prefix="wrapatlas_transfer") as folder:
            rows.append(row(options, source, pathlib.Path(folder)))
    print(measure.table(["<model", "charts", "images", "million texels", "images after", "of",
                         "million texels", "change", "scale", "PSNR, dB", "SSIM", "s"], rows))


if __name__ == "__main__":
    sys.exit(measure.run_script(main))
