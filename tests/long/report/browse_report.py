#!/usr/bin/env python3
"""A report in a real browser: flipped, wiped, subtracted, enlarged, by keys, mouse and fingers.

    browse_report.py INTERREFLECT_CLI [FOLDER]

FOLDER takes screenshots. Without Chromium the test is skipped.
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # the folder is of sources
from browser import PROGRAMS, Browser, find_browser

CLI = sys.argv[1]
SHOTS = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
SIZE = (96, 72)


def project(folder):
    """Two viewpoints, so that there are two viewers."""
    made = {
        "schema": 6, "name": "A report in a browser <b>",
        "scenes": [{"id": "box", "parts": [{"source": "builtin:cornell@1"}]}],
        "cameras": [{"id": "near", "eye": [0, 0, 2], "target": [0, 0, 0], "fov_y_degrees": 40}],
        "experiments": [
            {"id": "few", "name": "Few maps", "scene": "box", "method": "ldm-ao", "size": SIZE,
             "values": {"directions": 8}, "transport": {"max_distance": 0.5}, "reference": "many"},
            {"id": "many", "name": "Many maps", "scene": "box", "method": "ldm-ao", "size": SIZE,
             "values": {"directions": 64}, "transport": {"max_distance": 0.5}},
            {"id": "third", "name": "Third", "scene": "box", "method": "ldm-ao", "size": SIZE,
             "values": {"directions": 32}, "transport": {"max_distance": 0.5}, "reference": "many"},
            {"id": "near-few", "scene": "box", "camera": "near", "method": "ldm-ao", "size": SIZE,
             "values": {"directions": 8}, "transport": {"max_distance": 0.5}, "reference": "near-many"},
            {"id": "near-many", "scene": "box", "camera": "near", "method": "ldm-ao", "size": SIZE,
             "values": {"directions": 64}, "transport": {"max_distance": 0.5}}],
        "comparisons": [{"id": "c", "name": "Few against many", "a": "few", "b": "many", "mode": "wipe"}]}
    folder.mkdir()
    (folder / "project.json").write_text(json.dumps(made), encoding="utf-8")


class InTheBrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="interreflect-report-browser-")
        folder = pathlib.Path(cls.temporary.name)
        project(folder / "p.interreflect")
        cls.file = folder / "report.html"
        subprocess.run([CLI, "report", folder / "p.interreflect", "--render", "--quiet", "--out", cls.file], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def open(self, **options):
        browser = Browser(**options)
        self.addCleanup(browser.__exit__)
        browser.open(self.file)
        browser.wait("[...document.querySelectorAll('section.gallery')].every(s => s.dataset.ready === 'true')")
        browser.frame()
        return browser

    def shown(self, browser, viewer=0):
        """The stage as it is drawn."""
        browser.frame()
        return browser.value(f"document.querySelectorAll('.stage > canvas')[{viewer}].toDataURL()")

    def text(self, browser, selector):
        return browser.value(f"document.querySelector({json.dumps(selector)}).textContent")

    def focus(self, browser):
        browser.value("document.querySelector('.stage').focus()")

    def shot(self, browser, name, **options):
        if SHOTS:
            SHOTS.mkdir(parents=True, exist_ok=True)
            browser.screenshot(SHOTS / f"{name}.png", **options)

    def test_nothing_is_fetched_and_nothing_goes_wrong(self):
        browser = self.open()
        self.assertEqual(browser.messages, [])
        outside = [url for url in browser.requests if not url.startswith(("data:", "file:", "blob:"))]
        self.assertEqual(outside, [])
        self.assertEqual([url for url in browser.requests if url.startswith("file:")], [f"file://{self.file}"])

    def test_keys_flip_choose_and_subtract(self):
        browser = self.open()
        self.focus(browser)
        wiped = self.shown(browser)
        browser.key("1", "Digit1")
        browser.key("2", "Digit2", shift=True)
        browser.key(" ", "Space")
        second = self.shown(browser)
        browser.key(" ", "Space")
        first = self.shown(browser)
        self.assertEqual(len({wiped, first, second}), 3)
        browser.key(" ", "Space")
        self.assertEqual(self.shown(browser), second, "flipped back to the same picture")
        browser.key("d", "KeyD")
        signed = self.shown(browser)
        self.assertIn("A − B", self.text(browser, ".legend"))
        browser.key("d", "KeyD")
        self.assertNotEqual(self.shown(browser), signed, "the second D takes magnitudes")
        browser.key("1", "Digit1", shift=True)
        colours = browser.value("""(() => { const c = document.querySelector('.stage > canvas');
            const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
            return [...new Set(Array.from({length: d.length / 4}, (_, i) => d.slice(4*i, 4*i+3).join()))] })()""")
        self.assertEqual(len(set(colours) - {"96,96,96", "0,0,0"}), 1,
                         f"a picture less itself is one colour where it is valid: {colours}")
        browser.key("g", "KeyG")
        self.assertNotEqual(self.shown(browser), signed)
        self.assertEqual(browser.messages, [])

    def test_the_line_wipes_and_the_zoom_is_one_for_all(self):
        browser = self.open()
        x, y, width, height = browser.box(".stage")
        before = self.shown(browser)
        browser.drag((x + width / 2, y + height / 2), (x + width / 4, y + height / 2))
        self.assertNotEqual(self.shown(browser), before)
        other = self.shown(browser, 1)
        self.assertEqual(self.text(browser, ".viewer output"), self.text(browser, "section:nth-of-type(2) .viewer output"))
        browser.key("+", "Equal")
        self.assertNotEqual(self.shown(browser, 1), other, "the other viewer is enlarged, too")
        enlarged = self.shown(browser)
        browser.drag((x + width * 0.7, y + height * 0.7), (x + width * 0.6, y + height * 0.6))
        self.assertNotEqual(self.shown(browser), enlarged, "dragged")
        browser.key("0", "Digit0")
        self.assertEqual(self.shown(browser, 1), other, "as before")

    def test_the_values_under_the_cursor_are_told(self):
        browser = self.open()
        self.focus(browser)
        x, y, width, height = browser.box(".stage")
        scale = min(width / SIZE[0], height / SIZE[1])
        browser.mouse("mouseMoved", x + width / 2 + scale * (10.5 - SIZE[0] / 2),
                      y + height / 2 + scale * (20.5 - SIZE[1] / 2))
        browser.frame()
        told = self.text(browser, ".readout")
        self.assertIn("x 10, y 20", told)
        browser.key("ArrowRight")
        browser.key("ArrowDown", shift=True)
        self.assertIn("x 11, y 30", self.text(browser, ".readout"))
        numbers = browser.value("[...document.querySelectorAll('.readout .value')].map(e => "
                                "parseFloat(e.lastChild.textContent.replace('−', '-')))")
        self.assertEqual(len(numbers), 3)
        self.assertAlmostEqual(numbers[0] - numbers[1], numbers[2], delta=2e-3)
        exposed = self.shown(browser)
        browser.key("e", "KeyE")
        self.assertNotEqual(self.shown(browser), exposed)
        browser.key("E", "KeyE", shift=True)
        self.assertEqual(self.shown(browser), exposed)

    def test_fingers_wipe_and_pinch(self):
        browser = self.open(width=390, height=844, scale=2, touch=True)
        x, y, width, height = browser.box(".stage")
        before = self.shown(browser)
        middle = y + height / 2
        browser.touch("touchStart", [(x + width / 2, middle)])
        browser.touch("touchMove", [(x + width / 4, middle)])
        browser.touch("touchEnd", [])
        self.assertNotEqual(self.shown(browser), before)
        zoom = self.text(browser, ".viewer output")
        browser.touch("touchStart", [(x + width * 0.4, middle), (x + width * 0.6, middle)])
        for apart in (0.2, 0.3, 0.4):
            browser.touch("touchMove", [(x + width * (0.5 - apart), middle), (x + width * (0.5 + apart), middle)])
        browser.touch("touchEnd", [])
        browser.frame()
        self.assertNotEqual(self.text(browser, ".viewer output"), zoom)
        self.assertLessEqual(browser.value("document.documentElement.scrollWidth"), 390, "nothing sticks out")

    def test_it_looks_right_in_all_sizes_and_without_script(self):
        for name, options in (("wide", {"width": 1600, "height": 1000}),
                              ("wide-2x-dark", {"width": 1600, "height": 1000, "scale": 2, "dark": True}),
                              ("phone", {"width": 390, "height": 844, "scale": 2, "touch": True})):
            browser = self.open(**options)
            self.assertLessEqual(browser.value("document.documentElement.scrollWidth"), options["width"], name)
            self.shot(browser, name, whole=True)
        browser = Browser()
        self.addCleanup(browser.__exit__)
        browser.call("Emulation.setScriptExecutionDisabled", value=True)
        browser.open(self.file)
        self.assertEqual(browser.value("document.querySelectorAll('.viewer').length"), 0)
        self.assertTrue(browser.value("[...document.images].every(i => i.complete && i.naturalWidth > 0 && "
                                      "i.getBoundingClientRect().width > 200)"))
        self.shot(browser, "without-script", whole=True)


if __name__ == "__main__":
    if not find_browser():
        print("skipped: none of " + ", ".join(PROGRAMS) + " is installed")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
