"""Atlases packed by the command, composed with captions."""
import base64
import json
import re
import subprocess
import sys
import tempfile

from figures.svg import FONT, escaped

GROUND, LIGHT, DIM = "#ffffff", "#1f2430", "#555c68"


def packed(command, root, sample, *options):
    """The picture of a packing of a sample, or a file elsewhere, as SVG text, and its report."""
    with tempfile.TemporaryDirectory() as folder:
        ending = sample.rsplit(".", 1)[1]
        run = [str(command), "pack", str(root / "samples" / sample), "-o", f"{folder}/out.{ending}",
               "--image", f"{folder}/out.svg", "--json", f"{folder}/out.json", "--quiet", *options]
        subprocess.run(run, check=True)
        with open(f"{folder}/out.svg", encoding="utf-8") as svg:
            with open(f"{folder}/out.json", encoding="utf-8") as report:
                return svg.read(), json.load(report)


def panel(svg, name, x, y, size, numbers):
    """An SVG picture inside another one: its names made unique, its numbers kept or not."""
    if not numbers:
        svg = re.sub(r"<text .*?</text>\n?", "", svg)
    svg = re.sub(r'id="', f'id="{name}-', svg)
    svg = re.sub(r'href="#', f'href="#{name}-', svg)
    svg = re.sub(r"url\(#", f"url(#{name}-", svg)
    return re.sub(r'^<svg ([^>]*?)width="[^"]*" height="[^"]*"',
                  rf'<svg \1x="{x}" y="{y}" width="{size}" height="{size}"', svg)


def words(x, y, text, size, colour=LIGHT, weight="normal"):
    return (f'<text x="{x}" y="{y}" font-size="{size}" fill="{colour}" font-weight="{weight}">'
            f"{escaped(text)}</text>")


def sheet(width, height, parts):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
            f'viewBox="0 0 {width} {height}" {FONT}>\n'
            f'<rect width="100%" height="100%" rx="8" fill="{GROUND}"/>\n' + "\n".join(parts)
            + "\n</svg>\n")


def percent(report):
    return f"{100 * report['efficiency']:.1f} %"


def demo(command, root):
    options = ("coral.glb", "--method", "modulo")
    one, _ = packed(command, root, *options)
    tiled, _ = packed(command, root, *options, "--image-tiles")
    size, y = 760, 64
    return sheet(1600, 840, [
        words(24, 42, "The atlas; hatched parts have crossed its border", 26, weight="bold"),
        words(816, 42, "What a repeating sampler sees: whole charts", 26, weight="bold"),
        panel(one, "one", 24, y, size, numbers=False),
        panel(tiled, "tiled", 816, y, size, numbers=False)])


METHODS = (("lprm02", "Lévy et al. 2002"), ("swg03", "Sander et al. 2003"),
           ("zsgs04", "Zhou et al. 2004"), ("modulo", "Nöll & Stricker 2011"))


def four_methods(command, root):
    sample, parts = "coral.glb", []
    for i, (method, source) in enumerate(METHODS):
        svg, report = packed(command, root, sample, "--method", method)
        x = 20 + 396 * i
        parts += [words(x, 40, f"{method}: {percent(report)}", 26, weight="bold"),
                  words(x, 70, source, 21, DIM),
                  panel(svg, method, x, 88, 372, numbers=False)]
    parts.append(words(20, 498, f"wrapatlas pack samples/{sample} -o out.glb --method …   "
                       f"(all else by default: {report['width']} × {report['height']} texels, "
                       f"padding {report['padding']:g})", 20, DIM))
    return sheet(1600, 518, parts)


def of_method(method, sample):
    def draw(command, root):
        svg, report = packed(command, root, sample, "--method", method)
        return sheet(800, 836, [
            words(20, 36, f"pack samples/{sample} --method {method}: {percent(report)}", 24),
            panel(svg, method, 20, 56, 760, numbers=False)])
    return draw


def pages(command, root):
    options = ("--method", "guided", "--time", "0", "--resolution", "512", "--density", "250")
    svg, report = packed(command, root, "mosaic.ply", *options, "--image-size", "512")
    width = 1560
    height = width * int(re.search(r'height="(\d+)"', svg)[1]) / int(re.search(r'width="(\d+)"', svg)[1])
    shares = " · ".join(f"{100 * share:.0f} %" for share in report["page_efficiency"])
    return sheet(1600, height + 76, [
        words(20, 40, f"wrapatlas pack samples/mosaic.ply -o out.ply {' '.join(options)}   {shares}", 20),
        panel(svg, "pages", 20, 56, width, numbers=False).replace(
            f'height="{width}"', f'height="{height}"', 1)])


# Name of the picture: what draws it, and its width in pixels.
def jigsaws(command, root):
    parts = []
    with tempfile.TemporaryDirectory() as folder:
        for i, pieces in enumerate((10, 30, 100)):
            sample, x = f"{folder}/{pieces}.obj", 20 + 528 * i
            subprocess.run([sys.executable, str(root / "bench/jigsaw.py"), "--pieces", str(pieces),
                            "--seed", "1", "-o", sample], check=True)
            svg, report = packed(command, root, sample, "--time", "20", "--padding", "0")
            parts += [words(x, 40, f"{pieces} pieces: {percent(report)}", 26, weight="bold"),
                      panel(svg, f"jigsaw{pieces}", x, 60, 504, numbers=False)]
    return sheet(1600, 584, parts)


def rendering(command, root):
    """A model that is baked onto itself, with the map that repeats and with the same one clamped."""
    def png(name):
        with open(name, "rb") as file:
            return "data:image/png;base64," + base64.b64encode(file.read()).decode()

    parts = []
    with tempfile.TemporaryDirectory() as folder:
        model, size = f"{folder}/coral.glb", ("--resolution", "512")

        def run(name, *arguments):
            subprocess.run([str(command), name, *arguments, "--quiet"], check=True)
        run("pack", str(root / "samples/coral.glb"), "-o", model, "--time", "0", *size)
        run("bake", model, model, "-o", f"{folder}/map.png", "--map", "object", *size)
        baked = ("--normal-map", f"{folder}/map.png", "--space", "object")
        pictures = (("Its own normals", ()), ("A baked map, repeating", baked),
                    ("The same map, clamped", (*baked, "--wrap", "none")))
        for i, (title, options) in enumerate(pictures):
            view = f"{folder}/{i}.png"
            compare = ("--compare", f"{folder}/0.png", "--json", f"{folder}/{i}.json") if i else ()
            run("render", model, "-o", view, "--azimuth", "0", "--elevation", "60",
                "--size", "504", *options, *compare)
            if compare:
                with open(f"{folder}/{i}.json", encoding="utf-8") as report:
                    title += f": {json.load(report)['psnr']:.1f} dB"
            x = 20 + 528 * i
            parts += [words(x, 40, title, 26, weight="bold"),
                      f'<image x="{x}" y="60" width="504" height="504" href="{png(view)}"/>']
    return sheet(1600, 584, parts)


PICTURES = {
    "rendering": (rendering, 1200),
    "demo": (demo, 1500),
    "four-methods": (four_methods, 1600),
    "pages": (pages, 1200),
    "jigsaws": (jigsaws, 1200),
    "modulo": (of_method("modulo", "machine.obj"), 600),
    "lprm02": (of_method("lprm02", "machine.obj"), 600),
    "swg03": (of_method("swg03", "machine.obj"), 600),
    "zsgs04": (of_method("zsgs04", "machine.obj"), 600),
}
