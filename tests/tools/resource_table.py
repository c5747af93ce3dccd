#!/usr/bin/env python3
"""Writes docs/design/tables/resources.csv from the Markdown that `tegument check --resources` prints:
tegument check effects/*.fx --all-settings --target fx_2_0 --resources | tests/tools/resource_table.py"""

import csv
import pathlib
import sys

TABLE = pathlib.Path(__file__).resolve().parents[2] / "docs/design/tables/resources.csv"


def rows_of(lines):
    """The cells of each pass behind its effect's name; the columns' names first."""
    effect, columns = None, None
    for line in lines:
        if line.startswith("### "):
            effect = line[4:].strip()
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if effect is None or not line.startswith("|") or not any(cell.strip("-") for cell in cells):
            continue
        if cells[0] != "technique":
            yield [effect, *cells]
        elif columns is None:
            columns = cells
            yield ["effect", *columns]


if __name__ == "__main__":
    with TABLE.open("w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(rows_of(sys.stdin))
