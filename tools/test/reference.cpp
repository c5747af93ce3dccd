#include "tools/test/reference.h"

#include "host/support/file.h"
#include "host/support/system.h"
#include "host/support/temporary.h"
#include "host/support/text.h"
#include "tools/process/process.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace tegument::testing {

namespace {

constexpr double kTimeLimit = 600; // seconds

/// Of each line of numbers, vectors with commas, what the function makes of it.
constexpr const char* kScript = R"(import os, runpy, sys
sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[1])))
function = runpy.run_path(sys.argv[1])[sys.argv[2]]
with open(sys.argv[3]) as cases, open(sys.argv[4], "w") as results:
    for case in cases:
        made = function(*(tuple(map(float, x.split(","))) if "," in x else float(x) for x in case.split()))
        print(*(map(float, made) if hasattr(made, "__iter__") else [float(made)]), file=results)
)";

using Results = std::vector<std::array<float, 4>>;

Result<Results> byPython(const std::filesystem::path& file, const Reference& reference, const std::string& cases) {
    const char* own = std::getenv("TEGUMENT_PYTHON"); // that runs the Python module
    const auto python = own ? std::optional<std::filesystem::path>(own) : findProgram("python3");
    if (!python) return machineError(8206, "there is no python3 to run " + file.string(), "Debian: apt-get install python3");
    const Temporary folder(newTemporaryFolder());
    const std::string input = (folder.path() / "cases").string(), output = (folder.path() / "results").string();
    if (auto written = writeFile(input, cases); !written) return written.error();
    const auto done =
        runProcess({.arguments = {python->string(), "-c", kScript, file.string(), reference.name, input, output}}, kTimeLimit);
    if (!done) return done.error();
    const auto printed = readFile(output);
    if (done->exitCode != 0 || done->timedOut || !printed) {
        const std::string said(trim(done->output));
        return inputError(8206, reference.at, fmt::format("{} has no result for {}", file.string(), reference.name),
                          done->timedOut ? fmt::format("it took more than {} s", kTimeLimit) : said.substr(said.rfind('\n') + 1));
    }
    Results results;
    std::istringstream lines(*printed);
    for (std::string line, word; std::getline(lines, line);) {
        results.emplace_back();
        std::istringstream words(line);
        std::size_t count = 0;
        for (; words >> word; ++count)
            if (count < 4) results.back().at(count) = static_cast<float>(std::strtod(word.c_str(), nullptr));
        if (count != reference.components)
            return inputError(8206, reference.at, fmt::format("{} returns {} numbers", reference.name, count),
                              fmt::format("{} are declared here", reference.components));
    }
    return results;
}

} // namespace

Result<Results> evaluate(const std::filesystem::path& file, const Reference& reference, std::span<const Recorded> arguments,
                         std::uint32_t cases) {
    if (file.empty())
        return inputError(8206, reference.at, "no file of references is given", "--reference refs.py, with a function " + reference.name);
    std::string why = fmt::format("extern \"C\" void {}(const double* arguments, double* result)", reference.name);
    const bool python = file.extension() == ".py";
    void* const library = python ? nullptr : openLibrary(std::filesystem::absolute(file), why);
    void* const found = library == nullptr ? nullptr : functionOf(library, reference.name.c_str());
    if (!python && found == nullptr)
        return inputError(8206, reference.at, fmt::format("{} has no function {}", file.string(), reference.name), why);
    std::string text;
    Results results(python ? 0 : cases);
    for (std::uint32_t i = 0; i < cases; ++i) {
        std::vector<double> given;
        for (std::uint32_t a = 0; a < reference.arguments; ++a) {
            const Recorded& argument = arguments[std::size_t{a} * cases + i];
            for (std::uint32_t c = 0; c < std::max(argument.count, 1U); ++c) {
                given.push_back(static_cast<double>(argument.numbers.at(c)));
                text += fmt::format("{}{}", c > 0 ? "," : " ", given.back());
            }
        }
        text += '\n';
        std::array<double, 4> made{};
        if (found != nullptr) reinterpret_cast<void (*)(const double*, double*)>(found)(given.data(), made.data());
        for (std::size_t c = 0; c < made.size() && !python; ++c)
            results[i].at(c) = static_cast<float>(made.at(c));
    }
    return python ? byPython(file, reference, text) : results;
}

} // namespace tegument::testing
