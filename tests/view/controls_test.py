#!/usr/bin/env python3
"""The controls of tegument view by real input events under Xvfb: each changes the picture, the search finds them, files are opened and saved by dialog, lights
are dragged, and at no size of window does a panel stand over the picture.

usage: controls_test.py PROGRAM REPOSITORY [PICTURES]      with PICTURES the screen of every step is kept there
Exit code 77: this machine lacks Xvfb, python3-xlib or a Vulkan driver that draws to windows.
"""

import json
import shutil
import subprocess
import unittest

import screen as screens
import session as base

SIZE = (900, 560)
SWITCHES = ("--set", "TEGUMENT_SURROUNDINGS=1", "--set", "TEGUMENT_LAMPS=2", "--set", "TEGUMENT_SOFT_SHADOWS=1")
PLAIN = """float4x4 wvp : WORLDVIEWPROJECTION;
float3 tint < string UIWidget = "Color"; string UIName = "Tint of all that is seen"; > = { 1, 0, 0 };
float hidden = 1;
struct V { float4 p : SV_Position; };
V VS(float4 p : POSITION) { V v; v.p = mul(p, wvp); return v; }
float4 PS(V v) : SV_Target { return float4(tint * hidden, 1); }
technique A { pass P { VertexShader = compile vs_4_0 VS(); PixelShader = compile ps_4_0 PS(); } }
"""


class Panelled(base.View):
    def picture(self):
        """What stands in the picture's area."""
        return self.crop(self.screen.grab(), "picture")

    def away(self):
        """The mouse over nothing that lights up or explains itself."""
        self.screen.move(self.screen.width - 3, self.screen.height - 3)

    def changed(self, before, least=1e-4):
        self.away()

        def other():
            now = self.picture()
            return now if len(now.pixels) == len(before.pixels) and now.share_apart(before, limit=0) > least else None
        return self.wait("another picture", other)

    def is_again(self, before):
        self.away()
        self.wait("the picture as it was", lambda: self.picture() == before)


class Controls(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.view = Panelled(("effects/Main.fx", "-w", "ball.json", "--map-size", "64", "--samples", "1", *SWITCHES), size=SIZE, screen=SIZE)
        cls.view.title("Main.fx DEonLuebke [corrected] picture")
        cls.view.away()
        base.keep(cls.view.still(), "controls_start")
        cls.start = cls.view.picture()

    @classmethod
    def tearDownClass(cls):
        cls.view.search("")
        cls.view.away()
        ended, said = cls.view.end(), cls.view.said()
        shutil.rmtree(cls.view.folder)
        assert ended == 0 and "validation:" not in said, said

    def setUp(self):
        self.view.search("")
        self.view.screen.press("r")
        self.view.is_again(self.start)

    def found(self, text, prefix=""):
        self.view.search(text)
        return sorted(name for name in self.view.places() if "/" in name and name.split("/")[0] not in ("menu", "disc", "section") and name.startswith(prefix))

    def drag_disc(self, name, by):
        left, top, width, height = self.view.place("disc/" + name)
        at = (round(left + width / 2), round(top + height / 2))
        self.view.screen.move(*at)
        self.view.still()
        self.view.screen.drag(at, (at[0] + by[0], at[1] + by[1]))

    def moved(self, name, search, by=0.3):
        self.view.search(search)
        self.view.slide(name, by)
        picture = self.view.changed(self.start)
        self.view.screen.press("r")
        self.view.is_again(self.start)
        return picture

    def test_every_number_of_a_light_changes_the_picture_and_r_takes_it_back(self):
        for lamp in ("", "1/", "2/"):
            for name in ("Colour", "Intensity") + (("Position",) if not lamp else ("Direction", "Highlight")):
                with self.subTest(control=lamp + name):
                    words = (f"lamp {lamp[0]}: " if lamp else "") + name.lower()
                    self.moved(f"Lights/{lamp}{name}", words, -0.2 if name == "Colour" else 0.3)

    def test_every_number_of_skin_changes_the_picture(self):
        names = [name for name in self.found("skin", "Skin/g")]
        self.assertGreater(len(names), 5, names)
        # Of what is culled alike, of what does not scatter, of light through thin parts and of shadows: the ball has none.
        quiet = {"gUsePrePass", "gPlainRoughness", "gPlainIntensity", "gTransmission", "gShadowTolerance"}
        for name in names:
            parameter = name.split("/")[1]
            if parameter in quiet:
                continue
            with self.subTest(control=name):
                self.moved(name, parameter, -0.3)

    def test_the_camera_s_numbers_and_its_buttons_move_it(self):
        for name in ("Camera", "Target", "Field of view"):
            with self.subTest(control=name):
                self.moved(f"Scene/{name}", name.lower(), 0.2)

    def test_numbers_that_have_no_slider_are_found_by_their_name(self):
        names = self.found("gaussianweight", "More parameters/")
        self.assertIn("More parameters/gGaussianWeight[0]", names)
        self.moved("More parameters/gGaussianWeight[0]", "gaussianweight[0]", -0.3)
        self.assertEqual(self.found("no such word"), [])

    def test_technique_setting_and_preset_are_chosen_from_lists(self):
        view = self.view
        view.choose("Technique/Technique", "Lambert")
        view.title("Main.fx Lambert [")
        lambert = view.changed(self.start)
        view.choose("Technique/Technique", "DEonLuebke")
        view.title("Main.fx DEonLuebke [")
        view.changed(lambert)
        view.choose("Technique/Setting", "seed")
        view.title("[seed] picture")
        view.choose("Technique/Setting", "corrected")
        view.title("[corrected] picture")
        view.is_again(self.start)
        view.search("preset")
        view.choose("Technique/Preset", "dry")
        view.changed(self.start)

    def test_a_light_s_disc_is_dragged_and_turns_it_about_the_target(self):
        self.drag_disc("light", (-8, 90))
        base.keep(self.view.screen.grab(), "disc_dragged")
        self.view.changed(self.start, 0.01)
        self.view.screen.press("r")
        self.view.is_again(self.start)
        self.drag_disc("lamp 1", (-60, 60))
        self.view.changed(self.start)

    def test_a_switch_reads_the_effect_again_and_keeps_the_view(self):
        view = self.view
        view.search("surroundings")
        view.click("Surroundings/TEGUMENT_SURROUNDINGS")
        dark = view.changed(self.start)
        self.assertLess(dark.mean(), self.start.mean())
        view.click("Surroundings/TEGUMENT_SURROUNDINGS")
        view.is_again(self.start)


class Files(unittest.TestCase):
    """Opened and saved by dialog, and drawn the same by the window, by a window on the saved file, and by `render`."""

    def setUp(self):
        self.view = Panelled(("effects/Main.fx", "-w", "ball.json", "--map-size", "64", *SWITCHES), size=SIZE, screen=SIZE)
        self.addCleanup(lambda: shutil.rmtree(self.view.folder))
        self.addCleanup(self.view.end)
        self.view.title("Main.fx DEonLuebke [corrected] picture")

    def dialog(self, item, path):
        self.view.click("menu/File")
        self.view.click(f"menu/{item}")
        self.view.place("dialog/path")
        base.keep(self.view.screen.grab(), "dialog_" + item.split(" .")[0].replace(" ", "_"))
        self.view.screen.type(path)
        self.view.screen.press("Return")

    def test_go_round(self):
        view = self.view
        view.still()
        for search, name, by in (("camera", "Scene/Camera", 0.1), ("target", "Scene/Target", 0.02), ("field", "Scene/Field of view", 0.05), ("position", "Lights/Position", 0.3),
                                 ("shadow map", "Lights/Shadow map", -0.2), ("intensity", "Lights/Intensity", 0.2), ("colour", "Lights/Colour", -0.1),
                                 ("lamp 1: direction", "Lights/1/Direction", 0.2), ("lamp 2: colour", "Lights/2/Colour", -0.1), ("lamp 1: size", "Lights/1/Size", 0.2), ("lamp 1: shadow", "Lights/1/Shadow", -0.2),
                                 ("roughness", "Skin/gRoughness", 0.2), ("turn of", "Surroundings/gSurroundingsTurn", 0.3), ("gaussianweight[0]", "More parameters/gGaussianWeight[0]", 0.1)):
            view.search(search)
            view.slide(name, by)
        view.search("")
        view.away()
        base.keep(view.still(), "round_trip_by_controls")
        shown = view.picture()
        saved = view.folder / "saved here.json"
        self.dialog("Save workspace as ...", str(saved))
        view.wait("the workspace", lambda: saved.exists() and saved.read_text().endswith("}\n"))
        scene = json.loads(saved.read_text())
        self.assertEqual(scene["size"], [shown.width, shown.height])
        self.assertNotEqual(scene["parameters"]["gLampAxis"][3], 0.25)  # which the ball does not show: it hides nothing of itself
        self.assertLess(scene["parameters"]["gLampSpot"][2], 0.9)
        drawn = view.folder / "drawn.png"
        ran = subprocess.run([base.PROGRAM, "render", "effects/Main.fx", "-w", str(saved), "-o", str(drawn), "--map-size", "64"], cwd=view.folder,
                             capture_output=True, text=True, timeout=base.PATIENCE)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        view.screen.press("i")  # the discs of lights stand on the picture
        picture = view.folder / "shown"
        before = shutil.copy(saved, view.folder / "before.json")
        view.screen.press("i")
        self.dialog("Save picture as ...", str(picture))
        picture = picture.with_suffix(".png")
        view.wait("the picture", lambda: picture.exists() and picture.read_bytes().endswith(b"IEND\xaeB`\x82"))
        if base.PICTURES:
            for made in (picture, drawn):
                shutil.copy(made, base.PICTURES)
        self.assertLess(screens.read_png(picture).share_apart(screens.read_png(drawn), limit=2), 1e-4)
        view.screen.press("r")
        view.changed(shown)
        self.dialog("Open workspace ...", str(before))
        view.wait("the workspace", lambda: "shown: " in view.said())
        view.is_again(shown)

    def test_what_is_wrong_is_said_and_nothing_that_was_read_is_replaced(self):
        view = self.view
        view.still()
        self.dialog("Open mesh ...", "nowhere.obj")
        base.keep(view.still(), "dialog_no_such_file")
        view.click("dialog/cancel")
        mesh = view.folder / "ball.json"
        text = mesh.read_text()
        self.dialog("Save workspace as ...", str(mesh))
        base.keep(view.still(), "dialog_is_there_already")
        view.click("dialog/do")  # once more
        view.wait("the refusal", lambda: "TG5004" in view.said())
        self.assertEqual(mesh.read_text(), text)
        (view.folder / "egg.obj").write_text(base.ball(radius=60.0))
        before = view.picture()
        self.dialog("Open mesh ...", str(view.folder / "egg.obj"))
        view.wait("the mesh", lambda: "shown: " in view.said())
        view.changed(before)


def apart(a, b):
    return a[0] + a[2] <= b[0] or b[0] + b[2] <= a[0] or a[1] + a[3] <= b[1] or b[1] + b[3] <= a[1]


class Sizes(unittest.TestCase):
    PANELS = ("menus", "controls", "sheets", "targets", "problem", "status", "source")
    KEYS = ("h", "x", "g", "o", "v", "b", "p", "f", "i")

    def test_no_panel_stands_over_the_picture_or_another_one(self):
        for width, height, scale in ((320, 240, 1), (1280, 800, 1), (1920, 1080, 1), (3840, 2160, 2)):
            with self.subTest(size=(width, height), scale=scale):
                view = Panelled(("plain.fx", "-w", "ball.json", "--samples", "1"), (("plain.fx", PLAIN),), size=(width, height), screen=(width, height), scale=scale)
                self.addCleanup(lambda folder=view.folder: shutil.rmtree(folder))
                self.addCleanup(view.end)
                view.title("plain.fx A")
                place = view.place("status")
                self.assertAlmostEqual(place[3], 22 * scale, delta=2 * scale)
                for key in ("",) + self.KEYS:
                    if key:
                        view.screen.press(key)
                    view.place("picture")
                    self.check(view.places(), width, height)
                base.keep(view.screen.grab(), f"sizes_{width}x{height}")
                self.assertNotIn("validation:", view.said())

    def check(self, places, width, height):
        picture = places["picture"]
        self.assertGreaterEqual(picture[2] * picture[3], 0.09 * width * height, places)
        panels = [(name, places[name]) for name in self.PANELS if name in places]
        for i, (name, place) in enumerate(panels):
            self.assertTrue(apart(place, picture), f"{name} over the picture: {place}, {picture}")
            self.assertTrue(place[0] >= 0 and place[1] >= 0 and place[0] + place[2] <= width and place[1] + place[3] <= height, f"{name}: {place}")
            for other, its in panels[:i]:
                self.assertTrue(apart(place, its), f"{name} over {other}: {place}, {its}")

    def test_a_wide_window_and_a_high_one_show_all_that_a_square_one_shows(self):
        view = Panelled(("plain.fx", "-w", "ball.json", "--samples", "1"), (("plain.fx", PLAIN),), size=(400, 400), screen=(800, 800))
        self.addCleanup(lambda: shutil.rmtree(view.folder))
        self.addCleanup(view.end)
        view.title("plain.fx A")
        view.screen.press("i")
        view.still()
        for size in ((400, 400), (800, 300), (300, 800)):
            view.screen.resize(*size)
            view.wait("its size", lambda: tuple(view.places()["picture"][2:]) == size)
            view.still()
            picture = view.picture()
            red = [i // 3 for i in range(0, len(picture.pixels), 3) if picture.pixels[i] > 200]
            rows = {i // picture.width for i in red}
            columns = {i % picture.width for i in red}
            side = min(size)
            self.assertAlmostEqual(len(rows), len(columns), delta=0.1 * side)
            self.assertAlmostEqual(max(len(rows), len(columns)) / side, 0.865, delta=0.01, msg=str(size))


if __name__ == "__main__":
    base.main()
