#!/usr/bin/env python3
"""Reports of the command line, read as a browser reads them: well-formed, closed, true.

    check_report.py INTERREFLECT_CLI
"""

import base64
import html.parser
import json
import math
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

CLI = sys.argv[1]
VOID = {"meta", "img", "br", "link", "input"}
HOSTILE = "<script>alert('x')</script> \"A & B\""


class Page(html.parser.HTMLParser):
    """Elements with their texts; anything that is not closed in order is a fault."""

    def __init__(self, text):
        super().__init__()
        self.open, self.faults, self.elements, self.ids = [], [], [], set()
        self.feed(text)
        self.close()
        self.faults += [f"{element['name']} is not closed" for element in self.open]

    def handle_starttag(self, name, attributes):
        element = {"name": name, "attributes": dict(attributes), "text": "", "inside": list(self.open)}
        if len(dict(attributes)) < len(attributes):
            self.faults.append(f"{name} has an attribute twice")
        self.elements.append(element)
        if name not in VOID:
            self.open.append(element)

    def handle_startendtag(self, name, attributes):
        self.handle_starttag(name, attributes)
        if name not in VOID:
            self.open.pop()

    def handle_endtag(self, name):
        if not self.open or self.open[-1]["name"] != name:
            self.faults.append(f"</{name}> closes {self.open[-1]['name'] if self.open else 'nothing'}")
        else:
            self.open.pop()

    def handle_data(self, data):
        for element in self.open:
            element["text"] += data

    def all(self, name, **attributes):
        found = [e for e in self.elements if e["name"] == name]
        return [e for e in found if all(e["attributes"].get(k.rstrip("_")) == v for k, v in attributes.items())]


def decoded(uri):
    """Bytes of a data URI."""
    head, data = uri.split(",", 1)
    assert re.fullmatch(r"data:(image/png|application/zlib);base64", head), head
    return base64.b64decode(data, validate=True)


def halves(image):
    """Numbers of a picture, as report.js reads them."""
    width, height, channels = (int(image[k]) for k in ("width", "height", "data-channels"))
    packed = zlib.decompress(decoded(image["data-half"]))
    pixels = width * height
    assert len(packed) == 2 * pixels * channels, len(packed)
    values = []
    for c in range(channels):
        low = 2 * c * pixels
        for y in range(height):
            bits = 0
            for at in range(y * width, (y + 1) * width):
                bits = (bits + packed[low + at] + (packed[low + pixels + at] << 8)) & 0xFFFF
                values.append(struct.unpack("<e", struct.pack("<H", bits))[0])
    return values


def levels(image):
    """Red of each pixel of the picture that is seen without a script, a PNG of 8 bits. [PNG 1.2 §6]"""
    png, at, packed = decoded(image["src"]), 8, b""
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        data = png[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", data[:10])
        packed += data if kind == b"IDAT" else b""
        at += 12 + length
    assert depth == 8
    step = {0: 1, 2: 3, 4: 2, 6: 4}[colour]
    rows, above, result = zlib.decompress(packed), bytes(width * step), []
    for y in range(height):
        line = rows[y * (width * step + 1):(y + 1) * (width * step + 1)]
        row = bytearray(line[1:])
        for x in range(width * step):
            left, up, corner = row[x - step] if x >= step else 0, above[x], above[x - step] if x >= step else 0
            nearest = min((left, up, corner), key=lambda v: abs(left + up - corner - v))
            row[x] = (row[x] + (0, left, up, (left + up) // 2, nearest)[line[0]]) & 0xFF
        result += row[::step]
        above = bytes(row)
    return result


class Reports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="interreflect-report-test-")
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.project = cls.folder / "p.interreflect"
        cls.document = {
            "schema": 6, "name": HOSTILE, "notes": "First, on the [left](view:1).\n\n<img src=x onerror=alert(1)>",
            "scenes": [{"id": "box", "parts": [{"source": "builtin:cornell@1"}]}],
            "experiments": [
                {"id": "few", "name": HOSTILE, "scene": "box", "method": "ldm-ao", "size": [24, 16],
                 "values": {"directions": 8}, "transport": {"max_distance": 0.5}, "reference": "truth",
                 "notes": "</figure><h1>not a heading"},
                {"id": "many", "scene": "box", "method": "ldm-ao", "size": [24, 16],
                 "values": {"directions": 64}, "transport": {"max_distance": 0.5}, "reference": "truth"},
                {"id": "truth", "name": "Truth", "scene": "box", "method": "reference", "size": [24, 16],
                 "transport": {"paths": "ao", "max_distance": 0.5}}],
            "comparisons": [{"id": "c", "name": "'onmouseover=\"alert(1)", "a": "few", "b": "truth",
                             "mode": "difference", "notes": "<i>look</i>"}],
            "plots": [{"id": "plot", "name": "Over <directions>", "reference": "truth", "experiments": ["few"],
                       "over": "directions", "values": [4, 8, 16]}],
            "sweeps": [{"id": "s", "experiment": "few", "axes": [{"key": "directions", "values": [4, 8]}]}]}
        cls.store()
        cls.cli("report", cls.project, "--render", "--out", cls.folder / "p.html", "--quiet")
        cls.text = (cls.folder / "p.html").read_text(encoding="utf-8")
        cls.page = Page(cls.text)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def store(cls):
        cls.project.mkdir(exist_ok=True)
        (cls.project / "project.json").write_text(json.dumps(cls.document), encoding="utf-8")

    @classmethod
    def cli(cls, *arguments, status=0):
        run = subprocess.run([CLI, *map(str, arguments)], capture_output=True, text=True, check=False)
        assert run.returncode == status, (arguments, run.returncode, run.stderr)
        return run.stdout if status == 0 else run.stderr

    def report(self, *arguments):
        out = self.folder / "other.html"
        self.cli("report", *arguments, "--out", out, "--quiet")
        return Page(out.read_text(encoding="utf-8"))

    def kept(self, experiment):
        index = json.loads((self.project / "results/index.json").read_text(encoding="utf-8"))
        for result in index["entries"]:
            if result["experiment"] == experiment:
                return self.project / "results" / result["files"][0]["path"]
        raise AssertionError(f"{experiment} is not kept")

    def images(self, page):
        return [e["attributes"] for e in page.all("img")]

    def test_the_page_is_well_formed_and_takes_nothing_from_outside(self):
        self.assertEqual(self.page.faults, [])
        policy = self.page.all("meta", **{"http-equiv": "Content-Security-Policy"})[0]["attributes"]["content"]
        self.assertTrue(policy.startswith("default-src 'none'"))
        for element in self.page.elements:
            for key, value in element["attributes"].items():
                if key in ("src", "href", "srcset", "data-half", "data-mask", "xlink:href"):
                    self.assertTrue(value.startswith("data:"), (element["name"], key, value[:40]))
                self.assertFalse(key.startswith("on"), (element["name"], key))
        style = self.page.all("style")[0]["text"]
        self.assertNotRegex(style, r"url\(|@import")
        for address in re.findall(r"https?://[^\s\"'<)]+", self.text):
            self.assertEqual(address, "http://www.w3.org/2000/svg", "only the name of a language")

    def test_names_cannot_become_markup(self):
        self.assertEqual(self.page.all("h1")[0]["text"], HOSTILE)
        self.assertEqual(len(self.page.all("h1")), 1)
        self.assertEqual([e for e in self.page.all("script") if "alert" in e["text"]], [])
        paragraphs = [e["text"] for e in self.page.all("p")]
        self.assertIn("<img src=x onerror=alert(1)>", "".join(paragraphs))
        self.assertIn("First, on the left.", paragraphs, "links into the window are words on a page")
        captions = [e["text"] for e in self.page.all("figcaption")]
        self.assertTrue(any(HOSTILE in c and "</figure><h1>not a heading" in c for c in captions), captions)
        offered = self.page.all("ul", class_="pairs")[0]["text"]
        self.assertIn("'onmouseover=\"alert(1)", offered)

    def test_every_data_uri_decodes(self):
        images = self.images(self.page)
        self.assertEqual(len(images), 3)
        for image in images:
            png = decoded(image["src"])
            self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
            self.assertEqual(struct.unpack(">II", png[16:24]), (24, 16))
            self.assertEqual(len(halves(image)), 24 * 16 * int(image["data-channels"]))
            self.assertTrue(image["alt"])
            if "data-mask" in image:
                self.assertEqual(len(zlib.decompress(decoded(image["data-mask"]))), 24 * 16)

    def test_metrics_are_those_of_compare(self):
        section = self.page.all("section", class_="metrics")[0]
        table = next(e for e in self.page.all("table") if section in e["inside"])
        rows = [e for e in self.page.all("tr") if table in e["inside"]]
        cells = lambda row: [e for e in self.page.elements
                             if e["name"] in ("td", "th") and e["inside"] and e["inside"][-1] is row]
        numbers = lambda cell: [e["attributes"]["value"] for e in self.page.all("data") if cell in e["inside"]]
        names = [json.loads(self.cli("compare", self.kept("few"), self.kept("truth"), "--metric", "all", "--json"))]
        expected = {HOSTILE: names[0],
                    "many": json.loads(self.cli("compare", self.kept("many"), self.kept("truth"), "--metric", "all",
                                                "--json"))}
        self.assertEqual(len(rows), 3)
        for row in rows[1:]:
            own = cells(row)
            compared = expected[HOSTILE if own[0]["text"] == HOSTILE else own[0]["text"].lower()]
            self.assertEqual(own[1]["text"], "Truth")
            told = [float(numbers(cell)[0]) for cell in own[2:]]
            self.assertEqual(told, [math.nan if v is None else v for v in compared["metrics"].values()])
        best = [e for e in self.page.elements if "best" in (e["attributes"].get("class") or "")]
        self.assertGreater(len(best), 4)

    def test_values_are_those_of_the_file(self):
        compared = json.loads(self.cli("compare", self.kept("few"), self.kept("truth"), "--metric",
                                       "mean,reference-mean", "--json"))
        images = self.images(self.page)[::2]
        masks = [zlib.decompress(decoded(image["data-mask"])) for image in images]
        valid = [all(mask[i] for mask in masks) for i in range(24 * 16)]
        self.assertEqual(sum(valid), compared["pixels"])
        self.assertGreater(compared["skipped"], 0)
        for image, metric in zip(images, ("mean", "reference-mean")):
            values = [value for value, is_valid in zip(halves(image), valid) if is_valid]
            self.assertAlmostEqual(sum(values) / len(values), compared["metrics"][metric], delta=5e-4)

    def test_numbers_that_are_no_light_are_levels_of_grey_as_in_the_window(self):
        image = self.images(self.page)[0]
        seen = [round(255 * min(1.0, value)) for value in halves(image)]
        self.assertLess(min(seen), 150)
        for level, expected in zip(levels(image), seen):
            self.assertAlmostEqual(level, expected, delta=1)
        self.assertIn("from black to white", self.page.all("p", class_="shown")[0]["text"])

    def test_only_what_differs_is_in_the_short_table(self):
        def rows(caption):
            table = next(e for e in self.page.all("table") if e["text"].startswith(caption))
            return {e["text"]: [c["text"] for c in self.page.all("td") if row in c["inside"]]
                    for row in self.page.all("tr") if table in row["inside"]
                    for e in self.page.all("th", scope="row") if row in e["inside"]}
        differing, everything = rows("Settings that differ"), rows("All settings")
        self.assertEqual(differing["Directions"], ["8", "64", "—"])
        self.assertEqual(differing["method"], ["ldm-ao", "ldm-ao", "reference"])
        self.assertNotIn("scene", differing)
        self.assertIn("scene", everything)
        self.assertLess(set(differing), set(everything))
        for values in everything.values():
            for value in values:
                self.assertNotIn(str(self.folder), value, "a path of this computer")

    def test_plots_are_drawn_and_their_numbers_told(self):
        svg = self.page.all("svg")
        self.assertEqual(len(svg), 1)
        self.assertIn("Over <directions>", svg[0]["attributes"]["aria-label"])
        marks = [e for e in self.page.elements if "mark" in (e["attributes"].get("class") or "").split()]
        self.assertEqual(len(marks), 3 + 1, "three points and the legend's")
        file = self.folder / "plot.svg"
        self.cli("plot", self.project, "--svg", file, "--no-keep", "--quiet")
        drawn = Page(file.read_text(encoding="utf-8"))
        self.assertEqual(drawn.faults, [])
        self.assertEqual(len(drawn.all("svg")), 1)
        self.assertIn("Over <directions>", [e["text"] for e in drawn.all("text")])

    def test_what_is_missing_or_stale_is_said_once(self):
        self.assertEqual(self.page.all("section", class_="lacks"), [])
        before = json.dumps(self.document)
        try:
            self.document["experiments"][1]["values"]["directions"] = 32
            self.document["experiments"].append({"id": "new", "name": "New one", "scene": "box", "method": "hbao",
                                                 "size": [24, 16]})
            self.document["plots"][0]["values"] = [4, 8]
            self.store()
            page = self.report(self.project)
            lines = [e["text"] for e in page.all("li")
                     if any(i["attributes"].get("class") == "lacks" for i in e["inside"])]
            self.assertEqual(len(lines), 3, lines)
            self.assertTrue(any("stale" in l and "directions: 64 → 32" in l for l in lines), lines)
            self.assertTrue(any("New one has no kept result" in l for l in lines), lines)
            self.assertTrue(any("Over <directions> is stale" in l for l in lines), lines)
            self.assertEqual(len(self.images(page)), 3, "the stale picture is shown")
        finally:
            type(self).document = json.loads(before)
            self.store()

    def test_two_pictures_a_sweep_and_a_packed_project(self):
        pair = self.report(self.kept("few"), self.kept("truth"))
        self.assertEqual(pair.faults, [])
        self.assertEqual(len(self.images(pair)), 2)
        out = self.folder / "sweep"
        self.cli("sweep", self.project, "s", "--out", out, "--reference", "16", "--keep", "--quiet")
        sweep = self.report(out)
        self.assertEqual(sweep.faults, [])
        self.assertEqual(len(self.images(sweep)), 3, "two variations and their ground truth")
        listed = json.loads((out / "sweep.json").read_text(encoding="utf-8"))
        told = {e["attributes"]["value"] for e in sweep.all("data")}
        for point in listed["points"]:
            self.assertIn(point["errors"]["rmse"], {float(value) for value in told})
        for own in ("sweep.json", listed["points"][0]["image"]):
            refused = self.cli("report", out, "--out", out / own, status=2)
            self.assertEqual(refused.count("\n"), 1, refused)
            self.assertTrue((out / own).exists())
        private = self.folder / "private.exr"
        private.write_bytes(self.kept("few").read_bytes())
        listed["points"][0]["image"] = str(private)
        (out / "sweep.json").write_text(json.dumps(listed), encoding="utf-8")
        self.assertEqual(len(self.images(self.report(out))), 2, "a list takes along no file from elsewhere")
        packed = self.folder / "p.tar"
        self.cli("project", self.project, "--pack", packed)
        self.assertEqual(self.images(self.report(packed)), self.images(self.page))
        self.assertIn("unpack", self.cli("report", packed, "--render", status=2))

    def test_a_comparison_alone(self):
        for name in ("c", self.document["comparisons"][0]["name"]):
            page = self.report(self.project, "--comparison", name)
            self.assertEqual(page.faults, [])
            self.assertEqual(page.all("p", class_="kind")[0]["text"], "Comparison")
            self.assertEqual(page.all("h1")[0]["text"], self.document["comparisons"][0]["name"])
            everything = self.images(self.page)
            self.assertEqual(self.images(page), [everything[0], everything[2]])
            self.assertEqual(page.all("svg"), [], "plots are of the project")
            self.assertEqual(page.all("section", class_="lacks"), [])
        self.assertIn("did you mean 'c'", self.cli("report", self.project, "--comparison", "cc", status=2))
        self.assertIn("for projects", self.cli("report", self.kept("few"), self.kept("truth"), "--comparison", "c",
                                               status=2))

    def test_a_name_that_two_comparisons_have_is_refused(self):
        project = self.folder / "two.interreflect"
        shutil.copytree(self.project, project)
        document = json.loads((project / "project.json").read_text(encoding="utf-8"))
        first = document["comparisons"][0]
        document["comparisons"].append({**first, "id": "again"})
        (project / "project.json").write_text(json.dumps(document), encoding="utf-8")
        said = self.cli("report", project, "--comparison", first["name"], status=2)
        self.assertIn("give an id: c, again", said)

    def test_galleries_hold_what_is_compared_whichever_comes_first(self):
        project = self.folder / "galleries.interreflect"
        project.mkdir()
        small = {"scene": "box", "method": "view-normals", "size": [8, 6]}
        pairs = ("da", "bc", "cb", "ef", "fa")
        (project / "project.json").write_text(json.dumps({
            "schema": 6, "name": "Galleries", "scenes": self.document["scenes"],
            "experiments": [{"id": name, "seed": seed, **small} for seed, name in enumerate("abcdefgh")],
            "comparisons": [{"id": pair, "a": pair[0], "b": pair[1]} for pair in pairs]}), encoding="utf-8")
        page = self.report(project, "--render")
        captions = page.all("figcaption")
        names = [[c["text"].split()[0] for c in captions if gallery in c["inside"]]
                 for gallery in page.all("section", class_="gallery")]
        self.assertEqual(names, [list("adef"), list("bc"), list("gh")])

    def test_a_comparison_renders_what_it_lacks_alone(self):
        project = self.folder / "other.interreflect"
        project.mkdir()
        small = {"scene": "box", "method": "view-normals", "size": [8, 6]}
        (project / "project.json").write_text(json.dumps({
            "schema": 6, "name": "Other", "scenes": self.document["scenes"],
            "experiments": [{"id": name, "seed": seed, **small} for seed, name in enumerate("abx")],
            "comparisons": [{"id": "c", "name": "C", "a": "a", "b": "b", "output": "position"}]}), encoding="utf-8")
        page = self.report(project, "--comparison", "c", "--render")
        self.assertEqual(len(self.images(page)), 2)
        kept = json.loads((project / "results/index.json").read_text(encoding="utf-8"))["entries"]
        self.assertEqual(sorted(result["experiment"] for result in kept), ["a", "b"])
        lines = [e["text"] for e in page.all("li") if "lacks" in str(e["inside"])]
        self.assertIn("The comparison C is of 'position'; its pictures here are the main results.", lines)

    def test_where_files_lie_stays_at_home(self):
        scene = self.folder / "triangle.gltf"
        corners = struct.pack("<9f", -1, -1, 0, 1, -1, 0, 0, 1, 0)
        scene.write_text(json.dumps({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                           "min": [-1, -1, 0], "max": [1, 1, 0]}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,"
                                                  + base64.b64encode(corners).decode()}]}), encoding="utf-8")
        for name in ("a", "b"):
            self.cli("render", "--scene", scene, "--method", "view-normals", "--size", "16x12", "--seed",
                     1 + (name == "b"), "--out", self.folder / f"{name}.exr", "--quiet")
        page = self.report(self.folder / "a.exr", self.folder / "b.exr")
        text = (self.folder / "other.html").read_text(encoding="utf-8")
        self.assertIn("triangle.gltf", text)
        self.assertFalse(str(self.folder) in text, "a path of this computer")
        differing = [e for e in page.all("table") if e["text"].startswith("Settings that differ")][0]
        self.assertEqual([e["text"] for e in page.all("th", scope="row") if differing in e["inside"]], ["seed"])

    def test_large_reports_carry_8_bit_values_and_say_so(self):
        small = self.report(self.project, "--limit", "1kB")
        self.assertEqual([i for i in self.images(small) if "data-half" in i], [])
        self.assertIn("8-bit", small.all("span", class_="values")[0]["text"])
        self.assertIn("half floats", self.page.all("span", class_="values")[0]["text"])

    def test_wrong_arguments_are_one_line(self):
        nothing = self.cli("report", self.folder / "nothing", status=3)
        self.assertEqual(nothing.count("\n"), 1, nothing)
        alone = self.cli("report", self.kept("few"), status=2)
        self.assertIn("second picture", alone)
        larger = self.folder / "larger.exr"
        self.cli("render", "--scene", "builtin:cornell", "--method", "view-normals", "--size", "24x20", "--out", larger,
                 "--quiet")
        unlike = self.cli("report", self.kept("few"), larger, "--out", self.folder / "unlike.html", status=2)
        self.assertEqual(unlike.count("\n"), 1, unlike)
        own = self.cli("report", self.project, "--out", self.project / "project.json", status=2)
        self.assertIn("file of the project", own)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
