#!/usr/bin/env python3
"""The machine fails: disks, streams, caches, libraries, drivers, Wine. One clear message, the right exit code, nothing lost and nothing half
written. usage: machine_test.py TEGUMENT REPOSITORY LAYER_FOLDER OTHER_DXC
"""

import json
import os
import random
import resource
import shutil
import signal
import subprocess
import sys

from harness import Faults, KEPT, MACHINE, OLD, main

LAYER, OTHER_DXC = sys.argv[3], sys.argv[4]


def at_most(size):
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


class Streams(Faults):
    def test_a_full_standard_output_is_said(self):
        for arguments in (["info", "Main"], ["list", "--json"], ["check", "Beckmann", "--target", "spirv-glslang"], self.picture()):
            with open("/dev/full", "w", encoding="ascii") as full:
                self.refused(self.run_it(*arguments, stdout=full), "TG8090", "No space left")
        self.assertTrue((self.out / "picture.png").read_bytes().startswith(b"\x89PNG"))

    def test_a_full_standard_error_changes_no_exit_code(self):
        with open("/dev/full", "w", encoding="ascii") as full:
            self.assertEqual(self.run_it("render", "Nowhere", "-o", self.out / "x.png", stderr=full).returncode, 2)
            self.assertEqual(self.run_it(*self.picture(), stderr=full).returncode, 0)

    def test_a_pipe_that_nobody_reads_costs_no_file(self):
        ends = os.pipe()
        os.close(ends[0])
        with os.fdopen(ends[1], "w") as closed:
            self.assertIn(self.run_it(*self.picture(), stdout=closed).returncode, (-signal.SIGPIPE, MACHINE))
        self.good("compare", self.out / "picture.png", self.out / "picture.png")

    def test_closed_streams_are_no_files_of_ours(self):
        def close():
            for number in range(3):
                os.close(number)
        self.assertEqual(self.run_it(*self.picture("closed.png"), preexec_fn=close).returncode, 0)
        self.good(*self.picture("open.png"))
        self.assertEqual((self.out / "closed.png").read_bytes(), (self.out / "open.png").read_bytes())


class Disks(Faults):
    def commands(self):
        return {
            "picture.exr": ["render", "Beckmann", "--size", "256", "-o", self.out / "picture.exr"],
            "mesh.glb": ["prep", self.ball, "-o", self.out / "mesh.glb"],
            "roots.dds": ["fur", "roots", self.ball, "-o", self.out / "roots.dds"],
        }

    def driver_is_limited_itself(self):
        """Mesa 25's lavapipe keeps its memory in files without names, and does not see that the limit cuts them: no picture, however small, can be drawn."""
        small = ["render", "Beckmann", "--size", "8", "-o", self.folder / "small.png"]
        return self.run_it(*small, preexec_fn=at_most(4096)).returncode == -signal.SIGBUS

    def test_a_file_beyond_the_limit_leaves_the_one_before(self):
        for name, command in self.commands().items():
            (self.out / name).write_bytes(OLD)
            if command[0] == "render" and self.driver_is_limited_itself():
                continue
            self.refused(self.run_it(*command, preexec_fn=at_most(4096)), "TG5002", "File too large")
            self.assertEqual((self.out / name).read_bytes(), OLD)
        self.assertEqual(self.leftovers(), [])

    def test_a_full_disk_leaves_the_file_before(self):
        """A file system of 16 KiB, where this user may mount one in a name space of his own; else the limit above is all that can be tried."""
        mount = ["unshare", "--map-root-user", "--mount", "sh", "-c", 'mount -t tmpfs -o size=16k none "$0" && exec "$@"', str(self.out)]
        if subprocess.run([*mount, "true"], capture_output=True, check=False).returncode != 0:
            return self.test_a_file_beyond_the_limit_leaves_the_one_before()
        see = 'printf old > "$0"; "$@"; code=$?; printf ":%s:" "$(ls -A "$(dirname "$0")")"; cat "$0"; exit $code'
        for name, command in self.commands().items():
            program = self.start("--version").args[0]
            ran = subprocess.run([*mount, "sh", "-c", see, str(self.out / name), str(program), *map(str, command)], capture_output=True, text=True, errors="replace",
                                 env=self.environment, check=False, timeout=300)
            self.refused(ran, "TG5002", "No space left")
            self.assertTrue(ran.stdout.endswith(f":{name}:old"), ran.stdout)

    def test_what_cannot_be_written_is_said_before_the_work(self):
        (self.folder / "file").write_bytes(OLD)
        for place in ("/proc", self.folder / "file", "/dev/null"):
            for command in (["render", "Main", "--size", "4096", "--turntable", "900", "-o", f"{place}/x.webp"],
                            ["prep", self.ball, "-o", f"{place}/x.glb"]):
                self.refused(self.run_it(*command), "TG5002", f"{place}/x.")

    def test_devices_pipes_and_links_stay_what_they_are(self):
        link, pipe = self.out / "link.json", self.out / "pipe.json"
        (self.folder / "target.json").write_bytes(OLD)
        link.symlink_to(self.folder / "target.json")
        self.good("prep", self.ball, "--report", link, "--dry-run")
        self.assertTrue(link.is_symlink())
        json.loads((self.folder / "target.json").read_text())
        os.mkfifo(pipe)
        reader = subprocess.Popen(["cat", pipe], stdout=subprocess.PIPE)
        self.good("prep", self.ball, "--report", pipe, "--dry-run")
        json.loads(reader.communicate(timeout=60)[0])
        self.assertTrue(pipe.is_fifo())
        self.refused(self.run_it("prep", self.ball, "--report", "/dev/full", "--dry-run"), "TG5002", "No space left")


class Names(Faults):
    def test_any_path_will_do(self):
        folder = self.out / "with blanks" / "\u00fcn\u00ef \u982d \U0001f600" / "a'b\"c$d;e"
        folder.mkdir(parents=True)
        mesh = folder / "my head.obj"
        shutil.copy(self.ball, mesh)
        self.good("prep", mesh, "-o", folder / "my head.glb")
        self.good("render", "OriginalTexture", "--mesh", folder / "my head.glb", "--size", "32", "-o", folder / "a b.png")
        self.good(*self.picture("n" * 251 + ".png"))
        self.good(*self.picture("n" * 251 + ".png"))  # once more: it is there

    def test_a_path_too_long_is_said(self):
        long = "d/" * 2046
        self.refused(self.run_it("render", "Beckmann", "-o", f"/{long}x.png"), "TG5002", "name too long")
        self.refused(self.run_it("render", "Beckmann", "-o", self.out / ("n" * 4096 + ".png")), "TG5002", "name too long")
        self.refused(self.run_it("prep", f"/{long}x.obj", "-o", self.out / "x.glb"), "TG8008", code=2)
        self.refused(self.run_it("render", "n" * 4096 + ".fx", "-o", self.out / "x.png"), "TG8006", code=2)

    def test_a_decimal_comma_changes_nothing(self):
        places = self.folder / "locales"
        places.mkdir()
        subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", str(places / "de_DE.UTF-8")], capture_output=True, check=False)
        german = {"LOCPATH": str(places), "LC_ALL": "de_DE.UTF-8", "LANG": "de_DE.UTF-8"}
        command = ["render", "Specular", "--mesh", self.ball, "--size", "48", "--set", "gRoughness=0.25"]
        self.good(*command, "-o", self.out / "plain.png")
        self.good(*command, "-o", self.out / "german.png", environment=german)
        self.assertEqual((self.out / "plain.png").read_bytes(), (self.out / "german.png").read_bytes())
        self.good("prep", self.ball, "-o", self.out / "plain.ply")
        self.good("prep", self.ball, "-o", self.out / "german.ply", environment=german)
        self.assertEqual((self.out / "plain.ply").read_bytes(), (self.out / "german.ply").read_bytes())


class Caches(Faults):
    def drawn(self, name="picture.png", environment=None):
        self.good("render", "Specular", "--mesh", self.ball, "--size", "48", "-o", self.out / name, environment=environment)
        return (self.out / name).read_bytes()

    def shaders(self):
        files = sorted((self.folder / "cache/spirv").glob("*.bin"))
        self.assertGreaterEqual(len(files), 2)
        return files

    def test_a_damaged_cache_is_made_again(self):
        expected = self.drawn()
        good = [file.read_bytes() for file in self.shaders()]
        dice = random.Random(23)
        damages = [lambda b: b"", lambda b: b[: len(b) // 2], lambda b: b + b"x", lambda b: b[:7] + b"0" + b[8:],
                   lambda b: bytes(dice.randrange(256) for _ in b)]
        for at in (0, 9, 40, 41, 60, 200):
            damages.append(lambda b, at=at: b[:at] + bytes([b[at] ^ 1 << dice.randrange(8)]) + b[at + 1:])
        for damage in damages:
            for file in self.shaders():
                file.write_bytes(damage(file.read_bytes()))
            self.assertEqual(self.drawn(), expected)
            self.assertEqual([file.read_bytes() for file in self.shaders()], good)

    def test_what_was_made_and_is_damaged_is_made_again(self):
        for command, made in ((["render", "Fur", "--mesh", self.ball], "fur/made"), (["render", "Pyramid", "-t", "PyramidLinked", "--mesh", self.ball], "skin/made")):
            picture = self.out / "made.png"
            command = [*command, "--size", "48", "--map-size", "128", "-o", picture]
            self.good(*command)
            expected = picture.read_bytes()
            files = [file for file in (self.folder / "cache" / made).rglob("*") if file.is_file()]
            self.assertTrue(files)
            damages = (lambda b: b[: len(b) // 2], lambda b: b"", lambda b: b"x" * len(b))
            for damage in damages if made == "skin/made" else damages[:1]:  # the cube map takes seconds to make
                for file in files:
                    file.write_bytes(damage(file.read_bytes()))
                self.good(*command)
                self.assertEqual(picture.read_bytes(), expected)

    def test_four_processes_share_an_empty_cache(self):
        for _ in range(3):
            shutil.rmtree(self.folder / "cache")
            together = [self.start("render", "Specular", "--mesh", self.ball, "--size", "48", "-o", self.out / f"{i}.png") for i in range(4)]
            for process in together:
                _, err = process.communicate(timeout=300)
                self.assertEqual(process.returncode, 0, err)
            self.assertEqual(len({(self.out / f"{i}.png").read_bytes() for i in range(4)}), 1)
        self.assertEqual([file for file in (self.folder / "cache").rglob("*tegument*")], [])

    def test_a_cache_that_cannot_be_written_costs_time_only(self):
        expected = self.drawn()
        for place in ("/proc/nowhere", "/dev/null", str(self.ball)):
            self.assertEqual(self.drawn(environment={"TEGUMENT_CACHE": "", "XDG_CACHE_HOME": "", "HOME": place}), expected)
        ran = self.run_it("render", "Fur", "--mesh", self.ball, "-o", self.out / "x.png", environment={"TEGUMENT_CACHE": "/dev/null/x"})
        self.refused(ran, "TG5002", "TEGUMENT_CACHE=FOLDER")

    def test_a_clock_that_goes_back_hides_no_change(self):
        expected = self.drawn()
        for file in self.shaders():
            os.utime(file, (4e9, 4e9))
        self.assertEqual(self.drawn(), expected)
        batch = ["batch", "-i", self.ball, "--results", self.folder / "results", "--", "prep", "{}", "-o", str(self.out / "{name}.ply")]
        self.good(*batch)
        before = (self.out / "ball.ply").read_bytes()
        self.ball.write_text(self.ball.read_text().replace("v 0.000000 90.", "v 0.000000 95."), encoding="ascii")
        os.utime(self.ball, (1e8, 1e8))
        self.good(*batch)
        self.assertNotEqual((self.out / "ball.ply").read_bytes(), before)


class Missing(Faults):
    def layer(self, fault):
        return {"VK_LAYER_PATH": LAYER, "VK_INSTANCE_LAYERS": "VK_LAYER_TEGUMENT_fault", "TEGUMENT_FAULT": fault}

    def test_no_driver(self):
        broken = self.folder / "driver.json"
        broken.write_text('{"file_format_version": "1.0.0", "ICD": {"library_path": "/nowhere/libvulkan_none.so", "api_version": "1.3.0"}}')
        for driver in ("/nonexistent.json", str(broken), str(self.ball)):
            self.refused(self.run_it(*self.picture(), environment={"VK_DRIVER_FILES": driver, "VK_ICD_FILENAMES": driver}), "TG6002", "install")

    def test_a_driver_that_is_too_old(self):
        self.refused(self.run_it(*self.picture(), environment=self.layer("old:1")), "TG6005", "it offers Vulkan 1.1, and 1.3 is needed")

    def test_a_driver_without_optional_features(self):
        self.good(*self.picture("all.png"))
        self.good(*self.picture("none.png"), environment=self.layer("bare:1"))
        self.assertEqual((self.out / "all.png").read_bytes(), (self.out / "none.png").read_bytes())
        # Storage images without a format are what compute passes write: refused, not drawn wrong.
        ran = self.run_it("render", "Pyramid", "-t", "PyramidCompute", "--mesh", self.ball, "--size", "48", "--map-size", "128", "-o",
                          self.out / "compute.png", environment=self.layer("bare:1"))
        self.refused(ran, "TG6", "device")

    def test_no_compiler_library_or_another(self):
        self.checked("Beckmann", "--target", "spirv-dxc")
        for library, word in (("/nonexistent.so", "cannot open shared object"), (str(self.ball), "invalid ELF"),
                              ("libz.so.1", "is no DXC"), (OTHER_DXC, "another version")):
            named = {"TEGUMENT_DXC": library}
            self.refused(self.run_it(*self.picture(), environment=named), "TG8015", word)
            checked = self.run_it("check", "Beckmann", "--target", "spirv-dxc", environment=named)
            self.assertEqual(checked.returncode, MACHINE)
            self.assertIn(word, checked.stderr)
            self.good(*self.picture(), "--compiler", "glslang", environment=named)

    def test_wine_that_dies(self):
        programs = self.folder / "programs"
        programs.mkdir()
        wine = programs / "wine"
        library = self.folder / "d3dcompiler_47.dll"
        library.write_bytes(b"MZ")
        for script in ("echo cannot load ntdll >&2; exit 1", "kill -9 $$", "echo begin 0; exit 1", "echo begin 0; echo '{\"ok\": 7}'", "echo '{'; echo begin 99999999999"):
            wine.write_text(f"#!/bin/sh\n{script}\n", encoding="ascii")
            wine.chmod(0o755)
            prefix = self.folder / "cache/wine"
            prefix.mkdir(parents=True, exist_ok=True)
            (prefix / "system.reg").write_text("", encoding="ascii")
            # No display is opened: with a name for one, nothing but the driver of Microsoft's compiler is wanted of the machine.
            ran = self.checked("Beckmann", "--target", "fx_5_0", environment={"PATH": f"{programs}:{os.environ['PATH']}", "DISPLAY": ":none",
                                                                             "TEGUMENT_D3DCOMPILER": str(library)})
            self.assertIn(ran.returncode, (1, MACHINE), script + ran.stderr)
            self.assertIn("TG3104", ran.stdout + ran.stderr, script)
            self.assertNotIn("unexpected failure", ran.stderr, script)
        self.assertEqual(self.leftovers(), [])

    def test_wine_that_dies_while_slots_are_counted(self):
        """What compiles and cannot be measured has not passed: the limits of Direct3D 9 are part of the check."""
        here = {"TEGUMENT_CACHE": str(KEPT)}  # with the compiler, and Wine's folder
        self.assertEqual(self.checked("Beckmann", "--target", "fx_2_0", environment=here).returncode, 0)
        programs = self.folder / "programs"
        programs.mkdir()
        wine = programs / "wine"
        # The second call's jobs are listings of what the first has compiled; the list's path is an argument, with Wine's drive before it.
        wine.write_text(f"""#!/bin/bash
for argument in "$@"; do
    path="${{argument#?:}}"
    if [[ $path = *jobs.txt ]] && grep -q ^listing "${{path//\\\\//}}"; then echo the disk is gone >&2; exit 1; fi
done
exec {shutil.which("wine")} "$@"
""", encoding="ascii")
        wine.chmod(0o755)
        ran = self.checked("Beckmann", "--target", "fx_2_0", environment={**here, "PATH": f"{programs}:{os.environ['PATH']}"})
        self.assertEqual(ran.returncode, 1, ran.stdout + ran.stderr)
        self.assertIn("TG3104", ran.stdout + ran.stderr)


if __name__ == "__main__":
    main()
