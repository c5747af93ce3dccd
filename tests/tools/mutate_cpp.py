#!/usr/bin/env python3
"""Changes one constant, operator or condition of the C++ at a time and asks whether a test turns red; all mutants are in one build.

    mutate_cpp.py write FOLDER [--sample 300] [--only TEXT]    a copy of the tree with so many mutants in it, the same ones every time
    mutate_cpp.py build FOLDER [-D NAME=VALUE]...              the programs with the tests that are asked, in FOLDER/build/release
    mutate_cpp.py run FOLDER [--jobs N] [--minutes M]          which cases reach which mutant, then those cases with it; goes on where it stopped
    mutate_cpp.py report FOLDER

The rooms are lab/reference, meshprep/order, meshprep/prepare and host/run. Numbers: times 1.1, whole ones plus 1, an index another one. + and -,
* and /, comparisons are exchanged as in mutate.py; min and max, sin and cos, exp and exp2 too; sqrt and abs are taken away; the condition of an `if` is
turned round. Not mutated: && and ||, whose second side must not be evaluated at times, and what the compiler evaluates. A mutant whose other form does not compile
(strings are not subtracted) is none. FOLDER/mutants.jsonl lists them, FOLDER/results.jsonl says what became of each.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

import mutate
from reproducible import copied

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROOMS = ("lab/reference", "meshprep/order", "meshprep/prepare", "host/run")
PROGRAMS = {"reference_tests": "tests/lab/reference", "order_tests": "tests/order", "prepare_tests": "tests/meshprep/prepare", "run_tests": "tests/run",
            "verify_tests": "tests/lab/verify", "hlsl_tests": "tests/hlsl"}
LEFT_OUT = {"verify_tests": "-Full*"}  # minutes each
OPERATORS = {"+": "Add", "-": "Subtract", "*": "Multiply", "/": "Divide", "<": "Less", ">": "Greater", "<=": "AtMost", ">=": "AtLeast", "==": "Equal", "!=": "Unequal"}
FUNCTIONS = {"min": "max", "max": "min", "sqrt": "", "abs": "", "sin": "cos", "cos": "sin", "exp": "exp2"}
TOKEN = re.compile(r"(?P<number>(?<![\w.'])(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?[uUfFzZlL]*(?![\w'.]))|(?P<op>(?<= )(?:[-+*/<>]|[<>=!]=)(?=[ \n]))"
                   r"|std::(?P<call>min|max|sqrt|abs|sin|cos|exp)(?=\([^{])|\bif \((?P<condition>)")
# Lines whose numbers the compiler wants, and declarations of operators.
CONSTANT = re.compile(r"\bconst(?:expr|eval|init)\b|\bstatic_assert\b|^\s*(?:case|template|enum|using|#|\[\[)|\boperator\b|\brequires\b|\bassert\("
                      r"|\bconst (?:int|unsigned|std::u?int\d*_t|std::size_t|bool) k?\w+ = [^(]*$|= 0;\s*$|std::get<|std::array<")
MOST, SAME, REACHED = 4095, 1, 2  # as in mutants.h
LEAST_SECONDS, TIMES_LONGER = 10, 8  # a mutant that runs on is dead
SHARED = ("tools", "data", "human", "spirv")  # of the cache: what no mutant makes. A wrong reference that is kept would be judged by later


def blanked(text):
    def blank(match):
        return re.sub(r"[^\n]", " ", match.group())
    text = re.sub(r"//[^\n]*|/\*.*?\*/", blank, text, flags=re.S)
    text = re.sub(r'"(?:\\.|[^"\\\n])*"|(?<![\w])\'(?:\\.|[^\'\\\n])+\'', blank, text)
    text = re.sub(r"^\s*(?:inline |static )?constexpr [^;({]*= \{.*?\};", blank, text, flags=re.S | re.M)
    return "\n".join(" " * len(line) if CONSTANT.search(line) else line for line in text.split("\n"))


def closing(text, at):
    """Of the bracket that is open before this place."""
    depth = 1
    for i in range(at, len(text)):
        depth += {"(": 1, ")": -1}.get(text[i], 0)
        if depth == 0:
            return i
    return -1


def other_number(word, before):
    digits, suffix = re.match(r"(.*?)([uUfFzZlL]*)$", word).groups()
    if before == "[" and "." not in digits:
        return ("1" if int(digits) == 0 else str(int(digits) - 1)) + suffix
    return mutate.other_number(digits, before) + suffix


class Mutant(mutate.Mutant):
    """`pieces`: what to write at which places; # stands for the number that it gets."""

    def __init__(self, path, start, end, text, replacement, pieces):
        super().__init__(path, start, end, text, replacement)
        self.pieces, self.in_level = pieces, False


def mutants_of(path):
    text = (ROOT / path).read_text(encoding="utf-8")
    code = blanked(text)
    for token in TOKEN.finditer(code):
        start, end, word = token.start(), token.end(), token.group()
        before = code[:start].rstrip()[-1:]
        if token.lastgroup == "number" and not (code[start - 1] == "<" or code[end] == ">" or before == ":"):
            other = other_number(word, before)
            yield Mutant(path, start, end, text, other, [(start, end, f"::tgm::number<#>({word}, {other})")])
        elif token.lastgroup == "op" and before and before not in "=(,{[?:&|" and not code[:start].rstrip().endswith("return"):
            yield Mutant(path, start, end, text, mutate.SWAPS[word], [(start, end, f"{word} ::tgm::{OPERATORS[word]}<#>{{}} {word}")])
        elif token.lastgroup == "call":
            yield Mutant(path, start, end, text, FUNCTIONS[token.group("call")], [(start, end, f"::tgm::{token.group('call')}<#>")])
        elif token.lastgroup == "condition":
            last = closing(code, end)
            inside = code[end:last]
            if last > 0 and ";" not in inside and not re.search(r"[^=!<>]=[^=]", inside):
                yield Mutant(path, start, end, text, "not (", [(end, end, "::tgm::condition<#>("), (last, last, ")")])


def all_mutants():
    return [mutant for room in ROOMS for path in sorted((ROOT / room).glob("*.cpp")) for mutant in mutants_of(str(path.relative_to(ROOT)))]


def write(arguments):
    copied(ROOT, arguments.folder, False)
    for entry in ("shared",):  # tests that read it are skipped without
        if (ROOT / entry).exists() and not (arguments.folder / entry).exists():
            (arguments.folder / entry).symlink_to(ROOT / entry)
    mutants = [mutant for mutant in all_mutants() if arguments.only in mutant.describe()]
    chosen = mutate.sampled(mutants, min(arguments.sample, MOST))
    lines, edits = [], {}
    for number, mutant in enumerate(chosen, 1):
        lines.append(json.dumps({"number": number, "id": mutant.id, "path": mutant.path, "what": mutant.describe(), "key": mutant.key()}))
        edits.setdefault(mutant.path, []).extend((start, end, piece.replace("#", str(number))) for start, end, piece in mutant.pieces)
    for path, pieces in edits.items():
        text = (ROOT / path).read_text(encoding="utf-8")
        # From the end; what is only put in at a place goes before what is exchanged there.
        for start, end, piece in sorted(pieces, key=lambda piece: (-piece[0], -piece[1])):
            text = text[:start] + piece + text[end:]
        (arguments.folder / path).write_text('#include "tests/tools/mutants.h"\n' + text, encoding="utf-8")
    (arguments.folder / "mutants.jsonl").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(f"{len(chosen)} of {len(mutants)} mutants in {len(edits)} files below {arguments.folder}")


def build(arguments):
    subprocess.run(["cmake", "--preset", "release", *(f"-D{definition}" for definition in arguments.define)], cwd=arguments.folder, check=True,
                   stdout=subprocess.DEVNULL)
    ninja = ["ninja", "-C", arguments.folder / "build/release", f"-j{arguments.jobs}", "-k0", *arguments.program]
    built = subprocess.run(ninja, check=False, stdout=subprocess.PIPE, text=True, errors="replace")
    if built.returncode == 0:
        return
    # Source that the text alone did not tell to be a place for a mutant: it is put back, and its mutants are none.
    mutants = [json.loads(line) for line in (arguments.folder / "mutants.jsonl").read_text(encoding="utf-8").splitlines()]
    wrong = {mutant["path"] for mutant in mutants if re.search(rf"^FAILED: .*/{pathlib.PurePath(mutant['path']).name}\.o", built.stdout, re.M)}
    for path in sorted(wrong):
        print(f"{path} does not compile with its mutants, and is left as it is")
        shutil.copy(ROOT / path, arguments.folder / path)
    with (arguments.folder / "results.jsonl").open("a", encoding="utf-8") as file:
        for mutant in mutants:
            if mutant["path"] in wrong:
                file.write(json.dumps({**mutant, "stage": "none", "test": ""}) + "\n")
    if not wrong or subprocess.run(ninja, check=False).returncode != 0:
        sys.exit(built.stdout[-3000:])


class Asked:
    """Cases, what each reaches, and how long it takes."""

    def __init__(self, folder, programs):
        self.folder, self.programs = folder, programs
        self.mutants = [json.loads(line) for line in (folder / "mutants.jsonl").read_text(encoding="utf-8").splitlines()]
        self.temporary = pathlib.Path(tempfile.mkdtemp(prefix="tegument-mutants-"))
        self.seconds, self.reached, self.none, self.red = {}, {}, set(), []
        self.users = pathlib.Path(os.environ.get("TEGUMENT_CACHE") or os.environ.get("XDG_CACHE_HOME", str(pathlib.Path.home() / ".cache")) + "/tegument")

    def close(self):
        shutil.rmtree(self.temporary, ignore_errors=True)

    def cases(self):
        for name in self.programs:
            program = self.folder / "build/release" / PROGRAMS[name] / name
            listed = subprocess.run([program, "--gtest_list_tests", f"--gtest_filter={LEFT_OUT.get(name, '*')}"], cwd=self.folder, capture_output=True, text=True,
                                    check=True).stdout
            suite = ""
            for line in listed.splitlines():
                word = line.split("#")[0].rstrip()
                if word.startswith(" "):
                    yield program, suite + word.strip()
                elif word.endswith("."):
                    suite = word

    def ask(self, case, limit, **environment):
        """Whether the case passes; and how long it takes."""
        began = time.monotonic()
        own = pathlib.Path(tempfile.mkdtemp(prefix="cache-", dir=self.temporary))
        for name in SHARED:
            if (self.users / name).exists():
                (own / name).symlink_to(self.users / name)
        process = subprocess.Popen([case[0], f"--gtest_filter={case[1]}", "--gtest_brief=1"], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                   env={**os.environ, "TMPDIR": str(self.temporary), "TEGUMENT_CACHE": str(own), **environment}, start_new_session=True)
        try:
            code = process.wait(limit)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 9)
            process.wait()
            code = -1
        shutil.rmtree(own, ignore_errors=True)
        return code in (0, 77), time.monotonic() - began

    def reach(self, case):
        seen = self.temporary / f"seen-{abs(hash(case))}"
        passed, seconds = self.ask(case, 600, TEGUMENT_MUTANTS_SEEN=str(seen))
        found = seen.read_bytes() if seen.exists() else b""
        return case, passed, seconds, {n for n, what in enumerate(found) if what == REACHED}, {n for n, what in enumerate(found) if what == SAME}

    def look(self, jobs):
        """What was seen of a program stays in FOLDER/reached.jsonl until it is built again."""
        kept = self.folder / "reached.jsonl"
        known = {(*entry["case"], entry["built"]): entry for entry in map(json.loads, kept.read_text().splitlines())} if kept.exists() else {}
        cases = [(*case, case[0].stat().st_mtime_ns) for case in self.cases()]
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool, kept.open("a", encoding="utf-8") as file:
            asked = [pool.submit(self.reach, case[:2]) for case in cases if (str(case[0]), *case[1:]) not in known]
            for done in concurrent.futures.as_completed(asked):
                case, passed, seconds, reached, none = done.result()
                entry = {"case": [str(case[0]), case[1]], "built": case[0].stat().st_mtime_ns, "passed": passed, "seconds": seconds, "reached": sorted(reached),
                         "none": sorted(none)}
                file.write(json.dumps(entry) + "\n")
                file.flush()
                known[(*entry["case"], entry["built"])] = entry
        for case in cases:
            self.take(case[:2], known[(str(case[0]), *case[1:])])
        self.none -= set(self.reached)

    def take(self, case, entry):
        if not entry["passed"]:
            self.red.append(case[1])
            return
        self.none |= set(entry["none"])
        self.seconds[case] = entry["seconds"]
        for number in entry["reached"]:
            self.reached.setdefault(number, []).append(case)

    def kill(self, number, until, longest):
        """Program and case that turned red; two empty texts: none; nothing where the time was over, or cases were left out."""
        cases = sorted(self.reached.get(number, []), key=self.seconds.get)
        for case in cases:
            if self.seconds[case] > longest:
                return None
            left = until - time.monotonic()
            limit = max(LEAST_SECONDS, TIMES_LONGER * self.seconds[case])
            passed, seconds = self.ask(case, min(limit, left), TEGUMENT_MUTANT=str(number)) if left > 0 else (False, 0)
            if not passed and seconds >= left:
                return None
            if not passed:
                return case[0].name, case[1]
        return "", "" if number in self.reached else "not reached"


def run(arguments):
    until = time.monotonic() + 60 * arguments.minutes
    results = arguments.folder / "results.jsonl"
    known = {entry["number"]: entry["stage"] for entry in map(json.loads, results.read_text().splitlines())} if results.exists() else {}
    if arguments.retry:
        known = {number: stage for number, stage in known.items() if stage}
    asked = Asked(arguments.folder, arguments.program)
    try:
        asked.look(arguments.jobs)
        for name in asked.red:
            print(f"red without any mutant, not asked: {name}")
        todo = [mutant for mutant in asked.mutants if mutant["number"] not in known]
        print(f"{len(asked.seconds)} cases; {len(todo)} mutants to try", flush=True)
        with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool, results.open("a", encoding="utf-8") as file:
            jobs = {pool.submit(asked.kill, mutant["number"], until, arguments.longest): mutant for mutant in todo if mutant["number"] not in asked.none}
            for mutant in todo:
                if mutant["number"] in asked.none:
                    file.write(json.dumps({**mutant, "stage": "none", "test": ""}) + "\n")
            for done in concurrent.futures.as_completed(jobs):
                if done.result() is None:
                    continue
                mutant, (stage, test) = jobs[done], done.result()
                file.write(json.dumps({**mutant, "stage": stage, "test": test}) + "\n")
                file.flush()
                print(f"{mutant['what']}: {f'killed by {test}' if stage else f'SURVIVED {test}'}", flush=True)
    finally:
        asked.close()


def report(arguments):
    results = {entry["id"]: entry for entry in map(json.loads, (arguments.folder / "results.jsonl").read_text().splitlines())}
    rules, rows, survivors = mutate.explained(), {}, []
    for entry in results.values():
        if entry["stage"] == "none":
            continue
        row = rows.setdefault(str(pathlib.PurePath(entry["path"]).parent), [0, 0, 0])
        row[0] += 1
        if entry["stage"]:
            row[1] += 1
        elif mutate.reason_in(rules, entry["key"]):
            row[2] += 1
        else:
            survivors.append(entry)
    rate = mutate.print_table("room", rows)
    for entry in survivors:
        print(f"survived{', ' + entry['test'] if entry['test'] else ''}: {entry['key']}")
    return 0 if rate >= mutate.PASSING else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("do", choices=["write", "build", "run", "report"])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--sample", type=int, default=300)
    parser.add_argument("--only", default="")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--minutes", type=float, default=600)
    parser.add_argument("--retry", action="store_true", help="try survivors again: there are new tests")
    parser.add_argument("--longest", type=float, default=1e9, metavar="SECONDS", help="cases that take longer are not asked: such mutants stay to be tried")
    parser.add_argument("--program", action="append", choices=list(PROGRAMS), help="with the tests that are asked; default: all of these")
    parser.add_argument("-D", "--define", action="append", default=[], metavar="NAME=VALUE")
    arguments = parser.parse_args()
    arguments.folder, arguments.program = arguments.folder.resolve(), arguments.program or list(PROGRAMS)
    return {"write": write, "build": build, "run": run, "report": report}[arguments.do](arguments)


if __name__ == "__main__":
    sys.exit(main())
