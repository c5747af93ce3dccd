// The list of what can be compared.
// The front, the pick, and the command that draws what was picked.

#include "host/support/file.h"
#include "lab/bench/catalogue.h"
#include "lab/bench/choice.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <set>

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

Row row(double milliseconds, double error) {
    Row row;
    row.drawn.milliseconds.median = milliseconds;
    row.errors.relativeL2 = error;
    return row;
}

/// Fast and rough, in the middle, slow and exact; one that is beaten in both, and one that failed.
std::vector<Row> five() {
    std::vector<Row> rows = {row(4, 0.001), row(1, 0.1), row(2, 0.01), row(3, 0.05), row(0, 0)};
    rows.back().failure = inputError(4001, {}, "no such technique");
    return rows;
}

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
            const auto effect = loadEffect(contender.effect, {.defines = contender.defines});
            ASSERT_TRUE(effect) << format(effect.error());
            for (const Technique& technique : effect->techniques)
                known.insert(technique.name);
        }
        EXPECT_TRUE(known.contains(contender.technique)) << contender.effect << " " << contender.technique;
    }
}

TEST(Choice, takes_the_cheapest_within_an_error) {
    EXPECT_EQ(pick(five(), {.error = 0.05})->row, 2);
    EXPECT_EQ(pick(five(), {.error = 0.5})->row, 1);
}

TEST(Choice, takes_the_most_accurate_within_a_time) {
    EXPECT_EQ(pick(five(), {.milliseconds = 3.5})->row, 2);
    EXPECT_EQ(pick(five(), {.milliseconds = 10})->row, 0);
}

TEST(Choice, takes_nothing_where_nothing_keeps_the_limit) {
    EXPECT_FALSE(pick(five(), {.error = 1e-4}));
    EXPECT_FALSE(pick(five(), {.milliseconds = 0.5}));
}

TEST(Choice, of_rows_that_tie_is_the_most_accurate_and_names_the_others) {
    std::vector<Row> rows = five();
    rows.push_back(row(1.04, 0.09)); // 4 % slower than the fastest: no gain
    const auto close = pick(rows, {.error = 0.5});
    EXPECT_EQ(close->row, 5);
    EXPECT_EQ(close->ties, std::vector<std::size_t>{1});
    rows.back().drawn.milliseconds.median = 1.2;
    EXPECT_EQ(pick(rows, {.error = 0.5})->row, 1) << "a fifth slower, by times that do not vary";
    rows.back().drawn.milliseconds.p25 = 1.1;
    rows.back().drawn.milliseconds.p75 = 1.4;
    EXPECT_EQ(pick(rows, {.error = 0.5})->row, 5) << "within its spread";
    rows.back().drawn.milliseconds.median = 1.3;
    EXPECT_EQ(pick(rows, {.error = 0.5})->row, 1) << "more than a quarter slower";
    rows[0].drawn.milliseconds.p25 = 3;
    EXPECT_EQ(pick(rows, {.milliseconds = 3.5})->ties, std::vector<std::size_t>{0}) << "often within the time, and nearer";
}

TEST(Choice, takes_no_diffusion_where_it_is_asked_for_only_and_tells_errors_beside_it) {
    std::vector<Row> rows = five();
    EXPECT_EQ(shareOfNoDiffusion(rows, 2), std::nullopt);
    rows[1].contender.claim = Claim::Delta;
    EXPECT_EQ(pick(rows, {.error = 0.5})->row, 2);
    EXPECT_EQ(pick(rows, {.error = 0.5, .milliseconds = {}, .withoutDiffusion = true})->row, 1);
    EXPECT_NEAR(*shareOfNoDiffusion(rows, 2), 0.1, 1e-12);
    rows[2].mapSize = 512;
    EXPECT_EQ(shareOfNoDiffusion(rows, 2), std::nullopt) << "of other maps";
}

TEST(Choice, the_command_carries_everything_that_was_measured) {
    Row chosen = row(1, 0.1);
    chosen.contender = {.technique = "Gosselin",
                        .setting = "seed",
                        .effect = "effects/Main.fx",
                        .defines = {{"TEGUMENT_SETTING", "0"}, {"X", "a b"}},
                        .parameters = {{"gBlurCount", {2}}, {"gTint", {1, 0.5}}}};
    chosen.mapSize = 512;
    chosen.shadowSize = 1024;
    chosen.width = 64;
    chosen.height = 32;
    chosen.workspace = "my scene.json";
    EXPECT_EQ(renderCommand(chosen), "tegument render effects/Main.fx -t Gosselin --setting seed -D 'X=a b' -s gBlurCount=2 -s gTint=1,0.5 "
                                     "--map-size 512 --shadow-size 1024 --size 64x32 -w 'my scene.json'");
}
