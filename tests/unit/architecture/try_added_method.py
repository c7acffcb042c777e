#!/usr/bin/env python3
"""Adding a method is adding one folder of code and one of shaders: asks a command line that has a copy of an example
under a new name for it: list, describe, render; and holds the example's length. Usage: try_added_method.py CLI ROOT FOLDER; see long/ for the build
of a whole tree."""
import json
import os
import subprocess
import sys

EXAMPLE, ADDED = "view-normals", "added-method"
# Lines of code that a new method begins with.
MAX_LINES = {"renderers": 60, "shaders": 20}


def run(*command):
    print("$", " ".join(command), flush=True)
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def link(source, target):
    os.makedirs(os.path.dirname(target), exist_ok=True)
    if not os.path.lexists(target):
        os.symlink(source, target)


def link_shaders(root, folder):
    """All shaders of the tree in FOLDER/shaders, beside those of the added method."""
    for name in os.listdir(os.path.join(root, "shaders")):
        if name != "methods":
            link(os.path.join(root, "shaders", name), os.path.join(folder, "shaders", name))
    methods = os.path.join(root, "shaders", "methods")
    for name in os.listdir(methods):
        link(os.path.join(methods, name), os.path.join(folder, "shaders", "methods", name))


def count_lines(root):
    for part, most in MAX_LINES.items():
        folder = os.path.join(root, part, "methods", EXAMPLE)
        lines = sum(len(open(os.path.join(folder, name), encoding="utf-8").readlines()) for name in os.listdir(folder))
        assert lines <= most, f"{folder} has {lines} lines, {most} are the limit"


def try_method(cli, folder):
    """Lists, describes and renders it, and compares the picture with that of the example."""
    assert ADDED in run(cli, "list"), "the new method is not listed"
    added, example = (json.loads(run(cli, "describe", name, "--json")) for name in (ADDED, EXAMPLE))
    assert added["id"] == ADDED and added["parameters"] == example["parameters"], "it is described otherwise"
    pictures = []
    for name in (ADDED, EXAMPLE):
        pictures.append(os.path.join(folder, name + ".exr"))
        run(cli, "render", "--scene", "builtin:cornell", "--method", name, "--size", "32x32", "--out", pictures[-1])
    run(cli, "compare", *pictures, "--fail-above", "rmse=0")


if __name__ == "__main__":
    cli, root, folder = sys.argv[1:]
    count_lines(root)
    link_shaders(root, folder)
    os.environ["INTERREFLECT_DATA"] = folder
    try_method(cli, folder)
