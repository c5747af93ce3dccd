// Completion for shells, of the same tables as the help: commands, options, and effects by name.

#include "meshprep/assets/names.h"
#include "tools/cli/command_line.h"

#include <fmt/format.h>

#include <functional>

namespace tegument::app {

namespace {

struct Word {
    std::string text, says;
};

/// What may stand behind "tegument fur".
struct Place {
    std::string path;
    std::vector<Word> commands, options;
    bool takesEffect = false;
};

/// In single quotes, of one line; `colon`: what stands for one.
std::string quoted(const std::string& text, const std::string& quote, const std::string& colon = ":") {
    std::string result;
    for (const char c : text.substr(0, text.find('\n')))
        result += c == '\'' ? quote : c == ':' ? colon : std::string(1, c);
    return "'" + result + "'";
}

void gather(const CLI::App& command, const std::string& path, std::vector<Place>& places) {
    Place place{.path = path};
    for (const CLI::Option* option : command.get_options()) {
        place.takesEffect = place.takesEffect || (option->get_positional() && option->get_name() == "effect");
        for (const std::string& name : option->get_lnames())
            place.options.push_back({"--" + name, option->get_description()});
    }
    const auto below = command.get_subcommands([](const CLI::App*) { return true; });
    for (const CLI::App* sub : below)
        place.commands.push_back({sub->get_name(), sub->get_description()});
    places.push_back(std::move(place));
    for (const CLI::App* sub : below)
        gather(*sub, path + " " + sub->get_name(), places);
}

/// The lines of a `case` over what was typed, each with the words that may follow.
std::string cases(const std::vector<Place>& places, const std::function<std::string(const Word&)>& shown) {
    std::string text;
    for (const Place& place : places) {
        text += fmt::format("    {})\n        effect={}\n        all=(", quoted(place.path, ""), place.takesEffect ? "yes" : "");
        for (const auto* words : {&place.commands, &place.options})
            for (const Word& word : *words)
                text += ' ' + shown(word);
        text += " )\n        ;;\n";
    }
    return text;
}

/// In bash and zsh: `at` becomes the command that `words` name.
std::string walk(const std::vector<Place>& places, const std::string& words) {
    std::string known;
    for (const Place& place : places)
        known += (known.empty() ? "" : " | ") + quoted(place.path, "");
    return "    local word at=tegument effect=\n    local -a all\n    for word in " + words + "; do\n        case \"$at $word\" in " +
           known + ") at=\"$at $word\" ;; esac\n    done\n    case \"$at\" in\n";
}

std::string forBash(const std::vector<Place>& places, const std::vector<std::string>& effects) {
    return "_tegument() {\n" + walk(places, R"("${COMP_WORDS[@]:1:COMP_CWORD-1}")") +
           cases(places, [](const Word& word) { return word.text; }) +
           fmt::format("    esac\n    [ -z \"$effect\" ] || all+=({})\n", fmt::join(effects, " ")) +
           "    mapfile -t COMPREPLY < <(compgen -W \"${all[*]}\" -- \"${COMP_WORDS[COMP_CWORD]}\")\n}\n"
           "complete -o bashdefault -o default -F _tegument tegument\n";
}

std::string forZsh(const std::vector<Place>& places, const std::vector<std::string>& effects) {
    const auto described = [](const Word& word) {
        const std::string says = quoted(word.says, R"('\'')", R"(\:)");
        return "'" + word.text + ":" + says.substr(1);
    };
    return "#compdef tegument\n_tegument() {\n" + walk(places, "${words[2,CURRENT-1]}") + cases(places, described) +
           fmt::format("    esac\n    [ -z \"$effect\" ] || all+=({})\n", fmt::join(effects, " ")) +
           "    _describe tegument all\n    _files\n}\n_tegument \"$@\"\n";
}

std::string forFish(const std::vector<Place>& places, const std::vector<std::string>& effects) {
    std::string text;
    for (const Place& place : places) {
        std::string seen;
        for (const std::string& word : CLI::detail::split(place.path, ' '))
            if (word != "tegument") seen += (seen.empty() ? "" : "; and ") + fmt::format("__fish_seen_subcommand_from {}", word);
        const std::string when = seen.empty() ? "-n __fish_use_subcommand" : fmt::format("-n '{}'", seen);
        for (const Word& word : place.commands)
            text += fmt::format("complete -c tegument {} -a {} -d {}\n", when, word.text, quoted(word.says, R"(\')"));
        for (const Word& word : place.options)
            text += fmt::format("complete -c tegument {} -l {} -d {}\n", when, word.text.substr(2), quoted(word.says, R"(\')"));
        if (place.takesEffect) text += fmt::format("complete -c tegument {} -a '{}'\n", when, fmt::join(effects, " "));
    }
    return text;
}

} // namespace

std::string completion(const CLI::App& program, const std::string& shell) {
    std::vector<Place> places;
    gather(program, "tegument", places);
    std::vector<std::string> effects;
    for (const auto& effect : assets::knownEffects())
        effects.push_back(effect.stem().string());
    return shell == "bash" ? forBash(places, effects) : shell == "zsh" ? forZsh(places, effects) : forFish(places, effects);
}

} // namespace tegument::app
