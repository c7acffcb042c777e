#!/usr/bin/env python3
"""Compares the defaults on the methods' pages with those of the program. Usage: check_defaults.py ROOT PROGRAM

A row of a table with the columns `parameter` and `default` has keys and as many values, both separated by commas.
"""
import json
import re
import subprocess
import sys
from pathlib import Path

UNITS = {"px": ("px", "pixels"), "°": ("degrees",)}  # on a page: as the program writes it


def tables_of(text):
    """The rows of each table as lists of cells, its header first."""
    for table in re.findall(r"(?:^\|.*\n)+", text, re.M):
        rows = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip()[1:-1])] for line in table.splitlines()]
        if len(rows) > 2:
            yield [rows[0], *rows[2:]]


def is_written(value, unit, text):
    """Whether `text` is how a page writes the value."""
    if isinstance(value, bool):
        return text == ("on" if value else "off")
    if isinstance(value, str):
        return text.strip("`") == value
    number = re.fullmatch(r"(-?[\d,]*\.?\d+) ?(.*)", text)
    return bool(number) and float(number[1].replace(",", "")) == value and (
        not number[2] or unit in UNITS.get(number[2], (number[2],)))


def problems_of(row, parameters):
    keys = re.findall(r"`([^`]+)`", row[0])
    values = row[1].split(", ")
    if len(keys) != len(values):
        yield f"{row[0]} has {len(keys)} parameters and {len(values)} defaults"
        return
    for key, text in zip(keys, values):
        if key not in parameters:
            yield f"`{key}` is no parameter of the method"
        elif not is_written(parameters[key]["default"], parameters[key].get("unit", ""), text):
            parameter = parameters[key]
            yield f"`{key}` has the default {text}, the program {parameter['default']} {parameter.get('unit', '')}"


def main():
    root, program = Path(sys.argv[1]), sys.argv[2]
    problems, compared = [], 0
    for page in sorted((root / "docs/methods").glob("*.md")):
        answer = subprocess.run([program, "describe", page.stem, "--json"], check=True, capture_output=True)
        parameters = {each["key"]: each for each in json.loads(answer.stdout)["parameters"]}
        for header, *rows in tables_of(page.read_text(encoding="utf-8")):
            if header[:2] == ["parameter", "default"]:
                compared += len(rows)
                problems += [f"docs/methods/{page.name}: {each}" for row in rows for each in problems_of(row, parameters)]
    if not compared:
        problems.append("no page has a table of defaults")
    sys.exit("\n".join(problems) or None)


main()
