#pragma once
// Effects from literal texts, and a sink that writes down what scripts do.

#include "host/effect/load.h"
#include "host/effect/model.h"
#include "host/effect/script_run.h"

#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

namespace tegument::test {

using Files = std::map<std::string, std::string>;

/// Loads "main.fx" of these files; nothing is read from disk.
inline Result<Effect> load(const Files& files, const LoadOptions& options = {}) {
    return loadEffect("main.fx", options, [&](const std::filesystem::path& path) -> Result<std::string> {
        const auto file = files.find(path.string());
        if (file == files.end()) return inputError(5001, {path.string()}, "no such file");
        return file->second;
    });
}

inline Result<Effect> load(const std::string& text) {
    return load(Files{{"main.fx", text}});
}

/// The effect, or an empty one whose load failed the test with its diagnostics.
inline Effect loaded(const Result<Effect>& effect) {
    if (effect) return *effect;
    throw std::runtime_error(format(effect.error()));
}

inline Effect loaded(const std::string& text) {
    return loaded(load(text));
}

/// The code of the first diagnostic; 0 when loading worked.
inline int firstCode(const Result<Effect>& effect) {
    return effect ? 0 : effect.error().diagnostics[0].code;
}

/// The parameter's default value as numbers.
inline std::vector<double> numbers(const Effect& effect, const std::string& name) {
    const Parameter* parameter = effect.findParameter(name);
    if (parameter == nullptr || !parameter->defaultValue) throw std::runtime_error("no default value: " + name);
    return std::get<std::vector<double>>(*parameter->defaultValue);
}

/// One line for each call, in order.
class Log : public ScriptSink {
public:
    std::vector<std::string> lines;
    std::map<std::string, double> values; // instead of default values

    Result<void> targetsChanged(const BoundTargets& targets) override {
        std::string line = "bind";
        for (const std::optional<std::string>& color : targets.colors)
            if (color) line += ' ' + (color->empty() ? "app" : *color);
        return add(line + " / " + (!targets.depth ? "none" : targets.depth->empty() ? "app" : *targets.depth));
    }
    Result<void> clear(ClearKind what, int index, const ScriptState& state) override {
        if (what == ClearKind::Color) return add(fmt::format("clear color{} with {}", index, orDefault(state.clear.color)));
        if (what == ClearKind::Depth) return add("clear depth with " + orDefault(state.clear.depth));
        return add("clear stencil with " + orDefault(state.clear.stencil));
    }
    Result<void> beginPass(const Technique&, const Pass& pass) override { return add("begin " + pass.name); }
    Result<void> draw(const Pass& pass, DrawKind kind, const ScriptState& state) override {
        const std::string what = kind == DrawKind::Geometry  ? "geometry"
                                 : kind == DrawKind::Buffer  ? "buffer"
                                 : kind == DrawKind::Compute ? "compute"
                                                             : "scene";
        const std::optional<std::string>& color = state.targets.colors[0];
        return add(fmt::format("{}: {} to {}", pass.name, what, color->empty() ? "app" : *color));
    }
    Result<void> endPass(const Pass& pass) override { return add("end " + pass.name); }
    Result<void> external(const ScriptState&) override { return add("external"); }
    [[nodiscard]] std::vector<double> read(const Parameter& parameter) const override {
        if (const auto value = values.find(parameter.name); value != values.end()) return {value->second};
        return parameter.defaultValue ? std::get<std::vector<double>>(*parameter.defaultValue) : std::vector<double>{0};
    }
    void write(const Parameter& parameter, double value) override {
        values[parameter.name] = value;
        lines.push_back(fmt::format("{} = {}", parameter.name, value));
    }

private:
    static std::string orDefault(const std::string& name) { return name.empty() ? "default" : name; }
    Result<void> add(std::string line) {
        lines.push_back(std::move(line));
        return {};
    }
};

/// What running the scripts did, without "begin" and "end"; an error's code as last line.
inline std::vector<std::string> ran(const std::string& text, const std::map<std::string, double>& values = {},
                                    const std::string& technique = {}) {
    const Effect effect = loaded(text);
    Log log;
    log.values = values;
    const Result<void> done = runScripts(effect, technique, log);
    std::erase_if(log.lines, [](const std::string& line) { return line.starts_with("begin ") || line.starts_with("end "); });
    if (!done) log.lines.push_back(fmt::format("TG{}", done.error().diagnostics[0].code));
    return log.lines;
}

} // namespace tegument::test
