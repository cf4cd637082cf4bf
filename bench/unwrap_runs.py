"""Unwrapping one mesh, with wrapatlas or with xatlas, and judging the result by what
unwrap_measures.py measures of it. No run ends the script: what it breaks is named in its row."""

import collections
import importlib.util
import json
import pathlib
import sys

import numpy

import measure
import mesh_files
from chart_corners import folded
from chart_triangles import fans
from unwrap_measures import Measures, measured

STAGES = ("total", "read", "repair", "segment", "flatten", "pack", "validate", "write")
XATLAS = measure.REPOSITORY / "bench" / "compare" / "xatlas_unwrap.py"
ROUNDING = 1e-4  # of stretch, relative: UVs are 32-bit floats
AGREEMENT = 1e-2  # of the stretch that the program reports, relative

# Those of Measures that are numbers.
MEASURED = ("charts", "angle", "boundary", "flipped", "otherwise_flipped", "collapsed",
            "crossing_charts", "crossing_depth", "thin", "thin_flipped", "thin_depth", "touches",
            "touch_depth")
# Lengths in texels, times in seconds. None: not known. `failed`: broken promises, or why there is
# no result.
COLUMNS = ("group", "file", "method", "faces", "l2", "linf", "efficiency", "megabytes", *STAGES,
           "left_out", "folded", "not_discs", *MEASURED, "failed")
Row = collections.namedtuple("Row", COLUMNS, defaults=[None] * (len(COLUMNS) - 3))


def has_xatlas():
    return importlib.util.find_spec("xatlas") is not None


def row(group, path, method, measures=None, **values):
    if measures:
        values |= {"l2": measures.l2.max(initial=0), "linf": measures.linf.max(initial=0),
                   "not_discs": len(measures.not_discs)}
        values |= {name: getattr(measures, name) for name in MEASURED}
    return Row(group, str(path), method, **values)


def by_wrapatlas(options, group, path, folder, more=()):
    """Needs of the options: wrapatlas, resolution, padding, threads, max_stretch, limit."""
    output = pathlib.Path(folder) / "unwrapped.obj"
    packs = "--stop-after" not in more
    packing_options = ["--resolution", options.resolution, "--padding", options.padding]
    try:
        report = json.loads(measure.run(
            [options.wrapatlas, "unwrap", str(path), "-o", str(output), "--max-stretch",
             f"{options.max_stretch:g}", *(packing_options if packs else ()), "--threads", options.threads, "--quiet", "--json", "-", *more],
            str(path), options.limit))
        source, result = mesh_files.read(path), mesh_files.read(output)
    except (measure.Failure, ValueError) as failure:
        return row(group, path, "wrapatlas", failed=without_name(path, failure))
    broken, faces = unlike(source, result), len(result.sizes())
    result = with_uvs(result)
    left_out = faces - len(result.sizes())
    measures, folds = unfolded_measures(result, report.get("width", 1), report.get("height", 1))
    broken += broken_promises(measures, left_out, options.max_stretch)
    broken += disagreements(report, {"faces": faces, "charts": measures.charts + folds})
    if (result.sizes() == 3).all():  # else it depends on how polygons are cut
        broken += disagreement_on_stretch(report, measures.l2.max(initial=0))
    if "width" in report:
        broken += check(options, output, report)
    seconds = {stage: report["seconds"].get(stage) for stage in STAGES}
    return row(group, path, "wrapatlas", measures, faces=faces, left_out=left_out, folded=folds,
               efficiency=report.get("efficiency"), megabytes=report.get("peak_memory_mb"),
               failed="; ".join(broken), **seconds)


def without_name(path, failure):
    return str(failure).removeprefix(f"{path}: ")


def unfolded_measures(mesh, width, height):
    """(Measures, number of faces that have a position twice and are left out of them)."""
    fold = folded(mesh)
    mesh = mesh.subset(~fold) if fold.any() else mesh
    measures = measured(mesh, width, height) if len(mesh.sizes()) else Measures(
        l2=numpy.zeros(0), linf=numpy.zeros(0))
    return measures, int(fold.sum())


def unlike(source, result):
    """Where the result is not the source with other UVs."""
    if len(source.sizes()) != len(result.sizes()):
        return [f"{len(source.sizes())} faces became {len(result.sizes())}"]
    if (source.sizes() != result.sizes()).any():
        return ["faces have other numbers of corners, or another order"]
    broken = []
    moved = (numpy.float32(source.corner_positions())
             != numpy.float32(result.corner_positions())).any(axis=1)
    if moved.any():
        broken.append(f"{moved.sum()} corners are at other positions, or in another order")
    if (source.positions.shape != result.positions.shape
            or (source.corners != result.corners).any()):
        broken.append("vertices were renumbered")
    return broken


def with_uvs(mesh):
    if mesh.uvs is None:
        mesh.uvs = numpy.full((len(mesh.corners), 2), numpy.nan)
    bare = numpy.isnan(mesh.uvs).any(axis=1)
    return mesh.subset(numpy.add.reduceat(bare, mesh.begins[:-1]) == 0) if bare.any() else mesh


def broken_promises(measures, left_out, max_stretch):
    found = [(left_out, "faces without UVs"), (measures.flipped, "flipped triangles"),
             (measures.collapsed, "triangles without area in the plane")]
    broken = [f"{count} {what}" for count, what in found if count]
    broken += [f"chart {chart} is no disc: {why}" for chart, why in measures.not_discs.items()]
    if measures.crossing_charts:
        broken.append(f"{measures.crossing_charts} charts overlap themselves, borders cross by up "
                      f"to {measures.crossing_depth:.2g} texels")
    most = measures.l2.max(initial=0)
    if most > max_stretch * (1 + ROUNDING):
        broken.append(f"L2 stretch {most:.4f}")
    return broken


def disagreements(report, counts):
    """Where the program says something else than what is measured."""
    return [f"reports {report.get(name)} {name}, counted are {count}"
            for name, count in counts.items() if report.get(name) != count]


def disagreement_on_stretch(report, most):
    said = report["stretch"]["l2_max"]
    if said is None or numpy.isfinite(most) and abs(said - most) > AGREEMENT * most:
        return [f"reports L2 stretch {said}, measured is {most:.4f}"]
    return []


def check(options, output, report):
    """What `wrapatlas check` has to say of the packing. (A reference it could have is the source:
    but that has no UVs, or others.)"""
    command = [options.wrapatlas, "check", str(output), "--resolution",
               f"{report['width']}x{report['height']}", "--padding", str(report["padding"]),
               "--wrap", report["wrap"], "--findings", "3"]
    try:
        measure.run(command, "check")
    except measure.Failure as failure:
        return [" ".join(str(failure).replace(f"{output}: ", "").split())]
    return []


def by_xatlas(options, group, path, folder):
    """Needs of the options: limit. xatlas gets the mesh as it is, polygons as triangles."""
    given, taken = (pathlib.Path(folder) / name for name in ("in.npz", "out.npz"))
    try:
        source = mesh_files.read(path)
        corners, _ = fans(source)
        triangles = source.corners[corners]
        numpy.savez(given, positions=source.positions.astype(numpy.float32),
                    triangles=triangles.astype(numpy.uint32))
        measure.run([sys.executable, str(XATLAS), str(given), str(taken)], str(path), options.limit)
    except (measure.Failure, ValueError) as failure:
        return row(group, path, "xatlas", failed=without_name(path, failure))
    data = numpy.load(taken)
    result = mesh_files.Mesh(source.positions, 3 * numpy.arange(len(triangles) + 1),
                             triangles.ravel(), data["uvs"].astype(numpy.float64))
    placed = data["placed"]
    measures, folds = unfolded_measures(result.subset(placed), *data["size"].tolist())
    return row(group, path, "xatlas", measures, faces=len(triangles), folded=folds,
               left_out=int((~placed).sum()), total=float(data["seconds"]),
               megabytes=float(data["megabytes"]), failed="")
