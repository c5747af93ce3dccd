// Every function of hlsl/, and some of effects/passes/, against double precision, by both compilers, on thousands of argument lists in one
// draw.

#include "tests/hlsl/judge.h"
#include "tests/hlsl/sources.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>

using namespace tegument;
using namespace tegument::test;

namespace {

struct Trial {
    const FunctionCase* function = nullptr;
    int setting = 2;
    Compiler compiler = Compiler::Dxc;
};

void PrintTo(const Trial& call, std::ostream* out) {
    *out << call.function->function << ", setting " << call.setting << ", " << compilerName(call.compiler);
}

const Cases& cases() {
    static const Cases kCases = allCases();
    return kCases;
}

std::vector<Trial> calls() {
    std::vector<Trial> all;
    for (const FunctionCase& function : cases())
        for (int setting : function.settings)
            for (Compiler compiler : {Compiler::Dxc, Compiler::Glslang})
                all.push_back({&function, setting, compiler});
    return all;
}

std::string nameOf(const Trial& call) {
    static const std::array<const char*, 3> kSettings = {"seed", "deon2007", "corrected"};
    const auto place = std::to_string(call.function - cases().data()); // several cases may test one function
    return fmt::format("{}_{}_{}_{}", call.function->function, place, kSettings.at(static_cast<std::size_t>(call.setting)),
                       call.compiler == Compiler::Dxc ? "dxc" : "glslang");
}

Result<gpu::Device>& device() {
    static Result<gpu::Device> made = gpu::Device::create({.validation = true});
    return made;
}

/// Rows of docs/design/reference.md, written where TEGUMENT_FUNCTION_TABLE says.
class Table : public testing::Environment {
public:
    void add(const Trial& call, const Samples& samples, const Verdict& verdict) {
        const auto worst = samples.list(verdict.ulp.list);
        rows_.insert(fmt::format("| `{}` | {} | {} | {} | {:.2g} | {:.2g} | {:.3g} | {} |", call.function->function,
                                 call.setting == 0   ? "seed"
                                 : call.setting == 1 ? "deon2007"
                                                     : "corrected",
                                 call.compiler == Compiler::Dxc ? "DXC" : "glslang", verdict.compared, verdict.absolute.error,
                                 verdict.relative.error, verdict.ulp.error,
                                 verdict.ulp.error > 0 ? describe(*call.function, worst) : "exact"));
    }
    void TearDown() override {
        const char* path = std::getenv("TEGUMENT_FUNCTION_TABLE");
        if (!path || rows_.empty()) return;
        std::ofstream file(path);
        file << "| function | setting | compiler | inputs | absolute | relative | ULP | arguments of the largest ULP error |\n"
                "|---|---|---|---|---|---|---|---|\n";
        for (const std::string& row : rows_)
            file << row << "\n";
    }

private:
    std::set<std::string> rows_;
};

Table& table() {
    static auto* made = static_cast<Table*>(testing::AddGlobalTestEnvironment(new Table)); // GoogleTest deletes it
    return *made;
}

const Table& kRegisteredBeforeMain = table();

class Functions : public testing::TestWithParam<Trial> {};

void expectWithinTolerance(const Trial& call, const Samples& samples, const Evaluated& evaluated, const Verdict& verdict) {
    const FunctionCase& function = *call.function;
    if (!verdict.notFinite.empty())
        ADD_FAILURE() << verdict.notFinite.size() << " results are not finite although their arguments are, first: "
                      << describe(function, samples.list(verdict.notFinite.front()));
    if (verdict.allowed.error <= 1) return;
    const auto worst = samples.list(verdict.allowed.list);
    const std::vector<double> exact(worst.begin(), worst.end());
    const Values should = function.expected(Inputs(exact, function.arguments, call.setting));
    ADD_FAILURE() << "arguments " << describe(function, worst) << "\nexpected "
                  << fmt::format("({:.9g})\nactual   ({:.9g})\n", fmt::join(should, ", "),
                                 fmt::join(evaluated.results[verdict.allowed.list], ", "))
                  << verdict.allowed.error << " times what is allowed: " << function.tolerance.forward << " ULP of the result, "
                  << function.tolerance.backward << " ULP of the arguments, " << function.tolerance.absolute << ", because "
                  << function.tolerance.why;
}

} // namespace

TEST_P(Functions, are_what_double_precision_says) {
    if (!device()) GTEST_SKIP() << format(device().error());
    const Trial& call = GetParam();
    if (!compilerAvailable(call.compiler)) GTEST_SKIP() << compilerName(call.compiler) << " is not available";
    const Samples samples = makeSamples(*call.function);
    const std::size_t before = device()->validationMessages().size();
    const auto evaluated = evaluate(*device(), *call.function, call.setting, samples, call.compiler);
    ASSERT_TRUE(evaluated) << format(evaluated.error());
    EXPECT_EQ(device()->validationMessages().size(), before);
    EXPECT_EQ(evaluated->unwritten, 0U) << "results still hold the poison";
    EXPECT_EQ(evaluated->overwritten, 0U) << "pixels behind the last call were written";
    const Verdict verdict = judge(*call.function, call.setting, samples, *evaluated);
    EXPECT_GT(verdict.compared, static_cast<std::size_t>(call.function->samples) / 10) << "the domain leaves too little to compare";
    expectWithinTolerance(call, samples, *evaluated, verdict);
    table().add(call, samples, verdict);
}

INSTANTIATE_TEST_SUITE_P(Hlsl, Functions, testing::ValuesIn(calls()), [](const auto& each) { return nameOf(each.param); });

TEST(Coverage, every_function_of_hlsl_has_a_case_that_calls_it) {
    const auto functions = functionsIn("hlsl");
    ASSERT_GT(functions.size(), 40U) << "the sources were not read";
    for (const ShaderFunction& function : functions) {
        const bool printed = function.file.starts_with("printed/");
        const auto calls = [&](const FunctionCase& c) {
            const bool read = std::ranges::any_of(c.settings, [&](int setting) { return printed == (setting != 2); });
            return read && c.function == function.name && c.body.find(function.name + "(") != std::string::npos;
        };
        EXPECT_TRUE(std::ranges::any_of(cases(), calls)) << "hlsl/" << function.file << ": " << function.name << " has no case";
    }
}

TEST(Coverage, every_case_tests_what_exists) {
    auto functions = functionsIn("hlsl");
    const auto ofPasses = functionsIn("effects/passes");
    functions.insert(functions.end(), ofPasses.begin(), ofPasses.end());
    auto others = constantsAndMacrosIn("effects/passes");
    others.merge(constantsAndMacrosIn("hlsl"));
    for (const FunctionCase& c : cases())
        EXPECT_TRUE(others.contains(c.function) ||
                    std::ranges::any_of(functions, [&](const ShaderFunction& f) { return f.name == c.function; }))
            << c.function;
}

TEST(Judge, a_wrong_formula_is_found) {
    if (!device()) GTEST_SKIP() << format(device().error());
    FunctionCase wrong = specularCases().front();
    const auto right = wrong.expected;
    wrong.expected = [&](const Inputs& x) { return values(1.001 * right(x)[0]); };
    const Samples samples = makeSamples(wrong);
    const auto evaluated = evaluate(*device(), wrong, 2, samples, Compiler::Glslang);
    ASSERT_TRUE(evaluated) << format(evaluated.error());
    EXPECT_GT(judge(wrong, 2, samples, *evaluated).allowed.error, 1);
}
