#include "tools/cli/command_line.h"

#include "host/mesh/read_mesh.h"
#include "host/support/text.h"
#include "meshprep/assets/names.h"
#include "meshprep/assets/picture.h"
#include "tools/cli/output.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

namespace tegument::app {

namespace {

constexpr std::size_t kIndent = 30; // of the descriptions

/// Two columns; a first one that is too wide stands on a line of its own.
std::string row(const std::string& left, const std::string& right) {
    std::string text = "  " + left;
    if (right.empty()) return text + '\n';
    if (text.size() + 2 > kIndent)
        text += '\n' + std::string(kIndent, ' ');
    else
        text.resize(kIndent, ' ');
    const auto lines = wrapped(right, kWidth - kIndent);
    return text + fmt::format("{}\n", fmt::join(lines, '\n' + std::string(kIndent, ' ')));
}

void replace(std::string& text, const std::string& from, const std::string& to) {
    if (const std::size_t at = text.find(from); at != std::string::npos) text.replace(at, from.size(), to);
}

/// CLI11's help, in lines of at most 100 columns, with ranges as a..b and lists of words as {a,b}.
class HelpFormatter : public CLI::Formatter {
public:
    std::string make_option(const CLI::Option* option, bool positional) const override {
        return row(make_option_name(option, positional) + make_option_opts(option), make_option_desc(option));
    }

    std::string make_option_opts(const CLI::Option* option) const override {
        std::string text = Formatter::make_option_opts(option);
        for (const char* type : {"INT", "FLOAT"})
            if (const std::size_t at = text.find(fmt::format(":{} in [", type)); at != std::string::npos) {
                text.replace(at, std::string_view(type).size() + 6, " ");
                replace(text, " - ", "..");
                replace(text, "]", "");
            }
        replace(text, "FLOAT:POSITIVE", "FLOAT > 0");
        replace(text, "TEXT:{", "{");
        replace(text, "TEXT:FILE", "FILE");
        replace(text, " REQUIRED", "");
        return text;
    }

    std::string make_subcommand(const CLI::App* command) const override { return row(command->get_name(), command->get_description()); }

    std::string make_description(const CLI::App* command) const override {
        return fmt::format("{}\n", fmt::join(wrapped(command->get_description(), kWidth), "\n"));
    }
};

/// "tegument fur roots"
std::string nameOf(const CLI::App& command) {
    const CLI::App* parent = command.get_parent();
    return parent ? nameOf(*parent) + " " + command.get_name() : command.get_name();
}

std::vector<std::string> commandsOf(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(sub->get_name());
    return names;
}

std::vector<std::string> optionsOf(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    return names;
}

/// Who names an effect or a mesh first wants it drawn, or prepared.
std::string commandFor(const CLI::App& command, const std::string& word) {
    if (command.get_parent()) return {};
    if (meshFormatOf(word))
        return fmt::format("tegument prep {0} -o NEW.glb prepares a mesh, tegument render EFFECT --mesh {0} draws it", shellWord(word));
    if (toLower(word).ends_with(".fx") || assets::findEffect(word))
        return fmt::format("tegument render {} draws an effect", shellWord(word));
    return {};
}

Error unknownCommand(const CLI::App& command, const std::string& word) {
    const std::vector<std::string> names = commandsOf(command);
    std::string hint = didYouMean(word, names);
    if (hint.empty()) hint = commandFor(command, word);
    if (hint.empty()) hint = fmt::format("it has {}", fmt::join(names, ", "));
    return usageError(8003, fmt::format("{} has no command '{}'", nameOf(command), word), std::move(hint));
}

/// What a word that stands where none is taken is likely to be; empty where nobody knows.
std::string meantBy(const CLI::App& command, const std::string& word) {
    const auto takes = [&](const char* option) { return command.get_option_no_throw(option) != nullptr; };
    if (meshFormatOf(word) && takes("--mesh")) return fmt::format("a mesh is given by --mesh {}", shellWord(word));
    if ((meshFormatOf(word) || assets::isPicture(word)) && takes("--output"))
        return fmt::format("where it goes is said by -o {}", shellWord(word));
    if (takes("--set") && !word.empty() && word.find_first_not_of("0123456789.,-+eE") == std::string::npos)
        return "a value is one word with its name: --set NAME=VALUE";
    return {};
}

/// The innermost command that was named.
const CLI::App& chosen(const CLI::App& program) {
    const auto parsed = program.get_subcommands();
    return parsed.empty() ? program : chosen(*parsed.back());
}

Error explain(const CLI::App& program, const CLI::ParseError& error) {
    const CLI::App& command = chosen(program);
    const std::vector<std::string> rest = program.remaining(true);
    const std::string help = command.get_parent() ? fmt::format("tegument help{} says what it takes", nameOf(command).substr(8))
                                                  : std::string("tegument --help lists the commands");
    const bool wantsCommand = command.get_require_subcommand_min() > 0;
    if (wantsCommand && !rest.empty() && !rest.front().starts_with('-')) return unknownCommand(command, rest.front());
    const auto option = std::ranges::find_if(rest, [](const std::string& word) { return word.size() > 1 && word.front() == '-'; });
    if (option != rest.end()) {
        const std::string name = option->substr(0, option->find('='));
        const std::string near = didYouMean(name, optionsOf(command));
        return usageError(8004, fmt::format("{} has no option {}", nameOf(command), name), near.empty() ? help : near);
    }
    if (wantsCommand) return usageError(8003, fmt::format("{} needs a command", nameOf(command)), help);
    if (!rest.empty()) {
        const std::string meant = meantBy(command, rest.front());
        return usageError(8005, fmt::format("'{}' is more than {} takes", rest.front(), nameOf(command)), meant.empty() ? help : meant);
    }
    const std::string text = error.what();
    return usageError(8005, text, text.ends_with('?') ? "" : help); // it has a name to offer already
}

std::string helpOf(const CLI::App& command) {
    // App::help prints that of the command that was parsed: `help` itself.
    return command.get_formatter()->make_help(&command, nameOf(command), CLI::AppFormatMode::Normal);
}

int printHelp(const CLI::App& program, const std::vector<std::string>& topics) {
    const CLI::App* command = &program;
    for (const std::string& topic : topics) {
        const auto names = commandsOf(*command);
        if (std::ranges::find(names, topic) == names.end()) return fail(unknownCommand(*command, topic), false);
        command = command->get_subcommand(topic);
    }
    fmt::print("{}", helpOf(*command));
    return 0;
}

/// As troff prints it literally.
std::string troff(const std::string& text) {
    std::string result;
    for (const std::string& line : CLI::detail::split(text, '\n')) {
        if (line.starts_with('.') || line.starts_with('\'')) result += "\\&";
        for (const char c : line)
            result += c == '\\' ? std::string("\\e") : c == '-' ? std::string("\\-") : std::string(1, c);
        result += '\n';
    }
    return result;
}

std::string manualSections(const CLI::App& command) {
    std::string text = fmt::format(".SH {}\n.nf\n{}.fi\n", nameOf(command), troff(helpOf(command)));
    for (const CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; }))
        text += manualSections(*sub);
    return text;
}

/// tegument(1), made of the same texts as the help.
int printManual(const CLI::App& program) {
    fmt::print(".TH TEGUMENT 1 \"\" \"tegument {}\"\n.SH NAME\ntegument \\- {}\n{}", TEGUMENT_VERSION, troff(program.get_description()),
               manualSections(program));
    fmt::print("{}", R"(.SH ENVIRONMENT
.TP
TEGUMENT_CACHE
where what was made or fetched is kept; else $XDG_CACHE_HOME/tegument, else ~/.cache/tegument
.TP
TEGUMENT_DEVICE
part of the Vulkan device's name
.TP
TEGUMENT_DXC, TEGUMENT_D3DCOMPILER
libdxcompiler.so and d3dcompiler_47.dll, where they are not in the cache
.SH FILES
share/tegument: effects, hlsl, workspaces. share/doc/tegument/README.md: where the documentation begins.
)");
    return 0;
}

} // namespace

std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
    std::vector<std::string> lines;
    for (const std::string& paragraph : CLI::detail::split(text, '\n')) {
        if (paragraph.size() <= width) {
            lines.push_back(paragraph); // indented as it is
            continue;
        }
        std::string line;
        for (const std::string& word : CLI::detail::split(paragraph, ' ')) {
            if (!line.empty() && line.size() + 1 + word.size() > width) {
                lines.push_back(line);
                line.clear();
            }
            line += (line.empty() ? "" : " ") + word;
        }
        lines.push_back(line);
    }
    return lines;
}

CLI::Validator oneOf(const std::vector<std::string>& words) {
    std::vector<std::pair<std::string, std::string>> same;
    for (const std::string& word : words)
        same.emplace_back(word, word);
    return oneOf(same);
}

CLI::Option* repeatable(CLI::Option* option) {
    return option->allow_extra_args(false);
}

void addExamples(CLI::App& command, const std::vector<Example>& examples, const std::string& note) {
    constexpr std::size_t kAround = 15; // "  tegument " and "  # "
    std::size_t widest = 0;
    std::size_t widestShown = 0;
    for (const Example& example : examples) {
        widest = std::max(widest, example.arguments.size());
        widestShown = std::max(widestShown, example.shows.size());
    }
    const bool beside = widest + widestShown + kAround <= kWidth; // else what an example shows stands above it
    std::string text = examples.empty() ? "" : "\nExamples:";
    for (const auto& [arguments, shows] : examples) {
        if (!beside && !shows.empty()) text += fmt::format("\n  # {}", shows);
        text += fmt::format("\n  tegument {}", arguments);
        if (beside && !shows.empty()) text += fmt::format("{}  # {}", std::string(widest - arguments.size(), ' '), shows);
    }
    if (!note.empty()) text += fmt::format("\n\n{}", fmt::join(wrapped(note, kWidth), "\n"));
    command.footer(text);
}

void setUpHelp(CLI::App& program, Action& action) {
    program.formatter(std::make_shared<HelpFormatter>());
    auto topics = std::make_shared<std::vector<std::string>>();
    CLI::App* command = program.add_subcommand("help", "Print the help of a command");
    command->add_option("command", *topics, "The command, for example: render, or: fur roots");
    auto manual = std::make_shared<bool>(false);
    command->add_flag("--man", *manual, "Print the manual page, tegument(1), of all commands");
    addExamples(*command, {{"help render", ""}, {"help fur roots", ""}, {"help --man | man -l -", ""}});
    command->callback([&program, topics, manual, &action] {
        action = [&program, topics, manual] { return *manual ? printManual(program) : printHelp(program, *topics); };
    });
}

std::optional<int> parse(CLI::App& program, int argc, char** argv) {
    std::vector<std::string> words(argv + 1, argv + argc);
    if (const auto end = std::ranges::find(words, "--"); end != words.end() && words.front() == "batch")
        words.insert(end, "--"); // an option that takes any number of words eats the first
    try {
        std::ranges::reverse(words);
        program.parse(words);
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return program.exit(error); // --help, --version
        return fail(explain(program, error), false);
    }
}

} // namespace tegument::app
