// docs/samples/player beside this project's own runner of scripts: the same clears, draws and numbers, with the same targets, in the same
// order.
#include "tests/effect/player_calls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace tegument::test {
namespace {

script_player::Technique steps(const Technique& technique) {
    script_player::Technique steps{technique.name, technique.annotations.string("Script"), {}};
    for (const Pass& pass : technique.passes)
        steps.passes.push_back({pass.name, pass.annotations.string("Script")});
    return steps;
}

/// Gives the number of lines.
std::size_t expectTheSame(const Effect& effect, const Technique& technique) {
    const Lines expected = runnersCalls(effect, technique);
    ByPlayer player{PlayedParameters(effect)};
    script_player::play(steps(technique), player);
    EXPECT_EQ(player.lines, expected) << technique.name;
    return expected.size();
}

Effect effectOf(const std::string& script, const std::string& passes) {
    return loaded("Texture2D gX : RENDERCOLORTARGET; Texture2D gY : RENDERCOLORTARGET; Texture2D gZ : RENDERDEPTHSTENCILTARGET;\n"
                  "int gN = 2; int gM = 3; int gNone = 0; float gIndex; float gInner; bool gFast = true; bool gSlow = false;\n"
                  "float4 gRed = {1, 0, 0, 1}; float gFar = 0.25;\n"
                  "technique T < string Script = \"" +
                  script + "\"; > { " + passes + " }");
}

/// Of scripts that the front end refuses.
std::string played(const std::string& script, const std::string& passScript = "Draw=Geometry;") {
    const Effect effect = effectOf("Pass=A;", "pass A { } pass B { }");
    script_player::Technique technique = steps(effect.techniques.front());
    technique.script = script;
    technique.passes[0].script = passScript;
    ByPlayer player{PlayedParameters(effect)};
    try {
        script_player::play(technique, player);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(ScriptPlayer, does_what_this_project_s_runner_does_with_every_kind_of_command) {
    for (const auto& [script, passes] : {
             std::pair<std::string, std::string>("Pass=A; Pass=B", "pass A { } pass B { }"),
             {"CLEAR=color; pass=a; loopbycount=gn; LOOPEND;", "pass A < string Script = \"\"; > { } pass B { }"},
             {"LoopByCount=gN; LoopGetIndex=gIndex; LoopByCount=gM; LoopGetIndex=gInner; LoopGetCount=gInner; Pass=B; LoopEnd; LoopEnd=;",
              "pass A { } pass B { }"},
             {"LoopByCount=gNone; Pass=A; LoopByCount=gM; Pass=A; LoopEnd; Pass=A; LoopEnd; Pass=B;", "pass A { } pass B { }"},
             {"RenderColorTarget=gX; RenderColorTarget3=gY; RenderDepthStencilTarget=gZ; ClearSetColor=gRed; ClearSetDepth=gFar;"
              "Clear=Color; Clear=Color3; Clear=Color5; Clear=Depth; Clear=Stencil; Pass=A; RenderColorTarget3=; RenderColorTarget0=; "
              "Pass=B;",
              "pass A < string Script = \"RenderColorTarget=gY; RenderDepthStencilTarget=; Draw=Buffer; RenderColorTarget=; Draw=Geometry; "
              "Draw=Scene;\"; > { } pass B { }"},
             {"Pass=gFast?A:B; Pass=gSlow?A:B; Pass=gN?A:A:B; ScriptExternal=Color;", "pass A { } pass B { }"},
         }) {
        const Effect effect = effectOf(script, passes);
        EXPECT_GT(expectTheSame(effect, effect.techniques.front()), 0U) << script;
    }
}

TEST(ScriptPlayer, does_what_this_project_s_runner_does_with_every_technique_of_every_effect) {
    std::size_t techniques = 0;
    for (const auto& entry : std::filesystem::directory_iterator("effects")) {
        if (entry.path().extension() != ".fx") continue;
        const Effect effect = loaded(loadEffect(entry.path()));
        for (const Technique& technique : effect.techniques) {
            EXPECT_GT(expectTheSame(effect, technique), 0U) << entry.path() << ' ' << technique.name;
            ++techniques;
        }
    }
    EXPECT_GE(techniques, 40U);
}

TEST(ScriptPlayer, sets_targets_where_they_change_and_no_more_often) {
    const Effect effect =
        effectOf("Clear=Color; Clear=Depth; Pass=A; Pass=B; RenderColorTarget=gX; Pass=A; Pass=B;", "pass A { } pass B { }");
    ByPlayer player{PlayedParameters(effect)};
    script_player::play(steps(effect.techniques.front()), player);
    EXPECT_EQ(player.targetChanges, 2);
}

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i)
        all += text;
    return all;
}

TEST(ScriptPlayer, ends_where_a_script_does_not) {
    EXPECT_EQ(played(repeated("LoopByCount=gM;", 100000)), "technique T: too many loops in loops");
    const std::string loops = repeated("LoopByCount=gM;", 60) + repeated("LoopEnd;", 60);
    EXPECT_EQ(played(loops), "technique T: the script does not end");
    const std::string options = "Clear=gN?" + repeated("Color:", 200000) + "Color;";
    EXPECT_EQ(played(options), "");
    EXPECT_EQ(played(repeated("LoopByCount=gM;", 4) + options + repeated("LoopEnd;", 4)), "technique T: the script does not end");
    EXPECT_EQ(played("Pass=gN?" + repeated("A:", 1000) + "B;"), "");
}

TEST(ScriptPlayer, passes_over_what_scripts_reserve) {
    EXPECT_EQ(played("Hint=x; GeometryList=y; LoopByType=; LoopUpdate=; ScriptSignature=z; Pass=A;"), "");
}

TEST(ScriptPlayer, gives_four_numbers_to_each_clear_of_a_colour) {
    class Clears : public ByPlayer {
    public:
        using ByPlayer::ByPlayer;
        std::size_t least = 9;
        void clear(script_player::Clear what, std::optional<std::size_t>, const std::vector<float>& value) override {
            if (what == script_player::Clear::Color) least = std::min(least, value.size());
        }
    };
    Clears engine{PlayedParameters(effectOf("Pass=A;", "pass A { }"))};
    script_player::play({"T", "ClearSetColor=gFar; Clear=Color; Clear=Color0;", {}}, engine);
    EXPECT_EQ(engine.least, 4U);
}

TEST(ScriptPlayer, says_what_a_script_does_wrong) {
    EXPECT_EQ(played("Pass=C;"), "technique T: no pass C");
    EXPECT_EQ(played("Pas=A;"), "technique T: no command PAS");
    EXPECT_EQ(played("LoopByCount=gN; Pass=A;"), "technique T: a loop has no end");
    EXPECT_EQ(played("LoopEnd;"), "technique T: LoopEnd without a loop");
    EXPECT_NE(played("Pass=gM?A:B;").find("no option 3"), std::string::npos);
    EXPECT_EQ(played("Clear=Everything;"), "technique T: no clear of Everything");
    EXPECT_EQ(played("Draw=Buffer;"), "technique T: no command DRAW");
    EXPECT_EQ(played("=X;"), "technique T: no command ");
    EXPECT_EQ(played("Pass=A;", "Pass=A;"), "technique T: no command PASS");
}

} // namespace tegument::test
