// The parser and interpreter of DXSAS scripts. The 13 cases of docs/scripts.md are in conformance_test.cpp.
// Direct3D 9 draws lights of their own passes where shader model 3 has no slots for them in one (effects/passes/light_by_light.fxh);
// everything else has one pass, whatever the number of lights.

#include "tests/effect/support.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tegument::test {
namespace {

using Lines = std::vector<std::string>;

/// An effect with targets, clear values and passes A, B (without scripts) for the technique script under test.
std::string techniqueOf(const std::string& script) {
    return "Texture2D gX : RENDERCOLORTARGET; Texture2D gY : RENDERCOLORTARGET; Texture2D gZ : RENDERDEPTHSTENCILTARGET;\n"
           "float4 gRed = {1, 0, 0, 1}; float gFar = 1; int gN = 2; int gM = 3; float gIndex; int gCount; bool gFast = true;\n"
           "technique T < string Script = \"" +
           script + "\"; > { pass A { } pass B { } }";
}

TEST(ScriptDefaults, a_technique_without_script_runs_its_passes_in_order) {
    EXPECT_EQ(ran("technique T { pass A { } pass B { } }"), (Lines{"A: geometry to app", "B: geometry to app"}));
}

TEST(ScriptDefaults, an_effect_without_global_script_runs_its_first_technique) {
    EXPECT_EQ(ran("technique T { pass A { } } technique U { pass B { } }"), (Lines{"A: geometry to app"}));
}

TEST(ScriptDefaults, a_pass_script_without_draw_draws_nothing) {
    EXPECT_EQ(ran("technique T { pass A < string Script = \"\"; > { } }"), Lines{});
}

TEST(ScriptDefaults, clear_values_are_the_defaults_until_set) {
    EXPECT_EQ(ran(techniqueOf("Clear=Color; ClearSetColor=gRed; Clear=Color; Clear=Depth; Clear=Stencil;")),
              (Lines{"clear color0 with default", "clear color0 with gRed", "clear depth with default", "clear stencil with default"}));
}

TEST(Scripts, whitespace_and_literal_borders_do_not_matter) {
    EXPECT_EQ(ran(techniqueOf(" Pass = A ; \"\n \" Pa\" \"ss=B")), (Lines{"A: geometry to app", "B: geometry to app"}));
}

TEST(Scripts, positions_point_at_the_command_in_its_literal) {
    const Result<Effect> effect = load("technique T < string Script = \"Pass=A;\"\n    \"Pass=A; Pass=C;\"; > { pass A { } }");
    ASSERT_FALSE(effect);
    EXPECT_EQ(effect.error().diagnostics[0].at.line, 2);
    EXPECT_EQ(effect.error().diagnostics[0].at.column, 14);
}

TEST(Scripts, an_index_less_clear_clears_every_bound_colour_target) {
    EXPECT_EQ(ran(techniqueOf("RenderColorTarget0=gX; RenderColorTarget2=gY; Clear=Color;")),
              (Lines{"bind gX / app", "bind gX gY / app", "clear color0 with default", "clear color2 with default", "bind app / app"}));
}

TEST(Scripts, an_indexed_clear_clears_one_target) {
    EXPECT_EQ(ran(techniqueOf("RenderColorTarget1=gY; Clear=Color1;")),
              (Lines{"bind app gY / app", "clear color1 with default", "bind app / app"}));
}

TEST(Scripts, clearing_a_target_that_is_not_bound_does_nothing) {
    EXPECT_EQ(ran(techniqueOf("Clear=Color5;")), Lines{});
}

TEST(Scripts, an_empty_target_is_the_callers_in_place_0_and_none_elsewhere) {
    EXPECT_EQ(ran(techniqueOf("RenderColorTarget0=gX; RenderColorTarget1=gY; RenderDepthStencilTarget=gZ;"
                              "RenderColorTarget0=; RenderColorTarget1=; RenderDepthStencilTarget=;")),
              (Lines{"bind gX / app", "bind gX gY / app", "bind gX gY / gZ", "bind app gY / gZ", "bind app / gZ", "bind app / app"}));
}

TEST(Scripts, the_caller_of_a_pass_is_its_technique) {
    const std::string text = "Texture2D gX : RENDERCOLORTARGET; Texture2D gY : RENDERCOLORTARGET;"
                             "technique T < string Script = \"RenderColorTarget=gX; Pass=A;\"; > {"
                             " pass A < string Script = \"RenderColorTarget=gY; Draw=Buffer; RenderColorTarget=; Draw=Buffer;\"; > { } }";
    EXPECT_EQ(ran(text),
              (Lines{"bind gX / app", "bind gY / app", "A: buffer to gY", "bind gX / app", "A: buffer to gX", "bind app / app"}));
}

TEST(Scripts, what_a_pass_sets_ends_with_it) {
    const std::string text = "Texture2D gX : RENDERCOLORTARGET; float4 gRed;"
                             "technique T < string Script = \"Pass=A; Clear=Color;\"; > {"
                             " pass A < string Script = \"ClearSetColor=gRed; RenderColorTarget=gX; Draw=Scene;\"; > { } }";
    EXPECT_EQ(ran(text), (Lines{"bind gX / app", "A: scene to gX", "bind app / app", "clear color0 with default"}));
}

TEST(Scripts, passes_begin_and_end_around_their_scripts) {
    const Effect effect = loaded("technique T { pass A < string Script = \"Draw=Buffer; Draw=Buffer;\"; > { } }");
    Log log;
    ASSERT_TRUE(runScripts(effect, "", log));
    EXPECT_EQ(log.lines, (Lines{"begin A", "A: buffer to app", "A: buffer to app", "end A"}));
}

TEST(Scripts, external_rendering_keeps_targets_and_clear_values) {
    EXPECT_EQ(ran(techniqueOf("RenderColorTarget=gX; ClearSetColor=gRed; ScriptExternal=Color; Clear=Color;")),
              (Lines{"bind gX / app", "external", "bind gX / app", "clear color0 with gRed", "bind app / app"}));
}

TEST(Scripts, a_bool_selects_the_first_option_when_true) {
    EXPECT_EQ(ran(techniqueOf("Pass=gFast?A:B;")), (Lines{"A: geometry to app"}));
    EXPECT_EQ(ran(techniqueOf("Pass=gFast?A:B;"), {{"gFast", 0}}), (Lines{"B: geometry to app"}));
}

TEST(Scripts, a_number_selects_by_index_from_0) {
    EXPECT_EQ(ran(techniqueOf("Pass=gN?A:B:A;"), {{"gN", 1}}), (Lines{"B: geometry to app"}));
    EXPECT_EQ(ran(techniqueOf("Pass=gIndex?A:B;"), {{"gIndex", 1.9}}), (Lines{"B: geometry to app"}));
}

TEST(Scripts, a_selector_out_of_range_is_an_error) {
    EXPECT_EQ(ran(techniqueOf("Pass=gN?A:B;")), (Lines{"TG2301"}));
    EXPECT_EQ(ran(techniqueOf("Pass=gN?A:B;"), {{"gN", -1}}), (Lines{"TG2301"}));
}

TEST(Scripts, targets_may_be_selected_too) {
    EXPECT_EQ(ran(techniqueOf("RenderColorTarget=gFast?gX:; Pass=A;")), (Lines{"bind gX / app", "A: geometry to gX", "bind app / app"}));
    EXPECT_EQ(ran(techniqueOf("RenderColorTarget=gFast?gX:; Pass=A;"), {{"gFast", 0}}), (Lines{"A: geometry to app"}));
}

TEST(Scripts, the_global_script_chooses_the_technique) {
    const std::string text = "int gQuality = 1; float Script : STANDARDSGLOBAL < string Script = \"Technique=gQuality?Low:High;\"; > = 0.8;"
                             "technique Low { pass A { } } technique High { pass B { } }";
    EXPECT_EQ(ran(text), (Lines{"B: geometry to app"}));
    EXPECT_EQ(loaded(text).defaultTechnique()->name, "High");
    EXPECT_EQ(ran(text, {}, "low"), (Lines{"A: geometry to app"}));
}

TEST(Scripts, the_loop_count_can_be_read) {
    EXPECT_EQ(ran(techniqueOf("LoopByCount=gN; LoopGetCount=gCount; LoopEnd;")), (Lines{"gCount = 2", "gCount = 2"}));
}

TEST(Scripts, a_count_changed_inside_its_loop_has_no_effect) {
    EXPECT_EQ(ran(techniqueOf("LoopByCount=gN; LoopGetIndex=gN; Pass=A; LoopEnd;")),
              (Lines{"gN = 0", "A: geometry to app", "gN = 1", "A: geometry to app"}));
}

TEST(Scripts, counts_that_are_no_counts_are_errors) {
    EXPECT_EQ(ran(techniqueOf("LoopByCount=gN; LoopEnd;"), {{"gN", -1}}), (Lines{"TG2302"}));
    EXPECT_EQ(ran(techniqueOf("LoopByCount=gN; LoopEnd;"), {{"gN", 1e9}}), (Lines{"TG2302"}));
    EXPECT_EQ(ran(techniqueOf("LoopByCount=gN; LoopEnd;"), {{"gN", std::nan("")}}), (Lines{"TG2302"}));
}

TEST(Scripts, an_error_of_the_sink_stops_the_run) {
    class Refusing : public Log {
        Result<void> draw(const Pass&, DrawKind, const ScriptState&) override { return inputError(4001, {}, "no"); }
    };
    Refusing sink;
    const Effect effect = loaded("technique T { pass A { } pass B { } }");
    const Result<void> done = runScripts(effect, "", sink);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().diagnostics[0].code, 4001);
    EXPECT_EQ(sink.lines, (Lines{"begin A"}));
}

TEST(Scripts, commands_on_the_wrong_level_are_errors) {
    EXPECT_EQ(firstCode(load(techniqueOf("Draw=Buffer;"))), 2005);
    EXPECT_EQ(firstCode(load(techniqueOf("Technique=T;"))), 2005);
    EXPECT_EQ(firstCode(load("technique T { pass A < string Script = \"Pass=A;\"; > { } }")), 2005);
}

TEST(Scripts, misused_values_are_errors) {
    for (const char* script : {"Pass", "Pass=", "Pass=A?B", "Pass=?A:B", "Pass=A B=", "Clear=Color8", "RenderColorTarget8=gX",
                               "Clear0=Color", "LoopByCount=gN LoopEnd", "=A", "LoopByCount=;", "Pass=A:B"})
        EXPECT_NE(firstCode(load(techniqueOf(script))), 0) << script;
}

TEST(Scripts, parameters_must_fit_their_use) {
    EXPECT_EQ(firstCode(load(techniqueOf("ClearSetColor=gFar;"))), 2014);
    EXPECT_EQ(firstCode(load(techniqueOf("LoopByCount=gRed; LoopEnd;"))), 2014);
    EXPECT_EQ(firstCode(load(techniqueOf("RenderColorTarget=gZ;"))), 2014);
    EXPECT_EQ(firstCode(load(techniqueOf("RenderColorTarget=gRed;"))), 2014);
}

TEST(Scripts, reserved_commands_warn_and_do_nothing) {
    const Effect effect = loaded(techniqueOf("Hint=fast; LoopUpdate; Pass=A;"));
    ASSERT_EQ(effect.warnings.size(), 2u);
    EXPECT_EQ(effect.warnings[0].code, 2009);
    Log log;
    ASSERT_TRUE(runScripts(effect, "", log));
    EXPECT_EQ(log.lines, (Lines{"begin A", "A: geometry to app", "end A"}));
}

TEST(Scripts, names_take_the_spelling_of_their_declaration) {
    const Effect effect = loaded(techniqueOf("rendercolortarget=GX; pass=a;"));
    EXPECT_EQ(effect.techniques[0].script.commands[0].options[0], "gX");
    EXPECT_EQ(effect.techniques[0].script.commands[1].options[0], "A");
}

using Defines = std::vector<std::pair<std::string, std::string>>;

const Defines kThreeLamps = {{"TEGUMENT_LAMPS", "3"}};
const Defines kStudio = {{"TEGUMENT_LAMPS", "3"}, {"TEGUMENT_SURROUNDINGS", "1"}};

/// The passes that a technique has on Direct3D 9 only, and that its script plays there.
std::vector<std::string> passesOfNine(const std::string& file, const std::string& name, const Defines& defines) {
    const LoadOptions options{.defines = defines};
    const Effect effect = loaded(loadEffect(file, options));
    const Effect nine = loaded(loadEffectOfDirect3D9(file, options));
    const Technique& one = *effect.findTechnique(name);
    const Technique& other = *nine.findTechnique(name);
    const std::string script = other.annotations.string("Script").value_or("");
    std::vector<std::string> names;
    for (const Pass& pass : other.passes)
        if (std::ranges::find(one.passes, pass.name, &Pass::name) == one.passes.end() && script.find(pass.name) != std::string::npos)
            names.push_back(pass.name);
    EXPECT_EQ(other.passes.size(), one.passes.size() + names.size());
    return names;
}

using Names = std::vector<std::string>;

TEST(LightByLight, of_one_lamp_is_one_pass_in_main) {
    EXPECT_EQ(passesOfNine("effects/Main.fx", "DEonLuebke", {}), Names());
    EXPECT_EQ(passesOfNine("effects/Main.fx", "DEonLuebke", {{"TEGUMENT_LAMPS", "1"}}), Names());
    EXPECT_EQ(passesOfNine("effects/Main.fx", "DEonLuebke", {{"TEGUMENT_SURROUNDINGS", "1"}}), Names());
}

TEST(LightByLight, is_a_pass_for_each_light_on_direct3d_9_alone) {
    EXPECT_EQ(passesOfNine("effects/Main.fx", "DEonLuebke", kThreeLamps), (Names{"SkinLamp1", "SkinLamp2", "SkinLamp3"}));
    EXPECT_EQ(passesOfNine("effects/Main.fx", "Lambert", kStudio),
              (Names{"LambertSurroundings", "LambertLamp1", "LambertLamp2", "LambertLamp3"}));
    EXPECT_EQ(passesOfNine("effects/Main.fx", "Gosselin", kThreeLamps),
              (Names{"GosselinLamp1", "GosselinLamp2", "GosselinLamp3", "GosselinEvenLamp1", "GosselinEvenLamp2", "GosselinEvenLamp3"}));
    EXPECT_EQ(passesOfNine("effects/Pyramid.fx", "PyramidLinked", {{"TEGUMENT_LAMPS", "1"}}), Names{"PyramidLamp1"});
    EXPECT_EQ(passesOfNine("effects/peers/Preintegrated.fx", "PreintegratedPenumbra", {{"TEGUMENT_SURROUNDINGS", "1"}}),
              Names{"PreintegratedSurroundings"});
}

TEST(LightByLight, is_not_asked_where_one_pass_has_slots_for_all) {
    EXPECT_EQ(passesOfNine("effects/peers/Separable.fx", "Separable7", kStudio), Names());
    EXPECT_EQ(passesOfNine("effects/peers/Burley.fx", "Burley20", kStudio), Names());
}

TEST(LightByLight, adds_to_the_picture_behind_the_pass_that_it_adds_to) {
    const Effect nine = loaded(loadEffectOfDirect3D9("effects/Main.fx", {.defines = kThreeLamps}));
    const std::vector<Pass>& passes = nine.findTechnique("DEonLuebke")->passes;
    const Pass& lamp = passes.back();
    EXPECT_EQ(passes[passes.size() - 4].name, "Final");
    EXPECT_TRUE(lamp.state.depthTest);
    EXPECT_FALSE(lamp.state.depthWrite);
    EXPECT_TRUE(lamp.state.targets[0].enable);
    EXPECT_EQ(lamp.state.targets[0].src, BlendFactor::One);
    EXPECT_EQ(lamp.state.targets[0].dst, BlendFactor::One);
    EXPECT_EQ(lamp.state.depthCompare, CompareOp::Equal) << "no more than once at a pixel";
}

} // namespace
} // namespace tegument::test
