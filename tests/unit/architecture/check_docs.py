#!/usr/bin/env python3
"""Checks the Markdown files: columns, tables, relative links with their anchors, and that README.md has each
method's page.

Lines have at most 100 columns outside tables and code blocks, ARCHITECTURE.md has at most 150. Cells of tables hold
numbers and names: at most 12 words, and no sentence. Usage: check_docs.py ROOT
"""
import re
import sys
from pathlib import Path

COLUMNS = 100
WORDS = 12  # of a cell
ARCHITECTURE_LINES = 150
SENTENCES = re.compile(r"\w\.$|[a-z]\w\. [A-Z]")
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")


def prose_of(text):
    """The numbered lines of a page, empty where they are code."""
    fenced = False
    for number, line in enumerate(text.splitlines(), 1):
        fence = line.lstrip().startswith("```")
        fenced ^= fence
        yield number, "" if fenced or fence else line


def anchors_of(text):
    """What #… may name in a page, made of its headings as Git hosts do."""
    seen = {}
    for _, line in prose_of(text):
        if heading := re.match(r"#+ (.*)", line):
            name = re.sub(r"[^\w\- ]", "", heading[1].strip().lower()).replace(" ", "-")
            seen[name] = seen.get(name, -1) + 1
            yield f"{name}-{seen[name]}" if seen[name] else name


def cells_of(line):
    """Of a row of a table; a bar in a formula is escaped."""
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip().strip("|"))]


def problems_of_table(line):
    for cell in cells_of(line):
        if (words := len(cell.split())) > WORDS:
            yield f"a cell of {words} words, {WORDS} are allowed; put it above or below: {cell}"
        elif SENTENCES.search(cell):
            yield f"a sentence in a cell; put it above or below: {cell}"


def problems_of(page):
    text = page.read_text(encoding="utf-8")
    for number, line in prose_of(text):
        if len(line) > COLUMNS and not line.lstrip().startswith("|"):
            yield f"{number}: {len(line)} columns, {COLUMNS} are allowed"
        if line.startswith("|"):
            yield from (f"{number}: {each}" for each in problems_of_table(line))
    # Links may be broken over lines; code in backticks is none.
    for target in LINK.findall(re.sub(r"`[^`]*`", "", "\n".join(line for _, line in prose_of(text)))):
        if "://" in target or target.startswith("mailto:"):
            continue
        name, _, anchor = target.partition("#")
        file = page.parent / name if name else page
        if not file.exists():
            yield f"links to {target}, which does not exist"
        elif anchor and anchor not in anchors_of(file.read_text(encoding="utf-8")):
            yield f"links to {target}, which has no such heading"


def main():
    root = Path(sys.argv[1])
    pages = [*root.glob("*.md"), *root.glob("docs/**/*.md")]
    problems = [f"{page.relative_to(root)}: {each}" for page in sorted(pages) for each in problems_of(page)]
    readme = (root / "README.md").read_text(encoding="utf-8")
    problems += [f"{page.relative_to(root)}: README.md links to every method's page, and not to this one"
                 for page in sorted(root.glob("docs/methods/*.md")) if f"docs/methods/{page.name}" not in readme]
    if (lines := (root / "ARCHITECTURE.md").read_text(encoding="utf-8").count("\n")) > ARCHITECTURE_LINES:
        problems.append(f"ARCHITECTURE.md: {lines} lines, {ARCHITECTURE_LINES} are allowed")
    sys.exit("\n".join(problems) or None)


main()
