// A page's text, a picture's floats in it, and two runs beside each other.

#include "tools/report/against.h"
#include "tools/report/plane.h"
#include "tools/report/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tegument::report {

namespace {

std::vector<std::string> subjectsOf(const std::vector<Change>& changes) {
    std::vector<std::string> subjects;
    for (const Change& change : changes)
        subjects.push_back(change.subject);
    return subjects;
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

} // namespace

TEST(Page, what_stands_in_its_data_cannot_end_the_script) {
    const std::string page = html({.title = "</title><b>", .summary = "</script><script>alert(1)</script>"});
    std::size_t scripts = 0;
    for (std::size_t at = page.find("</script"); at != std::string::npos; at = page.find("</script", at + 1))
        ++scripts;
    EXPECT_EQ(scripts, 2U); // the data's own and the code's
    EXPECT_EQ(page.find("alert(1)</script>"), std::string::npos);
    EXPECT_NE(page.find("<title>&lt;/title>&lt;b></title>"), std::string::npos);
}

TEST(Page, names_no_address_and_forbids_requests) {
    const std::string page = html({.title = "t"});
    EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
    for (const char* way : {"https:", "src=", "href=\"http", "@import", "url("})
        EXPECT_EQ(page.find(way), std::string::npos) << way;
}

TEST(Page, bytes_that_are_no_utf8_do_not_stop_it) {
    const std::string page = html({.title = "t", .summary = "caf\xe9"});
    EXPECT_NE(page.find("caf\xef\xbf\xbd"), std::string::npos);
}

TEST(Plane, keeps_its_size_and_scales_by_a_power_of_two) {
    const Image image{.width = 2, .height = 1, .channels = 3, .pixels = {1e6F, 0, -3, 4, 5, 1e-3F}};
    const Json json = plane(image);
    EXPECT_EQ(json["width"], 2);
    EXPECT_EQ(json["channels"], 3);
    const double scale = json["scale"];
    int exponent = 0;
    EXPECT_EQ(std::frexp(scale, &exponent), 0.5) << scale;
    EXPECT_LE(1e6 / scale, 65504) << "beyond the largest half";
    EXPECT_GT(1e6 / scale, 16384) << "small values lose bits for nothing";
}

TEST(Plane, an_empty_or_black_picture_is_fine) {
    EXPECT_EQ(plane({.width = 0, .height = 0, .channels = 3})["scale"], 1.0);
    EXPECT_EQ(plane({.width = 1, .height = 1, .channels = 1, .pixels = {0}})["scale"], 1.0);
    EXPECT_EQ(plane({.width = 1, .height = 1, .channels = 1, .pixels = {static_cast<float>(kNan)}})["scale"], 1.0);
}

TEST(Against, a_figure_is_worse_beyond_the_threshold_only) {
    const Changes changes = compareRuns({{"a", "ms", 100}, {"b", "ms", 100}, {"c", "ms", 100}, {"d", "ms", 100}},
                                        {{"a", "ms", 104.9}, {"b", "ms", 105.1}, {"c", "ms", 150}, {"d", "ms", 94}}, 0.05);
    EXPECT_EQ(subjectsOf(changes.worse), (std::vector<std::string>{"c", "b"})) << "the worst first";
    EXPECT_EQ(subjectsOf(changes.better), std::vector<std::string>{"d"});
    EXPECT_EQ(changes.compared, 4U);
    EXPECT_NEAR(changes.worse.front().share, 0.5, 1e-12);
}

TEST(Against, noise_of_both_runs_is_no_difference) {
    const auto worse = [](double noise) { return compareRuns({{"a", "ms", 10, noise}}, {{"a", "ms", 11, noise}}, 0.05).worse.size(); };
    EXPECT_EQ(worse(0.4), 1U);
    EXPECT_EQ(worse(0.6), 0U);
}

TEST(Against, what_is_no_number_any_more_is_worst_of_all) {
    const Changes changes = compareRuns({{"a", "error", 1}, {"b", "error", 1}, {"c", "error", kNan}, {"d", "error", kNan}},
                                        {{"a", "error", 9}, {"b", "error", kNan}, {"c", "error", 1}, {"d", "error", kNan}}, 0.05);
    EXPECT_EQ(subjectsOf(changes.worse), (std::vector<std::string>{"b", "a"}));
    EXPECT_EQ(subjectsOf(changes.better), std::vector<std::string>{"c"});
}

TEST(Against, a_figure_that_was_nothing_and_is_something_is_worse) {
    const Changes changes = compareRuns({{"a", "not finite", 0}}, {{"a", "not finite", 3}}, 0.05);
    ASSERT_EQ(changes.worse.size(), 1U);
    EXPECT_TRUE(std::isinf(changes.worse.front().share));
    EXPECT_TRUE(changesSection(changes, "old.json", 0.05)["rows"][0][5].is_null()) << "JSON has no infinity";
}

TEST(Against, figures_of_one_run_alone_are_named_and_not_compared) {
    const Changes changes = compareRuns({{"a", "ms", 1}, {"gone", "ms", 1}}, {{"a", "ms", 1}, {"new", "ms", 9}}, 0.05);
    EXPECT_EQ(changes.compared, 1U);
    EXPECT_TRUE(changes.worse.empty());
    const std::string note = changesSection(changes, "old.json", 0.05)["note"];
    EXPECT_NE(note.find("Only in the earlier run: gone: ms."), std::string::npos) << note;
    EXPECT_NE(note.find("Only in this run: new: ms."), std::string::npos) << note;
    EXPECT_NE(note.find("worse by more than 5 %"), std::string::npos) << note;
}

} // namespace tegument::report
