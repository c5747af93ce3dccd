#!/usr/bin/env python3
"""tegument view under Xvfb, driven by real input events: what a person at the screen would see.

usage: window_test.py PROGRAM REPOSITORY [PICTURES]      with PICTURES the screen of every step is kept there
Exit code 77: this machine lacks Xvfb, python3-xlib or a Vulkan driver that draws to windows.
"""

import json
import math
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

import screen as screens

PROGRAM, REPOSITORY = sys.argv[1], pathlib.Path(sys.argv[2])
PICTURES = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else None
SIZE = 320
PATIENCE = 60  # seconds: lavapipe beside other tests
SKIPPED = 77


def ball(rings=24, radius=80.0):
    """A closed bumpy ball in two charts, in mm."""
    lines, faces, index = [], [], 1
    for chart in range(2):
        for i in range(rings + 1):
            for j in range(rings + 1):
                u, v = j / rings, i / rings
                theta, phi = math.pi * v, math.pi * (u + chart)
                r = radius * (1 + 0.05 * math.sin(3 * theta) * math.cos(2 * phi + 0.5))
                lines.append(f"v {-r * math.cos(phi) * math.sin(theta):.6f} {r * math.cos(theta):.6f} {r * math.sin(phi) * math.sin(theta):.6f}")
                lines.append(f"vt {0.02 + 0.5 * chart + 0.46 * u:.6f} {1 - (0.02 + 0.96 * v):.6f}")
                down = index + rings + 1
                if i < rings and j < rings:
                    if i > 0:
                        faces.append(f"f {index}/{index} {down}/{down} {index + 1}/{index + 1}")
                    if i + 1 < rings:
                        faces.append(f"f {index + 1}/{index + 1} {down}/{down} {down + 1}/{down + 1}")
                index += 1
    return "\n".join(lines + faces) + "\n"


def own_copy():
    """A folder with the effects and a ball."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="tegument-view-"))
    for name in ("effects", "hlsl"):
        shutil.copytree(REPOSITORY / name, folder / name)
    (folder / "ball.obj").write_text(ball())
    scene = {"mesh": "ball.obj", "unit_mm": 1, "head": False, "camera": {"position": [1, 0.5, 5]}, "light": {"position": [-1, 2, 5]}}
    (folder / "ball.json").write_text(json.dumps(scene))
    return folder


class View:
    """The program with a copy of the effects of its own, so that they can be broken."""

    def __init__(self, arguments=("effects/Main.fx", "-w", "ball.json", "--map-size", "64"), files=(), before=None):
        self.folder = own_copy()
        if before:
            before(self.folder)
        self.screen = screens.Screen(2 * SIZE, SIZE)
        self.errors = open(self.folder / "stderr.txt", "w+")
        for name, text in files:
            (self.folder / name).write_text(text)
        command = [PROGRAM, "view", *arguments, "--size", f"{SIZE}x{SIZE}", "--validate"]
        environment = {**os.environ, "DISPLAY": self.screen.name}
        environment.pop("WAYLAND_DISPLAY", None)
        self.process = screens.begin(command, cwd=self.folder, env=environment, stderr=self.errors)

    def said(self):
        return (self.folder / "stderr.txt").read_text()

    def wait(self, what, condition):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if self.process.poll() is not None:
                raise AssertionError(f"the program ended with {self.process.returncode}: {self.said()}")
            value = condition()
            if value:
                return value
            time.sleep(0.05)
        raise AssertionError(f"{what}: not within {PATIENCE} s; title '{self.screen.title()}', said '{self.said()}'")

    def title(self, part):
        return self.wait(f"'{part}' in the title", lambda: part in self.screen.title() and self.screen.title())

    def worked(self):
        """Ticks (10 ms) of processor time that the program has used."""
        fields = pathlib.Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return int(fields[11]) + int(fields[12])

    def still(self, unlike=None):
        """The screen once it stays the same while the program rests, and is not `unlike`."""
        last = [self.screen.grab(), self.worked()]

        def settled():
            time.sleep(0.4)
            now, worked = self.screen.grab(), self.worked()
            rests = now == last[0] and worked - last[1] <= 2  # it looks at its files now and then
            last[:] = now, worked
            return now if rests and (unlike is None or now != unlike) else None

        return self.wait("a picture that stays", settled)

    def start_again(self):
        for key in ("Escape", "r"):
            self.screen.press(key)
        self.title("picture,")
        return self.still()

    def end(self):
        """Its exit code; killed where a test that failed left the keys with the text of the effect, say."""
        if self.process.poll() is None:
            self.screen.press("q")
            try:
                self.process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                self.process.kill()
        self.screen.close()
        return self.process.wait()


def keep(picture, name):
    if PICTURES:
        PICTURES.mkdir(parents=True, exist_ok=True)
        picture.save(PICTURES / f"{name}.png")
    return picture


def slow_edit(text):
    """What takes the compiler some seconds: a loop that is unrolled, and whose result counts; the picture gets darker."""
    loop = "[unroll] for (int slow = 0; slow < 600; ++slow) sum += sin(sum.yzx * float(slow) + uv.xyx);"
    edited = text.replace("float4(lerp(", "1e-9 * SlowSum(input.uv * 1e-3).xyzz + float4(0.25 * lerp(")
    edited = edited.replace("float4 FinalPS", "float3 SlowSum(float2 uv) { float3 sum = uv.xyy; " + loop + " return sum; }\n\nfloat4 FinalPS", 1)
    assert edited.count("SlowSum") == 3, "what this edits is there"
    return edited


class WideWindow(unittest.TestCase):
    """Twice as wide as high, for what stands beside or over the picture; it must end well, with no message of validation."""

    ARGUMENTS = ("effects/Main.fx", "-w", "ball.json", "--map-size", "64")
    FILES = ()
    TITLE = "Main.fx DEonLuebke [corrected] picture"

    @classmethod
    def setUpClass(cls):
        cls.view = View(cls.ARGUMENTS, cls.FILES)
        cls.view.title(cls.TITLE)
        cls.view.screen.resize(2 * SIZE, SIZE)
        cls.view.screen.press("i")  # the text holds times, which differ from frame to frame
        cls.start = cls.view.still()

    @classmethod
    def tearDownClass(cls):
        ended, said = cls.view.end(), cls.view.said()
        shutil.rmtree(cls.view.folder)
        assert ended == 0 and "validation:" not in said, said


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
        self.assertEqual(turned[0], turned[1], "both turn the camera")
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
        def step():
            name = self.view.screen.title().split(" [")[0]
            self.view.screen.press("t")
            self.view.wait("the next technique", lambda: f"{name} [" not in self.view.screen.title())

        while "Lambert [" not in self.view.screen.title():
            step()
        self.keep(self.view.still(unlike=self.start))
        while "DEonLuebke [" not in self.view.screen.title():
            step()
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
        self.assertLess(broken.share_apart(self.start), 0.4)  # the message covers the lower part
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

    def test_h_and_p_lay_help_and_sliders_over_the_picture(self):
        for key in ("h", "p"):
            self.view.screen.press(key)
            over = self.keep(self.view.still(unlike=self.start), f"key_{key}")
            self.assertGreater(over.share_apart(self.start), 0.02)
            self.view.screen.press(key)
            self.assertEqual(self.view.still(unlike=over), self.start)

    def test_x_tells_values_and_how_they_are_spread(self):
        self.view.screen.move(160, 160)
        self.view.screen.press("x")
        over = self.keep(self.view.still(unlike=self.start), "key_x")
        self.assertGreater(over.share_apart(self.start), 0.02)
        self.view.screen.press("i")  # the values stand in the text
        here = self.keep(self.view.still(unlike=over), "key_x_values")
        self.view.screen.move(150, 120)
        self.assertNotEqual(self.keep(self.view.still(unlike=here), "key_x_elsewhere"), here)
        self.view.screen.press("i")
        self.view.still()
        self.view.screen.press("x")
        self.assertEqual(self.view.still(unlike=over), self.start)

    def test_v_shows_targets_as_small_pictures_and_a_click_opens_one(self):
        self.view.screen.press("v")
        strip = self.keep(self.view.still(unlike=self.start), "key_v")
        self.assertGreater(strip.share_apart(self.start), 0.05)
        self.view.screen.drag((30, 225), (30, 225))  # in the order of the frame, the picture last
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
        self.view.screen.move(30, 225)  # gTsmMap, which the first convolution and the picture read
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
        for _ in range(2):
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
        view.screen.press("q")
        self.assertEqual(view.process.wait(PATIENCE), 0, view.said())
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
    if screens.missing():
        print("skipped: " + screens.missing())
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1], verbosity=2)
