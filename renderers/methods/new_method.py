#!/usr/bin/env python3
"""Makes a new method: copies the folders of the example, renderers/methods/view-normals and
shaders/methods/view-normals, under a new id. Usage: new_method.py ID [--title TITLE] [--into ROOT]

Without --into the folders are made in this source tree and must not be there yet; elsewhere they are brought up to
date.
"""
import argparse
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE, EXAMPLE_TITLE = "view-normals", "Normals in view space"
SUMMARY = "Normals relative to the camera, no light: the example that methods are begun from."
COMMENT = "// The smallest whole method; copy this folder and shaders/methods/view-normals to begin another.\n"
ID = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")
# One word is a namespace by itself, and these are words of C++ or namespaces that methods use.
TAKEN = set("""and asm auto bool break case catch char class compl concept const continue default delete do double else
enum explicit export extern false float for friend gl goto graph if image inline int ir long methods mutable namespace
new not operator or passes private protected public register requires return scene short signed sizeof static std struct
switch template this throw true try typedef typename union unsigned using virtual void volatile while xor""".split())


def name_of(method):
    """In file names and namespaces."""
    return method.replace("-", "_")


def replaced(text, method, title):
    for old, new in ((COMMENT, ""), (SUMMARY, f"Begun as a copy of {EXAMPLE.replace('-', ' ')}."), (EXAMPLE_TITLE, title),
                     (EXAMPLE, method), (name_of(EXAMPLE), name_of(method))):
        text = text.replace(old, new)
    return text


def sources():
    """The example's files, relative to the source tree."""
    for top in ("renderers", "shaders"):
        yield from (path.relative_to(ROOT) for path in sorted((ROOT / top / "methods" / EXAMPLE).iterdir()))


def make(method, title, root):
    """The files that were made."""
    made = []
    for source in sources():
        target = root / source.parts[0] / "methods" / method / source.name.replace(name_of(EXAMPLE), name_of(method))
        text = replaced((ROOT / source).read_text(encoding="utf-8"), method, title)
        target.parent.mkdir(parents=True, exist_ok=True)
        if not target.exists() or target.read_text(encoding="utf-8") != text:
            target.write_text(text, encoding="utf-8")
        made.append(target)
    return made


def main():
    parser = argparse.ArgumentParser(description="Makes a new method from the example.")
    parser.add_argument("id", help="such as my-method: small letters, digits and single hyphens")
    parser.add_argument("--title", help="for people; without it made of the id")
    parser.add_argument("--into", type=Path, help="another folder than this source tree")
    arguments = parser.parse_args()
    method = arguments.id
    if not ID.fullmatch(method):
        sys.exit(f"'{method}' is no id of a method; use small letters, digits and single hyphens, as in {EXAMPLE}")
    if method in TAKEN:
        sys.exit(f"'{method}' has a meaning in C++ here; add another word, as in {method}-method")
    title = arguments.title or method.replace("-", " ").capitalize()
    if not title.isprintable() or re.search(r'["\\]', title):
        sys.exit(f"the title {title!r} has quotes, backslashes, tabs or several lines; leave them out")
    for top in ("renderers", "shaders"):
        folder = ROOT / top / "methods" / method
        if not arguments.into and folder.exists():
            sys.exit(f"{folder.relative_to(ROOT)} is there already; choose another id")
    for path in make(method, title, arguments.into or ROOT):
        print(path if arguments.into else path.relative_to(ROOT))


if __name__ == "__main__":
    main()
