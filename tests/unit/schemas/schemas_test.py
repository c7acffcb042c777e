"""Validates what the command line writes by the schemas that it prints. Usage: schemas_test.py PROGRAM ROOT

Ends with status 77, and says why, where Python has no module jsonschema.
"""
import copy
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    from jsonschema import Draft202012Validator
except ImportError:
    print(f"skipped: jsonschema is not installed for {sys.executable}")
    sys.exit(77)

PROGRAM, ROOT = sys.argv.pop(1), Path(sys.argv.pop(1))
NAMES = ["project", "statistics", "sweep", "compare", "scene"]


def run(*arguments, status=0):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode != status:
        raise AssertionError(f"{arguments} ended with {done.returncode}: {done.stderr}")
    return done.stdout


def strict(schema):
    """Refuses members that the schema does not describe."""
    if isinstance(schema, list):
        return [strict(each) for each in schema]
    if not isinstance(schema, dict):
        return schema
    result = {key: strict(value) for key, value in schema.items()}
    if result.get("type") == "object" and "properties" in result:
        result.setdefault("additionalProperties", False)
    return result


class Schemas(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.schemas = {name: json.loads(run("schema", name)) for name in NAMES}
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.render("a", 4)
        cls.render("b", 16)

    @classmethod
    def render(cls, name, directions):
        run("render", "--scene", "builtin:cornell", "--method", "ldm-ao", "--set", f"directions={directions}", "--size",
            "24x24", "--out", cls.folder / f"{name}.exr", "--json", cls.folder / f"{name}.json")

    def problems(self, name, document, part=None, is_strict=False):
        schema = strict(self.schemas[name]) if is_strict else self.schemas[name]
        if part:
            schema = {"$ref": f"#/$defs/{part}", "$defs": schema["$defs"]}
        return [f"{'/'.join(map(str, error.absolute_path))}: {error.message[:200]}"
                for error in Draft202012Validator(schema).iter_errors(document)]

    def expect_valid(self, name, document, part=None, is_strict=True):
        self.assertEqual(self.problems(name, document, part, is_strict), [])

    def expect_refused(self, name, document, change):
        wrong = copy.deepcopy(document)
        change(wrong)
        self.assertTrue(self.problems(name, wrong), "the change was not noticed")

    def test_are_schemas(self):
        for name, schema in self.schemas.items():
            Draft202012Validator.check_schema(schema)
            self.assertTrue(schema["title"] and schema["description"], name)

    def test_statistics(self):
        document = json.loads((self.folder / "a.json").read_text())
        self.expect_valid("statistics", document)
        self.expect_refused("statistics", document, lambda d: d.pop("device"))
        self.expect_refused("statistics", document, lambda d: d.update(schema_version=2))
        self.expect_refused("statistics", document, lambda d: d["passes"][0].update(queue="gpu"))
        self.expect_refused("statistics", document, lambda d: d["picture"]["camera"].pop("fov_y_degrees"))

    def test_compare(self):
        document = json.loads(run("compare", self.folder / "a.exr", self.folder / "b.exr", "--metric", "all", "--json",
                                  "--diff", self.folder / "diff.exr", "--fail-above", "rmse=0", status=4))
        self.assertEqual(document["exceeded"], ["rmse"])
        self.expect_valid("compare", document)
        equal = json.loads(run("compare", self.folder / "a.exr", self.folder / "a.exr", "--json"))
        self.assertIsNone(equal["metrics"]["psnr"])
        self.expect_valid("compare", equal)
        self.expect_refused("compare", document, lambda d: d["metrics"].update(rmse="small"))
        self.expect_refused("compare", document, lambda d: d.pop("metrics"))

    def test_scenes(self):
        for name in ("builtin:cornell", "builtin:conference", "builtin:corridor"):
            document = json.loads(run("scene", name, "--json"))
            self.expect_valid("scene", document)
        self.expect_refused("scene", document, lambda d: d["materials"][0].pop("name"))
        self.expect_refused("scene", document, lambda d: d["cameras"][0].pop("fov_y_degrees"))

    def project(self):
        """With something of everything."""
        at = {"id": "ao", "name": "AO", "scene": "box", "method": "ldm-ao", "values": {"directions": 4},
              "transport": {"max_distance": 0.5}, "size": [16, 16], "seed": 1, "frames": 1, "time": 0}
        return {
            "schema": self.schemas["project"]["properties"]["schema"]["const"], "name": "All", "notes": "",
            "scenes": [{"id": "box", "parts": [{"source": "builtin:cornell@1",
                                                "materials": {"white": {"base_colour": [1, 1, 1, 1]}}}]}],
            "cameras": [{"id": "near", "eye": [0, 1, 3], "target": [0, 1, 0], "up": [0, 1, 0], "fov_y_degrees": 40}],
            "lights": [{"id": "lamp", "lights": ["scene", {"type": "point", "flux": 3, "position": [0, 1, 0]}],
                        "environment": [0, 0, 1]}],
            "motion": [{"id": "walk", "moves": "camera", "camera": "near",
                        "keys": [{"time": 0, "eye": [0, 1, 3], "target": [0, 1, 0], "up": [0, 1, 0]}]}],
            "experiments": [at, dict(at, id="other", camera="near", lights="lamp", presets={"small": {"size": [8, 8]}})],
            "comparisons": [{"id": "c", "a": "ao", "b": "other", "mode": "wipe"}],
            "sweeps": [{"id": "s", "experiment": "ao", "axes": [{"key": "directions", "values": [4, 8]},
                                                                {"key": "size", "values": [[16, 16], [9000, 9000]]}]}],
            "plots": [{"id": "p", "reference": "ao", "experiments": ["other"], "over": "directions", "values": [4, 8],
                       "metric": "rmse", "axis": "time"}],
            "analyses": [{"id": "q", "kind": "sensitivity", "experiments": ["ao"], "reference": "other",
                          "parameters": ["directions"]},
                         {"id": "t", "kind": "frames", "experiments": ["ao"], "output": "normals", "frames": 4}]}

    def written(self, document):
        """What the program makes of it."""
        folder = self.folder / "all.interreflect"
        folder.mkdir(exist_ok=True)
        (folder / "project.json").write_text(json.dumps(document))
        run("project", folder, "--upgrade")
        return json.loads((folder / "project.json").read_text())

    def test_projects(self):
        document = self.project()
        self.expect_valid("project", document)
        self.expect_valid("project", self.written(document))
        first = lambda d: d["experiments"][0]
        for change in (
                lambda d: d.update(schema=5),
                lambda d: d.pop("schema"),
                lambda d: first(d).pop("method"),
                lambda d: first(d).update(id="a b"),
                lambda d: first(d).update(size=[0, 16]),
                lambda d: first(d)["values"].update(directions=-1),
                lambda d: first(d)["values"].update(storage="shelf"),
                lambda d: first(d)["transport"].update(paths="full"),
                lambda d: d["scenes"][0].update(parts=[]),
                lambda d: d["scenes"][0]["parts"][0]["materials"]["white"].update(base_colour=[2, 1, 1, 1]),
                lambda d: d["cameras"][0].update(eye=[0, 1]),
                lambda d: d["lights"][0]["lights"][1].update(type="laser"),
                lambda d: d["lights"][0]["lights"][1].pop("flux"),
                lambda d: d["lights"][0].update(environment="sun"),
                lambda d: d["motion"][0].update(moves="sun"),
                lambda d: d["motion"][0]["keys"][0].update(eye=3),
                lambda d: d["plots"][0].update(axis="up")):
            self.expect_refused("project", document, change)

    def test_projects_may_name_their_schema(self):
        document = self.written({"$schema": "project.schema.json", **self.project()})
        self.assertEqual(document["$schema"], "project.schema.json")
        self.assertNotIn("$schema", run("project", self.folder / "all.interreflect", "--check"))

    def test_sample_projects(self):
        """Keys that this build does not know are kept, so they are allowed."""
        files = sorted((ROOT / "projects/samples").glob("*.interreflect/project.json"))
        self.assertGreater(len(files), 20)
        for file in files:
            with self.subTest(file.parent.name):
                self.expect_valid("project", json.loads(file.read_text()), is_strict=False)

    def test_sweeps(self):
        self.written(self.project())
        out = self.folder / "out"
        run("sweep", self.folder / "all.interreflect", "s", "--out", out, "--reference", 4, "--memory", "100MB", status=1)
        document = json.loads((out / "sweep.json").read_text())
        self.assertEqual(["problem" in point for point in document["points"]], [False, True] * 2)
        self.expect_valid("sweep", document)
        lines = (out / "sweep.jsonl").read_text().splitlines()
        self.assertTrue(lines)
        for line in lines:
            self.expect_valid("sweep", json.loads(line), "point")
        self.expect_refused("sweep", document, lambda d: d["points"][0].pop("cold_ms"))
        self.expect_refused("sweep", document, lambda d: d.pop("plan"))


if __name__ == "__main__":
    unittest.main()
