#!/usr/bin/env python3
"""Effects of another host in tegument view: shown, edited, and bound by hand. By real input events under Xvfb.

usage: foreign_test.py PROGRAM REPOSITORY [PICTURES]      with PICTURES the screen of every step is kept there
Exit code 77: this machine lacks Xvfb, python3-xlib or a Vulkan driver that draws to windows.
"""

import shlex
import shutil
import subprocess
import unittest

import screen as screens
import session as base

FOREIGN = """float4x4 wvp : WORLDVIEWPROJECTION;
float4 tint = { 1, 0, 0, 1 };
float4 VS(float4 p : POSITION) : POSITION { return mul(p, wvp); }
float4 PS() : COLOR { return tint; }
float4 Other() : COLOR { return float4(0, 1, 0, 1); }
technique Red { pass { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }
technique Green { pass { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 Other(); } }
"""


UNBOUND = """float4x4 wvp : WORLDVIEWPROJECTION;
float4 strange;
texture pic;
sampler s = sampler_state { Texture = <pic>; };
void VS(float4 p : POSITION, float2 t : TEXCOORD0, out float4 o : POSITION, out float2 u : TEXCOORD0) { o = mul(p, wvp); u = t; }
float4 PS(float2 u : TEXCOORD0) : COLOR { return tex2D(s, 4 * u) * strange; }
technique T { pass { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }
"""


class BoundByHand(unittest.TestCase):
    def test_a_value_and_a_picture_are_chosen_from_a_list_and_render_draws_the_same(self):
        view = base.View(("unbound.fx",), (("unbound.fx", UNBOUND),))
        try:
            view.title("unbound.fx T [")
            view.screen.press("i")
            black = view.still()
            middle = (base.SIZE // 2 * black.width + base.SIZE // 2) * 3
            self.assertEqual(tuple(black.pixels[middle:middle + 3]), (0, 0, 0), "nothing is known of 'strange'")
            view.screen.press("b")
            table = base.keep(view.still(unlike=black), "bind_1_table")
            view.click("bind/strange")
            listed = base.keep(view.still(unlike=table), "bind_2_list")
            view.click("bind/strange=COLOR")
            squares = base.keep(view.still(unlike=listed), "bind_3_checker")
            view.click("bind/pic")
            listed = view.still(unlike=squares)
            view.click("bind/pic=white")
            white = base.keep(view.still(unlike=listed), "bind_4_white")
            view.screen.press("b")
            shown = view.still(unlike=white)
            view.screen.press("c")
            view.wait("the line", lambda: "copied: " in view.said())
            line = view.screen.clipboard()
            self.assertIn("--bind pic=white --bind strange=COLOR", line)
            self.assertEqual(tuple(shown.pixels[middle:middle + 3]), (255, 255, 255))
            ran = subprocess.run([base.PROGRAM] + shlex.split(line)[1:], cwd=view.folder, capture_output=True, text=True, timeout=base.PATIENCE)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            drawn = screens.read_png(view.folder / "out" / "unbound-001.png")
            self.assertEqual(drawn.width, base.SIZE)
            part = screens.Picture(base.SIZE, base.SIZE, b"".join(shown.pixels[y * shown.width * 3:(y * shown.width + base.SIZE) * 3] for y in range(base.SIZE)))
            self.assertLess(drawn.share_apart(part, limit=2), 0.02)  # of the edge: render takes several samples a pixel there
            self.assertNotIn("validation:", view.said())
        finally:
            view.end()
            shutil.rmtree(view.folder)


class ForeignWindow(unittest.TestCase):
    """An effect of Direct3D 9, on the ball that stands in for a mesh."""

    @classmethod
    def setUpClass(cls):
        cls.view = base.View(("foreign.fx",), (("foreign.fx", FOREIGN),))
        cls.view.title("foreign.fx Red [")
        cls.view.screen.press("i")
        cls.first = cls.view.still()

    @classmethod
    def tearDownClass(cls):
        cls.view.end()
        shutil.rmtree(cls.view.folder)

    def middle(self, picture):
        at = (base.SIZE // 2 * picture.width + base.SIZE // 2) * 3
        return tuple(picture.pixels[at:at + 3])

    def test_is_shown_in_its_own_colours(self):
        self.assertEqual(self.middle(self.first), (255, 0, 0))

    def test_b_tells_what_each_parameter_got(self):
        self.view.screen.press("b")
        over = self.view.still(unlike=self.first)
        base.keep(over, "key_b")
        self.view.screen.press("b")
        self.assertEqual(self.view.still(unlike=over), self.first)

    def test_t_shows_its_next_technique(self):
        self.view.screen.press("t")
        self.view.title("foreign.fx Green [")
        self.assertEqual(self.middle(self.view.still(unlike=self.first)), (0, 255, 0))
        self.view.screen.press("T")
        self.view.title("foreign.fx Red [")
        self.assertEqual(self.view.still(), self.first)

    def test_an_edit_is_seen_and_a_broken_one_keeps_the_picture(self):
        source = self.view.folder / "foreign.fx"
        source.write_text(FOREIGN.replace("{ 1, 0, 0, 1 }", "{ 0, 0, 1, 1 }"))
        blue = self.view.still(unlike=self.first)
        self.assertEqual(self.middle(blue), (0, 0, 255))
        source.write_text(FOREIGN.replace("return tint;", "return nowhere;"))
        self.view.title("error TG3001")
        self.assertIn("foreign.fx(4,", self.view.said())
        source.write_text(FOREIGN)
        self.view.title("foreign.fx Red [")
        self.assertEqual(self.view.still(unlike=blue), self.first)


if __name__ == "__main__":
    base.main()
