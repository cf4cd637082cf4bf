"""bake, transfer, render, images."""

import tempfile
import unittest
from pathlib import Path

import numpy as np
import shapes

import wrapatlas


class Bake(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.positions, cls.faces = shapes.sphere(4000)
        cls.high = wrapatlas.Mesh(cls.positions, cls.faces)
        low = wrapatlas.simplify(cls.high, 400)
        cls.low = wrapatlas.unwrap(low, time=0.2, resolution=128)

    def test_what_lies_outside(self):
        mesh = wrapatlas.Mesh(*shapes.square(), uv=np.array([[0.5, 0], [1.5, 0], [1.5, 1], [0.5, 1]]))
        for wrap, count in (("uv", 0), ("none", 2)):
            baking = wrapatlas.bake(mesh, mesh, wrap=wrap, resolution=16)
            self.assertEqual(baking.faces_outside, count)
        self.assertEqual(repr(baking), "<wrapatlas.Baking: tangent 16 x 16>")
        self.assertNotEqual(baking, wrapatlas.bake(mesh, mesh, resolution=16))

    def test_maps(self):
        baking = wrapatlas.bake(self.low, self.high, ["tangent", "object", "position", "occlusion"],
                                occlusion_rays=8)  # at the packing's own size
        self.assertEqual(list(baking.maps), ["tangent", "object", "position", "occlusion"])
        self.assertEqual(baking.image.shape, (128, 128, 3))
        self.assertEqual(baking.maps["occlusion"].shape, (128, 128, 1))
        self.assertEqual((baking.inside.shape, baking.inside.dtype), ((128, 128), np.bool_))
        self.assertTrue(baking._repr_png_().startswith(b"\x89PNG"))
        normals = 2 * np.asarray(baking.maps["object"])[baking.inside] - 1
        np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=0.1)
        places = (np.asarray(baking.maps["position"])[baking.inside] * baking.position_extent
                  + baking.position_origin)
        self.assertTrue((np.abs(places) <= np.abs(self.positions).max() + 1e-6).all())
        with tempfile.TemporaryDirectory() as folder:
            baking.image.save(folder + "/n.png", bits=16)
            again = wrapatlas.load_image(folder + "/n.png")
            np.testing.assert_allclose(again, baking.image, atol=1 / 65535)

    def test_means_of_samples_without_fit(self):
        fitted, means = (wrapatlas.bake(self.low, self.high, "object", resolution=64, fit=fit).image
                         for fit in (True, False))
        self.assertFalse(np.array_equal(fitted, means))
        self.assertLess(abs(fitted - means).mean(), 0.02)

    def test_a_normal_map_makes_it_look_like_the_original(self):
        map = wrapatlas.bake(self.low, self.high, resolution=256).image
        view = {"size": 128, "views": 2, "framed_as": self.high}
        original = wrapatlas.render(self.high, **view).astype(float)
        plain = wrapatlas.render(self.low, **view).astype(float)
        mapped = wrapatlas.render(self.low, normal_map=map, **view).astype(float)
        self.assertLess(np.abs(mapped - original).mean(), 0.8 * np.abs(plain - original).mean())

    def test_colours(self):
        source = wrapatlas.unwrap(self.high, time=0.1)
        baking = wrapatlas.bake(self.low, source, "color", color_from=shapes.checker(),
                                resolution=64)
        colours = np.asarray(baking.image)[baking.inside]
        self.assertTrue((colours >= 0.15).all() and (colours <= 0.91).all())


class Transfer(unittest.TestCase):
    def test_it_looks_as_before(self):
        positions, faces = shapes.sphere(1000)
        before = wrapatlas.unwrap(positions, faces, time=0.1, resolution=256, wrap="none")
        texture = np.kron(shapes.checker(128), np.ones((4, 4, 1), np.uint8))
        after = wrapatlas.unwrap(positions, faces, time=0.1, max_stretch=1.2)
        moved = wrapatlas.transfer(texture, before, after, resolution=1024)
        self.assertEqual((moved.shape, moved.dtype), ((1024, 1024, 3), np.float32))
        a = wrapatlas.render(before, texture, size=128, shade="none").astype(float)
        b = wrapatlas.render(after, moved, size=128, shade="none").astype(float)
        self.assertLess(np.abs(a - b).mean(), 2)

    def test_between_formats_that_count_v_from_either_side(self):
        texture = shapes.checker()
        with tempfile.TemporaryDirectory() as folder:
            wrapatlas.unwrap(*shapes.box(), time=0).save(folder + "/a.glb")
            other = wrapatlas.load(folder + "/a.glb")
        self.assertTrue(other.v_points_down)
        uv = np.column_stack([other.uv[:, 0], 1 - other.uv[:, 1]])
        mesh = wrapatlas.Mesh(other.positions, other.faces, uv, other.uv_faces)
        same = wrapatlas.transfer(texture, mesh, mesh, resolution=64)
        for before, after in ((mesh, other), (other, mesh), (other, other)):
            moved = wrapatlas.transfer(texture, before, after, resolution=64)
            np.testing.assert_allclose(moved, same, atol=0.02)

    def test_several_textures(self):
        positions, faces = shapes.box()
        mesh = wrapatlas.unwrap(positions, faces, time=0, hard_edges=45)
        which = np.arange(12) // 2 % 2
        red, grey = np.full((4, 4, 3), [255, 0, 0], np.uint8), np.full((4, 4), 0.5)
        moved = wrapatlas.transfer([red, grey], mesh, mesh, face_texture=which, resolution=64)
        colours = {tuple(np.round(255 * c).astype(int)) for c in np.asarray(moved).reshape(-1, 3)}
        self.assertEqual(colours, {(255, 0, 0), (128, 128, 128)})
        with self.assertRaisesRegex(ValueError, r"face_texture\[2\]"):
            wrapatlas.transfer([red], mesh, mesh, face_texture=which)
        with self.assertRaisesRegex(ValueError, "not one for each face"):
            wrapatlas.transfer([red, red], mesh, mesh, face_texture=which[:3])
        with self.assertRaisesRegex(ValueError, "one array"):
            wrapatlas.transfer(red, mesh, mesh, face_texture=which)
        for empty in (np.zeros((0, 0, 3), np.uint8), np.zeros((0, 4), np.uint8)):
            with self.assertRaises(ValueError):
                wrapatlas.transfer(empty, mesh, mesh)
        other = wrapatlas.unwrap(*shapes.square(), time=0)
        with self.assertRaisesRegex(ValueError, "differ in more than their UVs"):
            wrapatlas.transfer(red, mesh, other)


class Render(unittest.TestCase):
    def test_sizes_and_types(self):
        mesh = wrapatlas.Mesh(*shapes.box())
        self.assertEqual(wrapatlas.render(mesh, size=32, views=3).shape, (32, 96, 3))
        one = wrapatlas.render(mesh, size=32, azimuth=30)
        self.assertEqual((one.shape, one.dtype), ((32, 32, 3), np.uint8))
        self.assertTrue(one._repr_png_().startswith(b"\x89PNG"))
        self.assertIsNone(one.astype(int)._repr_png_())
        with self.assertRaisesRegex(ValueError, "no UVs"):
            wrapatlas.render(mesh, shapes.checker())

    def test_textures_of_any_type_look_the_same(self):
        mesh = wrapatlas.unwrap(*shapes.box(), time=0)
        texture = shapes.checker()
        wanted = wrapatlas.render(mesh, texture, size=64)
        for other in (texture.astype(np.uint16) * 257, texture / 255, (texture / 255).astype("f4"),
                      texture[:, ::-1][:, ::-1], texture.tolist() and texture.copy("F")):
            np.testing.assert_array_equal(wrapatlas.render(mesh, other, size=64), wanted)


class Images(unittest.TestCase):
    def test_round_trip(self):
        image = shapes.checker()
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.png"
            wrapatlas.save_image(path, image)
            np.testing.assert_array_equal(np.round(255 * wrapatlas.load_image(path)), image)
            with self.assertRaisesRegex(ValueError, "png"):
                wrapatlas.save_image(folder + "/a.tif", image)
            with self.assertRaisesRegex(ValueError, "neither 8 nor 16"):
                wrapatlas.save_image(path, image, 12)
            with self.assertRaises(OSError):
                wrapatlas.save_image(folder + "/no/a.png", image)
            with self.assertRaises(FileNotFoundError):
                wrapatlas.load_image(folder + "/b.png")
            Path(folder, "c.png").write_text("no picture")
            with self.assertRaisesRegex(ValueError, "c.png"):
                wrapatlas.load_image(folder + "/c.png")


if __name__ == "__main__":
    unittest.main()
