"""Small good files, for tests to break."""

import json
import struct

from support import obj, square

GOOD = obj([square(), square(2)])
PLY_HEADER = ("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
              "property float z\nproperty float s\nproperty float t\nelement face 1\n"
              "property list uchar int vertex_indices\nend_header\n")
PLY = PLY_HEADER + "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n"
STOFF = "STOFF\n3 1 0\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n"
STL = ("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
       "endloop\nendfacet\nendsolid a\n")
BINARY_STL = bytes(80) + struct.pack("<I12fH", 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)


def gltf(positions=((0, 0, 0), (1, 0, 0), (0, 1, 0)), uvs=((0, 0), (1, 0), (0, 1)),
         indices=(0, 1, 2)):
    """A glTF and its .bin."""
    parts = [struct.pack(f"<{3 * len(positions)}f", *sum(positions, ())),
             struct.pack(f"<{2 * len(uvs)}f", *sum(uvs, ())),
             struct.pack(f"<{len(indices)}I", *indices)]
    views, offset = [], 0
    for part in parts:
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": len(part)})
        offset += len(part)
    document = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": offset, "uri": "bad.bin"}],
        "bufferViews": views,
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(positions), "type": "VEC3",
             "min": [0, 0, 0], "max": [1, 1, 0]},
            {"bufferView": 1, "componentType": 5126, "count": len(uvs), "type": "VEC2"},
            {"bufferView": 2, "componentType": 5125, "count": len(indices), "type": "SCALAR"}],
        "meshes": [{"primitives": [
            {"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2}]}],
    }
    return json.dumps(document), b"".join(parts)
