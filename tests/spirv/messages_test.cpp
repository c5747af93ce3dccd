#include "host/spirv/messages.h"

#include <gtest/gtest.h>

namespace tegument::test {
namespace {

constexpr std::string_view kCode = "#line 1 \"a b/skin.fx\"\nfirst\nsecond line\n#line 7 \"other.fxh\"\nseventh here\n";

TEST(SourceLine, follows_line_directives) {
    EXPECT_EQ(sourceLine(kCode, "a b/skin.fx", 2), "second line");
    EXPECT_EQ(sourceLine(kCode, "other.fxh", 7), "seventh here");
    EXPECT_EQ(sourceLine(kCode, "other.fxh", 2), "");
    EXPECT_EQ(sourceLine(kCode, "nowhere.fx", 1), "");
}

TEST(DxcMessages, an_error_has_file_line_column_and_the_source_line) {
    const Messages messages =
        readDxcMessages("a b/skin.fx:2:8: error: use of undeclared identifier 'line'\nsecond line\n       ^\n", kCode, "skin.fx");
    ASSERT_EQ(messages.errors.size(), 1U);
    EXPECT_EQ(format(messages.errors[0]),
              "a b/skin.fx(2,8): error TG3001: use of undeclared identifier 'line'\n    second line\n           ^");
    EXPECT_TRUE(messages.warnings.empty());
}

TEST(DxcMessages, the_warning_that_default_values_are_ignored_is_left_out) {
    const Messages messages = readDxcMessages("s.fx:3:7: warning: variable 'gWorld' will be placed in $Globals so initializer ignored\n"
                                              "s.fx:4:9: warning: implicit truncation of vector type\n",
                                              kCode, "s.fx");
    ASSERT_EQ(messages.warnings.size(), 1U);
    EXPECT_EQ(messages.warnings[0].text, "implicit truncation of vector type");
    EXPECT_EQ(messages.warnings[0].code, 3007);
}

TEST(DxcMessages, an_error_without_place_is_one_of_the_file) {
    const Messages messages = readDxcMessages("fatal error: failed to optimize SPIR-V: something\n", kCode, "skin.fx");
    ASSERT_EQ(messages.errors.size(), 1U);
    EXPECT_EQ(format(messages.errors[0]), "skin.fx: error TG3001: failed to optimize SPIR-V: something");
}

TEST(GlslangMessages, the_token_gives_the_column) {
    const Messages messages = readGlslangMessages(
        "ERROR: a b/skin.fx:2: 'line' : unknown variable \nERROR: 1 compilation errors.  No code generated.\n", kCode, "skin.fx");
    ASSERT_EQ(messages.errors.size(), 1U);
    EXPECT_EQ(format(messages.errors[0]), "a b/skin.fx(2,8): error TG3001: unknown variable 'line'\n    second line\n           ^");
}

TEST(GlslangMessages, a_token_that_is_part_of_a_word_is_not_meant) {
    const Messages messages = readGlslangMessages("ERROR: x.fx:1: 'n' : bad\n", "#line 1 \"x.fx\"\n  min(n)\n", "x.fx");
    ASSERT_EQ(messages.errors.size(), 1U);
    EXPECT_EQ(messages.errors[0].at.column, 7);
}

TEST(Shortened, repeated_messages_are_shown_once) {
    const Diagnostic one{
        .code = 3001, .at = {.file = "x.fx", .line = 1, .column = 2, .byte = {}}, .text = "same", .hint = {}, .sourceLine = {}};
    EXPECT_EQ(shortened({one, one, one}).size(), 1U);
}

TEST(Shortened, the_rest_is_counted) {
    std::vector<Diagnostic> many;
    for (int i = 1; i <= 50; ++i)
        many.push_back(
            {.code = 3001, .at = {.file = "x.fx", .line = i, .column = 1, .byte = {}}, .text = "bad", .hint = {}, .sourceLine = {}});
    const auto shown = shortened(many);
    ASSERT_EQ(shown.size(), kShownMessages + 1);
    EXPECT_EQ(shown.back().text, "and 30 more");
    EXPECT_EQ(shown.back().severity, Severity::Note);
}

} // namespace
} // namespace tegument::test
