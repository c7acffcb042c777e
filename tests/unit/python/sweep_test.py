"""Sweeps as tables: the numbers of the command line."""
import json
import unittest

from support import SCENE, InFolder, require, run_cli

require("pandas")
import interreflect as ir
import pandas

AXES = {"directions": [4, 16], "seed": [1, 2]}


class Sweeps(InFolder):
    def test_have_the_rows_of_the_command_line(self):
        e = ir.Experiment("ldm-ao", SCENE, size=(32, 24))
        project = e.document()
        project["sweeps"] = [{"id": "s", "name": "s", "experiment": project["experiments"][0]["id"],
                              "axes": [{"key": key, "values": values} for key, values in AXES.items()]}]
        folder = self.folder / "p.interreflect"
        folder.mkdir()
        (folder / "project.json").write_text(json.dumps(project))
        csv = self.folder / "table.csv"
        run_cli("sweep", folder, "s", "--reference", 16, "--out", self.folder / "out", "--csv", csv)
        theirs = pandas.read_csv(csv)
        seen = []
        ours = ir.sweep(e, AXES, reference=16, each=lambda coordinates, picture: seen.append((coordinates, picture)))
        self.assertEqual(list(ours.columns), list(theirs.columns))
        exact = ["directions", "seed", "rmse", "hdr-flip", "bias", "reference_noise", "pixels"]
        pandas.testing.assert_frame_equal(ours[exact], theirs[exact])
        self.assertTrue((ours.warm_ms > 0).all())
        self.assertEqual([c for c, _ in seen], [{"directions": d, "seed": s} for d in (4, 16) for s in (1, 2)])
        self.assertEqual(ir.compare(seen[3][1], e.copy(directions=16, seed=2).render(), "rmse")["rmse"], 0)

    def test_a_failure_is_a_row(self):
        table = ir.sweep(ir.Experiment("ldm-ao", SCENE, size=(16, 16), directions=4), {"size": [[16, 16], [4000, 4000]]},
                         machine=ir.Machine(memory="60MB"))
        self.assertTrue(pandas.isna(table.problem[0]))
        self.assertIn("memory", table.problem[1])

    def test_wrong_axes_are_refused(self):
        e = ir.Experiment("ldm-ao", SCENE)
        with self.assertRaisesRegex(ir.UsageError, "direction"):
            ir.sweep(e, {"direction": [1]})


if __name__ == "__main__":
    unittest.main()
