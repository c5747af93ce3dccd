"""The folder for Windows under Wine, beside this system's program: windows_test.py PROGRAM FOLDER. Ends with 77 where the folder or Wine is not there."""

import json
import math
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

SKIPPED = 77
PROGRAM = pathlib.Path(sys.argv[1]).resolve()
FOLDER = pathlib.Path(sys.argv[2]).resolve()
WORK = pathlib.Path(tempfile.mkdtemp(prefix="tegument-windows-"))
ENVIRONMENT = {
    **os.environ,
    "WINEPREFIX": str(WORK / "wine"),
    "WINEDEBUG": "-all",
    "WINEDLLOVERRIDES": "mscoree,mshtml=;winedbg.exe=",
    "TEGUMENT_CACHE": str(WORK / "cache"),
}
LIMIT = 900  # seconds for one command, beside much else
LABORATORY = {"verify", "invariance", "bench"}


def run(*words, **variables):
    """What the program for Windows says, and its exit code."""
    environment = {**ENVIRONMENT, **variables}
    return subprocess.run(["wine", str(FOLDER / "tegument.exe"), *map(str, words)], env=environment, cwd=WORK, capture_output=True, text=True, timeout=LIMIT)


def run_here(*words):
    """In its usual environment: Microsoft's compiler is in its cache."""
    return subprocess.run([str(PROGRAM), *map(str, words)], cwd=WORK, capture_output=True, text=True, timeout=LIMIT)


def files(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def effect(name):
    """The folder's own: both programs read the same file."""
    return FOLDER / "effects" / name


def write_ball(path, rings=12):
    """Quads on a dented ball: no two triangles equal."""
    with path.open("w") as file:
        for i in range(rings + 1):
            for j in range(2 * rings):
                a, b = math.pi * i / rings, math.pi * j / rings
                r = 100 + 10 * math.sin(5 * a) * math.cos(3 * b)
                file.write(f"v {r * math.sin(a) * math.cos(b):.5f} {r * math.cos(a):.5f} {r * math.sin(a) * math.sin(b):.5f}\n")
        for i in range(rings):
            for j in range(2 * rings):
                corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                file.write("f " + " ".join(str(u * 2 * rings + v % (2 * rings) + 1) for u, v in corners) + "\n")


def parts_of(path):
    """A glb's description, and its accessors' bytes."""
    data = path.read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    described = json.loads(data[20 : 20 + length])
    binary = data[28 + length :]
    views = [described["bufferViews"][accessor["bufferView"]] for accessor in described["accessors"]]
    return described, [binary[view.get("byteOffset", 0) :][: view["byteLength"]] for view in views]


def start_display():
    """Wine's Vulkan wants one."""
    if "DISPLAY" in os.environ or shutil.which("Xvfb") is None:
        return None
    read, write = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "64x64x24"], pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)
    ENVIRONMENT["DISPLAY"] = ":" + os.read(read, 16).decode().strip()
    return server


class Windows(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        write_ball(WORK / "ball.obj")

    def ends(self, done, code):
        self.assertEqual(done.returncode, code, done.stdout[-2000:] + done.stderr[-2000:])

    def both(self, *words):
        """The same command in both programs, OUT in it another name in each: what they wrote."""
        names = []
        for program, end in ((run, "there"), (run_here, "here")):
            names.append([str(word).replace("OUT", end) for word in words])
            self.ends(program(*names[-1]), 0)
        return [WORK / next(a for a, b in zip(mine, others) if a != b) for mine, others in (names, names[::-1])]

    def same(self, *words):
        there, here = self.both(*words)
        self.assertTrue(there.read_bytes() == here.read_bytes(), f"{words}: other bytes")

    def test_the_folder_has_one_program(self):
        self.assertEqual([path.name for path in FOLDER.rglob("*.exe")], ["tegument.exe"])

    def test_help_names_the_same_commands_but_view(self):
        def commands(text):
            listed = text.split("Subcommands:\n")[1].split("\n\n")[0]
            return {line.split()[0] for line in listed.splitlines() if line.startswith("  ") and not line.startswith("   ")}

        here, there = run_here("--help"), run("--help")
        self.ends(there, 0)
        self.assertEqual(commands(here.stdout) - commands(there.stdout) - LABORATORY, {"view"})
        self.assertLessEqual(commands(there.stdout), commands(here.stdout))

    def test_what_is_left_out_says_so(self):
        (WORK / "draco.gltf").write_text(
            '{"asset":{"version":"2.0"},"extensionsUsed":["KHR_draco_mesh_compression"],"extensionsRequired":["KHR_draco_mesh_compression"],'
            '"buffers":[{"byteLength":3,"uri":"data:;base64,AAAA"}],"bufferViews":[{"buffer":0,"byteLength":3}],"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],'
            '"accessors":[{"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},'
            '"extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}}}]}]}'
        )
        self.ends(run("fur", "texture", "-o", "fur", "--size", "16"), 0)
        labels = ["sheet", "fur/fur.png", "fur/fur.png", "--column-labels", "a,b", "-o", "sheet.png"]
        openmesh = ["prep", "ball.obj", "--levels-by", "openmesh", "-o", "ball.glb"]
        for words in (["view", "Main"], ["prep", "human"], labels, openmesh, ["prep", "draco.gltf", "-o", "draco.glb"]):
            done = run(*words)
            self.ends(done, 3)
            self.assertRegex(done.stderr, "error TG8051: this build .*leaves out", words)
        for word in LABORATORY:
            done = run(word)
            self.ends(done, 3)
            self.assertIn("TG8046", done.stderr)

    def test_an_effect_passes_for_every_target_but_one(self):
        """glslang's SPIR-V wants an optimiser that is left out."""

        def verdicts(done):
            self.ends(done, 0)
            return {target["target"]: target["verdict"] for target in json.loads(done.stdout)["files"][0]["targets"]}

        there, here = verdicts(run("check", "Specular", "--skip-missing", "--json")), verdicts(run_here("check", effect("Specular.fx"), "--json"))
        self.assertEqual(there, {**here, "spirv-glslang": "not checked"})
        self.ends(run("check", "Specular", "--target", "spirv-glslang"), 3)

    def test_engines_get_the_same_direct3d(self):
        """What DXC writes is of another version here."""
        kinds = [word for kind in ("fx_2_0", "fx_4_0", "fx_5_0", "sm5") for word in ("--target", kind, "--emit-kind", kind)]
        there, here = (files(folder) for folder in self.both("check", effect("Specular.fx"), *kinds, "--emit", "emitted_OUT"))
        self.assertEqual(set(there), set(here))
        self.assertGreaterEqual(len(there), 10)
        for name, data in there.items():
            if not name.endswith("manifest.json"):  # it names DXC's version
                self.assertTrue(data == here[name], name)

    def test_texts_are_the_same(self):
        self.same("flatten", "--library", "-o", "library_OUT.hlsl")
        self.same("flatten", effect("Main.fx"), "-o", "main_OUT.fx")
        there, here = (json.loads(program("info", effect("Main.fx"), "--json").stdout) for program in (run, run_here))
        there["file"] = here["file"]
        self.assertEqual(there, here)

    def test_a_mesh_is_prepared_as_here(self):
        self.same("prep", "ball.obj", "-o", "ball_OUT.glb")

    def test_texture_coordinates_differ_by_the_last_digit(self):
        """xatlas asks the C library for sines, and Windows' rounds otherwise."""
        (there, bytes_there), (here, bytes_here) = map(parts_of, self.both("prep", "ball.obj", "--unwrap", "-o", "charts_OUT.glb"))
        self.assertEqual(there, here)
        for accessor, a, b in zip(there["accessors"], bytes_there, bytes_here):
            if accessor["componentType"] != 5126:
                self.assertTrue(a == b, accessor)
                continue
            count = len(a) // 4
            pairs = zip(struct.unpack(f"<{count}f", a), struct.unpack(f"<{count}f", b))
            self.assertLess(max(abs(x - y) for x, y in pairs), 1e-4, accessor)  # tangents: of triangles that are small in the map; else 2e-7

    def test_maps_of_fur_are_the_same(self):
        there, here = (files(folder) for folder in self.both("fur", "texture", "--size", "32", "-o", "maps_OUT"))
        self.assertEqual(there, here)

    def test_an_error_names_its_place_and_ends_with_1(self):
        (WORK / "broken.fx").write_text("float4 ps() : COLOR { return nothing; }\ntechnique T { pass P { PixelShader = compile ps_3_0 ps(); } }\n")
        done = run("check", "broken.fx", "--target", "fx_2_0")
        self.ends(done, 1)
        self.assertRegex(done.stdout + done.stderr, r"broken\.fx\(1,\d+.*\): error TG3101: .*nothing")

    def test_what_does_not_exist_ends_with_2(self):
        self.ends(run("info", "Nothing"), 2)

    def test_names_in_any_letters_with_spaces_and_long(self):
        """Of the effect's folder, of what it includes, of what is written; by Microsoft's compiler and by DXC; patterns, too."""
        folder = WORK / "köpfe und 頭" / ("long" * 30) / ("name" * 30)
        shutil.copytree(FOLDER / "effects", folder / "effects")
        shutil.copytree(FOLDER / "hlsl", folder / "hlsl")
        (folder / "effects" / "Specular.fx").rename(folder / "effects" / "Größe 頭.fx")
        for name in (folder / "effects" / "Größe 頭.fx", folder / "effects" / "Gr*.fx", f"Z:{folder}/effects/Größe 頭.fx".replace("/", "\\")):
            done = run("check", name, "--target", "fx_2_0", "--target", "dxil")
            self.ends(done, 0)
            self.assertIn("2 passed", done.stdout)
        self.ends(run("prep", "ball.obj", "-o", folder / "neu 頭.glb"), 0)
        self.assertGreater((folder / "neu 頭.glb").stat().st_size, 1000)

    def test_a_folder_in_another_spelling_is_the_same_project(self):
        (WORK / "Project" / "Effects").mkdir(parents=True)
        (WORK / "Project" / ".tegument-root").touch()
        (WORK / "Project" / "colour.fxh").write_text("float4 colour() { return 1; }\n")
        upper = f"Z:{WORK}/PROJECT/COLOUR.FXH"
        (WORK / "Project" / "Effects" / "a.fx").write_text(
            f'#include "{upper}"\nfloat4 ps() : COLOR {{ return colour(); }}\ntechnique T {{ pass P {{ PixelShader = compile ps_3_0 ps(); }} }}\n'
        )
        done = run("check", "project\\effects\\A.FX", "--target", "fx_2_0")
        self.ends(done, 0)

    def test_caches_go_to_the_users_own_folder(self):
        done = run("--version", "--verbose", TEGUMENT_CACHE="")
        self.ends(done, 0)
        self.assertRegex(done.stdout, r"cache +C:\\users\\\w+\\AppData\\Local\\tegument\n")

    def test_a_batch_keeps_failures_apart(self):
        (WORK / "meshes").mkdir()
        write_ball(WORK / "meshes" / "gut ä.obj")
        (WORK / "meshes" / "bad.obj").write_text("nothing\n")
        words = ["batch", "-i", "meshes/*.obj", "--results", "done", "--", "prep", "{}", "-o", "done/{name}.glb"]
        self.ends(run(*words), 1)
        self.assertTrue((WORK / "done" / "gut ä.glb").is_file())
        self.assertIn("1 done before, 1 failed", run(*words).stdout)

    def test_an_effect_is_drawn_as_here(self):
        words = ["--mesh", "ball.obj", "--size", "64x64", "-o"]
        done = run("render", effect("Specular.fx"), *words, "there.png")
        if done.returncode == 3:
            self.skipTest(done.stderr.strip())
        self.ends(done, 0)
        self.ends(run_here("render", effect("Specular.fx"), *words, "here.png"), 0)
        error = json.loads(run_here("compare", "there.png", "here.png", "--json").stdout)
        self.assertLess(error["rel_l2"], 0.01)  # DXC of another version; seen: 0
        done = run("render", "Specular", "--mesh", "ball.obj", "--size", "64x64", "--turntable", "2", "-o", "turn.webp")
        self.ends(done, 3)
        self.assertIn("TG8051", done.stderr)

    def test_without_vulkan_one_message_says_so(self):
        done = run("render", "Specular", "--mesh", "ball.obj", "-o", "none.png", DISPLAY="", WINEPREFIX=str(WORK / "wine-without-display"))
        self.ends(done, 3)
        self.assertRegex(done.stderr, "error TG600[12]: .*Vulkan")


if __name__ == "__main__":
    if not (FOLDER / "tegument.exe").is_file() or shutil.which("wine") is None:
        print("skipped: cmake/windows/build was not run, or there is no Wine")
        sys.exit(SKIPPED)
    display = start_display()
    try:
        unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
    finally:
        for prefix in WORK.glob("wine*"):
            subprocess.run(["wineserver", "-k"], env={**ENVIRONMENT, "WINEPREFIX": str(prefix)}, check=False)
        if display is not None:
            display.terminate()
        shutil.rmtree(WORK, ignore_errors=True)
