#!/usr/bin/env python3
"""Makes a CSV file of the Markdown tables on standard input: `csv_table.py FILE [--heading COLUMN] [--with COLUMN=VALUE ...]`. Tables that have the
columns of the first one go into it. --heading puts the heading above each table into the first column, --with a value behind every row:

tegument check effects/*.fx --all-settings --target fx_2_0 --resources | tests/tools/csv_table.py docs/design/tables/resources.csv --heading effect
tegument verify Main ... | tests/tools/csv_table.py FILE --with "command=tegument verify Main" device=llvmpipe driver= commit=... date=...
"""

import argparse
import csv
import pathlib
import re
import sys


def cells_of(line):
    """Without what Markdown adds: code marks, bold, links."""
    cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip().strip("|"))]
    return [re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", cell).replace("`", "").replace("**", "").replace("\\|", "|") for cell in cells]


def rows_of(lines, heading=None, constants=()):
    """The columns' names, then the rows of every table that has them."""
    above, columns, here, before = "", None, False, None
    for line in lines:
        if not line.startswith("|"):
            here = False
            above = line.lstrip("# ").strip() if line.startswith("#") else above
        elif re.fullmatch(r"\|[\s:|-]+\|\s*", line):
            if columns is None:
                columns = before
                yield ([heading] if heading else []) + columns + [name for name, _ in constants]
            here = before == columns
        elif here:
            yield ([above] if heading else []) + cells_of(line) + [value for _, value in constants]
        before = cells_of(line) if line.startswith("|") else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("--heading", metavar="COLUMN")
    parser.add_argument("--with", dest="constants", nargs="+", default=[], metavar="COLUMN=VALUE", type=lambda word: tuple(word.split("=", 1)))
    given = parser.parse_args()
    with given.file.open("w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(rows_of(sys.stdin.read().splitlines(), given.heading, given.constants))


if __name__ == "__main__":
    main()
