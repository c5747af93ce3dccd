#!/usr/bin/env python3
"""The program is killed at any moment, or asked to end by Ctrl-C: files are whole or absent, nothing runs on, and the next run succeeds.
usage: interrupt_test.py TEGUMENT REPOSITORY ROUNDS
"""

import json
import os
import pathlib
import random
import signal
import sys
import time

from harness import Faults, OLD, main

ROUNDS = int(sys.argv[3])
SEED = 23


def owned(environment):
    """Processes that run with this cache: ours, and those that they started."""
    mark = f"TEGUMENT_CACHE={environment['TEGUMENT_CACHE']}".encode()
    found = []
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if mark in (process / "environ").read_bytes().split(b"\0"):
                found.append((process / "cmdline").read_bytes().replace(b"\0", b" "))
        except OSError:
            continue  # it has ended, or is not ours
    return found


def catches(process, number):
    """Whether a process has come so far that it catches this signal: under a sanitizer and load, loading takes longer than any pause."""
    for line in pathlib.Path(f"/proc/{process.pid}/status").read_text(encoding="ascii").splitlines():
        if line.startswith("SigCgt:"):
            return bool(int(line.split()[1], 16) >> (number - 1) & 1)
    return False


def whole(content, expected):
    """Of JSON, which holds times, it is asked that it can be read."""
    if expected is not None:
        return content == expected
    try:
        return json.loads(content) is not None
    except ValueError:
        return False


class Interrupted(Faults):
    def setUp(self):
        super().setUp()
        self.second = self.folder / "second.obj"
        self.second.write_text(self.ball.read_text().replace("90.", "80."), encoding="ascii")

    def commands(self):
        """They write the same bytes each time, but for the seconds in their JSON files."""
        mesh, out = self.ball, self.out
        return [
            ["render", "Specular", "--mesh", mesh, "--size", "128", "-o", out / "picture.png"],
            ["prep", mesh, "--levels", "3", "-o", out / "mesh.glb", "--report", out / "mesh.json"],
            ["fur", "roots", mesh, "-o", out / "roots.dds"],
            ["fur", "strands", mesh, "--count", "4000", "-o", out / "strands.glb"],
            ["fur", "texture", "-o", out / "fur"],
            ["prep", "links", mesh, "-o", out / "links.dds"],
            ["render", "Fur", "--mesh", mesh, "--size", "64", "-o", out / "fur.png"],
            ["check", "Beckmann", "--target", "spirv-glslang", "--emit", out / "emitted"],
            ["batch", "-i", mesh, "-i", self.second, "--results", out / "results", "--", "prep", "{}", "-o", str(out / "{name}.ply")],
        ]

    def files(self):
        return {str(file.relative_to(self.out)): file for file in self.out.rglob("*") if file.is_file()}

    def empty(self):
        for file in sorted(self.out.rglob("*"), reverse=True):
            file.rmdir() if file.is_dir() else file.unlink()
        for file in sorted((self.folder / "cache").rglob("*"), reverse=True):
            file.rmdir() if file.is_dir() else file.unlink()

    def whole(self, command):
        """An undisturbed run: seconds, and every file's bytes; None for JSON, which holds times."""
        self.empty()
        begun = time.monotonic()
        self.good(*command)
        took = time.monotonic() - begun
        return took, {name: None if name.endswith(".json") else file.read_bytes() for name, file in self.files().items()}

    def ended(self):
        """What a killed program started is told of its end, and may take a moment."""
        end = time.monotonic() + 10
        while owned(self.environment) and time.monotonic() < end:
            time.sleep(0.01)
        self.assertEqual(owned(self.environment), [])

    def check(self, expected, command):
        """Linux has no call that puts a file without a name in another's place: it is named beside, then moved. Killed between the two, the
        program leaves it there, whole."""
        for name, file in self.files().items():
            if ".tmp." in name and "emitted" in name:
                continue  # the folder that would have been exchanged
            if name.startswith("results/records/") and name.endswith(".json.used"):
                continue  # what the command that ran had read and written so far: the next run takes it over and removes it
            content = file.read_bytes()
            if file.name.startswith(".tegument."):
                replaced = [place for place in expected if (self.out / place).parent == file.parent and (self.out / place).exists()]
                self.assertTrue(any(whole(content, expected[place]) for place in replaced), f"{name} is half written: {command}")
            else:
                self.assertIn(name, expected, command)
                self.assertTrue(content == OLD or whole(content, expected[name]), f"{name} is half written: {command}")

    def test_killed_at_any_moment_files_are_whole_or_absent(self):
        dice = random.Random(SEED)
        commands = self.commands()
        known = [self.whole(command) for command in commands]
        killed = 0
        for each in range(ROUNDS):
            command, (took, expected) = commands[each % len(commands)], known[each % len(commands)]
            self.empty()
            if dice.random() < 0.5:
                for name in expected:
                    if "results" not in name and "emitted" not in name:  # these folders are the program's own
                        (self.out / name).parent.mkdir(parents=True, exist_ok=True)
                        (self.out / name).write_bytes(OLD)
            process = self.start(*command)
            time.sleep(dice.random() * took)
            process.kill()
            process.communicate(timeout=60)
            killed += process.returncode == -signal.SIGKILL
            self.ended()
            self.check(expected, command)
            self.good(*command)
            for name, content in expected.items():
                self.assertTrue((self.out / name).exists(), f"{name}: {command}")
                if content is not None:
                    self.assertEqual((self.out / name).read_bytes(), content, f"{name}, after a kill: {command}")
            self.assertEqual([name for name in self.files() if name.endswith(".used")], [], command)
        print(f"{killed} of {ROUNDS} were killed before their end", flush=True)
        self.assertGreater(killed, ROUNDS // 3, "the kills come too late")

    def test_ctrl_c_ends_every_long_command_with_a_word(self):
        mesh, out = self.ball, self.out
        big = self.folder / "big.ply"
        self.good("prep", "shape", "terrain", "--detail", "400", "-o", big)
        (out / "picture.webp").write_bytes(OLD)
        commands = [
            ["render", "Specular", "--mesh", mesh, "--size", "512", "--turntable", "999", "-o", out / "picture.webp"],
            ["prep", big, "--levels", "8", "-o", out / "big.glb"],
            ["prep", "links", mesh, "-o", out / "links.dds"],
            ["prep", "occlusion", mesh, "-o", out / "occlusion.dds"],
            ["fur", "strands", mesh, "--count", "900000", "-o", out / "strands.glb"],
            ["check", "--target", "all", "--all-settings", *sorted(map(str, pathlib.Path("effects").glob("*.fx")))],
            ["survey", "effects"],
            ["batch", "-i", big, "-i", mesh, "--results", out / "results", "--", "prep", "{}", "-o", str(out / "{name}.glb")],
        ]
        if self.run_it("bench", "--help").returncode == 0:
            commands += [["verify", "Main"], ["bench", "--technique", "DEonLuebke", "--scene", "sphere-10@90", "--json", out / "bench.json"]]
        for number, signals in enumerate((signal.SIGINT, signal.SIGTERM, signal.SIGHUP)):
            for command in commands[number::1 if number == 0 else 3]:
                with self.subTest(command=command[:2], signal=signals.name):
                    self.interrupt(command, signals)
        self.assertEqual((out / "picture.webp").read_bytes(), OLD)

    def interrupt(self, command, number):
        process = self.start(*command)
        end = time.monotonic() + 60
        while process.poll() is None and not catches(process, number) and time.monotonic() < end:
            time.sleep(0.01)
        time.sleep(0.4)
        self.assertIsNone(process.poll(), f"{command} has ended before: {process.communicate()}" if process.poll() is not None else "")
        process.send_signal(number)
        begun = time.monotonic()
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, -number, err)
        self.assertIn("interrupted", err)
        self.assertLess(time.monotonic() - begun, 10)
        time.sleep(0.1)
        self.assertEqual(owned(self.environment), [], command)
        self.assertEqual(self.leftovers(), [], command)
        self.assertEqual([name for name in self.files() if not name.startswith(("picture.webp", "results"))], [], command)

    def test_who_ignores_interruptions_goes_on(self):
        process = self.start("prep", "links", self.ball, "-o", self.out / "links.dds",
                             preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        time.sleep(0.1)
        process.send_signal(signal.SIGHUP)
        _, err = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 0, err)
        self.assertTrue((self.out / "links.dds").exists())


if __name__ == "__main__":
    os.chdir(pathlib.Path(sys.argv[2]))
    main()
