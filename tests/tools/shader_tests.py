"""For mutate.py: which names of the shaders lead to which, which tests a program has, and how one ends in a copy of the tree."""

import hashlib
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import threading

ROOT = pathlib.Path(__file__).resolve().parents[2]
SKIPPED = 77  # tests/runner/main.cpp
STANDSTILL = 7200  # seconds: where nothing is computed


def uses_of_names(root):
    """Of every name that the shaders define: the names in its definition. Overloads count as one."""
    uses = {}
    for path in [*(root / "hlsl").rglob("*.fxh"), *(root / "effects").rglob("*.fx*")]:
        text = re.sub(r"//[^\n]*|/\*.*?\*/", "", path.read_text(), flags=re.S)
        for name, body in re.findall(r"^#define (\w+)((?:[^\n]*\\\n)*[^\n]*)", text, flags=re.M):
            uses.setdefault(name, set()).update(re.findall(r"[A-Za-z_]\w*|##", body.replace("##", "") if path.name == "platform.fxh" else body))
        text = re.sub(r"^#(?:[^\n]*\\\n)*[^\n]*|^[A-Z][A-Z_0-9]*\([^\n]*\)\s*$", "", text, flags=re.M)  # a macro alone in its line: it defines what nobody finds
        for head, body in re.findall(r"^(\w[^;{}=<]*?)(?=[;{=<])(.*?)(?:\n\}|;[^\S\n]*\n(?=\S|\n|$))", text, flags=re.M | re.S):
            found = re.search(r"(\w+)\s*(?:\((?:[^()]|\([^()]*\))*\)|\[[^]]*\])?\s*(?::\s*\w+)?\s*$", head)
            if found:
                uses.setdefault(found.group(1), set()).update(re.findall(r"[A-Za-z_]\w*", head + body))
    return uses


class Reach:
    """Which names of the shaders a name leads to, and which files a file includes, by their text."""

    def __init__(self, uses=None):
        self.uses, self.names, self.files = uses or uses_of_names(ROOT), {}, {}

    def of(self, name):
        if name not in self.names:
            seen, left = set(), [name]
            while left:
                at = left.pop()
                if at not in seen:
                    seen.add(at)
                    left.extend(self.uses.get(at, ()))
            self.names[name] = seen
        return self.names[name]

    def leads(self, entry, name):
        """Also where it cannot be told: names that macros paste together."""
        return not name or entry not in self.uses or not {name, "##"}.isdisjoint(self.of(entry))

    def steps(self, entry, name):
        """Names between them on the shortest way; more than any way has where none can be told."""
        seen, level = set(), {entry}
        for steps in range(len(self.uses)):
            if name in level:
                return steps
            seen |= level
            level = {used for at in level for used in self.uses.get(at, ())} - seen
        return len(self.uses)

    def surely_leads(self, entry, name):
        return bool(name) and name in self.of(entry)

    def included(self, file):
        path = os.path.normpath(file)
        if path not in self.files:
            self.files[path] = {path}
            if (ROOT / path).is_file():
                for name in re.findall(r'^\s*#\s*include\s+"([^"]+)"', (ROOT / path).read_text(errors="replace"), flags=re.M):
                    self.files[path] |= self.included(os.path.join(os.path.dirname(path), name))
        return self.files[path]


def shaders_in(folder):
    """What a process has compiled: per effect, entry and stage the SPIR-V in the order of compiling."""
    found = {}
    for path in sorted(folder.glob("*.bin"), key=lambda p: p.stat().st_mtime_ns):
        data, at = path.read_bytes(), 32  # behind a checksum (host/support/cache.cpp): host/spirv/cache.cpp
        stage, at = data[at:at + 4], at + 4
        texts = []
        for _ in range(2):
            size = int.from_bytes(data[at:at + 8], "little")
            texts.append(data[at + 8:at + 8 + size].decode(errors="replace"))
            at += 8 + size
        words = int.from_bytes(data[at:at + 8], "little")
        code = hashlib.sha256(data[at + 8:at + 8 + 4 * words]).hexdigest()[:16]
        found.setdefault(f"{texts[0]} {texts[1]} {stage[0]}", []).append(code)
    return found


class Trial:
    """One worker's copy of the tree, with a cache of its own: what others have made is linked into it, SPIR-V is made anew for each test."""

    def __init__(self, build, number, threads):
        self.build = build
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix=f"tegument-mutants-{number}-"))
        for entry in ROOT.iterdir():
            if entry.name in ("hlsl", "effects", "tests"):
                shutil.copytree(entry, self.folder / entry.name)
            elif entry.name not in ("build", ".git"):
                (self.folder / entry.name).symlink_to(entry)
        (self.folder / ".tegument-root").touch()  # effects may read what lies below it
        cache = pathlib.Path(os.environ.get("TEGUMENT_CACHE") or os.environ.get("XDG_CACHE_HOME", str(pathlib.Path.home() / ".cache")) + "/tegument")
        own = self.folder / "cache"
        for name in ("tools", "data", "human", "reference", "skin", "light", "fur"):
            for file in (f for f in (cache / name).rglob("*") if f.is_file()):
                link = own / file.relative_to(cache)
                link.parent.mkdir(parents=True, exist_ok=True)
                link.symlink_to(file)
        self.spirv = own / "spirv"
        self.environment = {**os.environ, "TEGUMENT_CACHE": str(own), "GTEST_FAIL_FAST": "1", "LP_NUM_THREADS": str(threads)}

    def compiled(self):
        return shaders_in(self.spirv)

    def close(self):
        shutil.rmtree(self.folder, ignore_errors=True)

    def ask(self, program, tests, limit):
        """Name of the first failed test, empty where all are green, and the processor's seconds. `tests`: a filter of GoogleTest."""
        shutil.rmtree(self.spirv, ignore_errors=True)
        # Of the processor's seconds: on a busy machine a test may take long without doing much.
        command = ["sh", "-c", f'ulimit -t {int(limit)}; exec "$@"', "sh", str(self.build / program), f"--gtest_filter={tests}", "--gtest_brief=1"]
        process = subprocess.Popen(command, cwd=self.folder, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                   errors="replace", start_new_session=True)
        watch = threading.Timer(STANDSTILL, lambda: os.killpg(process.pid, signal.SIGKILL))
        watch.start()
        output = process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        ran_out = not watch.is_alive() or process.returncode in (-signal.SIGXCPU, -signal.SIGKILL)
        watch.cancel()
        seconds = usage.ru_utime + usage.ru_stime
        self.skipped = process.returncode == SKIPPED
        failed = re.search(r"\[  FAILED  \] ([^\s,(]+)", output)
        if ran_out:
            return "time ran out", seconds
        if failed:
            return failed.group(1), seconds
        return "" if process.returncode in (0, SKIPPED) else f"{pathlib.Path(program).name} ended with {process.returncode}", seconds


def tests_of(build, program):
    listed = subprocess.run([str(build / program), "--gtest_list_tests"], capture_output=True, text=True, check=True).stdout
    suite = ""
    for line in listed.splitlines():
        if line and not line.startswith(" "):
            suite = line.split()[0]
        elif suite:
            yield suite + line.split()[0]
