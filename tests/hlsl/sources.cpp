#include "tests/hlsl/sources.h"

#include "host/support/file.h"

#include <regex>
#include <set>

namespace tegument::test {

namespace {

std::set<std::filesystem::path> filesIn(const std::filesystem::path& folder) {
    std::set<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".fxh") files.insert(entry.path());
    return files;
}

} // namespace

std::vector<ShaderFunction> functionsIn(const std::filesystem::path& folder) {
    // A type (a struct's name begins with a capital) and a name at the start of a line, a parameter list, and a body: declarations of
    // variables have no body.
    static const std::regex kDefinition(
        R"((?:^|\n)(?:static |inline )?(?:(?:void|bool|int|uint|half|float)(?:[1-4](?:x[1-4])?)?|[A-Z]\w*) (\w+)\([^;{}]*\)\s*(?::\s*\w+\s*)?\{)");
    std::vector<ShaderFunction> functions;
    for (const auto& path : filesIn(folder)) {
        const auto text = readFile(path);
        if (!text) continue;
        for (auto match = std::sregex_iterator(text->begin(), text->end(), kDefinition); match != std::sregex_iterator(); ++match)
            functions.push_back({(*match)[1], std::filesystem::relative(path, folder).string()});
    }
    return functions;
}

std::set<std::string> constantsAndMacrosIn(const std::filesystem::path& folder) {
    static const std::regex kDefinition(R"((?:^|\n)(?:#define (?=\w+\()|static const \w+ )(\w+))");
    std::set<std::string> names;
    for (const auto& path : filesIn(folder)) {
        const auto text = readFile(path);
        if (!text) continue;
        for (auto match = std::sregex_iterator(text->begin(), text->end(), kDefinition); match != std::sregex_iterator(); ++match)
            names.insert((*match)[1]);
    }
    return names;
}

} // namespace tegument::test
