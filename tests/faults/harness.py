"""What the tests of faults share: the program with a cache, a home and a folder for temporary files of its own."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM, REPOSITORY = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
MACHINE = 3  # exit code: docs/command-line.md
OLD = b"what was there before"
# The cache of whoever runs the tests, with what was fetched: every case has an empty one of its own.
KEPT = pathlib.Path(os.environ.get("TEGUMENT_CACHE") or pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "tegument")


def ball(rings, uvs=True):
    """A sphere as OBJ text."""
    import math
    lines = []
    for i in range(rings + 1):
        for j in range(rings + 1):
            theta, phi = math.pi * i / rings, 2 * math.pi * j / rings
            lines.append("v %.6f %.6f %.6f" % (90 * math.sin(theta) * math.cos(phi), 90 * math.cos(theta), -90 * math.sin(theta) * math.sin(phi)))
            lines.append("vt %.6f %.6f" % (0.01 + 0.98 * j / rings, 0.01 + 0.98 * (1 - i / rings)))
    for i in range(rings):
        for j in range(rings):
            a, b = i * (rings + 1) + j + 1, (i + 1) * (rings + 1) + j + 1
            for face in ((a, b, a + 1), (a + 1, b, b + 1)):
                lines.append("f " + " ".join(f"{corner}/{corner}" if uvs else str(corner) for corner in face))
    return "\n".join(lines) + "\n"


class Faults(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="tegument-faults-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.out = self.folder / "out"
        for name in ("out", "cache", "temporary", "home"):
            (self.folder / name).mkdir()
        self.ball = self.folder / "ball.obj"
        self.ball.write_text(ball(24), encoding="ascii")
        # The user's cache lends what is fetched; what is made goes into ours.
        self.environment = dict(os.environ, TEGUMENT_CACHE=str(self.folder / "cache"), HOME=str(self.folder / "home"),
                                TMPDIR=str(self.folder / "temporary"))

    def start(self, *arguments, environment=None, **more):
        streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "stdin": subprocess.DEVNULL, **more}
        return subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=REPOSITORY, env=dict(self.environment, **(environment or {})), text=True,
                                errors="replace", **streams)

    def run_it(self, *arguments, **more):
        process = self.start(*arguments, **more)
        out, err = process.communicate(timeout=300)
        return subprocess.CompletedProcess(arguments, process.returncode, out or "", err or "")

    def good(self, *arguments, **more):
        ran = self.run_it(*arguments, **more)
        self.assertEqual(ran.returncode, 0, f"{arguments}: {ran.stdout}{ran.stderr}")
        return ran

    def refused(self, ran, *words, code=MACHINE):
        """One message with these words, and this exit code."""
        self.assertEqual(ran.returncode, code, ran.stdout + ran.stderr)
        self.assertEqual(ran.stderr.count(": error TG"), 1, ran.stderr)
        for word in words:
            self.assertIn(word, ran.stderr)

    def picture(self, name="picture.png"):
        return ["render", "Beckmann", "--size", "48", "-o", self.out / name]

    def leftovers(self):
        """Files that no command is asked for."""
        return [str(file) for folder in (self.out, self.folder / "temporary") for file in folder.rglob("*") if "tegument" in file.name]


    def checked(self, *arguments, **more):
        """Of a target whose tool this machine may lack: then the case is skipped, in the program's own words."""
        ran = self.run_it("check", *arguments, **more)
        lacks = re.search(r"not checked: (.*(?:\./bootstrap test|built without it).*)", ran.stdout + ran.stderr)
        if ran.returncode == MACHINE and lacks:
            self.skipTest(lacks.group(1))
        return ran


def cases(suite):
    """The names of all that a suite holds: Class.test."""
    for part in suite:
        yield from cases(part) if isinstance(part, unittest.TestSuite) else [part.id().removeprefix("__main__.")]


def main():
    """The lines and exit codes of tests/runner/main.cpp: 77 where all cases were skipped, never where one failed. TEGUMENT_CASE=TEXT: only cases whose
    names hold that. TEGUMENT_PART=1/2: those of the first of two parts."""
    part, parts = map(int, os.environ.get("TEGUMENT_PART", "1/1").split("/"))
    names = sorted(cases(unittest.defaultTestLoader.loadTestsFromModule(sys.modules["__main__"])))[part - 1::parts]
    names = [name for name in names if os.environ.get("TEGUMENT_CASE", "") in name]
    if not names:
        print("[cases] 0 passed, 0 failed, 0 skipped\nno such case here")
        sys.exit(77 if parts > 1 else 1)
    ran = unittest.main(argv=[sys.argv[0], *names], exit=False).result
    name = lambda case: getattr(case, "test_case", case).id().removeprefix("__main__.")  # of a part of a case: the case's
    failed = {name(case) for case, _ in ran.failures + ran.errors}
    skipped = {name(case): reason for case, reason in ran.skipped if name(case) not in failed}
    passed = ran.testsRun - len(failed) - len(skipped)
    for case, reason in skipped.items():
        print(f"[skipped] {case}: {reason}")
    print(f"[cases] {passed} passed, {len(failed)} failed, {len(skipped)} skipped")
    sys.exit(1 if not ran.wasSuccessful() or ran.testsRun == 0 else 0 if passed else 77)
