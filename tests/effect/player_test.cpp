// docs/samples/player beside this project's own runner of scripts: the same clears, draws and numbers, with the same targets, in the same
// order.
#include "docs/samples/player/script_player.h"
#include "host/support/text.h"
#include "tests/effect/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace tegument::test {
namespace {

using Lines = std::vector<std::string>;
using Values = std::map<std::string, std::vector<double>>;

std::string text(const auto& targets) {
    std::string line;
    for (const std::optional<std::string>& color : targets.colors)
        line += ' ' + (!color ? "-" : color->empty() ? "app" : *color);
    return line + " / " + (!targets.depth ? "-" : targets.depth->empty() ? "app" : *targets.depth);
}

std::string text(const std::vector<double>& numbers) {
    return fmt::format("{}", fmt::join(numbers, " "));
}

/// Parameters: their defaults, and what scripts have set.
class Parameters {
public:
    explicit Parameters(const Effect& effect) : effect_(effect) {}

    /// Scripts ignore case.
    [[nodiscard]] const Parameter& named(const std::string& name) const {
        for (const Parameter& parameter : effect_.parameters)
            if (toLower(parameter.name) == toLower(name)) return parameter;
        throw std::runtime_error("no parameter " + name);
    }
    [[nodiscard]] std::vector<double> of(const Parameter& parameter) const {
        if (const auto set = set_.find(parameter.name); set != set_.end()) return set->second;
        return parameter.defaultValue ? std::get<std::vector<double>>(*parameter.defaultValue) : std::vector<double>{0};
    }
    void set(const Parameter& parameter, double value) { set_[parameter.name] = {value}; }

private:
    const Effect& effect_;
    Values set_;
};

class ByPlayer : public script_player::Engine {
public:
    explicit ByPlayer(const Effect& effect) : parameters_(effect) {}
    Lines lines;
    int targetChanges = 0;

    void setTargets(const script_player::Targets& targets) override {
        targets_ = targets;
        ++targetChanges;
    }
    void clear(script_player::Clear what, std::optional<std::size_t> place, const std::vector<float>& value) override {
        for (std::size_t i = 0; i < script_player::kColors; ++i)
            if (what != script_player::Clear::Color ? i == 0 : place ? i == *place : targets_.colors[i].has_value())
                lines.push_back(fmt::format("clear {} {} of{}: {}", static_cast<int>(what), i, text(targets_),
                                            text(std::vector<double>(value.begin(), value.end()))));
    }
    void draw(const script_player::Pass& pass, script_player::Draw what) override {
        constexpr std::array kNames = {"geometry", "buffer", "scene", "compute"};
        lines.push_back(fmt::format("{} draws {} to{}", pass.name, kNames[static_cast<std::size_t>(what)], text(targets_)));
    }
    script_player::Value value(const std::string& parameter) override {
        const Parameter& named = parameters_.named(parameter);
        const std::vector<double> numbers = parameters_.of(named);
        return {{numbers.begin(), numbers.end()}, named.type.base == BaseType::Bool};
    }
    void setNumber(const std::string& parameter, float number) override {
        const Parameter& named = parameters_.named(parameter);
        parameters_.set(named, static_cast<double>(number));
        lines.push_back(fmt::format("{} = {}", named.name, number));
    }
    void external() override { lines.push_back("external to" + text(targets_)); }

private:
    Parameters parameters_;
    script_player::Targets targets_;
};

class ByRunner : public ScriptSink {
public:
    explicit ByRunner(const Effect& effect) : parameters_(effect) {}
    Lines lines;

    Result<void> targetsChanged(const BoundTargets&) override { return {}; }
    Result<void> clear(ClearKind what, int index, const ScriptState& state) override {
        const std::string& named = what == ClearKind::Color   ? state.clear.color
                                   : what == ClearKind::Depth ? state.clear.depth
                                                              : state.clear.stencil;
        const std::vector<double> otherwise = what == ClearKind::Color   ? std::vector<double>{0, 0, 0, 0}
                                              : what == ClearKind::Depth ? std::vector<double>{1}
                                                                         : std::vector<double>{0};
        lines.push_back(fmt::format("clear {} {} of{}: {}", static_cast<int>(what), what == ClearKind::Color ? index : 0,
                                    text(state.targets),
                                    text(named.empty() ? otherwise : rounded(parameters_.of(parameters_.named(named))))));
        return {};
    }
    Result<void> beginPass(const Technique&, const Pass&) override { return {}; }
    Result<void> endPass(const Pass&) override { return {}; }
    Result<void> draw(const Pass& pass, DrawKind kind, const ScriptState& state) override {
        const std::string what = kind == DrawKind::Geometry  ? "geometry"
                                 : kind == DrawKind::Buffer  ? "buffer"
                                 : kind == DrawKind::Compute ? "compute"
                                                             : "scene";
        lines.push_back(fmt::format("{} draws {} to{}", pass.name, what, text(state.targets)));
        return {};
    }
    Result<void> external(const ScriptState& state) override {
        lines.push_back("external to" + text(state.targets));
        return {};
    }
    [[nodiscard]] std::vector<double> read(const Parameter& parameter) const override { return parameters_.of(parameter); }
    void write(const Parameter& parameter, double value) override {
        parameters_.set(parameter, value);
        lines.push_back(fmt::format("{} = {}", parameter.name, value));
    }

private:
    static std::vector<double> rounded(std::vector<double> numbers) {
        for (double& number : numbers)
            number = static_cast<double>(static_cast<float>(number));
        return numbers;
    }

    Parameters parameters_;
};

script_player::Technique steps(const Technique& technique) {
    script_player::Technique steps{technique.name, technique.annotations.string("Script"), {}};
    for (const Pass& pass : technique.passes)
        steps.passes.push_back({pass.name, pass.annotations.string("Script")});
    return steps;
}

/// Gives the number of lines.
std::size_t expectTheSame(const Effect& effect, const Technique& technique) {
    ByRunner runner(effect);
    const Result<void> ran = runScripts(effect, technique.name, runner);
    EXPECT_TRUE(ran) << (ran ? "" : format(ran.error()));
    ByPlayer player(effect);
    script_player::play(steps(technique), player);
    EXPECT_EQ(player.lines, runner.lines) << technique.name;
    return runner.lines.size();
}

Effect effectOf(const std::string& script, const std::string& passes) {
    return loaded("Texture2D gX : RENDERCOLORTARGET; Texture2D gY : RENDERCOLORTARGET; Texture2D gZ : RENDERDEPTHSTENCILTARGET;\n"
                  "int gN = 2; int gM = 3; int gNone = 0; float gIndex; float gInner; bool gFast = true; bool gSlow = false;\n"
                  "float4 gRed = {1, 0, 0, 1}; float gFar = 0.25;\n"
                  "technique T < string Script = \"" +
                  script + "\"; > { " + passes + " }");
}

std::string played(const std::string& script, const std::string& passes = "pass A { } pass B { }") {
    const Effect effect = effectOf("Pass=A;", "pass A { } pass B { }");
    script_player::Technique technique = steps(effectOf("Pass=A;", passes).techniques.front());
    technique.script = script;
    ByPlayer player(effect);
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
    ByPlayer player(effect);
    script_player::play(steps(effect.techniques.front()), player);
    EXPECT_EQ(player.targetChanges, 2);
}

TEST(ScriptPlayer, says_what_a_script_does_wrong) {
    EXPECT_EQ(played("Pass=C;"), "technique T: no pass C");
    EXPECT_EQ(played("Pas=A;"), "technique T: no command PAS");
    EXPECT_EQ(played("LoopByCount=gN; Pass=A;"), "technique T: a loop has no end");
    EXPECT_EQ(played("LoopEnd;"), "technique T: LoopEnd without a loop");
    EXPECT_NE(played("Pass=gM?A:B;").find("no option 3"), std::string::npos);
    EXPECT_EQ(played("Clear=Everything;"), "technique T: no clear of Everything");
    EXPECT_EQ(played("Draw=Buffer;"), "technique T: no command DRAW");
}

} // namespace tegument::test
