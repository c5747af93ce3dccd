#pragma once
// What all subcommands share of the command line: examples, words to choose from, messages, `tegument help`.

#include "host/support/text.h"
#include "tools/cli/commands.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tegument::app {

/// Help in 100 columns, the subcommand `help`, and no examples of another command.
void setUpHelp(CLI::App& program, Action& action);

/// A script of completions for `bash`, `zsh` or `fish`: all commands, their options, and the effects that are known here.
[[nodiscard]] std::string completion(const CLI::App& program, const std::string& shell);

/// Reads the command line. The exit code where nothing is left to do: help or the version was printed, or TG8003 no such command,
/// TG8004 no such option, TG8005 anything else.
[[nodiscard]] std::optional<int> parse(CLI::App& program, int argc, char** argv);

/// Columns of a terminal that most people have at least: nothing that is meant to be read is wider.
inline constexpr std::size_t kWidth = 100;

/// The text in lines of at most `width`, broken at spaces; its own line breaks stay.
[[nodiscard]] std::vector<std::string> wrapped(const std::string& text, std::size_t width);

struct Example {
    std::string arguments; // behind `tegument`
    std::string shows;     // what for; may be empty
};

/// The examples of one command, and below them what else is to be said.
void addExamples(CLI::App& command, const std::vector<Example>& examples, const std::string& note = {});

/// A repeatable option that takes one word each time: what follows it is not its own.
CLI::Option* repeatable(CLI::Option* option);

/// For CLI::Option::transform: one of these words, whatever their case, else an error that lists them and names the nearest. The help
/// of the option says what they mean.
template <class Value>
[[nodiscard]] CLI::Validator oneOf(const std::vector<std::pair<std::string, Value>>& words) {
    const auto choose = [words](std::string& text) -> std::string {
        std::vector<std::string> names;
        for (const auto& [name, value] : words) {
            names.push_back(name);
            if (!equalsIgnoreCase(name, text)) continue;
            text = CLI::detail::value_string(value);
            return {};
        }
        const std::string near = didYouMean(text, names);
        return "'" + text + "' is none of " + CLI::detail::join(names, ", ") + (near.empty() ? "" : "; " + near);
    };
    return {choose, ""};
}

/// Words that stand for themselves.
[[nodiscard]] CLI::Validator oneOf(const std::vector<std::string>& words);

} // namespace tegument::app
