#!/usr/bin/env python3
"""Checks that what the documentation promises names tests, and that these exist: each line of the tables under
"tests" in the pages below.

Usage: check_promises.py ROOT
"""
import re
import sys
from pathlib import Path

PAGES = ["docs/security.md", "docs/reproducibility.md", "docs/testing.md"]
TEST = re.compile(r"^TEST(?:_F|_P)?\((\w+), (\w+)\)", re.MULTILINE)


def cells_of(line):
    return [cell.strip() for cell in line.strip("|").split("|")]


def promises_of(page):
    """Each row of the tables whose last column is called tests."""
    is_promise = False
    for line in page.read_text(encoding="utf-8").splitlines():
        if not line.startswith("|"):
            is_promise = False
        elif cells_of(line)[-1] == "tests":
            is_promise = True
        elif is_promise and not line.startswith("|---"):
            yield cells_of(line)


def main():
    root = Path(sys.argv[1])
    tests = {f"{suite}.{name}" for file in root.glob("tests/**/*.cpp")
             for suite, name in TEST.findall(file.read_text(encoding="utf-8"))}
    problems = []
    for page in PAGES:
        promises = list(promises_of(root / page))
        problems += [f"{page} promises nothing"] * (not promises)
        for promise, *_, cell in promises:
            named = re.findall(r"`([^`]+)`", cell)
            problems += [f"{page}: '{promise}' names no test"] * (not named)
            problems += [f"{page}: '{promise}' names {name}, which does not exist" for name in named if name not in tests]
    sys.exit("\n".join(problems) or None)


main()
