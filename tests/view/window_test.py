#!/usr/bin/env python3
"""tegument view under Xvfb, driven by real input events: what a person at the screen would see.

usage: window_test.py PROGRAM REPOSITORY [PICTURES]      with PICTURES the screen of every step is kept there
Exit code 77: this machine lacks Xvfb, python3-xlib or a Vulkan driver that draws to windows.
"""

import json
import os
import pathlib
import shlex
import shutil
import subprocess
import tempfile
import time
import unittest

import screen as screens
from session import PATIENCE, PROGRAM, REPOSITORY, SIZE, View, ball, keep, main, slow_edit


class Window(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.view = View()
        cls.view.title("Main.fx DEonLuebke [corrected] picture")
        cls.view.screen.press("i")  # the text holds times, which differ from frame to frame
        cls.first = cls.view.still()

    @classmethod
    def tearDownClass(cls):
        cls.view.end()
        shutil.rmtree(cls.view.folder)

    def setUp(self):
        self.start = self.view.start_again()

    def keep(self, picture, name=None):
        return keep(picture, name or self.id().split(".")[-1])

    def test_the_ball_is_lit(self):
        self.keep(self.start)
        self.assertGreater(self.start.mean(), 8)

    def test_a_drag_turns_the_camera_and_r_turns_it_back(self):
        self.view.screen.drag((160, 160), (240, 130))
        turned = self.keep(self.view.still(unlike=self.start))
        self.assertGreater(turned.share_apart(self.start), 0.02)
        self.assertEqual(self.view.start_again(), self.start)

    def test_a_drag_with_the_right_button_moves_the_light_alone(self):
        self.view.screen.drag((160, 160), (60, 160), button=3)
        lit = self.keep(self.view.still(unlike=self.start))
        self.assertGreater(lit.share_apart(self.start), 0.02)
        left = [sum(p.pixels[(160 * p.width + x) * 3] for x in range(60, 140)) for p in (self.start, lit)]
        right = [sum(p.pixels[(160 * p.width + x) * 3] for x in range(180, 260)) for p in (self.start, lit)]
        self.assertGreater(left[1] / max(1, right[1]), left[0] / max(1, right[0]))  # the light went where the mouse did

    def test_drags_of_other_programs_turn_move_and_come_nearer(self):
        lit = lambda picture: sum(value > 24 for value in picture.pixels)
        drags = (("turned as in Blender", 2, ()), ("turned as in Maya", 1, ("Alt_L",)))
        turned = []
        for name, button, held in drags:
            self.view.screen.drag((160, 160), (240, 130), button=button, held=held)
            turned.append(self.keep(self.view.still(unlike=self.start), name.replace(" ", "_")))
            self.assertEqual(self.view.start_again(), self.start)
        # Steps of the mouse are summed as frames come: a slow machine rounds the sum otherwise.
        self.assertLess(turned[0].share_apart(turned[1]), 1e-3, "both turn the camera")
        for name, button, held in (("nearer as in Blender", 2, ("Control_L",)), ("nearer as in Maya", 3, ("Alt_L",))):
            self.view.screen.drag((160, 200), (160, 100), button=button, held=held)
            near = self.keep(self.view.still(unlike=self.start), name.replace(" ", "_"))
            self.assertGreater(lit(near), 1.15 * lit(self.start), name)
            self.assertEqual(self.view.start_again(), self.start)
        for name, button, held in (("moved as in Blender", 2, ("Shift_L",)), ("moved as in Maya", 2, ("Alt_L",)), ("moved by one button", 1, ("Shift_L",))):
            self.view.screen.drag((100, 160), (180, 160), button=button, held=held)
            moved = self.keep(self.view.still(unlike=self.start), name.replace(" ", "_"))
            columns = [sum(sum(p.pixels[(y * p.width + 40) * 3:(y * p.width + 44) * 3]) for y in range(p.height)) for p in (self.start, moved)]
            self.assertLess(columns[1], 0.5 * columns[0], f"{name}: the ball went with the mouse, to the right")
            self.assertEqual(self.view.start_again(), self.start)

    def test_the_digits_look_from_the_front_the_side_and_above(self):
        seen = [self.start]
        for key in ("1", "3", "7"):
            self.view.screen.press(key)
            seen.append(self.keep(self.view.still(unlike=seen[-1]), f"view_{key}"))
        self.assertEqual(self.view.start_again(), self.start)

    def test_where_there_are_no_surroundings_a_drag_of_them_says_what_is_missing(self):
        self.view.screen.drag((160, 160), (220, 160), button=3, held=("Shift_L",))
        self.view.wait("a word", lambda: "TEGUMENT_SURROUNDINGS" in self.view.said())
        self.assertEqual(self.view.start_again(), self.start)

    def test_the_wheel_brings_the_camera_nearer(self):
        for _ in range(4):
            self.view.screen.wheel(up=True)
        near = self.keep(self.view.still(unlike=self.start))
        lit = lambda picture: sum(value > 24 for value in picture.pixels)
        self.assertGreater(lit(near), 1.2 * lit(self.start))

    def test_t_shows_the_next_technique(self):
        self.view.turn_to("Lambert", "t")
        self.keep(self.view.still(unlike=self.start))
        self.view.turn_to("DEonLuebke", "t")
        self.assertEqual(self.view.start_again(), self.start)

    def test_right_stops_after_one_pass_more(self):
        self.view.screen.press("Right")
        self.view.title("pass 1 of 13, TSM into gTsmMap")
        first = self.keep(self.view.still(unlike=self.start), "pass_1")
        self.view.screen.press("Right")
        self.view.title("pass 2 of 13")
        self.keep(self.view.still(unlike=first), "pass_2")

    def test_down_shows_every_target(self):
        seen = []
        self.view.screen.press("Down")
        while True:
            title = self.view.title("target g")
            name = title.split("target ")[1].split(",")[0]
            if name in seen:
                break
            seen.append(name)
            picture = self.keep(self.view.still(), f"target_{name}")
            if name != "gUnwrapDepthMap":  # which is cleared to 0 and drawn to by the culling passes alone
                self.assertGreater(picture.mean(), 1, name)
            self.view.screen.press("Down")
            self.view.wait("the next target", lambda: f"target {name}," not in self.view.screen.title())
        self.assertIn("gTsmMap", seen)
        self.assertIn("gIrradianceMap", seen)

    def test_m_draws_with_the_next_setting(self):
        self.view.screen.press("m")
        self.view.title("[seed] picture")
        self.keep(self.view.still(unlike=self.start))
        for setting in ("deon2007", "corrected"):
            self.view.screen.press("m")
            self.view.title(f"[{setting}] picture")
        self.assertEqual(self.view.still(), self.start)

    def test_a_broken_edit_keeps_the_picture_and_its_mending_is_seen(self):
        include = self.view.folder / "effects" / "passes" / "final.fxh"
        text = include.read_text()
        include.write_text(text.replace("FinalPS", "FinalPS(broken", 1))
        title = self.view.title("error TG")
        self.assertIn(include.name, title)
        broken = self.keep(self.view.still(unlike=self.start))
        kept = self.view.crop(broken, "picture")  # smaller, above the message
        self.assertGreater(kept.height, 0.5 * SIZE)
        self.assertGreater(kept.mean(), 0.5 * self.start.mean())
        self.assertIn("error TG", self.view.said())
        replacement = include.with_suffix(".new")
        replacement.write_text(text)
        replacement.rename(include)  # as editors save
        self.view.title("Main.fx DEonLuebke [corrected] picture")
        self.assertEqual(self.keep(self.view.still(unlike=broken), "mended"), self.start)

    def test_an_edit_that_changes_the_picture_is_seen(self):
        include = self.view.folder / "effects" / "passes" / "final.fxh"
        text = include.read_text()
        include.write_text(text.replace("float4(lerp(", "float4(0.25 * lerp("))
        edited = self.keep(self.view.still(unlike=self.start))
        self.assertLess(edited.mean(), 0.7 * self.start.mean())
        include.write_text(text)
        self.assertEqual(self.view.still(unlike=edited), self.start)

    def test_a_drag_is_answered_while_an_edit_compiles_and_the_last_edit_wins(self):
        include = self.view.folder / "effects" / "passes" / "final.fxh"
        text = include.read_text()
        include.write_text(slow_edit(text))
        self.view.title("making the edit")
        self.view.screen.drag((160, 160), (240, 130))
        turned = self.view.wait("the answer to the drag", lambda: (lambda seen: seen if seen.share_apart(self.start) > 0.02 else None)(self.view.screen.grab()))
        self.assertIn("making the edit", self.view.screen.title(), "the edit is not there yet")
        self.keep(turned, "while_an_edit_compiles")
        self.assertGreater(turned.mean(), 0.8 * self.start.mean(), "the old picture was turned")
        self.view.screen.press("t")  # what is asked for meanwhile is not lost
        self.view.title("making technique")
        self.view.screen.press("T", "Shift_L")
        include.write_text(text.replace("float4(lerp(", "float4(0.25 * lerp("))
        self.view.wait("the end of it", lambda: "making" not in self.view.screen.title())
        self.assertIn("DEonLuebke [corrected]", self.view.screen.title())
        edited = self.keep(self.view.still(), "the_last_edit")
        self.assertLess(edited.mean(), 0.7 * self.start.mean())
        include.write_text(text)
        self.view.still(unlike=edited)
        self.assertEqual(self.view.start_again(), self.start)

    def test_h_and_p_set_keys_and_controls_beside_the_picture(self):
        for key, panel in (("h", "sheets"), ("p", "controls")):
            self.view.screen.press(key)
            over = self.keep(self.view.still(unlike=self.start), f"key_{key}")
            letters = sum(value > 150 for value in self.view.crop(over, panel).pixels)
            self.assertGreater(letters, 1000)
            self.assertGreater(self.view.crop(over, "picture").mean(), 5)
            self.view.screen.press(key)
            self.assertEqual(self.view.still(unlike=over), self.start)

    def test_x_tells_values_and_how_they_are_spread(self):
        self.view.screen.move(250, 160)
        self.view.screen.press("x")
        over = self.keep(self.view.still(unlike=self.start), "key_x")
        self.assertGreater(over.share_apart(self.start), 0.02)
        here = self.view.crop(over, "sheets")
        self.view.screen.move(240, 190)
        there = self.keep(self.view.still(unlike=over), "key_x_elsewhere")
        self.assertNotEqual(self.view.crop(there, "sheets"), here)
        self.assertEqual(self.view.crop(there, "picture"), self.view.crop(over, "picture"))
        self.view.screen.press("x")
        self.assertEqual(self.view.still(unlike=over), self.start)

    def test_v_shows_targets_as_small_pictures_and_a_click_opens_one(self):
        self.view.screen.press("v")
        strip = self.keep(self.view.still(unlike=self.start), "key_v")
        self.assertGreater(strip.share_apart(self.start), 0.05)
        self.view.click("target/gTsmMap")
        self.view.title("target gTsmMap")
        self.keep(self.view.still(unlike=strip), "key_v_opened")
        self.view.screen.press("v")
        self.assertEqual(self.view.start_again(), self.start)

    def amber(self, picture):
        """Of arrows that begin or end at the target under the cursor, else at the one that is shown."""
        pixels = picture.pixels
        return sum(abs(pixels[i] - 255) < 12 and abs(pixels[i + 1] - 190) < 12 and abs(pixels[i + 2] - 60) < 24 for i in range(0, len(pixels), 3))

    def test_arrows_tell_what_is_drawn_from_what(self):
        self.view.screen.resize(2 * SIZE, SIZE)
        wide = self.view.still(unlike=self.start)
        self.view.screen.press("v")
        strip = self.keep(self.view.still(unlike=wide), "arrows_1_to_the_picture")
        self.assertGreater(self.amber(strip), 100)
        left, top, width, height = self.view.place("target/gTsmMap")  # which the first convolution and the picture read
        self.view.screen.move(round(left + 15), round(top + 15))
        hovered = self.keep(self.view.still(unlike=strip), "arrows_2_of_one_target")
        self.assertGreater(self.amber(hovered), 100)
        self.view.screen.move(10, 10)
        self.view.screen.press("v")
        self.view.screen.resize(SIZE, SIZE)
        self.assertEqual(self.view.still(unlike=hovered), self.start)

    def test_z_enlarges_about_the_cursor_and_Z_shows_the_whole(self):
        self.view.screen.move(100, 120)
        self.view.still()
        self.view.screen.press("z")
        large = self.keep(self.view.still(unlike=self.start), "key_z")
        at = (120 * large.width + 100) * 3
        apart = max(abs(a - b) for a, b in zip(large.pixels[at:at + 3], self.start.pixels[at:at + 3]))
        self.assertLessEqual(apart, 8)  # a pixel's texel stays; half a pixel of it may not
        self.view.screen.press("z", "Shift_L")
        self.assertEqual(self.view.still(unlike=large), self.start)

    def test_s_writes_a_png_of_the_windows_size(self):
        self.view.screen.press("s")
        path = self.view.folder / "out" / "Main-001.png"
        self.view.wait("the picture", path.exists)
        self.view.wait("its end", lambda: path.read_bytes().endswith(b"IEND\xaeB`\x82"))
        header = path.read_bytes()[16:24]
        self.assertEqual((int.from_bytes(header[:4], "big"), int.from_bytes(header[4:], "big")), (SIZE, SIZE))

    def workspace_of(self, number):
        path = self.view.folder / "out" / f"Main-{number:03}.json"
        self.view.wait("the workspace", lambda: path.exists() and path.read_text().endswith("}\n"))
        return path

    def test_w_writes_a_workspace_that_draws_this_picture_and_c_copies_the_line_that_does(self):
        self.view.screen.drag((160, 160), (220, 140))
        self.view.still(unlike=self.start)
        self.view.screen.drag((160, 160), (110, 190), button=3)
        self.view.screen.press("n")  # the first preset
        shown = self.keep(self.view.still(unlike=self.start))
        self.view.screen.press("w")
        workspace = json.loads(self.workspace_of(1).read_text())
        self.assertEqual(workspace["mesh"], "../ball.obj")
        self.assertEqual(workspace["camera"]["frame"], "world")
        self.assertIn("gRoughness", workspace["parameters"])
        self.view.screen.press("c")
        self.view.wait("the line", lambda: "copied: " in self.view.said())
        line = self.view.screen.clipboard()
        self.assertTrue(line.startswith("tegument render effects/Main.fx -t DEonLuebke --setting corrected -w out/Main-001.json --size 320x320"), line)
        self.assertFalse((self.view.folder / "out" / "Main-002.json").exists(), "nothing has changed since w")
        ran = subprocess.run([PROGRAM] + shlex.split(line)[1:], cwd=self.view.folder, capture_output=True, text=True, timeout=PATIENCE)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        drawn = screens.read_png(self.view.folder / "out" / "Main-001.png")
        part = screens.Picture(SIZE, SIZE, b"".join(shown.pixels[y * shown.width * 3:(y * shown.width + SIZE) * 3] for y in range(SIZE)))
        self.assertLess(drawn.share_apart(part, limit=2), 0.001)  # bytes are rounded in a shader there, on the processor here

    def test_n_goes_through_the_presets_and_back(self):
        self.view.screen.press("n")
        dry = self.keep(self.view.still(unlike=self.start), "preset_1")
        self.view.screen.press("n")
        self.keep(self.view.still(unlike=dry), "preset_2")
        for _ in range(8):  # seven more, and none
            self.view.screen.press("n")
        self.assertEqual(self.view.still(unlike=dry), self.start)

    def test_panels_stand_side_by_side_and_show_what_the_technique_uses(self):
        self.view.screen.resize(640, 320)
        for key in ("i", "h", "p"):
            self.view.screen.press(key)
        self.keep(self.view.still(unlike=self.start))
        for key in ("p", "h", "i"):
            self.view.screen.press(key)
        self.view.screen.resize(SIZE, SIZE)
        self.assertEqual(self.view.still(), self.start)

    def test_y_dropped_files_are_shown(self):
        (self.view.folder / "egg.obj").write_text(ball(radius=60.0))
        self.view.screen.drop(self.view.folder / "egg.obj")
        self.view.wait("the mesh", lambda: "shown: " in self.view.said() and "egg.obj" in self.view.said())
        egg = self.keep(self.view.still(unlike=self.start), "dropped_mesh")
        self.view.screen.drop(self.view.folder / "notes.txt")
        self.view.wait("the refusal", lambda: "TG8045" in self.view.said())
        self.view.screen.drop(self.view.folder / "effects" / "Specular.fx")
        self.view.title("Specular.fx Specular")
        self.keep(self.view.still(unlike=egg), "dropped_effect")
        self.view.screen.drop(self.view.folder / "effects" / "Main.fx")
        self.view.title("Main.fx DEonLuebke")
        self.view.screen.drop(self.view.folder / "ball.json")
        self.view.wait("the workspace", lambda: "ball.json" in self.view.said())
        self.assertEqual(self.view.still(unlike=egg), self.start)

    def test_a_resized_window_is_drawn_anew(self):
        self.view.screen.resize(SIZE // 2, SIZE - 40)
        small = self.keep(self.view.still(unlike=self.start))
        self.assertGreater(small.mean(), 2)
        self.view.screen.resize(SIZE, SIZE)
        self.assertEqual(self.view.still(unlike=small), self.start)

    def test_zz_the_program_ends_in_peace_and_validation_said_nothing(self):
        self.view.screen.press("q")
        self.assertEqual(self.view.process.wait(PATIENCE), 0, self.view.said())
        self.assertNotIn("validation:", self.view.said())


class RoundTrip(unittest.TestCase):
    """What the window writes is shown by a window, and drawn by `render`, as it was: every control was moved."""

    SWITCHES = {"TEGUMENT_SURROUNDINGS": 1, "TEGUMENT_LAMPS": 2, "TEGUMENT_LOBES": 1}

    def moved(self, view):
        screen = view.screen
        view.title("Main.fx DEonLuebke [corrected] picture")
        screen.press("i")
        last = view.still()
        view.turn_to("Lambert", "t")
        view.turn_to("DEonLuebke", "t")
        screen.press("m")
        view.title("[seed] picture")
        for name, change in (("camera", lambda: screen.drag((160, 160), (220, 140))), ("near", lambda: screen.wheel(up=True)),
                             ("aside", lambda: screen.drag((160, 160), (170, 165), held=("Shift_L",))),
                             ("light", lambda: screen.drag((160, 160), (110, 190), button=3)),
                             ("surroundings", lambda: screen.drag((160, 160), (260, 160), button=3, held=("Shift_L",))),
                             ("preset", lambda: screen.press("n"))):
            change()
            last = keep(view.still(unlike=last), f"round_{name}")
        return last

    def test_of_every_control_changes_nothing(self):
        sets = [word for name, value in self.SWITCHES.items() for word in ("--set", f"{name}={value}")]
        first = View(("effects/Main.fx", "-w", "ball.json", "--map-size", "64", *sets, "--set", "gSurroundings=3"))
        path = first.folder / "out" / "Main-001.json"
        second = None
        try:
            shown = self.moved(first)
            first.screen.press("w")
            first.wait("the workspace", lambda: path.exists() and path.read_text().endswith("}\n"))
            scene = json.loads(path.read_text())
            self.assertEqual({name: scene["parameters"][name] for name in self.SWITCHES}, self.SWITCHES)
            self.assertEqual([scene["technique"], scene["setting"], scene["size"]], ["DEonLuebke", "seed", [SIZE, SIZE]])
            second = View(("effects/Main.fx", "-w", str(path)))
            second.title("Main.fx DEonLuebke [seed] picture")
            second.screen.press("i")
            again = keep(second.still(), "round_again")
            self.assertEqual(again, shown)
            picture = first.folder / "drawn.png"
            ran = subprocess.run([PROGRAM, "render", "effects/Main.fx", "-w", str(path), "-o", str(picture)], cwd=first.folder, capture_output=True,
                                 text=True, timeout=PATIENCE)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            drawn = screens.read_png(picture)
            part = screens.Picture(SIZE, SIZE, b"".join(shown.pixels[y * shown.width * 3:(y * shown.width + SIZE) * 3] for y in range(SIZE)))
            self.assertLess(drawn.share_apart(part, limit=2), 0.001)
        finally:
            for view in (first, second):
                if view:
                    view.end()
                    shutil.rmtree(view.folder)


class Leaving(unittest.TestCase):
    def test_the_program_ends_in_peace_while_an_edit_compiles_and_a_line_had_said_so(self):
        view = View()
        self.addCleanup(lambda: (view.end(), shutil.rmtree(view.folder)))
        view.title("Main.fx DEonLuebke [corrected] picture")
        include = view.folder / "effects" / "passes" / "final.fxh"
        include.write_text(slow_edit(include.read_text()))
        view.title("making the edit")
        time.sleep(0.5)
        keep(view.screen.grab(), "what_is_made_is_said")
        asked = time.monotonic()
        view.screen.press("q")
        self.assertEqual(view.process.wait(PATIENCE), 0, view.said())
        self.assertLess(time.monotonic() - asked, 0.25 * PATIENCE, "it waits for no compiler")
        self.assertNotIn("validation:", view.said())


class NoWindowSystem(unittest.TestCase):
    def test_without_a_display_one_line_says_so_and_the_exit_code_is_3(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "ball.obj").write_text(ball(4))
            environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
            ran = subprocess.run([PROGRAM, "view", REPOSITORY / "effects" / "Main.fx", "-m", f"{folder}/ball.obj", "--unit-mm", "2"],
                                 env=environment, capture_output=True, text=True, timeout=PATIENCE)
        self.assertEqual(ran.returncode, 3, ran.stderr)
        self.assertEqual(len([line for line in ran.stderr.splitlines() if "error TG6060" in line]), 1, ran.stderr)


if __name__ == "__main__":
    main()
