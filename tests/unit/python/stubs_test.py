"""The stubs name all that is public, and nothing else; descriptions are in the help."""
import ast
import inspect
import os
import unittest
from pathlib import Path

import support  # noqa: F401

import interreflect as ir

STUBS = Path(os.environ["SOURCE_ROOT"]) / "app/python/interreflect/__init__.pyi"
HELPERS = {"Value", "File", "Progress", "Event"}
OPERATORS = {"__init__", "__getitem__", "__setitem__", "__contains__", "__iter__", "__len__", "__fspath__"}


def names_in(body):
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            yield node.name
        elif isinstance(node, ast.AnnAssign):
            yield node.target.id
        elif isinstance(node, ast.Assign):
            yield from (target.id for target in node.targets)


def public(names):
    return {name for name in names if not name.startswith("_") or name in OPERATORS}


class Stubs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.body = ast.parse(STUBS.read_text()).body

    def test_name_all_of_the_module(self):
        self.assertEqual(public(names_in(self.body)) - HELPERS, set(ir.__all__))
        self.assertEqual({name for name in dir(ir) if not name.startswith("_")}, set(ir.__all__))

    def test_name_all_of_each_class(self):
        for node in self.body:
            if isinstance(node, ast.ClassDef) and node.name not in HELPERS and node.name in vars(ir):
                type = getattr(ir, node.name)
                own = public(vars(type)) | ({"pixels", "skipped"} if node.name == "Metrics" else set())
                self.assertEqual(public(names_in(node.body)) - {"__init__"}, own - {"__init__"}, node.name)

    def test_bases_are_those_of_the_module(self):
        self.assertTrue(issubclass(ir.UsageError, ValueError) and issubclass(ir.BudgetError, MemoryError))
        self.assertEqual(ir.UsageError.__module__, "interreflect")
        self.assertEqual(ir.Experiment.__module__, "interreflect")

    def test_everything_public_has_a_text(self):
        for name in ir.__all__:
            if callable(getattr(ir, name)):
                self.assertTrue(getattr(ir, name).__doc__, name)

    def test_texts_are_those_of_the_descriptions(self):
        self.assertIn("Width and height of the picture", ir.Experiment.size.__doc__)
        self.assertIn("Threads of passes on the host", ir.Machine.__doc__)
        for id in ir.methods():
            function = ir.method(id)
            self.assertIn(ir.describe(id)["title"], function.__doc__)
            for parameter in ir.describe(id)["parameters"]:
                self.assertEqual(inspect.signature(function).parameters[parameter["key"]].default, parameter["default"])
                self.assertIn(parameter["key"], function.__doc__)
        made = ir.method("ldm-ao")("builtin:cornell", directions=8, size=(4, 4))
        self.assertEqual((made.method, made["directions"], made.size), ("ldm-ao", 8, (4, 4)))


if __name__ == "__main__":
    unittest.main()
