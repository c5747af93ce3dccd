// tegument test: unit tests of shaders, written in HLSL.

#include "host/support/file.h"
#include "host/support/kept_inputs.h"
#include "meshprep/assets/names.h"
#include "tools/cli/command_line.h"
#include "tools/cli/commands.h"
#include "tools/cli/job_options.h"
#include "tools/cli/output.h"
#include "tools/test/report.h"
#include "tools/test/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <set>
#include <thread>

namespace tegument::app {

namespace {

using testing::FileResult;
using testing::TestResult;

struct TestArguments {
    std::vector<std::string> files;
    EffectOptions effect;
    std::string compiler = "both";
    std::string device;
    std::string filter;
    std::string junit;
    std::string coverage;
    std::string reference;
    std::size_t mutants = 0;
    std::uint32_t seed = 1;
    std::uint32_t loopMost = testing::RunOptions().loopMost;
    bool list = false;
    bool errors = false;
    bool validate = false;
    bool watch = false;
    bool json = false;
};

std::string_view nameOf(Compiler compiler) {
    return compiler == Compiler::Dxc ? "dxc" : "glslang";
}

Result<testing::RunOptions> runOptions(const TestArguments& arguments) {
    testing::RunOptions options{.read = {.load = assets::loadOptions(arguments.effect)}, .filter = arguments.filter};
    options.read.coverage = !arguments.coverage.empty();
    options.seed = arguments.seed;
    options.loopMost = arguments.loopMost;
    options.reference = arguments.reference;
    for (const Compiler compiler : {Compiler::Dxc, Compiler::Glslang})
        if (arguments.compiler == nameOf(compiler) || (arguments.compiler == "both" && compilerAvailable(compiler)))
            options.compilers.push_back(compiler);
    if (options.compilers.empty()) options.compilers.push_back(defaultCompiler());
    if (!compilerAvailable(options.compilers.front())) return machineError(3002, whyCompilerMissing(options.compilers.front()));
    return options;
}

Json resultJson(const TestResult& test) {
    Json json{{"name", test.name},
              {"file", test.at.file},
              {"line", test.at.line},
              {"compiler", nameOf(test.compiler)},
              {"passed", test.passed()},
              {"compiled", test.compiled},
              {"expected_to_fail", test.expectedToFail},
              {"cases", test.cases},
              {"assertions", test.assertions},
              {"ms", test.milliseconds},
              {"failures", Json::array()},
              {"errors", Json::array()}};
    for (const testing::Failure& failure : test.failures) {
        Json told = toJson(failure.message);
        told["cases"] = failure.cases;
        told["values"] = Json::object();
        for (const auto& [name, value] : failure.values)
            told["values"][name] = value;
        if (!failure.value.empty()) told["value"] = failure.value;
        if (!failure.expected.empty()) told["expected"] = failure.expected;
        json["failures"].push_back(std::move(told));
    }
    for (const testing::ErrorStatistics& each : test.errors)
        json["errors"].push_back({{"line", each.site.at.line},
                                  {"assertion", each.site.text},
                                  {"absolute", each.counts.absolute},
                                  {"relative", each.counts.relative},
                                  {"ulp", each.counts.ulp},
                                  {"ulp_classes", each.counts.classes}});
    return json;
}

/// Shares of the values by their errors.
void printErrors(const TestResult& test) {
    for (const testing::ErrorStatistics& each : test.errors) {
        fmt::print("  {}({}) {}: at most {:.3g}, relative {:.3g}, {} ulp\n", each.site.at.file, each.site.at.line, each.site.text,
                   each.counts.absolute, each.counts.relative, each.counts.ulp);
        for (std::size_t i = 0; i < each.counts.classes.size(); ++i) {
            const std::size_t most = i < 2 ? i : std::size_t{1} << (i - 1);
            const double share = static_cast<double>(each.counts.classes[i]) / std::max(1U, each.counts.runs);
            if (each.counts.classes[i] == 0) continue;
            const std::string class_ = i + 1 == each.counts.classes.size() ? "more" : fmt::format("<= {} ulp", most);
            fmt::print("    {:>12} {:>8} {}\n", class_, each.counts.classes[i],
                       std::string(static_cast<std::size_t>(share * 40 + 0.5), '#'));
        }
    }
}

std::string summary(const std::vector<FileResult>& results, double seconds) {
    std::size_t passed = 0;
    std::size_t all = 0;
    std::uint64_t assertions = 0;
    for (const FileResult& file : results)
        for (const TestResult& test : file.tests) {
            ++all;
            passed += test.passed() ? 1 : 0;
            assertions += test.assertions;
        }
    const auto unread = std::ranges::count_if(results, [](const FileResult& file) { return !file.read; });
    const std::string files = unread > 0 ? fmt::format(", {} not read", unread == 1 ? "1 file" : fmt::format("{} files", unread)) : "";
    return fmt::format("{} passed, {} failed{}; {} assertions in {:.1f} s\n", passed, all - passed, files, assertions, seconds);
}

void printResults(const std::vector<FileResult>& results, const TestArguments& arguments) {
    for (const FileResult& file : results) {
        (void)std::fflush(stdout); // both may go to one place
        warn(file.diagnostics);
        if (!file.read) fmt::print("FAILED  {}\n", file.path.string());
        for (const TestResult& test : file.tests) {
            fmt::print("{}  {}  {}  {}{}\n", test.passed() ? "passed" : "FAILED", file.path.string(), test.name, nameOf(test.compiler),
                       test.cases > 1 ? fmt::format("  {} cases", test.cases) : "");
            for (const testing::Failure& failure : test.failures)
                fmt::print("{}\n", format(failure.message));
            if (arguments.errors) printErrors(test);
        }
    }
}

void printCoverage(const testing::Coverage& coverage) {
    std::vector<std::vector<std::string>> rows;
    for (const auto& [file, source] : coverage) {
        std::set<int> lines;
        for (const auto& [line, runs] : source.lines)
            if (runs == 0) lines.insert(line);
        for (const auto& [place, taken] : source.sides)
            if (taken == 0) lines.insert(place[0]);
        std::string missed;
        for (const int line : lines)
            if (missed.size() < kWidth / 2) missed += fmt::format("{}{}", missed.empty() ? "" : " ", line);
        rows.push_back({file, fmt::format("{} of {}", testing::ran(source.lines), source.lines.size()),
                        fmt::format("{} of {}", testing::ran(source.sides), source.sides.size()), missed});
    }
    fmt::print("{}", table({"source", "lines reached", "branches taken", "not, or one way alone"}, rows));
}

int listTests(const TestArguments& arguments, const testing::RunOptions& options) {
    Json json{{"tests", Json::array()}};
    for (const std::string& file : arguments.files) {
        const auto tests = testing::readTests(file, options.read);
        if (!tests) return fail(tests.error(), arguments.json);
        for (const testing::Test& test : tests->tests) {
            if (!testing::chosen(test.name, arguments.filter)) continue;
            if (!arguments.json) fmt::print("{}({})  {}  {} cases\n", test.at.file, test.at.line, test.name, test.cases);
            json["tests"].push_back({{"name", test.name}, {"file", test.at.file}, {"line", test.at.line}, {"cases", test.cases}});
        }
    }
    if (arguments.json) print(json);
    return 0;
}

/// The exit code.
int mutateFiles(const TestArguments& arguments, const testing::RunOptions& options, gpu::Device& device) {
    Json json{{"killed", 0}, {"survived", Json::array()}, {"not_compiled", 0}};
    std::size_t killed = 0;
    std::size_t broken = 0;
    for (const std::string& file : arguments.files) {
        Progress progress;
        const auto results = testing::mutate(device, file, options, arguments.mutants,
                                             [&](std::size_t done, std::size_t all) { progress.count("mutants", done, all); });
        progress.clear();
        if (!results) return fail(results.error(), arguments.json);
        for (const testing::MutantResult& each : *results) {
            killed += each.fate == testing::Fate::Killed ? 1 : 0;
            broken += each.fate == testing::Fate::NotCompiled ? 1 : 0;
            if (each.fate != testing::Fate::Survived) continue;
            const SourcePosition& at = each.mutant.at;
            const std::string to = each.mutant.to.empty() ? "nothing" : each.mutant.to;
            if (!arguments.json) fmt::print("{}({},{}): survived: {} in place of {}\n", at.file, at.line, at.column, to, each.mutant.from);
            json["survived"].push_back(
                {{"file", at.file}, {"line", at.line}, {"column", at.column}, {"from", each.mutant.from}, {"to", each.mutant.to}});
        }
    }
    const std::size_t survived = json["survived"].size();
    json["killed"] = killed;
    json["not_compiled"] = broken;
    if (arguments.json)
        print(json);
    else
        fmt::print("{} mutants killed, {} survived, {} did not compile\n", killed, survived, broken);
    return survived == 0 ? 0 : static_cast<int>(Blame::Input);
}

Result<void> writeReports(const TestArguments& arguments, const std::vector<FileResult>& results) {
    if (!inputsAreKept()) return {};
    if (!arguments.junit.empty())
        if (auto written = writeFile(arguments.junit, testing::junit(results)); !written) return written;
    if (!arguments.coverage.empty()) return writeFile(arguments.coverage, testing::lcov(testing::coverageOf(results)));
    return {};
}

Result<std::vector<FileResult>> runFiles(const TestArguments& arguments, const testing::RunOptions& options, gpu::Device& device) {
    std::vector<FileResult> results;
    for (const std::string& file : arguments.files) {
        auto result = testing::runFile(device, file, options);
        if (!result && result.error().blame != Blame::Input) return result.error();
        if (result)
            results.push_back(std::move(*result));
        else // the others are run all the same
            results.push_back({.path = file, .read = false, .diagnostics = result.error().diagnostics});
    }
    if (std::ranges::all_of(results, [](const FileResult& file) { return file.read && file.tests.empty(); }))
        return usageError(8200, fmt::format("no test has a name like '{}'", arguments.filter),
                          "--list shows the names; * stands for anything");
    return results;
}

/// The exit code of one run.
int runOnce(const TestArguments& arguments, const testing::RunOptions& options, gpu::Device& device) {
    const auto start = std::chrono::steady_clock::now();
    Progress progress;
    progress.say("compiling and running tests");
    const auto results = runFiles(arguments, options, device);
    progress.clear();
    if (!results) return fail(results.error(), arguments.json);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const bool passed = std::ranges::all_of(*results, &FileResult::passed);
    if (arguments.json) {
        Json json{{"passed", passed},
                  {"seconds", seconds},
                  {"device", device.info().name},
                  {"tests", Json::array()},
                  {"diagnostics", Json::array()}};
        for (const FileResult& file : *results) {
            for (const TestResult& test : file.tests)
                json["tests"].push_back(resultJson(test));
            for (const Diagnostic& message : file.diagnostics)
                json["diagnostics"].push_back(toJson(message));
        }
        print(json);
    } else {
        printResults(*results, arguments);
        if (!arguments.coverage.empty()) printCoverage(testing::coverageOf(*results));
        fmt::print("{}", summary(*results, seconds));
    }
    if (const auto written = writeReports(arguments, *results); !written) return fail(written.error(), false);
    const auto messages = device.validationMessages();
    for (const std::string& message : messages)
        say("validation: " + message);
    if (!messages.empty()) return static_cast<int>(Blame::Machine);
    return passed ? 0 : static_cast<int>(Blame::Input);
}

/// Runs again whenever a file that was read changes, until it is interrupted.
int watchFiles(const TestArguments& arguments, const testing::RunOptions& options, gpu::Device& device) {
    namespace fs = std::filesystem;
    const auto stamps = [&] {
        std::vector<fs::file_time_type> times;
        std::error_code code;
        for (const std::string& file : arguments.files) {
            times.push_back(fs::last_write_time(file, code));
            times.push_back(fs::last_write_time(arguments.reference, code));
            const auto tests = testing::readTests(file, options.read);
            for (std::size_t i = 0; tests && i < tests->includes.size(); ++i)
                times.push_back(fs::last_write_time(tests->includes[i], code));
        }
        return times;
    };
    for (;;) {
        const auto before = stamps();
        (void)runOnce(arguments, options, device);
        (void)std::fflush(stdout);
        constexpr std::chrono::milliseconds kPause{300};
        do
            std::this_thread::sleep_for(kPause);
        while (stamps() == before);
    }
}

int test(const TestArguments& arguments) {
    for (const std::string& file : arguments.files)
        if (const auto exists = assets::fileExists(file, "the file of tests"); !exists) return fail(exists.error(), arguments.json);
    const auto options = runOptions(arguments);
    if (!options) return fail(options.error(), arguments.json);
    if (arguments.list) return listTests(arguments, *options);
    if (const auto can = checkOutput(arguments.junit, {".xml"}); !can) return fail(can.error(), arguments.json);
    if (const auto can = checkOutput(arguments.coverage, {".info"}); !can) return fail(can.error(), arguments.json);
    auto device = gpu::Device::create({.validation = arguments.validate, .prefer = arguments.device});
    if (!device) return fail(device.error(), arguments.json);
    if (arguments.watch) return watchFiles(arguments, *options, *device);
    const int code = runOnce(arguments, *options, *device);
    return code != 0 || arguments.mutants == 0 ? code : mutateFiles(arguments, *options, *device);
}

} // namespace

void addTest(CLI::App& program, Action& action) {
    auto arguments = std::make_shared<TestArguments>();
    CLI::App* command = program.add_subcommand("test", "Run unit tests of shaders, written in HLSL; no GPU is needed");
    command->add_option("files", arguments->files, "Files of tests (.test.hlsl)")->required();
    command->add_option("--filter", arguments->filter, "Only tests of this name; * stands for anything");
    command->add_flag("--list", arguments->list, "List the tests, run none");
    command->add_option("--compiler", arguments->compiler, "dxc, glslang or both; default: both, as far as they are installed")
        ->transform(oneOf({"dxc", "glslang", "both"}));
    command->add_option("--seed", arguments->seed, "Of random inputs and mutants")->capture_default_str();
    command->add_option("--max-loop", arguments->loopMost, "Turns after which a loop counts as endless")
        ->check(CLI::Range(1U, 1U << 28U))
        ->capture_default_str();
    command->add_flag("--errors", arguments->errors, "Print how far the values of each tgNear were off: largest errors, and shares by ulp");
    command->add_option("--reference", arguments->reference, "Python (.py) or a library: what tgReference asks")->check(CLI::ExistingFile);
    command->add_option("--coverage", arguments->coverage, "Print which lines and branches ran, and write them for LCOV (.info)");
    command->add_option("--mutate", arguments->mutants,
                        "Change so many constants and operators, one at a time; print those that no test notices");
    command->add_option("--junit", arguments->junit, "Write the results as JUnit's XML (.xml)");
    CLI::Option* json = command->add_flag("--json", arguments->json, "Print JSON");
    command->add_flag("--watch", arguments->watch, "Run again whenever a file changes, until interrupted")->excludes(json);
    command->add_option("--device", arguments->device, "Part of the Vulkan device's name; NAME#2: the second of that name");
    command->add_flag("--validate", arguments->validate, "Run under the Vulkan validation layers; any message is a failure");
    addEffectOptions(*command, arguments->effect);
    addExamples(*command,
                {{"test my.test.hlsl", "every test in the file, with both compilers"},
                 {"test my.test.hlsl --filter 'fresnel*' --watch", "some, again at every save"},
                 {"test my.test.hlsl --coverage my.info --mutate 100", "what the tests reach, and what they miss"}},
                "A test: TG_TEST(name) { float x = tgRange(0, 1, 100); tgNear(sqrt(x) * sqrt(x), x, tgUlp(2)); }\n"
                "Exit code 1 when any test failed or does not compile, or a mutant survived (docs/test.md).");
    command->callback([arguments, &action] { action = [arguments] { return test(*arguments); }; });
}

} // namespace tegument::app
