"""The folder for Windows under Wine, beside this system's program: windows_test.py PROGRAM FOLDER. Ends with 77 where the folder or Wine is not there."""

import json
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

CUBE = """v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"""


def run(*words):
    """What the program for Windows says, and its exit code."""
    return subprocess.run(["wine", str(FOLDER / "tegument.exe"), *map(str, words)], env=ENVIRONMENT, cwd=WORK, capture_output=True, text=True, timeout=LIMIT)


def run_here(*words):
    return subprocess.run([str(PROGRAM), *map(str, words)], env=ENVIRONMENT, cwd=WORK, capture_output=True, text=True, timeout=LIMIT)


def files(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


class Windows(unittest.TestCase):
    def ends(self, done, code):
        self.assertEqual(done.returncode, code, done.stdout[-2000:] + done.stderr[-2000:])

    def test_the_folder_has_one_program(self):
        self.assertEqual([path.name for path in FOLDER.rglob("*.exe")], ["tegument.exe"])

    def test_help_names_the_same_commands_but_view(self):
        def commands(text):
            listed = text.split("Subcommands:\n")[1].split("\n\n")[0]
            return {line.split()[0] for line in listed.splitlines() if line.startswith("  ") and not line.startswith("   ")}

        here, there = run_here("--help"), run("--help")
        self.ends(there, 0)
        self.assertEqual(commands(here.stdout) - commands(there.stdout) - {"verify", "invariance", "bench"}, {"view"})
        self.assertLessEqual(commands(there.stdout), commands(here.stdout))

    def test_every_command_that_is_left_out_says_so(self):
        (WORK / "cube.obj").write_text(CUBE)
        for words in (["view", "Main"], ["prep", "human"]):
            done = run(*words)
            self.ends(done, 3)
            self.assertRegex(done.stderr, "TG8051: this build .*leaves out")
            self.assertLessEqual(len(done.stderr.strip().splitlines()), 2, done.stderr)
        for word in ("verify", "invariance", "bench"):
            done = run(word)
            self.ends(done, 3)
            self.assertIn("TG8046", done.stderr)

    def test_an_effect_passes_for_every_target(self):
        done = run("check", "Specular", "--json")
        self.ends(done, 0)
        verdicts = {target["target"]: target["verdict"] for target in json.loads(done.stdout)["files"][0]["targets"]}
        here = {target["target"]: target["verdict"] for target in json.loads(run_here("check", "Specular", "--json").stdout)["files"][0]["targets"]}
        self.assertEqual(set(verdicts), set(here))
        self.assertEqual({target for target, verdict in verdicts.items() if verdict != "passed"}, {target for target, verdict in here.items() if verdict == "not applicable"})

    def test_engines_get_the_same_text_and_nearly_the_same_binaries(self):
        """glslang's SPIR-V and what is made of it byte for byte; DXC's is of another build of DXC."""
        kinds = ["--target", "spirv-glslang", "--target", "fx_2_0", "--target", "sm5", "--emit-kind", "spirv-glslang", "--emit-kind", "fx_2_0", "--emit-kind", "sm5"]
        self.ends(run("check", "Specular", *kinds, "--emit", "there"), 0)
        done = run_here("check", "Specular", *kinds, "--emit", "here")
        there, here = files(WORK / "there"), files(WORK / "here")
        self.assertEqual(set(there), set(here), done.stdout + done.stderr)
        self.assertTrue(any(name.endswith(".spv") for name in there))
        for name, data in there.items():
            if not name.endswith("manifest.json"):
                self.assertEqual(data, here[name], name)

    def test_the_library_is_the_same_text(self):
        self.ends(run("flatten", "--library", "-o", "there.hlsl"), 0)
        self.ends(run_here("flatten", "--library", "-o", "here.hlsl"), 0)
        self.assertEqual((WORK / "there.hlsl").read_bytes(), (WORK / "here.hlsl").read_bytes())

    def test_an_error_names_its_place_and_ends_with_1(self):
        (WORK / "broken.fx").write_text("float4 ps() : COLOR { return nothing; }\ntechnique T { pass P { PixelShader = compile ps_3_0 ps(); } }\n")
        done = run("check", "broken.fx", "--target", "fx_2_0")
        self.ends(done, 1)
        self.assertRegex(done.stdout + done.stderr, r"broken\.fx\(1,\d+.*\): error TG3101: .*nothing")

    def test_what_does_not_exist_ends_with_2(self):
        self.ends(run("info", "Nothing"), 2)

    def test_a_mesh_is_prepared_as_here(self):
        (WORK / "cube.obj").write_text(CUBE)
        self.ends(run("prep", "cube.obj", "--unwrap", "-o", "there.glb"), 0)
        self.ends(run_here("prep", "cube.obj", "--unwrap", "-o", "here.glb"), 0)

        def accessors(path):
            data = path.read_bytes()
            length = struct.unpack_from("<I", data, 12)[0]
            return [(a["count"], a["type"]) for a in json.loads(data[20 : 20 + length])["accessors"]]

        self.assertEqual(accessors(WORK / "there.glb"), accessors(WORK / "here.glb"))

    def test_roots_are_placed_as_here(self):
        (WORK / "cube.obj").write_text(CUBE)
        for end, program in (("there", run), ("here", run_here)):
            self.ends(program("prep", "cube.obj", "-o", f"fur_{end}.glb"), 0)
            self.ends(program("fur", "roots", f"fur_{end}.glb", "-o", f"{end}.dds"), 0)
        self.assertEqual((WORK / "there.dds").stat().st_size, (WORK / "here.dds").stat().st_size)

    def test_an_effect_is_drawn_where_vulkan_is(self):
        done = run("render", "OriginalTexture", "--size", "64", "-o", "there.png")
        if done.returncode == 3:
            self.skipTest(done.stderr.strip())
        self.ends(done, 0)
        self.assertGreater((WORK / "there.png").stat().st_size, 500)


if __name__ == "__main__":
    if not (FOLDER / "tegument.exe").is_file() or shutil.which("wine") is None:
        print("skipped: cmake/windows/build was not run, or there is no Wine")
        sys.exit(SKIPPED)
    try:
        unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
    finally:
        shutil.rmtree(WORK, ignore_errors=True)
