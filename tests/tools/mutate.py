#!/usr/bin/env python3
"""Changes one constant or operator of the shaders at a time and asks whether a test turns red.

usage: mutate.py --build DIR [--sample N | --all] [--jobs 2] [--minutes M] [--seconds S] [--only TEXT] [--results FILE] [--list] [--report]

A mutant is a copy of hlsl/ and effects/ with one change. The test programs of DIR read the shaders from the folder that they run in, so nothing is
compiled in C++. At first every test runs once without a change, and what it compiles is noted. Each mutant then meets the tests that reach it: its function's
cases in double precision, those of functions that call it, and the tests that compile an entry point that leads to it: the ones that killed in
this file first, then the quickest. The first red one kills it. Where none of them compiled anything else than without the change, it has the same code.
Results are appended to FILE (build/mutation.jsonl) as they come: a run that was interrupted, or whose minutes are over, goes on where it stopped, and a
mutant of a file that has changed since is tried anew. Exit code 1 when fewer than 90 % are killed; those that have the same code or that
mutants_without_effect.txt explains do not count.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import sys
import threading
import time

from shader_tests import Reach, Trial, tests_of

ROOT = pathlib.Path(__file__).resolve().parents[2]
EQUIVALENT = pathlib.Path(__file__).with_name("mutants_without_effect.txt")
PASSING = 0.90

FUNCTIONS = "tests/hlsl/hlsl_tests"
CASE_FILE = "effects/function_test.hlsl"
CASES = re.compile(r"Hlsl/Functions\.\w+/(\w+?)_\d+_\w+")
# Test programs that draw, and tests that are not asked: they draw no shader of ours, compare what compilers say, or take minutes each.
PROGRAMS = [
    ("tests/run/run_tests", "EffectLayouts|^VertexHook"),
    ("tests/fur/drawn/fur_drawn_tests", "^$"),
    ("tests/fur/swept/fur_swept_tests", "^$"),
    ("tests/light/scene_light_tests", "^$"),
    ("tests/lab/verify/verify_tests", "^FullFur|^Full/Modules.*(_corrected|/Fur|/Pyramid|/Surroundings|/Lamps)|^Full/Sliders"),
    ("tests/peers/peer_tests", "^$"),
    ("tests/cli/app_tests", "^(?!Beckmann|EnergyAtt|FurMotion|FurPose|FurShells|FurStrands|LightUnits|Modules|Pictures|WhiteIrr|Backlit)|Modules.every"),
]
# How likely a test kills before any was seen to: references are, comparisons of two pictures of one shader are not.
STRICT, LIKELY, UNLIKELY = r"reference_says|computed_picture_is|compute_shaders_are|exact|is_the_difference_of", 0.8, 0.05
APART = {"^FurPose|^FurMotion|^FurStrands": "effects/FurCoat.fx", "^FurShells": "effects/Fur.fx"}  # tests with a cache of their own: what they draw
VALUES = r"^PublishedValues\."  # read the effects' values, and draw nothing
SHORTEST = 60  # seconds of the processor, and so many times what a test takes without a mutant: one that loops forever counts as killed
TIMES_LONGER = 8
MOST_RED = 8  # cases of functions without any mutant; more of them: something is missing
CHUNK = 24  # cases of functions in one process
MOST_OTHERS = 4 * CHUNK  # cases of callers, where no picture is asked either

SWAPS = {"+": "-", "-": "+", "*": "/", "/": "*", "<": ">=", ">": "<=", "<=": ">", ">=": "<", "==": "!=", "!=": "==", "&&": "||", "||": "&&",
         "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="}
CALLS = {"min": "max", "max": "min", "saturate": "", "abs": "", "ddx": "ddy", "ddy": "ddx", "sin": "cos", "cos": "sin", "normalize": "",
         "sqrt": "", "exp": "exp2"}
TOKEN = re.compile(r"(?P<number>(?<![\w.])\d+(?:\.\d*)?(?:[eE][-+]?\d+)?)|(?P<name>[A-Za-z_]\w*)|(?P<op>&&|\|\||[-+*/<>=!]=|\+\+|--|[-+*/<>])|(?P<rest>\S)")
INVOCATION = re.compile(r"^([A-Z][A-Z_0-9]*)\([^;{}]*\)$")  # a macro alone in its line, which defines functions
DEFINITION = re.compile(r"^(?:static |inline )?(?:void|bool|int|uint|half|float|[A-Z]\w*)(?:[1-4](?:x[1-4])?)? (\w+)\(", re.M)


def blanked(text):
    """The text with everything that is no code replaced by spaces: comments, strings, annotations, preprocessor lines but plain numbers."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match.group())
    text = re.sub(r"//[^\n]*|/\*.*?\*/", blank, text, flags=re.S)
    text = re.sub(r'"[^"\n]*"', blank, text)
    text = re.sub(r"<\s*(?:string|float[234]?|int|bool|[A-Z][A-Z_]*(?=\())\b[^<>]*>", blank, text)
    text = re.sub(r"#ifdef (?:FX|TEGUMENT_COMPUTE)_TECHNIQUES.*?#endif", blank, text, flags=re.S)
    text = re.sub(r"^#define[^\n]*\\\n(?:[^\n]*\\\n)*[^\n]*", blank, text, flags=re.M)
    lines = []
    for line in text.split("\n"):
        plain = re.match(r"#define\s+\w+\s+(?=[\d.]+\s*$)", line)
        lines.append(" " * plain.end() + line[plain.end():] if plain else " " * len(line) if line.startswith("#") else line)
    return "\n".join(lines)


def other_number(number, before):
    value = float(number)
    if before in "[":  # an index must stay one
        return "1" if value == 0 else str(int(value) - 1)
    if value == 0:
        return "1.0" if "." in number else "1"
    if "." not in number and "e" not in number.lower():
        return str(int(value) + 1)
    return repr(value * 1.1)


def is_binary(before):
    """Whether a + or - behind this token has a left operand."""
    return bool(before) and (re.fullmatch(r"[\w.]+", before) is not None or before in ")]") and before not in ("return", "else")


def declared(code, at):
    """Name of the constant or parameter whose definition holds this place outside of functions, empty where that cannot be told; and whether
    it is a constant, which only compilers read."""
    begin = max(code.rfind(end, 0, at) for end in (";", "\n}\n", "*/"))
    found = re.match(r"[;}\s]*([\w\s]*?)(\w+)\s*[\[<:=]", code[max(begin, 0):at])
    return (found.group(2), found.group(1).startswith("static const")) if found else ("", False)


class Mutant:
    def __init__(self, path, start, end, text, replacement, code=""):
        self.path, self.start, self.end, self.replacement = path, start, end, replacement
        self.original = text[start:end]
        self.line = text.count("\n", 0, start) + 1
        self.column = start - (text.rfind("\n", 0, start) + 1) + 1
        self.source = text.split("\n")[self.line - 1].strip()
        functions = [m for m in DEFINITION.finditer(text) if m.start() <= start]
        self.function = functions[-1].group(1) if functions and "\n}" not in text[functions[-1].start():start] else ""
        made = INVOCATION.match(self.source) if not self.function else None
        self.macro = made.group(1) if made else ""
        macro = re.match(r"#define\s+(\w+)", self.source)
        name, constant = (macro.group(1), False) if macro else declared(code or text, start)
        self.name = self.function or name
        self.is_code = bool(self.function) or constant  # which no program reads but compilers
        self.by_name = self.is_code or macro is not None
        self.id = hashlib.sha256(f"{path} {hashlib.sha256(text.encode()).hexdigest()} {start} {replacement}".encode()).hexdigest()[:16]

    def describe(self):
        return f"{self.path}:{self.line}:{self.column}: {self.original} -> {self.replacement or '(nothing)'}"

    def key(self):
        """What mutants_without_effect.txt names: survives edits elsewhere in the file."""
        return f"{self.path} | {self.source} | {self.column - self.indent()} | {self.original} -> {self.replacement or '(nothing)'}"

    def indent(self):
        line = (ROOT / self.path).read_text().split("\n")[self.line - 1]
        return len(line) - len(line.lstrip())


# tex2Dlod(map, float4(uv, 0.0, 0.0)): SampleLevel does not read the third coordinate, and level 1 of a map with one level is level 0.
LEVEL = re.compile(r"(?:tex2Dlod|TG_TEX2DLOD)\((?:(?!tex2Dlod|TG_TEX2DLOD)[^;])*?(, 0\.0, 0\.0\))")


def mutants_of(path):
    text = (ROOT / path).read_text()
    code = blanked(text)
    found, before = [], ""
    levels = [match.span(1) for match in LEVEL.finditer(text)]
    for token in TOKEN.finditer(code):
        kind, word = token.lastgroup, token.group()
        replacement = None
        if kind == "number":
            replacement = other_number(word, before)
        elif kind == "name" and text[token.end():token.end() + 1] == "(":
            replacement = CALLS.get(word)
        elif kind == "op" and word in SWAPS and (word not in "+-" or is_binary(before)):
            replacement = SWAPS[word]
        if replacement is not None:
            found.append(Mutant(path, token.start(), token.end(), text, replacement, code))
            found[-1].in_level = any(start <= token.start() < end for start, end in levels)
        before = word
    return found


def all_mutants():
    paths = sorted(str(p.relative_to(ROOT)) for folder in ("hlsl", "effects/passes") for p in (ROOT / folder).rglob("*.fxh"))
    return [m for path in paths if path != "hlsl/platform.fxh" for m in mutants_of(path)]


def sampled(mutants, count):
    """As many, spread evenly over files and lines by their ids, which do not depend on what else there is."""
    return sorted(sorted(mutants, key=lambda m: m.id)[:count], key=lambda m: (m.path, m.start))


class Record:
    """What each test compiles, and how long it takes: asked once of the tree without a change, and kept until shaders change."""

    def __init__(self, arguments):
        self.file, self.build = arguments.build / "mutation_tests.jsonl", arguments.build
        self.tests, self.lock = {}, threading.Lock()
        sources = b"".join(p.read_bytes() for p in sorted([*(ROOT / "hlsl").rglob("*.fxh"), *(ROOT / "effects").rglob("*.fx*")]))
        self.shaders = hashlib.sha256(sources).hexdigest()[:16]
        left_out = {program: but for program, but in PROGRAMS}
        for line in self.file.read_text().splitlines() if self.file.exists() else []:
            entry = json.loads(line)
            if entry["of"] == self.shaders and not re.search(left_out.get(entry["program"], "^$"), entry["test"]):
                self.tests[entry["test"]] = entry

    def check_functions(self, trial):
        """Cases of functions that are red without a mutant, as on another device: a few are left out, or every mutant would seem to die."""
        cases = [test for test in tests_of(self.build, FUNCTIONS) if CASES.fullmatch(test)]
        name, red = f"Hlsl/* ({len(cases)})", []
        if name not in self.tests:
            while failed := trial.ask(FUNCTIONS, f"Hlsl/*-{':'.join(red)}", 3600)[0]:
                if failed not in cases or len(red) == MOST_RED:
                    sys.exit(f"{FUNCTIONS} is red without any mutant: {failed}")
                red.append(failed)
            if trial.skipped:
                sys.exit(f"every case of {FUNCTIONS} is skipped here, so that no mutant could die: no device, or no validation layer")
            self.add((FUNCTIONS, name), ":".join(red), 0, {})
        return [case for case in cases if case not in self.tests[name]["red"].split(":")]

    def make(self, trials, wanted=""):
        """wanted: of which tests, a pattern; all by default."""
        for program, _ in PROGRAMS:
            if not wanted and not (self.build / program).exists():
                print(f"not asked, for it is not built: {program}", flush=True)
        names = [(program, test) for program, but in PROGRAMS if (self.build / program).exists() for test in tests_of(self.build, program)
                 if re.search(wanted, test) and not re.search(but, test) and test not in self.tests]
        if names:
            print(f"{len(names)} tests to look at first", flush=True)
        with concurrent.futures.ThreadPoolExecutor(len(trials)) as pool:
            free = list(trials)

            def look(named):
                with self.lock:
                    trial = free.pop()
                red, seconds = trial.ask(*named, 600)
                apart = {f"{effect} ? 0": [] for tests, effect in APART.items() if re.search(tests, named[1])}
                self.add(named, red, seconds, trial.compiled() or apart)
                with self.lock:
                    free.append(trial)

            list(pool.map(look, names))

    def add(self, named, red, seconds, shaders):
        entry = {"of": self.shaders, "program": named[0], "test": named[1], "red": red, "seconds": round(seconds, 2), "shaders": shaders}
        with self.lock:
            self.tests[named[1]] = entry
            with self.file.open("a") as file:
                file.write(json.dumps(entry) + "\n")
            if red:
                print(f"red without any mutant, not asked: {red}", flush=True)


class Plan:
    """Which tests a mutant meets, and in which order."""

    def __init__(self, arguments, record, cases):
        self.record, self.arguments, self.reach = record, arguments, Reach()
        self.cases = {}
        for test in cases:
            self.cases.setdefault(CASES.fullmatch(test).group(1), []).append(test)
        self.kills, self.asked, self.base, self.sure = {}, {}, {}, {}

    def of_functions(self, mutant):
        """Cases of the function itself, or of what this macro defines, then of those that call it, the nearest first."""
        if (mutant.function or mutant.macro) in self.cases:
            yield "function", self.cases[mutant.function or mutant.macro]
        callers = [name for name in self.cases if name != mutant.function and self.reach.leads(name, mutant.name)]
        callers.sort(key=lambda name: self.reach.steps(name, mutant.name))
        others = [test for name in callers for test in self.cases[name]][:None if self.arguments.seconds else MOST_OTHERS]
        for begin in range(0, len(others), CHUNK):
            yield "functions", others[begin:begin + CHUNK]

    def reaches(self, mutant, shader):
        file, entry, _ = shader.rsplit(" ", 2)
        return mutant.path in self.reach.included(file) and (not mutant.by_name or self.reach.leads(entry, mutant.name))

    def of_pictures(self, mutant):
        """Entries of the record: those that have killed in this file first, then the quickest."""
        def order(test):
            here, anywhere = (mutant.path, test["test"]), ("", test["test"])
            count = lambda of: 3 * of.get(here, 0) + of.get(anywhere, 0)
            return test["seconds"] * (count(self.asked) + 1) / (count(self.kills) + (LIKELY if re.search(STRICT, test["test"]) else UNLIKELY))
        near = [test for test in self.record.tests.values() if not test["red"] and
                (any(self.reaches(mutant, shader) for shader in test["shaders"]) or not mutant.function and re.match(VALUES, test["test"]))]
        return sorted(near, key=order)

    def is_sure(self, test, trial):
        """Whether it is green without a mutant by the program that there is now: asked when it kills for the first time."""
        if test["test"] not in self.sure:
            self.sure[test["test"]] = not trial.ask(test["program"], test["test"], SHORTEST + TIMES_LONGER * test["seconds"])[0]
        return self.sure[test["test"]]

    def note(self, mutant, test, red):
        for place in ((mutant.path, test), ("", test)):
            self.asked[place] = self.asked.get(place, 0) + 1
            self.kills[place] = self.kills.get(place, 0) + bool(red)


class Attempt:
    """One mutant in one copy of the tree."""

    def __init__(self, trial, plan, mutant):
        self.trial, self.plan, self.mutant = trial, plan, mutant
        self.path = trial.folder / mutant.path
        self.text = self.path.read_text()
        self.changed, self.drawn, self.seen, self.seconds, self.left = False, False, set(), 0.0, 0

    def changed_file(self):
        self.path.write_text(self.text[:self.mutant.start] + self.mutant.replacement + self.text[self.mutant.end:])

    def ask(self, program, tests, seconds):
        self.changed_file()
        red, used = self.trial.ask(program, tests, max(SHORTEST, TIMES_LONGER * seconds))
        self.path.write_text(self.text)
        self.seconds += used
        return red

    def compare(self, before, now):
        """Notes what was compiled alike."""
        for shader, codes in before.items():
            self.drawn = self.drawn or shader.startswith(CASE_FILE) or self.plan.reach.surely_leads(shader.rsplit(" ", 2)[1], self.mutant.name)
            if now.get(shader) == codes:
                self.seen.update((shader, code) for code in codes)
            else:
                self.changed = True

    def by_functions(self):
        for stage, tests in self.plan.of_functions(self.mutant):
            filter = ":".join(tests)
            if red := self.ask(FUNCTIONS, filter, len(tests)):
                return stage, red
            if not self.changed:
                now = self.trial.compiled()
                if filter not in self.plan.base:
                    if red := self.trial.ask(FUNCTIONS, filter, 600)[0]:
                        sys.exit(f"red without any mutant: {red}")
                    self.plan.base[filter] = self.trial.compiled()
                self.compare(self.plan.base[filter], now)
        return "", ""

    def by_pictures(self):
        budget = self.plan.arguments.seconds
        for test in self.plan.of_pictures(self.mutant):
            of_it = {(shader, code) for shader, codes in test["shaders"].items() for code in codes if self.plan.reaches(self.mutant, shader)}
            if self.mutant.is_code and of_it and of_it <= self.seen:
                continue  # it would compile what it compiles without the change
            if test["seconds"] > budget and not re.match(VALUES, test["test"]):
                self.left += 1
                continue
            budget -= test["seconds"]
            red = self.ask(test["program"], test["test"], test["seconds"])
            self.plan.note(self.mutant, test["test"], red)
            if red and self.plan.is_sure(test, self.trial):
                return pathlib.Path(test["program"]).name, red
            self.compare({s: c for s, c in test["shaders"].items() if self.plan.reaches(self.mutant, s)}, self.trial.compiled())
        return "", ""

    def result(self):
        stage, test = self.by_functions()
        if not stage:
            stage, test = self.by_pictures()
        all_asked = self.left == 0 and self.plan.arguments.seconds > 0  # without tests of pictures nothing is said of what they compile
        same = not stage and not self.changed and all_asked and self.mutant.is_code and self.drawn
        return {"id": self.mutant.id, "mutant": self.mutant.describe(), "stage": stage, "test": test, "seconds": round(self.seconds, 1),
                "left": self.left, "budget": self.plan.arguments.seconds, "same": same}


def read_results(path):
    results = {}
    if path.exists():
        for line in path.read_text().splitlines():
            entry = json.loads(line)
            results[entry["id"]] = entry
    return results


def explained():
    """Patterns of mutants that change nothing that can be seen, each with its reason."""
    rules = []
    if EQUIVALENT.exists():
        for line in EQUIVALENT.read_text().splitlines():
            if line.strip() and not line.startswith("#"):
                pattern, reason = line.split(" :: ", 1)
                rules.append((pattern.strip(), reason.strip()))
    return rules


def reason_for(mutant, rules):
    if mutant.in_level:
        return "a coordinate that is not read, and the level of a map that has one"
    return reason_in(rules, mutant.key())


def reason_in(rules, key):
    matches = lambda pattern: re.fullmatch(re.escape(pattern).replace(r"\*\*", ".*"), key)  # ** stands for anything
    return next((reason for pattern, reason in rules if matches(pattern)), None)


def print_table(what, rows):
    """Of rows [mutants, killed, without effect] by name; returns the share of mutants with an effect that were killed."""
    total = [sum(row[i] for row in rows.values()) for i in range(3)]
    print(f"| {what} | mutants | killed | without effect | survived | kill rate |\n|---|---|---|---|---|---|")
    for name, (count, killed, same) in [*sorted(rows.items()), ("**all**", total)]:
        rate = f"{100 * killed / (count - same):.1f} %" if count > same else "-"
        print(f"| {name} | {count} | {killed} | {same} | {count - killed - same} | {rate} |")
    return total[1] / max(1, total[0] - total[2])


def tried(mutant, results, rules):
    """Whether all that may be said of it is known: one that functions left alive must have met tests of pictures."""
    entry = results.get(mutant.id)
    return entry is not None and bool(entry["stage"] or entry.get("budget", 1) or reason_for(mutant, rules))


def report(mutants, results):
    """Prints the table of the first of them, by hash, that are tried without a gap; returns the share of those with an effect that were killed."""
    rules, rows, survivors, stages, same = explained(), {}, [], {}, 0
    ordered = sorted(mutants, key=lambda m: m.id)
    count = next((i for i, mutant in enumerate(ordered) if not tried(mutant, results, rules)), len(ordered))
    for mutant in ordered[:count]:
        entry, row = results[mutant.id], rows.setdefault(mutant.path, [0, 0, 0])
        row[0] += 1
        if entry["stage"]:
            row[1] += 1
            stages[entry["stage"]] = stages.get(entry["stage"], 0) + 1
        elif entry.get("same") or reason_for(mutant, rules):
            row[2] += 1
            same += entry.get("same", False)
        else:
            survivors.append((mutant, entry.get("left", 0)))
    rate = print_table("file", rows)
    print("\nkilled by: " + ", ".join(f"{stage} {count}" for stage, count in sorted(stages.items(), key=lambda s: -s[1])))
    print(f"of those without effect, the same code: {same}")
    for mutant, left in survivors:
        print(f"survived{f' ({left} tests not asked)' if left else ''}: {mutant.key()}")
    if count < len(ordered):
        killed = sum(1 for mutant in ordered[count:] if results.get(mutant.id, {}).get("stage"))
        print(f"the first {count} of {len(ordered)}, in the order of their hash; of the others {killed} are killed so far")
    return rate


def run(mutants, arguments, results):
    rules = explained()
    def open_still(m):
        known = results.get(m.id)
        if known is None or known["stage"] or known.get("same"):
            return known is None
        return not reason_for(m, rules) and (arguments.retry or bool(known.get("left") or not known["budget"]) and known["budget"] < arguments.seconds)
    todo = [m for m in mutants if open_still(m)]
    if not todo:
        return
    print(f"{len(mutants)} mutants, {len(todo)} to try", flush=True)
    until = time.monotonic() + 60 * arguments.minutes
    threads = max(1, (os.cpu_count() or 1) // arguments.jobs)
    trials = [Trial(arguments.build, number, threads) for number in range(arguments.jobs)]
    free, lock = list(trials), threading.Lock()
    try:
        record = Record(arguments)
        record.make(trials, "" if arguments.seconds else VALUES)
        plan = Plan(arguments, record, record.check_functions(trials[0]))

        def attempt(mutant):
            if time.monotonic() > until:
                return
            with lock:
                trial = free.pop()
            entry = Attempt(trial, plan, mutant).result()
            with lock:
                free.append(trial)
                results[mutant.id] = entry
                with arguments.results.open("a") as file:
                    file.write(json.dumps(entry) + "\n")
                ended = f"killed by {entry['stage']} {entry['test']}" if entry["stage"] else "same code" if entry["same"] else "SURVIVED"
                print(f"{len(results)}: {entry['seconds']} s: {mutant.describe()}: {ended}", flush=True)

        with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
            list(pool.map(attempt, sorted(todo, key=lambda m: m.id)))  # no order: what an interruption leaves is an even sample too
    finally:
        for trial in trials:
            trial.close()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "release", help="folder with the test programs")
    parser.add_argument("--sample", type=int, default=200, help="how many mutants")
    parser.add_argument("--all", action="store_true", help="all of them: hours")
    parser.add_argument("--only", default="", help="of them, those whose description holds this")
    parser.add_argument("--seconds", type=float, default=600, help="of the processor that tests of pictures may take per mutant; what is left is said")
    parser.add_argument("--retry", action="store_true", help="try survivors again: there are new tests")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--minutes", type=float, default=6000, help="no mutant is begun later")
    parser.add_argument("--results", type=pathlib.Path)
    parser.add_argument("--list", action="store_true", help="print the mutants and stop")
    parser.add_argument("--report", action="store_true", help="print the table of what is known and stop")
    arguments = parser.parse_args()
    arguments.build = arguments.build.resolve()
    arguments.results = arguments.results or arguments.build / "mutation.jsonl"

    mutants = all_mutants()
    if not arguments.all:
        mutants = sampled(mutants, arguments.sample)
    mutants = [m for m in mutants if arguments.only in m.describe()]
    if arguments.list:
        print("\n".join(m.key() for m in mutants))
        return 0
    results = read_results(arguments.results)
    if not arguments.report:
        run(mutants, arguments, results)
    return 0 if report(mutants, results) >= PASSING else 1


if __name__ == "__main__":
    sys.exit(main())
