#include "host/compile/messages.h"
#include "host/compile/microsoft_messages.h"

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

TEST(MicrosoftMessages, an_error_names_the_unix_path_as_the_user_wrote_it) {
    const Messages messages = readMicrosoftMessages("Z:" + windowsPath(std::filesystem::absolute("effects/none.fx")).substr(2) +
                                                        "(3,10-22): error X1507: failed to open source file: 'm.fxh'\n",
                                                    "effects/none.fx");
    ASSERT_EQ(messages.errors.size(), 1U);
    EXPECT_EQ(format(messages.errors[0]), "effects/none.fx(3,10): error TG3101: X1507: failed to open source file: 'm.fxh'");
}

TEST(MicrosoftMessages, an_included_file_is_named_beside_the_source) {
    const Messages messages = readMicrosoftMessages("passes/none.fxh(1,21): error X3014: wrong\n", "effects/none.fx");
    ASSERT_EQ(messages.errors.size(), 1U);
    EXPECT_EQ(messages.errors[0].at.file, "effects/passes/none.fxh");
    EXPECT_EQ(messages.errors[0].at.line, 1);
    EXPECT_EQ(messages.errors[0].at.column, 21);
}

TEST(MicrosoftMessages, the_warning_that_comes_with_every_effect_is_left_out) {
    const Messages messages = readMicrosoftMessages(
        "warning X4717: Effects deprecated for D3DCompiler_47\nx.fx(2,3): warning X3206: implicit truncation\n", "x.fx");
    EXPECT_TRUE(messages.errors.empty());
    ASSERT_EQ(messages.warnings.size(), 1U);
    EXPECT_EQ(messages.warnings[0].code, 3102);
    EXPECT_EQ(messages.warnings[0].text, "X3206: implicit truncation");
}

TEST(MicrosoftMessages, an_error_without_place_is_one_of_the_file) {
    const Messages messages = readMicrosoftMessages("error X3501: 'NOPE': entrypoint not found\n", "x.fx");
    ASSERT_EQ(messages.errors.size(), 1U);
    EXPECT_EQ(format(messages.errors[0]), "x.fx: error TG3101: X3501: 'NOPE': entrypoint not found");
}

TEST(MicrosoftMessages, a_technique11_in_fx_2_0_gets_a_hint) {
    const Messages messages = readMicrosoftMessages("ID3DXEffectCompiler: There was an error initializing the compiler\n", "x.fx");
    ASSERT_EQ(messages.errors.size(), 1U);
    EXPECT_NE(messages.errors[0].hint.find("technique11"), std::string::npos);
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
