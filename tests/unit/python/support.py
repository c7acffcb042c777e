"""What the tests of the Python module share. A test ends with status 77, and says why, where it cannot run."""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)


def require(*modules):
    for module in modules:
        try:
            __import__(module)
        except ImportError as error:
            skip(f"{error.name} is not installed for {sys.executable}")


require("numpy")
sys.path.insert(0, os.environ["PYTHON_PACKAGES"])
CLI = os.environ["CLI_PROGRAM"]
SAMPLES = Path(os.environ["SOURCE_ROOT"]) / "projects/samples"
SCENE = "builtin:cornell"


def run_cli(*arguments):
    done = subprocess.run([CLI, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{arguments}: {done.stderr}")
    return done.stdout


class InFolder(unittest.TestCase):
    """With a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
