#!/usr/bin/env python3
"""The sample Snakefile: on this machine, and on a Slurm of four local nodes of which one dies half-way.
usage: snakemake_test.py TEGUMENT REPOSITORY [SCANS]
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import cluster

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "faults"))
import harness

PROGRAM, REPOSITORY = harness.PROGRAM, harness.REPOSITORY
SCANS = int((sys.argv[3:] or ("12",))[0])
NODES = 4


class Snakefile(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="tegument-snakemake-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "scans").mkdir()
        shutil.copy(REPOSITORY / "docs/samples/batch/Snakefile", self.folder)

    def scans(self, count):
        names = [f"ball {i:02}" for i in range(count)]
        for i, name in enumerate(names):
            (self.folder / f"scans/{name}.obj").write_text(harness.ball(12 + i), encoding="ascii")
        return names

    def snakemake(self, *options, environment=None, code=0):
        """What it said."""
        command = ["snakemake", "--nocolor", *options, "--config", f"tegument={PROGRAM}", "size=32x32", "effect=Pyramid"]
        done = subprocess.run(command, cwd=self.folder, env=environment, capture_output=True, text=True, check=False, timeout=1500)
        self.assertEqual(done.returncode, code, (done.stdout + done.stderr)[-4000:])
        return done.stdout + done.stderr

    def made(self):
        return {file: file.stat().st_mtime_ns for name in ("prepared", "baked", "pictures", "bench") for file in (self.folder / name).glob("*")}

    def holds_all(self, names):
        self.assertEqual({f"{folder}/{name}" for folder, ending in (("prepared", "glb"), ("baked", "dds"), ("pictures", "png"))
                          for name in (f"{one}.{ending}" for one in names)} | {"bench/sphere-10.json"},
                         {str(file.relative_to(self.folder)) for file in self.made()})

    def test_one_command_makes_all_and_again_only_what_is_missing_or_older(self):
        names = self.scans(2)
        self.snakemake("--cores", "2")
        self.holds_all(names)
        before = self.made()
        self.assertIn("Nothing to be done", self.snakemake("--cores", "2"))
        (self.folder / f"pictures/{names[0]}.png").unlink()
        (self.folder / f"scans/{names[1]}.obj").write_text(harness.ball(20), encoding="ascii")
        self.snakemake("--cores", "2")
        self.holds_all(names)
        again = {str(file.relative_to(self.folder)) for file, when in self.made().items() if when != before.get(file)}
        self.assertEqual(again, {f"pictures/{names[0]}.png", f"prepared/{names[1]}.glb", f"baked/{names[1]}.dds", f"pictures/{names[1]}.png"})

    def test_on_slurm_with_a_node_that_dies(self):
        lacking = cluster.missing()
        if lacking:
            self.skipTest(lacking)
        names = self.scans(SCANS)
        killed = []
        with cluster.Cluster(self.folder / "slurm", NODES) as slurm:
            def kill():
                end = time.monotonic() + 1200
                while time.monotonic() < end:
                    if len(self.made()) >= SCANS and slurm.runs("n2", PROGRAM):
                        killed.append((len(self.made()), slurm.kill_node("n2")))
                        return
                    time.sleep(0.05)

            killer = threading.Thread(target=kill)
            killer.start()
            said = self.snakemake("--jobs", str(NODES), "--retries", "3", "--cluster-sync", "srun --quiet --mem={resources.mem_mb}",
                                  environment=dict(slurm.environment, HOME=os.environ.get("HOME", "/root")))
            killer.join()
        self.assertTrue(killed, "no node was killed")
        before, processes = killed[0]
        print(f"node n2 killed after {before} of {3 * SCANS + 1} files, with {processes} processes; {said.count('Trying to restart')} jobs restarted")
        self.assertLess(before, 3 * SCANS + 1)
        self.assertGreater(said.count("Trying to restart"), 0, f"a job of that node was lost and run again: {said[-6000:]}")
        self.holds_all(names)
        for file in (self.folder / "pictures").glob("*.png"):
            self.assertTrue(file.read_bytes().endswith(b"IEND\xaeB`\x82"), file)


if __name__ == "__main__":
    if shutil.which("snakemake") is None:
        print("[cases] 0 passed, 0 failed, 2 skipped\nno snakemake: apt-get install snakemake")
        sys.exit(77)
    ran = unittest.main(argv=sys.argv[:1], exit=False).result
    for _, reason in ran.skipped:
        print(f"skipped: {reason}")
    sys.exit(1 if not ran.wasSuccessful() else 77 if ran.skipped else 0)
