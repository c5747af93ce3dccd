#include "host/effect/preprocess.h"
#include "host/support/file.h"
#include "tests/check/describe.h"
#include "tests/check/effect_files.h"
#include "tools/check/check.h"
#include "tools/check/resources.h"
#include "tools/emit/flatten.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>
#include <unistd.h>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

/// The names of the effects, without folder and extension.
std::vector<std::string> effectNames() {
    std::vector<std::string> names;
    for (const fs::path& file : effectFiles())
        names.push_back(file.stem().string());
    return names;
}

/// The parameter is an effect's name: a process of its own asks for each.
class Matrix : public testing::TestWithParam<std::string> {
protected:
    void SetUp() override {
        if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) GTEST_SKIP() << missing;
    }

    static fs::path file() { return fs::path("effects") / (GetParam() + ".fx"); }

    /// In every setting, compiled once for all tests.
    static const CheckReport& effect() {
        static std::map<std::string, CheckReport> reports;
        const auto known = reports.find(GetParam());
        if (known != reports.end()) return known->second;
        return reports[GetParam()] = checkEffects({file()}, {Target::Fx2, Target::Fx4, Target::Fx5, Target::Sm5, Target::SpirvGlslang},
                                                  {.allSettings = true});
    }
};

INSTANTIATE_TEST_SUITE_P(Effects, Matrix, testing::ValuesIn(effectNames()), [](const auto& one) { return one.param; });

TEST_P(Matrix, every_effect_passes_as_direct3d_9_10_and_11_in_every_setting) {
    ASSERT_FALSE(effect().files.empty());
    for (const FileReport& file : effect().files) {
        EXPECT_FALSE(file.sm3.empty()) << describe(file);
        for (const TargetCheck& target : file.targets)
            EXPECT_EQ(target.verdict, Verdict::Passed) << describe(file);
    }
}

TEST_P(Matrix, every_pass_of_every_effect_is_measured_against_shader_model_3) {
    for (const FileReport& file : effect().files) {
        std::size_t stages = 0;
        for (const Technique& technique : file.effect.techniques)
            if (std::ranges::none_of(technique.passes, [](const Pass& pass) { return pass.computeShader.has_value(); }))
                stages += 2 * technique.passes.size(); // those with compute shaders are Direct3D 11's alone
        EXPECT_EQ(file.sm3.size(), stages) << file.file << " " << file.variant;
        for (const PassUsage& pass : file.sm3)
            for (const Sm3Limit& limit : kSm3Limits)
                EXPECT_LE(pass.usage.*limit.used, pass.profile == "vs_3_0" ? limit.vertex : limit.pixel) << pass.entry << " " << limit.what;
    }
}

/// The lines of docs/design/tables/resources.csv without their first cell, by the effect that stands in it. Each cell ends with a comma.
std::map<std::string, std::vector<std::string>> documentedRows() {
    std::map<std::string, std::vector<std::string>> rows;
    const auto text = readFile("docs/design/tables/resources.csv");
    std::istringstream lines(text ? *text : "");
    for (std::string line; std::getline(lines, line);)
        if (const std::size_t comma = line.find(','); comma != std::string::npos)
            rows[line.substr(0, comma)].push_back(line.substr(comma + 1) + ",");
    return rows;
}

/// All numbers behind the first three cells.
std::vector<int> numbersOf(const std::string& line) {
    std::size_t at = 0;
    for (int cell = 0; cell < 3; ++cell)
        at = line.find(',', at + (cell == 0 ? 0 : 1));
    std::vector<int> numbers;
    std::string digits;
    for (const char c : line.substr(at)) {
        if (std::isdigit(static_cast<unsigned char>(c)) != 0) digits += c;
        if (std::isdigit(static_cast<unsigned char>(c)) == 0 && !digits.empty()) numbers.push_back(std::stoi(std::exchange(digits, {})));
    }
    return numbers;
}

TEST_P(Matrix, the_table_of_resources_tells_what_the_passes_take) {
    const auto documented = documentedRows();
    for (const ResourceRow& row : resourceTable(effect()).rows) {
        const std::string start = row.technique + "," + row.pass + "," + row.profile.substr(0, 2) + " " + row.entry + ",";
        ASSERT_TRUE(documented.contains(row.effect)) << row.effect;
        const auto& lines = documented.at(row.effect);
        const auto line = std::ranges::find_if(lines, [&](const std::string& l) { return l.starts_with(start); });
        ASSERT_NE(line, lines.end())
            << row.effect << ": no row " << start
            << "\ntegument check effects/*.fx --all-settings --target fx_2_0 --resources | tests/tools/csv_table.py "
               "docs/design/tables/resources.csv --heading effect";
        const std::vector<int> numbers = numbersOf(*line);
        ASSERT_FALSE(numbers.empty()) << *line;
        int most = 0;
        for (const Sm3Usage& usage : row.usage)
            most = std::max(most, usage.instructionSlots);
        // Another version of the compiler schedules a few instructions otherwise; a table that is off by more misleads.
        constexpr double kShare = 0.05;
        const int largest =
            *std::max_element(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(std::min(numbers.size(), row.usage.size())));
        EXPECT_NEAR(largest, most, 2 + kShare * most) << *line;
    }
}

/// What a compiler sees of the file: its tokens, and pragmas before those that they stand before.
std::vector<std::string> tokensOf(const fs::path& file, const PreprocessOptions& options) {
    Sources sources;
    const auto seen = preprocess(file, options, sources);
    EXPECT_TRUE(seen) << (seen ? "" : format(seen.error()));
    std::vector<std::string> tokens;
    if (!seen) return tokens;
    auto pragma = seen->pragmas.begin();
    for (std::size_t i = 0; i <= seen->tokens.size(); ++i) {
        for (; pragma != seen->pragmas.end() && pragma->before == i; ++pragma)
            tokens.push_back(pragma->text);
        if (i < seen->tokens.size()) tokens.emplace_back(seen->tokens[i].text);
    }
    return tokens;
}

/// The effect without includes, in a folder of its own.
class Flattened : public Matrix {
protected:
    void SetUp() override {
        Matrix::SetUp();
        if (IsSkipped()) return;
        const auto text = flattenEffect(file(), reading_);
        ASSERT_TRUE(text) << format(text.error());
        ASSERT_TRUE(writeFile(alone_, *text));
    }
    ~Flattened() override { fs::remove_all(alone_.parent_path()); }

    const PreprocessOptions reading_{.read = [](const fs::path& path) { return readFile(path); }};
    const fs::path alone_ = fs::temp_directory_path() / ("tegument-flatten-" + std::to_string(::getpid())) / file().filename();
};

INSTANTIATE_TEST_SUITE_P(Effects, Flattened, testing::ValuesIn(effectNames()), [](const auto& one) { return one.param; });

TEST_P(Flattened, is_the_same_to_each_compiler_in_every_setting) {
    for (std::size_t setting = 0; setting < settingVariants(file()).size(); ++setting) {
        for (const char* target : {"FX_D3D9", "FX_D3D10", "FX_D3D11", "FX_ENTRY"}) {
            PreprocessOptions options = reading_;
            options.defines = {{"TEGUMENT_SETTING", std::to_string(setting)}, {target, "1"}};
            const std::vector<std::string> whole = tokensOf(file(), options);
            EXPECT_GT(whole.size(), 100U);
            EXPECT_EQ(whole, tokensOf(alone_, options)) << setting << " " << target;
        }
    }
}

TEST_P(Flattened, compiles_to_the_same_bytes) {
    const CheckReport alone = checkEffects({alone_}, {Target::Fx2, Target::Fx4, Target::Fx5});
    const auto original = std::ranges::find_if(effect().files, [](const FileReport& one) {
        return one.effect.settings && one.effect.settings->current == one.effect.settings->names.back(); // the default
    });
    ASSERT_NE(original, effect().files.end());
    EXPECT_EQ(original->binaries.size(), 3U) << original->file;
    ASSERT_EQ(alone.files.size(), 1U);
    ASSERT_TRUE(alone.files[0].effect.settings);
    EXPECT_EQ(alone.files[0].effect.settings->current, original->effect.settings->current);
    EXPECT_EQ(original->binaries, alone.files[0].binaries) << original->file;
}

} // namespace
} // namespace tegument::test
