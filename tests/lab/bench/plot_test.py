#!/usr/bin/env python3
"""Tests of lab/bench/plot.py. Exit code 77: matplotlib is not installed (ctest: skipped)."""

import importlib.util
import pathlib
import sys
import tempfile
import unittest

if importlib.util.find_spec("matplotlib") is None:
    print("skipped: matplotlib is not installed")
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parents[3]
spec = importlib.util.spec_from_file_location("plot", ROOT / "lab" / "bench" / "plot.py")
plot = importlib.util.module_from_spec(spec)
spec.loader.exec_module(plot)


def row(technique, ms, error, setting="corrected", source="A 2001"):
    return {"technique": technique, "setting": setting, "source": source, "scene": "head", "resolution": [320, 200], "map_size": 256,
            "device": "a device", "driver": "1", "date": "2026-01-01", "cpu": False, "ms": {"median": ms, "p5": 0.9 * ms, "p95": 1.1 * ms},
            "error": {"rel_l2": error}}


def crowd():
    """Sixteen techniques, most of them side by side as separable ones are."""
    return [row(f"Separable{i}", 1 + 0.02 * i, 0.02 + 0.0003 * i, source=f"Source {i % 4}") for i in range(12)] + [
        row("Lambert", 0.3, 0.05), row("Seed", 4, 0.4, "seed"), row("Best", 9, 0.004), row("Worse", 10, 0.005)]


class Front(unittest.TestCase):
    def test_holds_what_nothing_else_beats_in_both(self):
        rows = [row("cheap", 1, 0.1), row("beaten", 2, 0.2), row("best", 3, 0.01), row("slower and no better", 4, 0.01)]
        self.assertEqual([r["technique"] for r in plot.front(rows)], ["cheap", "best"])

    def test_of_equal_times_keeps_the_nearer(self):
        self.assertEqual([r["technique"] for r in plot.front([row("far", 1, 0.2), row("near", 1, 0.1)])], ["near"])


class Pareto(unittest.TestCase):
    def drawn(self, rows):
        """The figure and its axes, kept open instead of saved."""
        kept = []
        original, plot.save = plot.save, lambda figure, folder, name: kept.append((figure, name))
        try:
            plot.pareto(rows, pathlib.Path("."))
        finally:
            plot.save = original
        figure, name = kept[0]
        figure.canvas.draw()
        return figure, figure.axes[0], name

    def boxes(self, rows):
        figure, axes, _ = self.drawn(rows)
        renderer = figure.canvas.get_renderer()
        names = {r["technique"] for r in rows}
        return [(t.get_text(), t.get_window_extent(renderer)) for t in axes.texts if t.get_text() in names]

    def test_labels_every_point(self):
        rows = crowd()
        self.assertEqual(sorted(name for name, _ in self.boxes(rows)), sorted(r["technique"] for r in rows))

    def test_labels_do_not_overlap_in_a_crowd(self):
        boxes = self.boxes(crowd())
        for i, (name, a) in enumerate(boxes):
            for other, b in boxes[i + 1:]:
                width, height = min(a.x1, b.x1) - max(a.x0, b.x0), min(a.y1, b.y1) - max(a.y0, b.y0)
                self.assertFalse(width > 1 and height > 1, f"{name} and {other} overlap by {width:.0f} x {height:.0f} pixels")

    def test_labels_stay_within_the_axes(self):
        figure, axes, _ = self.drawn(crowd())
        area = axes.get_window_extent()
        for name, box in self.boxes(crowd()):
            self.assertGreater(box.x0, area.x0 - 2, name)
            self.assertLess(box.x1, area.x1 + 2, name)

    def test_is_named_after_scene_and_size(self):
        self.assertEqual(self.drawn(crowd())[2], "pareto-head-320x200-256")

    def test_both_axes_are_logarithmic(self):
        _, axes, _ = self.drawn(crowd())
        self.assertEqual((axes.get_xscale(), axes.get_yscale()), ("log", "log"))


class Growth(unittest.TestCase):
    def test_is_written_as_png_and_svg(self):
        series = [{"quantity": "texels", "what": "blurs", "x": [1, 4, 16, 64], "ms": [1.1, 2, 6, 20], "exponent": 0.7, "factor": 1.0,
                   "fixed_ms": 0.8, "ms_per_unit": 0.3}]
        with tempfile.TemporaryDirectory() as folder:
            plot.growth(series, {"device": "a device", "driver": "1", "date": "2026-01-01"}, pathlib.Path(folder))
            self.assertEqual(sorted(p.name for p in pathlib.Path(folder).iterdir()), ["growth.png", "growth.svg"])


if __name__ == "__main__":
    unittest.main()
