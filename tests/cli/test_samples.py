"""The sample models: made anew they are the committed bytes; their charts are what README says."""

import collections
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

SAMPLES = pathlib.Path(__file__).resolve().parents[2] / "samples"
Model = collections.namedtuple("Model", "positions uvs faces groups materials")
# A face is a list of (position, UV) indices; a UV index is None where there is none.


def read_obj(name):
    model = Model([], [], [], [], set())
    for line in (SAMPLES / name).read_text().splitlines():
        word, *rest = line.split()
        if word == "v":
            model.positions.append(tuple(map(float, rest)))
        elif word == "vt":
            model.uvs.append(tuple(map(float, rest)))
        elif word == "f":
            model.faces.append([tuple(int(k) - 1 for k in corner.split("/")) for corner in rest])
        elif word == "o":
            model.groups.append(rest[0])
        elif word == "usemtl":
            model.materials.add(rest[0])
    return model


def read_off(name):
    words = (SAMPLES / name).read_text().split()
    vertices, faces = int(words[1]), int(words[2])
    numbers = list(map(float, words[4 : 4 + 3 * vertices]))
    model = Model([tuple(numbers[i : i + 3]) for i in range(0, len(numbers), 3)], [], [], [], set())
    at = 4 + 3 * vertices
    for _ in range(faces):
        count = int(words[at])
        model.faces.append([(int(k), None) for k in words[at + 1 : at + 1 + count]])
        at += 1 + count
    return model


def from_vertices(points, uvs, indices):
    """A model whose vertices were split along seams: welded again by their coordinates."""
    weld = {}
    for point in points:
        weld.setdefault(point, len(weld))
    faces = [[(weld[points[k]], k) for k in indices[i : i + 3]] for i in range(0, len(indices), 3)]
    return Model(list(weld), uvs, faces, [], set())


def read_ply(name):
    header, data = (SAMPLES / name).read_bytes().split(b"end_header\n", 1)
    counts = [int(line.split()[2]) for line in header.decode().splitlines()
              if line.startswith("element")]
    rows = list(struct.iter_unpack("<5f", data[: 20 * counts[0]]))
    faces = struct.iter_unpack("<B3i", data[20 * counts[0] :])
    return from_vertices([row[:3] for row in rows], [row[3:] for row in rows],
                         [k for row in faces for k in row[1:]])


def read_glb(name):
    data = (SAMPLES / name).read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    document = json.loads(data[20 : 20 + length])
    binary = data[28 + length :]

    def values(accessor, form):
        entry = document["accessors"][accessor]
        view = document["bufferViews"][entry["bufferView"]]
        part = binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
        return list(struct.iter_unpack(form, part))[: entry["count"]]

    uvs = [(u, 1 - v) for u, v in values(2, "<2f")]
    return from_vertices(values(1, "<3f"), uvs, [k for (k,) in values(0, "<H")])


def charts_of(model):
    """Lists of faces that are connected by edges on which position and UV agree."""
    by_edge = collections.defaultdict(list)
    for index, face in enumerate(model.faces):
        for a, b in zip(face, face[1:] + face[:1]):
            by_edge[tuple(sorted((a[0], b[0]))), tuple(sorted((a[1], b[1])))].append(index)
    parent = list(range(len(model.faces)))

    def root(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    for faces in by_edge.values():
        for other in faces[1:]:
            parent[root(other)] = root(faces[0])
    charts = collections.defaultdict(list)
    for index, face in enumerate(model.faces):
        charts[root(index)].append(face)
    return list(charts.values())


def area_3d(points):
    total = [0.0, 0.0, 0.0]
    for p, q in zip(points, points[1:] + points[:1]):
        total = [total[0] + p[1] * q[2] - p[2] * q[1], total[1] + p[2] * q[0] - p[0] * q[2],
                 total[2] + p[0] * q[1] - p[1] * q[0]]
    return math.sqrt(sum(x * x for x in total)) / 2


def area_2d(points):
    return sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(points, points[1:] + points[:1])) / 2


def volume(model):
    """Enclosed volume, positive if faces are counter-clockwise from outside."""
    total = 0.0
    for face in model.faces:
        a, *rest = [model.positions[p] for p, _ in face]
        for b, c in zip(rest, rest[1:]):
            total += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                      + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
    return total


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])


def outline(faces, uvs):
    """The border edges of faces, as pairs of points."""
    edges = [(a[1], b[1]) for face in faces for a, b in zip(face, face[1:] + face[:1])]
    inner = set(edges)
    return [(uvs[a], uvs[b]) for a, b in edges if (b, a) not in inner]


def crossings(edges):
    """How many pairs of edges cross properly: not at a common end, nor by rounding alone."""
    cell = max(max(abs(a[0] - b[0]), abs(a[1] - b[1])) for a, b in edges) / 2 + 1e-3
    grid, pairs = collections.defaultdict(list), set()
    for index, (a, b) in enumerate(edges):
        for x in range(int(min(a[0], b[0]) / cell), int(max(a[0], b[0]) / cell) + 1):
            for y in range(int(min(a[1], b[1]) / cell), int(max(a[1], b[1]) / cell) + 1):
                grid[x, y].append(index)
    for indices in grid.values():
        for i, first in enumerate(indices):
            (a, b) = edges[first]
            for second in indices[i + 1 :]:
                c, d = edges[second]
                if {a, b} & {c, d}:
                    continue
                sides = turn(a, b, c) * turn(a, b, d), turn(c, d, a) * turn(c, d, b)
                if max(sides) < -1e-20:
                    pairs.add((first, second))
    return len(pairs)


class SamplesAreReproducible(unittest.TestCase):
    def test_same_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-B", SAMPLES / "make_samples.py", folder], check=True)
            made = sorted(pathlib.Path(folder).iterdir())
            self.assertEqual([p.name for p in made],
                             ["coral.glb", "knot.off", "machine.mtl", "machine.obj", "mosaic.ply"])
            for path in made:
                self.assertEqual(path.read_bytes(), (SAMPLES / path.name).read_bytes(), path.name)

    def test_small(self):
        sizes = [p.stat().st_size for p in SAMPLES.iterdir() if p.is_file()]
        self.assertLess(max(sizes), 700_000)
        self.assertLess(sum(sizes), 1_500_000)


class SampleShapes(unittest.TestCase):
    def check_watertight(self, model):
        edges = collections.Counter()
        for face in model.faces:
            self.assertEqual(len({p for p, _ in face}), len(face))
            for a, b in zip(face, face[1:] + face[:1]):
                edges[a[0], b[0]] += 1
        for (a, b), count in edges.items():
            self.assertEqual((count, edges[b, a]), (1, 1))
        self.assertGreater(volume(model), 0)

    def check_charts(self, model, tolerance):
        """Returns chart areas in space; checks flips, overlap, and one density for all charts."""
        charts = charts_of(model)
        areas, densities, edges = [], [], []
        for faces in charts:
            flat = [[model.uvs[q] for _, q in face] for face in faces]
            for polygon in flat:
                self.assertGreater(area_2d(polygon), 0)
            areas.append(sum(area_3d([model.positions[p] for p, _ in face]) for face in faces))
            densities.append(sum(map(area_2d, flat)) / areas[-1])
            edges += outline(faces, model.uvs)
        # Charts without flips whose outlines nowhere cross do not overlap, each alone and together.
        self.assertEqual(crossings(edges), 0)
        self.assertLess(max(densities) / min(densities), 1 + tolerance)
        for u, v in model.uvs:
            self.assertTrue(0 <= u <= 1 and 0 <= v <= 1)
        return areas

    def test_coral(self):
        model = read_glb("coral.glb")
        self.check_watertight(model)
        self.assertEqual((len(model.faces), len(self.check_charts(model, 0.01))), (6904, 5))

    def test_machine(self):
        model = read_obj("machine.obj")
        self.check_watertight(model)
        self.assertEqual((len(model.faces), len(self.check_charts(model, 0.02))), (3768, 83))
        self.assertEqual((len(model.groups), len(model.materials)), (15, 3))
        self.assertEqual({3, 4} | {len(f) for f in model.faces if len(f) > 4},
                         {len(f) for f in model.faces})
        self.assertGreater(max(map(len, model.faces)), 20)

    def test_mosaic(self):
        model = read_ply("mosaic.ply")
        self.check_watertight(model)
        areas = self.check_charts(model, 0.05)
        self.assertEqual((len(model.faces), len(areas)), (11520, 360))
        self.assertGreater(max(areas) / min(areas), 100)

    def test_knot(self):
        model = read_off("knot.off")
        self.check_watertight(model)
        self.assertEqual(len(model.faces), 3360)
        euler = len(model.positions) - 2 * len(model.faces) + len(model.faces)
        self.assertEqual(euler, 0)


if __name__ == "__main__":
    unittest.main()
