#!/usr/bin/env python3
"""Checks that each threat of docs/security.md names tests, and that these exist.

Usage: check_security.py ROOT
"""
import re
import sys
from pathlib import Path

TEST = re.compile(r"^TEST(?:_F|_P)?\((\w+), (\w+)\)", re.MULTILINE)


def main():
    root = Path(sys.argv[1])
    tests = {f"{suite}.{name}" for file in root.glob("tests/**/*.cpp")
             for suite, name in TEST.findall(file.read_text(encoding="utf-8"))}
    _, _, threats = (root / "docs/security.md").read_text(encoding="utf-8").partition("\n## Threats\n")
    rows = [[cell.strip() for cell in line.strip("|").split("|")]
            for line in threats.splitlines() if line.startswith("|")][2:]
    problems = [] if rows else ["docs/security.md has no table of threats"]
    for threat, *_, cell in rows:
        named = re.findall(r"`([^`]+)`", cell)
        problems += [f"'{threat}' names no test"] * (not named)
        problems += [f"'{threat}' names {name}, which does not exist" for name in named if name not in tests]
    sys.exit("\n".join(problems) or None)


main()
