"""Reads pictures with OpenImageIO's own tool: layers, their names and values. Usage: oiiotool_test.py PROGRAM

Ends with status 77, and says why, without oiiotool (package openimageio-tools).
"""
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = sys.argv.pop(1)
if not shutil.which("oiiotool"):
    print("skipped: oiiotool is missing; install openimageio-tools")
    sys.exit(77)


def run(*words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{words} ended with {done.returncode}: {done.stdout}{done.stderr}")
    return done.stdout


class Layers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.file = self.folder / "a.exr"
        run(PROGRAM, "render", "--scene", "builtin:cornell", "--method", "ldm-ao", "--set", "directions=8", "--size",
            "32x24", "--dump", "gbuffer.*", "--out", self.file, "--quiet")

    def channels(self):
        line = re.search(r"channel list: (.*)", run("oiiotool", "--info", "-v", self.file)).group(1)
        return [name.split(" ")[0] for name in line.split(", ")]

    def test_channels_are_called_as_openexr_asks(self):
        """The picture itself has no layer. Others are LAYER.CHANNEL: tev and oiiotool split at the last dot."""
        layers = {}
        for name in self.channels():
            layer, _, channel = name.rpartition(".")
            layers.setdefault(layer, []).append(channel)
        self.assertEqual(layers[""], ["Y"])
        self.assertEqual(layers["gbuffer.albedo"], list("RGBA"))
        self.assertEqual(layers["gbuffer.position"], list("XYZW"))
        self.assertEqual(layers["gbuffer.velocity"], list("XY"))
        for layer, channels in layers.items():
            self.assertRegex(layer, r"^[a-z0-9_.]*$")
            for channel in channels:
                self.assertRegex(channel, r"^([RGBA]|[XYZW]|[0-9]+)$")

    def test_a_layer_taken_out_has_the_same_values(self):
        taken = self.folder / "taken.exr"
        run("oiiotool", self.file, "--ch", ",".join(f"gbuffer.albedo.{channel}" for channel in "RGBA"), "-o", taken)
        text = run(PROGRAM, "compare", taken, self.file, "--layer", "gbuffer.albedo", "--metric", "rmse,mean")
        self.assertRegex(text, r"rmse\s+0\b")
        self.assertNotRegex(text, r"mean\s+0\n")


if __name__ == "__main__":
    unittest.main()
