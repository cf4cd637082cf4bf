"""glTF files made in code, for tests: a cylinder and its caps, with whatever rides on them."""

import base64
import json
import math
import struct

FORMS = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
PNG = base64.b64decode(  # one white pixel
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGP4DwABAQEAsTj2kgAAAABJRU5ErkJggg==")


class GltfMaker:
    def __init__(self):
        self.binary = bytearray()
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}],
                     "nodes": [], "meshes": [], "accessors": [], "bufferViews": []}

    def view(self, data, **more):
        self.binary += bytes(-len(self.binary) % 4)
        self.json["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data), **more})
        self.binary += data
        return len(self.json["bufferViews"]) - 1

    def accessor(self, rows, component=5126, target=34962, **more):
        rows = [row if isinstance(row, (tuple, list)) else (row,) for row in rows]
        width = len(rows[0])
        size = struct.calcsize(FORMS[component]) * width
        pad = -size % 4 if target == 34962 else 0
        data = b"".join(struct.pack(f"<{width}{FORMS[component]}{pad}x", *row) for row in rows)
        view = {"target": target} if target else {}
        if pad:
            view["byteStride"] = size + pad
        kind = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}[width]
        self.json["accessors"].append({"bufferView": self.view(data, **view), "count": len(rows),
                                       "componentType": component, "type": kind, **more})
        return len(self.json["accessors"]) - 1

    def positions(self, rows):
        rows = [struct.unpack("<3f", struct.pack("<3f", *row)) for row in rows]
        return self.accessor(rows, min=list(map(min, zip(*rows))), max=list(map(max, zip(*rows))))

    def indices(self, values, component=5123):
        return self.accessor(values, component, 34963)

    def mesh(self, *primitives, **more):
        self.json["meshes"].append({"primitives": list(primitives), **more})
        return len(self.json["meshes"]) - 1

    def node(self, **more):
        self.json["nodes"].append(more)
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)
        return len(self.json["nodes"]) - 1

    def textured_material(self, sampler=None, extensions=None):
        """A material whose texture clamps unless told otherwise."""
        self.json["images"] = [{"bufferView": self.view(PNG), "mimeType": "image/png"}]
        self.json["samplers"] = [sampler or {"wrapS": 33071, "wrapT": 33071}]
        self.json["textures"] = [{"source": 0, "sampler": 0}]
        texture = {"index": 0}
        if extensions:
            texture["extensions"] = extensions
            self.json["extensionsUsed"] = sorted(extensions)
        self.json["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": texture}}]
        return 0

    def document(self, uri=None):
        buffer = {"byteLength": len(self.binary)}
        if uri:
            buffer["uri"] = uri
        return json.dumps({**self.json, "buffers": [buffer]})

    def glb(self):
        text = self.document().encode()
        text += b" " * (-len(text) % 4)
        binary = bytes(self.binary) + bytes(-len(self.binary) % 4)
        return (struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(binary), len(text),
                            0x4E4F534A)
                + text + struct.pack("<II", len(binary), 0x004E4942) + binary)


class Can:
    """A cylinder with caps: three charts, with vertices split along the seams."""

    def __init__(self, sides=12):
        self.positions, self.normals, self.tangents, self.uvs, self.triangles = [], [], [], [], []
        for k in range(sides + 1):
            angle = 2 * math.pi * (k % sides) / sides
            x, z = math.cos(angle), math.sin(angle)
            for y in (0.0, 2.0):
                self.add((x, y, z), (x, 0.0, z), (-z, 0.0, x, 1.0), (0.5 * k / sides, y / 12.6))
        for k in range(sides):
            low = 2 * k
            self.triangles += [(low, low + 1, low + 2), (low + 2, low + 1, low + 3)]
        for y, up, centre in ((0.0, -1.0, 0.2), (2.0, 1.0, 0.6)):
            first = len(self.positions)
            for k in range(sides):
                angle = 2 * math.pi * k / sides
                x, z = math.cos(angle), math.sin(angle)
                self.add((x, y, z), (0.0, up, 0.0), (1.0, 0.0, 0.0, 1.0),
                         (centre + x / 12.6, 0.6 - up * z / 12.6))
            for k in range(1, sides - 1):
                triangle = (first, first + k + 1, first + k)
                self.triangles.append(triangle if up > 0 else triangle[::-1])

    def add(self, position, normal, tangent, uv):
        self.positions.append(position)
        self.normals.append(normal)
        self.tangents.append(tangent)
        self.uvs.append(uv)

    def corners(self):
        return [k for triangle in self.triangles for k in triangle]

    def attributes(self, maker):
        return {"POSITION": maker.positions(self.positions), "NORMAL": maker.accessor(self.normals),
                "TEXCOORD_0": maker.accessor(self.uvs)}


def plain(component=5123):
    maker, can = GltfMaker(), Can()
    maker.node(mesh=maker.mesh({"attributes": can.attributes(maker),
                                "indices": maker.indices(can.corners(), component)}))
    return maker


def unindexed():
    maker, can = GltfMaker(), Can()
    rows = {"POSITION": maker.positions([can.positions[k] for k in can.corners()]),
            "TEXCOORD_0": maker.accessor([can.uvs[k] for k in can.corners()])}
    maker.node(mesh=maker.mesh({"attributes": rows}))
    return maker


def textured(transform=False):
    maker, can = GltfMaker(), Can()
    extensions = {"KHR_texture_transform": {"offset": [0.25, 0.5], "scale": [2, 2]}}
    primitive = {"attributes": can.attributes(maker), "indices": maker.indices(can.corners()),
                 "material": maker.textured_material(extensions=extensions if transform else None)}
    primitive["attributes"]["TANGENT"] = maker.accessor(can.tangents)
    primitive["attributes"]["COLOR_0"] = maker.accessor([(255, k, 0, 255) for k in range(
        len(can.positions))], 5121, normalized=True)
    maker.node(mesh=maker.mesh(primitive, name="can"), name="node", extras={"kept": 1})
    return maker


def skinned():
    maker, can = GltfMaker(), Can()
    attributes = can.attributes(maker)
    attributes["JOINTS_0"] = maker.accessor([(0, 1, 0, 0)] * len(can.positions), 5121)
    attributes["WEIGHTS_0"] = maker.accessor(
        [(1 - y / 2, y / 2, 0.0, 0.0) for _, y, _ in can.positions])
    mesh = maker.mesh({"attributes": attributes, "indices": maker.indices(can.corners())})
    matrix = tuple(float(i % 5 == 0) for i in range(16))
    inverse = maker.accessor([matrix, matrix], target=None)
    root = maker.node(children=[1])
    maker.json["nodes"].append({"translation": [0, 1, 0]})
    maker.json["skins"] = [{"joints": [root, 1], "inverseBindMatrices": inverse}]
    maker.node(mesh=mesh, skin=0)
    times = maker.accessor([0.0, 1.0], target=None, min=[0], max=[1])
    turns = maker.accessor([(0.0, 0.0, 0.0, 1.0), (0.0, 1.0, 0.0, 0.0)], target=None)
    maker.json["animations"] = [{
        "samplers": [{"input": times, "output": turns}],
        "channels": [{"sampler": 0, "target": {"node": 1, "path": "rotation"}}]}]
    return maker


def morphed():
    maker, can = GltfMaker(), Can()
    targets = [{"POSITION": maker.positions([(0.1 * x, 0.0, shift * z)
                                             for x, _, z in can.positions]),
                "NORMAL": maker.accessor([(0.0, 0.1, 0.0)] * len(can.positions))}
               for shift in (0.1, 0.3)]
    maker.node(mesh=maker.mesh(
        {"attributes": can.attributes(maker), "indices": maker.indices(can.corners()),
         "targets": targets}, weights=[0.5, 0.0], extras={"targetNames": ["a", "b"]}))
    return maker


def instanced():
    """One mesh in three nodes, one of them drawn many times, and two primitives on one buffer."""
    maker, can = GltfMaker(), Can()
    attributes = can.attributes(maker)
    corners = can.corners()
    mesh = maker.mesh({"attributes": attributes, "indices": maker.indices(corners[:72])},
                      {"attributes": attributes, "indices": maker.indices(corners[72:])})
    for k in range(2):
        maker.node(mesh=mesh, translation=[3 * k, 0, 0])
    places = maker.accessor([(0.0, 0.0, 3.0), (3.0, 0.0, 3.0)], target=None)
    maker.json["extensionsUsed"] = ["EXT_mesh_gpu_instancing"]
    maker.node(mesh=mesh, extensions={"EXT_mesh_gpu_instancing": {
        "attributes": {"TRANSLATION": places}}})
    return maker


def normalized_uvs():
    maker, can = GltfMaker(), Can()
    attributes = can.attributes(maker)
    attributes["TEXCOORD_0"] = maker.accessor(
        [tuple(round(65535 * x) for x in uv) for uv in can.uvs], 5123, normalized=True)
    maker.node(mesh=maker.mesh({"attributes": attributes, "indices": maker.indices(can.corners())}))
    return maker


def quantized(positions=5122, normalized=True, normals=False):
    """Positions, UVs and at will normals as integers, at a coarseness that rounding shows at."""
    maker, can = GltfMaker(), Can()
    one = {5120: 127, 5121: 255, 5122: 32767, 5123: 65535}[positions]
    size = one if normalized else 100
    rows = [tuple(round(size * c) for c in ((x + 1) / 2, y / 2, (z + 1) / 2))
            for x, y, z in can.positions]
    attributes = {"POSITION": maker.accessor(
        rows, positions, normalized=normalized, min=list(map(min, zip(*rows))),
        max=list(map(max, zip(*rows))))}
    if normals:
        attributes["NORMAL"] = maker.accessor(
            [tuple(round(127 * c) for c in row) for row in can.normals], 5120, normalized=True)
    attributes["TEXCOORD_0"] = maker.accessor(
        [tuple(round(32767 * x) for x in uv) for uv in can.uvs], 5122, normalized=True)
    maker.node(mesh=maker.mesh({"attributes": attributes, "indices": maker.indices(can.corners())}))
    maker.json["extensionsUsed"] = maker.json["extensionsRequired"] = ["KHR_mesh_quantization"]
    return maker


def two_uv_sets():
    maker, can = GltfMaker(), Can()
    attributes = can.attributes(maker)
    attributes["TEXCOORD_1"] = maker.accessor([(v / 2, u / 2) for u, v in can.uvs])
    maker.node(mesh=maker.mesh({"attributes": attributes, "indices": maker.indices(can.corners())}))
    return maker


def strip_and_fan():
    """The wall as a triangle strip, a cap as a fan."""
    maker, can = GltfMaker(), Can()
    attributes = can.attributes(maker)
    maker.node(mesh=maker.mesh(
        {"attributes": attributes, "indices": maker.indices(list(range(26))), "mode": 5},
        {"attributes": attributes, "indices": maker.indices(list(range(26, 38))), "mode": 6}))
    return maker


MODELS = {"plain": plain, "bytes": lambda: plain(5121), "words": lambda: plain(5125),
          "unindexed": unindexed, "textured": textured,
          "transformed": lambda: textured(transform=True), "skinned": skinned, "morphed": morphed,
          "instanced": instanced, "normalized": normalized_uvs, "quantized": quantized,
          "quantized_words": lambda: quantized(5123, False),
          "quantized_bytes": lambda: quantized(5120, True, normals=True), "two_uv_sets": two_uv_sets,
          "strip_and_fan": strip_and_fan}
