#pragma once
// What a script asks of an engine, as lines of text: by docs/samples/player, and by this project's own runner.

#include "docs/samples/player/script_player.h"
#include "host/support/text.h"
#include "tests/effect/support.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

namespace tegument::test {

using Lines = std::vector<std::string>;

template <class Targets>
std::string targetsText(const Targets& targets) {
    std::string line;
    for (const std::optional<std::string>& color : targets.colors)
        line += ' ' + (!color ? "-" : color->empty() ? "app" : *color);
    return line + " / " + (!targets.depth ? "-" : targets.depth->empty() ? "app" : *targets.depth);
}

inline std::string numbersText(const std::vector<double>& numbers) {
    return fmt::format("{}", fmt::join(numbers, " "));
}

struct PlayedParameter {
    std::string name;
    script_player::Value value;
};

/// Parameters by name in lower case: their defaults, and what scripts have set. Scripts ignore case.
class PlayedParameters {
public:
    PlayedParameters() = default;
    explicit PlayedParameters(const Effect& effect) {
        for (const Parameter& parameter : effect.parameters)
            if (!parameter.defaultValue)
                add({parameter.name, {{0}, parameter.type.base == BaseType::Bool}});
            else if (const auto* numbers = std::get_if<std::vector<double>>(&*parameter.defaultValue))
                add({parameter.name, {{numbers->begin(), numbers->end()}, parameter.type.base == BaseType::Bool}});
    }
    void add(const PlayedParameter& parameter) { all_[toLower(parameter.name)] = parameter; }
    [[nodiscard]] PlayedParameter& named(const std::string& name) {
        const auto found = all_.find(toLower(name));
        if (found == all_.end()) throw std::runtime_error("no parameter " + name);
        return found->second;
    }

private:
    std::map<std::string, PlayedParameter> all_;
};

class ByPlayer : public script_player::Engine {
public:
    explicit ByPlayer(PlayedParameters parameters) : parameters_(std::move(parameters)) {}
    Lines lines;
    int targetChanges = 0;

    void setTargets(const script_player::Targets& targets) override {
        targets_ = targets;
        ++targetChanges;
    }
    void clear(script_player::Clear what, std::optional<std::size_t> place, const std::vector<float>& value) override {
        for (std::size_t i = 0; i < script_player::kColors; ++i)
            if (what != script_player::Clear::Color ? i == 0 : place ? i == *place : targets_.colors[i].has_value())
                lines.push_back(fmt::format("clear {} {} of{}: {}", static_cast<int>(what), i, targetsText(targets_),
                                            numbersText(std::vector<double>(value.begin(), value.end()))));
    }
    void draw(const script_player::Pass& pass, script_player::Draw what) override {
        constexpr std::array kNames = {"geometry", "buffer", "scene", "compute"};
        lines.push_back(fmt::format("{} draws {} to{}", pass.name, kNames[static_cast<std::size_t>(what)], targetsText(targets_)));
    }
    script_player::Value value(const std::string& parameter) override { return parameters_.named(parameter).value; }
    void setNumber(const std::string& parameter, float number) override {
        PlayedParameter& named = parameters_.named(parameter);
        named.value.numbers = {number};
        lines.push_back(fmt::format("{} = {}", named.name, number));
    }
    void external() override { lines.push_back("external to" + targetsText(targets_)); }

private:
    PlayedParameters parameters_;
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
                                    targetsText(state.targets), numbersText(named.empty() ? otherwise : valuesOf(named))));
        return {};
    }
    Result<void> beginPass(const Technique&, const Pass&) override { return {}; }
    Result<void> endPass(const Pass&) override { return {}; }
    Result<void> draw(const Pass& pass, DrawKind kind, const ScriptState& state) override {
        const std::string what = kind == DrawKind::Geometry  ? "geometry"
                                 : kind == DrawKind::Buffer  ? "buffer"
                                 : kind == DrawKind::Compute ? "compute"
                                                             : "scene";
        lines.push_back(fmt::format("{} draws {} to{}", pass.name, what, targetsText(state.targets)));
        return {};
    }
    Result<void> external(const ScriptState& state) override {
        lines.push_back("external to" + targetsText(state.targets));
        return {};
    }
    [[nodiscard]] std::vector<double> read(const Parameter& parameter) const override { return valuesOf(parameter.name); }
    void write(const Parameter& parameter, double value) override {
        parameters_.named(parameter.name).value.numbers = {static_cast<float>(value)};
        lines.push_back(fmt::format("{} = {}", parameter.name, value));
    }

private:
    [[nodiscard]] std::vector<double> valuesOf(const std::string& parameter) const {
        const std::vector<float>& numbers = parameters_.named(parameter).value.numbers;
        return {numbers.begin(), numbers.end()};
    }

    mutable PlayedParameters parameters_;
};

inline Lines runnersCalls(const Effect& effect, const Technique& technique) {
    ByRunner runner(effect);
    const Result<void> ran = runScripts(effect, technique.name, runner);
    EXPECT_TRUE(ran) << (ran ? "" : format(ran.error()));
    return runner.lines;
}

} // namespace tegument::test
