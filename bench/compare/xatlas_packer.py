"""xatlas' packer on the charts of an OBJ, by PyPI's `xatlas`: the charts go in as they are
(add_uv_mesh: no segmentation, no parametrization), the largest scale that fits on one page is
searched, and the result is written as the same OBJ with other UVs.

What xatlas does, from its source (version 0.0.11 of the binding):
- Padding: each chart is rasterized conservatively and dilated by `padding` texels, and the dilated
  images must not meet. Two charts are thus 2 x padding texels apart; the half of what is wanted is
  right. Its `bilinear` would add about another texel to each chart; it is off.
- Border: charts may reach the border of the page, to half a texel.
- Charts are stretched along both axes of their box to whole texels (always up).
- A chart that is longer than the page is shrunk on its own; that does not count as fitting.
- A chart is turned into its box and by a swap of x and y, which mirrors it.
- Faces without area are left out.
"""

import math
import time

import numpy
import xatlas
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
    """The charts of an OBJ as one UV mesh, in units in which they would just fill the page."""

    def __init__(self, obj, resolution):
        self.obj, self.resolution = obj, resolution
        numbers, uvs, triangles, materials, self.corners = {}, [], [], [], []
        for corners, chart in zip(obj.faces, obj.charts):
            own = []
            for _, t in corners:
                # A vertex belongs to one chart in xatlas.
                key = (chart, obj.uvs[t])
                if key not in numbers:
                    numbers[key] = len(uvs)
                    uvs.append(obj.uvs[t])
                own.append(numbers[key])
            self.corners.append(own)
            for k in range(1, len(own) - 1):
                triangles.append((own[0], own[k], own[k + 1]))
                materials.append(chart)  # keeps charts that overlap or touch in the input apart
        uvs = numpy.array(uvs, dtype=numpy.float64)
        self.triangles = numpy.array(triangles, dtype=numpy.uint32)
        _, chart = numpy.unique(materials, return_inverse=True)
        self.materials = chart.astype(numpy.uint32).reshape(-1, 1)
        self.areas = self.areas_of(uvs)
        # Else small faces, or those of charts in small units, are "without area" to xatlas.
        self.unit = resolution / math.sqrt(self.areas.sum())
        self.areas *= self.unit ** 2
        self.uvs = ((uvs - uvs.min(axis=0)) * self.unit).astype(numpy.float32)

    def areas_of(self, uvs):
        a, b, c = (uvs[self.triangles[:, k]] for k in range(3))
        twice = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
        return numpy.bincount(self.materials[:, 0], numpy.abs(twice) / 2)

    def packed(self, scale, padding, brute_force):
        """(UVs in [0, 1], seconds), or (None, seconds) where the charts do not fit at the scale."""
        options = xatlas.PackOptions()
        options.resolution, options.texels_per_unit = self.resolution, scale
        options.padding, options.bilinear = math.ceil(padding / 2), False
        options.bruteForce, options.create_image = brute_force, False
        atlas = xatlas.Atlas()
        atlas.add_uv_mesh(self.uvs, self.triangles, self.materials)
        begin = time.monotonic()
        atlas.generate(xatlas.ChartOptions(), options)
        seconds = time.monotonic() - begin
        if atlas.atlas_count != 1:
            return None, seconds
        source, _, uvs = atlas.get_mesh(0)
        placed = numpy.full((len(self.uvs), 2), numpy.nan)
        placed[source] = uvs
        # Stretching only makes charts larger; one that is smaller was shrunk to fit the page.
        areas = self.areas_of(placed) * self.resolution ** 2
        if (areas < self.areas * scale ** 2 * 0.999 - 0.01).any():
            return None, seconds
        return placed, seconds

    def searched(self, padding, brute_force, precision):
        """The densest packing on one page, by bisection over the scale.

        Gives (UVs, scale, seconds of all tries, seconds of the one that is given)."""
        best, best_scale, best_seconds, total = None, 0.0, 0.0, 0.0
        low, high = 0.0, 1.0  # at 1 the charts would fill the page
        while best is None or high - low > precision * low:
            scale = (low + high) / 2
            if scale < 1e-3:
                raise ValueError("does not fit at any scale")
            placed, seconds = self.packed(scale, padding, brute_force)
            total += seconds
            if placed is None:
                high = scale
            else:
                low, best, best_scale, best_seconds = scale, placed, scale, seconds
        return best, best_scale, total, best_seconds

    def obj_text(self, placed):
        points = [tuple(point) for point in placed.tolist()]
        return self.obj.text([[points[k] for k in own] for own in self.corners])
