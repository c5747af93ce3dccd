"""What the tests of faults share: the program with a cache, a home and a folder for temporary files of its own."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM, REPOSITORY = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
MACHINE = 3  # exit code: docs/command-line.md
OLD = b"what was there before"


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


def main():
    ran = unittest.main(argv=sys.argv[:1], exit=False).result
    for _, reason in ran.skipped:
        print(f"skipped: {reason}")
    sys.exit(1 if not ran.wasSuccessful() else 77 if ran.skipped else 0)
