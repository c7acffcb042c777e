#!/usr/bin/env python3
"""The table of deep screen space at its defaults in docs/accuracy.md: light, RMSE and FLIP of eight scenes, beside
the screen-space methods.

    defaults_table.py build/release/bin/interreflect-cli [--size 156x104] [--samples 1024] [--only "still life"]
                      [--seeds 1 2]

Prints Markdown. References are kept in --keep, so that another run takes them from there. With --check it exits with 1
where the light is too far from the reference's, or where the method is not ahead by FLIP or, beyond the reference's own
noise, by RMSE. Scenes of INTERREFLECT_SCENES that are not there are left out, and a line says which.
"""

import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field

METHOD = "deep-screen-space"
AO = {"paths": "ao", "max_distance": "1"}
LIGHT = {"paths": "indirect", "max_distance": "0"}
TRUTH_SEED, COARSE_SEED = 7, 8  # of the reference


@dataclass
class Row:
    name: str
    scene: str
    transport: dict = field(default_factory=lambda: LIGHT)
    place: list = field(default_factory=list)  # camera and lights
    light_tolerance: float = 0.1  # of the reference's light, with --check

    @property
    def is_light(self):
        return self.transport is LIGHT

    @property
    def competitor(self):
        return "ssdo" if self.is_light else "hbao"

    @property
    def flip(self):
        return "hdr-flip" if self.is_light else "flip"


ROWS = [
    Row("graveyard, AO", "builtin:graveyard", AO),
    Row("still life", "builtin:still-life"),
    Row("dominoes", "builtin:dominoes", light_tolerance=0.2),
    Row("conference", "builtin:conference"),
    Row("living-room", "rooms/living-room/living-room.glb",
        place=["--light", "rect:position=2.3,2.7,-1.5;direction=0,-1,0;size=1,1;radiance=10"]),
    Row("Cornell", "builtin:cornell"),
    Row("atrium", "builtin:atrium"),
    Row("Sponza", "sponza.glb", place=["--eye=-10,2,0", "--target=0,3,0", "--light",
                                       "spot:position=-4,6,0;direction=0,-1,0;flux=2000;outer=60"]),
]


class Table:
    def __init__(self, options, keep):
        self.cli, self.size, self.samples = str(pathlib.Path(options.cli).resolve()), options.size, options.samples
        self.seeds = options.seeds
        self.keep = keep
        self.keep.mkdir(parents=True, exist_ok=True)

    def run(self, *arguments):
        done = subprocess.run([self.cli, *arguments], capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(done.stderr)
        return done.stdout

    def render(self, row, method, seed, match=0):
        kind = f"reference-{match}" if match else method
        out = self.keep / f"{row.name.replace(', ', '-').replace(' ', '-')}-{self.size}-{kind}-{seed}.exr"
        if match and out.exists():
            return out
        settings = [word for item in row.transport.items() for word in ("--set", "=".join(item))]
        self.run("render", "--quiet", "--scene", path_of(row.scene), "--method", method, "--size", self.size,
                 "--seed", str(seed), "--out", str(out), *row.place, *settings,
                 *(["--match", "--samples", str(match)] if match else []))
        return out

    def errors(self, row, picture, truth):
        text = self.run("compare", str(picture), str(truth), "--json", "--metric",
                        f"rmse,{row.flip},mean,reference-mean")
        found = json.loads(text)
        return found.get("metrics", found)

    def measure(self, row):
        truth = self.render(row, METHOD, TRUTH_SEED, self.samples)
        coarse = self.render(row, METHOD, COARSE_SEED, max(1, self.samples // 4))
        noise = self.errors(row, coarse, truth)["rmse"] / math.sqrt(5)  # s²/N and 4 s²/N add up
        result = {}
        for method in (METHOD, row.competitor):
            each = [self.errors(row, self.render(row, method, seed), truth) for seed in self.seeds]
            mean = lambda of: sum(map(of, each)) / len(each)
            result[method] = (mean(lambda e: e["mean"] / e["reference-mean"]),
                              math.sqrt(mean(lambda e: e["rmse"] ** 2)), mean(lambda e: e[row.flip]))
        return result, noise

    def print(self, row):
        result, noise = self.measure(row)
        own, other = result[METHOD], result[row.competitor]
        print(f"| {row.name} | {own[0]:.2f} | {own[1]:.3g} | {own[2]:.3f} | `{row.competitor}` | {other[0]:.2f} | "
              f"{other[1]:.3g} | {other[2]:.3f} | {noise:.2g} |", flush=True)
        problems = []
        if abs(own[0] - 1) > row.light_tolerance:
            problems.append(f"{row.name}: {own[0]:.3f} of the light, not 1 within {row.light_tolerance}")
        if own[1] >= other[1] + noise:
            problems.append(f"{row.name}: RMSE {own[1]:.3g}, {row.competitor} {other[1]:.3g}, noise {noise:.2g}")
        if own[2] >= other[2]:
            problems.append(f"{row.name}: FLIP {own[2]:.3f}, {row.competitor} {other[2]:.3f}")
        return problems


def path_of(scene):
    """None where it is not there."""
    if scene.startswith("builtin:"):
        return scene
    path = pathlib.Path(os.environ.get("INTERREFLECT_SCENES", "")) / scene
    return str(path) if path.exists() else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cli")
    parser.add_argument("--size", default="156x104")
    parser.add_argument("--samples", type=int, default=1024, help="of the reference")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2], help="of the methods")
    parser.add_argument("--keep", help="folder for the pictures (default: a temporary one)")
    parser.add_argument("--only", action="append", help="name of a row; repeat for more")
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    if unknown := set(options.only or []) - {row.name for row in ROWS}:
        parser.error("no such row: " + ", ".join(sorted(unknown)))
    chosen = [row for row in ROWS if not options.only or row.name in options.only]
    left_out = [row.name for row in chosen if not path_of(row.scene)]
    if left_out:
        print("left out, as INTERREFLECT_SCENES does not lead to them: " + ", ".join(left_out), file=sys.stderr)
    problems = []
    print("| scene | light | RMSE | ꟻLIP | beside | light | RMSE | ꟻLIP | noise |\n" + "|---" * 9 + "|")
    with tempfile.TemporaryDirectory() as folder:
        table = Table(options, pathlib.Path(options.keep or folder))
        for row in chosen:
            if path_of(row.scene):
                problems += table.print(row)
    if options.check and problems:
        sys.exit("\n".join(problems))


if __name__ == "__main__":
    main()
