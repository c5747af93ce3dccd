// The list of what can be compared.

#include "host/support/file.h"
#include "lab/bench/catalogue.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <unistd.h>

using namespace tegument;
using namespace tegument::bench;

namespace {

namespace fs = std::filesystem;

/// What a catalogue of this text says.
Result<std::vector<Contender>> load(const std::string& text) {
    const fs::path file = fs::temp_directory_path() / ("tegument-catalogue-" + std::to_string(::getpid()) + ".json");
    EXPECT_TRUE(writeFile(file, text));
    auto list = loadCatalogue(file);
    std::error_code code;
    fs::remove(file, code);
    return list;
}

constexpr const char* kTwoByTwo = R"([{"technique": "T", "effect": "E.fx", "source": "S",
    "settings": {"paper": {"defines": {"A": "1"}}, "corrected": {"parameters": {"gX": 1}}},
    "variants": {"few": {"parameters": {"gN": 7}}, "many": {"parameters": {"gN": [25], "gX": [2, 3]}}},
    "profile": {"burley": [0.4, 0.1, 0.1]}}])";

} // namespace

TEST(Catalogue, is_settings_times_variants) {
    const auto list = load(kTwoByTwo);
    ASSERT_TRUE(list) << format(list.error());
    ASSERT_EQ(list->size(), 4);
    const Contender& last = list->back();
    EXPECT_EQ(last.name(), "T, many");
    EXPECT_EQ(last.setting, "corrected");
    EXPECT_EQ(last.parameters.at("gN"), std::vector{25.0});
    EXPECT_EQ(last.parameters.at("gX"), (std::vector{2.0, 3.0})) << "the variant wins";
    EXPECT_EQ(last.claim, Claim::Burley);
}

TEST(Catalogue, refuses_what_it_does_not_know) {
    for (const char* text :
         {"", "{}", "[1]", R"([{"technique": "T"}])", R"([{"technique": "T", "effect": "E", "source": "S", "settings": {}}])",
          R"([{"technique": "T", "effect": "E", "source": "S", "settings": {"a": {"define": {}}}}])",
          R"([{"technique": "T", "effect": "E", "source": "S", "settings": {"a": {"parameters": {"g": "x"}}}}])",
          R"([{"technique": "T", "effect": "E", "source": "S", "settings": {"a": {}}, "profile": {"burley": [0, 1, 1]}}])",
          R"([{"technique": "T", "effect": "E", "source": "S", "settings": {"a": {}}, "profil": "none"}])"}) {
        const auto list = load(text);
        ASSERT_FALSE(list) << text;
        EXPECT_EQ(list.error().diagnostics.front().code, 8070) << text;
    }
}

TEST(Catalogue, chooses_by_technique_variant_and_setting_ignoring_case) {
    const auto list = load(kTwoByTwo);
    ASSERT_TRUE(list);
    EXPECT_EQ(choose(*list, {"t"}, {})->size(), 4);
    EXPECT_EQ(choose(*list, {"T, few"}, {})->size(), 2);
    EXPECT_EQ(choose(*list, {"T, FEW"}, {"Paper"})->size(), 1);
    EXPECT_EQ(choose(*list, {}, {})->size(), 4);
}

TEST(Catalogue, says_which_name_chooses_nothing) {
    const auto list = load(kTwoByTwo);
    ASSERT_TRUE(list);
    const auto none = choose(*list, {"U"}, {});
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().diagnostics.front().code, 8071);
    EXPECT_EQ(choose(*list, {}, {"seed"}).error().diagnostics.front().code, 8071);
}

TEST(Catalogue, of_the_effects_names_files_and_techniques_that_exist) {
    const auto list = loadCatalogue("effects/catalogue.json");
    ASSERT_TRUE(list) << format(list.error());
    std::map<fs::path, std::set<std::string>> techniques;
    for (const Contender& contender : *list) {
        auto& known = techniques[contender.effect];
        if (known.empty()) {
            const auto effect = loadEffect(contender.effect, {.defines = contender.defines, .includeFolders = {}});
            ASSERT_TRUE(effect) << format(effect.error());
            for (const Technique& technique : effect->techniques)
                known.insert(technique.name);
        }
        EXPECT_TRUE(known.contains(contender.technique)) << contender.effect << " " << contender.technique;
    }
}
