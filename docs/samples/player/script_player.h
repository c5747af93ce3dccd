#pragma once
// The scripts of docs/scripts.md for an engine of your own: walks those of a technique and calls your engine back to set targets, clear,
// draw and set numbers. C++17, this file alone. manifest.h beside it reads techniques from what `tegument check --emit` writes.
//
//   class Mine : public script_player::Engine { ... the five functions, and external() where effects lie above others ... };
//   Mine engine;
//   script_player::play(technique, engine);
//
// What a script does wrong is a std::runtime_error that names it; `tegument check` finds all of that before.

#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace script_player {

constexpr std::size_t kColors = 8;
constexpr int kMostInLoop = 65536; // a script that never ends is a typing mistake
constexpr long kMostCommands = 1000000;
constexpr std::size_t kMostNested = 64; // loops in loops
constexpr std::size_t kOption = 64;     // letters of a command's value that count as a command more

struct Pass {
    std::string name;
    std::optional<std::string> script; // none: Draw=Geometry
};

struct Technique {
    std::string name;
    std::optional<std::string> script; // none: the passes in order
    std::vector<Pass> passes;
};

/// Names of textures as the effect declares them. "": the application's own target; none: nothing is bound in this place.
struct Targets {
    std::array<std::optional<std::string>, kColors> colors{""};
    std::optional<std::string> depth = "";

    bool operator==(const Targets& other) const { return colors == other.colors && depth == other.depth; }
};

enum class Clear { Color, Depth, Stencil };
enum class Draw { Mesh, Quad, Scene, Compute };

struct Value {
    std::vector<float> numbers; // of a parameter, as many as it has
    bool isBool = false;
};

/// Your engine, as scripts see it. Names come as the script writes them, which may differ from the effect's by case.
class Engine {
public:
    virtual ~Engine() = default;

    /// Called before what needs it, where the targets have changed or something else may have set others. Viewport and VIEWPORTPIXELSIZE
    /// follow the first one.
    virtual void setTargets(const Targets& targets) = 0;
    /// Of the colour targets the one in `place`, or all that are set: Direct3D 9 does that in one call. Values: rgba, depth, or stencil.
    virtual void clear(Clear what, std::optional<std::size_t> place, const std::vector<float>& value) = 0;
    virtual void draw(const Pass& pass, Draw what) = 0;
    virtual Value value(const std::string& parameter) = 0;
    virtual void setNumber(const std::string& parameter, float number) = 0;
    /// Draws what lies below this effect: ScriptExternal=Color.
    virtual void external() { throw std::runtime_error("the script asks for what lies below it (ScriptExternal)"); }
};

namespace detail {

inline std::string upper(std::string text) {
    for (char& letter : text)
        letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    return text;
}

struct Command {
    std::string name; // upper case, without its digit
    std::optional<std::size_t> digit;
    std::string value;   // an option, or `parameter?option:option...`
    std::size_t end = 0; // of a loop: its LoopEnd
};

inline std::vector<Command> parse(const std::string& script) {
    std::vector<Command> commands;
    std::string text;
    for (const char letter : script + ";") {
        if (std::isspace(static_cast<unsigned char>(letter)) != 0) continue;
        if (letter != ';') {
            text += letter;
            continue;
        }
        if (text.empty()) continue;
        const std::size_t equals = text.find('=');
        Command command{upper(text.substr(0, equals)), {}, equals == std::string::npos ? "" : text.substr(equals + 1)};
        if (!command.name.empty() && std::isdigit(static_cast<unsigned char>(command.name.back())) != 0) {
            command.digit = static_cast<std::size_t>(command.name.back() - '0');
            command.name.pop_back();
        }
        commands.push_back(command);
        text.clear();
    }
    return commands;
}

struct State {
    Targets targets;
    std::string color, depth, stencil; // the parameters that hold the values of clears; none: 0, 1 and 0
};

class Player {
public:
    Player(const Technique& technique, Engine& engine) : technique_(technique), engine_(engine) {
        for (const Pass& pass : technique.passes) {
            places_.emplace(upper(pass.name), passes_.size());
            passes_.push_back(withEnds(parse(pass.script.value_or("Draw=Geometry"))));
        }
    }

    void play() {
        std::vector<Command> commands = withEnds(parse(technique_.script.value_or("")));
        if (!technique_.script)
            for (const Pass& pass : technique_.passes)
                commands.push_back({"PASS", {}, pass.name});
        State state;
        run(commands, 0, commands.size(), state, {}, nullptr);
    }

private:
    struct Loop {
        int index = 0;
        int count = 0;
    };

    [[noreturn]] void fail(const std::string& what) const { throw std::runtime_error("technique " + technique_.name + ": " + what); }

    /// `caller`: what an empty target means; `pass`: none in the technique's script.
    void run(const std::vector<Command>& commands, std::size_t from, std::size_t to, State& state, const Targets& caller,
             const Pass* pass) {
        for (std::size_t i = from; i < to; ++i) {
            commands_ += 1 + static_cast<long>(commands[i].value.size() / kOption);
            if (commands_ > kMostCommands) fail("the script does not end");
            if (commands[i].name == "LOOPEND") continue;
            if (commands[i].name != "LOOPBYCOUNT") {
                execute(commands[i], state, caller, pass);
                continue;
            }
            const float count = number(commands[i].value);
            if (!(count >= 0 && count <= kMostInLoop)) fail("a loop of " + std::to_string(count));
            const Loop outer = loop_;
            for (loop_ = {0, static_cast<int>(count)}; loop_.index < loop_.count; ++loop_.index)
                run(commands, i + 1, commands[i].end + 1, state, caller, pass);
            loop_ = outer;
            i = commands[i].end;
        }
    }

    std::vector<Command> withEnds(std::vector<Command> commands) const {
        std::vector<std::size_t> open;
        for (std::size_t i = 0; i < commands.size(); ++i) {
            if (commands[i].name == "LOOPBYCOUNT") open.push_back(i);
            if (open.size() > kMostNested) fail("too many loops in loops");
            if (commands[i].name != "LOOPEND") continue;
            if (open.empty()) fail("LoopEnd without a loop");
            commands[open.back()].end = i;
            open.pop_back();
        }
        if (!open.empty()) fail("a loop has no end");
        return commands;
    }

    void execute(const Command& command, State& state, const Targets& caller, const Pass* pass) {
        for (const char* reserved : {"LOOPBYTYPE", "LOOPUPDATE", "GEOMETRYLIST", "HINT", "SCRIPTSIGNATURE"})
            if (command.name == reserved) return;
        const std::string option = choose(command.value);
        if (command.name == "PASS" && !pass) return runPass(option, state);
        if (command.name == "DRAW" && pass) return draw(*pass, option, state);
        if (command.name == "CLEAR") return clear(option, state);
        if (command.name == "SCRIPTEXTERNAL") return external(state);
        if (command.name == "LOOPGETINDEX") return engine_.setNumber(option, static_cast<float>(loop_.index));
        if (command.name == "LOOPGETCOUNT") return engine_.setNumber(option, static_cast<float>(loop_.count));
        if (command.name == "CLEARSETCOLOR")
            state.color = option;
        else if (command.name == "CLEARSETDEPTH")
            state.depth = option;
        else if (command.name == "CLEARSETSTENCIL")
            state.stencil = option;
        else
            setTarget(command, option, state, caller);
    }

    void setTarget(const Command& command, const std::string& option, State& state, const Targets& caller) const {
        const std::size_t place = command.digit.value_or(0);
        if (command.name == "RENDERDEPTHSTENCILTARGET")
            state.targets.depth = option.empty() ? caller.depth : option;
        else if (command.name != "RENDERCOLORTARGET" || place >= kColors)
            fail("no command " + command.name);
        else if (!option.empty())
            state.targets.colors[place] = option;
        else if (place == 0)
            state.targets.colors[0] = caller.colors[0];
        else
            state.targets.colors[place].reset();
    }

    /// A bool has two options, the first when true; a number counts from 0.
    std::string choose(const std::string& value) {
        const std::size_t question = value.find('?');
        if (question == std::string::npos) return value;
        std::vector<std::string> options(1);
        for (const char letter : value.substr(question + 1))
            letter == ':' ? options.emplace_back() : options.back() += letter;
        const Value chosen = valueOf(value.substr(0, question));
        const float which = chosen.isBool ? (chosen.numbers[0] != 0 ? 0.0F : 1.0F) : std::trunc(chosen.numbers[0]);
        if (!(which >= 0 && which < static_cast<float>(options.size()))) fail("no option " + std::to_string(which) + " in " + value);
        return options[static_cast<std::size_t>(which)];
    }

    Value valueOf(const std::string& parameter) {
        Value value = engine_.value(parameter);
        if (value.numbers.empty()) fail("parameter " + parameter + " has no value");
        return value;
    }
    float number(const std::string& parameter) { return valueOf(parameter).numbers[0]; }

    void runPass(const std::string& name, const State& state) {
        const auto found = places_.find(upper(name));
        if (found == places_.end()) fail("no pass " + name);
        const std::vector<Command>& commands = passes_[found->second];
        State own = state;
        run(commands, 0, commands.size(), own, state.targets, &technique_.passes[found->second]);
    }

    void bind(const State& state) {
        if (bound_ == state.targets) return;
        bound_ = state.targets;
        engine_.setTargets(state.targets);
    }

    /// `Color` without a number: every target that is bound.
    void clear(const std::string& what, const State& state) {
        bind(state);
        const std::string name = upper(what);
        const auto of = [&](const std::string& parameter, const std::vector<float>& otherwise) {
            return parameter.empty() ? otherwise : valueOf(parameter).numbers;
        };
        if (name == "DEPTH") return engine_.clear(Clear::Depth, {}, of(state.depth, {1}));
        if (name == "STENCIL") return engine_.clear(Clear::Stencil, {}, of(state.stencil, {0}));
        std::vector<float> color = of(state.color, {0, 0, 0, 0});
        color.resize(4);
        if (name == "COLOR") return engine_.clear(Clear::Color, {}, color);
        if (name.size() != 6 || name.compare(0, 5, "COLOR") != 0 || name[5] < '0' || name[5] > '7') fail("no clear of " + what);
        const auto place = static_cast<std::size_t>(name[5] - '0');
        if (state.targets.colors[place]) engine_.clear(Clear::Color, place, color);
    }

    void external(const State& state) {
        bind(state);
        engine_.external();
        bound_.reset();
    }

    void draw(const Pass& pass, const std::string& what, const State& state) {
        bind(state);
        const std::string name = upper(what);
        if (name == "GEOMETRY") return engine_.draw(pass, Draw::Mesh);
        if (name == "BUFFER") return engine_.draw(pass, Draw::Quad);
        if (name == "SCENE") return engine_.draw(pass, Draw::Scene);
        if (name != "COMPUTE") fail("no drawing of " + what);
        engine_.draw(pass, Draw::Compute);
        bound_.reset();
    }

    const Technique& technique_;
    Engine& engine_;
    std::vector<std::vector<Command>> passes_;
    std::map<std::string, std::size_t> places_; // by name: the first of that name
    std::optional<Targets> bound_;
    Loop loop_;
    long commands_ = 0;
};

} // namespace detail

inline void play(const Technique& technique, Engine& engine) {
    detail::Player(technique, engine).play();
}

} // namespace script_player
