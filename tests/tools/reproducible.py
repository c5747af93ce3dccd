#!/usr/bin/env python3
"""Two builds in two folders are the same bytes: reproducible.py REPOSITORY [--target NAME]... [--jobs N] [--install] [-D NAME=VALUE]...

Copies the tree into two folders whose paths differ in length, and builds each: with another time zone, locale, home, mask of permissions, number of
jobs and order of the files of a folder, and seconds later. Without a cache of compiled objects. Then compares what was built: programs, libraries,
and with --install all that is installed, the effects compiled for engines among it. Exit code 1 where a byte differs, with the place.
"""

import argparse
import filecmp
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

BUILT = ("*.a", "*.so", "*.exe", "*.hlsl", "tegument")
ALONE = ["TEGUMENT_TESTS=OFF", "TEGUMENT_LAB=OFF"]
# What a build may depend on by mistake.
SURROUNDINGS = [
    {"TZ": "UTC", "LC_ALL": "C.UTF-8", "umask": 0o022, "folder": "a"},
    {"TZ": "Pacific/Kiritimati", "LC_ALL": "C", "umask": 0o077, "folder": "another folder/of a much longer name"},
]


def run(command, folder, surroundings):
    environment = dict(os.environ, TZ=surroundings["TZ"], LC_ALL=surroundings["LC_ALL"], CCACHE_DISABLE="1", HOME=str(folder.parent))
    done = subprocess.run(command, cwd=folder, env=environment, umask=surroundings["umask"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} failed in {folder}:\n{done.stdout[-3000:]}")


def copied(repository, folder, backwards):
    """Files that are made in another order are listed in another order on many file systems."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=repository, capture_output=True, text=True, check=False)
    names = [name for name in listed.stdout.split("\0") if name] if listed.returncode == 0 else [
        str(path.relative_to(repository)) for path in repository.rglob("*") if path.is_file() and path.relative_to(repository).parts[0] not in ("build", ".git", "out")]
    for name in sorted(names, reverse=backwards):
        if (repository / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(repository / name, folder / name)


def build(arguments, top, surroundings, jobs, backwards):
    folder = top / surroundings["folder"] / "tegument"
    copied(arguments.repository, folder, backwards)
    definitions = [f"-D{definition}" for definition in [*ALONE, *arguments.define]]
    run(["cmake", "--preset", "release", *definitions], folder, surroundings)
    run(["nice", "ninja", "-C", "build/release", f"-j{jobs}", *arguments.target], folder, surroundings)
    if arguments.install:
        run(["cmake", "--install", "build/release", "--prefix", folder / "installed"], folder, surroundings)
    return folder


def built(folder):
    found = {path.relative_to(folder) for pattern in BUILT for path in (folder / "build/release").rglob(pattern) if path.is_file() and "CMakeFiles" not in path.parts}
    return found | {path.relative_to(folder) for path in (folder / "installed").rglob("*") if path.is_file()}


def difference(first, second):
    """The first byte that differs, with what stands around it."""
    a, b = first.read_bytes(), second.read_bytes()
    at = next((i for i, (x, y) in enumerate(zip(a, b)) if x != y), min(len(a), len(b)))
    around = slice(max(0, at - 24), at + 24)
    return f"{len(a)} and {len(b)} bytes, from byte {at}: {a[around]!r} and {b[around]!r}"


def compare(first, second):
    files, others = built(first), built(second)
    wrong = [f"{name}: one build only" for name in sorted(files ^ others)]
    for name in sorted(files & others):
        if not filecmp.cmp(first / name, second / name, shallow=False):
            wrong.append(f"{name}: {difference(first / name, second / name)}")
    size = sum((first / name).stat().st_size for name in files)
    print("\n".join([*wrong, f"{len(files)} files, {size / 1e6:.1f} MB, {len(wrong)} differ"]))
    return 1 if wrong or not files else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("repository", type=pathlib.Path)
    parser.add_argument("--target", action="append", help="what is built; default: tegument, with --install all")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--install", action="store_true")
    parser.add_argument("-D", "--define", action="append", default=[], metavar="NAME=VALUE")
    arguments = parser.parse_args()
    arguments.repository = arguments.repository.resolve()
    arguments.target = arguments.target or ["all" if arguments.install else "tegument"]
    with tempfile.TemporaryDirectory(prefix="tegument-twice-") as folder:
        top = pathlib.Path(folder)
        folders = [build(arguments, top, surroundings, jobs, backwards)
                   for surroundings, jobs, backwards in zip(SURROUNDINGS, (arguments.jobs, max(1, arguments.jobs - 1)), (False, True))]
        return compare(*folders)


if __name__ == "__main__":
    sys.exit(main())
