// `tegument check --target spirv-dxc` passes exactly what `tegument render` draws: every effect in tests, and some of them changed at
// random.

#include "tests/cli/program.h"

#include "host/support/file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

constexpr int kShards = 8;
constexpr int kChanged = 100;
constexpr unsigned kSeed = 53;

/// Effects that stand in files of their own, in a fixed order.
std::vector<fs::path> effects() {
    std::vector<fs::path> files;
    for (const char* folder :
         {"tests/adopt/effects", "tests/check/broken", "tests/effect/expect_fail", "tests/effect/foreign", "tests/effect/fuzz/corpus"})
        for (const auto& entry : fs::directory_iterator(folder))
            if (entry.path().extension() == ".fx") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

/// Empty: both say the same.
std::string difference(const std::string& file) {
    const Ran check = tegument({"check", file, "--target", "spirv-dxc"});
    const Ran render = tegument({"render", file, "--mesh", ballMesh(), "--size", "16", "-o", out("both.png")});
    if (check.code == kMachine && check.out.find("not checked") != std::string::npos &&
        check.out.find("0 not checked") == std::string::npos)
        return {}; // no DXC here
    const auto says = [](const Ran& ran, const char* code) { return (ran.err + ran.out).find(code) != std::string::npos; };
    // For values and textures of the user, with all passes made; or recording finds one target bound twice, as only a frame can.
    const bool waits = says(render, "TG4018") || says(render, "TG4030") || says(render, "TG6034");
    const bool blank = says(check, "TG3206"); // no position is written: what render draws is nothing
    if ((check.code == 0) == ((render.code == 0 || waits) && !blank)) return {};
    return file + ": check " + std::to_string(check.code) + ", render " + std::to_string(render.code) + "\n" + check.err + check.out +
           render.err;
}

/// A word left out, written twice or exchanged for another one of the file; a sign exchanged; a line left out.
std::string changed(const std::string& text, std::mt19937& random) {
    std::vector<std::pair<std::size_t, std::size_t>> words; // first, length
    const auto letter = [](char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; };
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::size_t first = i;
        while (i < text.size() && letter(text[i]))
            ++i;
        if (i > first) words.emplace_back(first, i - first);
    }
    const auto any = [&](std::size_t count) { return static_cast<std::size_t>(random()) % std::max<std::size_t>(count, 1); };
    if (words.empty()) return text;
    std::string result = text;
    const auto [first, length] = words[any(words.size())];
    const auto [other, otherLength] = words[any(words.size())];
    switch (any(4)) {
    case 0: result.erase(first, length); break;
    case 1: result.insert(first, text.substr(first, length) + " "); break;
    case 2: result.replace(first, length, text.substr(other, otherLength)); break;
    default: {
        const std::size_t line = result.rfind('\n', first) + 1;
        result.erase(line, result.find('\n', first) - line);
    }
    }
    return result;
}

class CheckAndRender : public testing::TestWithParam<int> {};

TEST_P(CheckAndRender, say_the_same_of_every_effect) {
    const std::vector<fs::path> files = effects();
    ASSERT_GT(files.size(), 150U);
    for (std::size_t i = static_cast<std::size_t>(GetParam()); i < files.size(); i += kShards)
        EXPECT_EQ(difference(files[i].string()), "");
}

TEST_P(CheckAndRender, say_the_same_of_effects_changed_at_random) {
    const std::vector<fs::path> files = effects();
    for (int i = GetParam(); i < kChanged; i += kShards) {
        std::mt19937 random(kSeed + static_cast<unsigned>(i));
        const fs::path& file = files[random() % files.size()];
        const auto text = readFile(file);
        ASSERT_TRUE(text);
        const fs::path folder = fs::path(write("inc/none.txt", "")).parent_path().parent_path();
        fs::copy("tests/adopt/effects/inc", folder / "inc", fs::copy_options::recursive | fs::copy_options::overwrite_existing);
        EXPECT_EQ(difference(write("changed.fx", changed(*text, random))), "") << file << ", change " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Shard, CheckAndRender, testing::Range(0, kShards));

} // namespace
} // namespace tegument::test
