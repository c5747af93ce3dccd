#include "host/support/result.h"

#include <gtest/gtest.h>

using namespace tegument;

TEST(Diagnostics, carry_file_line_column_code_and_hint) {
    const Diagnostic diagnostic{.code = 2004,
                                .at = {.file = "effects/Main.fx", .line = 41, .column = 12, .byte = {}},
                                .text = "unknown script command 'RenderColourTarget'",
                                .hint = "did you mean 'RenderColorTarget'?",
                                .sourceLine = {}};
    EXPECT_EQ(format(diagnostic),
              "effects/Main.fx(41,12): error TG2004: unknown script command 'RenderColourTarget'; did you mean 'RenderColorTarget'?");
}

TEST(Diagnostics, put_the_caret_under_the_column_whatever_the_tab_width) {
    const Diagnostic diagnostic{.severity = Severity::Warning,
                                .code = 1,
                                .at = {.file = "a.fx", .line = 2, .column = 4, .byte = {}},
                                .text = "x",
                                .hint = {},
                                .sourceLine = "\tab cd"};
    EXPECT_EQ(format(diagnostic), "a.fx(2,4): warning TG0001: x\n    \tab cd\n    \t  ^");
}

TEST(Diagnostics, print_no_bytes_that_a_terminal_would_obey) {
    Diagnostic diagnostic{.code = 1101,
                          .at = {.file = "a.fx", .line = 1, .column = 9, .byte = {}},
                          .text = "found '\x1b[31m'",
                          .hint = "\xe4\xff \xc0\xaf",
                          .sourceLine = "fl\xc3\xb6\x07\x7f\x80 x"};
    EXPECT_EQ(format(diagnostic), "a.fx(1,9): error TG1101: found '?[31m'; ?? ??\n    fl\xc3\xb6??? x\n            ^")
        << "one question mark for each, so that the caret keeps its column; UTF-8 stays";
}

TEST(Diagnostics, name_the_byte_in_binary_files) {
    EXPECT_EQ(format(inputError(5100, {.file = "head.glb", .byte = 12}, "ends early")), "head.glb(byte 12): error TG5100: ends early");
}

TEST(Diagnostics, of_the_machine_name_the_program) {
    const Error error = machineError(6001, "no Vulkan device");
    EXPECT_EQ(format(error), "tegument: error TG6001: no Vulkan device");
    EXPECT_EQ(static_cast<int>(error.blame), 3);
}

TEST(Results, hold_either_a_value_or_an_error) {
    const Result<int> value = 7;
    const Result<int> failed = usageError(8000, "no");
    ASSERT_TRUE(value);
    EXPECT_EQ(*value, 7);
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().blame, Blame::Usage);
    EXPECT_TRUE(Result<void>());
    EXPECT_FALSE(Result<void>(usageError(8000, "no")));
}
