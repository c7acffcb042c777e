"""The module renders the same bits as the command line, and hands them out without a copy."""
import gc
import unittest

from support import SAMPLES, SCENE, InFolder, run_cli

import interreflect as ir
import numpy

SIZE = (48, 36)


class Bits(InFolder):
    def expect_equal(self, ours, file):
        theirs = ir.read(file)
        self.assertGreater(len(ours.keys()), 1)
        for key in ours.keys():
            name = key if key in theirs.keys() else ""
            if ours[key].dtype.fields:
                continue  # a buffer, which files hold as pixels: below
            self.assertTrue(numpy.array_equal(ours[key], theirs[name], equal_nan=True), key)
        for name, text in theirs.attributes.items():
            if name != "interreflect.command":
                self.assertEqual(ours.attributes.get(name), text, name)

    def test_of_a_scene(self):
        file = self.folder / "a.exr"
        run_cli("render", "--scene", SCENE, "--method", "ldm-ao", "--set", "directions=16", "--set",
                "max_distance=1.5", "--size", "48x36", "--seed", 3, "--light", "point:position=0,1,0;flux=40",
                "--eye", "0,1,3.2", "--target", "0,1,0", "--out", file, "--dump", "*")
        ours = ir.Experiment("ldm-ao", SCENE, directions=16, max_distance=1.5, size=SIZE, seed=3,
                             lights=["point:position=0,1,0;flux=40"],
                             camera={"eye": (0, 1, 3.2), "target": (0, 1, 0)}).render("*")
        self.expect_equal(ours, file)
        self.assertTrue(any(ours[key].dtype.fields for key in ours), "no buffer was compared")
        saved = self.folder / "b.exr"
        ours.save(saved)
        again, theirs = ir.read(saved), ir.read(file)
        self.assertEqual(again.keys(), theirs.keys())
        for key in theirs:
            if key in ours and ours[key].dtype.fields:
                continue  # buffers may have the order in which threads came
            self.assertTrue(numpy.array_equal(again[key], theirs[key], equal_nan=True), key)

    def test_of_a_buffer(self):
        """A record's fields are the channels of the pixel that files have in its place."""
        picture = ir.Experiment("ldm-ao", SCENE, directions=4, size=SIZE).render("*")
        file = self.folder / "buffers.exr"
        picture.save(file)
        written, compared = ir.read(file), 0
        for key in picture:
            records = picture[key]
            if not records.dtype.fields or not 0 < len(records) <= 4096 or key not in written:
                continue
            pixels = dict(zip(written.channels(key), written[key].reshape(len(records), -1).T))
            for name in records.dtype.names:
                if "." in name:
                    continue  # files take what stands before the dot for a layer
                values = records[name].reshape(len(records), -1).T
                for i, column in enumerate(values):
                    channel = pixels[name if len(values) == 1 else f"{name}{i}"]
                    self.assertTrue(numpy.array_equal(column.astype(numpy.float32), channel, equal_nan=True), key)
                    compared += 1
        self.assertGreater(compared, 10)

    def test_of_a_project(self):
        project = ir.Project(SAMPLES / "crevice-leaks.interreflect")
        id, experiment = next(iter(project.experiments.items()))
        run_cli("render", project.folder, "--experiment", id, "--size", "48x36", "--out", self.folder)
        experiment.size = SIZE
        self.expect_equal(experiment.render(), self.folder / f"{id}.exr")

    def test_of_a_ground_truth(self):
        file = self.folder / "truth.exr"
        run_cli("render", "--scene", SCENE, "--method", "ldm-ao", "--size", "48x36", "--match", "--samples", 8,
                "--out", file)
        self.expect_equal(ir.Experiment("ldm-ao", SCENE, size=SIZE).match(8).render(), file)

    def test_of_errors(self):
        images = [ir.Experiment("ldm-ao", SCENE, size=SIZE, directions=n).render() for n in (4, 64)]
        for image, name in zip(images, "ab"):
            image.save(self.folder / f"{name}.exr")
        import json
        told = json.loads(run_cli("compare", self.folder / "a.exr", self.folder / "b.exr", "--metric", "all",
                                  "--json"))
        found = ir.compare(*images)
        self.assertEqual(dict(found), told["metrics"])
        self.assertEqual((found.pixels, found.skipped), (told["pixels"], told["skipped"]))
        self.assertGreater(found["rmse"], 0)
        self.assertEqual(ir.compare(self.folder / "a.exr", images[1]), found)
        self.assertEqual(ir.compare(images[0], images[0], "rmse"), {"rmse": 0})


class Arrays(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.picture = ir.Experiment("ldm-ao", SCENE, size=SIZE, directions=4).render("*")

    def test_shapes_follow_the_picture(self):
        self.assertEqual(self.picture.image.shape, (36, 48))
        self.assertEqual(self.picture.image.dtype, numpy.float32)
        self.assertEqual(self.picture["gbuffer.normal"].shape[:2], (36, 48))
        self.assertEqual(self.picture.valid.dtype, bool)
        self.assertTrue(self.picture.valid.any())

    def test_nothing_is_copied(self):
        for key in self.picture:
            first, second = self.picture[key], self.picture[key]
            if not first.size:
                continue
            self.assertEqual(first.ctypes.data, second.ctypes.data, key)
            self.assertFalse(first.flags.owndata, key)
            self.assertFalse(first.flags.writeable, key)
            with self.assertRaises(ValueError):
                first[...] = 0

    def test_an_array_outlives_its_picture(self):
        picture = ir.Experiment("ldm-ao", SCENE, size=SIZE, directions=4).render()
        array = picture.image
        expected = array.copy()
        del picture
        gc.collect()
        ballast = [numpy.full((36, 48), n, numpy.float32) for n in range(64)]
        self.assertTrue(numpy.array_equal(array, expected, equal_nan=True))
        self.assertEqual(len(ballast), 64)


if __name__ == "__main__":
    unittest.main()
