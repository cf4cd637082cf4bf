"""What cannot be used is refused in one line, and nothing crashes."""

import pathlib
import random
import unittest

import numpy as np
import shapes

import wrapatlas
from wrapatlas._errors import as_python, make

FLAT, FACES = shapes.scattered_squares()
POSITIONS, TRIANGLES = shapes.square()
KNOT = pathlib.Path(__file__).resolve().parents[2] / "samples/knot.off"


class Arrays(unittest.TestCase):
    def refused(self, pattern, call, *arrays, **options):
        with self.assertRaisesRegex(ValueError, pattern) as caught:
            call(*arrays, **options)
        self.assertIsInstance(caught.exception, wrapatlas.Error)
        self.assertNotIn("\n", str(caught.exception))

    def test_shapes(self):
        for call, good, name in ((wrapatlas.pack, FLAT, "uv"),
                                 (wrapatlas.unwrap, POSITIONS, "positions")):
            width = good.shape[1]
            self.refused(rf"{name}: its shape is .*; pass \(N, {width}\)", call, good[:, :1], FACES)
            self.refused(f"{name}: its shape is", call, good[None], FACES)
            self.refused(f"{name}: its shape is", call, good.ravel(), FACES)
            self.refused("faces: its shape is", call, good, TRIANGLES[:, :2])
            self.refused("faces: its shape is", call, good, TRIANGLES.ravel())
            self.refused("faces: its shape is", call, good, TRIANGLES[None])

    def test_masked(self):
        masked = np.ma.masked_array(FLAT, mask=np.zeros_like(FLAT, bool))
        wrapatlas.pack(masked, FACES, time=0, resolution=64)  # nothing is
        masked[0, 0] = np.ma.masked
        self.refused("uv: some of it is masked", wrapatlas.pack, masked, FACES)

    def test_types(self):
        for call, good in ((wrapatlas.pack, FLAT), (wrapatlas.unwrap, POSITIONS)):
            self.refused("its dtype is complex128", call, good.astype(complex), TRIANGLES)
            self.refused("its dtype is", call, [["a", "b", "c"]], TRIANGLES)
            self.refused("its dtype is bool", call, good > 0, TRIANGLES)
            self.refused("its dtype is object", call, good.astype(object), TRIANGLES)
            self.refused("faces: its dtype is float64", call, good, TRIANGLES + 0.5)
            self.refused("faces: its dtype is", call, good, TRIANGLES.astype(str))
            self.refused("rows differ in length", call, [[0, 0, 0], [1]], TRIANGLES)
            self.refused("faces: its dtype is", call, good, TRIANGLES * np.nan)

    def test_content(self):
        for call, good in ((wrapatlas.pack, FLAT), (wrapatlas.unwrap, POSITIONS)):
            for bad in (np.nan, np.inf, 1e30):
                broken = good.copy()
                broken[2, 1] = bad
                self.refused("2: a coordinate is NaN, infinite or beyond 1e30", call, broken,
                             TRIANGLES)
            self.refused(r"faces\[0, 1\]: index 1000 is out of range; there are \d+", call, good,
                         TRIANGLES * 1000)
            self.refused(r"faces\[0, 1\]: index -1 is out of range", call, good, -TRIANGLES)
            self.refused("out of range", call, good, TRIANGLES + (np.int64(1) << 32))
            self.refused("out of range", call, good, TRIANGLES + (np.int64(1) << 62))
            self.refused("infinite or too large", call, good, np.full((1, 3), 1e300))
            self.refused("there are no faces", call, good, TRIANGLES[:0])
            self.refused("there are no faces", call, good, [])
            self.refused("empty|no rows|there are no", call, [], TRIANGLES)
            self.refused("there are no", call, good[:0], TRIANGLES)

    def test_meshes(self):
        self.refused("faces: there are none", wrapatlas.pack, FLAT)
        self.refused("faces: there are none", wrapatlas.unwrap, POSITIONS)
        self.refused("is no mesh", wrapatlas.pack, None)
        self.refused("is no mesh", wrapatlas.check, 3)
        self.refused("no face has", wrapatlas.pack, wrapatlas.Mesh(POSITIONS, TRIANGLES))
        self.refused("no face has UVs", wrapatlas.check, wrapatlas.Mesh(POSITIONS, TRIANGLES))
        self.refused("for 48 positions|for 4 positions", wrapatlas.Mesh, POSITIONS, TRIANGLES, FLAT)
        self.refused("uv_faces: its shape", wrapatlas.Mesh, POSITIONS, TRIANGLES, FLAT,
                     TRIANGLES[:1])
        self.refused(r"uv_faces\[", wrapatlas.Mesh, POSITIONS, TRIANGLES, FLAT, TRIANGLES + 99)
        self.refused("area", wrapatlas.pack, np.zeros((4, 2)), TRIANGLES)
        self.refused("area|no faces", wrapatlas.unwrap, np.zeros((4, 3)), TRIANGLES)
        self.refused("positions", wrapatlas.pack, FLAT, FACES, density=5)
        self.refused("there are no positions", wrapatlas.pack, FLAT, FACES, None, FACES)
        packing = wrapatlas.pack(FLAT, FACES, time=0)
        self.refused("pass positions=", packing.save, "a.obj")
        self.refused("pass positions=", lambda: packing.positions)
        self.refused("a row for each", packing.interpolate, [1.0])
        self.refused("size=", packing.image, 3)
        self.refused("size=", packing.image, 10**9)
        self.refused("end the name", packing.save_image, "a.txt")

    def test_nothing_fits(self):
        with self.assertRaises(wrapatlas.NoPacking) as caught:
            wrapatlas.pack(FLAT, FACES, resolution=8, padding=7, time=0.05)
        self.assertNotIn("--", str(caught.exception))
        positions = np.column_stack([FLAT, 0 * FLAT[:, 0]])
        with self.assertRaisesRegex(wrapatlas.NoPacking, "density=.* would fit, or raise resolution="):
            wrapatlas.pack(FLAT, FACES, positions, resolution=8, padding=1, density=1e6)

    def test_random_garbage_never_crashes(self):
        chance = random.Random(1)
        values = [None, [], "x", 3, np.zeros(0), np.zeros((3, 0)), np.zeros((0, 3)), FLAT, FACES,
                  POSITIONS, np.full((9, 3), np.nan), np.zeros((4, 3), np.int8), object(), {}, -FACES,
                  np.zeros((2, 2, 2, 2)), np.array(5), np.datetime64("2020-01-01"), b"abc"]
        for _ in range(400):
            call = chance.choice([wrapatlas.pack, wrapatlas.unwrap, wrapatlas.Mesh,
                                  wrapatlas.parametrize, wrapatlas.check, wrapatlas.render,
                                  wrapatlas.bake, wrapatlas.transfer, wrapatlas.simplify])
            arguments = [chance.choice(values) for _ in range(chance.randint(1, 4))]
            try:
                call(*arguments)
            except (ValueError, TypeError, OSError, wrapatlas.Error):
                pass


class Options(unittest.TestCase):
    def test_each_is_named(self):
        for name, value in {"padding": -1, "margin": "x", "block": 65, "rotations": 0, "grid": 1.5,
                            "method": "best", "wrap": True, "export": "both", "resolution": 0,
                            "time": float("nan"), "moves": -5, "seed": 2**40, "coverage": None,
                            "stacked": "on", "threads": 5000, "aspect": "wide", "pages": 0,
                            "density": 0, "lambda_": -1, "no_inner": 1, "check": "no",
                            "on_interrupt": "ignore", "rotation_base": "", "scale_start": 2}.items():
            with self.subTest(name), self.assertRaisesRegex(wrapatlas.UsageError, f"^{name}"):
                wrapatlas.pack(FLAT, FACES, **{name: value})
        for name, value in {"max_stretch": 0.5, "stretch": "l3", "max_charts": -1, "max_extent": -1,
                            "flatten": "abf", "iterations": 100, "hard_edges": 200, "keep_seams": 1}.items():
            with self.subTest(name), self.assertRaisesRegex(wrapatlas.UsageError, f"^{name}"):
                wrapatlas.unwrap(POSITIONS, TRIANGLES, **{name: value})

    def test_what_would_be_ignored(self):
        for options in ({"method": "modulo", "time": 1}, {"method": "guided", "lambda_": 1},
                        {"method": "swg03", "wrap": "uv"}, {"wrap": "uv", "margin": 1},
                        {"udim": True, "wrap": "u"}, {"time": 1, "moves": 5},
                        {"moves": 5, "pages": 3}, {"resolution": (64, 32), "aspect": "2:1"}):
            with self.subTest(options), self.assertRaises(wrapatlas.UsageError):
                wrapatlas.pack(FLAT, FACES, **options)
        positions = np.column_stack([FLAT, 0 * FLAT[:, 0]])
        page = wrapatlas.pack(FLAT, FACES, positions, density=4, pages=1, moves=5)
        self.assertEqual(page.pages, 1)
        with self.assertWarnsRegex(UserWarning, "one orientation"):
            wrapatlas.pack(FLAT, FACES, method="lprm02", rotations=4)
        with self.assertRaisesRegex(TypeError, "unexpected keyword argument 'paddding'"):
            wrapatlas.pack(FLAT, FACES, paddding=2)
        with self.assertRaisesRegex(TypeError, "max_stretch"):
            wrapatlas.pack(FLAT, FACES, max_stretch=2)

    def test_of_others(self):
        mesh = wrapatlas.unwrap(POSITIONS, TRIANGLES, time=0)
        image = shapes.checker()
        for call, options in (
            (wrapatlas.render, {"size": 8}), (wrapatlas.render, {"views": 65}),
            (wrapatlas.render, {"size": 4096, "views": 60}), (wrapatlas.render, {"azimuth": 500}),
            (wrapatlas.render, {"shade": "dark"}), (wrapatlas.render, {"texture": image[:, :, 0] > 0,
                                                                       "filter": "x"}),
            (wrapatlas.render, {"normal_map": image[:, :, 0]}),
            (wrapatlas.render, {"texture": np.zeros((0, 4))}),
            (wrapatlas.render, {"texture": np.zeros((4, 4, 5))}),
            (wrapatlas.check, {"padding": 5000}), (wrapatlas.check, {"resolution": "big"}),
            (wrapatlas.check, {"tolerance": -1}), (wrapatlas.check, {"wrap": "w"}),
        ):
            with self.subTest(options), self.assertRaises(ValueError):
                call(mesh, **options)
        for options in ({"map": "colour"}, {"map": []}, {"map": ["object", "object"]},
                        {"map": "color"}, {"samples": 0}, {"resolution": 70000}):
            with self.subTest(options), self.assertRaises(ValueError):
                wrapatlas.bake(mesh, mesh, **options)

    def test_sets_of_uvs_are_of_gltf(self):
        with self.assertRaisesRegex(wrapatlas.UsageError, "texcoord=1: .*knot.off can hold one UV set"):
            wrapatlas.load(KNOT, texcoord=1)

    def test_names_of_options_in_errors(self):
        self.assertEqual(as_python("raise --resolution, or lower --padding and --lambda"),
                         "raise resolution=, or lower padding= and lambda_=")
        self.assertEqual(str(make("input", "scan--wrap.obj: bad; give --wrap", "scan--wrap.obj")),
                         "scan--wrap.obj: bad; give wrap=")
        self.assertEqual(str(make("usage", "--wrap: bad", "--wrap")), "wrap=: bad")


if __name__ == "__main__":
    unittest.main()
