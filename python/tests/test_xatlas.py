"""parametrize and Atlas, beside those of xatlas-python on the same meshes."""

import tempfile
import time
import unittest
import warnings
from pathlib import Path

import numpy as np
import shapes

import wrapatlas

try:
    import xatlas
except ImportError:
    xatlas = None

SAMPLES = Path(__file__).parents[2] / "samples"


def meshes():
    yield "square", *shapes.square()
    yield "box", *shapes.box()
    yield "sphere", *shapes.sphere(3000)
    knot = wrapatlas.load(SAMPLES / "knot.off").triangulated()
    yield "knot", knot.positions, knot.faces


def covered(uvs, indices):
    a, b, c = (uvs[indices[:, i]].astype(float) for i in range(3))
    (x, y), (p, q) = (b - a).T, (c - a).T
    return np.abs(x * q - y * p).sum() / 2


class Parametrize(unittest.TestCase):
    @unittest.skipIf(xatlas is None, "xatlas is not installed")
    def test_beside_xatlas(self):
        print(f"\n{'mesh':8} {'faces':>6}  {'xatlas in use':>13} {'s':>6}  {'wrapatlas':>9} {'s':>6}")
        for name, positions, faces in meshes():
            with self.subTest(name):
                results, seconds = [], []
                for library in (xatlas, wrapatlas):
                    begin = time.monotonic()
                    results.append(library.parametrize(positions, faces))
                    seconds.append(time.monotonic() - begin)
                theirs, ours = results
                for their, our in zip(theirs, ours):
                    self.assertEqual((our.dtype, our.ndim), (their.dtype, their.ndim))
                    self.assertTrue(our.flags.writeable and our.flags.c_contiguous)
                vmapping, indices, uvs = ours
                self.assertEqual(indices.shape, theirs[1].shape)
                self.assertEqual(uvs.shape, (len(vmapping), 2))
                np.testing.assert_array_equal(vmapping[indices], faces)
                np.testing.assert_array_equal(theirs[0][theirs[1]], faces)
                self.assertTrue((uvs >= 0).all() and (uvs <= 1).all())
                self.assertEqual(set(indices.ravel()), set(range(len(vmapping))))
                use = [covered(r[2], r[1]) for r in (theirs, ours)]
                print(f"{name:8} {len(faces):6}  {100 * use[0]:12.1f}% {seconds[0]:6.2f}  "
                      f"{100 * use[1]:8.1f}% {seconds[1]:6.2f}")
                atlas = wrapatlas.Mesh(positions[vmapping], indices, uvs)
                self.assertTrue(wrapatlas.check(atlas).ok)

    def test_normals_uvs_and_empty(self):
        positions, faces = shapes.box()
        wanted = wrapatlas.parametrize(positions, faces)[1]
        got = wrapatlas.parametrize(positions, faces, positions, positions[:, :2])[1]
        self.assertEqual(got.shape, wanted.shape)
        empty = wrapatlas.parametrize(positions[:0], faces[:0])
        self.assertEqual([a.shape for a in empty], [(0,), (0, 3), (0, 2)])

    def test_errors_are_value_errors(self):
        positions, faces = shapes.box()
        for arguments in ((positions[:, :2], faces), (positions, faces[:, :2]),
                          (positions, faces + 100), (positions, -faces), (positions * np.nan, faces),
                          (positions, faces, positions[:2]), (positions, faces, None, positions),
                          (positions * 0, faces)):
            with self.assertRaises(ValueError):
                wrapatlas.parametrize(*arguments)


class Atlas(unittest.TestCase):
    def fill(self, library):
        atlas = library.Atlas()
        atlas.add_mesh(*shapes.box())
        atlas.add_mesh(*shapes.sphere(500))
        return atlas

    def options(self, library, **values):
        options = library.PackOptions()
        for name, value in values.items():
            setattr(options, name, value)
        return options

    def libraries(self):
        return [library for library in (xatlas, wrapatlas) if library]

    def test_same_names(self):
        if xatlas is None:
            self.skipTest("xatlas is not installed")
        for name in ("Atlas", "Chart", "ChartOptions", "ChartType", "PackOptions", "export",
                     "parametrize"):
            theirs, ours = getattr(xatlas, name), getattr(wrapatlas, name)
            missing = [member for member in dir(theirs) if member[0] != "_"
                       and member not in ("name", "value") and not hasattr(ours, member)
                       and member not in getattr(ours, "__annotations__", {})]
            self.assertEqual(missing, [], name)
        for name in ("ChartOptions", "PackOptions"):
            theirs, ours = getattr(xatlas, name)(), getattr(wrapatlas, name)()
            for member in dir(theirs):
                if member[0] != "_":
                    self.assertAlmostEqual(getattr(ours, member), getattr(theirs, member), places=6)

    def test_several_meshes(self):
        for library in self.libraries():
            with self.subTest(library.__name__):
                atlas = self.fill(library)
                self.assertEqual(len(atlas), 0)
                with self.assertRaises(IndexError):
                    atlas[0]
                atlas.generate()
                self.assertEqual((len(atlas), atlas.mesh_count, atlas.atlas_count), (2, 2, 1))
                charts = 0
                for i, (positions, faces) in enumerate((shapes.box(), shapes.sphere(500))):
                    vmapping, indices, uvs = atlas[i]
                    np.testing.assert_array_equal(vmapping[indices], faces)
                    self.assertEqual(uvs.shape, (len(vmapping), 2))
                    page, chart = atlas.get_mesh_vertex_assignment(i)
                    self.assertTrue((page == 0).all() and page.dtype == np.uint32)
                    count = atlas.get_mesh_chart_count(i)
                    self.assertEqual(set(chart), set(range(charts, charts + count)))
                    seen = np.concatenate([atlas.get_mesh_chart(i, j).faces for j in range(count)])
                    self.assertEqual(sorted(seen), list(range(len(faces))))
                    charts += count
                self.assertEqual(atlas.chart_count, charts)
                self.assertTrue(0.3 < atlas.utilization <= 1)
                self.assertEqual(atlas.get_utilization(0), atlas.utilization)
                self.assertEqual(len(list(atlas)), 2)
                for call in (lambda: atlas[2], lambda: atlas.get_utilization(1),
                             lambda: atlas.get_mesh_chart(0, 999), lambda: atlas.get_chart_image(7)):
                    with self.assertRaises(IndexError):
                        call()

    def test_uv_meshes(self):
        uv, faces = shapes.scattered_squares()
        for library in self.libraries():
            atlas = library.Atlas()
            atlas.add_uv_mesh(uv, faces)
            atlas.add_uv_mesh(2 * uv, faces, np.arange(len(faces)).reshape(-1, 1) // 2)
            atlas.generate()
            for i in range(2):
                vmapping, indices, uvs = atlas[i]
                np.testing.assert_array_equal(vmapping[indices], faces)
            self.assertEqual(atlas.get_mesh_chart_count(0), 12)
            self.assertEqual(atlas.get_mesh_chart_count(1), 12)

    def test_scales_and_sizes(self):
        for library in self.libraries():
            for resolution, unit in ((256, 0), (256, 50.0), (0, 50.0)):
                with self.subTest(f"{library.__name__} {resolution} {unit}"):
                    atlas = self.fill(library)
                    for _ in range(6):
                        atlas.add_mesh(*shapes.box())
                    atlas.generate(pack_options=self.options(library, resolution=resolution,
                                                             texels_per_unit=unit))
                    if unit:
                        self.assertAlmostEqual(atlas.texels_per_unit, unit, places=3)
                    if unit and resolution:
                        self.assertEqual((atlas.width, atlas.height), (256, 256))
                        self.assertGreater(atlas.atlas_count, 1)
                    pages = np.concatenate([atlas.get_mesh_vertex_assignment(i)[0]
                                            for i in range(len(atlas))])
                    self.assertEqual(set(pages), set(range(atlas.atlas_count)))
                    for _, _, uvs in atlas:
                        self.assertTrue((uvs >= -1e-6).all() and (uvs <= 1 + 1e-6).all())
                    self.assertGreater(atlas.get_utilization(atlas.atlas_count - 1), 0)

    def test_picture(self):
        for library in self.libraries():
            atlas = self.fill(library)
            atlas.generate(pack_options=self.options(library, create_image=True, resolution=128))
            image = atlas.chart_image
            self.assertEqual(image.dtype, np.uint8)
            self.assertEqual(image.shape, (atlas.height, atlas.width, 3))
            ground = image.reshape(-1, 3)
            _, indices, uvs = atlas[0]
            middles = uvs[indices].mean(axis=1) * (atlas.width, atlas.height)
            x, y = middles.astype(int).T
            colours, counts = np.unique(ground, axis=0, return_counts=True)
            unused = min(map(tuple, colours.astype(int)), key=sum)
            hits = [tuple(image[j, i]) != unused for i, j in zip(x, y)]
            self.assertGreater(np.mean(hits), 0.9, library.__name__)

    def test_options(self):
        atlas = self.fill(wrapatlas)
        charts = wrapatlas.ChartOptions()
        charts.max_cost = 4
        with self.assertWarnsRegex(UserWarning, "max_cost"):
            atlas.generate(charts)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            for name in ("blockAlign", "bruteForce", "create_image"):
                options = self.options(wrapatlas, padding=2)
                setattr(options, name, True)
                options.time = 0.1
                atlas.generate(pack_options=options)
            for turn, axis in ((False, False), (True, False), (False, True)):
                atlas.generate(pack_options=self.options(
                    wrapatlas, rotate_charts=turn, rotate_charts_to_axis=axis))
            atlas.generate(pack_options=self.options(wrapatlas, wrap="uv", time=0.1), verbose=True)

    def test_input_uvs(self):
        positions, faces = shapes.square()
        options = wrapatlas.ChartOptions()
        options.use_input_mesh_uvs = True
        atlas = wrapatlas.Atlas()
        atlas.add_mesh(positions, faces, uvs=positions[:, :2])
        atlas.generate(options)
        self.assertEqual(atlas.chart_count, 1)
        atlas.add_mesh(positions, faces)
        with self.assertRaisesRegex(ValueError, "without uvs"):
            atlas.generate(options)
        with self.assertRaisesRegex(ValueError, "an atlas for each"):
            atlas.add_uv_mesh(positions[:, :2], faces)

    def test_nothing(self):
        atlas = wrapatlas.Atlas()
        atlas.generate()
        self.assertEqual((len(atlas), atlas.width, atlas.atlas_count), (0, 0, 0))
        with self.assertRaises(IndexError):
            atlas.utilization


class Export(unittest.TestCase):
    def test_files_are_the_same_mesh(self):
        positions, faces = shapes.box()
        uvs, normals = positions[:, :2], positions - 0.5
        for library in (wrapatlas, xatlas) if xatlas else (wrapatlas,):
            with tempfile.TemporaryDirectory() as folder:
                path = folder + "/a.obj"
                library.export(path, positions, faces, uvs, normals)
                again = wrapatlas.load(path)
                np.testing.assert_array_equal(again.positions, positions)
                np.testing.assert_array_equal(again.faces, faces)
                np.testing.assert_array_equal(again.uv, uvs)
                self.assertIn("vn ", Path(path).read_text())
                library.export(path, positions)
                self.assertEqual(Path(path).read_text().count("\nv "), 7)
                library.export(path, positions, faces)
                self.assertEqual(wrapatlas.load(path).face_count, 12)

    def test_errors(self):
        positions, faces = shapes.box()
        with self.assertRaises(OSError):
            wrapatlas.export("/nowhere/a.obj", positions, faces)
        with tempfile.TemporaryDirectory() as folder:
            for arguments in ((positions[:, :2],), (positions, faces[:, :2]), (positions, faces + 9),
                              (positions, faces, positions), (positions, faces, None, faces)):
                with self.assertRaises(ValueError):
                    wrapatlas.export(folder + "/a.obj", *arguments)
            self.assertEqual(list(Path(folder).iterdir()), [])


class Readme(unittest.TestCase):
    """The snippets of xatlas-python's README with the import changed, as they stand there."""

    def test_snippets(self):
        import trimesh

        with tempfile.TemporaryDirectory() as folder:
            for name, mesh in (("input.obj", shapes.sphere(500)), ("input1.obj", shapes.box()),
                               ("input2.obj", shapes.square())):
                wrapatlas.export(f"{folder}/{name}", *mesh)
            mesh = trimesh.load_mesh(f"{folder}/input.obj")
            vmapping, indices, uvs = wrapatlas.parametrize(mesh.vertices, mesh.faces)
            wrapatlas.export(f"{folder}/output.obj", mesh.vertices[vmapping], indices, uvs)

            mesh1 = trimesh.load_mesh(f"{folder}/input1.obj")
            mesh2 = trimesh.load_mesh(f"{folder}/input2.obj")
            atlas = wrapatlas.Atlas()
            atlas.add_mesh(mesh1.vertices, mesh1.faces)
            atlas.add_mesh(mesh2.vertices, mesh2.faces)
            atlas.generate()
            vmapping1, indices1, uvs1 = atlas[0]
            vmapping2, indices2, uvs2 = atlas[1]

            atlas = wrapatlas.Atlas()
            atlas.add_uv_mesh(uvs1, indices1)
            atlas.add_uv_mesh(uvs2, indices2)
            atlas.generate()
            vmapping1, indices1, uvs1 = atlas[0]
            vmapping2, indices2, uvs2 = atlas[1]
            self.assertEqual((len(indices1), len(indices2)), (12, 2))

            atlas.mesh_count, len(atlas), atlas.get_mesh(0), atlas[0], atlas.width, atlas.height
            atlas.utilization, atlas.get_utilization(0)
            atlas.get_mesh_vertex_assignment(0), atlas.get_mesh_chart_count(0)
            atlas.get_mesh_chart(0, 0)
            pack_options = wrapatlas.PackOptions()
            pack_options.create_image = True
            atlas.generate(pack_options=pack_options)
            atlas.chart_image, atlas.get_chart_image(0)
            self.assertGreater(Path(folder, "output.obj").stat().st_size, 1000)


if __name__ == "__main__":
    unittest.main()
