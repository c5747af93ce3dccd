#!/usr/bin/env python3
"""What stands beside the picture in tegument view: a kept side with a border and its error, a saved picture, the effect's text. By real
input events under Xvfb.

usage: beside_test.py PROGRAM REPOSITORY [PICTURES]      with PICTURES the screen of every step is kept there
Exit code 77: this machine lacks Xvfb, python3-xlib or a Vulkan driver that draws to windows.
"""

import json
import os
import shutil
import signal
import subprocess
import time
import unittest

import screen as screens
import session as base

WIDE, HIGH = 2 * base.SIZE, base.SIZE


class Beside(base.WideWindow):
    def half(self, picture, left, right, top=0, bottom=HIGH // 2):
        """Above the labels, without the border."""
        return b"".join(picture.pixels[(y * picture.width + left) * 3:(y * picture.width + right) * 3] for y in range(top, bottom))

    def press(self, key, unlike):
        self.view.screen.press(key)
        return self.view.still(unlike=unlike)

    def test_a_kept_side_stands_left_of_a_border_that_moves(self):
        same = base.keep(self.press("k", self.start), "beside_1_kept")
        middle = WIDE // 2
        self.assertEqual(self.half(same, 0, middle - 8), self.half(self.start, 0, middle - 8))
        self.assertEqual(self.half(same, middle + 8, WIDE), self.half(self.start, middle + 8, WIDE))
        self.view.turn_to("Lambert", "t")
        split = base.keep(self.view.still(unlike=same), "beside_2_lambert_to_the_right")
        self.assertEqual(self.half(split, 0, middle - 8), self.half(self.start, 0, middle - 8), "the kept side has changed")
        self.assertNotEqual(self.half(split, middle + 8, WIDE), self.half(self.start, middle + 8, WIDE))
        self.view.screen.drag((middle, 40), (middle + 80, 40))
        moved = base.keep(self.view.still(unlike=split), "beside_3_border_moved")
        self.assertEqual(self.half(moved, 0, middle + 70), self.half(self.start, 0, middle + 70), "the border, not the camera")
        self.view.screen.drag((middle + 80, 40), (middle, 40))
        back = self.view.still(unlike=moved)
        self.view.screen.drag((200, 200), (260, 180))
        turned = base.keep(self.view.still(unlike=back), "beside_4_both_turn")
        self.assertNotEqual(self.half(turned, 0, middle - 8), self.half(self.start, 0, middle - 8), "the kept side follows the camera")
        errors = base.keep(self.press("e", turned), "beside_5_errors")
        self.assertGreater(errors.share_apart(turned), 0.02)
        self.press("e", errors)
        self.view.screen.move(WIDE - 120, 150)
        values = base.keep(self.press("x", turned), "beside_6_values")
        self.assertGreater(sum(value > 150 for value in self.view.crop(values, "sheets").pixels), 1000)
        self.view.screen.press("x")
        self.view.screen.press("k")
        self.view.turn_to("DEonLuebke", "T")
        self.view.screen.press("r")
        self.assertEqual(self.view.still(), self.start)

    def test_an_edit_is_held_against_what_was_before_it(self):
        kept = self.press("k", self.start)
        include = self.view.folder / "effects" / "passes" / "final.fxh"
        text = include.read_text()
        include.write_text(text.replace("float4(lerp(", "float4(0.25 * lerp("))
        split = base.keep(self.view.still(unlike=kept), "beside_edit")
        middle = WIDE // 2
        self.assertEqual(self.half(split, 0, middle - 8), self.half(self.start, 0, middle - 8))
        self.assertLess(sum(self.half(split, middle + 8, WIDE)), 0.8 * sum(self.half(self.start, middle + 8, WIDE)))
        include.write_text(text)
        self.view.still(unlike=split)
        self.view.screen.press("k")
        self.assertEqual(self.view.still(), self.start)

    def test_the_text_stands_beside_the_picture_with_its_errors_and_is_written_by_control_s(self):
        text = base.keep(self.press("f", self.start), "text_1")
        letters = sum(value > 150 for value in self.half(text, WIDE // 2, WIDE))
        self.assertGreater(letters, 5000)
        include = self.view.folder / "effects" / "passes" / "final.fxh"
        right = include.read_text()
        include.write_text(right.replace("FinalPS", "FinalPS(broken", 1))
        self.view.title("error TG")
        broken = base.keep(self.view.still(unlike=text), "text_2_error_in_its_line")
        red = [i for i in range(0, len(broken.pixels), 3) if broken.pixels[i] > 110 and broken.pixels[i + 1] < 60 and broken.pixels[i + 2] < 60]
        marked = {i // 3 // broken.width for i in red if i // 3 % broken.width > WIDE // 2}
        self.assertTrue(12 <= len(marked) <= 19, f"one line of text is marked: {sorted(marked)}")
        include.write_text(right)
        self.view.title("Main.fx DEonLuebke")
        mended = self.view.still(unlike=broken)
        # By keys: into the text, to its end, a comment, Ctrl+S.
        self.view.screen.drag((WIDE - 60, 200), (WIDE - 60, 200))
        self.view.screen.press("End", "Control_L")
        for key in ("slash", "slash", "a"):
            self.view.screen.press(key)
        typed = base.keep(self.view.still(unlike=mended), "text_3_typed")
        self.assertEqual(include.read_text(), right)
        for _ in range(3):
            self.view.screen.press("z", "Control_L")
        undone = base.keep(self.view.still(unlike=typed), "text_3_undone")
        self.assertLess(undone.share_apart(mended), typed.share_apart(mended))
        for key in ("slash", "slash", "a"):
            self.view.screen.press(key)
        self.view.still(unlike=undone)
        self.view.screen.press("s", "Control_L")
        self.view.wait("the file", lambda: include.read_text() != right)
        self.assertEqual(include.read_text().count("//a"), right.count("//a") + 1)
        base.keep(self.view.still(unlike=typed), "text_4_written")
        self.view.screen.drag((60, 300), (60, 300))  # back to the picture
        include.write_text(right)
        self.view.still()
        self.view.screen.press("f")
        self.assertEqual(self.view.start_again(), self.start)


class SavedPicture(unittest.TestCase):
    def test_a_saved_picture_of_the_same_view_differs_by_its_rounding_alone(self):
        view = base.View(("effects/Main.fx", "-w", "ball.json", "--map-size", "64", "--beside", "saved.png"), before=self.draw)
        try:
            view.title("Main.fx DEonLuebke [corrected] picture")
            view.screen.press("i")
            picture = view.still()
            view.screen.press("k")
            alone = view.still(unlike=picture)
            if base.PICTURES:
                picture.save(base.PICTURES / "beside_saved.png")
            apart = [abs(a - b) for y in range(base.SIZE // 2) for a, b in zip(
                picture.pixels[(y * picture.width + 100) * 3:(y * picture.width + 150) * 3],
                alone.pixels[(y * picture.width + 100) * 3:(y * picture.width + 150) * 3])]
            self.assertLessEqual(max(apart), 1)  # bytes are rounded in a shader there, on the processor here
        finally:
            view.end()
            shutil.rmtree(view.folder)

    def draw(self, folder):
        command = [base.PROGRAM, "render", "effects/Main.fx", "-w", "ball.json", "--map-size", "64", "--size", f"{base.SIZE}x{base.SIZE}", "-o", "saved.png"]
        ran = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=base.PATIENCE)
        self.assertEqual(ran.returncode, 0, ran.stderr)


class Replay(unittest.TestCase):
    STEPS = [{"drag": [0.05, 0.01], "as": "first", "soon": True},
             {"drag": [0.05, 0.01], "times": 4}, {"light": [0.05, 0]}, {"wheel": 1}, {"key": "k"}, {"key": "t", "times": 2},
             {"edit": "effects/passes/final.fxh", "from": "float4(lerp(", "to": "float4(0.5 * lerp("},
             {"edit": "effects/passes/final.fxh", "from": "float4(0.5 * lerp(", "to": "float4(lerp("},
             {"edit": "effects/passes/final.fxh", "from": "float4(lerp(", "to": "float4(0.5{new} * lerp("},
             {"back": "effects/passes/final.fxh", "as": "back"}]

    COMMAND = [base.PROGRAM, "view", "effects/Main.fx", "-w", "ball.json", "--map-size", "64", "--size", "200x100", "--validate", "--replay", "steps.json"]

    @staticmethod
    def environment(display=None):
        environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        if display:
            environment["DISPLAY"] = display
        return environment

    def replay(self, steps, folder, display=None):
        (folder / "steps.json").write_text(json.dumps(steps))
        return subprocess.run(self.COMMAND, cwd=folder, env=self.environment(display), capture_output=True, text=True, timeout=4 * base.PATIENCE)

    def setUp(self):
        self.folder = base.own_copy()
        self.addCleanup(shutil.rmtree, self.folder)

    def test_tells_how_long_each_kind_of_step_takes_without_a_window(self):
        ran = self.replay(self.STEPS, self.folder)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        rows = self.rows(ran)
        rows.pop("sharp after a move", None)  # of a slow machine, as is more than one of these
        self.assertIn(rows["ready to move"].pop(0), ("1", "2"))
        rows["ready to move"].insert(0, "1")
        self.assertEqual({kind: row[0] for kind, row in rows.items()},
                         {"first": "1", "ready to move": "1", "drag": "4", "light": "1", "wheel": "1", "key k": "1", "key t": "2", "edit": "3", "back": "1"}, ran.stdout)
        for kind, (_, median, p95, most, unanswered) in rows.items():
            self.assertTrue(0 < float(median) <= float(p95) <= float(most), kind)
            self.assertTrue(0 < float(unanswered) <= float(most), kind)
        self.assertNotIn("validation:", ran.stderr)

    def test_in_a_window_it_is_the_same_and_what_it_edits_is_as_before(self):
        final = self.folder / "effects" / "passes" / "final.fxh"
        before = final.read_text()
        display = screens.Screen(400, 200)
        self.addCleanup(display.close)
        ran = self.replay(self.STEPS[:-1] + [{"key": "t", "meanwhile": [0.03, 0.01]}], self.folder, display.name)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        self.assertEqual(final.read_text(), before, "an edit that no step took back")
        rows = self.rows(ran)
        self.assertEqual((rows["first"][0], rows["drag"][0], rows["edit"][0], rows["key t"][0]), ("1", "4", "3", "3"), ran.stdout)
        self.assertGreater(int(rows["drag meanwhile"][0]), 0, ran.stdout)
        self.assertNotIn("validation:", ran.stderr)

    def test_ended_from_outside_it_changes_back_what_it_has_edited(self):
        final = self.folder / "effects" / "passes" / "final.fxh"
        before = final.read_bytes()
        (self.folder / "steps.json").write_text(json.dumps(
            [{"edit": "effects/passes/final.fxh", "from": "float4(lerp(", "to": "float4(0.5 * lerp("}, {"wheel": 1, "times": 60000}]))
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            with self.subTest(signal=number.name):
                process = subprocess.Popen(self.COMMAND, cwd=self.folder, env=self.environment(), stdout=subprocess.DEVNULL,
                                           stderr=subprocess.PIPE, text=True)
                self.addCleanup(process.kill)
                end = time.monotonic() + base.PATIENCE
                while final.read_bytes() == before and process.poll() is None and time.monotonic() < end:
                    time.sleep(0.01)
                self.assertNotEqual(final.read_bytes(), before, "no edit to interrupt")
                process.send_signal(number)
                said = process.communicate(timeout=base.PATIENCE)[1]
                self.assertEqual(process.returncode, -number, said)
                self.assertEqual(final.read_bytes(), before, said)
                self.assertEqual([file.name for file in final.parent.iterdir() if "tegument" in file.name], [], "a temporary file")

    @staticmethod
    def rows(ran):
        return {line.rsplit(None, 5)[0]: line.rsplit(None, 5)[1:] for line in ran.stdout.splitlines()[1:] if line.strip()}

    def test_drags_are_answered_while_a_picture_is_made_and_what_is_made_gets_done(self):
        steps = [{"key": "t", "meanwhile": [0.03, 0.01]},
                 {"edit": "effects/passes/final.fxh", "from": "float4(lerp(", "to": "float4(0.5 * lerp(", "meanwhile": [0.03, 0.01]},
                 {"key": "t", "times": 7}, {"key": "m", "times": 3, "meanwhile": [0.01, 0]}, {"key": "n"}, {"drag": [0.1, 0.1]}]
        ran = self.replay(steps, self.folder)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        rows = self.rows(ran)
        self.assertGreater(int(rows["drag meanwhile"][0]), 8, ran.stdout)
        self.assertEqual((rows["key t"][0], rows["edit"][0], rows["key m"][0]), ("8", "1", "3"), ran.stdout)
        self.assertNotIn("validation:", ran.stderr)

    def test_refuses_what_is_none_and_says_which_step(self):
        for steps in ([{"drug": [1, 1]}], {"drag": [1, 1]}, [{"key": "%"}], [{"drag": [1]}], [{"wheel": 1, "as": 2}], [{"key": "t", "meanwhile": 1}], [{"wheel": 1, "soon": 1}], [{"wheel": 1, "cursor": 0.5}], [{"back": ""}],
                      [{"wheel": 1, "times": 2.5}], [{"wheel": 1, "times": -1}], [{"wheel": 1, "times": 1 << 33}], [{"wheel": 1, "times": 600000}] * 2,
                      [{"edit": "effects/passes/final.fxh", "from": "not there", "to": ""}]):
            ran = self.replay(steps, self.folder)
            self.assertEqual(ran.returncode, 1, f"{steps}: {ran.stderr}")
            self.assertIn("TG8049", ran.stderr)


if __name__ == "__main__":
    base.main()
