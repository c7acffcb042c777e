#!/usr/bin/env python3
"""Checks shaders for what some drivers accept and others do not. Usage: check_shaders.py ROOT

- A block whose program uses nothing of it but length(): NVIDIA's driver takes the block for unused, and the length
  is 0. Capacities of such buffers are uniforms.
- a = b = 0 where b is writeonly: the value of the inner assignment is read, which NVIDIA's linker refuses.

Conditions of the preprocessor are not looked at: what stands under any of them counts.
"""
import re
import sys
import tempfile
import unittest
from pathlib import Path

ENTRY_POINTS = {".vert", ".tesc", ".tese", ".geom", ".frag", ".comp"}
BLOCK = re.compile(r"layout\([^)]*\)\s*((?:\w+\s+)*)buffer\s+(\w+)\s*\{([^}]*)\}\s*(\w*)")
DEFINES = re.compile(r"^[ \t]*#define(?:[^\n]*\\\n)*[^\n]*", re.M)
FUNCTION = re.compile(r"^[ \t]*(?:\w+[ \t]+)+(\w+)[ \t]*\([^;{}]*\)\s*\{", re.M)


def expanded(path, shaders, seen):
    """The file with its includes, each once, without comments."""
    if path in seen or not path.is_file():
        return ""
    seen.add(path)
    text = re.sub(r"//[^\n]*|/\*.*?\*/", "", path.read_text(encoding="utf-8"), flags=re.S)

    def include(match):
        beside = path.parent / match[1]
        return expanded(beside if beside.is_file() else shaders / match[1], shaders, seen)
    return re.sub(r'#include "([^"]*)"', include, text)


def body_at(text, begin):
    """What follows an opening brace, up to the one that closes it."""
    depth, end = 1, begin
    while depth and end < len(text):
        depth += {"{": 1, "}": -1}.get(text[end], 0)
        end += 1
    return text[begin:end]


def reached(text):
    """The bodies of main() and of all functions that it may call, and what macros stand for."""
    bodies = {}
    for match in FUNCTION.finditer(text):
        bodies[match[1]] = bodies.get(match[1], "") + body_at(text, match.end())
    macros = "\n".join(DEFINES.findall(text))
    found, left = {}, ["main", *re.findall(r"\w+", macros)]
    while left:
        name = left.pop()
        if name in bodies and name not in found:
            found[name] = bodies[name]
            left += set(re.findall(r"\w+", bodies[name]))
    return "\n".join([*found.values(), macros])


def faults(path, shaders):
    text = expanded(path, shaders, set())
    used = reached(text)
    for qualifiers, block, members, _ in BLOCK.findall(text):
        names = [re.match(r"\w+", name.strip())[0] for member in members.split(";") if member.strip()
                 for name in member.strip().split(None, 1)[1].split(",")]
        if re.search(rf"(?<!\.)\b({'|'.join(names)})\.length\(\)", used) and not re.search(
                rf"(?<!\.)\b({'|'.join(names)})\b(?!\.length\(\))", used):
            yield f"{path.relative_to(shaders)}: nothing but length() is used of {block}; give its capacity as a uniform"
        if "writeonly" in qualifiers:
            for name in names:
                if re.search(rf"=\s*{name}(\[[^\]]*\])?(\.\w+)?\s*=[^=]", used):
                    yield f"{path.relative_to(shaders)}: {name} of {block} is writeonly; assign to it alone"


class Rules(unittest.TestCase):
    def faults_of(self, text):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.comp"
            path.write_text(text, encoding="utf-8")
            return [fault.split(": ", 1)[1] for fault in faults(path, Path(folder))]

    def test_lengths_alone(self):
        block = "layout(std430) buffer Words { uint words[]; };\n"
        self.assertEqual(self.faults_of(block + "uint f() { return words[0]; }\n"
                                                "void main() { uint n = uint(words.length()); }\n"),
                         ["nothing but length() is used of Words; give its capacity as a uniform"])
        self.assertEqual(self.faults_of(block + "uint f() { return words[0]; }\n"
                                                "void main() { if (words.length() > 1) f(); }\n"), [])
        self.assertEqual(self.faults_of(block + "void main() {}\n"), [])

    def test_assigned_in_a_row(self):
        block = "layout(std430) writeonly buffer Draw { uint first, count; };\n"
        self.assertEqual(self.faults_of(block + "void main() { first = count = 0u; }\n"),
                         ["count of Draw is writeonly; assign to it alone"])
        self.assertEqual(self.faults_of(block + "void main() { first = 0u; count = 0u; }\n"), [])

    def test_shaders(self):
        entries = [path for path in sorted(SHADERS.rglob("*")) if path.suffix in ENTRY_POINTS]
        self.assertGreater(len(entries), 50)
        self.assertEqual([fault for path in entries for fault in faults(path, SHADERS)], [])


if __name__ == "__main__":
    SHADERS = Path(sys.argv.pop(1)) / "shaders"
    unittest.main()
