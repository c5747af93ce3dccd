#!/usr/bin/env python3
"""clang-tidy over the tree: `tidy.py CLANG_TIDY BUILD [PATTERN]`, with the checks of .clang-tidy. What `cmake --build BUILD --target tidy` runs.

A source that passed before is not looked at again unless it, a header of ours that it includes, its command or the checks have changed: BUILD/tidy
remembers. PATTERN is a regular expression for paths from the root. Exit code 0: no findings, 1: some.
"""

import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]


@functools.cache
def included(path):
    """Our headers that a file names; they are named from the root, and a few from their own folder."""
    text = path.read_text(encoding="utf-8", errors="replace")
    named = (candidate / name for name in re.findall(r'^\s*#\s*include\s+"([^"]+)"', text, re.M) for candidate in (ROOT, path.parent))
    return frozenset(header.resolve() for header in named if header.is_file())


def with_headers(path):
    known, open_ = set(), [path]
    while open_:
        current = open_.pop()
        if current not in known:
            known.add(current)
            open_ += included(current)
    return sorted(known)


def configurations(path):
    """.clang-tidy of the root and of the folders down to a file: a folder's adds to those above it."""
    folders = [folder for folder in reversed(path.parents) if folder.is_relative_to(ROOT)]
    return [folder / ".clang-tidy" for folder in folders if (folder / ".clang-tidy").is_file()]


def key_of(program, path, command):
    digest = hashlib.sha256()
    digest.update(subprocess.run([program, "--version"], capture_output=True, check=True).stdout)
    digest.update(command.encode())
    for part in [*configurations(path), *with_headers(path)]:
        digest.update(part.read_bytes())
    return digest.hexdigest()


def without_precompiled_headers(entries, folder):
    """The same commands with copies of CMake's precompiled headers, beside which no compiler has put what only it can read."""
    for entry in entries:
        for header in set(re.findall(r"\S+/cmake_pch\.hxx(?=\s)", entry["command"])):
            copy = folder / hashlib.sha256(header.encode()).hexdigest()[:16] / "cmake_pch.hxx"
            copy.parent.mkdir(exist_ok=True)
            copy.write_bytes(pathlib.Path(header).read_bytes())
            entry["command"] = entry["command"].replace(header, str(copy))
    (folder / "compile_commands.json").write_text(json.dumps(entries), encoding="utf-8")
    return entries


def look(program, build, path, command):
    stamp = build / "tidy" / key_of(program, path, command)
    if stamp.exists():
        return path, ""
    done = subprocess.run([program, "--quiet", "-p", str(build / "tidy"), str(path)], capture_output=True, text=True, check=False)
    if done.returncode == 0:
        stamp.touch()
        return path, ""
    return path, done.stdout or done.stderr


def main(arguments):
    program, build = arguments[0], pathlib.Path(arguments[1])
    pattern = re.compile(arguments[2] if len(arguments) > 2 else "(host|meshprep|tests|docs)/")
    (build / "tidy").mkdir(exist_ok=True)
    entries = without_precompiled_headers(json.loads((build / "compile_commands.json").read_text(encoding="utf-8")), build / "tidy")
    commands = {pathlib.Path(entry["file"]).resolve(): entry["command"] for entry in entries}
    chosen = sorted(path for path in commands if path.is_relative_to(ROOT) and pattern.match(str(path.relative_to(ROOT))))
    flawed = 0
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        waiting = [pool.submit(look, program, build, path, commands[path]) for path in chosen]
        for number, one in enumerate(concurrent.futures.as_completed(waiting), 1):
            path, findings = one.result()
            flawed += bool(findings)
            print(f"[{number}/{len(chosen)}] {path.relative_to(ROOT)}" + (f"\n{findings}" if findings else ""), flush=True)
    print(f"{len(chosen)} sources, {flawed} with findings")
    return 1 if flawed or not chosen else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
