// What stands beside the picture, without a window: errors as colours, text with its errors, times of a replay.

#include "tools/view/beside.h"
#include "tools/view/probe.h"
#include "tools/view/reactions.h"
#include "tools/view/source_text.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <random>

namespace tegument::view {

namespace {

namespace fs = std::filesystem;

Image grey(const std::vector<float>& values) {
    Image image{.width = static_cast<int>(values.size()), .height = 1, .channels = 4};
    for (const float value : values)
        image.pixels.insert(image.pixels.end(), {value, value, value, 1});
    return image;
}

struct SourceFolder {
    SourceFolder() : path(fs::temp_directory_path() / ("tegument-source-" + std::to_string(std::random_device{}()))) {
        fs::create_directories(path);
    }
    ~SourceFolder() { fs::remove_all(path); }
    fs::path path;

    fs::path write(const std::string& name, const std::string& text) const {
        std::ofstream(path / name, std::ios::binary) << text;
        return path / name;
    }
};

std::string textOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

Reaction reaction(const char* kind, double milliseconds) {
    return {.kind = kind, .milliseconds = milliseconds};
}

} // namespace

TEST(BesideView, colours_go_from_black_at_a_thousandth_of_the_mean_to_red_at_all_of_it) {
    const Image reference = grey({1, 1, 1, 1}); // its mean is 1
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Image colours = falseColours(grey({1, 1.001F, 2, nan}), reference);
    for (const int x : {0, 1})
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(colours.at(x, 0, c), 0, 0.01) << x; // 1.001 is no float: 1e-3 by 1e-4 of it
    EXPECT_GT(colours.at(2, 0, 0), 0.9F);
    EXPECT_LT(colours.at(2, 0, 2), 0.1F);
    EXPECT_EQ(colours.at(3, 0, 0), 1);
    EXPECT_EQ(colours.at(3, 0, 1), 0);
    EXPECT_EQ(colours.at(3, 0, 2), 1);
}

TEST(BesideView, what_a_display_shows_of_light_is_what_its_saved_bytes_hold) {
    const Image radiance = grey({0, 0.2F, 0.7F, 3});
    Image stored = displayed(radiance);
    stored.bitsPerChannel = 8;
    const Image light = displayLight(radiance);
    for (int x = 0; x < 3; ++x) // below the knee of the tone map light stays as it is
        EXPECT_NEAR(light.at(x, 0, 0), radiance.at(x, 0, 0), 1e-4);
    EXPECT_LT(light.at(3, 0, 0), 1.0001F);
    EXPECT_EQ(lightOf(stored).pixels, light.pixels);
}

TEST(BesideView, the_line_of_the_error_tells_where_it_is_largest_or_why_there_is_none) {
    EXPECT_NE(errorLine(compareImages(grey({1, 1, 1.5F}), grey({1, 1, 1}))).find("largest 0.5 at (2, 0)"), std::string::npos);
    EXPECT_EQ(errorLine(compareImages(grey({1, 2}), grey({1, 2}))), "no difference");
    const Result<Difference> none = compareImages(grey({1, 1}), grey({1}));
    ASSERT_FALSE(none);
    EXPECT_EQ(errorLine(none), none.error().diagnostics.front().text);
}

TEST(BesideView, values_under_the_cursor_are_those_of_both_sides_and_their_difference) {
    const auto at = [](std::vector<float> values, double x) { return probedTexel("", grey(std::move(values)), {x, 0.5}); };
    const auto lines = besideLines(at({0, 3}, 0.75), at({0, 2}, 0.75));
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_NE(lines[0].find(" 2 "), std::string::npos) << lines[0];
    EXPECT_NE(lines[1].find(" 1 "), std::string::npos) << lines[1];
    EXPECT_NE(lines[2].find("50.00%"), std::string::npos) << lines[2];
    EXPECT_EQ(besideLines(at({0, 3}, 0.25), at({0, 2}, 0.25))[2].find('%'), std::string::npos) << "nothing is no share of 0";
}

TEST(SourceView, an_error_opens_its_file_and_marks_its_lines_unless_there_are_edits) {
    const SourceFolder folder;
    const fs::path effect = folder.write("a.fx", "one\n");
    const fs::path include = folder.write("b.fxh", "one\ntwo\n");
    const Error error = inputError(3001, {.file = include.string(), .line = 2, .column = 1}, "no");
    SourceText source;
    openSource(source, effect);
    source.text += "edited";
    markSource(source, error);
    EXPECT_EQ(source.file, effect);
    EXPECT_TRUE(source.marks.empty());
    source.text = source.saved;
    markSource(source, error);
    EXPECT_EQ(source.file, include);
    ASSERT_EQ(source.marks.size(), 1U);
    EXPECT_EQ(source.marks.front().line, 2);
    EXPECT_EQ(source.goTo, 2);
}

TEST(SourceView, a_changed_file_is_read_again_but_edits_are_kept_and_written) {
    const SourceFolder folder;
    const fs::path file = folder.write("a.fx", "one");
    SourceText source;
    openSource(source, file);
    folder.write("a.fx", "two");
    refreshSource(source);
    EXPECT_EQ(source.text, "two");
    source.text = "mine";
    folder.write("a.fx", "three");
    refreshSource(source);
    EXPECT_EQ(source.text, "mine");
    EXPECT_FALSE(source.problem.empty());
    writeSource(source);
    EXPECT_EQ(textOf(file), "mine");
    EXPECT_FALSE(source.edited());
}

TEST(Reactions, a_row_has_the_value_that_95_of_100_do_not_exceed) {
    std::vector<Reaction> reactions = {reaction("other", 7)};
    for (int i = 100; i >= 1; --i)
        reactions.push_back(reaction("drag", i));
    const auto rows = reactionRows(reactions);
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].kind, "other");
    EXPECT_EQ(rows[0].p95, 7);
    EXPECT_EQ(rows[1].count, 100U);
    EXPECT_EQ(rows[1].median, 50);
    EXPECT_EQ(rows[1].p95, 95);
    EXPECT_EQ(rows[1].most, 100);
}

} // namespace tegument::view
