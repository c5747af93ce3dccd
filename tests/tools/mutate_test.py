#!/usr/bin/env python3
"""Tests of mutate.py and shader_tests.py on made-up shaders and test programs. usage: mutate_test.py"""

import pathlib
import tempfile
import types
import unittest

import mutate
import shader_tests

SHADERS = """
static const float kSteps[2] = {
    1.0,
    2.0
};
float gWidth < string UIName = "Width"; > = 3.0;
#define PASTED(n) float part##n() { return n; }
PASTED(7)
#define TAKEN 5.0
float inner(float x)
{
    return kSteps[1] * x;
}
float outer(float x)
{
    return inner(x) + 1.0;
}
float other(TAKEN_AS(float, x), float y) : SV_Target0
{
    return x * TAKEN;
}
float joined(float x)
{
    return PASTED(x);
}
"""


class Shaders(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = pathlib.Path(scratch.name)
        (self.root / "hlsl").mkdir()
        (self.root / "effects").mkdir()
        (self.root / "hlsl" / "made.fxh").write_text(SHADERS, encoding="utf-8")

    def test_a_number_outside_of_functions_belongs_to_what_is_declared_there(self):
        code = mutate.blanked(SHADERS)
        self.assertEqual(mutate.declared(code, code.index("2.0")), ("kSteps", True))
        self.assertEqual(mutate.declared(code, code.index("3.0")), ("gWidth", False))

    def test_one_in_a_line_that_makes_functions_meets_the_cases_of_its_macro(self):
        text = "#define STEP(n) float Step##n() { return n; }\nSTEP(7)\nfloat f()\n{\n    return SCALED(2);\n}\n"
        made = [mutate.Mutant("hlsl/made.fxh", text.index(number), text.index(number) + 1, text, "9") for number in "72"]
        self.assertEqual([(mutant.macro, mutant.function) for mutant in made], [("STEP", ""), ("", "f")])
        plan = object.__new__(mutate.Plan)
        plan.arguments, plan.cases = types.SimpleNamespace(seconds=0), {"STEP": ["case"]}
        plan.reach = shader_tests.Reach({"STEP": set()})
        self.assertEqual(next(plan.of_functions(made[0])), ("function", ["case"]))

    def test_a_name_leads_to_all_that_it_uses_and_to_nothing_else(self):
        reach = shader_tests.Reach(shader_tests.uses_of_names(self.root))
        self.assertTrue(reach.leads("outer", "kSteps"))
        self.assertTrue(reach.leads("other", "TAKEN"))
        self.assertFalse(reach.leads("other", "kSteps"))
        self.assertFalse(reach.leads("inner", "outer"))

    def test_steps_are_those_of_the_shortest_way(self):
        reach = shader_tests.Reach({"far": {"middle", "aside"}, "middle": {"near"}, "aside": {"middle"}, "near": {"f"}})
        self.assertEqual([reach.steps(name, "f") for name in ("f", "near", "far", "unknown")], [0, 1, 3, 4])

    def test_of_too_many_cases_of_callers_the_nearest_are_asked_where_no_picture_is(self):
        plan = object.__new__(mutate.Plan)
        far, near = [f"far {i}" for i in range(mutate.MOST_OTHERS)], ["near 1", "near 2"]
        plan.cases, plan.reach = {"far": far, "near": near}, shader_tests.Reach({"far": {"near"}, "near": {"f"}})
        text = "float f()\n{\n    return 2.0;\n}\n"
        mutant = mutate.Mutant("hlsl/made.fxh", text.index("2.0"), text.index("2.0") + 3, text, "2.2")
        for seconds, asked in ((0, (near + far)[:mutate.MOST_OTHERS]), (600, near + far)):
            plan.arguments = types.SimpleNamespace(seconds=seconds)
            self.assertEqual([test for _, tests in plan.of_functions(mutant) for test in tests], asked)

    def test_names_that_macros_paste_together_may_lead_anywhere_but_not_surely(self):
        reach = shader_tests.Reach(shader_tests.uses_of_names(self.root))
        self.assertTrue(reach.leads("joined", "kSteps"))
        self.assertTrue(reach.leads("part7", "kSteps"))
        self.assertFalse(reach.surely_leads("joined", "kSteps"))

    def test_a_cached_shader_is_its_effect_entry_stage_and_code(self):
        text = lambda value: len(value).to_bytes(8, "little") + value.encode()
        made = 32 * b"0" + b"\1\0\0\0" + text("a b.fx") + text("MainPS") + (2).to_bytes(8, "little") + b"word" + b"more" + b"rest"
        (self.root / "one.bin").write_bytes(made)
        (self.root / "two.bin").write_bytes(made[:-4] + b"else")  # what follows the code does not count
        found = shader_tests.shaders_in(self.root)
        self.assertEqual(list(found), ["a b.fx MainPS 1"])
        self.assertEqual(len(set(found["a b.fx MainPS 1"])), 1)


class Records(unittest.TestCase):
    def test_what_was_found_of_functions_is_read_again(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        arguments = types.SimpleNamespace(build=pathlib.Path(scratch.name))
        mutate.Record(arguments).add((mutate.FUNCTIONS, "Hlsl/* (7)"), "", 0, {})
        self.assertIn("Hlsl/* (7)", mutate.Record(arguments).tests)


class Made:
    """A worker's copy whose tests end, and compile, as the case says."""

    def __init__(self, folder, red=(), compiled=None, always=()):
        self.folder, self.reds, self.asked, self.result, self.always = folder, red, [], compiled or {}, always

    def ask(self, program, tests, limit):
        if "2.2" not in (self.folder / "passes.fxh").read_text(encoding="utf-8"):
            return (tests if tests in self.always else ""), 1.0
        self.asked.append(tests)
        return (tests if tests in (*self.reds, *self.always) else ""), 1.0

    def compiled(self):
        return self.result.get(self.asked[-1], {})


class Attempts(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "passes.fxh").write_text("float f()\n{\n    return 2.0;\n}\n", encoding="utf-8")
        text = (self.folder / "passes.fxh").read_text(encoding="utf-8")
        at = text.index("2.0")
        self.mutant = mutate.Mutant("passes.fxh", at, at + 3, text, "2.2")

    def plan(self, tests, seconds=600):
        plan = object.__new__(mutate.Plan)
        plan.arguments, plan.cases, plan.kills, plan.asked, plan.base, plan.sure = types.SimpleNamespace(seconds=seconds), {}, {}, {}, {}, {}
        plan.reach = shader_tests.Reach({"PS": {"f"}, "OtherPS": {"g"}})
        plan.reach.files["e.fx"] = {"passes.fxh"}
        program = mutate.PROGRAMS[0][0]
        plan.record = types.SimpleNamespace(tests={name: {"test": name, "program": program, "seconds": cost, "red": "", "shaders": shaders}
                                                   for name, cost, shaders in tests})
        return plan

    def attempt(self, plan, trial):
        return mutate.Attempt(trial, plan, self.mutant).result()

    def test_the_quickest_asks_first_and_the_first_red_one_kills(self):
        trial = Made(self.folder, red=["slow", "quick"])
        result = self.attempt(self.plan([("slow", 9, {"e.fx PS 1": ["a"]}), ("quick", 1, {"e.fx PS 1": ["a"]})]), trial)
        self.assertEqual((trial.asked, result["test"]), (["quick"], "quick"))

    def test_one_that_has_killed_in_this_file_asks_before_quicker_ones(self):
        plan = self.plan([("killer", 9, {"e.fx PS 1": ["a"]}), ("quick", 1, {"e.fx PS 1": ["a"]})])
        for _ in range(5):
            plan.note(self.mutant, "killer", "killer")
            plan.note(self.mutant, "quick", "")
        trial = Made(self.folder, red=["killer"])
        self.attempt(plan, trial)
        self.assertEqual(trial.asked, ["killer"])

    def test_one_that_compiles_nothing_of_it_is_not_asked(self):
        trial = Made(self.folder)
        result = self.attempt(self.plan([("other", 1, {"e.fx OtherPS 1": ["a"]})]), trial)
        self.assertEqual((trial.asked, result["stage"], result["same"]), ([], "", False))

    def test_what_compiles_to_the_same_everywhere_is_the_same_code(self):
        shaders = {"e.fx PS 1": ["a", "b"]}
        trial = Made(self.folder, compiled={"first": shaders})
        result = self.attempt(self.plan([("first", 1, shaders), ("second", 2, shaders)]), trial)
        self.assertEqual((trial.asked, result["same"]), (["first"], True))  # the second would compile the same again

    def test_what_compiles_to_something_else_in_another_order_or_is_not_all_asked_is_not(self):
        shaders = {"e.fx PS 1": ["a", "b"]}
        for now in ({"e.fx PS 1": ["b", "a"]}, {"e.fx PS 1": ["a", "c"]}, {}):
            self.assertFalse(self.attempt(self.plan([("first", 1, shaders)]), Made(self.folder, compiled={"first": now}))["same"])
        result = self.attempt(self.plan([("first", 1, shaders), ("dear", 99, {"e.fx PS 1": ["d"]})], 5), Made(self.folder, compiled={"first": shaders}))
        self.assertEqual((result["same"], result["left"]), (False, 1))

    def test_nothing_is_proven_where_no_picture_is_asked(self):
        plan = self.plan([], 0)
        plan.cases, plan.reach = {"f": ["case"]}, shader_tests.Reach({"f": set()})
        shaders = {"effects/function_test.hlsl FunctionPS 1": ["a"]}
        trial = Made(self.folder, compiled={"case": shaders})
        self.assertEqual(self.attempt(plan, trial)["same"], False)
        plan.arguments.seconds = 600
        self.assertEqual(self.attempt(plan, trial)["same"], True)

    def test_one_that_is_red_without_it_too_kills_nothing(self):
        trial = Made(self.folder, always=["broken"])
        result = self.attempt(self.plan([("broken", 1, {"e.fx PS 1": ["a"]}), ("sound", 2, {"e.fx PS 1": ["a"]})]), trial)
        self.assertEqual((trial.asked, result["stage"]), (["broken", "sound"], ""))

    def test_the_file_is_as_before_afterwards(self):
        before = (self.folder / "passes.fxh").read_bytes()
        self.attempt(self.plan([("first", 1, {"e.fx PS 1": ["a"]})]), Made(self.folder, red=["first"]))
        self.assertEqual((self.folder / "passes.fxh").read_bytes(), before)


if __name__ == "__main__":
    unittest.main()
