#include "host/effect/script_run.h"

#include <cmath>

#include <fmt/format.h>

namespace tegument {

namespace {

Error failure(int code, const SourcePosition& at, std::string text, std::string hint = {}) {
    return inputError(code, at, std::move(text), std::move(hint));
}

/// What a pass without script does.
DrawKind usual(const Pass& pass) {
    return pass.computeShader ? DrawKind::Compute : DrawKind::Geometry;
}

class Interpreter {
public:
    Interpreter(const Effect& effect, ScriptSink& sink) : effect_(effect), sink_(sink) {}

    Result<void> run(std::string_view name) {
        if (!name.empty()) {
            const Technique* technique = effect_.findTechnique(name);
            if (technique == nullptr) return unknownTechnique(name);
            return runTechnique(*technique);
        }
        if (effect_.standardsGlobal && effect_.standardsGlobal->script.given) return runGlobal(effect_.standardsGlobal->script);
        if (effect_.techniques.empty()) return failure(2304, {effect_.file.string()}, "the effect has no technique");
        return runTechnique(*effect_.defaultTechnique());
    }

private:
    [[nodiscard]] Error unknownTechnique(std::string_view name) const {
        std::string names;
        for (const Technique& technique : effect_.techniques)
            names += (names.empty() ? "it has " : ", ") + technique.name;
        return failure(2304, {effect_.file.string()}, fmt::format("the effect has no technique '{}'", name), names);
    }

    Result<void> count(const SourcePosition& at) {
        if (++commands_ > kMaxCommands) return failure(2303, at, fmt::format("the scripts run more than {} commands", kMaxCommands));
        return {};
    }

    [[nodiscard]] double scalar(const std::string& name) const {
        const Parameter* parameter = effect_.findParameter(name);
        assert(parameter != nullptr); // the effect's check resolved every name
        const std::vector<double> value = sink_.read(*parameter);
        return value.empty() ? 0 : value[0];
    }

    /// The option in force. A bool selects the first when true; a number counts from 0 and is cut to an integer.
    Result<std::string> option(const Command& command) const {
        if (command.selector.empty()) return command.options[0];
        const double value = scalar(command.selector);
        const bool isBool = effect_.findParameter(command.selector)->type.base == BaseType::Bool;
        const double index = isBool ? (value != 0 ? 0.0 : 1.0) : std::trunc(value);
        if (index >= 0 && index < static_cast<double>(command.options.size())) return command.options[static_cast<std::size_t>(index)];
        return failure(
            2301, command.at,
            fmt::format("selector '{}' is {}; the command has options 0 to {}", command.selector, value, command.options.size() - 1));
    }

    Result<void> runGlobal(const Script& script) {
        for (const Command& command : script.commands) {
            if (Result<void> counted = count(command.at); !counted) return counted;
            if (command.kind != CommandKind::Technique) continue;
            const Result<std::string> name = option(command);
            if (!name) return name.error();
            if (Result<void> done = runTechnique(*effect_.findTechnique(*name)); !done) return done;
        }
        return {};
    }

    Result<void> runTechnique(const Technique& technique) {
        const ScriptState caller = state_;
        if (!technique.script.given) {
            for (const Pass& pass : technique.passes)
                if (Result<void> done = runPass(technique, pass); !done) return done;
            return {};
        }
        if (Result<void> done = runCommands(technique.script, technique, caller); !done) return done;
        return restore(caller);
    }

    Result<void> runPass(const Technique& technique, const Pass& pass) {
        if (Result<void> counted = count(pass.at); !counted) return counted;
        const ScriptState caller = state_;
        pass_ = &pass;
        if (Result<void> begun = sink_.beginPass(technique, pass); !begun) return begun;
        Result<void> done = pass.script.given ? runCommands(pass.script, technique, caller) : sink_.draw(pass, usual(pass), state_);
        if (!done) return done;
        if (Result<void> ended = sink_.endPass(pass); !ended) return ended;
        pass_ = nullptr;
        return restore(caller);
    }

    Result<void> restore(const ScriptState& caller) {
        const bool changed = state_.targets != caller.targets;
        state_ = caller;
        return changed ? sink_.targetsChanged(state_.targets) : Result<void>();
    }

    struct Loop {
        std::size_t start;
        int index;
        int count;
    };

    Result<void> runCommands(const Script& script, const Technique& technique, const ScriptState& caller) {
        std::vector<Loop> loops;
        for (std::size_t i = 0; i < script.commands.size(); ++i) {
            const Command& command = script.commands[i];
            if (Result<void> counted = count(command.at); !counted) return counted;
            switch (command.kind) {
            case CommandKind::LoopByCount: {
                const Result<int> times = loopCount(command);
                if (!times) return times.error();
                if (*times == 0) {
                    i = static_cast<std::size_t>(command.loopMatch);
                } else {
                    loops.push_back({i, 0, *times});
                }
                break;
            }
            case CommandKind::LoopEnd:
                if (++loops.back().index < loops.back().count) {
                    i = loops.back().start;
                } else {
                    loops.pop_back();
                }
                break;
            case CommandKind::LoopGetIndex: sink_.write(*effect_.findParameter(command.options[0]), loops.back().index); break;
            case CommandKind::LoopGetCount: sink_.write(*effect_.findParameter(command.options[0]), loops.back().count); break;
            case CommandKind::Reserved: break;
            default:
                if (Result<void> done = runCommand(command, technique, caller); !done) return done;
            }
        }
        return {};
    }

    Result<int> loopCount(const Command& command) const {
        const double value = scalar(command.options[0]);
        if (value >= 0 && value <= kMaxLoopCount) return static_cast<int>(value);
        return failure(2302, command.at, fmt::format("'{}' is {}; a loop runs 0 to {} times", command.options[0], value, kMaxLoopCount));
    }

    Result<void> runCommand(const Command& command, const Technique& technique, const ScriptState& caller) {
        const Result<std::string> name = option(command);
        if (!name) return name.error();
        switch (command.kind) {
        case CommandKind::Pass: return runPass(technique, *technique.findPass(*name));
        case CommandKind::RenderColorTarget: return bindColor(command.index, *name, caller);
        case CommandKind::RenderDepthStencilTarget: return bindDepth(*name, caller);
        case CommandKind::ClearSetColor: state_.clear.color = *name; return {};
        case CommandKind::ClearSetDepth: state_.clear.depth = *name; return {};
        case CommandKind::ClearSetStencil: state_.clear.stencil = *name; return {};
        case CommandKind::Clear: return clear(*name, command.index);
        case CommandKind::Draw:
            return sink_.draw(*pass_,
                              *name == "Geometry"  ? DrawKind::Geometry
                              : *name == "Buffer"  ? DrawKind::Buffer
                              : *name == "Compute" ? DrawKind::Compute
                                                   : DrawKind::Scene,
                              state_);
        case CommandKind::ScriptExternal: return external();
        default: return {};
        }
    }

    /// An empty name means the caller's target in place 0, and nothing in the others.
    Result<void> rebind(std::optional<std::string>& place, std::optional<std::string> name) {
        if (place == name) return {};
        place = std::move(name);
        return sink_.targetsChanged(state_.targets);
    }

    Result<void> bindColor(int index, const std::string& name, const ScriptState& caller) {
        std::optional<std::string>& place = state_.targets.colors[static_cast<std::size_t>(index)];
        if (!name.empty()) return rebind(place, name);
        return rebind(place, index == 0 ? caller.targets.colors[0] : std::nullopt);
    }

    Result<void> bindDepth(const std::string& name, const ScriptState& caller) {
        return rebind(state_.targets.depth, name.empty() ? caller.targets.depth : std::optional(name));
    }

    Result<void> clear(const std::string& what, int index) {
        if (what == "Depth") return sink_.clear(ClearKind::Depth, 0, state_);
        if (what == "Stencil") return sink_.clear(ClearKind::Stencil, 0, state_);
        for (int i = 0; i < static_cast<int>(state_.targets.colors.size()); ++i)
            if ((index < 0 || i == index) && state_.targets.colors[static_cast<std::size_t>(i)])
                if (Result<void> done = sink_.clear(ClearKind::Color, i, state_); !done) return done;
        return {};
    }

    Result<void> external() {
        const ScriptState before = state_;
        if (Result<void> done = sink_.external(state_); !done) return done;
        state_ = before;
        return sink_.targetsChanged(state_.targets);
    }

    const Effect& effect_;
    ScriptSink& sink_;
    ScriptState state_;
    const Pass* pass_ = nullptr;
    long commands_ = 0;
};

} // namespace

Result<void> runScripts(const Effect& effect, std::string_view technique, ScriptSink& sink) {
    return Interpreter(effect, sink).run(technique);
}

} // namespace tegument
