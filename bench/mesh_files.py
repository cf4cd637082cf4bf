"""Meshes as numpy arrays, and reading them from OBJ and OFF files.

Corners of faces stand one after the other: face f has those from begins[f] to begins[f + 1].
"""

import dataclasses

import numpy


@dataclasses.dataclass
class Mesh:
    positions: numpy.ndarray  # a row of three for each vertex, in the file's units
    begins: numpy.ndarray  # per face its first corner, and at the end the number of corners
    corners: numpy.ndarray  # per corner the number of its position
    uvs: numpy.ndarray = None  # per corner (u, v), NaN where it has none; None: no face has any

    def sizes(self):
        """Per face, its number of corners."""
        return numpy.diff(self.begins)

    def corner_positions(self):
        return self.positions[self.corners]

    def subset(self, faces):
        """The faces that are marked, with all vertices."""
        of_corner = numpy.repeat(faces, self.sizes())
        return Mesh(self.positions, begins_of(self.sizes()[faces]), self.corners[of_corner],
                    None if self.uvs is None else self.uvs[of_corner])


def begins_of(sizes):
    return numpy.concatenate([[0], numpy.cumsum(sizes)]).astype(numpy.int64)


def numbers(words, columns):
    """Rows of numbers from a list of lines, of each its first words."""
    flat = [word for line in words for word in line[:columns]]
    return numpy.array(flat, dtype=numpy.float64).reshape(-1, columns)


def read(path):
    """A Mesh. Raises ValueError where the file is no OBJ or OFF as these scripts need them."""
    readers = {".obj": read_obj, ".off": read_off}
    if path.suffix.lower() not in readers:
        raise ValueError(f"{path}: only OBJ and OFF files can be measured")
    return readers[path.suffix.lower()](path)


def read_off(path):
    words = path.read_text().split("\n")
    words = " ".join(line.split("#")[0] for line in words).split()
    vertices, faces = int(words[1]), int(words[2])
    body = numpy.array(words[4:], dtype=numpy.float64)
    positions, body = body[:3 * vertices].reshape(-1, 3), body[3 * vertices:].astype(numpy.int64)
    if len(body) == 4 * faces and (body[::4] == 3).all():
        return Mesh(positions, 3 * numpy.arange(faces + 1), body.reshape(-1, 4)[:, 1:].ravel())
    sizes, corners, at = [], [], 0
    for _ in range(faces):
        sizes.append(body[at])
        corners.append(body[at + 1:at + 1 + body[at]])
        at += 1 + body[at]
    return Mesh(positions, begins_of(sizes), numpy.concatenate([body[:0], *corners]))


def read_obj(path):
    kinds = {"v": [], "vt": [], "f": []}
    for line in path.read_text(encoding="utf-8", errors="replace").split("\n"):
        word, *rest = line.split() or [""]
        if word in kinds:
            kinds[word].append(rest)
    sizes = [len(face) for face in kinds["f"]]
    corners, uvs = obj_corners([corner for face in kinds["f"] for corner in face])
    if (corners < 0).any():
        raise ValueError(f"{path}: faces that count backwards are not read here")
    if (uvs >= 0).any():
        table = numpy.vstack([numbers(kinds["vt"], 2), [numpy.nan, numpy.nan]])
        uvs = table[uvs]  # -1, the last: none
    else:
        uvs = None
    return Mesh(numbers(kinds["v"], 3), begins_of(sizes), corners, uvs)


def obj_corners(words):
    """The numbers of the positions and of the UVs of corners like 3, 3/4, 3//5 and 3/4/5."""
    if words and all(word.count("/") == 1 for word in words):
        pairs = numpy.array(" ".join(words).replace("/", " ").split(), dtype=numpy.int64)
        return pairs[0::2] - 1, pairs[1::2] - 1
    parts = [word.split("/") for word in words]
    uvs = [int(part[1]) if len(part) > 1 and part[1] else 0 for part in parts]
    return (numpy.array([int(part[0]) for part in parts], dtype=numpy.int64) - 1,
            numpy.array(uvs, dtype=numpy.int64) - 1)
