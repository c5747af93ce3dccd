#!/usr/bin/env python3
"""What an effect or a mesh of a stranger can make the program read: its own folder and project, the folders of -I, and nothing else unless the
user says so. Each way out is tried; each is refused with one message, whose hint works. usage: confine_test.py TEGUMENT REPOSITORY [microsoft]
"""

import json
import os
import pathlib
import re
import struct
import sys

from harness import Faults, main
from limits_test import png

SECRET = "kept from strangers"
SHADERS = """
float4 VS(float4 p : POSITION) : SV_Position { return p; }
float4 PS() : SV_Target0 { return 1; }
"""
TECHNIQUE = """
#ifndef FX_ENTRY
technique11 T { pass P { SetVertexShader(CompileShader(vs_5_0, VS())); SetPixelShader(CompileShader(ps_5_0, PS())); } }
#endif
"""
TEXTURED = """
Texture2D gMap < %s >;
SamplerState gSampler { Texture = gMap; };
float4 VS(float4 p : POSITION) : SV_Position { return p; }
float4 PS() : SV_Target0 { return gMap.Sample(gSampler, float2(0.5, 0.5)); }
#ifndef FX_ENTRY
technique11 T < string Script = "Pass=P;"; > { pass P < string Script = "Draw=Buffer;"; > {
    SetVertexShader(CompileShader(vs_5_0, VS())); SetPixelShader(CompileShader(ps_5_0, PS())); } }
#endif
"""


class Confined(Faults):
    def setUp(self):
        super().setUp()
        self.project = self.folder / "project"
        self.effects = self.project / "effects"
        self.effects.mkdir(parents=True)
        (self.project / "common").mkdir()
        (self.project / "common/shared.fxh").write_text("float gShared;\n", encoding="ascii")
        self.secret = self.folder / "secret.fxh"
        self.secret.write_text(f"// {SECRET}\nfloat gSecret;\n", encoding="ascii")

    def effect(self, text, name="a.fx", folder=None):
        path = (folder or self.effects) / name
        path.write_text(text, encoding="ascii")
        return path

    def including(self, name):
        return self.effect(f'#include "{name}"\n' + SHADERS + TECHNIQUE)

    def is_outside(self, ran):
        self.refused(ran, "TG1014", "-I ", "--anywhere", code=1)
        self.assertNotIn(SECRET, ran.stdout + ran.stderr)
        return re.search(r"-I (\S+), or", ran.stderr).group(1)

    def make_project(self):
        (self.project / ".git").mkdir()


class Includes(Confined):
    def ways(self):
        """Names, by what is tried; links are made."""
        (self.effects / "link.fxh").symlink_to(self.secret)
        (self.effects / "linked").symlink_to(self.folder)
        (self.effects / "in.fxh").write_text('#include "../../secret.fxh"\n', encoding="ascii")
        (self.effects / "chain.fxh").symlink_to("link.fxh")
        return {"up": "../../secret.fxh", "down and up": "deep/../../../secret.fxh", "backslashes": "..\\\\..\\\\secret.fxh",
                "absolute": str(self.secret), "link": "link.fxh", "link to a link": "chain.fxh", "linked folder": "linked/secret.fxh",
                "through an include": "in.fxh", "absolute with dots": f"{self.effects}/../../secret.fxh", "device": "/dev/zero"}

    def test_every_way_out_is_refused_with_a_hint_that_works(self):
        self.make_project()
        (self.effects / "deep").mkdir()
        for what, name in self.ways().items():
            with self.subTest(what):
                path = self.including(name.replace("\\\\", "\\"))
                folder = self.is_outside(self.run_it("info", path))
                if what == "device":
                    continue
                self.good("info", path, "-I", self.folder if "link" in what else folder)
                self.good("info", path, "--anywhere")

    def test_names_in_macros_and_angles_are_names(self):
        for text in (f'#define WHERE "{self.secret}"\n#include WHERE\n', f"#include <{self.secret}>\n"):
            with self.subTest(text):
                self.is_outside(self.run_it("info", self.effect(text + SHADERS + TECHNIQUE)))

    def test_every_command_that_reads_effects_is_confined(self):
        self.make_project()
        path = self.including("../../secret.fxh")
        for command in (["info", path], ["check", path, "--target", "spirv-dxc"], ["flatten", path], ["render", path, "--size", "16", "-o", self.out / "x.png"]):
            with self.subTest(command[0]):
                ran = self.run_it(*command)
                self.assertEqual(ran.returncode, 1, ran.stdout + ran.stderr)
                self.assertNotIn(SECRET, ran.stdout + ran.stderr)
                self.assertIn("TG1014", ran.stdout + ran.stderr)

    def test_a_project_shares_its_files(self):
        """.git and the like, or an empty file, say how far a project reaches; without one it is what the effect names relatively."""
        path = self.including("../common/shared.fxh")
        self.good("info", path)
        for mark in (".git", ".hg", ".svn", ".tegument-root"):
            with self.subTest(mark):
                (self.effects / mark).mkdir()
                self.is_outside(self.run_it("info", path))
                (self.effects / mark).rmdir()
                (self.project / mark).mkdir()
                self.good("info", path)
                (self.project / mark).rmdir()

    def test_without_a_mark_links_and_absolute_names_lead_nowhere(self):
        self.including("../common/shared.fxh")  # the common parent is the project's folder
        ways = self.ways()
        for what in ("absolute", "link", "link to a link", "linked folder", "absolute with dots", "device"):
            with self.subTest(what):
                self.is_outside(self.run_it("info", self.including(ways[what])))

    def test_the_home_folder_is_no_project(self):
        home = self.folder / "home"
        (home / ".git").mkdir()
        (home / "shared.fxh").write_text("float gShared;\n", encoding="ascii")
        (home / "effects").mkdir()
        path = self.effect('#include "../shared.fxh"\n' + SHADERS + TECHNIQUE, folder=home / "effects")
        self.is_outside(self.run_it("info", path))

    def test_links_to_an_effect_and_within_a_project_are_followed(self):
        self.make_project()
        path = self.including("../common/shared.fxh")
        (self.effects / "common").symlink_to(self.project / "common")
        self.good("info", self.effect('#include "common/shared.fxh"\n' + SHADERS + TECHNIQUE, "within.fx"))
        beside = self.effect('#include "beside.fxh"\n' + SHADERS + TECHNIQUE, "beside.fx")
        (self.effects / "beside.fxh").write_text("float gBeside;\n", encoding="ascii")
        link = self.folder / "elsewhere"
        link.mkdir()
        (link / "beside.fxh").symlink_to(self.effects / "beside.fxh")
        (link / "beside.fx").symlink_to(beside)
        self.good("info", link / "beside.fx")
        self.good("info", path)

    def test_a_survey_reaches_as_far_as_its_folder(self):
        self.including("../common/shared.fxh")
        self.effect('#include "../../secret.fxh"\n' + SHADERS + TECHNIQUE, "b.fx")
        ran = self.good("survey", self.project, "--target", "none")
        self.assertIn("a.fx: read", ran.stdout)
        self.assertIn("b.fx: refused: TG1014", ran.stdout)

    def test_a_file_that_is_not_there_is_told_as_before(self):
        self.refused(self.run_it("info", self.including("../../nothing.fxh")), "TG1001", code=1)


class Textures(Confined):
    def setUp(self):
        super().setUp()
        for folder in (self.folder, self.project / "common", self.effects):
            (folder / "red.png").write_bytes(png(2, 2))
        (self.effects / "link.png").symlink_to(self.folder / "red.png")
        self.make_project()

    def drawn(self, annotation, *more):
        return self.run_it("render", self.effect(TEXTURED % annotation), "--size", "16", "-o", self.out / "x.png", *more)

    def test_textures_that_an_effect_names_are_confined(self):
        for name in ("../../red.png", str(self.folder / "red.png"), "link.png"):
            with self.subTest(name):
                annotation = f'string ResourceName = "{name}";'
                self.is_outside(self.drawn(annotation))
                self.assertEqual(self.drawn(annotation, "-I", self.folder).returncode, 0)
                self.assertEqual(self.drawn(annotation, "--anywhere").returncode, 0)
        for name in ("red.png", "../common/red.png"):
            with self.subTest(name):
                ran = self.drawn(f'string ResourceName = "{name}";')
                self.assertEqual(ran.returncode, 0, ran.stderr)

    def test_effects_that_draw_textures_are_confined(self):
        self.effect(SHADERS + TECHNIQUE, "other.fx", self.folder)
        self.is_outside(self.drawn('string Producer = "../../other.fx/gTarget";'))

    def test_what_the_user_names_lies_anywhere(self):
        ran = self.drawn('string ResourceName = "../../red.png";', "--set", f"gMap={self.folder / 'red.png'}")
        self.assertEqual(ran.returncode, 0, ran.stderr)
        (self.folder / "scene").mkdir()
        scene = self.folder / "scene/w.json"
        scene.write_text('{"textures": {"gMap": "../red.png"}}', encoding="ascii")
        ran = self.drawn('string ResourceName = "x.png";', "-w", scene)
        self.assertEqual(ran.returncode, 0, ran.stderr)


TRIANGLE = "v 0 0 0\nv 90 0 0\nv 0 90 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
CORNERS = struct.pack("<15f", 0, 0, 0, 0.09, 0, 0, 0, 0.09, 0, 0, 0, 1, 0, 0, 1)  # positions, texture coordinates


class Meshes(Confined):
    """What a mesh file names: buffers, or there is no mesh; pictures and libraries of materials, which are left out as where they are missing."""

    def setUp(self):
        super().setUp()
        self.meshes = self.effects  # its folder; the project's other one is common/
        for folder in (self.folder, self.project / "common", self.meshes):
            (folder / "red.png").write_bytes(png(2, 2))
            (folder / "corners.bin").write_bytes(CORNERS)
            (folder / "red.mtl").write_text("newmtl red\nmap_Kd red.png\n", encoding="ascii")
        for name in ("red.png", "corners.bin", "red.mtl"):
            (self.meshes / f"link-{name}").symlink_to(self.folder / name)
        (self.meshes / "linked").symlink_to(self.folder)

    def outside(self, name):
        """The ways out to that file."""
        return [f"../../{name}", f"./linked/project/../{name}", str(self.folder / name), f"link-{name}", f"linked/{name}", f"{self.meshes}/../../{name}"]

    def gltf(self, buffer="corners.bin", picture="red.png"):
        path = self.meshes / "mesh.gltf"
        path.write_text(json.dumps({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "buffers": [{"uri": buffer, "byteLength": 60}], "bufferViews": [{"buffer": 0, "byteLength": 60}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                          {"bufferView": 0, "byteOffset": 36, "componentType": 5126, "count": 3, "type": "VEC2"}], "images": [{"uri": picture}],
            "textures": [{"source": 0}], "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}]}), encoding="utf-8")
        return path

    def obj(self, library="red.mtl", picture="red.png"):
        path = self.meshes / "mesh.obj"
        path.write_text(f"mtllib {library}\n{TRIANGLE}usemtl red\nf 1/1 2/2 3/3\n", encoding="ascii")
        (self.meshes / "red.mtl").write_text(f"newmtl red\nmap_Kd {picture}\n", encoding="ascii")
        return path

    def commands(self, path):
        yield ["prep", path, "-o", self.out / "x.glb"]
        yield ["render", "OriginalTexture", "--mesh", path, "--no-head", "--size", "16", "-o", self.out / "x.png"]

    def left_out(self, path):
        """Each command reads the mesh, and says of the rest that it lies outside, with a hint that works."""
        for command in self.commands(path):
            ran = self.run_it(*command)
            self.assertNotIn("error TG", ran.stderr)
            self.assertIn("warning TG5328", ran.stderr)
            self.assertIn("lies outside of the mesh's folder and its project", ran.stderr)
            self.assertIn(f"touch {self.folder}/.tegument-root", ran.stderr)
            self.assertNotIn("lies outside", self.run_it(*command, "--anywhere").stderr)

    def read(self, path):
        for command in self.commands(path):
            self.assertNotIn("TG5328", self.run_it(*command).stderr)

    def test_buffers_outside_are_refused(self):
        self.make_project()
        names = self.outside("corners.bin")
        for name in [*names, names[0].replace("..", "%2e%2e"), "/dev/zero"]:
            with self.subTest(name):
                for command in self.commands(self.gltf(buffer=name)):
                    self.refused(self.run_it(*command), "TG1014", "lies outside of the mesh's folder and its project", code=1)
                    if name != "/dev/zero":
                        self.assertNotIn("TG1014", self.run_it(*command, "--anywhere").stderr)

    def test_pictures_outside_are_left_out(self):
        self.make_project()
        for name in self.outside("red.png"):
            for path in (self.gltf(picture=name), self.obj(picture=name)):
                with self.subTest(name, format=path.suffix):
                    self.left_out(path)

    def test_libraries_of_materials_outside_are_left_out(self):
        self.make_project()
        for name in [*self.outside("red.mtl"), "..\\..\\red.mtl"]:
            with self.subTest(name):
                self.left_out(self.obj(library=name))

    def test_a_project_shares_its_files_and_its_links(self):
        self.make_project()
        (self.meshes / "within.png").symlink_to(self.project / "common/red.png")
        for name in ("red.png", "../common/red.png", "within.png"):
            with self.subTest(name):
                self.read(self.gltf(picture=name))
                self.read(self.obj(picture=name))
        self.read(self.gltf(buffer="../common/corners.bin"))
        self.read(self.obj(library="../common/red.mtl"))

    def test_the_hint_makes_one_project_of_both(self):
        path = self.obj(picture="../../red.png")
        for repository in (False, True):
            with self.subTest(repository=repository):
                if repository:
                    self.make_project()
                self.left_out(path)
                (self.folder / ".tegument-root").touch()
                self.read(path)
                (self.folder / ".tegument-root").unlink()

    def test_a_link_to_a_mesh_brings_what_lies_beside_either(self):
        (self.folder / "elsewhere").mkdir()
        link = self.folder / "elsewhere/mesh.gltf"
        link.symlink_to(self.gltf(picture="../effects/red.png"))
        (self.folder / "elsewhere/corners.bin").write_bytes(CORNERS)
        (self.folder / "effects").symlink_to(self.meshes)
        self.read(link)

    def test_what_is_not_there_is_told_as_before(self):
        ran = self.run_it("prep", self.gltf(picture="../../nothing.png"), "-o", self.out / "x.glb")
        self.assertIn("TG5328", ran.stderr)
        self.assertNotIn("lies outside", ran.stderr)


class Microsoft(Confined):
    """Microsoft's compiler has a preprocessor of its own, and sees branches that the front end does not."""

    def setUp(self):
        super().setUp()
        users = pathlib.Path(os.environ.get("TEGUMENT_CACHE") or pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "tegument")
        for name in ("tools", "wine"):
            if (users / name).exists():
                (self.folder / "cache" / name).symlink_to(users / name)

    def check(self, text):
        path = self.effect("#if defined(FX_ENTRY) || defined(FX_D3D10) || defined(FX_D3D11)\n#else\n" + text + "#endif\n" + SHADERS +
                           "#ifndef FX_ENTRY\ntechnique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }\n#endif\n")
        return path, self.checked(path, "--target", "fx_2_0")

    def test_microsofts_compiler_is_confined(self):
        (self.effects / "link.fxh").symlink_to(self.secret)
        for name in ("../../secret.fxh", str(self.secret), "link.fxh"):
            with self.subTest(name):
                path, ran = self.check(f'#include "{name}"\n')
                self.assertEqual(ran.returncode, 1, ran.stdout + ran.stderr)
                self.assertIn("TG1014", ran.stdout + ran.stderr)
                self.assertNotIn(SECRET, ran.stdout + ran.stderr)
                self.good("check", path, "--target", "fx_2_0", "--anywhere")
        self.make_project()
        self.assertEqual(self.check('#include "../common/shared.fxh"\n')[1].returncode, 0)

    def test_a_line_of_another_file_is_not_shown(self):
        """`#line` names any file as the place of an error; its text is not quoted."""
        _, ran = self.check(f'#line 1 "{self.secret}"\nthis is no HLSL\n')
        self.assertEqual(ran.returncode, 1, ran.stdout + ran.stderr)
        self.assertIn("TG3101", ran.stdout + ran.stderr)
        self.assertNotIn(SECRET, ran.stdout + ran.stderr)


if __name__ == "__main__":
    if sys.argv[3:] == ["microsoft"]:
        del Includes, Textures, Meshes
    else:
        del Microsoft
    main()
