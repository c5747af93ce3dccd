#!/usr/bin/env python3
"""united_test.py SOURCE FOLDER COMPILER [-D NAME=VALUE]...: a quick build with laboratory and tests, whose rooms are compiled as one source each.

What two sources of a room keep to themselves under one name is seen nowhere else. Nothing is made: the compiler only reads.
"""

import json
import pathlib
import re
import shlex
import subprocess
import sys

source, folder, compiler, *definitions = sys.argv[1:]
configured = subprocess.run(["cmake", "-S", source, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_CXX_COMPILER={compiler}",
                             "-DTEGUMENT_LAB=ON", "-DTEGUMENT_TESTS=ON", "-DTEGUMENT_VIEWER=ON", "-DTEGUMENT_LSP=ON", "-DTEGUMENT_BATCH=ON",
                             "-DTEGUMENT_HUMAN=ON", "-DTEGUMENT_QUICK=ON", *definitions], capture_output=True, text=True, check=False)
if configured.returncode != 0:
    sys.exit("a quick build of all does not configure\n" + configured.stdout + configured.stderr)
built = re.compile(r"/tests/(gpu|order/draw)/")  # they include shaders that the build compiles
units = [entry for entry in json.loads(pathlib.Path(folder, "compile_commands.json").read_text(encoding="utf-8"))
         if re.search("/(lab|tests)/.*/Unity/", entry["file"]) and not built.search(entry["file"])]
if len(units) < 50:  # 6 of the laboratory, 50 of tests
    sys.exit(f"only {len(units)} rooms of laboratory and tests are compiled as one source")
for unit in units:
    words = shlex.split(re.sub(r" -o \S+ -c ", " -fsyntax-only ", unit["command"]))
    ran = subprocess.run(words, cwd=unit["directory"], capture_output=True, text=True, check=False)
    if ran.returncode != 0:
        sys.exit(f"{unit['file']} does not compile: name what two sources of a room keep to themselves differently\n{ran.stderr[:4000]}")
print(f"{len(units)} rooms")
