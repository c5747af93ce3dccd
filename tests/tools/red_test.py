#!/usr/bin/env python3
"""No failure stays unseen: cases with known ends in a project that registers them as the tree registers its own (cmake/tests.cmake), run by
ctest and by ./bootstrap, whose exit codes and counts are what is asserted. usage: red_test.py RED_CASES REPOSITORY
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM, REPOSITORY = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
HIDDEN = "--gtest_filter="
PROJECT = """cmake_minimum_required(VERSION 3.25)
project(red LANGUAGES NONE)
enable_testing()
add_library(tegument_test_main INTERFACE)
include({repository}/cmake/tests.cmake)
add_executable(red_cases IMPORTED)
set_target_properties(red_cases PROPERTIES IMPORTED_LOCATION {program})
{tests}
"""


def run(command, **options):
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False, timeout=120, **options)
    return done.returncode, done.stdout + done.stderr


class Red(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="tegument-red-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.build = self.folder / "build"

    def project(self, tests, program=PROGRAM):
        text = PROJECT.format(repository=REPOSITORY, program=program, tests=tests)
        (self.folder / "CMakeLists.txt").write_text(text, encoding="utf-8")
        code, out = run(["cmake", "-G", "Ninja", "-S", self.folder, "-B", self.build])
        self.assertEqual(code, 0, out)

    def cases(self, *names):
        """All of them in one process."""
        self.project(f"tegument_one_process(Whole red_cases fast {HIDDEN}{':'.join(names)})")

    def verdict(self, before=""):
        """Exit code and output of what ./bootstrap test does behind the build, and so of .ci/run."""
        script = f". ./bootstrap; log={self.folder}/log; {before} run_tests {self.build} && report_tests {self.build}"
        return run(["bash", "-c", script], cwd=REPOSITORY)

    def ends(self, code, line):
        """ctest alone says 0 or not; bootstrap says the code, and the line is its last."""
        ctest, out = run(["ctest", "--test-dir", self.build, "--no-tests=error", "--timeout", "20"])
        self.assertEqual(ctest == 0, code in (0, 3), f"ctest: {ctest}\n{out}")
        bootstrap, out = self.verdict()
        self.assertEqual((bootstrap, out.rstrip().splitlines()[-1]), (code, line), out)
        return out

    def test_a_failure_beside_a_skip_is_red(self):
        self.cases("Ends.passes", "Ends.is_skipped", "Ends.fails")
        self.ends(1, "1 passed, 1 failed, 1 skipped")

    def test_a_failure_beside_a_skip_is_red_in_tests_of_their_own(self):
        self.project("""tegument_one_process(A red_cases fast --gtest_filter=Ends.is_skipped)
tegument_one_process(B red_cases fast --gtest_filter=Ends.fails)""")
        self.ends(1, "0 passed, 1 failed, 1 skipped")

    def test_a_case_that_fails_and_then_skips_is_red(self):
        self.cases("Ends.passes", "Ends.fails_and_is_skipped")
        self.ends(1, "1 passed, 1 failed, 0 skipped")

    def test_what_a_failure_says_makes_no_skip_of_it(self):
        self.cases("Ends.says_skipped_and_fails")
        self.ends(1, "0 passed, 1 failed, 0 skipped")

    def test_a_set_up_that_fails_is_red(self):
        self.cases("BrokenSetUp.*", "Ends.passes")
        self.ends(1, "1 passed, 1 failed, 0 skipped")

    def test_a_crash_is_red(self):
        self.cases("Ends.is_skipped", "Ends.crashes")
        self.ends(1, "0 passed, 1 failed, 0 skipped")

    def test_a_crash_at_exit_behind_a_skip_is_red(self):
        self.cases("Ends.is_skipped_and_crashes_at_exit")
        self.ends(1, "0 passed, 1 failed, 0 skipped")

    def test_a_program_that_runs_no_case_is_red(self):
        self.cases("Ends.has_another_name")
        self.ends(1, "0 passed, 1 failed, 0 skipped")

    def test_a_time_limit_is_red(self):
        self.project("tegument_command(Slow fast sleep 30)\nset_tests_properties(Slow PROPERTIES TIMEOUT 1)")
        self.ends(1, "0 passed, 1 failed, 0 skipped")

    def test_no_test_at_all_is_red(self):
        self.project("")
        self.ends(1, "0 passed, 0 failed, 0 skipped")

    def test_a_test_that_waits_for_one_that_failed_is_red(self):
        self.project("""tegument_command(First fast false)
tegument_command(Second fast true)
set_tests_properties(First PROPERTIES FIXTURES_SETUP first)
set_tests_properties(Second PROPERTIES FIXTURES_REQUIRED first)""")
        self.ends(1, "0 passed, 2 failed, 0 skipped")

    def test_a_test_that_is_switched_off_is_red_for_bootstrap(self):
        self.project("tegument_command(A fast true)\ntegument_command(B fast true)\nset_tests_properties(B PROPERTIES DISABLED TRUE)")
        code, out = self.verdict()
        self.assertEqual((code, out.rstrip().splitlines()[-1]), (1, "1 passed, 1 failed, 0 skipped"), out)

    def test_a_program_that_was_not_built_is_red(self):
        self.project("tegument_cases(red_cases fast)", program=self.folder / "nothing")
        self.ends(1, "0 passed, 1 failed, 0 skipped")

    def test_a_program_that_cannot_list_its_cases_is_red(self):
        broken = self.folder / "broken"
        broken.write_text("#!/bin/sh\nexit 1\n", encoding="utf-8")
        broken.chmod(0o755)
        self.project("tegument_command(Good fast true)\ntegument_cases(red_cases fast)", program=broken)
        code, out = run(["ctest", "--test-dir", self.build])
        self.assertNotEqual(code, 0, out)
        code, out = self.verdict()
        self.assertEqual(code, 1, out)

    def test_each_case_is_a_test_where_cases_are_discovered(self):
        self.project("tegument_cases(red_cases fast)")
        out = self.ends(1, "2 passed, 6 failed, 1 skipped")
        self.assertIn("Ends.is_skipped: it lacks something", out)

    def test_parts_lose_no_case(self):
        self.project(f"tegument_parts(Whole red_cases fast 3 {HIDDEN}Ends.passes:Ends.in_part_2_passes:Ends.fails:Ends.is_skipped)")
        self.ends(1, "2 passed, 1 failed, 1 skipped")

    def test_a_case_waits_for_what_its_own_part_needs(self):
        self.project("""tegument_cases(red_cases fast FIXTURES_REQUIRED made_@PART@)
tegument_command(Make fast false)
set_tests_properties(Make PROPERTIES FIXTURES_SETUP made_2)""")
        _, out = run(["ctest", "--test-dir", self.build, "-R", "passes"])
        self.assertRegex(out, r"Ends\.passes \.+ +Passed")
        self.assertRegex(out, r"Ends\.in_part_2_passes \.+\*\*\*Not Run")

    def test_skips_are_printed_with_their_reason_and_only_some_are_allowed(self):
        self.cases("Ends.passes", "Ends.is_skipped")
        self.assertIn("missing: Ends.is_skipped: it lacks something", self.ends(3, "1 passed, 0 failed, 1 skipped"))
        code, out = self.verdict("allowed='it lacks something';")
        self.assertEqual(code, 0, out)
        self.assertIn("skipped: Ends.is_skipped: it lacks something", out)

    def test_what_passes_is_green(self):
        self.cases("Ends.passes")
        self.ends(0, "1 passed, 0 failed, 0 skipped")

    def test_programs_left_out_are_neither_registered_nor_missed(self):
        self.project("tegument_one_process(Whole red_cases fast)\ntegument_command(Other fast false)\n"
                     "set(TEGUMENT_TEST_PROGRAMS red_cases)\ntegument_command(Another fast false)")
        code, out = run(["ctest", "--test-dir", self.build, "-N"])
        self.assertIn("Total Tests: 2", out)
        text = PROJECT.format(repository=REPOSITORY, program=PROGRAM, tests="set(TEGUMENT_TEST_PROGRAMS red_case)\ntegument_check_test_programs()")
        (self.folder / "CMakeLists.txt").write_text(text, encoding="utf-8")
        code, out = run(["cmake", "-G", "Ninja", "-S", self.folder, "-B", self.folder / "other"])
        self.assertNotEqual(code, 0, out)

    def test_ci_passes_the_verdict_on(self):
        for code in (0, 1, 3):
            tree = self.folder / f"tree{code}"
            (tree / ".ci").mkdir(parents=True)
            (tree / ".ci" / "run").write_bytes((REPOSITORY / ".ci" / "run").read_bytes())
            (tree / "bootstrap").write_text(f'#!/bin/sh\n[ "$*" = test ] && exit {code}\nexit 9\n', encoding="utf-8")
            os.chmod(tree / "bootstrap", 0o755)
            self.assertEqual(run(["bash", tree / ".ci" / "run"])[0], code)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
