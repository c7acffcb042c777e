#!/usr/bin/env python3
"""Writes C++ headers of the records and constants that shaders and host share, so that they stand once: in GLSL.

A struct or block whose comment has the line "C++: ir::some::Name" becomes a struct with IR_FIELDS in the header
OUT/shaders/PATH.glsl.h of its file shaders/PATH.glsl; a record may hold records of the same file. A name that is a
word of GLSL ends in "_" there, and not in C++. A record that std430 lays out with gaps is refused. A constant whose
comment has "C++: ir::some::name" becomes an inline constexpr one; its value is a number. "C++: ir::some::*" takes all
constants of a declaration under their own names in small letters (arrays of floats, too), and "C++: enum ir::some::Name" makes an enum class
of them, without the word before their first "_". Usage:
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
CONSTANT = re.compile(r"((?:^//[^\n]*\n)+)^const (float|int|uint) (\w+ = [^;]+);[ \t]*(//[^\n]*)?", re.M)
ARRAY = re.compile(r"((?:^//[^\n]*\n)+)^const float (\w+)\[(\d+)\] = float\[\3\]\(([^)]*)\);", re.M)
NUMBERS = {"float": r"-?\d+(\.\d*(e-?\d+)?|e-?\d+)", "int": r"-?\d+", "uint": r"(0x[0-9a-f]+|\d+)u|1u << \d+"}
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


def constants_of(kind, values, last_note, path):
    """(name, value, comment) of each constant of a declaration, as C++ has them but for the name."""
    if "//" in values.splitlines()[-1]:
        sys.exit(f"{path}: the comment '{values[values.rindex('//'):]};' has a semicolon; write another sign there")
    values = re.sub(r"//([^\n]*)\n\s*(\w+ =)", r"//\1\n\2", values)  # a comment is of what stands before it
    found = []
    for item in re.finditer(r"(\w+) = ([^,]+?)\s*(?:,[ \t]*(?://[ \t]?([^\n]*))?|$)", values):
        name, value, note = item.groups()
        if not re.fullmatch(NUMBERS[kind], value):
            sys.exit(f"{path}: the constant '{name}' is for C++, too, so its value is a number, not '{value}'")
        found.append((name, value + ("f" if kind == "float" else ""), note))
    name, value, note = found[-1]
    found[-1] = name, value, note or (last_note or "").lstrip("/ ")
    return found


def declared_constants(comment, space, name, constants, kind):
    """What one mark makes of a declaration: one constant, all, or an enum class."""
    note = lambda text: f"  ///< {text}" if text else ""
    type_ = TYPES[kind][0]
    if space.startswith("enum "):
        items = [f"    {constant.split('_', 1)[1].lower()} = {value},{note(text)}" for constant, value, text in constants]
        return "\n".join(documented(comment) + [f"enum class {name} : {type_} {{"] + items + ["};"])
    if name == "*":
        items = [f"inline constexpr {type_} {constant.lower()} = {value};{note(text)}"
                 for constant, value, text in constants]
        return "\n".join(documented(comment) + items)
    return "\n".join(documented(comment) + [f"inline constexpr {type_} {name} = {constants[0][1]};"])


def header_of(path, text):
    """The header's text; None where nothing is marked."""
    records, types = [], dict(TYPES)
    within = "namespace {} {{\n\n{}\n\n}}  // namespace {}\n".format
    for comment, kind, values, last_note in CONSTANT.findall(text):
        for space, name in marked_names(comment):
            constants = constants_of(kind, values, last_note, path)
            declared = declared_constants(comment, space, name, constants, kind)
            space = space.removeprefix("enum ")
            records.append(within(space, declared, space))
    for comment, name, count, values in ARRAY.findall(text):
        values = [value.strip() for value in values.split(",")]
        if not all(re.fullmatch(NUMBERS["float"], value) for value in values):
            sys.exit(f"{path}: the constant '{name}' is for C++, too, so it holds numbers, not '{', '.join(values)}'")
        for space, own_name in marked_names(comment):
            name = name.lower() if own_name == "*" else own_name
            numbers = ", ".join(f"{value}f" for value in values)
            constant = f"inline constexpr std::array<float, {count}> {name}{{{numbers}}};"
            records.append(within(space, "\n".join(documented(comment) + [constant]), space))
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
