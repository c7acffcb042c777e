#!/usr/bin/env python3
"""The test of the architecture: adding a method is adding one folder of code and one of shaders.

Copies the source tree, adds a method by copying the folders of an example under a new name, builds the command
line and asks it for the new method: list, describe, render. Usage: add_method.py ROOT FOLDER [CMAKE_ARGUMENT...]
"""
import os
import shutil
import sys

from try_added_method import ADDED, EXAMPLE, run, try_method


def copy_with_new_name(source, target):
    """The whole folder, with the example's id, namespace and file names replaced."""
    for folder, _, names in os.walk(source):
        there = os.path.join(target, os.path.relpath(folder, source))
        os.makedirs(there, exist_ok=True)
        for name in names:
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                text = file.read()
            text = text.replace(EXAMPLE, ADDED).replace("namespace ir::methods::view_normals",
                                                        "namespace ir::methods::added_method")
            with open(os.path.join(there, name), "w", encoding="utf-8") as file:
                file.write(text)


def main():
    root, folder = (os.path.realpath(path) for path in sys.argv[1:3])
    shutil.rmtree(folder, ignore_errors=True)
    tree, build = os.path.join(folder, "source"), os.path.join(folder, "build")
    shutil.copytree(root, tree, ignore=shutil.ignore_patterns(".git", "build", "results", "__pycache__"),
                    symlinks=True)
    for top in ("renderers", "shaders"):
        copy_with_new_name(os.path.join(root, top, "methods", EXAMPLE),
                           os.path.join(tree, top, "methods", ADDED))
    os.environ["CCACHE_BASEDIR"] = folder
    run("cmake", "-S", tree, "-B", build, "-DINTERREFLECT_GUI=OFF", "-DINTERREFLECT_TESTS=OFF", *sys.argv[3:])
    run("cmake", "--build", build, "--target", "interreflect-cli", "--parallel", "2")
    cli = os.path.join(build, "bin", "interreflect-cli")
    try_method(cli, folder)
    shutil.rmtree(folder)


main()
