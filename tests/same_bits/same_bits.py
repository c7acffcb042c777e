#!/usr/bin/env python3
"""Renders the same at two commits and compares all buffers bit by bit.

    same_bits.py [--quick] [--method ID]… BASE OTHER

BASE and OTHER are commits, each of which is built in build/same-bits, or programs that are built already. The BASE
`before` is HEAD where something is not committed yet; else where this branch left its upstream; else HEAD's parent.
Every method renders at its defaults on four built-in scenes, by EGL and by OSMesa, and on one scene with each
choice of each of its parameters, --quick without those; always two frames with a pixel picked, so that histories
and explanations are there. --method may be given several times. The exit status is 1 where a bit differs.
"""
import argparse
import concurrent.futures
import datetime
import hashlib
import json
import os
import struct
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "build" / "same-bits"
SCENES = ["builtin:caustics", "builtin:still-life", "builtin:dominoes", "builtin:cornell"]  # the first with choices
BACKENDS = ["egl", "osmesa"]
SIZE = "48x32"
PARTS_FLAG = 0x1000  # of an EXR file's version: several parts


def git(*words):
    """What a command of git says; nothing where it fails."""
    return subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True).stdout.strip()


def commit_before():
    """The commit that this tree is to be compared with: never one of the same content."""
    if git("status", "--porcelain", "--untracked-files=no"):
        return "HEAD"
    left = git("merge-base", "HEAD", "@{upstream}")
    return left if left and left != git("rev-parse", "HEAD") else "HEAD~1"


def program_of(commit):
    """The command-line program of a commit, or the program that it already is."""
    if Path(commit).is_file():
        return Path(commit).resolve()
    commit = subprocess.check_output(["git", "rev-parse", "--verify", commit + "^{commit}"], cwd=ROOT, text=True)
    source = FOLDER / commit.strip()
    if not source.exists():
        subprocess.run(["git", "worktree", "prune"], cwd=ROOT, check=True)
        subprocess.run(["git", "worktree", "add", "--detach", "--force", source, commit.strip()], cwd=ROOT,
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    quiet = {"stdout": subprocess.DEVNULL, "check": True, "cwd": source,
             "env": {**os.environ, "CCACHE_BASEDIR": str(source), "CCACHE_NOHASHDIR": "1"}}
    if not (source / "build/release/build.ninja").exists():
        subprocess.run(["cmake", "--preset", "release", "-DINTERREFLECT_GUI=OFF"], **quiet)
    subprocess.run(["cmake", "--build", "build/release", "--target", "interreflect-cli"], **quiet)
    return source / "build/release/bin/interreflect-cli"


def describe(cli, *words):
    return json.loads(subprocess.check_output([cli, *words, "--json"], text=True))


def jobs_of(cli, quick, wanted):
    """All renders by name: what is given to `render`."""
    jobs = {}
    for method in (entry["id"] for entry in describe(cli, "list")):
        if wanted and method not in wanted:
            continue
        for scene in SCENES:
            for backend in BACKENDS:
                jobs[f"{method} on {scene}, {backend}"] = [
                    "--method", method, "--scene", scene, "--backend", backend]
        if quick:
            continue
        for parameter in describe(cli, "describe", method)["parameters"]:
            values = [choice["key"] for choice in parameter.get("choices", [])]
            if parameter["type"] == "toggle":
                values = ["true", "false"]
            for value in values:
                if value == str(parameter["default"]).lower():
                    continue
                setting = f"{parameter['key']}={value}"
                jobs[f"{method} with {setting}"] = [
                    "--method", method, "--scene", SCENES[0], "--backend", "egl", "--set", setting]
    return jobs


def string_at(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def header_at(data, at):
    """The attributes of one part and where they end."""
    attributes = {}
    while data[at] != 0:
        name, at = string_at(data, at)
        _, at = string_at(data, at)
        size, = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def layers_of(file):
    """Of each part of an EXR file its channels and stored pixels, as one hash."""
    data = file.read_bytes()
    version, = struct.unpack_from("<i", data, 4)
    headers, at = [], 8
    while not headers or (version & PARTS_FLAG and data[at] != 0):
        header, at = header_at(data, at)
        headers.append(header)
    if not version & PARTS_FLAG:
        raise ValueError(f"{file} has one part; dumps have several")
    at += 1
    chunks = [struct.unpack("<i", header["chunkCount"])[0] for header in headers]
    hashes = [hashlib.sha256(header["channels"] + header["dataWindow"]) for header in headers]
    offsets = struct.unpack_from(f"<{sum(chunks)}Q", data, at)
    for offset in offsets:
        part, _, size = struct.unpack_from("<3i", data, offset)
        hashes[part].update(data[offset + 12:offset + 12 + size])
    return {header["name"].decode(): content.hexdigest() for header, content in zip(headers, hashes)}


def render(cli, name, arguments, folder):
    """The hashes of all buffers, or what the program said when it refused."""
    out = folder / (hashlib.md5(name.encode()).hexdigest() + ".exr")
    done = subprocess.run(
        [cli, "render", *arguments, "--size", SIZE, "--frames", "2", "--pick", "24,16", "--dump", "*", "--quiet",
         "--threads", "1", "--out", out], capture_output=True, text=True, timeout=600,
        env={**os.environ, "LP_NUM_THREADS": "0"})  # Mesa's threads append to lists in any order
    if done.returncode != 0:
        return {"refused": done.stderr.strip().splitlines()[-1:]}
    layers = layers_of(out)
    out.unlink()
    return layers


def differing_keys(before, after):
    return sorted(key for key in {**before, **after} if before.get(key) != after.get(key))


def compare(item, programs, folder):
    """The keys that differ, and those that differ at BASE already when it renders again: lists that many threads
    append to, and room that nothing was written to."""
    before, after = (render(program, *item, folder) for program in programs)
    differing, unstable = differing_keys(before, after), set()
    for _ in range(2):
        if differing and "refused" not in differing:
            unstable.update(differing_keys(before, render(programs[0], *item, folder)))
    for key in differing:
        if key == "refused":
            print(f"    before: {before.get(key)}\n    after:  {after.get(key)}", flush=True)
    return [key for key in differing if key not in unstable], sorted(unstable)


def differences(jobs, programs, folder):
    """Prints each render whose buffers differ; their number. What is other at each run of one render is compared in
    none: elsewhere two runs may be the same by chance."""
    found, unstable = {}, set()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as workers:
        results = workers.map(lambda item: compare(item, programs, folder), jobs.items())
        for number, (name, (keys, not_compared)) in enumerate(zip(jobs, results), 1):
            if sys.stderr.isatty():
                print(f"\r{number} of {len(jobs)}\033[K", end="", file=sys.stderr)
            unstable.update(not_compared)
            found[name] = keys
    if unstable:
        print(f"not compared, other at each run of BASE: {', '.join(sorted(unstable))}")
    differing = {name: [key for key in keys if key not in unstable] for name, keys in found.items()}
    for name, keys in differing.items():
        if keys:
            print(f"{name}: {', '.join(keys)}", flush=True)
    return sum(1 for keys in differing.values() if keys)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("base")
    parser.add_argument("other")
    parser.add_argument("--method", action="append")
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    FOLDER.mkdir(parents=True, exist_ok=True)
    base = commit_before() if arguments.base == "before" else arguments.base
    print(f"{datetime.date.today()}: compared with {base}", flush=True)
    programs = [program_of(base), program_of(arguments.other)]
    every = [jobs_of(program, arguments.quick, arguments.method) for program in programs]
    for name in sorted(every[0].keys() ^ every[1].keys()):
        print(f"only at one commit, not compared: {name}")
    jobs = {name: job for name, job in every[0].items() if name in every[1]}
    differing = differences(jobs, programs, FOLDER)
    print(f"{len(jobs)} renders, {differing} differ")
    return differing > 0 or not jobs


if __name__ == "__main__":
    sys.exit(main())
