// tegument verify as a user runs it.

#include "tests/cli/program.h"

#include <gtest/gtest.h>

namespace tegument::test {

TEST(VerifyProgram, a_folder_without_effects_is_refused) {
    const Ran ran = tegument({"verify", "--effects", (scratch() / "other").string()});
    EXPECT_EQ(ran.code, 1) << ran.err;
    EXPECT_NE(ran.err.find("error TG8060"), std::string::npos) << ran.err;
}

} // namespace tegument::test
