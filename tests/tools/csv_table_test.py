#!/usr/bin/env python3
"""Tests of csv_table.py. usage: csv_table_test.py"""

import unittest

import csv_table

TEXT = """# Page

| limit | most |
|---|---|
| a | 1 |

### One.fx

| pass | slots |
|---|---|
| `Final` | 1 / 2 |
| [Light](light.md) | **3** |

### Two.fx

| pass | slots |
|---|---|
| a \\| b | 4 |
"""


class CsvTable(unittest.TestCase):
    def rows(self, text, **options):
        return list(csv_table.rows_of(text.splitlines(), **options))

    def test_tables_of_the_same_columns_are_one(self):
        self.assertEqual(self.rows(TEXT[TEXT.index("###") :]), [["pass", "slots"], ["Final", "1 / 2"], ["Light", "3"], ["a | b", "4"]])

    def test_a_table_of_other_columns_is_left_out(self):
        self.assertEqual(self.rows(TEXT), [["limit", "most"], ["a", "1"]])

    def test_the_heading_and_what_is_known_of_the_run_are_columns(self):
        rows = self.rows(TEXT[TEXT.index("###") :], heading="effect", constants=[("date", "2026-01-01")])
        self.assertEqual(rows[0], ["effect", "pass", "slots", "date"])
        self.assertEqual(rows[-1], ["Two.fx", "a | b", "4", "2026-01-01"])


if __name__ == "__main__":
    unittest.main()
