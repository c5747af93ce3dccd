// Each file of expect_fail/ says in its first line what loading it (and, where that works, running its scripts) reports first.

#include "tests/effect/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = "tests/effect/expect_fail";
constexpr std::string_view kPrefix = "// expect: ";

std::vector<fs::path> effects() {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(kFolder))
        if (entry.path().extension() == ".fx") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

std::string firstLine(const fs::path& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    return line;
}

std::string firstMessage(const fs::path& file) {
    const bool lenient = file.stem().string().ends_with("_lenient");
    const Result<Effect> effect = loadEffect(file, {.lenient = lenient});
    if (!effect) return format(effect.error().diagnostics[0]);
    if (!effect->warnings.empty()) return format(effect->warnings[0]);
    if (const std::optional<Diagnostic> intrinsic = direct3D9Intrinsic(*effect)) return format(*intrinsic);
    Log log;
    const Result<void> done = runScripts(*effect, "", log);
    return done ? "no message" : format(done.error().diagnostics[0]);
}

class ExpectFail : public testing::TestWithParam<fs::path> {};

TEST_P(ExpectFail, gives_the_message_of_its_first_line) {
    const std::string message = firstMessage(GetParam());
    const std::string line = message.substr(0, message.find('\n'));
    const std::string expected = firstLine(GetParam());
    ASSERT_TRUE(expected.starts_with(kPrefix));
    EXPECT_EQ(line, kFolder.string() + "/" + expected.substr(kPrefix.size()));
}

std::string testName(const testing::TestParamInfo<fs::path>& info) {
    return "tg" + info.param.stem().string();
}

INSTANTIATE_TEST_SUITE_P(Effects, ExpectFail, testing::ValuesIn(effects()), testName);

TEST(Diagnostics, every_documented_code_has_an_effect_that_shows_it) {
    std::ifstream page("docs/diagnostics.md");
    ASSERT_TRUE(page);
    std::set<std::string> shown;
    for (const fs::path& file : effects())
        shown.insert("TG" + file.filename().string().substr(0, 4));
    int documented = 0;
    bool ofEffectFiles = false;
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("## ")) ofEffectFiles = line == "## Effect files";
        if (!ofEffectFiles || !line.starts_with("| TG")) continue;
        ++documented;
        EXPECT_TRUE(shown.contains(line.substr(2, 6))) << line;
    }
    EXPECT_EQ(documented, static_cast<int>(shown.size()));
}

} // namespace
} // namespace tegument::test
