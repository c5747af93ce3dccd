#!/usr/bin/env python3
"""The window of `tegument view` on the default head, as docs/view.md shows it: docs/images/view.py. Needs ./bootstrap test and demo."""

import pathlib
import subprocess
import sys

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = str(REPOSITORY / "build" / "release" / "tegument")
sys.path.insert(0, str(REPOSITORY / "tests" / "view"))
sys.argv = [sys.argv[0], PROGRAM, str(REPOSITORY)]

import session  # noqa: E402

SIZE = (1280, 800)

view = session.View(("Pyramid", "--set", "TEGUMENT_SURROUNDINGS=1", "--set", "TEGUMENT_LAMPS=3", "--set", "gSurroundings=0.35"), size=SIZE, screen=SIZE)
try:
    view.title("picture")
    view.still()
    view.screen.move(SIZE[0] - 3, SIZE[1] - 3)
    picture = view.folder / "view.png"
    view.still().save(picture)
    subprocess.run([PROGRAM, "sheet", str(picture), "-o", str(REPOSITORY / "docs" / "images" / "view.jpg")], check=True)
finally:
    view.end()
