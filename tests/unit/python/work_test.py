"""Progress, cancelling, threads and errors."""
import base64
import json
import os
import signal
import sys
import threading
import unittest

from support import SAMPLES, SCENE, InFolder

import interreflect as ir


def long_work(**changes):
    """Takes far longer than any test waits, in many slices."""
    return ir.Experiment("reference", SCENE, size=(256, 256), frames=1000, **changes)


class Work(unittest.TestCase):
    def test_tells_its_progress(self):
        told = []
        ir.Experiment("ldm-ao", SCENE, size=(48, 36)).render(progress=lambda what, part: told.append((what, part)))
        self.assertTrue(told)
        self.assertTrue(all(isinstance(what, str) and 0 <= part <= 1 for what, part in told))
        self.assertEqual([part for _, part in told], sorted(part for _, part in told))

    def test_an_exception_of_the_progress_ends_it(self):
        class Enough(Exception):
            pass

        def stop(what, part):
            raise Enough(what)

        with self.assertRaises(Enough):
            long_work().render(progress=stop)
        self.assertIsNotNone(ir.Experiment("ldm-ao", SCENE, size=(8, 8)).render(), "the machine still works")

    def test_interrupt_ends_it(self):
        with self.assertRaises(KeyboardInterrupt):
            long_work().render(progress=lambda what, part: os.kill(os.getpid(), signal.SIGINT))

    def test_an_event_ends_it_from_another_thread(self):
        begun, enough, seen = threading.Event(), threading.Event(), []

        def render():
            try:
                long_work().render(progress=lambda what, part: begun.set(), cancel=enough)
            except ir.Cancelled as cancelled:
                seen.append(cancelled)

        thread = threading.Thread(target=render)
        thread.start()
        self.assertTrue(begun.wait(120))
        enough.set()
        thread.join(120)
        self.assertFalse(thread.is_alive())
        self.assertEqual(len(seen), 1)

    def test_other_threads_run_meanwhile(self):
        """Python's lock is free between two calls of the progress: another thread counts there."""
        enough, counted = threading.Event(), []

        def count():
            number = 0
            while not enough.is_set():
                number += 1
                counted.append(number)
                threading.Event().wait(0.0001)

        thread = threading.Thread(target=count)
        switch = sys.getswitchinterval()
        sys.setswitchinterval(1000)  # nobody is made to give the lock away
        try:
            thread.start()
            before = []
            with self.assertRaises(StopIteration):
                def look(what, part):
                    before.append(len(counted))
                    if before[-1] > before[0]:
                        raise StopIteration
                long_work().render(progress=look)
        finally:
            enough.set()
            sys.setswitchinterval(switch)
            thread.join()
        self.assertGreater(before[-1], before[0])

    def test_threads_share_a_machine(self):
        pictures = {}

        def render(seed):
            pictures[seed] = ir.Experiment("ldm-ao", SCENE, size=(32, 24), directions=4, seed=seed).render()

        threads = [threading.Thread(target=render, args=(seed % 2,)) for seed in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(sorted(pictures), [0, 1])
        expected = ir.Experiment("ldm-ao", SCENE, size=(32, 24), directions=4, seed=1).render()
        self.assertEqual(ir.compare(pictures[1], expected, "rmse")["rmse"], 0)

    def test_progress_cannot_render_on_its_own_machine(self):
        small = ir.Experiment("ldm-ao", SCENE, size=(8, 8), directions=4)
        with self.assertRaisesRegex(ir.UsageError, "another Machine"):
            small.render(progress=lambda what, part: small.render())

    def test_progress_may_render_on_another_machine(self):
        small = ir.Experiment("ldm-ao", SCENE, size=(32, 24), directions=4)
        other, inner = ir.Machine(), []

        def look(what, part):
            if len(inner) < 3:
                inner.append(small.render(machine=other))

        outer = small.render(progress=look)
        self.assertEqual(len(inner), 3)
        for picture in [outer, *inner]:
            self.assertEqual(ir.compare(picture, small.render(), "rmse")["rmse"], 0)

    def test_what_is_changed_during_a_sweep_is_not_of_it(self):
        e = ir.Experiment("ldm-ao", SCENE, size=(16, 12), directions=4)
        e_before = e.copy()

        def change(coordinates, picture):
            e["seed"] = e["seed"] + 1
            e.set(size=(8, 8))

        columns = ["rmse"]
        table = ir.sweep(e, {"directions": [4, 8]}, reference=4, each=change)
        again = ir.sweep(e_before, {"directions": [4, 8]}, reference=4)
        self.assertEqual(table[columns].values.tolist(), again[columns].values.tolist())


class Errors(InFolder):
    def expect(self, error, text, work):
        with self.assertRaisesRegex(error, text) as caught:
            work()
        self.assertIsInstance(caught.exception, ir.Error)
        self.assertNotIn("\n", str(caught.exception))

    def test_are_ours_with_one_line(self):
        e = ir.Experiment("ldm-ao", SCENE, size=(8, 8))
        self.expect(ir.UsageError, "did you mean 'ldm-ao'", lambda: ir.Experiment("ldm-oa", SCENE))
        self.expect(ValueError, "did you mean 'directions'", lambda: e.set(direction=3))
        self.expect(ir.UsageError, "directions.*an integer from", lambda: e.set(directions=-3))
        self.expect(ir.UsageError, "directions.*a number or a text", lambda: e.set(directions=[3]))
        self.expect(ir.UsageError, "size", lambda: e.set(size=(0, 3)))
        self.expect(ir.UsageError, "camera: unknown 'eyes'.*did you mean 'eye'", lambda: e.set(camera={"eyes": 1}))
        self.expect(ir.UsageError, "camera.*target", lambda: e.set(camera={"eye": [0, 1, 2], "target": "x"}))
        self.expect(ir.UsageError, "positio", lambda: e.set(lights=[{"type": "point", "flux": 1, "positio": [0, 1, 2]}]))
        self.expect(ir.UsageError, "'gbufer.\\*' matches no buffer", lambda: e.render("gbufer.*"))
        self.expect(ir.UsageError, "outside the picture", lambda: e.render(pick=(8, 0)))
        self.expect(ir.InputError, "none.glb", lambda: ir.Experiment("ldm-ao", "none.glb").render())
        self.expect(ir.InputError, "none", lambda: ir.Project(self.folder / "none"))
        self.expect(ir.BudgetError, "memory", lambda: e.copy(size=(4000, 4000)).render(machine=ir.Machine(memory="1MB")))
        with self.assertRaisesRegex(KeyError, "render\\(outputs"):
            e.render()["gbuffer.normal"]
        self.expect(ir.UsageError, "3x2.*4x2|4x2.*3x2", lambda: ir.compare([[1, 2, 3], [1, 2, 3]], [[1] * 4] * 2))

    def test_change_nothing(self):
        e = ir.Experiment("ldm-ao", SCENE, size=(8, 8), directions=16)
        with self.assertRaises(ir.UsageError):
            e.set(size=(9, 9), directions=-1)
        self.assertEqual((e.size, e["directions"]), ((8, 8), 16))

    def test_pictures_of_other_things_are_not_compared(self):
        a = ir.Experiment("ldm-ao", SCENE, size=(16, 16), directions=4)
        b = a.copy(camera={"eye": (0, 1, 2), "target": (0, 1, 0)})
        self.expect(ir.UsageError, "different camera", lambda: ir.compare(a.render(), b.render()))
        self.assertGreater(ir.compare(a.render(), b.render(), "rmse", allow_different="camera")["rmse"], 0)


class Values(InFolder):
    def test_are_read_and_set(self):
        import numpy
        e = ir.Experiment("ldm-ao", SCENE, size=(8, 8))
        e["directions"] = numpy.int32(24)
        e.seed = 2**64 - 1
        self.assertEqual((e["directions"], e.values["directions"], e.seed), (24, 24, 2**64 - 1))
        copy = e.copy(directions=8)
        self.assertEqual((e["directions"], copy["directions"]), (24, 8))
        self.assertEqual(copy.document()["experiments"][0]["values"]["directions"], 8)

    def test_of_a_project_stay_in_the_copy(self):
        project = ir.Project(SAMPLES / "crevice-leaks.interreflect")
        first = next(iter(project.experiments))
        experiment = project.experiments[first]
        experiment.size = (8, 8)
        self.assertNotEqual(project.experiments[first].size, (8, 8))

    def test_a_scene_is_the_file_as_it_is_now(self):
        import numpy
        file = self.folder / "a.gltf"

        def write(size):
            corners = (numpy.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]]) * size).astype("<f4")
            data = base64.b64encode(corners.tobytes()).decode()
            file.write_text(json.dumps({
                "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                               "min": [0, 0, 0], "max": [size, size, 0]}],
                "bufferViews": [{"buffer": 0, "byteLength": 36}],
                "buffers": [{"byteLength": 36, "uri": f"data:application/octet-stream;base64,{data}"}]}))

        write(1)
        e = ir.Experiment("view-normals", file, size=(8, 8), camera={"eye": [0.4, 0.4, 3], "target": [0.4, 0.4, 0]})
        few = e.render().valid.sum()
        write(2)
        self.assertEqual(ir.Scene(file).bounds[1], (2, 2, 0))
        self.assertGreater(e.render().valid.sum(), few)

    def test_scenes_tell_what_they_hold(self):
        scene = ir.Scene(SCENE)
        self.assertGreater(scene.triangles, 10)
        self.assertEqual(ir.Experiment("ldm-ao", scene).scene, scene.name)
        low, high = scene.bounds
        self.assertTrue(all(a < b for a, b in zip(low, high)))


if __name__ == "__main__":
    unittest.main()
