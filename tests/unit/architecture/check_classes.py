#!/usr/bin/env python3
"""Checks that classes stay small: public functions, and lines of a class over all its files.

Counts each name of a public function once, without constructors, operators, overrides of Qt's virtual functions and
signals. Usage: check_classes.py ROOT [--table]
"""
import re
import sys
from pathlib import Path

FUNCTIONS, LINES = 25, 500
FOLDERS = ["app", "widgets", "projects", "renderers"]
CLASS = re.compile(r"^(class|struct) (\w+)(?: final)?(?: : [^;{]*)?\s*\{", re.M)
ACCESS = re.compile(r"(public|protected|private|signals)(?: slots)?:$")
# A declaration at the class's own indentation: its first name before a parenthesis.
FUNCTION = re.compile(r"    (?! )(?!friend|using|static_assert|explicit|operator|IR_|Q_|//)[^=;(]*?(\w+)\(")


def end_of_block(text, begin):
    """Behind the brace that closes the one before `begin`. Text in comments and strings has balanced braces."""
    depth = 1
    for match in re.compile(r"[{}]").finditer(text, begin):
        depth += 1 if match[0] == "{" else -1
        if depth == 0:
            return match.end()
    return len(text)


def public_functions(kind, name, body):
    names, depth = set(), 0
    access = "public" if kind == "struct" else "private"
    for line in body.splitlines():
        if depth == 0:
            if label := ACCESS.match(line.strip()):
                access = label[1]
            elif access == "public" and "override" not in line and "operator" not in line:
                found = FUNCTION.match(line)
                if found and found[1] != name:
                    names.add(found[1])
        depth += line.count("{") - line.count("}")
    return names


def classes_of(root):
    """(functions, lines, name, header) of all classes."""
    paths = [path for folder in FOLDERS for path in sorted((root / folder).rglob("*")) if path.suffix in (".h", ".cpp")]
    texts = {path: re.sub(r"//[^\n]*", "", path.read_text(encoding="utf-8")) for path in paths}
    definitions = {}  # lines of member functions by (folder, class)
    for path, text in texts.items():
        for match in re.finditer(r"^[^\s#/}][^\n;]*?\b(\w+)::~?\w+\(", text, re.M):
            brace = text.find("{", match.end())
            if path.suffix == ".cpp" and brace > 0:
                key = path.parent, match[1]
                definitions[key] = definitions.get(key, 0) + text[match.start():end_of_block(text, brace + 1)].count("\n") + 1
    for path, text in texts.items():
        for match in CLASS.finditer(text):
            body = text[match.end():end_of_block(text, match.end())]
            lines = body.count("\n") + definitions.get((path.parent, match[2]), 0)
            yield len(public_functions(match[1], match[2], body)), lines, match[2], path.relative_to(root)


def main():
    classes = sorted(classes_of(Path(sys.argv[1])), reverse=True)
    if "--table" in sys.argv:
        for functions, lines, name, header in classes[:40]:
            print(f"{functions:4} {lines:5}  {name}  {header}")
        return
    if len(classes) < 500:
        sys.exit(f"only {len(classes)} classes were found")
    sys.exit("\n".join(f"{header}: {name} has {functions} public functions and {lines} lines; {FUNCTIONS} and {LINES} are "
                       f"allowed" for functions, lines, name, header in classes
                       if functions > FUNCTIONS or lines > LINES) or None)


main()
