// The conformance cases of docs/scripts.md, in its order. Each is a point where public hosts differ. What only a GPU shows of cases 7, 12
// and 13 (the value of ViewportPixelSize, the refusal to sample a bound target, the barrier between two passes) is tested with host/run;
// here it is held that the sink learns all it needs in time.

#include "tests/effect/support.h"

#include <gtest/gtest.h>

namespace tegument::test {
namespace {

using Lines = std::vector<std::string>;

std::string technique(const std::string& script, const std::string& passes = "pass A { } pass B { }") {
    return "Texture2D gX : RENDERCOLORTARGET; Texture2D gY : RENDERCOLORTARGET;\n"
           "int gN = 2; int gM = 3; float gIndex; float gInner; bool gFast = true;\n"
           "technique T < string Script = \"" +
           script + "\"; > { " + passes + " }";
}

TEST(Conformance, case_01_the_last_command_needs_no_semicolon) {
    EXPECT_EQ(ran(technique("Pass=A; Pass=B")), (Lines{"A: geometry to app", "B: geometry to app"}));
}

TEST(Conformance, case_02_an_unknown_command_is_an_error_with_a_suggestion) {
    const Result<Effect> effect = load(technique("Pas=A;"));
    ASSERT_EQ(firstCode(effect), 2004);
    EXPECT_EQ(effect.error().diagnostics[0].hint, "did you mean 'Pass'?");
}

TEST(Conformance, case_03_a_loop_end_without_loop_is_an_error_and_so_is_a_loop_without_end) {
    EXPECT_EQ(firstCode(load(technique("Pass=A; LoopEnd;"))), 2007);
    EXPECT_EQ(firstCode(load(technique("LoopByCount=gN; Pass=A;"))), 2007);
    EXPECT_EQ(firstCode(load(technique("LoopGetIndex=gIndex;"))), 2007);
}

TEST(Conformance, case_04_loops_nest) {
    const Lines lines = ran(technique("LoopByCount=gN; LoopGetIndex=gIndex; LoopByCount=gM; LoopGetIndex=gInner; LoopEnd; LoopEnd=;"));
    EXPECT_EQ(lines,
              (Lines{"gIndex = 0", "gInner = 0", "gInner = 1", "gInner = 2", "gIndex = 1", "gInner = 0", "gInner = 1", "gInner = 2"}));
}

TEST(Conformance, case_05_a_count_of_0_skips_to_the_matching_end) {
    EXPECT_EQ(ran(technique("LoopByCount=gN; Pass=A; LoopByCount=gM; Pass=A; LoopEnd; Pass=A; LoopEnd; Pass=B;"), {{"gN", 0}}),
              (Lines{"B: geometry to app"}));
    EXPECT_EQ(ran(technique("LoopByCount=gM; LoopByCount=gN; Pass=A; LoopEnd; LoopEnd; Pass=B;"), {{"gN", 0}}),
              (Lines{"B: geometry to app"}));
}

TEST(Conformance, case_06_indices_count_up_from_0) {
    EXPECT_EQ(ran(technique("LoopByCount=gM; LoopGetIndex=gIndex; LoopEnd;")), (Lines{"gIndex = 0", "gIndex = 1", "gIndex = 2"}));
}

TEST(Conformance, case_07_a_target_change_is_told_before_the_next_draw_and_undone_after_the_script) {
    const std::string passes = "pass A < string Script = \"RenderColorTarget=gX; Draw=Buffer;\"; > { } pass B { }";
    EXPECT_EQ(ran(technique("Pass=A; Pass=B;", passes)),
              (Lines{"bind gX / app", "A: buffer to gX", "bind app / app", "B: geometry to app"}));
}

TEST(Conformance, case_08_clear_before_any_target_clears_the_applications) {
    EXPECT_EQ(ran(technique("Clear=Color; Clear=Depth;")), (Lines{"clear color0 with default", "clear depth with default"}));
}

TEST(Conformance, case_09_a_missing_pass_is_an_error) {
    EXPECT_EQ(firstCode(load(technique("Pass=C;"))), 2011);
}

TEST(Conformance, case_10_a_wrong_number_of_options_is_an_error) {
    EXPECT_EQ(firstCode(load(technique("Pass=gFast?A:B:A;"))), 2008);
    EXPECT_EQ(firstCode(load(technique("Pass=gFast?A;"))), 2008);
    EXPECT_EQ(firstCode(load(technique("Pass=A:B;"))), 2008);
}

TEST(Conformance, case_11_case_does_not_matter) {
    const std::string passes = "pass A < string SCRIPT = \"draw=BUFFER;\"; > { } pass B { }";
    EXPECT_EQ(ran(technique("CLEAR=color; pass=a; loopbycount=gn; LOOPEND;", passes)),
              (Lines{"clear color0 with default", "A: buffer to app"}));
}

TEST(Conformance, case_12_a_draw_names_every_bound_target) {
    struct Recorder : Log {
        BoundTargets last;
        Result<void> draw(const Pass&, DrawKind, const ScriptState& state) override {
            last = state.targets;
            return {};
        }
    };
    Recorder sink;
    ASSERT_TRUE(
        runScripts(loaded(technique("RenderColorTarget0=gX; RenderColorTarget3=gY; RenderDepthStencilTarget=; Pass=A;")), "", sink));
    BoundTargets expected;
    expected.colors[0] = "gX";
    expected.colors[3] = "gY";
    EXPECT_EQ(sink.last, expected);
}

TEST(Conformance, case_13_a_pass_that_wrote_a_target_has_ended_before_another_one_reads_it) {
    const Effect effect = loaded(technique("RenderColorTarget=gX; Pass=A; RenderColorTarget=gY; Pass=B;"));
    Log log;
    ASSERT_TRUE(runScripts(effect, "", log));
    EXPECT_EQ(log.lines, (Lines{"bind gX / app", "begin A", "A: geometry to gX", "end A", "bind gY / app", "begin B", "B: geometry to gY",
                                "end B", "bind app / app"}));
}

} // namespace
} // namespace tegument::test
