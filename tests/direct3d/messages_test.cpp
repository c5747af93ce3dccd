#include "tools/direct3d/microsoft_messages.h"

#include <gtest/gtest.h>

namespace tegument::test {
namespace {

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

TEST(MicrosoftMessages, a_place_before_the_file_s_first_line_is_none) {
    const Messages messages = readMicrosoftMessages("x.fx(-639,-2): error X3000: syntax error\n", "x.fx");
    ASSERT_EQ(messages.errors.size(), 1U);
    EXPECT_EQ(messages.errors[0].at.line, 0);
    EXPECT_EQ(messages.errors[0].at.column, 0);
}

TEST(MicrosoftMessages, the_warning_that_comes_with_every_effect_is_left_out) {
    const Messages messages = readMicrosoftMessages(
        "warning X4717: Effects deprecated for D3DCompiler_47\nx.fx(2,3): warning X3206: implicit truncation\n", "x.fx");
    EXPECT_TRUE(messages.errors.empty());
    ASSERT_EQ(messages.warnings.size(), 1U);
    EXPECT_EQ(messages.warnings[0].code, 3102);
    EXPECT_EQ(messages.warnings[0].text, "X3206: implicit truncation");
}

TEST(MicrosoftMessages, memory_that_compute_shaders_share_is_no_matter_for_the_others_of_their_file) {
    const Messages messages =
        readMicrosoftMessages("x.fx(66,20-28): warning X3579: vs_5_0 does not support groupshared, groupshared ignored\n", "x.fx");
    EXPECT_TRUE(messages.errors.empty() && messages.warnings.empty());
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

} // namespace
} // namespace tegument::test
