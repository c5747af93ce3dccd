#!/usr/bin/env python3
"""Each repository check finds the flaw that it is there for, and nothing in a tree without it."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import commands_test
import diagnostics

PROGRAM = pathlib.Path(__file__).with_name("repository.py")
ROOMS = ["cmake", "docs", "effects", "hlsl", "host", "meshprep", "tools", "lab", "tests"]
GUARDED = "// Purpose.\n#ifndef TEGUMENT_SCATTER_BLUR_FXH\n#define TEGUMENT_SCATTER_BLUR_FXH\n{}\n#endif\n"


def table(*codes, **more):
    """The file of a table of one area with these codes."""
    rows = [{"code": code, "meaning": "meaning", "do": "what to do", **more} for code in codes]
    return {diagnostics.TABLE: json.dumps([{"title": "A", "sections": [{"title": "", "text": "", "codes": rows}]}])}


def run(check, tree):
    """Exit code and findings of a check on a repository made of these files over a sound one."""
    sound = {f"{room}/README.md": "What belongs here.\n" for room in ROOMS}
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {**sound, **tree}.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, PROGRAM, check, folder], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout


class Checks(unittest.TestCase):
    def finds(self, check, tree, expected):
        code, out = run(check, tree)
        self.assertEqual((code, expected in out), (1, True), out)

    def accepts(self, check, tree):
        code, out = run(check, tree)
        self.assertEqual(code, 0, out)

    def test_a_line_of_141_characters_of_a_shader_is_too_long(self):
        check = "shaders_have_lines_of_at_most_140_characters"
        self.accepts(check, {"hlsl/a.fxh": "/" * 140 + "\n", "effects/passes/b.fxh": "é" * 140, "host/c.cpp": "/" * 141})
        self.finds(check, {"effects/passes/a.fxh": "\n" + "/" * 141}, "effects/passes/a.fxh:2: 141 characters")
        self.finds(check, {"hlsl/a.fxh": "/" * 141}, "hlsl/a.fxh:1: 141 characters")

    def test_a_home_folder_is_a_path_of_one_machine(self):
        check = "no_file_names_a_registry_host_or_a_path_of_one_machine"
        self.accepts(check, {"docs/a.md": "see ~/.cache/tegument and out/home/head.png, packages of Debian"})
        self.finds(check, {"docs/a.md": "see /" + "home/me/x"}, "docs/a.md:1: /" + "home/me")

    def test_a_registry_host_is_found_in_a_script(self):
        host = "files.python" + "hosted.org"
        self.finds("no_file_names_a_registry_host_or_a_path_of_one_machine", {"bootstrap": f"curl {host}"}, host)

    def test_a_test_that_the_conventions_name_must_exist(self):
        check = "every_test_that_the_conventions_name_exists"
        page = {"docs/conventions.md": "* v down: `Obj.v_is_turned`\n"}
        self.accepts(check, {**page, "tests/a_test.cpp": "TEST_P(Obj, v_is_turned) {}\n"})
        self.finds(check, {**page, "tests/a_test.cpp": "TEST(Obj, v_is_kept) {}\n"}, "conventions.md:1: no test Obj.v_is_turned")

    def test_a_setting_is_named_where_its_switch_is_and_nowhere_else(self):
        check = "names_of_the_settings_stand_in_one_place"
        named = {"hlsl/settings.fxh": "#define FX_SETTINGS LOOK seed deon2007 corrected\n"}
        self.accepts(check, {**named, "host/a.cpp": '// "corrected"\nauto a = load(kSettingCorrected); f("it was corrected");'})
        self.accepts(check, {**named, "tools/cli/fur.cpp": 'json["seed"] = 1;'})
        for text in ['"corrected"', '"seed"', '"seed, deon2007 or corrected"']:
            self.finds(check, {**named, "host/a.cpp": f"f({text});"}, f"host/a.cpp:1: {text}")
        self.finds(check, {**named, "effects/a.fx": 'string UIHelp = "as in deon2007";'}, "effects/a.fx:1")

    def test_a_header_that_needs_no_gpu_includes_none_by_any_way(self):
        check = "headers_that_need_no_gpu_include_none"
        gpu = {"host/gpu/gpu.h": "#pragma once\n", "host/run/b.h": '#pragma once\n#include "host/gpu/gpu.h"\n'}
        self.accepts(check, {**gpu, "host/run/a.h": '#pragma once\n// Draws.\n#include "host/run/b.h"\n'})
        self.accepts(check, {**gpu, "host/run/a.h": '#pragma once\n// Needs no GPU.\n#include "host/run/c.h"\n'})
        self.finds(check, {**gpu, "host/run/a.h": '#pragma once\n// A plan;\n// needs no GPU.\n#include "host/run/b.h"\n'}, "host/run/a.h: says")

    def test_an_unfinished_mark_is_found(self):
        mark = "TO" + "DO"
        self.finds("nothing_is_left_unfinished", {"host/a.h": f"int a; // {mark}: more"}, f"host/a.h:1: {mark}")

    def test_a_raised_code_needs_a_row(self):
        check = "every_diagnostic_code_is_documented"
        source = {"host/a.cpp": 'auto a() { return inputError(\n  5001, "x"); }'}
        self.accepts(check, {**source, **table(5001)})
        self.finds(check, source, "TG5001 is not in")

    def test_a_code_in_a_comment_is_not_raised(self):
        self.accepts("every_diagnostic_code_is_documented", {"host/a.cpp": '// inputError(5001, "x")'})

    def test_two_rows_of_one_code_are_found(self):
        self.finds("every_diagnostic_code_is_documented", table(5001, 5001), "TG5001 again")

    def test_a_documented_code_must_be_raised(self):
        check = "every_documented_code_can_be_raised"
        self.accepts(check, {**table(5001), "host/a.cpp": "constexpr int kMissing = 5001;"})
        self.finds(check, {**table(5001), "host/a.cpp": "int a = 15001;"}, "no source raises TG5001")

    def test_a_documented_code_must_be_tested_or_have_a_reason_why_not(self):
        check = "every_diagnostic_code_is_tested"
        named = {"tests/a_test.cpp": "EXPECT_EQ(code, 5001);"}
        self.accepts(check, {**table(5001), **named})
        self.accepts(check, {**table(1001), "tests/effect/expect_fail/1001_a.fx": ""})
        self.accepts(check, table(5001, untested="needs a broken disk"))
        self.finds(check, table(5001), "TG5001 has no test")
        self.finds(check, {**table(5001, untested="needs a broken disk"), **named}, "TG5001 is tested")

    def test_a_page_of_codes_that_is_not_made_from_the_table_is_found(self):
        check = "the_page_of_diagnostics_is_made_from_its_table"
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, diagnostics.TABLE)
            path.parent.mkdir()
            path.write_text(table(5001)[diagnostics.TABLE], encoding="utf-8")
            page = diagnostics.markdown(pathlib.Path(folder))
        self.assertIn("## A\n\n| code | meaning | what to do |\n|---|---|---|\n| TG5001 | meaning | what to do |\n", page)
        self.accepts(check, {**table(5001), diagnostics.PAGE: page})
        self.finds(check, {**table(5001), diagnostics.PAGE: page.replace("meaning |", "sense |")}, "diagnostics.md: python3")
        self.finds(check, table(5001), "diagnostics.md: python3")
        self.finds(check, {diagnostics.PAGE: page}, "diagnostics.md: python3")

    def test_a_test_that_may_hide_a_failure_is_found(self):
        check = "tests_are_registered_where_no_failure_is_lost"
        self.accepts(check, {"tests/a/CMakeLists.txt": "tegument_tests(a_tests fast)", "cmake/tests.cmake": "add_test(NAME a)"})
        for way in ("add_test(NAME a COMMAND b)", "gtest_discover_tests(a)", "PROPERTIES SKIP_REGULAR_EXPRESSION x", "PROPERTIES WILL_FAIL TRUE",
                    "target_link_libraries(a PRIVATE GTest::gtest_main)"):
            self.finds(check, {"tests/a/CMakeLists.txt": way}, "tests/a/CMakeLists.txt:1")
        self.finds(check, {"tests/a/a_test.cpp": "TEST(A, DISABLED_b) {}"}, "a_test.cpp:1: DISABLED_b")

    def test_a_test_that_nothing_builds_is_found(self):
        check = "every_test_is_built"
        case = {"tests/a/b_test.cpp": "TEST(A, b) {}\n", "tests/CMakeLists.txt": "add_subdirectory(a)"}
        self.accepts(check, {**case, "tests/a/CMakeLists.txt": "tegument_tests(a_tests fast)"})
        self.accepts(check, {**case, "tests/a/CMakeLists.txt": "add_executable(a b_test.cpp)"})
        self.finds(check, {**case, "tests/a/CMakeLists.txt": "add_executable(a other_b_test.cpp)"}, "b_test.cpp: no CMakeLists.txt builds it")
        self.finds(check, {**case, "tests/a/b.cpp": "TEST_F(A, c) {}", "tests/a/CMakeLists.txt": "tegument_tests(a_tests fast)"}, "tests/a/b.cpp")
        self.finds(check, {**case, "tests/CMakeLists.txt": "", "tests/a/CMakeLists.txt": "tegument_tests(a)"}, "the folder above does not add it")

    def test_a_conditional_needs_a_listed_switch(self):
        check = "shaders_branch_on_targets_only_in_platform"
        shader = {"hlsl/scatter/blur.fxh": GUARDED.format("#if TEGUMENT_FAST\n#endif")}
        self.accepts(check, {**shader, "docs/settings.md": "`TEGUMENT_FAST` halves the taps"})
        self.accepts(check, {"hlsl/platform.fxh": "#if FX_D3D9\n#endif"})
        self.finds(check, shader, "blur.fxh:4: conditional on TEGUMENT_FAST")

    def test_an_include_is_guarded_by_its_path(self):
        check = "includes_of_shaders_are_guarded_by_their_name"
        self.accepts(check, {"hlsl/scatter/blur.fxh": GUARDED})
        self.accepts(check, {"hlsl/scatter.fxh": '// All of scatter.\n#include "scatter/blur.fxh"\n'})
        self.finds(check, {"hlsl/blur.fxh": GUARDED}, "TEGUMENT_BLUR_FXH")

    def test_a_shader_names_its_licence_at_its_end(self):
        check = "shaders_name_their_licence"
        self.accepts(check, {"hlsl/blur.fxh": GUARDED + "// SPDX-License-Identifier: MIT\n"})
        self.finds(check, {"effects/Blur.fx": GUARDED}, "Blur.fx: the last line")

    def test_a_library_of_another_version_is_found(self):
        check = "the_library_states_version_and_licence"
        beside = {"LICENSE": "MIT\n\nas is\n", "CMakeLists.txt": "project(tegument VERSION 1.2.3)\n"}
        head = "// MIT\n//\n// as is\n"
        beside["hlsl/platform.fxh"] = "#define TEGUMENT_VERSION 10203\n"
        self.accepts(check, {**beside, "hlsl/tegument.fxh": head})
        self.finds(check, {**beside, "hlsl/tegument.fxh": head, "CMakeLists.txt": "project(tegument VERSION 1.2.4)\n"}, "TEGUMENT_VERSION")
        self.finds(check, {**beside, "hlsl/tegument.fxh": "// MIT\n"}, "LICENSE")

    def test_rooms_that_include_each_other_are_found(self):
        check = "rooms_include_each_other_without_a_cycle"
        down = {"host/run/a.h": '#include "host/gpu/b.h"\n#include "host/run/c.h"\n', "host/gpu/b.h": '#include "meshprep/base/d.h"\n'}
        self.accepts(check, {**down, "meshprep/base/d.h": ""})
        self.finds(check, {**down, "meshprep/base/d.h": '#include "host/run/a.h"\n'}, "meshprep/base: includes")

    def test_an_include_that_leads_up_is_found(self):
        check = "data_goes_down_from_folder_to_folder"
        include = '#include "lab/bench/a.h"\n'
        self.accepts(check, {"lab/app/b.cpp": include, "tests/lab/bench/a_test.cpp": include})
        self.finds(check, {"tools/cli/b.cpp": include}, "tools/cli/b.cpp:1")
        self.finds(check, {"meshprep/order/b.h": include}, "meshprep/order/b.h:1")
        self.finds(check, {"host/run/b.h": '#include "meshprep/order/a.h"\n'}, "host/run/b.h:1")
        self.accepts(check, {"tools/cli/b.cpp": '#include "meshprep/order/a.h"\n#include "host/run/a.h"\n'})

    def test_a_library_in_a_room_that_should_not_know_it_is_found(self):
        check = "some_libraries_are_known_to_one_room"
        include = "#include <embree3/rtcore.h>\n"
        self.accepts(check, {"meshprep/rays/a.cpp": include, "host/run/a.cpp": "#include <vector>\n"})
        self.finds(check, {"lab/reference/a.cpp": include}, "lab/reference/a.cpp: includes embree3")
        self.finds(check, {"tools/cli/a.cpp": "#include <ft2build.h>\n", "host/run/b.cpp": "#include <ft2build.h>\n"}, "host/run/b.cpp")

    def test_an_algorithm_without_its_header_is_found(self):
        check = "sources_that_use_algorithms_include_them"
        self.accepts(check, {"host/run/a.cpp": "#include <algorithm>\nint a = std::max(1, 2);\n", "tests/b.cpp": "// std::max(1, 2)\nint b = std::numeric_limits<int>::max();\n"})
        self.finds(check, {"tests/a.cpp": "#include <vector>\nint a = std::max({1, 2});\n"}, "tests/a.cpp: uses an algorithm")
        self.finds(check, {"lab/a.h": "bool a = std::ranges::find(v, 1) == v.end();\n"}, "lab/a.h: uses an algorithm")

    def test_a_changelog_of_another_version_is_found(self):
        check = "the_changelog_knows_the_version_that_is_built"
        built = {"CMakeLists.txt": "cmake_minimum_required(VERSION 3.25)\nproject(a VERSION 0.2.0 LANGUAGES CXX)\n"}
        first = "## [0.1.0] - 2026-11-22\n* a\n"
        self.accepts(check, {**built, "CHANGELOG.md": "## [Unreleased]\n## [0.2.0] - 2026-12-01\n* **Breaking**: b\n" + first})
        self.finds(check, {**built, "CHANGELOG.md": first}, "its newest release is 0.1.0, CMakeLists.txt builds 0.2.0")
        self.finds(check, {**built, "CHANGELOG.md": "## [Unreleased]\n* a\n"}, "its newest release is none")
        self.finds(check, {**built, "CHANGELOG.md": "## [0.2.0] - 2026-12-01\n* **Breaking**: b\n"}, "something is **Breaking** in 0.2.0")

    def test_an_installed_header_that_is_not_for_users_is_found(self):
        check = "public_headers_are_meant_for_users"
        listed = {"cmake/install.cmake": "set(public_headers\n    host/run/a.h host/gpu/b.h)\n", "host/gpu/b.h": "#pragma once\n// A device.\n"}
        purpose = "#pragma once\n// Runs an effect.\n"
        self.accepts(check, {**listed, "host/run/a.h": purpose + '#include "host/gpu/b.h"\n#include <map>\n'})
        self.finds(check, {**listed, "host/run/a.h": purpose + '#include "host/gpu/c.h"\n'}, "host/run/a.h: is installed and includes host/gpu/c.h")
        self.finds(check, {**listed, "host/run/a.h": "#pragma once\n// Inside host/run: a plan.\n"}, "host/run/a.h: is installed, yet")
        self.finds(check, {**listed, "host/run/a.h": "#pragma once\nint a;\n"}, "host/run/a.h: is installed, yet")
        self.finds(check, listed, "host/run/a.h: is installed, yet")

    def test_what_a_file_needs_stands_above_its_guard_behind_its_own_guard(self):
        needs = '#ifndef TEGUMENT_SCATTER_{}_FXH\n#include "../scatter/seam.fxh"\n#endif\n'
        for check in ("includes_of_shaders_are_guarded_by_their_name", "shaders_branch_on_targets_only_in_platform"):
            self.accepts(check, {"hlsl/scatter/blur.fxh": needs.format("SEAM") + GUARDED})
        self.finds("includes_of_shaders_are_guarded_by_their_name", {"hlsl/scatter/blur.fxh": needs.format("SEAMS") + GUARDED}, "blur.fxh")
        self.finds("shaders_branch_on_targets_only_in_platform", {"hlsl/scatter/blur.fxh": needs.format("SEAMS") + GUARDED}, "TEGUMENT_SCATTER_SEAMS_FXH")

    def test_what_is_right_knows_no_setting(self):
        check = "right_forms_know_no_setting"
        constants = {"hlsl/constants.fxh": "static const bool kExact = true;\n", "hlsl/settings.fxh": "#if TEGUMENT_SETTING == 2\n#endif\n"}
        branch = GUARDED.format("float f(float x) { return kExact ? x : 0.0; }")
        self.accepts(check, {**constants, "hlsl/printed/blur.fxh": branch})
        self.finds(check, {**constants, "hlsl/scatter/blur.fxh": branch}, "blur.fxh:4: kExact")
        self.finds(check, {**constants, "hlsl/scatter/blur.fxh": GUARDED.format("#if TEGUMENT_SETTING\n#endif")}, "blur.fxh:4: TEGUMENT_SETTING")

    def test_a_name_of_the_library_without_its_prefix_is_found(self):
        check = "names_of_the_library_carry_one_prefix"
        right = "#define TG_SIZE TEGUMENT_SIZE\nstruct TgWay\n{\n};\nstatic const float kTgCircle = 3.0;\nfloat3 tgUnit(float3 v)\n{\n    return v;\n}\n"
        self.accepts(check, {"hlsl/blur.fxh": right, "hlsl/platform.fxh": "#define tex2D(s, uv) TG_TEX2D(s, uv)\n"})
        for wrong in ("#define SIZE 4", "struct Way", "static const float kCircle = 3.0;", "float3 unit(float3 v)", "TgWay wayOf(float3 v)", "#define tex2D(s, uv) 0"):
            self.finds(check, {"hlsl/blur.fxh": wrong + "\n"}, "hlsl/blur.fxh:1: ")

    def test_a_folder_without_readme_is_found(self):
        check = "folders_explain_themselves_in_at_most_30_lines"
        self.accepts(check, {"host/run/README.md": "What belongs here.\n"})
        self.finds(check, {"host/run/run.h": ""}, "host/run: no README.md")
        self.finds(check, {"hlsl/README.md": "\n" * 31}, "hlsl/README.md: more than 30 lines")

    def test_a_broken_link_is_found(self):
        check = "links_lead_somewhere"
        self.accepts(check, {"docs/a.md": "[b](b.md#part) [c](https://example.com) [d](#here)", "docs/b.md": ""})
        self.finds(check, {"docs/a.md": "[b](b.md)"}, "docs/a.md:1: b.md")

    def test_a_page_or_a_word_too_many_for_users_is_found(self):
        check = "user_pages_are_few_and_short"
        pages = {f"docs/{number}.md": "word\n" for number in range(24)}  # and README.md
        self.accepts(check, {**pages, "docs/design/more.md": "word " * 50000})
        self.finds(check, {**pages, "docs/samples/README.md": ""}, "docs: 26 pages outside docs/design, at most 25")
        words = 40000 - len("What belongs here.".split())
        self.accepts(check, {"docs/a.md": "word " * words})
        self.finds(check, {"docs/a.md": "word " * (words + 1)}, "docs: 40001 words outside docs/design, at most 40000; the longest page is docs/a.md, 39998")

    def test_a_page_that_no_front_lists_is_found(self):
        check = "every_page_is_listed_where_its_readers_begin"
        listed = {"docs/README.md": "[a](a.md#part)", "docs/a.md": "", "docs/design/README.md": "[b](b.md), [c](c/c.md)",
                  "docs/design/b.md": "", "docs/design/c/c.md": ""}
        self.accepts(check, listed)
        self.finds(check, {**listed, "docs/x.md": ""}, "docs/README.md: does not list docs/x.md")
        self.finds(check, {**listed, "docs/design/c/x.md": ""}, "docs/design/README.md: does not list docs/design/c/x.md")
        self.finds(check, {**listed, "docs/README.md": "[a](a.md)" + "\n" * 51}, "docs/README.md: more than 50 lines")

    def test_only_tests_may_name_the_shared_folder(self):
        check = "nothing_but_tests_reads_the_shared_folder"
        folder = "../" + "shared/data"
        self.accepts(check, {"tests/a_test.cpp": folder})
        self.finds(check, {"docs/a.md": folder}, "docs/a.md:1")

    def test_packages_and_their_table_agree(self):
        check = "dependencies_are_those_that_bootstrap_installs"
        script = {"bootstrap": "build_packages=(cmake\n  g++)\nwheel=(a==1.2 " + "a" * 64 + ")\n"}
        page = "| apt | `cmake` |\n| apt | `g++` |\n| pip | a==1.2 | " + "a" * 64
        self.accepts(check, {**script, "docs/dependencies.md": page})
        self.finds(check, {**script, "docs/dependencies.md": page.replace("| apt | `g++` |\n", "")}, "bootstrap installs g++")
        self.finds(check, {**script, "docs/dependencies.md": page + "\n| apt | `git` |"}, "lists git")
        self.finds(check, {**script, "docs/dependencies.md": page.replace("a==1.2", "a")}, "bootstrap pins a==1.2")


class OneProgram(commands_test.Program):
    """Has the commands render and `fur roots`, one effect and one workspace."""

    def output(self, *arguments):
        return {
            ("render", "--help"): "  -t,--technique TEXT\n  -p,--preset TEXT\n  -s,--set TEXT ...\n  -w,--workspace TEXT\n",
            ("fur", "--help"): "Subcommands:\n  roots                       Place roots\n",
            ("fur", "roots", "--help"): "  --lean FLOAT=0              How far tips lean\n",
            ("list", "--json"): '{"effects": [{"name": "Skin", "techniques": ["Fast"], "presets": ["dry"]},'
                                '             {"name": "Torn", "techniques": [], "presets": []}], "workspaces": [{"name": "front"}]}',
            ("info", "Skin", "--json"): '{"parameters": [{"name": "gMix"}]}',
        }.get(arguments, "")


class Commands(unittest.TestCase):
    def test_a_line_is_read_up_to_its_prose(self):
        page = "    tegument render Skin -o a.png    and look\n    tegument view Skin # h: help\n  tegument prose\n    build/release/tegument list\n"
        self.assertEqual(list(commands_test.commands_of(page)), [(1, "render Skin -o a.png"), (2, "view Skin"), (4, "list")])

    def test_what_the_program_has_not_is_found(self):
        program = OneProgram("")
        for right in ("render Skin -t Fast -p dry -w front --set gMix=1", "render mine/Other.fx -t Any -w my.json", "fur roots a.glb --lean 0.5",
                      "render [EFFECT] [--technique T] | --set"):
            self.assertEqual(list(commands_test.faults(program, right)), [], right)
        for wrong, fault in (("draw Skin", "no command draw"), ("render Skin --sett gMix=1", "has no option --sett"), ("fur roots a.glb --comb 1", "fur roots has no option --comb"),
                             ("render effects/Skin.fx -t Slow", "has no technique Slow"), ("render Skin --preset oily", "has no preset oily"),
                             ("render Skin -w back", "no workspace back"), ("render Skin -s gMax=1", "has no parameter gMax"), ("render Torn -s gMix=1", "Torn cannot be read"),
                             ("render [EFFECT] [--tecnique T]", "has no option --tecnique")):
            self.assertIn(fault, "".join(commands_test.faults(program, wrong)), wrong)


if __name__ == "__main__":
    unittest.main()
