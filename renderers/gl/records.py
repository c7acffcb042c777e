#!/usr/bin/env python3
"""Writes C++ headers of the records and constants that shaders and host share, so that they stand once: in GLSL.

A struct or block whose comment has the line "C++: ir::some::Name" becomes a struct with IR_FIELDS in the header
OUT/shaders/PATH.glsl.h of its file shaders/PATH.glsl; a record may hold records of the same file. A name that is a
word of GLSL ends in "_" there, and not in C++. A record that std430 lays out with gaps is refused. A constant whose
comment has "C++: ir::some::name" becomes an inline constexpr one; its value is a number. Usage:
records.py ROOT OUT, or records.py --list ROOT for the files that have any.
"""
import re
import sys
from pathlib import Path

# In C++, bytes, and bytes that std430 aligns it to.
TYPES = {"float": ("float", 4, 4), "int": ("std::int32_t", 4, 4), "uint": ("std::uint32_t", 4, 4),
         "vec2": ("glm::vec2", 8, 8), "vec3": ("glm::vec3", 12, 16), "vec4": ("glm::vec4", 16, 16),
         "ivec2": ("glm::ivec2", 8, 8), "uvec2": ("glm::uvec2", 8, 8), "mat4": ("glm::mat4", 64, 16)}
MARK = "// C++: "
RECORD = re.compile(r"((?:^//[^\n]*\n)*)^(?:struct|layout\(std430\)[a-z ]* buffer) (\w+) \{\n(.*?)^\}", re.M | re.S)
CONSTANT = re.compile(r"((?:^//[^\n]*\n)+)^const (float|int|uint) \w+ = ([^;\n]+);", re.M)
NUMBERS = {"float": r"-?\d+(\.\d*(e-?\d+)?|e-?\d+)", "int": r"-?\d+", "uint": r"(0x[0-9a-f]+|\d+)u"}
MEMBERS = re.compile(r"\s*(\w+) ([^;]+);\s*(?://\s?(.*))?$")


def members_of(body, types, path):
    """(type, name, comment, bytes, alignment) of each member, in order; without a type: a comment that goes on."""
    for line in body.splitlines():
        if line.strip().startswith("//"):
            yield None, None, line.strip()[2:].strip(), 0, 1
            continue
        match = MEMBERS.match(line)
        if not match or match[1] not in types:
            sys.exit(f"{path}: the line '{line.strip()}' of a record is no 'type name;  // comment' with one of "
                     f"{', '.join(types)}")
        names = [name.strip() for name in match[2].split(",")]
        for name in names:
            kind, size, alignment = types[match[1]]
            if array := re.fullmatch(r"(\w+)\[(\d+)\]", name):
                if size % alignment:
                    sys.exit(f"{path}: std430 leaves gaps in '{name}', which C++ does not; declare floats")
                kind, size, name = f"std::array<{kind}, {array[2]}>", size * int(array[2]), array[1]
            is_last = re.match(r"\w+", names[-1])[0] == name
            yield kind, name.removesuffix("_"), match[3] if is_last else None, size, alignment


def record_of(comment, name, body, types, path):
    """The C++ struct, and what TYPES has of it."""
    lines = documented(comment) + [f"struct {name} {{"]
    names, end, widest = [], 0, 4
    for kind, member, note, size, alignment in members_of(body, types, path):
        code = f"{kind} {member}{{}};" if kind else ""
        lines.append(f"    {code}  ///< {note}" if note else f"    {code}")
        names += [member] if kind else []
        if end % alignment:
            sys.exit(f"{path}: std430 leaves a gap before '{name}.{member}', which C++ does not; declare floats there")
        end, widest = end + size, max(widest, alignment)
    if end % widest:
        sys.exit(f"{path}: std430 leaves a gap behind '{name}', which C++ does not; name it or declare floats")
    return "\n".join(lines + [f"    IR_FIELDS({', '.join(names)})", "};"]), (name, end, widest)


def documented(comment):
    """The lines of a comment but for the mark, as C++ has them."""
    return [f"/// {line.lstrip('/').strip()}" for line in comment.splitlines() if not line.startswith(MARK)]


def marked_names(comment):
    """(namespace, name) of each mark in a comment."""
    for line in comment.splitlines():
        if line.startswith(MARK):
            yield line[len(MARK):].strip().rsplit("::", 1)


def constant_of(comment, name, kind, value, path):
    """The C++ constant."""
    if not re.fullmatch(NUMBERS[kind], value):
        sys.exit(f"{path}: the constant '{name}' is for C++, too, so its value is a number, not '{value}'")
    suffix = "f" if kind == "float" else ""
    return "\n".join(documented(comment) + [f"inline constexpr {TYPES[kind][0]} {name} = {value}{suffix};"])


def header_of(path, text):
    """The header's text; None where nothing is marked."""
    records, types = [], dict(TYPES)
    within = "namespace {} {{\n\n{}\n\n}}  // namespace {}\n".format
    for comment, kind, value in CONSTANT.findall(text):
        for space, name in marked_names(comment):
            records.append(within(space, constant_of(comment, name, kind, value, path), space))
    for comment, glsl_name, body in RECORD.findall(text):
        for space, name in marked_names(comment):
            record, types[glsl_name] = record_of(comment, name, body, types, path)
            records.append(within(space, record, space))
    if len(records) != text.count("\n" + MARK) + text.startswith(MARK):
        sys.exit(f"{path}: '{MARK}' stands in the comment right above a struct, block or constant, once")
    return "\n".join([f"// Made from {path}: edit that.\n#pragma once\n\n#include <array>\n#include <cstdint>\n"
                      '#include <glm/glm.hpp>\n\n#include "renderers/core/fields.h"\n'] + records) if records else None


def headers_of(root):
    """(path, text) of each header, by the shader's path below the root."""
    for shader in sorted((root / "shaders").rglob("*.*")):
        path = shader.relative_to(root).as_posix()
        if text := header_of(path, shader.read_text(encoding="utf-8")):
            yield path, text


def main():
    if sys.argv[1] == "--list":
        print(";".join(path for path, _ in headers_of(Path(sys.argv[2]))), end="")
        return
    for path, text in headers_of(Path(sys.argv[1])):
        header = Path(sys.argv[2]) / (path + ".h")
        header.parent.mkdir(parents=True, exist_ok=True)
        if not header.exists() or header.read_text(encoding="utf-8") != text:
            header.write_text(text, encoding="utf-8")


main()
