#!/usr/bin/env python3
"""A program of 28 lines by the installed library draws what `tegument render` draws, bit for bit.

    client_test.py setup BUILD SOURCE COMPILER LAUNCHER    installs into a fresh prefix and builds docs/samples/client against it
    client_test.py draw BUILD PART PARTS                   every technique of every effect: the first of each on the default head, others on the Bunny
    client_test.py draw BUILD PART PARTS both              on both of them
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

SMALL = ["-D", "TEGUMENT_MAP_SIZE=64", "--size", "40x40"]
BUNNY = pathlib.Path("/usr/share/glmark2/models/bunny.obj")
SKIPPED = 77


def run(words, **options):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}\nended with {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def setup(build, source, compiler, launcher):
    work = build / "client_test"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    run(["cmake", "--install", build, "--prefix", work / "package", "--strip"], env={**os.environ, "TEGUMENT_NO_PRECOMPILE": "1"})
    run(["cmake", "-S", source / "docs/samples/client", "-B", work / "client", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={work / 'package'}",
         f"-DCMAKE_CXX_COMPILER={compiler}", f"-DCMAKE_CXX_COMPILER_LAUNCHER={launcher}", "-DCMAKE_BUILD_TYPE=Release"])
    run(["cmake", "--build", work / "client"])
    lines = (source / "docs/samples/client/main.cpp").read_text(encoding="utf-8").splitlines()
    if len(lines) > 30:
        sys.exit(f"the client has {len(lines)} lines, at most 30")
    linked = set(re.findall(r"libtegument_(\w+)\.a", run(["ninja", "-C", work / "client", "-t", "commands", "client"])))
    if not {"assets", "run", "gpu"} <= linked:
        sys.exit(f"the client links {sorted(linked)}: this test looks for the wrong names")
    own = {path.name for path in (source / "tools").iterdir() if path.is_dir()} | {"app", "lab_app"}
    if linked & own:
        sys.exit(f"the client links something of tools/: {sorted(linked & own)}")


def meshes():
    cache = os.environ.get("TEGUMENT_CACHE") or os.path.join(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"), "tegument")
    found = [mesh for mesh in (pathlib.Path(cache, "human/human.glb"), BUNNY) if mesh.exists()]
    if len(found) < 2:
        print("skipped: the default head or the Bunny is missing; ./bootstrap test brings both")
        sys.exit(SKIPPED)
    return found


def techniques(tegument, share):
    for effect in sorted([*(share / "effects").glob("*.fx"), *(share / "effects/peers").glob("*.fx")]):
        for number, technique in enumerate(json.loads(run([tegument, "info", effect, "--json"]))["techniques"]):
            yield effect, technique["name"], number == 0


def outcome(words, picture):
    """The picture's bytes, or the code of the first error."""
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False)
    if done.returncode == 0:
        return picture.read_bytes()
    text = done.stdout + done.stderr
    return text[text.index("error TG"):].split(":")[0] if "error TG" in text else f"ended with {done.returncode}: {text}"


def draw(build, part, parts, both):
    work = build / "client_test"
    tegument, client = work / "package/bin/tegument", work / "client/client"
    drawn = refused = 0
    for number, (effect, technique, first) in enumerate(techniques(tegument, work / "package/share/tegument")):
        for mesh in meshes():
            if not both and first == (mesh == BUNNY) or number % parts != part:
                continue
            ours, theirs = (work / f"{name}_{part}.exr" for name in ("client", "program"))
            mine = outcome([client, effect, "-t", technique, *SMALL, mesh, "-o", ours], ours)
            wanted = outcome([tegument, "render", effect, "-t", technique, *SMALL, "--mesh", mesh, "-o", theirs], theirs)
            if mine != wanted:
                sys.exit(f"{effect.name} {technique} on {mesh.name}: the client's differs from the program's: "
                         f"{mine if isinstance(mine, str) else 'a picture'}, {wanted if isinstance(wanted, str) else 'a picture'}")
            drawn, refused = drawn + isinstance(mine, bytes), refused + isinstance(mine, str)
    if drawn <= 2 * refused:
        sys.exit(f"only {drawn} pictures, {refused} refused")
    print(f"{drawn} pictures are the same bits, {refused} refused alike")


if __name__ == "__main__":
    build = pathlib.Path(sys.argv[2])
    if sys.argv[1] == "setup":
        setup(build, pathlib.Path(sys.argv[3]), *(sys.argv[4:] + [""])[:2])
    else:
        draw(build, int(sys.argv[3]), int(sys.argv[4]), sys.argv[5:] == ["both"])
