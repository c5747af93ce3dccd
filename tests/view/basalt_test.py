#!/usr/bin/env python3
"""ReShade's effects by a second compiler: vkBasalt draws them over the window of tegument view, as it does over any Vulkan program, and
`tegument render --picture-in` over a picture of the same window. By real frames under Xvfb.

usage: basalt_test.py PROGRAM REPOSITORY [PICTURES]
Exit code 77: this machine lacks Xvfb, python3-xlib, a Vulkan driver that draws to windows, or vkBasalt (Debian package vkbasalt).
"""

import os
import pathlib
import shutil
import subprocess
import sys
import unittest

import screen as screens
import session as base

LAYER = pathlib.Path("/usr/share/vulkan/implicit_layer.d/vkBasalt.json")
HEAD = """
texture BackBufferTex : COLOR;
sampler BackBuffer { Texture = BackBufferTex; };
void PostVS(in uint id : SV_VertexID, out float4 p : SV_Position, out float2 uv : TEXCOORD)
{
    uv.x = (id == 2) ? 2.0 : 0.0;
    uv.y = (id == 1) ? 2.0 : 0.0;
    p = float4(uv * float2(2.0, -2.0) + float2(-1.0, 1.0), 0.0, 1.0);
}
"""
EFFECTS = {
    "mixed": HEAD + """
namespace Mixed { static const float3x3 kMix = float3x3(0.1, 0.8, 0.1, 0.6, 0.2, 0.2, 0.3, 0.3, 0.4); float3 mixed(float3 c) { return mul(kMix, c); } }
float4 PS(float4 p : SV_Position, float2 uv : TEXCOORD) : SV_Target { return float4(1.0 - Mixed::mixed(tex2D(BackBuffer, uv).rgb), 1.0); }
technique Mix { pass { VertexShader = PostVS; PixelShader = PS; } }
""",
    "spread": HEAD + """
uniform float Width < ui_type = "slider"; ui_min = 0.0; ui_max = 8.0; > = 3.0;
float4 PS(float4 p : SV_Position, float2 uv : TEXCOORD) : SV_Target
{
    float3 sum = 0.0;
    [unroll] for (int i = -4; i <= 4; i++)
        sum += tex2D(BackBuffer, uv + float2(i * Width, 0.5 * i) * float2(BUFFER_RCP_WIDTH, BUFFER_RCP_HEIGHT)).rgb / 9.0;
    return float4(sum, 1.0);
}
technique Spread { pass { VertexShader = PostVS; PixelShader = PS; } }
""",
    "two_passes": HEAD + """
texture Half { Width = BUFFER_WIDTH / 2; Height = BUFFER_HEIGHT / 2; Format = RGBA16F; };
sampler Halved { Texture = Half; };
float4 Down(float4 p : SV_Position, float2 uv : TEXCOORD) : SV_Target { return tex2D(BackBuffer, uv) * tex2D(BackBuffer, uv).g; }
float4 Up(float4 p : SV_Position, float2 uv : TEXCOORD) : SV_Target
{
    float3 c = tex2D(BackBuffer, uv).rgb, glow = tex2D(Halved, uv).rgb;
    return float4(p.y < BUFFER_HEIGHT * 0.5 ? saturate(c + 0.5 * glow) : abs(c - glow), 1.0);
}
technique Glow { pass { VertexShader = PostVS; PixelShader = Down; RenderTarget = Half; } pass { VertexShader = PostVS; PixelShader = Up; } }
""",
}


class SecondCompiler(unittest.TestCase):
    def shown(self, **environment):
        """The window at rest, as a program that loads Vulkan's layers by these variables shows it."""
        before = dict(os.environ)
        os.environ.update(environment)
        try:
            view = base.View(screen=(base.SIZE, base.SIZE))
        finally:
            os.environ.clear()
            os.environ.update(before)
        try:
            view.title("Main.fx")
            return view.still()
        finally:
            view.end()
            shutil.rmtree(view.folder)

    def test_draws_what_render_draws_over_the_same_picture(self):
        folder = base.own_copy()
        self.addCleanup(shutil.rmtree, folder)
        plain = base.keep(self.shown(), "basalt_plain")
        plain.save(folder / "plain.png")
        for name, text in EFFECTS.items():
            with self.subTest(name):
                (folder / f"{name}.fx").write_text(text)
                (folder / "basalt.conf").write_text(f"effects = {name}\n{name} = {folder}/{name}.fx\nreshadeTexturePath = {folder}\n"
                                                    f"reshadeIncludePath = {folder}\nenableOnLaunch = True\n")
                theirs = base.keep(self.shown(ENABLE_VKBASALT="1", VKBASALT_CONFIG_FILE=str(folder / "basalt.conf")), f"basalt_{name}_theirs")
                self.assertGreater(theirs.share_apart(plain), 0.1, "vkBasalt has drawn")
                ran = subprocess.run([base.PROGRAM, "render", folder / f"{name}.fx", "--picture-in", folder / "plain.png", "--size",
                                      f"{plain.width}x{plain.height}", "--samples", "1", "-o", folder / f"{name}.png"], capture_output=True, text=True)
                self.assertEqual(ran.returncode, 0, ran.stderr)
                ours = base.keep(screens.read_png(folder / f"{name}.png"), f"basalt_{name}_ours")
                # A step for the rounding of each of the two, and one for where a look-up falls between texels.
                self.assertLess(ours.share_apart(theirs, limit=3), 0.001)


if __name__ == "__main__":
    if not LAYER.exists():
        print(f"skipped: {LAYER} is not there (Debian package vkbasalt)")
        sys.exit(base.SKIPPED)
    base.main()
