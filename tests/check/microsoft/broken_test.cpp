#include "tests/check/broken.h"

namespace tegument::test {
namespace {

TEST(BrokenEffects, are_blamed_on_the_right_line_for_every_target_of_microsoft_s_compiler) {
    if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) GTEST_SKIP() << missing;
    const CheckReport report = checkEffects(brokenEffects(), {kAllTargets.begin(), kAllTargets.end()});
    for (const FileReport& file : report.files)
        expectBlame(file);
}

} // namespace
} // namespace tegument::test
