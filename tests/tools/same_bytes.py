#!/usr/bin/env python3
"""Whether two programs, as of two processors or compilers, write the same bytes: the front end, prep, fur and baked maps.

    same_bytes.py PROGRAM OTHER [--only TEXT]     each one word, with what runs it: "qemu-aarch64-static -L FOLDER build/arm64/tegument"
    same_bytes.py PROGRAM                         against itself on one processor

Effects are those of effects/, meshes those that `prep shape` makes. A row for each case; of files that differ, how many bytes do and the first of them.
Exit code 1 when something differs.
"""

import argparse
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
EFFECTS = ["Main", "Beckmann", "Pyramid", "FurCoat"]
SHAPES = {"ball": ["sphere", "--detail", "8"], "hills": ["terrain", "--detail", "16"], "torus": ["torus"], "cube": ["cube"]}
SECONDS = re.compile(rb'"seconds": *\{[^}]*\}')  # what is measured is no result
PREPARED = {"default": [], "warp": ["--overdraw", "--cache", "fifo:16"], "hoppe": ["--order", "hoppe"], "tipsify": ["--order", "tipsify"],
            "lin-yu": ["--order", "lin-yu"], "sums": ["--normals", "sum"], "box": ["--centre", "box"], "openmesh": ["--levels-by", "openmesh"],
            "half": ["--vertex", "half"], "unorm16": ["--vertex", "unorm16"], "unwrap": ["--unwrap"], "levels by meshoptimizer": ["--levels", "4"]}


def cases(folder):
    """Name, arguments, and whether what is printed counts. {} is the folder of the program at hand; both read the first one's meshes."""
    for name in EFFECTS:
        yield f"info {name}", ["info", name, "--json"], True
        yield f"flatten {name}", ["flatten", name], True
    yield "flatten --library", ["flatten", "--library"], True
    for name, shape in SHAPES.items():
        yield f"prep shape {name}", ["prep", "shape", *shape, "-o", f"{{}}/{name}.ply"], False
    for name in ("ball", "hills"):
        for how, options in PREPARED.items():
            levels = [] if "--levels" in options or how == "openmesh" else ["--levels", "1"]
            yield f"prep {name}, {how}", ["prep", folder / f"{name}.ply", "-o", f"{{}}/{name}-{how}.glb", *options, *levels], False
    unwrapped = folder / "ball-unwrap.glb"
    yield "fur texture", ["fur", "texture", "--size", "64", "-o", "{}/fur"], False
    yield "fur roots", ["fur", "roots", unwrapped, "--count", "2000", "-o", "{}/roots.dds"], False
    yield "fur strands", ["fur", "strands", unwrapped, "--count", "2000", "-o", "{}/strands.glb"], False
    yield "prep environment --sky", ["prep", "environment", "--sky", "-o", "{}/sky.dds"], False
    yield "prep environment --studio", ["prep", "environment", "--studio", "-o", "{}/studio.dds"], False
    yield "prep occlusion", ["prep", "occlusion", unwrapped, "--size", "32", "--rays", "64", "-o", "{}/occlusion.dds"], False
    yield "prep links", ["prep", "links", unwrapped, "-o", "{}/links.dds"], False


def files(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def to_one_processor():
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


def ask(program, arguments, folder, prints, before_it=None):
    """What there is afterwards: new files, and what was printed. Text instead where it failed."""
    before = set(files(folder))
    ran = subprocess.run([*program, *(str(argument).replace("{}", str(folder)) for argument in arguments)], cwd=ROOT, capture_output=True, check=False,
                         preexec_fn=before_it)
    if ran.returncode != 0:
        return ran.stderr.decode(errors="replace").strip().splitlines()[-1:] or [f"exit code {ran.returncode}"]
    made = {name: content for name, content in files(folder).items() if name not in before}
    made = {name: SECONDS.sub(b"", content) if name.endswith(".json") else content for name, content in made.items()}
    return {**made, "what is printed": ran.stdout} if prints else made


def difference(name, a, b):
    if len(a) != len(b):
        return f"{name}: {len(a)} and {len(b)} bytes"
    places = [i for i, (x, y) in enumerate(zip(a, b)) if x != y]
    return f"{name}: {len(places)} of {len(a)} bytes, the first at {places[0]}" if places else ""


def differences(first, second):
    if isinstance(first, list) or isinstance(second, list):
        return [] if first == second else [f"{first if isinstance(first, list) else 'made'} and {second if isinstance(second, list) else 'made'}"]
    names = sorted({*first, *second})
    return [text for text in (difference(name, first.get(name, b""), second.get(name, b"")) for name in names) if text]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=shlex.split)
    parser.add_argument("other", nargs="?", type=shlex.split)
    parser.add_argument("--only", default="")
    parser.add_argument("--may-differ", default="$.", metavar="PATTERN", help="cases whose names it fits are told, and not counted")
    arguments = parser.parse_args()
    failed = compared = 0
    with tempfile.TemporaryDirectory(prefix="tegument-same-") as place:
        folders = [pathlib.Path(place, name) for name in ("first", "second")]
        for folder in folders:
            folder.mkdir()
        for name, words, prints in cases(folders[0]):
            if arguments.only not in name and "shape" not in name and "unwrap" not in name:
                continue
            made = [ask(arguments.program, words, folders[0], prints),
                    ask(arguments.other or arguments.program, words, folders[1], prints, None if arguments.other else to_one_processor)]
            wrong = differences(*made)
            if not re.search(arguments.may_differ, name):
                failed, compared = failed + bool(wrong), compared + 1
            print(f"{name}: {'; '.join(wrong) if wrong else 'the same ' + (made[0][0] if isinstance(made[0], list) else 'bytes')}", flush=True)
    print(f"{compared - failed} of {compared} are the same")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
