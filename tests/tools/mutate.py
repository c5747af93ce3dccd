#!/usr/bin/env python3
"""Changes one constant or operator of the shaders at a time and asks whether a test turns red.

usage: mutate.py --build DIR [--sample N | --all] [--jobs 2] [--minutes M] [--only TEXT] [--results FILE] [--list] [--report]

A mutant is a copy of hlsl/ and effects/ with one change. The test programs of DIR read the shaders from the folder that they run in, so nothing is
compiled in C++. Tests run from the most likely to fail to the least: the functions in the changed line's function, all functions, every module against
its reference, whole pictures; the first red one kills the mutant. Without --all an even sample of N mutants is taken, the same ones every time.
Results are appended to FILE (build/mutation.jsonl) as they come: a run that was interrupted, or whose minutes are over, goes on where it stopped, and a
mutant of a file that has changed since is tried anew. Exit code 1 when fewer than 90 % are killed; those that equivalent.txt explains do not count.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
EQUIVALENT = pathlib.Path(__file__).with_name("mutants_without_effect.txt")
PASSING = 0.90

# Programs, and the tests in them that read the shaders. Seconds: a mutant that loops forever counts as killed.
FUNCTIONS = ("tests/hlsl/hlsl_tests", "Hlsl/*")
STAGES = [
    ("functions", *FUNCTIONS),
    ("modules", "tests/lab/verify/verify_tests", "Quick/Modules.*:ErrataMeasured.*"),
    ("runs", "tests/run/run_tests", "PublishedValues.*:MainEffect.*:*Inputs.*"),
    ("pictures", "tests/app/app_tests", "Pictures.*:EnergyAttenuation.*:Beckmann.*:Modules.*:WhiteIrradiance.*:LightUnits.*"),
]
LIMIT = 600
MOST_RED = 8  # without any mutant; more of them: something is missing
TIMES_LONGER = 5  # than without a mutant, where that is more than LIMIT

# Modules that draw with a file, tried before all of them.
NEAR = {"hlsl/specular": ["Specular", "Beckmann", "EnergyAttenuation"], "hlsl/shadow": ["ShadowMap", "TSM"], "hlsl/scatter/gaussian": ["Convolution"],
        "hlsl/scatter": ["Irradiance", "Main"], "hlsl/surface": ["Stretch", "TSM"], "effects/passes/convolution": ["Convolution"],
        "effects/passes/final": ["Main"], "effects/passes/irradiance": ["Irradiance"], "effects/passes/profile": ["Main"],
        "effects/passes/shadow_map": ["ShadowMap"], "effects/passes/skin": ["Irradiance", "Main"], "effects/passes/specular": ["Specular"],
        "effects/passes/stretch": ["Stretch", "Convolution"], "effects/passes/surface": ["TSM", "Irradiance"], "effects/passes/tsm": ["TSM"]}

SWAPS = {"+": "-", "-": "+", "*": "/", "/": "*", "<": ">=", ">": "<=", "<=": ">", ">=": "<", "==": "!=", "!=": "==", "&&": "||", "||": "&&",
         "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="}
CALLS = {"min": "max", "max": "min", "saturate": "", "abs": "", "ddx": "ddy", "ddy": "ddx", "sin": "cos", "cos": "sin", "normalize": "",
         "sqrt": "", "exp": "exp2"}
TOKEN = re.compile(r"(?P<number>(?<![\w.])\d+(?:\.\d*)?(?:[eE][-+]?\d+)?)|(?P<name>[A-Za-z_]\w*)|(?P<op>&&|\|\||[-+*/<>=!]=|\+\+|--|[-+*/<>])|(?P<rest>\S)")
DEFINITION = re.compile(r"^(?:static |inline )?(?:void|bool|int|uint|half|float|\w+Varying|\w+Point)(?:[1-4](?:x[1-4])?)? (\w+)\(", re.M)


def blanked(text):
    """The text with everything that is no code replaced by spaces: comments, strings, annotations, preprocessor lines but plain numbers."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match.group())
    text = re.sub(r"//[^\n]*|/\*.*?\*/", blank, text, flags=re.S)
    text = re.sub(r'"[^"\n]*"', blank, text)
    text = re.sub(r"<\s*(?:string|float|float2|int|bool|[A-Z][A-Z_]*(?=\())\b[^<>]*>", blank, text)
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


class Mutant:
    def __init__(self, path, start, end, text, replacement):
        self.path, self.start, self.end, self.replacement = path, start, end, replacement
        self.original = text[start:end]
        self.line = text.count("\n", 0, start) + 1
        self.column = start - (text.rfind("\n", 0, start) + 1) + 1
        self.source = text.split("\n")[self.line - 1].strip()
        functions = [m for m in DEFINITION.finditer(text) if m.start() <= start]
        self.function = functions[-1].group(1) if functions and "\n}" not in text[functions[-1].start():start] else ""
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
    found, before = [], ""
    levels = [match.span(1) for match in LEVEL.finditer(text)]
    for token in TOKEN.finditer(blanked(text)):
        kind, word = token.lastgroup, token.group()
        replacement = None
        if kind == "number":
            replacement = other_number(word, before)
        elif kind == "name" and text[token.end():token.end() + 1] == "(":
            replacement = CALLS.get(word)
        elif kind == "op" and word in SWAPS and (word not in "+-" or is_binary(before)):
            replacement = SWAPS[word]
        if replacement is not None:
            found.append(Mutant(path, token.start(), token.end(), text, replacement))
            found[-1].in_level = any(start <= token.start() < end for start, end in levels)
        before = word
    return found


def all_mutants():
    paths = sorted(str(p.relative_to(ROOT)) for folder in ("hlsl", "effects/passes") for p in (ROOT / folder).rglob("*.fxh"))
    return [m for path in paths if path != "hlsl/platform.fxh" for m in mutants_of(path)]


def sampled(mutants, count):
    """As many, spread evenly over files and lines by their ids, which do not depend on what else there is."""
    return sorted(sorted(mutants, key=lambda m: m.id)[:count], key=lambda m: (m.path, m.start))


class Trial:
    """One worker's copy of the tree."""

    red_always = set()  # without a mutant, as on another device

    def __init__(self, build, number, stages, threads):
        self.build, self.known_stages, self.limits = build, stages, {}
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix=f"tegument-mutants-{number}-"))
        for entry in ROOT.iterdir():
            if entry.name in ("hlsl", "effects"):
                shutil.copytree(entry, self.folder / entry.name)
            elif entry.name not in ("build", ".git"):
                (self.folder / entry.name).symlink_to(entry)
        cache = pathlib.Path(os.environ.get("TEGUMENT_CACHE") or os.environ.get("XDG_CACHE_HOME", str(pathlib.Path.home() / ".cache")) + "/tegument")
        own = self.folder / "cache"
        own.mkdir()
        for name in ("tools", "data", "human"):
            if (cache / name).exists():
                (own / name).symlink_to(cache / name)
        self.environment = {**os.environ, "TEGUMENT_CACHE": str(own), "GTEST_FAIL_FAST": "1", "LP_NUM_THREADS": str(threads)}

    def close(self):
        shutil.rmtree(self.folder, ignore_errors=True)

    def red(self, program, tests):
        """Name of the first failed test; empty: green. `tests`: a filter of GoogleTest."""
        command = [str(self.build / program), f"--gtest_filter={tests}-{':'.join(sorted(self.red_always))}", "--gtest_brief=1"]
        process = subprocess.Popen(command, cwd=self.folder, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                   errors="replace", start_new_session=True)
        try:
            output, _ = process.communicate(timeout=self.limits.get(program, LIMIT))
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return "time ran out"
        failed = re.search(r"\[  FAILED  \] ([^\s,(]+)", output)
        if not re.search(r"[1-9]\d* tests? from", output):
            if self.red_always:
                return ""
            raise RuntimeError(f"{program} has no tests {tests}")
        if failed:
            return failed.group(1)
        return "" if process.returncode == 0 else f"{pathlib.Path(program).name} ended with {process.returncode}"

    def stages(self, mutant):
        passes = mutant.path.startswith("effects/")  # which hlsl_tests does not read
        if mutant.function and not passes:
            yield "function", FUNCTIONS[0], f"Hlsl/Functions.*/{mutant.function}_*"
        modules = [stage for stage in self.known_stages if stage[0] == "modules"]
        near = next((names for start, names in NEAR.items() if mutant.path.startswith(start)), None)
        if modules and near:
            yield "module", modules[0][1], ":".join(f"Full/Modules.*/{name}_*" for name in near)
        yield from (stage for stage in self.known_stages if not (passes and stage[0] == "functions"))

    green = set()

    def is_red_always(self, path, text, program, test):
        """Asked once of what check_green has not asked."""
        path.write_text(text)
        always = bool(self.red(program, test)) and "/" in test
        (self.red_always if always else self.green).add(test)
        return always

    def kill(self, mutant):
        """Stage and test that turned red, or two empty texts."""
        path = self.folder / mutant.path
        text = path.read_text()
        path.write_text(text[:mutant.start] + mutant.replacement + text[mutant.end:])
        try:
            for stage, program, tests in self.stages(mutant):
                while failed := self.red(program, tests):
                    if stage != "module" or failed in self.green or not self.is_red_always(path, text, program, failed):
                        return stage, failed
                    path.write_text(text[:mutant.start] + mutant.replacement + text[mutant.end:])
            return "", ""
        finally:
            path.write_text(text)


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


def report(mutants, results):
    """Prints the table; returns the share of mutants with an effect that were killed."""
    rules, rows, survivors = explained(), {}, []
    for mutant in mutants:
        entry = results.get(mutant.id)
        if not entry:
            continue
        row = rows.setdefault(mutant.path, [0, 0, 0])
        row[0] += 1
        if entry["stage"]:
            row[1] += 1
        elif reason_for(mutant, rules):
            row[2] += 1
        else:
            survivors.append(mutant)
    rate = print_table("file", rows)
    stages = {}
    for mutant in mutants:
        if mutant.id in results and results[mutant.id]["stage"]:
            stages[results[mutant.id]["stage"]] = stages.get(results[mutant.id]["stage"], 0) + 1
    print("\nkilled by: " + ", ".join(f"{stage} {count}" for stage, count in sorted(stages.items(), key=lambda s: -s[1])))
    for mutant in survivors:
        print(f"survived: {mutant.key()}")
    return rate


def check_green(trials):
    """Tests must be green without a change, or every mutant would seem to die; a few that are not are left out. How long they take then limits how long they may take."""
    def check(i, stage, program, tests):
        trial = trials[i % len(trials)]
        if not (trial.build / program).exists():
            return f"{trial.build / program} is not there: build it first"
        begin = time.monotonic()
        for _ in range(MOST_RED + 1):
            if not (failed := trial.red(program, tests)):
                break
            if "." not in failed or failed in Trial.red_always or len(Trial.red_always) == MOST_RED:
                return f"{program} is red without any mutant: {failed}"
            print(f"red without any mutant, not asked: {failed}", flush=True)
            Trial.red_always.add(failed)
        seconds = time.monotonic() - begin
        for other in trials:
            other.limits[program] = max(LIMIT, TIMES_LONGER * seconds)
        print(f"{stage}: green in {seconds:.0f} s", flush=True)
        return ""

    with concurrent.futures.ThreadPoolExecutor(len(trials)) as pool:
        wrong = [text for text in pool.map(lambda numbered: check(numbered[0], *numbered[1]), enumerate(trials[0].known_stages)) if text]
    if wrong:
        sys.exit("\n".join(wrong))


def run(mutants, arguments, results):
    stages = [stage for stage in STAGES if stage[0] in arguments.stages]
    rules = explained()
    again = lambda m: arguments.retry and not results[m.id]["stage"] and not reason_for(m, rules)
    todo = [m for m in mutants if m.id not in results or again(m)]
    if not todo:
        return
    print(f"{len(mutants)} mutants, {len(todo)} to try", flush=True)
    until = time.monotonic() + 60 * arguments.minutes
    trials = [Trial(arguments.build, number, stages, max(1, (os.cpu_count() or 1) // arguments.jobs)) for number in range(arguments.jobs)]
    free, lock = list(trials), threading.Lock()
    try:
        check_green(trials)

        def attempt(mutant):
            if time.monotonic() > until:
                return
            with lock:
                trial = free.pop()
            stage, test = trial.kill(mutant)
            with lock:
                free.append(trial)
                results[mutant.id] = {"id": mutant.id, "mutant": mutant.describe(), "stage": stage, "test": test}
                with arguments.results.open("a") as file:
                    file.write(json.dumps(results[mutant.id]) + "\n")
                print(f"{len(results)}: {mutant.describe()}: {f'killed by {stage} {test}' if stage else 'SURVIVED'}", flush=True)

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
    parser.add_argument("--only", default="", help="mutants whose description holds this")
    parser.add_argument("--stages", nargs="+", default=[stage[0] for stage in STAGES], help="of the tests: " + " ".join(s[0] for s in STAGES))
    parser.add_argument("--retry", action="store_true", help="try survivors again: there are new tests")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--minutes", type=float, default=6000, help="no mutant is begun later")
    parser.add_argument("--results", type=pathlib.Path)
    parser.add_argument("--list", action="store_true", help="print the mutants and stop")
    parser.add_argument("--report", action="store_true", help="print the table of what is known and stop")
    arguments = parser.parse_args()
    arguments.build = arguments.build.resolve()
    arguments.results = arguments.results or arguments.build / "mutation.jsonl"

    mutants = [m for m in all_mutants() if arguments.only in m.describe()]
    if not arguments.all:
        mutants = sampled(mutants, arguments.sample)
    if arguments.list:
        print("\n".join(m.key() for m in mutants))
        return 0
    results = read_results(arguments.results)
    if not arguments.report:
        run(mutants, arguments, results)
    return 0 if report(mutants, results) >= PASSING else 1


if __name__ == "__main__":
    sys.exit(main())
