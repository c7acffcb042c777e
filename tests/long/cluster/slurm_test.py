"""Runs a sweep and a divided reference on Slurm: three nodes on this machine, one of which is killed meanwhile.
Usage: slurm_test.py PROGRAM

Needs the packages slurm-wlm and munge, and the superuser. Ends with status 77, and says why, without them.
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import small_slurm

PROGRAM = Path(sys.argv.pop(1))
TOOLS = ["munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol"]
os.environ["PATH"] += ":/usr/sbin"


missing = [tool for tool in TOOLS if not shutil.which(tool)]
if missing or os.geteuid() != 0:
    print(f"skipped: {', '.join(missing)} missing; install slurm-wlm and munge" if missing else "skipped: not the superuser")
    sys.exit(77)


def run(*words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{words} ended with {done.returncode}: {done.stdout}{done.stderr}")
    return done.stdout


def wait_until(condition, what, seconds=400):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"{what}: not after {seconds} s")
        time.sleep(0.2)


class Slurm(unittest.TestCase):
    samples = 1024

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.cluster = small_slurm.Cluster(self.folder / "slurm", nodes=3)
        self.addCleanup(self.cluster.stop)
        self.cluster.begin()
        self.project = self.make("divided")

    def make(self, name):
        folder = self.folder / f"{name}.interreflect"
        folder.mkdir()
        (folder / "project.json").write_text(json.dumps({
            "schema": 6, "name": name, "scenes": [{"id": "box", "parts": [{"source": "builtin:cornell"}]}],
            "experiments": [{"id": "light", "scene": "box", "method": "ldm-indirect", "size": [160, 120]},
                            {"id": "ao", "scene": "box", "method": "ldm-ao", "size": [160, 120]}],
            "sweeps": [{"id": "s", "experiment": "ao", "axes": [{"key": "directions", "values": [8, 16, 32, 64]},
                                                                {"key": "resolution", "values": [64, 128, 256]}]}]}))
        return folder

    def submit(self, name, *command):
        run(PROGRAM, "submit", "--tasks", 3, "--cpus", 1, "--mem", "500M", "--time", "00:30:00", "--run", "--log",
            self.folder / f"{name}-%a.log", *command)

    def test_a_node_that_dies_changes_nothing(self):
        reference = ["reference", self.project, "--experiment", "light", "--samples", self.samples]
        self.submit("reference", *reference, "--checkpoint", 1, "--json", "--quiet")
        self.submit("sweep", "sweep", self.project, "s", "--out", self.folder / "out")
        parts = self.project / "results/parts"
        wait_until(lambda: len(list(parts.glob("*.exr"))) >= 3, "all parts have a checkpoint")
        victim = self.cluster.node_of("interreflect-reference")
        self.cluster.kill(victim)
        wait_until(lambda: self.cluster.state(victim).startswith("down"), "the node is missed")
        self.cluster.start_at_once()
        wait_until(lambda: (self.cluster.start_at_once(), not self.cluster.jobs())[1], "all tasks are done")

        logs = "".join(file.read_text() for file in sorted(self.folder.glob("reference-*.log")))
        self.assertRegex(logs, r'"shards": 3,\s+"samples": \d+,\s+"resumed_from": [1-9]', "a task went on")
        self.assertFalse(parts.exists(), "the parts are joined")
        one = self.make("one")
        run(PROGRAM, "reference", one, *reference[2:], "--quiet")
        kept = [json.loads(run(PROGRAM, "project", project, "--results", "--json"))["results"][0]
                for project in (self.project, one)]
        for member in ("key", "samples", "can_continue"):
            self.assertEqual(kept[0][member], kept[1][member])
        self.expect_same(*(next(project.glob("results/*/main.exr")) for project in (self.project, one)))

        run(PROGRAM, "sweep", "merge", self.folder / "out", "--out", self.folder / "out/sweep.json")
        run(PROGRAM, "sweep", one, "s", "--out", self.folder / "alone", "--quiet")
        points = json.loads((self.folder / "out/sweep.json").read_text())["points"]
        self.assertEqual(len(points), 12)
        for point in points:
            self.expect_same(self.folder / "out" / point["image"], self.folder / "alone" / point["image"])

    def expect_same(self, divided, whole):
        compared = json.loads(run(PROGRAM, "compare", divided, whole, "--metric", "mae", "--json"))
        self.assertEqual(compared["metrics"]["mae"], 0, divided)


if __name__ == "__main__":
    unittest.main()
