#!/usr/bin/env python3
"""The licence's name in each source: licence.py --check | --write [ROOT]. Exit code of --check: 1 where one is missing, and its path.

The first line, behind `#!` the second. Of effects and of what they include the last: their lines are what messages name. Inputs of tests have none.
"""

import pathlib
import sys

MARK = "SPDX-License-Identifier: MIT"
SLASHES, SHADERS, HASHES = {".cpp", ".h", ".js"}, {".fx", ".fxh", ".hlsl"}, {".py", ".sh", ".cmake"}
OUTSIDE = {"build", "out", "__pycache__", "node_modules", "corpus", "fixtures"}


def comment_of(path, text):
    """How a line of the file becomes a comment; none where it is no source."""
    if path.suffix in SLASHES or path.suffix in SHADERS:
        return "// "
    return "# " if path.suffix in HASHES or path.name == "CMakeLists.txt" or (not path.suffix and text.startswith("#!")) else None


def sources(folder, top=True):
    for path in sorted(folder.iterdir()):
        if path.is_symlink() or path.name in OUTSIDE or (path.name[0] == "." and path.name != ".ci"):
            continue
        if path.is_dir():
            yield from sources(path, False)
        elif path.suffix in SHADERS and "tests" in path.parts:
            continue
        elif path.suffix in SLASHES | SHADERS | HASHES or path.name == "CMakeLists.txt" or not path.suffix:
            text = path.read_bytes().decode("utf-8", "replace")
            if comment := comment_of(path, text):
                yield path, text, comment + MARK + "\n"


def marked(path, text, line):
    if path.suffix in SHADERS:
        return text + line
    if text.startswith("#!"):
        first, rest = text.split("\n", 1)
        return f"{first}\n{line}{rest}"
    return line + text


def main(arguments):
    if not arguments or arguments[0] not in ("--check", "--write") or len(arguments) > 2:
        print(__doc__.split(".", 1)[0], file=sys.stderr)
        return 2
    root = pathlib.Path(arguments[1] if len(arguments) == 2 else ".")
    without = [(path, text, line) for path, text, line in sources(root) if line not in text]
    for path, text, line in without:
        if arguments[0] == "--write":
            path.write_bytes(marked(path, text, line).encode())
        else:
            print(f"{path}: does not name its licence; python3 tests/tools/licence.py --write")
    return 1 if without and arguments[0] == "--check" else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
