#!/usr/bin/env python3
"""The rooms of host, meshprep, tools and lab: `rooms.py [ROOT]` prints each with its sources, its lines of code and the rooms that it includes.

A room is a folder with C++ in it; its folder `windows` is part of it. They come in an order in which each includes only rooms above it; what is in a cycle, or includes one that is,
comes last and is marked. Lines of code are those with more than blanks and comments.
"""

import pathlib
import re
import sys

SOURCES = {".cpp", ".h"}
TOPS = ("host", "meshprep", "tools", "lab")
COMMENT = r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|//[^\n]*|/\*.*?\*/'


def room_of(folder):
    return folder.removesuffix("/windows")


def sources(root):
    """(room, path) of every source."""
    for top in TOPS:
        for path in sorted((root / top).rglob("*")):
            if path.suffix in SOURCES:
                yield room_of(path.relative_to(root).parent.as_posix()), path


def includes(root):
    """For each room the others that its sources include."""
    found = {}
    for room, path in sources(root):
        names = re.findall(r'^#include "((?:host|meshprep|tools|lab)/[^"]+)/[^/"]+"', path.read_text(encoding="utf-8"), re.MULTILINE)
        found.setdefault(room, set()).update({room_of(name) for name in names} - {room})
    return found


def ordered(graph):
    """The rooms from which no way leads back, each behind those that it includes; and the others."""
    free = []
    while ready := sorted(room for room, others in graph.items() if room not in free and others & graph.keys() <= set(free)):
        free += ready
    return free, sorted(graph.keys() - set(free))


def code_lines(text):
    plain = re.sub(COMMENT, lambda match: match[0] if match[0][0] in "\"'" else re.sub(r"[^\n]", " ", match[0]), text, flags=re.S)
    return sum(1 for line in plain.splitlines() if line.strip())


def main(arguments):
    root = pathlib.Path(arguments[0]) if arguments else pathlib.Path(__file__).resolve().parents[2]
    graph = includes(root)
    free, cyclic = ordered(graph)
    count = {room: [0, 0] for room in graph}
    for room, path in sources(root):
        count[room][0] += 1
        count[room][1] += code_lines(path.read_text(encoding="utf-8"))
    print(f"{'room':24} {'sources':>7} {'lines':>6}  includes")
    for room in free + cyclic:
        print(f"{room:24} {count[room][0]:7} {count[room][1]:6}  {'(cycle) ' if room in cyclic else ''}{' '.join(sorted(graph[room]))}")
    print(f"{'':24} {sum(files for files, _ in count.values()):7} {sum(lines for _, lines in count.values()):6}  "
          f"{len(graph)} rooms, {sum(map(len, graph.values()))} edges, {len(cyclic)} rooms in or above a cycle")
    return 1 if cyclic else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
