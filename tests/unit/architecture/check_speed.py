#!/usr/bin/env python3
"""Sources of renderers/ that work on pixels, rays or triangles on the host are compiled for speed: those in folders
host/ and those whose names end in _on_host. Reads the build's compile_commands.json.

    check_speed.py ROOT BUILD
"""

import json
import pathlib
import re
import sys

ON_HOST = re.compile(r"renderers/.*(/host/|_on_host\.cpp$)")


def sources_of(file):
    """A source, or those that a file of a unity build includes."""
    if "/Unity/" not in file:
        return [file]
    return re.findall(r'#include "(.*?)"', pathlib.Path(file).read_text())


def main():
    root, build = sys.argv[1:]
    slow = set()
    for entry in json.loads((pathlib.Path(build) / "compile_commands.json").read_text()):
        levels = re.findall(r"(?:^| )(-O\w*)", entry["command"])
        if levels and levels[-1] == "-Og":
            slow.update(s for s in sources_of(entry["file"]) if s.endswith(".cpp") and ON_HOST.search(s))
    if slow:
        sys.exit("compiled with -Og; see ir_compile_for_speed in the CMakeLists.txt of their library:\n" +
                 "\n".join(sorted(s.removeprefix(root + "/") for s in slow)))


if __name__ == "__main__":
    main()
