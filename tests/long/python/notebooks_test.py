"""Runs the notebooks, cell by cell in one namespace, as Jupyter would, and looks at what they leave."""
import ast
import json
import os
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ["SOURCE_ROOT"])
sys.path.insert(0, str(ROOT / "tests/unit/python"))
from support import require

require("pandas", "matplotlib")
import interreflect as ir
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy

NOTEBOOKS = ROOT / "app/python/notebooks"


def run(name):
    """What all cells leave behind, and the value of each."""
    notebook = json.loads((NOTEBOOKS / f"{name}.ipynb").read_text(encoding="utf-8"))
    assert (notebook["nbformat"], notebook["nbformat_minor"]) == (4, 5)
    namespace, values = {"__name__": "__main__"}, []
    for cell in notebook["cells"]:
        source = "".join(cell["source"])
        if cell["cell_type"] != "code":
            continue
        assert cell["outputs"] == [], "a notebook is kept without its output"
        statements = ast.parse(source, filename=f"{name}, {cell['id']}").body
        last = statements.pop() if statements and isinstance(statements[-1], ast.Expr) else None
        exec(compile(ast.Module(statements, []), f"{name}, {cell['id']}", "exec"), namespace)
        values.append(eval(compile(ast.Expression(last.value), f"{name}, {cell['id']}", "eval"), namespace) if last else None)
    return namespace, values


def pixels_of(figure):
    figure.canvas.draw()
    return numpy.asarray(figure.canvas.buffer_rgba())


class Notebooks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        self.addCleanup(plt.close, "all")
        os.chdir(folder.name)

    def keep(self, figure, name):
        """Where a person can look at it."""
        if "NOTEBOOK_FIGURES" in os.environ:
            figure.savefig(Path(os.environ["NOTEBOOK_FIGURES"]) / f"{name}.png")

    def test_all_are_run(self):
        self.assertEqual({path.stem for path in NOTEBOOKS.glob("*.ipynb")}, {"figure-of-a-paper", "study-of-your-own"})

    def test_figure_of_a_paper(self):
        namespace, values = run("figure-of-a-paper")
        table = namespace["table"]
        self.assertLess(table.rmse["layered depth maps"], 0.5 * table.rmse["HBAO"])
        self.assertGreater(table.bias["HBAO"], 0.02, "HBAO is too bright")
        self.assertLess(abs(table.bias["layered depth maps"]), 0.03)
        self.assertEqual(len(ir.read("HBAO.exr").image), 240)
        pixels = pixels_of(namespace["figure"])
        self.assertGreater(len(numpy.unique(pixels[..., 0])), 100)
        self.keep(namespace["figure"], "figure-of-a-paper")

    def test_study_of_your_own(self):
        namespace, values = run("study-of-your-own")
        table = namespace["table"]
        self.assertEqual(len(table), 15)
        finest = table[table.resolution == 100].set_index("directions").rmse
        self.assertLess(finest[128], 0.6 * finest[8])
        self.assertTrue((table.reference_noise > 0).all())
        front = namespace["front"]
        self.assertTrue(front.rmse.is_monotonic_decreasing and len(front) > 1)
        self.assertEqual(values[-1].columns[0], "directions")
        self.assertGreater(len(numpy.unique(pixels_of(namespace["figure"])[..., 0])), 50)
        self.keep(namespace["figure"], "study-of-your-own")


if __name__ == "__main__":
    unittest.main()
