#!/usr/bin/env python3
"""Tests of skin_table.py on made-up measurements. usage: skin_table_test.py"""

import csv
import io
import json
import pathlib
import tempfile
import unittest

import skin_table


def row(technique, milliseconds, error, maps=1024, passes=(), pixels=(1920, 1080)):
    return {"technique": technique, "setting": "corrected", "map_size": maps, "shadow_size": 2048, "coverage": 0.5, "target_bytes": maps**2, "resolution": list(pixels),
            "ms": {"median": milliseconds, "noise": 0.01}, "ms_gross": {"median": milliseconds + 1}, "error": {"rel_l2": error, "bias": 0.0},
            "passes": [{"name": name, "ms": ms} for name, ms in passes], "device": "GPU", "driver": "1", "compiler": "DXC", "date": "2026-01-01"}


class SkinTable(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def put(self, name, rows):
        (self.folder / f"{name}.json").write_text(json.dumps(rows), encoding="utf-8")

    def test_a_peer_that_is_faster_and_more_accurate_is_named(self):
        self.put("human-maps", [row("Pyramid", 2.0, 0.010)])
        self.put("human-peers", [row("Preintegrated", 1.0, 0.009), row("Lambert", 0.5, 0.020)])
        text, views, _ = skin_table.page(self.folder)
        self.assertIn("* human: `Pyramid` 1024/2048: 0.0100, 2.00 ms; `Preintegrated` 1024/2048: 0.0090, 1.00 ms", text)
        self.assertEqual(len(skin_table.dominated(views["human"])), 1)

    def test_what_is_only_faster_only_better_or_as_fast_within_the_noise_dominates_nothing(self):
        self.put("human-maps", [row("PyramidLinked, few levels", 2.0, 0.010)])
        self.put("human-peers", [row("Lambert", 1.0, 0.020), row("Burley80", 9.0, 0.005), row("Separable7", 1.995, 0.009)])
        text, views, _ = skin_table.page(self.folder)
        self.assertEqual(skin_table.dominated(views["human"]), [])
        self.assertIn("None: no setting of a peer is both faster and more accurate", text)

    def test_peers_that_nothing_of_ours_dominates_are_named(self):
        rows = [row("PyramidCompute", 1.0, 0.008), row("Lambert", 0.5, 0.030), row("DEonLuebke", 5.0, 0.009)]
        self.assertEqual([peer["technique"] for peer in skin_table.undominated_peers(rows)], ["Lambert"])

    def test_what_is_drawn_twice_counts_once(self):
        self.put("lps_head-maps", [row("Pyramid", 2.0, 0.010)])
        self.put("lps_head-peers", [row("Pyramid", 2.1, 0.010), row("Lambert", 1.0, 0.030)])
        self.assertEqual(len(skin_table.read(self.folder)["lps_head"]), 2)

    def test_every_setting_is_a_row_of_the_csv(self):
        self.put("human-maps", [row("Pyramid", 2.0, 0.010), row("PyramidLinked, few levels", 3.0, 0.008)])
        lines = list(csv.DictReader(io.StringIO(skin_table.as_csv(skin_table.settings_of(skin_table.read(self.folder))))))
        self.assertEqual([(line["view"], line["technique"], line["ms"], line["rel L2"], line["date"]) for line in lines],
                         [("human", "Pyramid", "2.00", "0.0100", "2026-01-01"), ("human", "PyramidLinked, few levels", "3.00", "0.0080", "2026-01-01")])

    def test_time_that_grows_with_the_square_root_has_the_exponent_one_half(self):
        self.assertAlmostEqual(skin_table.exponent([(4, 2.0), (16, 4.0), (64, 8.0)]), 0.5)

    def test_growth_counts_the_passes_that_grow_with_it(self):
        def drawn(maps):
            return row("PyramidLinked", 3, 0.01, maps, (("ShadowMap", 7), ("Entry", maps**2 * 1e-6), ("Light0", maps**2 * 1e-6), ("Final", 9)))
        self.put("growth-texels", [drawn(256), drawn(512), drawn(1024), drawn(2048)])
        [(quantity, technique, sizes, _, exponent)] = skin_table.growth(self.folder)
        self.assertEqual((quantity, technique, sizes, exponent), ("texels of the base", "PyramidLinked", "65,536, 262,144, 1,048,576, 4,194,304", "1.00"))


if __name__ == "__main__":
    unittest.main()
