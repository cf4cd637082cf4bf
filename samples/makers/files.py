"""Bytes of GLB, OBJ, MTL, PLY and OFF files."""

import json
import struct


def number(x, digits):
    text = f"{x:.{digits}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def split_vertices(positions, faces, charts):
    """One vertex per (position, chart): triangles, and rows of (position, UV)."""
    index, rows, triangles = {}, [], []
    for corners, chart, local in faces:
        triangle = []
        for position, point in zip(corners, local):
            key = (position, chart, point)
            if key not in index:
                index[key] = len(rows)
                rows.append((positions[position], charts[chart][point]))
            triangle.append(index[key])
        triangles.append(triangle)
    return rows, triangles


def glb_bytes(name, positions, faces, charts):
    rows, triangles = split_vertices(positions, faces, charts)
    place = [[round(x, 4) for x in p] for p, _ in rows]
    place = [struct.unpack("<3f", struct.pack("<3f", *p)) for p in place]
    indices = b"".join(struct.pack("<3H", *t) for t in triangles)
    indices += b"\0" * (-len(indices) % 4)
    points = b"".join(struct.pack("<3f", *p) for p in place)
    uvs = b"".join(struct.pack("<2f", round(u, 6), round(1 - v, 6)) for _, (u, v) in rows)
    views, offset = [], 0
    for part, target in ((indices, 34963), (points, 34962), (uvs, 34962)):
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": len(part), "target": target})
        offset += len(part)
    document = {
        "asset": {"version": "2.0", "generator": "wrapatlas samples/make_samples.py"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": name}],
        "meshes": [{"name": name, "primitives": [
            {"attributes": {"POSITION": 1, "TEXCOORD_0": 2}, "indices": 0, "material": 0}]}],
        "materials": [{"name": name, "pbrMetallicRoughness": {
            "baseColorFactor": [0.85, 0.42, 0.36, 1.0], "metallicFactor": 0.0,
            "roughnessFactor": 0.8}}],
        "buffers": [{"byteLength": offset}],
        "bufferViews": views,
        "accessors": [
            {"bufferView": 0, "componentType": 5123, "count": 3 * len(triangles),
             "type": "SCALAR"},
            {"bufferView": 1, "componentType": 5126, "count": len(rows), "type": "VEC3",
             "min": [min(p[axis] for p in place) for axis in range(3)],
             "max": [max(p[axis] for p in place) for axis in range(3)]},
            {"bufferView": 2, "componentType": 5126, "count": len(rows), "type": "VEC2"},
        ],
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    binary = indices + points + uvs
    return (struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary))
            + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(binary), b"BIN\0") + binary)


def obj_bytes(library, machine, charts):
    lines = [f"mtllib {library}"]
    lines += ["v " + " ".join(number(x, 4) for x in p) for p in machine.positions]
    first = [1]
    for chart in charts:
        first.append(first[-1] + len(chart))
        lines += ["vt " + " ".join(number(x, 6) for x in p) for p in chart]
    for name, material, faces in machine.objects:
        lines += [f"o {name}", f"usemtl {material}"]
        for corners, chart, local in faces:
            lines.append("f " + " ".join(f"{p + 1}/{first[chart] + q}"
                                         for p, q in zip(corners, local)))
    return ("\n".join(lines) + "\n").encode()


def mtl_bytes():
    colors = {"steel": "0.62 0.64 0.67", "brass": "0.80 0.62 0.28", "paint": "0.20 0.42 0.66"}
    return "".join(f"newmtl {name}\nKd {kd}\n" for name, kd in colors.items()).encode()


def ply_bytes(positions, faces, charts):
    rows, triangles = split_vertices(positions, faces, charts)
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(rows)}"]
    header += [f"property float {name}" for name in ("x", "y", "z", "s", "t")]
    header += [f"element face {len(triangles)}", "property list uchar int vertex_indices",
               "end_header"]
    data = b"".join(struct.pack("<5f", *(round(x, 5) for x in p), *(round(x, 6) for x in uv))
                    for p, uv in rows)
    data += b"".join(struct.pack("<B3i", 3, *t) for t in triangles)
    return ("\n".join(header) + "\n").encode() + data


def off_bytes(positions, faces):
    lines = ["OFF", f"{len(positions)} {len(faces)} 0"]
    lines += [" ".join(number(x, 4) for x in p) for p in positions]
    lines += [f"{len(f)} " + " ".join(str(k) for k in f) for f in faces]
    return ("\n".join(lines) + "\n").encode()
