#!/usr/bin/env python3
"""Compiles every header alone, with the flags of the build.

Headers that some .cpp includes before anything else were proven by the build already; the others are compiled
here, with the flags of a .cpp of the same folder or one above. Usage: check_headers.py ROOT BUILD [--all]
Without --all the folders whose sources are compiled together are left out.
"""
import concurrent.futures
import json
import os
import re
import shlex
import subprocess
import sys

FOLDERS = ("app", "widgets", "projects", "renderers")
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<][^">]+[">])', re.MULTILINE)


UNITY_SOURCE = re.compile(r'^#include "([^"]+\.cpp)"', re.MULTILINE)


def sources_of(entry):
    """The source, or those that CMake compiles together in its place."""
    if f"{os.sep}Unity{os.sep}" not in entry["file"]:
        return [entry["file"]]
    with open(entry["file"], encoding="utf-8") as file:
        return UNITY_SOURCE.findall(file.read())


def flags_by_folder(build):
    """The flags with which the files of each folder are compiled, without -o, -c and the file."""
    result = {}
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        for entry in json.load(file):
            words = shlex.split(entry["command"])
            kept, skip = [], False
            for word in words:
                if skip or word in ("-c", "-o", "-MD", "-MF", "-MT", "-include", entry["file"]) or word.endswith("ccache"):
                    skip = word in ("-o", "-MF", "-MT", "-include")
                    continue
                kept.append(word)
            for source in sources_of(entry):
                result.setdefault(os.path.dirname(source), kept)
    return result


def flags_for(header, root, flags):
    """Those of the header's folder, else of the nearest folder that shares most of its path."""
    folder = os.path.dirname(os.path.join(root, header))
    while len(folder) >= len(root):
        inside = sorted(f for f in flags if f == folder or f.startswith(folder + os.sep))
        if inside:
            return flags[inside[0]]
        folder = os.path.dirname(folder)
    return None


def proven_by_the_build(root, build):
    """Headers that a source, compiled by itself, includes first; and folders whose sources are compiled together."""
    proven, together = set(), set()
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        for entry in json.load(file):
            if len(sources_of(entry)) != 1 or sources_of(entry)[0] != entry["file"]:
                together.update(os.path.dirname(source) for source in sources_of(entry))
                continue
            if not entry["file"].startswith(root + os.sep):
                continue
            with open(entry["file"], encoding="utf-8") as source:
                first = INCLUDE.search(source.read())
            if first and first.group(1)[0] == '"':
                proven.add(first.group(1)[1:-1])
    return proven, together


def compile_alone(root, header, flags):
    text = f'#include "{header}"\n'
    run = subprocess.run(flags + ["-fsyntax-only", "-O0", "-x", "c++", "-"], input=text, cwd=root,
                         capture_output=True, text=True, check=False)
    return header, run.returncode, run.stderr


def main():
    root, build = (os.path.realpath(path) for path in sys.argv[1:3])
    flags, (proven, together) = flags_by_folder(build), proven_by_the_build(root, build)
    headers = [os.path.relpath(os.path.join(folder, name), root)
               for top in FOLDERS for folder, _, names in os.walk(os.path.join(root, top))
               for name in names if name.endswith(".h")]
    configured = {header: flags_for(header, root, flags) for header in sorted(headers)}
    todo = [header for header in configured if header not in proven and configured[header] and
            any(folder.startswith(os.path.join(root, *header.split(os.sep)[:2])) for folder in flags)]
    if "--all" not in sys.argv:  # what compiles together has heavy headers: minutes
        todo = [header for header in todo if os.path.dirname(os.path.join(root, header)) not in together]
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for header, code, errors in pool.map(lambda h: compile_alone(root, h, configured[h]), todo):
            if code:
                failed += 1
                print(f"{header} does not compile alone:\n{errors}")
    print(f"{len(headers)} headers: {len(todo)} compiled alone, {failed} failed, "
          f"{len(proven & set(headers))} proven by the build")
    return 1 if failed or not headers else 0


sys.exit(main())
