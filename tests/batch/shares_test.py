#!/usr/bin/env python3
"""The same parts under GNU parallel and as an indexed Job of Kubernetes, whose file is held against what such a Job must have and whose command
is run for every index. usage: shares_test.py TEGUMENT REPOSITORY
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, REPOSITORY = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
JOB = (REPOSITORY / "docs/samples/batch/job.yaml").read_text(encoding="utf-8")
TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


class Shares(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="tegument-shares-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for i in range(20):
            (self.folder / f"scan{i}.obj").write_text(TRIANGLE.replace("1 0 0", f"{i + 1} 0 0"), encoding="ascii")
        (self.folder / "scans.txt").write_text("".join(f"scan{i}.obj\n" for i in range(20)), encoding="ascii")
        programs = self.folder / "bin"
        programs.mkdir()
        (programs / "tegument").symlink_to(PROGRAM)
        self.environment = dict(os.environ, PATH=f"{programs}:{os.environ['PATH']}")

    def shell(self, line, **more):
        done = subprocess.run(["sh", "-c", line], cwd=self.folder, env=dict(self.environment, **more), capture_output=True, text=True,
                              check=False, timeout=300)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def holds_all(self):
        records = [json.loads(file.read_text()) for file in (self.folder / "done/records").glob("*.json")]
        self.assertEqual(sorted(record["input"] for record in records), sorted(f"scan{i}.obj" for i in range(20)))
        self.assertEqual({record["state"] for record in records}, {"done"})
        self.assertEqual(len(list((self.folder / "prepared").glob("*.glb"))), 20)

    def test_the_indexed_job(self):
        for line in ("apiVersion: batch/v1", "kind: Job", "completionMode: Indexed", "restartPolicy: OnFailure"):
            self.assertRegex(JOB, rf"(?m)^ *{line}$")
        completions = int(re.search(r"(?m)^  completions: (\d+)$", JOB)[1])
        command = " ".join(re.search(r"args:\n +- (.*?)\n +resources:", JOB, re.S)[1].split())
        self.assertIn(f"/{completions}\"", command)
        for index in range(completions):
            self.shell(command, JOB_COMPLETION_INDEX=str(index))
        self.holds_all()

    def test_the_line_for_gnu_parallel(self):
        if shutil.which("parallel") is None:
            self.skipTest("no parallel: ./bootstrap test brings it")
        line = re.search(r"(?m)^    (seq 8 \| parallel .*)$", (REPOSITORY / "docs/many.md").read_text(encoding="utf-8"))[1]
        self.shell(line)
        self.holds_all()


if __name__ == "__main__":
    ran = unittest.main(argv=sys.argv[:1], exit=False).result
    for _, reason in ran.skipped:
        print(f"skipped: {reason}")
    sys.exit(1 if not ran.wasSuccessful() else 77 if ran.skipped else 0)
