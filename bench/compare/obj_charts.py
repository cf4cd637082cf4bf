"""The charts of an OBJ, as other packers take them, and the OBJ again with other UVs."""

import math

import numpy
from union_find import UnionFind


class Obj:
    """An OBJ's lines, and its charts: faces joined by edges at which position and UV agree."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            self.lines = file.read().splitlines()
        self.positions, self.uvs, self.faces, self.objects = [], [], [], []
        current = 0
        for line in self.lines:
            word, *rest = line.split() or [""]
            if word == "v":
                self.positions.append(tuple(map(float, rest[:3])))
            elif word == "vt":
                self.uvs.append(tuple(map(float, rest[:2])))
            elif word == "o":
                current += 1
            elif word == "f":
                self.faces.append([self.corner(corner) for corner in rest])
                self.objects.append(current)
        self.charts = self.chart_of_each_face()

    def corner(self, text):
        position, uv = (int(part) for part in text.split("/")[:2])
        return (position - 1 if position > 0 else len(self.positions) + position,
                uv - 1 if uv > 0 else len(self.uvs) + uv)

    def chart_of_each_face(self):
        connected, first_at = UnionFind(range(len(self.faces))), {}
        for face, corners in enumerate(self.faces):
            ends = [(self.positions[p], self.uvs[t]) for p, t in corners]
            for a, b in zip(ends, ends[1:] + ends[:1]):
                key = (self.objects[face], *sorted((a, b)))
                connected.join(face, first_at.setdefault(key, face))
        return [connected.root(face) for face in range(len(self.faces))]

    def text(self, uv_of):
        """The OBJ with new UVs: uv_of[face][corner]."""
        out, face, numbers = [], 0, {}
        for line in self.lines:
            word, *rest = line.split() or [""]
            if word == "f":
                corners = []
                for text, uv in zip(rest, uv_of[face]):
                    if uv not in numbers:
                        numbers[uv] = len(numbers) + 1
                        out.append(f"vt {uv[0]:.9g} {uv[1]:.9g}")
                    position, _, *normal = text.split("/")
                    corners.append("/".join([position, str(numbers[uv]), *normal]))
                out.append("f " + " ".join(corners))
                face += 1
            elif word != "vt":
                out.append(line)
        return "\n".join(out) + "\n"


class Charts:
    """The charts of an OBJ as one UV mesh, in units in which they would just fill the page.

    uvs: a row for each vertex; triangles: three vertices each, with their chart in materials;
    corners: the vertices of each face of the OBJ; areas: of each chart."""

    def __init__(self, obj, resolution):
        self.obj, self.resolution = obj, resolution
        numbers, uvs, triangles, materials, self.corners = {}, [], [], [], []
        for corners, chart in zip(obj.faces, obj.charts):
            own = []
            for _, t in corners:
                # A vertex belongs to one chart.
                key = (chart, obj.uvs[t])
                if key not in numbers:
                    numbers[key] = len(uvs)
                    uvs.append(obj.uvs[t])
                own.append(numbers[key])
            self.corners.append(own)
            for k in range(1, len(own) - 1):
                triangles.append((own[0], own[k], own[k + 1]))
                materials.append(chart)
        uvs = numpy.array(uvs, dtype=numpy.float64)
        self.triangles = numpy.array(triangles, dtype=numpy.uint32)
        _, chart = numpy.unique(materials, return_inverse=True)
        self.materials = chart.astype(numpy.uint32).reshape(-1, 1)
        self.areas = self.areas_of(uvs)
        # Packers take small faces, or those of charts in small units, as without area.
        self.unit = resolution / math.sqrt(self.areas.sum())
        self.areas *= self.unit ** 2
        self.uvs = (uvs - uvs.min(axis=0)) * self.unit

    def areas_of(self, uvs):
        a, b, c = (uvs[self.triangles[:, k]] for k in range(3))
        twice = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
        return numpy.bincount(self.materials[:, 0], numpy.abs(twice) / 2)

    def obj_text(self, placed):
        """The OBJ with these UVs, a row for each vertex."""
        points = [tuple(point) for point in placed.tolist()]
        return self.obj.text([[points[k] for k in own] for own in self.corners])
