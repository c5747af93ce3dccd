#pragma once
// A file of tests, made ready to be compiled: tests with their inputs and fixtures, and code in which every assertion knows its place.

#include "host/effect/model.h"
#include "host/support/shader_stage.h"
#include "tools/test/table.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tegument::testing {

/// Assertions first; then what only notes values; then what instrumentation finds.
enum class SiteKind { Equal, Near, True, Finite, Between, Increasing, Decreasing, Continuous, Watch, Input, Loop, Index, NotANumber };

/// A place in the source that the device tells of.
struct Site {
    SiteKind kind = SiteKind::True;
    SourcePosition at;
    std::string text;           // as written; of an input its name
    std::string line;           // of the source
    std::uint32_t property = 0; // of an assertion about neighbouring cases: its number in the test
    [[nodiscard]] bool isAssertion() const { return kind <= SiteKind::Continuous; }
    [[nodiscard]] bool isProperty() const { return kind >= SiteKind::Increasing && kind <= SiteKind::Continuous; }
};

/// A value from outside: tgTexture, tgBuffer, tgConstant, tgSampler.
struct Fixture {
    std::string kind;
    std::string name;
    SourcePosition at;
    std::vector<double> numbers;
    std::uint32_t width = 0; // of a texture; of a buffer given by its size, the numbers
    std::uint32_t height = 0;
    std::filesystem::path file;
    std::vector<std::string> words; // of a sampler
    bool isDefault = false;         // of the declaration
};

/// tgReference: of arguments that a run records the result of another program, which the next run reads.
struct Reference {
    std::string name;
    SourcePosition at;
    std::uint32_t first = 0; // of its arguments among what is recorded; behind them the result
    std::uint32_t arguments = 0;
    std::uint32_t components = 1;
};

struct Test {
    std::string name;
    SourcePosition at;
    ShaderStage stage = ShaderStage::Compute;
    std::array<std::uint32_t, 3> group = {0, 0, 0}; // threads that work together; 0: each case alone
    std::uint32_t cases = 1;
    std::uint32_t row = 1;        // cases that differ in the first input alone, in its order
    std::uint32_t properties = 0; // that are recorded case by case: of neighbours, and of references
    bool neighbours = false;      // are compared
    std::vector<Reference> references;
    std::vector<Fixture> fixtures;  // the file's own first
    std::vector<float> table;       // what its inputs read
    std::string entry;              // of the shader
    std::optional<std::string> why; // it is expected to fail

    [[nodiscard]] std::uint32_t invocations() const {
        return stage == ShaderStage::Pixel ? 4 : group[0] == 0 ? 1 : group[0] * group[1] * group[2];
    }
};

/// A change of the code that a test should notice.
struct Mutant {
    std::size_t token = 0;
    SourcePosition at;
    std::string from;
    std::string to;
};

/// A place whose runs are counted: a statement, or one of the two sides of an `if`, a `?` or a loop.
struct Counted {
    SourcePosition at;
    int side = -1; // 0: the condition held
};

struct TestFile {
    std::filesystem::path path;
    std::string code;
    std::vector<Test> tests;
    std::vector<Site> sites;
    std::vector<std::filesystem::path> includes;
    std::map<std::string, std::string> elements; // of structured buffers by name: their type
    bool direct3D9 = false;                      // its HLSL is respelt for DXC
    std::vector<Sampler> samplers;               // of Direct3D 9, each with its state, under the names of the code
    std::map<std::string, std::string> authors;  // of the code's names of samplers and their textures those that the author wrote
    std::vector<Counted> counted;
    std::vector<Mutant> mutants; // that could be made
    std::vector<Diagnostic> warnings;
};

struct ReadOptions {
    LoadOptions load;
    bool coverage = false; // count the runs of statements and branches outside of tests
    bool trace = false;    // look for the first NaN
    std::optional<Mutant> mutant;
};

/// TG8201: no test in it, TG8202: one is not well formed, TG8203: an input or a fixture is not; and what the preprocessor has to say.
[[nodiscard]] Result<TestFile> readTests(const std::filesystem::path& file, const ReadOptions& options);

} // namespace tegument::testing
