#!/usr/bin/env python3
"""A user in a hurry before tegument view: files that go, that are saved all the time, that are no files; windows of any size; keys and drops while something is
made. By real input events under Xvfb. Whatever happens, it stays, says why, and shows what it can.

usage: hurry_test.py PROGRAM REPOSITORY [PICTURES]      with PICTURES the screen of every step is kept there
Exit code 77: this machine lacks Xvfb, python3-xlib or a Vulkan driver that draws to windows.
"""

import time

import session as base

EFFECT = """float4 tint = { %s };
float4x4 wvp : WORLDVIEWPROJECTION;
struct V { float4 p : SV_Position; float3 n : TEXCOORD0; };
V VS(float4 p : POSITION, float3 n : NORMAL) { V v; v.p = mul(p, wvp); v.n = n; return v; }
float4 PS(V v) : SV_Target { return tint; }
float4 PS2(V v) : SV_Target { return tint * 0.5; }
technique A { pass P { VertexShader = compile vs_4_0 VS(); PixelShader = compile ps_4_0 PS(); } }
technique B { pass P { VertexShader = compile vs_4_0 VS(); PixelShader = compile ps_4_0 PS2(); } }
"""
RED, GREEN, BLUE = EFFECT % "1, 0, 0, 1", EFFECT % "0, 1, 0, 1", EFFECT % "0, 0, 1, 1"


class Hurry(base.WideWindow):
    ARGUMENTS = ("quick.fx", "--mesh", "ball.obj")
    FILES = (("quick.fx", RED), ("green.fx", GREEN), ("notes.txt", "no effect"), ("broken.fx", RED.replace("mul(p, wvp)", "nowhere")), ("empty.fx", ""),
             ("broken.obj", "v 1 2\nf 1 2 3\n"), ("picture.png", "no picture"))
    TITLE = "quick.fx A"

    def setUp(self):
        self.effect = self.view.folder / "quick.fx"

    def tearDown(self):
        if self.id().rsplit(".", 1)[1].startswith("test_zz"):  # which has ended it
            return
        self.assertIsNone(self.view.process.poll(), self.view.said())
        if self.effect.is_dir():
            self.effect.rmdir()
        self.effect.write_text(RED)
        for key in ("Escape", "r"):
            self.view.screen.press(key)
        self.middle_is((255, 0, 0))

    def middle(self):
        picture = self.view.screen.grab()
        at = (base.SIZE // 2 * picture.width + base.SIZE) * 3
        return tuple(picture.pixels[at:at + 3])

    def middle_is(self, colour):
        self.view.wait(f"{colour} in the middle, not {self.middle()}", lambda: self.middle() == colour)

    def test_an_effect_that_is_deleted_keeps_its_picture_until_it_is_there_again(self):
        self.effect.unlink()
        self.view.title("error TG")
        self.view.screen.drag((320, 160), (360, 170))
        self.view.screen.press("F5")
        self.assertEqual(self.middle(), (255, 0, 0))
        self.effect.write_text(BLUE)
        self.middle_is((0, 0, 255))
        self.view.title("quick.fx A")

    def test_an_effect_that_becomes_a_folder_is_an_error_and_then_a_file_again(self):
        self.effect.unlink()
        self.effect.mkdir()
        self.view.title("error TG")
        self.effect.rmdir()
        self.effect.write_text(GREEN)
        self.middle_is((0, 255, 0))

    def test_of_edits_every_50_ms_the_last_one_is_shown(self):
        for i in range(60):
            self.effect.write_text((GREEN, BLUE)[i % 2])
            time.sleep(0.05)
        self.effect.write_text(GREEN)
        self.middle_is((0, 255, 0))
        self.view.title("quick.fx A")

    def test_an_edit_that_never_compiles_keeps_the_picture_whatever_is_pressed(self):
        self.effect.write_text(RED.replace("mul(p, wvp)", "nowhere"))
        self.view.title("error TG")
        for key in "tTkemnxvguoblzZ+-0aif137r":
            self.view.screen.press({"+": "plus", "-": "minus"}.get(key, key), *(("Shift_L",) if key.isupper() or key == "+" else ()))
            time.sleep(0.02)
        for key in ("Right", "Left", "Down", "Up", "Escape"):
            self.view.screen.press(key)
        self.view.screen.resize(500, 300)
        time.sleep(0.5)
        self.view.screen.resize(2 * base.SIZE, base.SIZE)
        base.keep(self.view.screen.grab(), "hurry_all_keys_on_a_broken_edit")
        self.effect.write_text(GREEN)
        self.view.wait("an end of the error", lambda: "error" not in self.view.screen.title() and "making" not in self.view.screen.title())
        for key in "kxvgofiub":  # off again, each as often as it takes
            self.view.screen.press(key)
            time.sleep(0.05)
        self.view.screen.press("b")
        self.view.screen.press("b")

    def test_keys_and_the_kept_side_in_quick_turns_end_where_they_should(self):
        for _ in range(10):
            for key in ("k", "t", "k", "t"):
                self.view.screen.press(key)
        self.view.title("quick.fx A")
        self.middle_is((255, 0, 0))

    def test_a_mesh_that_vanishes_is_missed_by_nobody_until_it_is_dropped_again(self):
        mesh = self.view.folder / "ball.obj"
        text = mesh.read_text()
        mesh.unlink()
        try:
            self.view.screen.press("F5")
            self.effect.write_text(BLUE)
            self.middle_is((0, 0, 255))
            self.view.screen.drop(mesh)
            self.view.wait("the refusal", lambda: "TG" in self.view.screen.title() or "ball.obj" in self.view.said())
            self.assertEqual(self.middle(), (0, 0, 255))
        finally:
            mesh.write_text(text)

    def test_a_window_of_one_pixel_and_one_larger_than_the_screen_are_drawn(self):
        for size in ((1, 1), (4000, 3000), (3, 700), (2000, 2)):
            self.view.screen.resize(*size)
            time.sleep(1)
            for key in "xvgpk":
                self.view.screen.press(key)
            self.view.screen.drag((0, 0), (1, 1))
            time.sleep(1)
            for key in "xvgpk":
                self.view.screen.press(key)
            time.sleep(0.5)
        self.view.screen.resize(2 * base.SIZE, base.SIZE)

    def test_of_ten_files_dropped_at_once_each_is_shown_or_refused_while_the_picture_moves(self):
        folder = self.view.folder
        before = self.view.said().count("shown: ")
        names = ("notes.txt", "broken.fx", "ball.obj", "nowhere.obj", "empty.fx", "effects", "broken.obj", "picture.png", "ball.json", "green.fx")
        self.view.screen.drop(*(folder / name for name in names))
        self.view.screen.drag((320, 160), (350, 180))
        self.view.title("green.fx A")
        self.middle_is((0, 255, 0))
        self.assertGreaterEqual(self.view.said().count("shown: ") - before, 3, self.view.said())
        self.view.screen.drop(folder / "quick.fx")
        self.view.title("quick.fx A")

    def test_zz_the_program_ends_in_peace_while_it_reads_a_file_and_validation_said_nothing(self):
        self.view.screen.drop(self.view.folder / "ball.obj")
        self.view.screen.press("t")
        self.view.screen.press("q")
        self.assertEqual(self.view.process.wait(base.PATIENCE), 0, self.view.said())
        self.assertNotIn("validation:", self.view.said())


if __name__ == "__main__":
    base.main()
