#!/usr/bin/env python3
"""Renders every method with different threads and memory budgets and compares the pictures bit by bit.

    same_choices.py [--method ID]… PROGRAM

The pictures alone are compared: lists that threads append to may be in any order. Each method renders two
built-in scenes on each processor that it has, with 1, 2 and 8 threads, and with two thirds of the memory that it
took. The exit status is 1 where threads change a bit. Whether a budget does is told: batches of maps are added up in
another order, to rounding. A budget that is refused is not compared.
"""
import argparse
import hashlib
import json
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

from same_bits import SIZE, describe, header_at

SCENES = ["builtin:cornell", "builtin:crevice"]
PROCESSORS = ["gl", "host"]
THREADS = [1, 2, 8]
BUDGET = 2 / 3


def pixels_of(file):
    """The hash of the pixels as an EXR file of one part stores them, behind header and table of offsets."""
    data = file.read_bytes()
    _, at = header_at(data, 8)
    begin, = struct.unpack_from("<Q", data, at)
    return hashlib.sha256(data[begin:]).hexdigest()


def render(cli, folder, *words):
    """The picture's hash and its statistics; nothing and the reason where it is refused."""
    out, statistics = folder / "a.exr", folder / "a.json"
    done = subprocess.run([cli, "render", *words, "--size", SIZE, "--frames", "2", "--quiet", "--out", out, "--json",
                           statistics], capture_output=True, text=True, timeout=600)
    if done.returncode != 0:
        return None, done.stderr.strip()
    report = json.loads(statistics.read_text(encoding="utf-8"))
    return pixels_of(out), report


def peak_of(report):
    """Bytes that the graph's buffers took at most."""
    return next((report[key] for key in ("peak_memory_bytes", "peak_bytes") if key in report), 0)


def choices(cli, folder, words):
    """What each choice gives, by its name."""
    for threads in THREADS:
        picture, report = render(cli, folder, *words, "--threads", str(threads))
        yield f"{threads} threads", picture, report
        if threads == 1 and picture and peak_of(report):
            budget = int(BUDGET * peak_of(report))
            yield (f"{budget} bytes", *render(cli, folder, *words, "--threads", "1", "--memory", str(budget)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--method", action="append")
    arguments = parser.parse_args()
    cli = arguments.program.resolve()
    rendered, differing = 0, 0
    with tempfile.TemporaryDirectory() as place:
        for method in [entry["id"] for entry in describe(cli, "list")]:
            if arguments.method and method not in arguments.method:
                continue
            for scene in SCENES:
                for processor in PROCESSORS:
                    words = ["--method", method, "--scene", scene, "--processor", processor]
                    first = None
                    for name, picture, report in choices(cli, Path(place), words):
                        if not picture:
                            print(f"{method} on {scene}, {processor}, {name}: refused: {report[:160]}", flush=True)
                            continue
                        rendered += 1
                        first = first or picture
                        if picture != first:
                            differing += name.endswith("threads")
                            print(f"{method} on {scene}, {processor}, {name}: differs", flush=True)
    print(f"{rendered} pictures, {differing} differ by threads")
    return differing > 0 or rendered == 0


if __name__ == "__main__":
    sys.exit(main())
