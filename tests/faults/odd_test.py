#!/usr/bin/env python3
"""What nobody expects: files that are none or have no end, and surroundings that lack what every machine has. One clear message, the right exit
code; no crash, no hang. usage: odd_test.py TEGUMENT REPOSITORY
"""

import os
import pathlib
import resource
import shutil
import signal
import struct
import subprocess
import threading
import time

from harness import Faults, MACHINE, OLD, PROGRAM, main

NOBODY = 65534
MIB = 1 << 20
MESHES = ("obj", "ply", "stl", "off", "glb", "gltf")
PICTURES = ("png", "jpg", "hdr", "dds", "exr")


def limited(kind, value):
    return lambda: resource.setrlimit(kind, (value, value))


class OddFiles(Faults):
    def command(self, path):
        ending = path.suffix[1:]
        if ending in PICTURES:
            return ["compare", path, path]
        return {"fx": ["info", path], "json": ["render", "OriginalTexture", "-w", path, "-o", self.out / "x.png"]}.get(ending, ["prep", path, "--dry-run"])

    def test_what_has_no_end_is_not_read_for_ever(self):
        for ending in ("obj", "png", "dds", "fx", "json"):
            path = self.folder / f"zero.{ending}"
            path.symlink_to("/dev/zero")
            self.refused(self.run_it(*self.command(path)), "TG5001", str(path), "gives more than 1024 MiB", code=1)
        with open("/dev/zero", "rb") as zeros:
            ran = self.run_it("batch", "--list", "-", "--results", self.folder / "results", "--", "prep", "{}", stdin=zeros)
        self.refused(ran, "TG5001", "standard input: ", "gives more than 1024 MiB", code=1)

    def test_a_pipe_without_a_writer_is_said(self):
        started = {}
        for ending in ("obj", "png", "fx", "json"):  # beside each other: each waits for some seconds
            path = self.folder / f"pipe.{ending}"
            os.mkfifo(path)
            started[path] = self.start(*self.command(path))
        for path, process in started.items():
            out, err = process.communicate(timeout=60)
            self.assertIn(process.returncode, (1, 2), err)
            self.refused(subprocess.CompletedProcess(path, process.returncode, out, err), str(path), code=process.returncode)

    def test_what_a_pipe_gives_is_what_a_file_gives(self):
        pipe = self.folder / "pipe.fx"
        os.mkfifo(pipe)
        effect = "float4 gColor < string UIName = \"Colour\"; > = { 1, 2, 3, 4 };\n" + "// long\n" * 50_000
        (self.folder / "file.fx").write_text(effect, encoding="ascii")

        def write():
            with open(pipe, "w", encoding="ascii") as out:
                out.write(effect[:10])
                out.flush()
                time.sleep(0.2)  # a slow writer is no end
                out.write(effect[10:])
        writer = threading.Thread(target=write, daemon=True)
        writer.start()
        piped = self.good("info", pipe).stdout
        writer.join(60)
        self.assertIn("gColor", piped)
        self.assertEqual(piped.replace("pipe.fx", "file.fx"), self.good("info", self.folder / "file.fx").stdout)

    def test_files_larger_than_memory_are_said(self):
        """Sparse: they take no place on the disk. Of 5 GiB with a limit, as counts of 32 bits are beyond them; of 8 TiB with all memory."""
        for size, limit in ((5 << 30, ["--max-memory", "900"]), (8 << 40, [])):
            for ending in (*MESHES, *PICTURES, "json"):
                path = self.folder / f"sparse.{ending}"
                try:
                    with open(path, "wb") as file:
                        file.truncate(size)
                except OSError:
                    continue  # more than this file system has
                ran = self.run_it(*self.command(path), *limit)
                self.refused(ran, "memory", str(path))
                self.assertRegex(ran.stderr, "TG(8001|5311)")

    def test_folders_are_no_files(self):
        for ending in (*MESHES, *PICTURES, "fx", "json"):
            path = self.folder / f"folder.{ending}"
            path.mkdir()
            ran = self.run_it(*self.command(path))
            self.refused(ran, f"{path} is a folder, not a", code=2)
            self.assertNotIn("did you mean", ran.stderr)

    def test_a_file_that_changes_while_it_is_read_is_read_or_refused(self):
        end = threading.Event()
        wholes = {self.ball: self.ball.read_bytes()}
        picture, effect = self.folder / "changing.png", self.folder / "changing.fx"
        self.good(*self.picture())
        wholes[picture] = (self.out / "picture.png").read_bytes()
        wholes[effect] = ("float4 gColor = { 1, 2, 3, 4 };\n" * 2000).encode()
        for path, whole in wholes.items():
            path.write_bytes(whole)

        def change():
            at = 0
            while not end.is_set():
                for path, whole in wholes.items():
                    at = (at * 7 + 12345) % len(whole)
                    with open(path, "r+b") as file:  # the same file, cut and longer: not a new one in its place
                        file.truncate(at)
                        file.seek(0, 2)
                        file.write(whole[at:] + (b"\n" if at % 2 else b""))
        changer = threading.Thread(target=change, daemon=True)
        changer.start()
        try:
            for _ in range(12):
                for path in wholes:
                    ran = self.run_it(*self.command(path))
                    self.assertIn(ran.returncode, (0, 1), ran.stdout + ran.stderr)
                    self.assertNotIn("TG8002", ran.stderr)
        finally:
            end.set()
            changer.join(60)


class OddSizes(Faults):
    """The smallest and the largest: drawn, or one message. What is larger than a driver's memory is refused before it is made."""

    def mesh(self, name, *places, coordinates=True):
        path = self.folder / f"{name}.obj"
        corners = "f 1/1 2/2 3/3\n" if coordinates else "f 1 2 3\n"
        path.write_text("".join("v %r %r %r\n" % place for place in places) + ("vt 0 0\nvt 1 0\nvt 0 1\n" if coordinates else "") + corners, encoding="ascii")
        return path

    def size_of(self, path):
        return struct.unpack(">II", path.read_bytes()[16:24])

    def test_the_smallest_pictures_and_maps(self):
        for size in ("1", "1x7", "7x1", "1x2048", "2048x1"):
            self.good("render", "Specular", "--mesh", self.ball, "--size", size, "-o", self.out / "small.png")
            self.assertEqual(self.size_of(self.out / "small.png"), tuple(map(int, size.split("x"))) if "x" in size else (1, 1))
        for maps in (["--map-size", "1"], ["--map-size", "1", "--shadow-size", "1"], ["--map-size", "3", "--shadow-size", "1"]):
            for effect in ("Main", "Pyramid") if maps == ["--map-size", "1"] else ("Main",):
                self.good("render", effect, "--mesh", self.ball, "--size", "24", *maps, "-o", self.out / "small.png")

    def test_sizes_beyond_the_largest(self):
        for size in ("0", "0x8", "-1", "99999999999999999999", "8x", "1e3"):
            self.refused(self.run_it("render", "Beckmann", "--size", size, "-o", self.out / "x.png"), "TG8010", code=2)
        self.refused(self.run_it("render", "Beckmann", "--size", "16385", "-o", self.out / "x.png"), "TG4004", code=2)
        for side in ("0", "16385", "99999999999"):
            for option in ("--map-size", "--shadow-size"):
                self.refused(self.run_it("render", "Main", "--mesh", self.ball, option, side, "-o", self.out / "x.png"), "TG8005", code=2)

    def test_what_the_driver_has_no_memory_for(self):
        """Each takes more than the 2 GiB that Mesa 22's lavapipe has; a device with more draws them, or says the same."""
        for size, samples, *more in (("16384", "1"), ("16384", "4"), ("64", "1", "--shadow-size", "16384", "--map-size", "64"), ("64", "1", "--map-size", "16384")):
            ran = self.run_it("render", "Main", "--mesh", self.ball, "--size", size, "--samples", samples, *more, "-o", self.out / "x.png")
            if ran.returncode != 0:
                self.assertIn(ran.returncode, (1, MACHINE), ran.stderr)
                self.refused(ran, "TG60", "smaller", code=ran.returncode)
                self.assertFalse((self.out / "x.png").exists())

    def test_a_mesh_of_one_triangle_of_any_size(self):
        for scale in (1, 1e30, 1e-30, 1e38, 1e-44):
            mesh = self.mesh("one", (0.0, 0.0, 0.0), (scale, 0.0, 0.0), (0.0, scale, 0.0))
            self.good("prep", mesh, "-o", self.out / "one.glb")
            self.good("prep", mesh, "--unwrap", "-o", self.out / "one.glb")
            for effect in ("Specular", "FurCoat") if scale in (1, 1e38, 1e-44) else ("Specular",):
                self.good("render", effect, "--mesh", mesh, "--size", "24", "-o", self.out / "one.png")

    def test_a_mesh_without_area(self):
        line = self.mesh("line", (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (2.0, 0.0, 0.0))
        point = self.mesh("point", *[(5.0, 5.0, 5.0)] * 3, coordinates=False)
        for mesh in (line, point):
            for effect in ("Specular", "FurCoat"):
                self.refused(self.run_it("render", effect, "--mesh", mesh, "--size", "24", "-o", self.out / "x.png"), "TG5306", "has an area", code=1)
        for words in ((line,), (line, "--unwrap")):
            self.refused(self.run_it("prep", *words, "-o", self.out / "x.glb"), "TG7020", "on one line", code=1)
        self.refused(self.run_it("prep", point, "-o", self.out / "x.glb"), "TG7020", code=1)

    def test_a_mesh_of_more_memory_than_there_may_be(self):
        """A grid of 180,000 triangles; a larger one by hand: docs/design/reliability.md."""
        grid = self.folder / "grid.ply"
        self.good("prep", "shape", "terrain", "--detail", "300", "-o", grid)
        for command, codes in ((["prep", grid, "-o", self.out / "grid.glb"], "TG(5311|70..|8001|8027)"),
                               (["render", "Specular", "--mesh", grid, "--size", "24", "-o", self.out / "grid.png"], "TG(5311|6008|8001|8027|6007|6002|6006)")):
            self.good(*command)
            pathlib.Path(command[-1]).unlink()
            for most in (20, 30, 40, 50):
                ran = self.run_it(*command, "--max-memory", most)
                if ran.returncode != 0:
                    self.assertRegex(ran.stderr, codes)
                    self.refused(ran)
                    self.assertEqual(list(self.out.glob("grid.[pg]*")), [])
                pathlib.Path(command[-1]).unlink(missing_ok=True)


class OddPlaces(Faults):
    def commands(self):
        """They need no more than a cache, a compiler and a driver."""
        return {
            "picture.png": ["render", "Beckmann", "--size", "48", "-o", self.out / "picture.png"],
            "mesh.glb": ["prep", self.ball, "-o", self.out / "mesh.glb"],
            "emitted": ["check", "Beckmann", "--target", "spirv-glslang", "--emit", self.out / "emitted"],
            "batch.ply": ["batch", "-i", self.ball, "--results", self.out / "results", "--", "prep", "{}", "-o", str(self.out / "batch.ply")],
        }

    def all_good(self, **more):
        for name, command in self.commands().items():
            shutil.rmtree(self.out)
            self.out.mkdir()
            self.out.chmod(0o777)
            self.good(*command, **more)
            self.assertTrue((self.out / name).exists(), name)

    def good_or_said(self, *words, **more):
        """Each command does its work, or says in one message what is missing: no signal, no failure that nobody expected."""
        said = 0
        for command in (*self.commands().values(), ["info", "Main"], ["survey", "effects/peers", "--target", "none"]):
            ran = self.run_it(*command, **more)
            self.assertIn(ran.returncode, (0, 1, 2, MACHINE), f"{command}: {ran.stdout}{ran.stderr}")
            self.assertNotIn("TG8002", ran.stderr, command)
            if ran.returncode != 0:
                said += 1
                self.assertEqual(ran.stderr.count("error TG"), 1, f"{command}: {ran.stderr}")
                if words:
                    self.assertTrue(any(word in ran.stderr for word in words), ran.stderr)
        return said

    def test_a_working_folder_that_was_removed(self):
        gone = ["sh", "-c", 'cd "$(mktemp -d)" && rmdir "$PWD" && exec "$@"', "-", str(PROGRAM)]
        for name, command in self.commands().items():
            ran = subprocess.run([*gone, *map(str, command)], capture_output=True, text=True, env=self.environment, timeout=300, check=False)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            self.assertTrue((self.out / name).exists(), name)
        ran = subprocess.run([*gone, "render", "Beckmann", "--size", "8", "-o", "here.png"], capture_output=True, text=True, env=self.environment, timeout=300,
                             check=False)
        self.refused(ran, "TG5002", "cannot write here.png")

    def test_a_folder_for_temporary_files_that_is_none(self):
        for place in ("/nonexistent/x", str(self.ball), "/proc", ""):
            self.all_good(environment={"TMPDIR": place})

    def test_no_variables_at_all(self):
        for name in ("HOME", "TEGUMENT_CACHE", "XDG_CACHE_HOME", "PATH", "LANG", "TMPDIR", "USER"):
            self.environment.pop(name, None)
        self.environment["XDG_CACHE_HOME"] = str(self.folder / "cache")  # not in the place of whoever runs the tests
        self.all_good()

    def test_a_home_that_is_no_place_and_a_locale_and_a_zone_that_nobody_knows(self):
        self.all_good(environment={"LC_ALL": "xx_YY.nonsense", "LANG": "zz", "TZ": "Nowhere/At-All", "HOME": "no/place", "TERM": "none"})

    def test_as_many_variables_as_the_system_takes(self):
        self.all_good(environment={f"VARIABLE_{i}": "x" * 100_000 for i in range(18)})

    def test_a_cache_on_a_full_disk(self):
        mount = ["unshare", "--map-root-user", "--mount", "sh", "-c", f'mount -t tmpfs -o size=16k none "{self.folder}/cache" && exec "$@"', "-"]
        if subprocess.run([*mount, "true"], capture_output=True, check=False).returncode != 0:
            return  # this user may mount nothing; `a cache that cannot be written costs time only` was tried in any case
        needs = {"fur": ["render", "Fur", "--mesh", self.ball, "--size", "48", "-o", self.out / "fur.png"],
                 "coat": ["render", "FurCoat", "--mesh", self.ball, "--size", "48", "-o", self.out / "coat.png"]}
        for name, command in {**self.commands(), **needs}.items():
            ran = subprocess.run([*mount, str(PROGRAM), *map(str, command)], capture_output=True, text=True, errors="replace", env=self.environment,
                                 cwd=PROGRAM.parent, timeout=300, check=False)
            if name in needs:
                self.refused(ran, "TG5002", "No space left", "TEGUMENT_CACHE=FOLDER")
            else:
                self.assertEqual(ran.returncode, 0, f"{name}: {ran.stderr}")
        self.assertEqual(self.leftovers(), [])

    def test_no_kernel_file_system_and_no_devices(self):
        for place in ("/proc", "/dev"):
            mount = ["unshare", "--map-root-user", "--mount", "sh", "-c", f'mount -t tmpfs none {place} && exec "$@"', "-"]
            if subprocess.run([*mount, "true"], capture_output=True, check=False).returncode != 0:
                return
            ran = subprocess.run([*mount, str(PROGRAM), "prep", str(self.ball), "-o", str(self.out / "mesh.glb")], capture_output=True, text=True,
                                 env=self.environment, timeout=300, check=False)
            self.assertEqual(ran.returncode, 0, ran.stderr)

    def as_nobody(self, before):
        """What is to be done before the program begins, and as a user without rights where these tests run as root and he may run it."""
        for folder in (self.folder, *(self.folder / name for name in ("out", "cache", "temporary", "home"))):
            folder.chmod(0o777)

        def become():
            before()
            if os.getuid() == 0:
                os.setgroups([])
                os.setgid(NOBODY)
                os.setuid(NOBODY)
        try:
            return become if self.run_it("--version", preexec_fn=lambda: (os.setgid(NOBODY), os.setuid(NOBODY))).returncode == 0 else before
        except (OSError, subprocess.SubprocessError):
            return before

    def test_files_that_their_owner_may_not_read(self):
        """umask 777, and a cache folder that is made with it."""
        become = self.as_nobody(lambda: os.umask(0o777))
        self.good_or_said("Permission denied", preexec_fn=become, environment={"TEGUMENT_CACHE": str(self.folder / "cache/new")})
        self.good_or_said("Permission denied", preexec_fn=become)

    def test_no_thread_to_be_had(self):
        become = self.as_nobody(limited(resource.RLIMIT_NPROC, 0))
        if subprocess.run(["true"], preexec_fn=become, check=False).returncode != 0:
            return  # not even that can be run
        self.good_or_said("TG8027", "TG6", "TG5003", "TG4071", preexec_fn=become)

    def test_few_open_files(self):
        for most in (4, 6, 8, 12, 16):
            if self.run_it("--version", preexec_fn=limited(resource.RLIMIT_NOFILE, most)).returncode != 127:  # the loader needs some before us
                self.good_or_said(preexec_fn=limited(resource.RLIMIT_NOFILE, most))

    def test_a_small_stack(self):
        self.all_good(preexec_fn=limited(resource.RLIMIT_STACK, 256 * 1024))

    def test_memory_that_ends_anywhere(self):
        """Also where it ends in the driver or in a library under it, which do not look whether they were given any."""
        said = 0
        for most in (1, 4, 12, 16, 24, 32, 40, 48, 56, 60, 64, 68, 72, 76, 80):
            ran = self.run_it(*self.picture("memory.png"), "--max-memory", most)
            self.assertIn(ran.returncode, (0, MACHINE), f"{most} MiB: {ran.stderr}")
            if ran.returncode == MACHINE:
                said += 1
                self.assertEqual(ran.stderr.count("error TG"), 1, f"{most} MiB: {ran.stderr}")
                self.assertRegex(ran.stderr, "TG(8001|8027|6002|6006|6007|6008)", most)
                self.assertFalse((self.out / "memory.png").exists())
            (self.out / "memory.png").unlink(missing_ok=True)
        self.assertGreater(said, 5, "otherwise this tests nothing")
        self.good(*self.picture("memory.png"), "--max-memory", "400")

    def test_a_death_is_said(self):
        """By a signal as from a fault of ours or of the driver: a line says so, and whoever waits still sees the signal."""
        for number in (signal.SIGSEGV, signal.SIGABRT, signal.SIGBUS):
            process = self.start("prep", "links", self.ball, "-o", self.out / "links.dds")
            while process.poll() is None and not self.catches(process, number):
                time.sleep(0.01)
            process.send_signal(number)
            _, err = process.communicate(timeout=60)
            self.assertEqual(process.returncode, -number, err)
            self.assertEqual(err.count("error TG8002: unexpected failure: signal"), 1, err)
            self.assertFalse((self.out / "links.dds").exists())

    @staticmethod
    def catches(process, number):
        with open(f"/proc/{process.pid}/status", encoding="ascii") as status:
            caught = next(line for line in status if line.startswith("SigCgt:"))
        return bool(int(caught.split()[1], 16) >> (number - 1) & 1)

    def test_who_is_stopped_and_goes_on(self):
        """Some calls of the system end early then, as after a signal that has a handler."""
        for name, command in self.commands().items():
            process = self.start(*command)
            while process.poll() is None:
                for number in (signal.SIGSTOP, signal.SIGCONT, signal.SIGWINCH):
                    process.send_signal(number)
                    time.sleep(0.002)
            out, err = process.communicate(timeout=300)
            self.assertEqual(process.returncode, 0, out + err)
            self.assertTrue((self.out / name).exists(), name)

    def test_a_mesh_that_may_not_be_read_and_one_that_is_written_to(self):
        secret = self.folder / "secret.obj"
        shutil.copy(self.ball, secret)
        secret.chmod(0)
        ran = self.run_it("prep", secret, "--dry-run", preexec_fn=self.as_nobody(lambda: None))
        if ran.returncode != 0:
            self.refused(ran, "TG5001", "Permission denied", code=1)
        same = self.folder / "same.ply"
        self.good("prep", self.ball, "-o", same)
        before = same.read_bytes()
        self.refused(self.run_it("prep", same, "-o", same), "TG5004", code=2)
        self.assertEqual(same.read_bytes(), before, "what preparation would leave out is there still")


if __name__ == "__main__":
    main()
