#!/usr/bin/env python3
"""reproducible.py sees what makes two builds differ: a path, the time. usage: reproducible_test.py"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(__file__).with_name("reproducible.py")
PRESETS = """{"version": 6, "configurePresets": [{"name": "release", "generator": "Ninja", "binaryDir": "${sourceDir}/build/release",
    "cacheVariables": {"CMAKE_BUILD_TYPE": "Release"}}]}"""
PROJECT = "cmake_minimum_required(VERSION 3.25)\nproject(twice LANGUAGES CXX)\nadd_library(twice STATIC a.cpp)\n"


class Twice(unittest.TestCase):
    def ends(self, code, text, more=""):
        with tempfile.TemporaryDirectory(prefix="tegument-twice-test-") as folder:
            for name, content in (("CMakePresets.json", PRESETS), ("CMakeLists.txt", PROJECT + more), ("a.cpp", text)):
                (pathlib.Path(folder) / name).write_text(content, encoding="ascii")
            done = subprocess.run([sys.executable, PROGRAM, folder, "--target", "twice", "--jobs", "1"], capture_output=True, text=True, check=False, timeout=250)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout

    def test_what_is_the_same_passes(self):
        self.assertIn("1 files", self.ends(0, "int answer() { return 42; }\n"))

    def test_a_path_is_found(self):
        self.assertIn("libtwice.a", self.ends(1, "const char* where() { return __FILE__; }\n"))

    def test_a_time_is_found(self):
        self.ends(1, "const char* when() { return NOW; }\n", 'string(TIMESTAMP now "%s%f")\ntarget_compile_definitions(twice PRIVATE NOW="${now}")\n')


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
