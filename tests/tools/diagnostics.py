#!/usr/bin/env python3
"""The page docs/diagnostics.md, made from the table docs/diagnostics.json: `diagnostics.py` compares, `diagnostics.py --write` writes it.

A code stands in a section of an area, with its meaning, what to do, and, where no test can provoke it, the reason (`untested`).
"""

import json
import pathlib
import sys

TABLE = "docs/diagnostics.json"
PAGE = "docs/diagnostics.md"
HEAD = """# Diagnostics

<!-- Made from diagnostics.json by tests/tools/diagnostics.py --write. -->

Every message of the program has a code, `TG` and four digits. Search this page for it.
The message itself names the place and, as a rule, what to do; the table says it again in general.
What the exit codes mean: [the command line](command-line.md).
"""


def areas(root):
    path = root / TABLE
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else []


def codes(root):
    """Every row of the table, in its order."""
    return [row for area in areas(root) for section in area["sections"] for row in section["codes"]]


def section_lines(section):
    lines = ["", f"### {section['title']}"] if section["title"] else []
    lines += ["", section["text"]] if section["text"] else []
    if section["codes"]:
        lines += ["", "| code | meaning | what to do |", "|---|---|---|"]
    return lines + [f"| TG{row['code']} | {row['meaning']} | {row['do']} |" for row in section["codes"]]


def markdown(root):
    lines = []
    for area in areas(root):
        lines += ["", f"## {area['title']}"]
        for section in area["sections"]:
            lines += section_lines(section)
    return HEAD + "\n".join(lines) + "\n"


def outdated(root):
    """Is the page not what the table makes of it? A tree without the table has no page."""
    page = root / PAGE
    if not (root / TABLE).exists():
        return page.exists()
    return not page.exists() or page.read_text(encoding="utf-8") != markdown(root)


def main(arguments):
    root = pathlib.Path(__file__).resolve().parents[2]
    if not outdated(root):
        return 0
    print(PAGE)
    if arguments != ["--write"]:
        return 1
    (root / PAGE).write_text(markdown(root), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
