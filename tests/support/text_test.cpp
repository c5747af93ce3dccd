#include "host/support/text.h"

#include <gtest/gtest.h>

using namespace tegument;

TEST(Text, comparison_ignores_case_only) {
    EXPECT_TRUE(equalsIgnoreCase("ViewPortRatio", "viewportratio"));
    EXPECT_FALSE(equalsIgnoreCase("Format", "Formats"));
    EXPECT_TRUE(equalsIgnoreCase("", ""));
}

TEST(Text, trim_removes_white_space_at_both_ends) {
    EXPECT_EQ(trim(" \t a b \r\n"), "a b");
    EXPECT_EQ(trim(" \n"), "");
}

TEST(Text, nearest_name_forgives_a_third_of_the_letters) {
    const std::vector<std::string> names = {"RenderColorTarget", "RenderDepthStencilTarget", "Clear"};
    EXPECT_EQ(nearestName("RenderColourTarget", names), "RenderColorTarget");
    EXPECT_EQ(nearestName("claer", names), "Clear");
    EXPECT_EQ(nearestName("Draw", names), "");
    EXPECT_EQ(nearestName("", names), "");
}

TEST(Text, hint_is_a_question_or_nothing) {
    const std::vector<std::string> names = {"gMix"};
    EXPECT_EQ(didYouMean("gmix", names), "did you mean 'gMix'?");
    EXPECT_EQ(didYouMean("unrelated", names), "");
}

TEST(Text, words_of_a_command_line_come_back_as_they_were) {
    EXPECT_EQ(shellWord("scans/head_1.obj"), "scans/head_1.obj");
    EXPECT_EQ(shellWord("my scan (2).obj"), "'my scan (2).obj'");
    EXPECT_EQ(shellWord("it's"), "'it'\\''s'");
    EXPECT_EQ(shellWord(""), "''");
}
