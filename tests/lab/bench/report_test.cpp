// What is written for programs and for pages.

#include "lab/bench/report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

using namespace tegument;
using namespace tegument::bench;
using Json = nlohmann::json;

namespace {

Row exampleRow() {
    Row row;
    row.contender = {.technique = "Tech", .setting = "paper", .variant = "7 samples", .source = "A, B 2020", .effect = "E.fx"};
    row.scene = "sphere-5";
    row.mesh = "a \"sphere\"";
    row.width = 64;
    row.height = 32;
    row.mapSize = 256;
    row.coverage = 0.25;
    row.drawn.milliseconds = {.median = 2, .p5 = 1, .p95 = 3, .noise = 0.5};
    row.drawn.passes = {{"Blur", 1.5}};
    row.drawn.bytes = 1 << 21;
    row.drawn.targetBytes = 1 << 20;
    row.errors = {.relativeL2 = 0.01, .p99 = 0.02, .p999 = 0.03, .largestInterior = 0.04, .bias = -0.005, .psnr = 40};
    row.referenceId = "abc";
    row.referencePixels = 1024;
    return row;
}

Machine exampleMachine() {
    return {.device = "Device", .driver = "Driver 1", .compiler = "dxc", .date = "2026-01-02", .version = "0.1.0", .cpu = true};
}

} // namespace

TEST(BenchJson, has_every_key_that_the_page_names) {
    const Json list = Json::parse(toJson({exampleRow()}, exampleMachine()));
    ASSERT_EQ(list.size(), 1);
    const Json& row = list[0];
    for (const char* key : {"technique", "setting", "scene", "mesh", "resolution", "map_size", "device", "driver", "ms", "passes", "bytes",
                            "error", "reference", "coverage", "own_error", "source", "date", "version"})
        EXPECT_TRUE(row.contains(key)) << key;
    EXPECT_EQ(row["technique"], "Tech, 7 samples");
    EXPECT_EQ(row["resolution"], Json({64, 32}));
    EXPECT_EQ(row["ms"]["median"], 2);
    EXPECT_EQ(row["passes"][0]["name"], "Blur");
    for (const char* key : {"rel_l2", "p99", "p999", "max_interior", "bias", "psnr"})
        EXPECT_TRUE(row["error"][key].is_number()) << key;
    EXPECT_TRUE(row["error"]["flip"].is_null()) << "not measured";
    EXPECT_EQ(row["reference"]["id"], "abc");
}

TEST(BenchJson, of_a_row_that_failed_says_why_and_has_no_figures) {
    Row row = exampleRow();
    row.failure = machineError(6001, "out of memory");
    const Json json = Json::parse(toJson({row}, exampleMachine()))[0];
    EXPECT_NE(json["failure"].get<std::string>().find("out of memory"), std::string::npos);
    EXPECT_FALSE(json.contains("ms"));
}

TEST(BenchCsv, has_as_many_cells_in_each_line_as_names) {
    const std::string csv = toCsv({exampleRow()}, exampleMachine());
    const auto lineEnd = csv.find('\n');
    const std::string names = csv.substr(0, lineEnd);
    std::string cells = csv.substr(lineEnd + 1);
    // "Tech, 7 samples" holds a comma in quotes.
    EXPECT_EQ(std::ranges::count(names, ','), std::ranges::count(cells, ',') - 1);
    EXPECT_NE(cells.find("\"a \"\"sphere\"\"\""), std::string::npos) << "quotes are doubled (RFC 4180)";
}

TEST(BenchMarkdown, says_not_measured_where_nothing_was) {
    const auto markdown = toMarkdown(toJson({exampleRow()}, exampleMachine()), "r.json");
    ASSERT_TRUE(markdown) << format(markdown.error());
    EXPECT_NE(
        markdown->find("| Tech, 7 samples | paper | 2.000 | 1.000 | 3.000 | 1.0 | 0.0100 | 0.020 | -0.0050 | not measured | the same |"),
        std::string::npos)
        << *markdown;
    EXPECT_NE(markdown->find("sphere-5, 64 x 32, maps of 256 x 256, 25 % of the picture is skin; Device, driver Driver 1"),
              std::string::npos);
}

TEST(BenchMarkdown, of_several_scenes_ends_with_one_row_for_each_technique) {
    Row other = exampleRow();
    other.scene = "head";
    other.errors.relativeL2 = 0.25;
    const auto markdown = toMarkdown(toJson({exampleRow(), other}, exampleMachine()), "r.json");
    ASSERT_TRUE(markdown);
    EXPECT_NE(markdown->find("| technique | setting | sphere-5, 256 | head, 256 |"), std::string::npos) << *markdown;
    EXPECT_NE(markdown->find("| Tech, 7 samples | paper | 0.0100 | 0.2500 |"), std::string::npos) << *markdown;
}

TEST(BenchMarkdown, of_growth_and_of_ablation_have_their_tables) {
    const Growth growth{.quantity = "texels", .what = "blurs", .x = {1, 2}, .milliseconds = {3, 6}, .law = {.exponent = 1, .factor = 3}};
    EXPECT_NE(toMarkdown(toJson({growth}, exampleMachine()), "g.json")->find("| blurs | texels | 1, 2 | 3.000, 6.000 | 1.00 |"),
              std::string::npos);
    const AblationRow row{.group = "culling", .what = "none", .milliseconds = 2, .noise = 0.1, .change = 0, .relativeL2 = 0.5};
    EXPECT_NE(toMarkdown(toJson({row}, exampleMachine(), "head"), "a.json")->find("| culling | none | 2.000 | +0.000 | 0.100 | 0.5000 |"),
              std::string::npos);
}

TEST(BenchMarkdown, refuses_what_is_no_result) {
    for (const char* text : {"", "{}", "[{}]", R"([{"technique": "T", "resolution": [1]}])", R"({"machine": {}, "series": [1]})"}) {
        const auto markdown = toMarkdown(text, "x.json");
        ASSERT_FALSE(markdown) << text;
        EXPECT_EQ(markdown.error().diagnostics.front().code, 8076) << text;
    }
}

TEST(BenchMarkdown, has_a_table_of_motion) {
    const MotionRow row{
        .motion = "zoom", .contender = exampleRow().contender, .error = 0.01, .flicker = 0.02, .largest = 0.03, .light = 0.05};
    const auto markdown = toMarkdown(toJson(std::vector{row}, exampleMachine(), "head"), "motion.json");
    ASSERT_TRUE(markdown);
    EXPECT_NE(markdown->find("| zoom | Tech, 7 samples | paper | 0.0100 | 0.0200 | 0.0300 | 0.0500 |"), std::string::npos) << *markdown;
}

TEST(BenchJson, counts_are_sums_and_passes_or_nothing) {
    Row row = exampleRow();
    EXPECT_TRUE(Json::parse(toJson({row}, exampleMachine()))[0]["counts"].is_null());
    row.drawn.traffic = {{.pass = "A", .calls = 1, .fetches = 20, .read = 300, .written = 4000},
                         {.pass = "B", .calls = 5, .fetches = 60, .read = 700, .written = 8000}};
    const Json counts = Json::parse(toJson({row}, exampleMachine()))[0]["counts"];
    EXPECT_EQ(counts["calls"], 6);
    EXPECT_EQ(counts["fetches"], 80);
    EXPECT_EQ(counts["bytes_read"], 1000);
    EXPECT_EQ(counts["bytes_written"], 12000);
    EXPECT_EQ(counts["passes"][1]["name"], "B");
    EXPECT_EQ(counts["passes"][1]["bytes_written"], 8000);
}
