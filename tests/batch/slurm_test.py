#!/usr/bin/env python3
"""Batches on a real Slurm with four nodes: 200 meshes and 200 effects; a node that dies in the middle loses nothing, and nothing is done twice.
usage: slurm_test.py TEGUMENT REPOSITORY [MESHES EFFECTS]
"""

import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import cluster

PROGRAM, REPOSITORY = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
MESHES, EFFECTS = (int(n) for n in (sys.argv[3:5] or ("200", "200")))
NODES, SHARDS = 4, 16


def write_ball(file, rings):
    """A ball of so many rings, as OBJ."""
    lines, columns = [], 2 * rings
    for i in range(rings + 1):
        for j in range(columns):
            theta, phi = math.pi * i / rings, 2 * math.pi * j / columns
            lines.append(f"v {math.sin(theta) * math.cos(phi):.6f} {math.cos(theta):.6f} {math.sin(theta) * math.sin(phi):.6f}")
    for i in range(rings):
        for j in range(columns):
            a, b = i * columns + j + 1, i * columns + (j + 1) % columns + 1
            lines += [f"f {a} {a + columns} {b}", f"f {b} {a + columns} {b + columns}"]
    file.write_text("\n".join(lines) + "\n", encoding="ascii")


def write_effect(file, grey):
    file.write_text(f"""float4x4 gWvp : WORLDVIEWPROJECTION;
float4 VS(float4 p : POSITION) : SV_Position {{ return mul(p, gWvp); }}
float4 PS() : SV_Target0 {{ return {grey:.4f}; }}
technique10 T {{ pass P {{ SetVertexShader(CompileShader(vs_4_0, VS())); SetPixelShader(CompileShader(ps_4_0, PS())); }} }}
""", encoding="ascii")


class OnSlurm(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="tegument-slurm-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.cluster = cluster.Cluster(self.folder / "slurm", NODES)
        self.cluster.__enter__()
        self.addCleanup(self.cluster.__exit__)

    def submit(self, inputs, results, *command):
        arguments = [PROGRAM, "submit", "--slurm", "--go", "--shards", str(SHARDS), "-i", inputs, "--results", results, "--", *command]
        done = subprocess.run(arguments, cwd=self.folder, env=self.cluster.environment, capture_output=True, text=True, check=False, timeout=900)
        print(done.stdout + done.stderr, end="", flush=True)
        return done.returncode

    def records(self, results):
        return [json.loads(file.read_text()) for file in sorted((self.folder / results / "records").glob("*.json"))]

    def logged(self, results):
        """(inputs, done, done before, failed) of each task that came to its end."""
        lines = "".join(file.read_text() for file in (self.folder / results / "jobs").glob("*.txt") if "_" in file.name)
        return [tuple(map(int, found)) for found in re.findall(r"(\d+) inputs: (\d+) done, (\d+) done before, (\d+) failed", lines)]

    def test_meshes_with_a_node_that_dies(self):
        scans = self.folder / "scans"
        scans.mkdir()
        for i in range(MESHES):
            write_ball(scans / f"ball{i:03}.obj", 90 + i % 20)
        killed = []

        def kill():
            end = time.monotonic() + 300
            while len(self.records("done")) < MESHES // 5 and time.monotonic() < end:
                time.sleep(0.05)
            killed.append((len(self.records("done")), self.cluster.kill_node("n2")))

        killer = threading.Thread(target=kill)
        killer.start()
        code = self.submit("scans/*.obj", "done", "prep", "{}", "-o", "prepared/{name}.glb", "--json")
        killer.join()
        before, processes = killed[0]
        print(f"node n2 killed after {before} of {MESHES} records, with {processes} processes of its jobs")
        self.assertEqual(code, 0)
        self.assertLess(before, MESHES)
        self.assertGreater(processes, 0, "the node was at work")
        self.assertEqual(sorted(record["input"] for record in self.records("done")), sorted(f"scans/ball{i:03}.obj" for i in range(MESHES)))
        self.assertEqual({record["state"] for record in self.records("done")}, {"done"})
        self.assertEqual(len(list((self.folder / "prepared").glob("*.glb"))), MESHES)
        tasks = self.logged("done")
        print(f"{len(tasks)} tasks ended: {sum(t[1] for t in tasks)} inputs done by them, {sum(t[2] for t in tasks)} found done by a task that was killed")
        self.assertEqual(sum(t[0] for t in tasks), MESHES, "each input is in exactly one task that ended")
        self.assertEqual(sum(t[1] + t[2] for t in tasks), MESHES, "done once, by that task or by the one that was killed")

    def test_effects_and_what_is_left_to_do(self):
        effects = self.folder / "effects"
        effects.mkdir()
        for i in range(EFFECTS):
            write_effect(effects / f"grey{i:03}.fx", i / EFFECTS)
        (effects / "grey007.fx").write_text("float a = ;", encoding="ascii")
        check = ("effects/*.fx", "checked", "check", "{}", "--target", "spirv-glslang", "--json")
        self.assertEqual(self.submit(*check), 1)
        states = {record["input"]: record["state"] for record in self.records("checked")}
        self.assertEqual([name for name, state in states.items() if state != "done"], ["effects/grey007.fx"])
        self.assertEqual(len(states), EFFECTS)
        write_effect(effects / "grey007.fx", 0.5)
        write_effect(effects / "grey008.fx", 0.6)
        ended = {record["input"]: record["ended"] for record in self.records("checked")}
        time.sleep(1.1)  # the records' times are in seconds
        self.assertEqual(self.submit(*check), 0)
        again = [record["input"] for record in self.records("checked") if record["ended"] != ended[record["input"]]]
        self.assertEqual(sorted(again), ["effects/grey007.fx", "effects/grey008.fx"], "the one that failed, and the one that changed")
        self.assertEqual(self.submit(*check), 0, "nothing to do")


if __name__ == "__main__":
    lacking = cluster.missing()
    if lacking:
        print(f"[cases] 0 passed, 0 failed, 1 skipped\n{lacking}")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
