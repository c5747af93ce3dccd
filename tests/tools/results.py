#!/usr/bin/env python3
"""What a run of ctest came to: `results.py [--allow REASON]... TESTS.XML...`, files of `ctest --output-junit`.

Prints one line for each case that was skipped, with its reason, then one with the sums: `N passed, N failed, N skipped`. Cases are counted, not
programs: one that runs many says how many (the line [cases] of tests/runner/main.cpp). Exit code 0: nothing failed, something passed, and
nothing was skipped that ./bootstrap installs; 1: a failure; 3: nothing failed, but something that ./bootstrap installs is missing.
`--allow` is a regular expression for reasons that count as the machine's own for once.
"""

import argparse
import re
import sys
import xml.etree.ElementTree

# What ./bootstrap cannot bring, or what the device decides. Every other reason to skip means that an installation failed.
ALLOWED = [
    r"set TEGUMENT_SHARED_DATA",  # scans that are no Debian package
    r"in the cache's data/dragon",  # Stanford's Dragon: by hand, docs/dependencies.md
    r"docs/meshprep\.md says where it comes from",
    r"\./bootstrap test fetches it where npm is",
    r"TEGUMENT_FOREIGN_EFFECTS names a folder",  # effects of others that no package brings
    r"has room for it",  # a device with more memory than the test asks for
    r"has no timestamps|no timestamps on",
    r"error TG6024|error TG6050",  # no second source of blending, no border colours of one's own
]


def text_of(case):
    return "".join(element.text or "" for element in case.iter("system-out"))


def reason_of(case):
    """Of a program that does not say [skipped]: its line `skipped: REASON`, else the last that it wrote."""
    lines = [line.strip() for line in text_of(case).splitlines() if line.strip()]
    said = [line.removeprefix("skipped: ") for line in lines if line.startswith("skipped: ")]
    return (said or lines or ["no reason given"])[-1]


class Results:
    def __init__(self):
        self.passed, self.failed, self.skipped = 0, 0, []
        self.red = []

    def add(self, case):
        name, status = case.get("name"), case.get("status")
        text = text_of(case)
        inside = re.findall(r"^\[cases\] (\d+) passed, (\d+) failed, (\d+) skipped$", text, re.M)
        passed, failed, skipped = map(int, inside[-1]) if inside else (0, 0, 0)
        reasons = re.findall(r"^\[skipped\] (\S.*?): (.*)$", text, re.M)
        is_skip = status == "notrun" and any("SKIP" in (element.get("message") or "") for element in case.iter("skipped"))
        if is_skip and passed == failed == 0:
            self.skipped += reasons or [(name, reason_of(case))]
        elif status == "run":
            if failed > 0 or len(reasons) != skipped:
                self.red.append(f"{name}: ctest says passed, the program says {passed} passed, {failed} failed, {skipped} skipped")
                self.failed += max(1, failed)
            else:
                self.passed += passed if inside else 1
                self.skipped += reasons
        else:  # failed, timed out, not found, a fixture that failed, disabled, or skipped against its own word
            self.red.append(f"{name}: {status}")
            self.failed += max(1, failed)
            self.passed += passed if failed else 0
            self.skipped += reasons if failed else []

    def read(self, path):
        suite = xml.etree.ElementTree.parse(path).getroot()
        cases = suite.findall("testcase")
        if int(suite.get("tests")) != len(cases):
            self.red.append(f"{path}: {suite.get('tests')} tests, results of {len(cases)}")
            self.failed += 1
        for case in cases:
            self.add(case)


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--allow", action="append", default=[])
    parser.add_argument("files", nargs="+")
    options = parser.parse_args(arguments)
    results = Results()
    for path in options.files:
        results.read(path)
    allowed = re.compile("|".join(f"(?:{pattern})" for pattern in ALLOWED + options.allow))
    missing = [(name, reason) for name, reason in results.skipped if not allowed.search(reason)]
    for line in results.red:
        print(f"red: {line}")
    for name, reason in results.skipped:
        print(f"{'missing' if (name, reason) in missing else 'skipped'}: {name}: {reason}")
    if missing:
        print("./bootstrap installs what the tests above marked as missing want; its log says why it is not there")
    print(f"{results.passed} passed, {results.failed} failed, {len(results.skipped)} skipped")
    if results.failed or not results.passed:
        return 1
    return 3 if missing else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
