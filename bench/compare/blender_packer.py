"""Blender's Pack Islands on the charts of an OBJ, by PyPI's `bpy`: concave shapes, any rotation, the
margin as an exact share of the page (it searches the scale at which that holds), one call.

The mesh that Blender gets has a vertex of its own for each vertex of a chart, so that its islands are
the charts. Its margin is kept between islands and to the border of the page alike."""

import contextlib
import os
import time

import bpy
import numpy


@contextlib.contextmanager
def silence():
    """Blender talks to standard output past Python."""
    kept, null = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        os.close(null)


def pack(charts, padding, **_):
    """(UVs, None, seconds, seconds): the scale is Blender's own to find."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    mesh = bpy.data.meshes.new("charts")
    points = numpy.column_stack([charts.uvs / charts.resolution, numpy.zeros(len(charts.uvs))])
    mesh.from_pydata(points.tolist(), [], charts.corners)
    layer = mesh.uv_layers.new()
    vertices = numpy.concatenate([numpy.array(own) for own in charts.corners])
    layer.data.foreach_set("uv", points[vertices, :2].astype(numpy.float32).ravel())
    model = bpy.data.objects.new("charts", mesh)
    bpy.context.collection.objects.link(model)
    bpy.context.view_layer.objects.active = model
    model.select_set(True)
    bpy.context.scene.tool_settings.use_uv_select_sync = True
    with silence():
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        begin = time.monotonic()
        bpy.ops.uv.pack_islands(
            udim_source="CLOSEST_UDIM", rotate=True, rotate_method="ANY", scale=True,
            merge_overlap=False, margin_method="FRACTION", margin=padding / charts.resolution,
            pin=False, shape_method="CONCAVE")
        seconds = time.monotonic() - begin
        bpy.ops.object.mode_set(mode="OBJECT")
    uvs = numpy.empty(2 * len(vertices), dtype=numpy.float32)
    mesh.uv_layers.active.data.foreach_get("uv", uvs)
    placed = numpy.full((len(charts.uvs), 2), numpy.nan)
    placed[vertices] = uvs.reshape(-1, 2)
    return placed, None, seconds, seconds
