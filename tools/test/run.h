#pragma once
// Runs the tests of a file: each by each compiler, on the device.

#include "host/gpu/gpu.h"
#include "host/spirv/compile.h"
#include "tools/test/device.h"
#include "tools/test/test_file.h"

#include <string>
#include <utility>
#include <vector>

namespace tegument::testing {

struct RunOptions {
    ReadOptions read;
    std::vector<Compiler> compilers;
    std::filesystem::path reference; // of tgReference: Python, or a shared library
    std::string filter;              // of names, with *; empty: all
    std::uint32_t seed = 1;
    std::uint32_t loopMost = 50'000; // turns of a loop: lavapipe leaves each after 65,535, in silence
};

/// An assertion that failed, or what instrumentation found.
struct Failure {
    Diagnostic message; // as a whole
    std::uint32_t cases = 0;
    std::vector<std::pair<std::string, std::string>> values; // of inputs and what is watched, in the first case that failed
    std::string value;
    std::string expected;
};

/// How far an assertion's values were from what was expected.
struct ErrorStatistics {
    Site site;
    Counts counts;
};

struct TestResult {
    std::string name;
    SourcePosition at;
    Compiler compiler = Compiler::Dxc;
    bool compiled = false;
    bool expectedToFail = false;
    std::uint32_t cases = 0;
    std::uint64_t assertions = 0; // judged, all cases together
    double milliseconds = 0;
    std::vector<Failure> failures;
    std::vector<ErrorStatistics> errors;

    [[nodiscard]] bool passed() const { return compiled && failures.empty(); }
};

struct FileResult {
    std::filesystem::path path;
    bool read = true; // else nothing of it was run
    std::vector<TestResult> tests;
    std::vector<Diagnostic> diagnostics; // of the compilers, each once
    std::vector<std::filesystem::path> includes;
    std::vector<std::pair<Counted, std::uint64_t>> counted; // and how often they ran, with the first compiler

    [[nodiscard]] bool passed() const;
};

[[nodiscard]] bool chosen(const std::string& name, const std::string& filter);

/// What is wrong with a test is in its result; an Error is of the file as a whole, or of the machine.
[[nodiscard]] Result<FileResult> runFile(gpu::Device& device, const std::filesystem::path& file, const RunOptions& options);

/// What became of a mutant.
enum class Fate { Killed, Survived, NotCompiled };
struct MutantResult {
    Mutant mutant;
    Fate fate = Fate::Survived;
};

/// At most `most` changes of the code, drawn by the seed, each against all tests and the first compiler.
[[nodiscard]] Result<std::vector<MutantResult>> mutate(gpu::Device& device, const std::filesystem::path& file, const RunOptions& options,
                                                       std::size_t most, const std::function<void(std::size_t, std::size_t)>& progress);

} // namespace tegument::testing
