#!/usr/bin/env python3
"""The test of the architecture: adding a method is adding one folder of code and one of shaders.

Copies the source tree, adds a method as ./dev method does, builds the command line and asks it for the new method:
list, describe, render. Usage: add_method.py ROOT FOLDER [CMAKE_ARGUMENT...]
"""
import os
import shutil
import sys

from try_added_method import ADDED, run, try_method


def main():
    root, folder = (os.path.realpath(path) for path in sys.argv[1:3])
    shutil.rmtree(folder, ignore_errors=True)
    tree, build = os.path.join(folder, "source"), os.path.join(folder, "build")
    shutil.copytree(root, tree, ignore=shutil.ignore_patterns(".git", "build", "results", "__pycache__"),
                    symlinks=True)
    run(os.path.join(tree, "renderers", "methods", "new_method.py"), ADDED)
    os.environ["CCACHE_BASEDIR"] = folder
    run("cmake", "-S", tree, "-B", build, "-DINTERREFLECT_GUI=OFF", "-DINTERREFLECT_TESTS=OFF", *sys.argv[3:])
    run("cmake", "--build", build, "--target", "interreflect-cli", "--parallel", "2")
    cli = os.path.join(build, "bin", "interreflect-cli")
    try_method(cli, folder)
    shutil.rmtree(folder)


main()
