#!/usr/bin/env python3
"""docs/samples/ci/pre-commit in a repository of its own: hook_test.py PROGRAM REPOSITORY. Exit code 77: no git or no DXC."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = pathlib.Path(sys.argv.pop()).resolve()
PROGRAM = pathlib.Path(sys.argv.pop()).resolve()
PART = "float4 shade() { return 1; }\n"
EFFECT = """#include "part.fxh"
float4 vertex(float3 p : POSITION) : SV_Position { return float4(p, 1); }
float4 pixel() : SV_Target { return shade(); }
technique11 T { pass P { SetVertexShader(CompileShader(vs_5_0, vertex())); SetPixelShader(CompileShader(ps_5_0, pixel())); } }
"""
NAMES = {f"GIT_{who}_{what}": "a@b" for who in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}


class Hook(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.git("init", "-q", ".")
        hook = self.folder / ".git" / "hooks" / "pre-commit"
        hook.parent.mkdir(exist_ok=True)
        shutil.copy(REPOSITORY / "docs" / "samples" / "ci" / "pre-commit", hook)

    def git(self, *arguments, program=PROGRAM):
        environment = {**{name: value for name, value in os.environ.items() if not name.startswith("GIT_")}, **NAMES, "TEGUMENT": str(program)}
        return subprocess.run(["git", *arguments], cwd=self.folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)

    def commit(self, program=PROGRAM, **files):
        for name, text in files.items():
            (self.folder / name.replace("_", ".")).write_text(text, encoding="utf-8")
        self.git("add", "-A")
        return self.git("commit", "-qm", "x", program=program)

    def test_effects_that_compile_are_committed(self):
        done = self.commit(effect_fx=EFFECT, part_fxh=PART)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("1 passed", done.stdout)

    def test_a_broken_include_of_an_effect_is_not(self):
        self.commit(effect_fx=EFFECT, part_fxh=PART)
        done = self.commit(part_fxh=PART.replace("1", "missing"))
        self.assertNotEqual(done.returncode, 0, done.stdout)
        self.assertIn("1 failed", done.stdout)

    def test_what_is_staged_counts(self):
        (self.folder / "part.fxh").write_text(PART, encoding="utf-8")
        (self.folder / "effect.fx").write_text(EFFECT.replace("shade", "missing"), encoding="utf-8")
        self.git("add", "-A")
        (self.folder / "effect.fx").write_text(EFFECT, encoding="utf-8")
        self.assertNotEqual(self.git("commit", "-qm", "x").returncode, 0)

    def test_other_files_need_no_program(self):
        self.assertEqual(self.commit(program="/nowhere", notes_txt="x").returncode, 0)

    def test_a_program_that_is_not_there_stops_the_commit(self):
        self.assertNotEqual(self.commit(program="/nowhere", effect_fx=EFFECT, part_fxh=PART).returncode, 0)


if __name__ == "__main__":
    if not shutil.which("git"):
        print("skipped: git is not installed")
        sys.exit(77)
    if subprocess.run([PROGRAM, "check", "effects/Beckmann.fx", "--target", "spirv-dxc"], cwd=REPOSITORY, stdout=subprocess.DEVNULL, check=False).returncode == 3:
        print("skipped: DXC is not installed")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
