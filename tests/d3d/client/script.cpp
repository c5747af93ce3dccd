#include "script.h"

#include "com.h"

#include <algorithm>
#include <cctype>

namespace client {

namespace {

struct Command {
    std::string name; // upper case, without its digit
    unsigned index = 0;
    std::string value; // an option, or `parameter?option:option...`
};

struct State {
    Bound bound;
    Numbers color{0, 0, 0, 0};
    Numbers depth{1};
    Numbers stencil{0};
};

Command parseCommand(const std::string& text) {
    const std::size_t equals = text.find('=');
    Command command{upper(text.substr(0, equals)), 0, equals == std::string::npos ? "" : text.substr(equals + 1)};
    if (!command.name.empty() && std::isdigit(static_cast<unsigned char>(command.name.back())) != 0) {
        command.index = static_cast<unsigned>(command.name.back() - '0');
        command.name.pop_back();
    }
    return command;
}

std::vector<Command> parse(std::string text) {
    std::erase_if(text, [](unsigned char letter) { return std::isspace(letter) != 0; });
    std::vector<Command> commands;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(';', at), text.size());
        if (end > at) commands.push_back(parseCommand(text.substr(at, end - at)));
        at = end + 1;
    }
    return commands;
}

std::size_t matchingEnd(const std::vector<Command>& commands, std::size_t loop) {
    int depth = 0;
    for (std::size_t i = loop; i < commands.size(); ++i) {
        if (commands[i].name == "LOOPBYCOUNT") ++depth;
        if (commands[i].name == "LOOPEND" && --depth == 0) return i;
    }
    fail("a loop of the script has no end");
}

/// The parameter of a choice counts the options from 0.
std::string choose(Engine& engine, const std::string& value) {
    const std::size_t question = value.find('?');
    if (question == std::string::npos) return value;
    const auto wanted = static_cast<int>(engine.numbers(value.substr(0, question)).at(0));
    std::size_t at = question + 1;
    for (int i = 0; i < wanted && at != 0; ++i)
        at = value.find(':', at) + 1;
    if (at == 0 || wanted < 0) fail("no option " + std::to_string(wanted) + " in " + value);
    return value.substr(at, value.find(':', at) - at);
}

/// Runs one script; returns with the caller's targets bound again.
class Runner {
public:
    Runner(Engine& engine, State caller, std::string pass)
        : engine_(engine), caller_(caller), state_(std::move(caller)), pass_(std::move(pass)) {}

    void run(const std::vector<Command>& commands, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (commands[i].name != "LOOPBYCOUNT") {
                execute(commands[i]);
                continue;
            }
            const std::size_t last = matchingEnd(commands, i);
            loop(commands, i, last);
            i = last;
        }
    }

private:
    void loop(const std::vector<Command>& commands, std::size_t begin, std::size_t end) {
        const float count = engine_.numbers(commands[begin].value).at(0);
        const float outerIndex = index_;
        for (index_ = 0; index_ < count; ++index_)
            run(commands, begin + 1, end);
        index_ = outerIndex;
    }

    void execute(const Command& command) {
        const std::string option = choose(engine_, command.value);
        if (command.name == "PASS") return runPass(option);
        if (command.name == "DRAW") return draw(option);
        if (command.name == "CLEAR") return clear(option);
        if (command.name == "LOOPGETINDEX") return engine_.setNumber(option, index_);
        if (command.name == "CLEARSETCOLOR")
            state_.color = engine_.numbers(option);
        else if (command.name == "CLEARSETDEPTH")
            state_.depth = engine_.numbers(option);
        else if (command.name == "CLEARSETSTENCIL")
            state_.stencil = engine_.numbers(option);
        else
            setTarget(command, option);
    }

    void setTarget(const Command& command, const std::string& option) {
        if (command.name == "RENDERDEPTHSTENCILTARGET") {
            state_.bound.depth = option.empty() ? caller_.bound.depth : option;
        } else if (command.name == "RENDERCOLORTARGET" && command.index < kMaxColors) {
            auto& target = state_.bound.colors[command.index];
            if (!option.empty())
                target = option;
            else if (command.index == 0)
                target = caller_.bound.colors[0];
            else
                target.reset();
        } else {
            fail("the script has a command that this client lacks: " + command.name);
        }
    }

    void clear(const std::string& what) {
        engine_.bind(state_.bound);
        const std::string name = upper(what);
        if (name == "COLOR")
            engine_.clear(Clear::Color, state_.color);
        else if (name == "DEPTH")
            engine_.clear(Clear::Depth, state_.depth);
        else if (name == "STENCIL")
            engine_.clear(Clear::Stencil, state_.stencil);
        else
            fail("the script clears " + what);
    }

    void draw(const std::string& what) {
        engine_.bind(state_.bound);
        const std::string name = upper(what);
        engine_.draw(pass_, name == "BUFFER" ? Drawing::Quad : name == "COMPUTE" ? Drawing::Nothing : Drawing::Mesh);
    }

    void runPass(const std::string& pass) {
        const std::vector<Command> commands = parse(engine_.passScript(pass));
        Runner inner(engine_, state_, pass);
        inner.index_ = index_;
        if (commands.empty()) inner.draw("Geometry");
        inner.run(commands, 0, commands.size());
    }

    Engine& engine_;
    State caller_;
    State state_;
    std::string pass_;
    float index_ = 0;
};

} // namespace

void runTechnique(Engine& engine) {
    std::vector<Command> commands = parse(engine.techniqueScript());
    if (commands.empty())
        for (const std::string& pass : engine.passes())
            commands.push_back({"PASS", 0, pass});
    Runner(engine, {}, "").run(commands, 0, commands.size());
}

} // namespace client
