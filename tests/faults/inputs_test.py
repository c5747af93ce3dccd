#!/usr/bin/env python3
"""Every command with each file that it reads as its output, by other names: refused with TG5004, and nothing of the user's is changed.

usage: inputs_test.py TEGUMENT REPOSITORY
"""

import json
import os
import shutil
import struct
import sys
import unittest
import zlib

import harness

EFFECT = """#include "shade.fxh"
float4x4 gWvp : WORLDVIEWPROJECTION;
Texture2D gMap < string UIName = "Map"; >;
Texture2D gSkinMap < string ResourceName = "own.png"; >;
SamplerState gSampler { Filter = MIN_MAG_MIP_LINEAR; };
float gGrey = 0.5;
float4 VS(float4 p : POSITION, float2 uv : TEXCOORD0, out float2 to : TEXCOORD0) : SV_Position { to = uv; return mul(p, gWvp); }
float4 PS(float4 p : SV_Position, float2 uv : TEXCOORD0) : SV_Target0 { return shade(gGrey) + gMap.Sample(gSampler, uv) + gSkinMap.Sample(gSampler, uv); }
technique10 T { pass P { SetVertexShader(CompileShader(vs_4_0, VS())); SetPixelShader(CompileShader(ps_4_0, PS())); } }
"""


def png(width, height, grey):
    """A picture, as another program writes it."""
    rows = b"".join(b"\0" + bytes(v for x in range(width) for v in (grey, x * 8 % 256, y * 8 % 256)) for y in range(height))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(rows)) + \
        chunk(b"IEND", b"")


def triangle_gltf():
    """A quad that names a buffer and a picture beside it."""
    positions = struct.pack("<12f", 0, 0, 0, .1, 0, 0, .1, .1, 0, 0, .1, 0)
    uvs = struct.pack("<8f", 0, 1, 1, 1, 1, 0, 0, 0)
    indices = struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    views = [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 32},
             {"buffer": 0, "byteOffset": 80, "byteLength": 12}]
    accessors = [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [.1, .1, 0]},
                 {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
                 {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}]
    return {"asset": {"version": "2.0"}, "buffers": [{"uri": "quad.bin", "byteLength": 92}], "bufferViews": views, "accessors": accessors,
            "images": [{"uri": "quad.png"}], "textures": [{"source": 0}],
            "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
            "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0}, positions + uvs + indices


class Inputs(harness.Faults):
    def setUp(self):
        super().setUp()
        self.user = self.folder / "user"
        self.user.mkdir()
        gltf, buffer = triangle_gltf()
        ball = "mtllib ball.mtl\nusemtl skin\n" + harness.ball(8)
        scene = {"mesh": "ball.obj", "textures": {"gSkinMap": "scene.png"},
                 "camera": {"position": [0, 0, 400], "horizontal_fov": 40, "near": 100, "far": 900}, "light": {"position": [300, 300, 900]}}
        for name, content in {
                "own.fx": EFFECT, "shade.fxh": "float shade(float grey) { return grey; }\n",
                "own.presets.json": json.dumps({"pale": {"parameters": {"gGrey": 0.9}}}),
                "ball.obj": ball, "bent.obj": ball.replace("v 0.000000", "v 1.000000"),
                "ball.mtl": "newmtl skin\nmap_Kd head.png\n", "scene.json": json.dumps(scene), "quad.gltf": json.dumps(gltf), "quad.bin": buffer,
                "list.txt": "ball.obj\n",
                **{f"{name}.png": png(32, 32, i) for i, name in enumerate(("own", "head", "scene", "map", "quad", "a", "b", "density"))}}.items():
            (self.user / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        self.run_here("fur", "roots", "ball.obj", "--count", "200", "-o", "roots.dds")
        self.run_here("batch", "--list", "list.txt", "--results", "done", "--", "prep", "{}", "--dry-run", "--json")
        record = next((self.user / "done/records").glob("*.json"))
        self.record = record.relative_to(self.user)

    def run_here(self, *arguments):
        ran = self.run_it(*arguments, cwd=self.user)
        self.assertEqual(ran.returncode, 0, f"{arguments}: {ran.stdout}{ran.stderr}")

    def start(self, *arguments, **more):
        import subprocess
        more.pop("environment", None)
        return subprocess.Popen([harness.PROGRAM, *map(str, arguments)], cwd=self.user, env=self.environment, text=True, errors="replace",
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL)

    def table(self):
        """(command with {OUT}, ending of the output, inputs)"""
        obj = ("ball.obj", "ball.mtl", "head.png")
        gltf = ("quad.gltf", "quad.bin", "quad.png")
        draw = ("render", "own.fx", "--size", "16", "--compiler", "glslang")
        scene = (*draw, "-w", "scene.json", "-p", "pale", "--set", "gMap=map.png")
        rows = [((*scene, "-o", "{OUT}"), ending, ("own.fx", "shade.fxh", "own.presets.json", "scene.json", "ball.obj", "scene.png", "map.png"))
                for ending in (".png", ".jpg", ".exr", ".dds")]
        rows += [
            ((*draw, "-m", "ball.obj", "-o", "{OUT}"), ".png", (*obj, "own.png")),
            ((*draw, "-m", "quad.gltf", "-o", "{OUT}"), ".png", gltf),
            ((*scene, "--turntable", "2", "-o", "turn.png"), "turn-002.png", ("scene.json", "map.png")),
            ((*scene, "--turntable", "2", "-o", "{OUT}"), ".webp", ("scene.json", "map.png")),
            (("render", "FurCoat", "-m", "ball.obj", "--pose", "bent.obj", "--size", "16", "-o", "{OUT}"), ".png", ("ball.obj", "bent.obj")),
            (("prep", "ball.obj", "-o", "{OUT}"), ".glb", obj),
            (("prep", "ball.obj", "-o", "{OUT}"), ".ply", obj),
            (("prep", "ball.obj", "--dry-run", "--report", "{OUT}"), ".json", obj),
            (("prep", "ball.obj", "--dry-run", "--html", "{OUT}"), ".html", obj),
            (("prep", "quad.gltf", "-o", "{OUT}"), ".glb", gltf),
            (("prep", "links", "ball.obj", "-o", "{OUT}"), ".dds", obj),
            (("prep", "links", "ball.obj", "-o", "links.dds"), "links.json", obj),
            (("prep", "occlusion", "ball.obj", "--size", "8", "--rays", "1", "-o", "{OUT}"), ".dds", obj),
            (("prep", "environment", "room.exr", "-o", "{OUT}"), ".dds", ("room.exr",)),
            (("fur", "roots", "ball.obj", "--count", "20", "--density-map", "density.png", "-o", "{OUT}"), ".dds", ("ball.obj", "density.png")),
            (("fur", "roots", "ball.obj", "--count", "20", "-o", "new.dds"), "new.json", ("ball.obj",)),
            (("fur", "strands", "ball.obj", "--roots", "roots.dds", "-o", "{OUT}"), ".glb", ("ball.obj", "roots.dds")),
            (("fur", "pose", "ball.obj", "bent.obj", "--roots", "roots.dds", "-o", "{OUT}"), ".dds", ("ball.obj", "bent.obj", "roots.dds")),
            (("fur", "pose", "ball.obj", "bent.obj", "--roots", "roots.dds", "-o", "new.dds", "--seats", "{OUT}"), ".dds",
             ("bent.obj", "roots.dds")),
            (("sheet", "a.png", "b.png", "-o", "{OUT}"), ".png", ("a.png", "b.png")),
            (("sheet", "a.png", "b.png", "--column-labels", "a,b", "--columns", "2", "--font", "font.ttf", "-o", "{OUT}"), ".jpg", ("b.png", "font.ttf")),
            (("compare", "a.png", "b.png", "-o", "{OUT}"), ".png", ("a.png", "b.png")),
            (("flatten", "own.fx", "-o", "{OUT}"), ".fx", ("own.fx", "shade.fxh")),
            (("check", "own.fx", "--target", "spirv-glslang", "--html", "{OUT}"), ".html", ("own.fx", "shade.fxh")),
            (("check", "own.fx", "--target", "spirv-glslang", "--against", "a.json", "--html", "{OUT}"), ".html", ("a.json",)),
            (("batch", "--results", "done", "--report", "{OUT}"), ".html", (self.record,)),
            (("batch", "--list", "list.txt", "--results", "new", "--report", "{OUT}", "--", "prep", "{}", "--dry-run"), ".html", ("list.txt",)),
        ]
        return rows

    def prepare_more(self):
        self.run_here("render", "Beckmann", "--size", "64x32", "-o", "room.exr")
        fonts = [folder for folder in ("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",) if os.path.exists(folder)]
        if fonts:
            shutil.copy(fonts[0], self.user / "font.ttf")
        ran = self.run_it("check", "own.fx", "--target", "spirv-glslang", "--json")
        self.assertEqual(ran.returncode, 0, ran.stdout + ran.stderr)
        (self.user / "a.json").write_text(ran.stdout, encoding="utf-8")

    def contents(self):
        return {file: file.read_bytes() for file in self.user.rglob("*") if file.is_file() and not file.is_symlink()}

    def refuses(self, command, ending, name, make):
        """`make` gives the output's name to the input."""
        out = self.user / (ending if not ending.startswith(".") else "x" + ending)
        make(self.user / name, out)
        before = self.contents()
        ran = self.run_it(*(word.replace("{OUT}", out.name) for word in command))
        after = self.contents()
        wrong = []
        if after != before:
            wrong.append("changed " + ", ".join(str(file.relative_to(self.user)) for file in after.keys() | before.keys()
                                                if after.get(file) != before.get(file)))
        if ran.returncode != 2 or ran.stderr.count("error TG5004") != 1:
            wrong.append(f"code {ran.returncode}: {ran.stderr.strip()[:300]}")
        out.unlink(missing_ok=True)
        for file, content in before.items():
            if file != out and (not file.exists() or file.read_bytes() != content):
                file.write_bytes(content)
        for file in set(after) - set(before):
            file.unlink(missing_ok=True)
        return wrong

    def test_every_command_with_each_of_its_inputs_as_the_output(self):
        self.prepare_more()
        ways = (lambda file, out: out.symlink_to(file), lambda file, out: os.link(file, out))
        tried, failures = 0, []
        for command, ending, inputs in self.table():
            for name in inputs:
                if not (self.user / name).exists():
                    continue
                for way in ways:
                    tried += 1
                    failures += [f"{' '.join(map(str, command))} over {name}: {wrong}" for wrong in self.refuses(command, ending, name, way)]
        print(f"[cases] {tried} outputs that are inputs tried, {len(failures)} not refused as they should be", flush=True)
        self.assertGreater(tried, 120)
        self.assertEqual(failures, [], "\n".join(failures))

    def test_by_its_own_name_and_round_about(self):
        for name in ("a.png", "../user/a.png", str(self.user / "a.png")):
            before = self.contents()
            self.refused(self.run_it("sheet", "a.png", "b.png", "-o", name), "TG5004", "read by this command", code=2)
            self.assertEqual(self.contents(), before)

    def test_a_folder_that_holds_the_effect_is_not_replaced(self):
        self.run_here("check", "own.fx", "--target", "spirv-glslang", "--emit", "emitted", "--emit-kind", "spirv-glslang")
        inside = next((self.user / "emitted").rglob("manifest.json")).parent
        for name in ("own.fx", "shade.fxh", "own.png"):
            shutil.copy(self.user / name, inside / name)
        before = self.contents()
        self.refused(self.run_it("check", inside.relative_to(self.user) / "own.fx", "--target", "spirv-glslang", "--emit", "emitted",
                                 "--emit-kind", "spirv-glslang"), "TG5004", code=2)
        self.assertEqual(self.contents(), before)

    def test_a_picture_of_another_program_is_warned_of_and_one_of_ours_is_not(self):
        for ending in (".png", ".jpg", ".exr", ".dds"):
            out = self.user / f"new{ending}"
            out.write_bytes(png(4, 4, 7))
            command = ("render", "Beckmann", "--size", "16", "-o", out.name)
            for expected in (1, 0):
                ran = self.run_it(*command)
                self.assertEqual((ran.returncode, ran.stderr.count("warning TG8028")), (0, expected), ran.stderr)
        for ending in (".glb", ".ply"):
            (self.user / f"new{ending}").write_bytes(b"something dear")
            for expected in (1, 0):
                ran = self.run_it("prep", "ball.obj", "-o", f"new{ending}")
                self.assertEqual((ran.returncode, ran.stderr.count("warning TG8028")), (0, expected), ran.stderr)
        for command, out in ((("sheet", "a.png", "b.png"), "new_sheet.png"), (("compare", "a.png", "b.png"), "new_difference.png")):
            self.run_here(*command, "-o", out)
            self.assertNotIn("TG8028", self.run_it(*command, "-o", out).stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
