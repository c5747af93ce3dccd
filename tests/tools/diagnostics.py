#!/usr/bin/env python3
"""The pages of docs/diagnostics, made from their table codes.json: `diagnostics.py` compares, `diagnostics.py --write` writes them.

A code stands in the section of a page, with its meaning, what to do, and, where no test can provoke it, the reason (`untested`).
"""

import json
import pathlib
import sys

TABLE = "docs/diagnostics/codes.json"
NOTE = "<!-- Made from codes.json by tests/tools/diagnostics.py --write. -->"


def pages(root):
    path = root / TABLE
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else []


def codes(root):
    """Every row of the table, in its order."""
    return [row for page in pages(root) for section in page["sections"] for row in section["codes"]]


def markdown(page):
    lines = [f"# {page['title']}", "", NOTE]
    for section in page["sections"]:
        lines += ["", f"## {section['title']}"] if section["title"] else []
        lines += ["", section["text"]] if section["text"] else []
        if section["codes"]:
            lines += ["", "| code | meaning | what to do |", "|---|---|---|"]
        lines += [f"| TG{row['code']} | {row['meaning']} | {row['do']} |" for row in section["codes"]]
    return "\n".join(lines) + "\n"


def outdated(root):
    """Path and text of every page that is not what the table makes of it."""
    for page in pages(root):
        path, text = root / "docs/diagnostics" / page["file"], markdown(page)
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            yield path, text


def main(arguments):
    root = pathlib.Path(__file__).resolve().parents[2]
    found = list(outdated(root))
    for path, text in found:
        if arguments == ["--write"]:
            path.write_text(text, encoding="utf-8")
        print(path.relative_to(root))
    return 1 if found and arguments != ["--write"] else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
