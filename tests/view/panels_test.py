#!/usr/bin/env python3
"""Panels of times, of the mesh and of textures, and a target's mip levels, in tegument view. By real input events under Xvfb.

usage: panels_test.py PROGRAM REPOSITORY [PICTURES]      with PICTURES the screen of every step is kept there
Exit code 77: this machine lacks Xvfb, python3-xlib or a Vulkan driver that draws to windows.
"""

import struct
import unittest

import session as base

WIDE, HIGH = 2 * base.SIZE, base.SIZE

# Columns of 0 and 1, one texel wide: on every other level all texels are 1/2.
STRIPES = """#include "hlsl/platform.fxh"
Texture2D gStripesMap : RENDERCOLORTARGET < int Width = 32; int Height = 32; int MipLevels = 0; string Format = "A32B32G32R32F"; >;
TG_SAMPLER2D(gStripes, POINT, CLAMP);
struct In { float3 position : POSITION; float2 uv : TEXCOORD0; };
struct Out { float4 position : SV_Position; float2 uv : TEXCOORD0; };
Out QuadVS(In input) { Out output; output.position = float4(input.position, 1.0); output.uv = input.uv; return output; }
float4 StripesPS(Out input) : SV_Target0 { float odd = fmod(floor(input.position.x), 2.0); return float4(odd, odd, odd, 1.0); }
float4 ShowPS(Out input) : SV_Target0 { return gStripesMap.SampleLevel(gStripes, input.uv, 1.0); }
#ifdef FX_TECHNIQUES
technique Stripes < string Script = "RenderColorTarget0=gStripesMap; Pass=Draw; RenderColorTarget0=; Pass=Show;"; >
{
    pass Draw < string Script = "Draw=Buffer;"; > { VertexShader = compile TG_VS_MODEL QuadVS(); PixelShader = compile TG_PS_MODEL StripesPS(); TG_STATE_BUFFER; }
    pass Show < string Script = "Draw=Buffer;"; > { VertexShader = compile TG_VS_MODEL QuadVS(); PixelShader = compile TG_PS_MODEL ShowPS(); TG_STATE_BUFFER; }
}
#endif
"""


# What has roots made for its mesh, and shows its texture coordinates.
ROOTS = """#include "hlsl/platform.fxh"
float4x4 gWorldViewProjection : WORLDVIEWPROJECTION;
Texture2D gRootsMap < string Generator = "fur roots"; >;
TG_SAMPLER2D(gRoots, POINT, CLAMP);
struct In { float3 position : POSITION; float2 uv : TEXCOORD0; };
struct Out { float4 position : SV_Position; float2 uv : TEXCOORD0; };
Out RootsVS(In input) { Out output; output.position = mul(float4(input.position, 1.0), gWorldViewProjection); output.uv = input.uv; return output; }
float4 RootsPS(Out input) : SV_Target0 { return float4(input.uv, 0.5 + 1e-9 * gRootsMap.SampleLevel(gRoots, float2(0.0, 0.0), 0.0).w, 1.0); }
#ifdef FX_TECHNIQUES
technique Roots
{ pass Draw { VertexShader = compile TG_VS_MODEL RootsVS(); PixelShader = compile TG_PS_MODEL RootsPS(); TG_STATE_SOLID; } }
#endif
"""


class Panels(base.WideWindow):
    def press(self, key, unlike, name):
        self.view.screen.press(key)
        return base.keep(self.view.still(unlike=unlike), name)

    def coloured(self, picture):
        """Pixels of strong colours beside the picture: bars."""
        sheet = self.view.crop(picture, "sheets")
        texels = (sheet.pixels[i:i + 3] for i in range(0, len(sheet.pixels), 3))
        return sum(max(texel) > 150 and max(texel) - min(texel) > 80 for texel in texels)

    def test_g_shows_times_as_bars_and_what_was_not_drawn_is_dim(self):
        times = self.press("g", self.start, "key_g")
        self.view.screen.press("F5")  # all is drawn
        anew = base.keep(self.view.still(unlike=times), "key_g_anew")
        self.assertGreater(self.coloured(anew), 300)
        self.view.screen.drag((450, 160), (490, 150))
        camera = base.keep(self.view.still(unlike=anew), "key_g_camera")
        self.assertLess(self.coloured(camera), self.coloured(anew), "the rows of passes that the camera does not touch")
        self.press("k", camera, "key_g_two_sides")
        self.view.screen.press("k")
        self.view.still()
        self.view.screen.press("r")
        self.view.still()
        self.view.screen.press("g")
        self.assertEqual(self.view.still(), self.start)

    def test_u_shows_the_mesh_in_false_colours_that_turn_with_the_camera(self):
        last = self.start
        for name in ("texels", "stretch", "seams"):
            picture = self.press("u", last, f"key_u_{name}")
            self.assertGreater(picture.share_apart(self.start), 0.1)
            last = picture
        amber = lambda p: sum(p.pixels[i] > 220 and 90 < p.pixels[i + 1] < 140 and p.pixels[i + 2] < 60 for i in range(0, len(p.pixels), 3))
        self.view.screen.drag((420, 160), (560, 160))  # the ball's two charts meet at its side
        turned = base.keep(self.view.still(unlike=last), "key_u_seams_turned")
        self.assertGreater(amber(turned), 150, "the seam")
        self.view.screen.press("r")
        self.view.still(unlike=turned)
        self.view.screen.press("u")
        self.assertEqual(self.view.still(unlike=last), self.start)

    def test_o_tells_where_textures_come_from_and_a_click_opens_one(self):
        listed = self.press("o", self.start, "key_o")
        self.view.click("texture/gEnergyAttenuationMap")
        self.view.title("texture gEnergyAttenuationMap")
        opened = base.keep(self.view.still(unlike=listed), "key_o_opened")
        self.assertGreater(opened.share_apart(listed), 0.1)
        self.view.screen.press("o")
        self.assertEqual(self.view.start_again(), self.start)


class Fur(base.WideWindow):
    ARGUMENTS = ("roots.fx", "-w", "ball.json")
    FILES = (("roots.fx", ROOTS),)
    TITLE = "roots.fx Roots"

    def test_u_shows_the_density_of_fur_behind_the_others(self):
        last = self.start
        for name in ("texels", "stretch", "seams", "fur"):
            self.view.screen.press("u")
            last = base.keep(self.view.still(unlike=last), f"key_u_{name}_of_fur")
        seen = self.view.crop(last, "picture").pixels
        colours = [seen[i:i + 3] for i in range(0, len(seen), 3)]
        pale = sum(min(colour) > 120 and max(colour) - min(colour) < 60 for colour in colours)
        self.assertGreater(pale, 2000, "the ball is grown evenly: colours about the median")
        self.view.screen.press("u")
        self.assertEqual(self.view.still(unlike=last), self.start)

    def test_a_texture_made_from_the_mesh_is_made_again_by_a_click(self):
        self.view.screen.press("o")
        listed = base.keep(self.view.still(unlike=self.start), "key_o_roots")
        made = self.view.said().count("made fur roots")
        self.view.click("bake/gRootsMap")
        self.view.wait("the roots", lambda: self.view.said().count("made fur roots") > made)
        base.keep(self.view.still(unlike=listed), "key_o_roots_again")
        self.view.screen.press("o")
        self.assertEqual(self.view.still(), self.start)


CUBE = """#include "hlsl/platform.fxh"
float4x4 gWorldViewProjection : WORLDVIEWPROJECTION;
TextureCube gCubeMap < string Generator = "studio"; >;
TG_SAMPLERCUBE(gCube, LINEAR);
struct In { float3 position : POSITION; float3 normal : NORMAL; };
struct Out { float4 position : SV_Position; float3 normal : TEXCOORD0; };
Out CubeVS(In input) { Out output; output.position = mul(float4(input.position, 1.0), gWorldViewProjection); output.normal = input.normal; return output; }
float4 CubePS(Out input) : SV_Target0 { return gCubeMap.SampleLevel(gCube, input.normal, 0.0); }
#ifdef FX_TECHNIQUES
technique Cube
{ pass Draw { VertexShader = compile TG_VS_MODEL CubeVS(); PixelShader = compile TG_PS_MODEL CubePS(); TG_STATE_SOLID; } }
#endif
"""


class Faces(base.WideWindow):
    ARGUMENTS = ("cube.fx", "-w", "ball.json")
    FILES = (("cube.fx", CUBE),)
    TITLE = "cube.fx Cube"

    def test_a_cube_is_opened_as_a_cross_of_its_faces(self):
        self.view.screen.press("o")
        listed = base.keep(self.view.still(unlike=self.start), "key_o_cube")
        self.view.click("texture/gCubeMap")
        self.view.title("texture gCubeMap")
        self.view.screen.press("o")
        cross = base.keep(self.view.still(unlike=listed), "cube_faces")
        # 4 by 3 faces, as high as the window: +Y, -Y above and below the second, and nothing else in those rows.
        side, left = base.SIZE // 3, (2 * base.SIZE - base.SIZE * 4 // 3) // 2
        lit = {(x, y): sum(cross.pixels[(v * cross.width + u) * 3] > 20 for v in range(y * side + 2, y * side + side - 2)
                           for u in range(left + x * side + 2, left + x * side + side - 2)) for x in range(4) for y in range(3)}
        self.assertEqual([lit[x, y] for x in (0, 2, 3) for y in (0, 2)], [0] * 6)
        self.assertGreater(sum(lit[x, 1] for x in range(4)), 500, "the studio's lamps")
        self.assertGreater(lit[1, 0], 50, "and one above")
        self.view.screen.press("Escape")
        self.assertEqual(self.view.still(unlike=cross), self.start)


def limits(view, picture):
    """The numbers below a spread."""
    return [view.crop(picture, f"sheets/{which}").pixels for which in ("low", "high")]


def cube_dds(*faces):
    """Six faces of 4 x 4 texels of one value each, as floats."""
    header = struct.pack("<7I", 124, 0x100F, 4, 4, 64, 0, 1) + bytes(44) + struct.pack("<8I", 32, 4, 114, 32, 0, 0, 0, 0)  # D3DFMT_R32F
    header += struct.pack("<5I", 0x1008, 0xFE00, 0, 0, 0)
    return b"DDS " + header + b"".join(struct.pack("<16f", *[face] * 16) for face in faces)


class OtherFaces(base.WideWindow):
    ARGUMENTS = ("cube.fx", "-w", "ball.json")
    FILES = (("cube.fx", CUBE.replace('Generator = "studio"', 'ResourceName = "cube.dds"')),)
    TITLE = "cube.fx Cube"

    @classmethod
    def before(cls, folder):
        (folder / "cube.dds").write_bytes(cube_dds(0.5, 0.5, 0.5, 0.5, 0.5, 0.5))

    def test_the_spread_is_that_of_all_faces(self):
        screen = self.view.screen
        screen.press("o")
        listed = self.view.still(unlike=self.start)
        self.view.click("texture/gCubeMap")
        self.view.title("texture gCubeMap")
        screen.press("o")
        cross = self.view.still(unlike=listed)
        screen.press("x")
        same = base.keep(self.view.still(unlike=cross), "faces_alike")
        (self.view.folder / "cube.dds").write_bytes(cube_dds(0.5, 0.5, 0.5, 0.5, 0.5, 3.0))
        screen.press("F5")
        other = base.keep(self.view.still(unlike=same), "one_face_brighter")
        self.assertNotEqual(self.view.crop(other, "sheets").pixels, self.view.crop(same, "sheets").pixels)


class Levels(unittest.TestCase):
    def test_l_goes_through_the_mip_levels_and_back(self):
        view = base.View(("stripes.fx",), (("stripes.fx", STRIPES),))
        self.addCleanup(view.end)
        view.title("stripes.fx Stripes")
        view.screen.press("i")
        view.still()
        view.screen.press("Down")
        view.title("target gStripesMap")
        first = base.keep(view.still(), "level_0")
        self.assertEqual(view.screen.title().split(",")[0], "stripes.fx Stripes [] target gStripesMap")
        greys = lambda p: set(p.pixels[(p.height // 2 * p.width + 16) * 3:(p.height // 2 * p.width + base.SIZE - 16) * 3])
        self.assertEqual(len(greys(first)), 2, "columns")
        self.assertGreater(max(greys(first)) - min(greys(first)), 200)
        view.screen.press("l")
        second = base.keep(view.still(unlike=first), "level_1")
        view.screen.press("x")  # of level 2, whose texels are all 0.5, too; and of level 0, where what is not 0 is 1
        view.screen.press("l")
        spread = base.keep(view.still(unlike=second), "level_2_spread")
        numbers = limits(view, spread)
        for _ in range(4):
            view.screen.press("l")
        self.assertNotEqual(limits(view, base.keep(view.still(unlike=spread), "level_0_spread")), numbers)
        view.screen.press("x")
        view.screen.press("l")
        self.assertEqual(view.still(), second)
        self.assertEqual(len(greys(second)), 1, "one grey")
        self.assertTrue(100 < max(greys(second)) < 200, f"half of the light, or of the spread: {greys(second)}")
        for _ in range(5):  # 32 texels have six levels
            view.screen.press("l")
        self.assertEqual(view.still(unlike=second), first)
        self.assertNotIn("validation:", view.said())


if __name__ == "__main__":
    base.main()
