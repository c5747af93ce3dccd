#!/usr/bin/env python3
"""Every `tegument` line of README.md and of the users' pages names what the program has: `commands_test.py TEGUMENT [ROOT]`.

Nothing is drawn. Of each line the command, its options, effects, techniques, presets, workspaces and the parameters of --set are looked up
in `tegument COMMAND --help`, `tegument list --json` and `tegument info EFFECT --json`.
"""

import functools
import json
import pathlib
import re
import shlex
import subprocess
import sys

import repository

OPTIONS_OF_ALL = {"--help", "--version", "-h"}
DRAWING = {"render", "view", "check", "info"}


def commands_of(text):
    """(line number, command) of the indented lines that call the program; what follows three spaces or a # is prose."""
    for number, line in enumerate(text.splitlines(), 1):
        match = re.match(r" {4}(?:build/release/)?tegument (.*)", line)
        if match:
            yield number, re.split(r"\s{3,}|\s+#\s|\s+\|\s+man ", match[1])[0]


class Program:
    def __init__(self, path):
        self.path = path

    @functools.cache
    def output(self, *arguments):
        done = subprocess.run([self.path, *arguments], capture_output=True, text=True, check=False)
        return done.stdout if done.returncode == 0 else ""

    @functools.cache
    def effects(self):
        listed = json.loads(self.output("list", "--json"))
        return {effect["name"]: effect for effect in listed["effects"]}

    def workspaces(self):
        return {workspace["name"] for workspace in json.loads(self.output("list", "--json"))["workspaces"]}

    def options(self, words):
        return set(re.findall(r"(?<![\w-])--?[A-Za-z][\w-]*", self.output(*words, "--help"))) | OPTIONS_OF_ALL

    def parameters(self, effect, defines=()):
        """None where the program cannot read the effect."""
        text = self.output("info", effect, "--json", *(word for name in defines for word in ("-D", name)))
        return {one["name"] for one in json.loads(text)["parameters"] + json.loads(text).get("switches", [])} if text else None

    def subcommand(self, words):
        """The words at the beginning that are commands: `prep human`, `fur roots`, or one."""
        if not self.output(words[0], "--help"):
            return []
        below = re.split(r"^Subcommands:$", self.output(words[0], "--help"), flags=re.M)[1:]
        names = re.findall(r"^ {2}(\w+)", below[0], re.M) if below else []
        return words[:2] if len(words) > 1 and words[1] in names else words[:1]


def value_after(words, *names):
    return next((words[i + 1] for i, word in enumerate(words[:-1]) if word in names), None)


def faults_of_effect(program, words):
    name = words[1] if len(words) > 1 else ""
    effect = program.effects().get(pathlib.PurePath(name).stem)
    if not effect:
        return  # the reader's own file, or a name in capitals
    technique, preset = value_after(words, "-t", "--technique"), value_after(words, "-p", "--preset")
    workspace = value_after(words, "-w", "--workspace")
    if technique and technique not in effect["techniques"]:
        yield f"{name} has no technique {technique}"
    if preset and preset not in effect["presets"]:
        yield f"{name} has no preset {preset}"
    if workspace and "." not in workspace and workspace not in program.workspaces():
        yield f"no workspace {workspace}"
    pairs = list(zip(words, words[1:]))
    defines = tuple(given for option, given in pairs if option in ("-D", "--define") or option in ("-s", "--set") and given.startswith("TEGUMENT_"))
    for i, word in enumerate(words):
        parameter = words[i + 1].split("=")[0] if word in ("-s", "--set") else ""
        known = program.parameters(effect["name"], defines) if parameter else None
        if parameter and known is None:
            yield f"{name} cannot be read"
        elif parameter and parameter not in known:
            yield f"{name} has no parameter {parameter}"


def faults(program, command):
    """What the program lacks of a command."""
    synopsis = "[" in command or "|" in command
    words = re.findall(r"[\w.*/=-]+", command) if synopsis else shlex.split(command)
    found = program.subcommand(words)
    if not found:
        yield f"no command {words[0]}"
        return
    options = program.options(found)
    for word in words:
        if re.match(r"--?[A-Za-z]", word) and word.split("=")[0] not in options:
            yield f"{' '.join(found)} has no option {word}"
    if not synopsis and found[0] in DRAWING:
        yield from faults_of_effect(program, words)


def main(arguments):
    program = Program(arguments[0])
    root = pathlib.Path(arguments[1] if len(arguments) > 1 else pathlib.Path(__file__).resolve().parents[2])
    count, wrong = 0, []
    for page in [root / "README.md", *repository.user_pages(root)]:
        for number, command in commands_of(repository.text_of(page)):
            count += 1
            wrong += [f"{page}:{number}: {fault}: tegument {command}" for fault in faults(program, command)]
    print("\n".join(wrong) or f"{count} commands are right")
    return 1 if wrong or not count else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
