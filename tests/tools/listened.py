#!/usr/bin/env python3
"""The tests that draw, while a layer of ours listens to what the validation layer says to any of their processes: listened.py BUILD OUT [OPTION...].

Each program of the list runs as a whole, in `--shards` parts, then the commands of ctest that draw. The validation layer is in every process, also where the
program does not ask for it, with synchronization validation and its shader heuristic. That a message would be heard is tried first: barriers of a
picture that wait for nothing, all at once and then each alone (tests/faults/layer.cpp). OUT gets the logs, heard.tsv and summary.json.
Exit code 0: no message, no test failed, and the hazards were heard.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import time

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
MESSAGES_ARE_MEANT = "Gpu.validation_messages_are_collected"
# Program: the cases that it does not run here. Of Barriers messages are wanted, too. Times mean nothing under a layer that costs many of them; memory is the layer's own.
PROGRAMS = {
    "tests/gpu/gpu_tests": MESSAGES_ARE_MEANT,
    "tests/run/run_tests": "",
    "tests/lab/verify/verify_tests": "Full*",
    "tests/hlsl/hlsl_tests": "",
    "tests/cli/app_tests": "",
    "tests/cli/parts/app_parts_tests": "",
    "tests/view/view_tests": "",
    "tests/faults/fault_tests": "Barriers.*",
    "tests/light/scene_light_tests": "",
    "tests/fur/drawn/fur_drawn_tests": "",
    "tests/fur/swept/fur_swept_tests": "",
    "tests/peers/peer_tests": "",
    "tests/lab/app/lab_app_tests": "",
    "tests/lab/bench/bench_tests": "",
    "tests/lab/invariance/invariance_tests": "",
    "tests/lab/stability/stability_tests": "",
    "tests/batch/batch_tests": "",
    "tests/spirv/spirv_tests": "",
    "tests/image/image_tests": "",
    "tests/adopt/adopt_tests": "",
}
COMMANDS = ("DrawTime", "View.in_a_window", "View.beside_the_picture", "View.of_another_host", "View.panels", "Faults.of_the_machine",
            "Faults.of_who_interrupts", "Faults.of_what_effects_may_read", "Everywhere.one_processor_and_all_write_the_same_bytes")
SETTINGS = """khronos_validation.validate_sync = true
khronos_validation.syncval_shader_accesses_heuristic = true
khronos_validation.enables = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT
khronos_validation.debug_action = VK_DBG_LAYER_ACTION_CALLBACK
khronos_validation.report_flags = error,warn
khronos_validation.enable_message_limit = false
khronos_validation.duplicate_message_limit = 0
"""
PICTURE = ("render", "Beckmann", "--size", "32", "--samples", "1")


class Listened:
    def __init__(self, given):
        self.build, self.out, self.given = given.build.resolve(), given.out.resolve(), given
        manifests = self.out / "layers/vulkan/implicit_layer.d"
        manifests.mkdir(parents=True, exist_ok=True)
        listener = self.build / "tests/faults/listener/listener.json"
        manifest = json.loads(listener.read_text())
        manifest["layer"]["library_path"] = str(self.build / "tests/faults/libtegument_listener.so")
        (manifests / "listener.json").write_text(json.dumps(manifest))
        (self.out / "vk_layer_settings.txt").write_text(SETTINGS)
        folders = os.environ.get("XDG_DATA_DIRS") or "/usr/local/share:/usr/share"
        self.environment = dict(os.environ, XDG_DATA_DIRS=f"{self.out}/layers:{folders}", VK_LAYER_SETTINGS_PATH=str(self.out / "vk_layer_settings.txt"),
                                TEGUMENT_LISTENER="1", VK_INSTANCE_LAYERS="VK_LAYER_KHRONOS_validation")
        self.environment["VK_LAYER_PATH"] = f"{self.build}/tests/faults/layer:{os.environ.get('VK_LAYER_PATH') or '/usr/share/vulkan/explicit_layer.d'}"
        self.end = time.monotonic() + 60 * given.minutes

    def started(self, command, heard, log, **more):
        """Exit code and output; what the layer says goes to the end of `heard`."""
        environment = dict(self.environment, TEGUMENT_HEARD=str(self.out / heard), **more)
        with open(self.out / log, "w", encoding="utf-8", errors="replace") as file:
            try:
                code = subprocess.run(command, cwd=REPOSITORY, env=environment, stdin=subprocess.DEVNULL, stdout=file, stderr=subprocess.STDOUT,
                                      timeout=max(1, self.end - time.monotonic()), check=False).returncode
            except subprocess.TimeoutExpired:
                code = None
        return code, (self.out / log).read_text(encoding="utf-8", errors="replace")

    def heard(self, name):
        file = self.out / name
        lines = file.read_text(encoding="utf-8", errors="replace").splitlines() if file.exists() else []
        return [line.split("\t") for line in lines if line.count("\t") == 3]

    def picture(self, fault, at):
        """Messages and barriers of one small picture."""
        name = f"hazard_{at}.tsv"
        (self.out / name).unlink(missing_ok=True)
        layers = {"VK_INSTANCE_LAYERS": "VK_LAYER_TEGUMENT_fault:VK_LAYER_KHRONOS_validation", "TEGUMENT_FAULT": fault}
        code, text = self.started([*self.given.prefix.split(), self.build / "tegument", *PICTURE, "--validate", "-o", self.out / "hazard.exr"], name,
                                  "hazard.log", **layers)
        rows = self.heard(name)
        (self.out / name).unlink(missing_ok=True)
        barriers = sum(int(row[3].split()[1]) for row in rows if row[0] == "work")
        return [row[3] for row in rows if row[0] == "message"], barriers, code, text

    def hazards(self):
        """Whether what is wrong is heard: nothing of the picture as it is, something of it without waiting."""
        none, barriers, code, text = self.picture("count:0", "none")
        if none or code != 0 or barriers == 0:
            return {"heard": False, "why": text[-2000:], "messages": none}
        every, _, code, _ = self.picture("barrier:0", "all")
        hazards = [message for message in every if message.startswith("SYNC-HAZARD")]
        alone = sum(bool(self.picture(f"barrier:{at}", at)[0]) for at in range(1, barriers + 1))
        return {"heard": bool(hazards) and code != 0, "messages_without_waiting": len(every), "barriers": barriers, "heard_alone": alone}

    def part(self, program, shard):
        name = pathlib.Path(program).name
        command = [*self.given.prefix.split(), self.build / program, "--gtest_brief=1", f"--gtest_filter={self.given.filter}-{PROGRAMS[program]}"]
        code, text = self.started(command, "heard.tsv", f"{name}_{shard}.log", GTEST_TOTAL_SHARDS=str(self.given.shards), GTEST_SHARD_INDEX=str(shard))
        found = re.findall(r"^\[cases\] (\d+) passed, (\d+) failed, (\d+) skipped$", text, re.M)
        passed, failed, skipped = map(int, found[-1]) if found else (0, 0, 0)
        if not found and "no case ran" not in text and not re.search(r"\[==========\] 0 tests", text):
            failed = 1  # crashed, or out of time
        red = re.findall(r"^\[  FAILED  \] (\S+?),? ", text, re.M)
        return {"name": name, "code": code, "passed": passed, "failed": failed, "skipped": skipped, "red": sorted(set(red)) or ([name] if failed else [])}

    def command(self, test):
        code, text = self.started(["ctest", "--test-dir", self.build, "-R", f"^{re.escape(test)}$", "--output-on-failure"], "heard.tsv",
                                  f"command_{test}.log")
        skipped = "***Skipped" in text
        passed = code == 0 and not skipped and "100% tests passed" in text
        return {"name": test, "code": code, "passed": int(passed), "failed": int(not passed and not skipped), "skipped": int(skipped),
                "red": [] if passed or skipped else [test]}

    def tests(self):
        (self.out / "heard.tsv").unlink(missing_ok=True)
        wanted = re.compile(self.given.only)
        programs = [program for program in PROGRAMS if wanted.search(program) and (self.build / program).exists()]
        commands = [] if self.given.without_commands else [test for test in COMMANDS if wanted.search(test)]
        rows = []
        with concurrent.futures.ThreadPoolExecutor(self.given.jobs) as pool:
            waiting = [pool.submit(self.part, program, shard) for program in programs for shard in range(self.given.shards)]
            waiting += [pool.submit(self.command, test) for test in commands]
            for done in concurrent.futures.as_completed(waiting):
                row = done.result()
                rows.append(row)
                print(f"{row['name']}: {row['passed']} passed, {row['failed']} failed, {row['skipped']} skipped", *row["red"], flush=True)
        return rows


def summary(listened, rows, hazards):
    heard = listened.heard("heard.tsv")
    kinds = collections.Counter(row[0] for row in heard)
    messages = collections.Counter((row[3].split(":")[0], row[2].split(" ")[0].rsplit("/", 1)[-1]) for row in heard if row[0] == "message")
    return {"passed": sum(row["passed"] for row in rows), "failed": sum(row["failed"] for row in rows), "skipped": sum(row["skipped"] for row in rows),
            "red": sorted({name for row in rows for name in row["red"]}), "devices": kinds["device"], "devices without the layer": kinds["unseen"],
            "submissions": sum(int(row[3].split()[0]) for row in heard if row[0] == "work"), "barriers": sum(int(row[3].split()[1]) for row in heard if row[0] == "work"),
            "messages": kinds["message"] + kinds["deaf"], "of": [f"{count} {name} ({program})" for (name, program), count in messages.most_common()],
            "deliberate": hazards}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--shards", type=int, default=1, help="processes that share a program's cases")
    parser.add_argument("--only", default="", help="a regular expression for programs and commands")
    parser.add_argument("--filter", default="*", help="cases, as --gtest_filter has them")
    parser.add_argument("--minutes", type=float, default=120, help="what runs then is stopped, and counts as failed")
    parser.add_argument("--prefix", default="", help="what programs are started by: a loader of another C library")
    parser.add_argument("--without-commands", action="store_true", help="test programs only")
    listened = Listened(parser.parse_args())
    hazards = listened.hazards()
    print("deliberate hazards:", json.dumps(hazards), flush=True)
    result = summary(listened, listened.tests(), hazards)
    (listened.out / "summary.json").write_text(json.dumps(result, indent=1))
    print(json.dumps(result, indent=1))
    print(f"{result['passed']} passed, {result['failed']} failed, {result['skipped']} skipped")
    return 0 if hazards["heard"] and result["messages"] == 0 and result["failed"] == 0 and result["passed"] > 0 else 1


if __name__ == "__main__":
    sys.exit(main())
