#!/usr/bin/env python3
"""What layered depth maps could share (the open question of Aalund 2015, §7): the table in docs/accuracy.md.

    PYTHONPATH=build/release/lib/python3/dist-packages tests/long/methods/ldm_sharing.py [--scene builtin:atrium]

Of the nodes of N maps it counts those of different surfaces in different cells of the world, as wide as a texel. The
others are duplicates. Then it predicts each depth from the texel to the left, and from another map whose nodes are
projected, and prints the entropy of what is left, in bits. Prints Markdown.
"""

import argparse

import interreflect as ir
import numpy as np

MAX_RESIDUAL = 255  # quanta; what is further off is written as it is
PLAIN_BITS = 16
MAX_SLOPE = 4000  # quanta a texel


class Map:
    def __init__(self, picture, number):
        points, frame = picture["ldm.points"], picture["ldm.frames"][number]
        there = np.abs(points["normal"]).sum(1) > 0
        self.position = points["position"][there].astype(float)
        self.normal = points["normal"][there].astype(float)
        self.row = {name: frame[name].astype(float) for name in frame.dtype.names}
        self.texel = 0.5 * (np.linalg.norm(self.row["step_u"][:3]) + np.linalg.norm(self.row["step_v"][:3]))

    def __len__(self):
        return len(self.position)

    def cells(self, size):
        """One number for each node: its cell of the world and, in eighths, its normal, whichever side it looks to."""
        cell = np.floor(self.position / size).astype(np.int64) + 2**15
        side = np.round(self.normal * 8).astype(np.int64)
        first = np.where(side[:, 0] != 0, side[:, 0], np.where(side[:, 1] != 0, side[:, 1], side[:, 2]))
        side = np.where(first[:, None] < 0, -side, side) + 8
        return ((cell @ [2**32, 2**16, 1]) << 15) + side @ [400, 20, 1]

    def seen_along(self, other):
        """Texel and depth at its centre of its nodes in another map, and what depths change by over a texel."""
        row = other.row
        at = [self.position @ row[axis][:3] + row[axis][3] for axis in ("u", "v", "depth")]
        facing = self.normal @ row["direction"][:3]
        facing = np.where(np.abs(facing) < 1e-3, 1e-3, facing) * row["direction"][3]
        slopes = [np.clip(-(self.normal @ row[step][:3]) / facing, -MAX_SLOPE, MAX_SLOPE)
                  for step in ("step_u", "step_v")]
        texel = np.floor(at[0]), np.floor(at[1])
        depth = at[2] + sum(s * (t + 0.5 - a) for s, t, a in zip(slopes, texel, at))
        return texel[1] * 4096 + texel[0], np.round(depth), slopes[0]


def residuals(texels, depths, guess_texels, guesses):
    """Of each depth to the nearest guess for its texel; huge where there is none."""
    span = 2.0**20
    sorted_guesses = np.sort(guess_texels * span + guesses + span / 4)
    wanted = texels * span + depths + span / 4
    best = np.full(len(wanted), 1e9)
    right = np.searchsorted(sorted_guesses, wanted)
    for place in (right - 1, right):
        gap = wanted - sorted_guesses[np.clip(place, 0, len(sorted_guesses) - 1)]
        best = np.where(np.abs(gap) < np.abs(best), gap, best)
    return np.round(best)


def bits(left):
    """A depth's entropy, where those that are too far off are written whole."""
    is_far = np.abs(left) > MAX_RESIDUAL
    _, counts = np.unique(np.where(is_far, MAX_RESIDUAL + 1, left), return_counts=True)
    part = counts / counts.sum()
    return -(part * np.log2(part)).sum() + PLAIN_BITS * is_far.mean()


def maps_of(arguments, directions, resolution, numbers):
    experiment = ir.Experiment("ldm-ao", arguments.scene, size=(8, 8), directions=directions, resolution=resolution,
                               nodes="plain", **({"camera": arguments.camera} if arguments.camera else {}))
    return [Map(experiment.render(outputs=["ldm.points", "ldm.frames"], choose={"map": number}), number)
            for number in numbers]


def count_duplicates(arguments, directions, resolution):
    maps = maps_of(arguments, directions, resolution, range(directions))
    size = np.mean([m.texel for m in maps])
    cells = [m.cells(size) for m in maps]
    nodes = sum(len(m) for m in maps)
    different = len(np.unique(np.concatenate(cells)))
    alone = sum(len(np.unique(c)) for c in cells)
    print(f"| {directions} maps of {resolution}² | {nodes / directions:,.0f} | {1 - alone / nodes:.2f} "
          f"| {1 - different / nodes:.2f} | {np.log2(different):.1f} |", flush=True)


def predict(arguments, directions, resolution):
    first, second = maps_of(arguments, directions, resolution, (directions // 2, directions // 2 + 1))
    texels, depths, slope = first.seen_along(first)
    flat = residuals(texels, depths, texels + 1, depths)
    sloped = residuals(texels, depths, texels + 1, np.round(depths + slope))
    there, guess, _ = second.seen_along(first)
    other = residuals(texels, depths, there, guess)
    better = np.where(np.abs(other) < np.abs(sloped), other, sloped)
    angle = np.degrees(np.arccos(min(1, abs(first.row["direction"][:3] @ second.row["direction"][:3]))))
    print(f"| {directions} maps of {resolution}² | {angle:.0f}° | {bits(flat):.1f} | {bits(sloped):.1f} "
          f"| {bits(other):.1f} | {bits(better) + 1:.1f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scene", default="builtin:atrium")
    parser.add_argument("--camera")
    parser.add_argument("--duplicates", nargs="*", default=["8,200", "16,200", "32,200", "16,100", "16,400"],
                        help="maps,resolution")
    parser.add_argument("--predictions", nargs="*", default=["32,200", "128,200", "512,200", "128,400"])
    arguments = parser.parse_args()
    settings = [[tuple(map(int, one.split(","))) for one in some]
                for some in (arguments.duplicates, arguments.predictions)]
    print("| maps | nodes a map | duplicates in a map | in all | bits of a reference |\n|---|---|---|---|---|")
    for one in settings[0]:
        count_duplicates(arguments, *one)
    print("\n| maps | apart | texel beside | with slopes | other map | better, and a bit |\n|---|---|---|---|---|---|")
    for one in settings[1]:
        predict(arguments, *one)


if __name__ == "__main__":
    main()
