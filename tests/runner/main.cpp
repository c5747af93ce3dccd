// main of every GoogleTest program of the tree. Its exit code tells ctest what happened, where GoogleTest's own says 0 of skipped cases, of
// no case at all, and calls cases skipped whose common set-up failed:
//   0    cases passed, none failed
//   1    a case or a set-up failed, or no case ran
//   77   all that ran were skipped (ctest: SKIP_RETURN_CODE)
// A crash or a sanitizer's finding at exit has yet another code: a failure. The lines [cases] and [skipped] are for tests/tools/results.py.

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace {

constexpr int kSkipped = 77;

std::string onOneLine(std::string text) {
    for (char& character : text)
        if (character == '\n' || character == '\r') character = ' ';
    return text;
}

std::string reasonOf(const testing::TestResult& result) {
    for (int i = 0; i < result.total_part_count(); ++i)
        if (const testing::TestPartResult& part = result.GetTestPartResult(i); part.skipped() && *part.message() != 0)
            return onOneLine(part.message());
    return "no reason given";
}

struct Counts {
    int passed = 0;
    int failed = 0;
    int skipped = 0;
};

/// Cases whose common set-up failed have failed; GoogleTest calls them skipped.
void count(const testing::UnitTest& all, const testing::TestSuite& suite, const testing::TestInfo& test, Counts& counts) {
    if (test.result()->Failed() || suite.ad_hoc_test_result().Failed() || all.ad_hoc_test_result().Failed()) {
        ++counts.failed;
    } else if (test.result()->Skipped()) {
        ++counts.skipped;
        std::printf("[skipped] %s.%s: %s\n", suite.name(), test.name(), reasonOf(*test.result()).c_str());
    } else {
        ++counts.passed;
    }
}

int verdict(const testing::UnitTest& all, bool failed) {
    Counts counts;
    for (int s = 0; s < all.total_test_suite_count(); ++s) {
        const testing::TestSuite& suite = *all.GetTestSuite(s);
        for (int t = 0; t < suite.total_test_count(); ++t)
            if (suite.GetTestInfo(t)->should_run()) count(all, suite, *suite.GetTestInfo(t), counts);
    }
    std::printf("[cases] %d passed, %d failed, %d skipped\n", counts.passed, counts.failed, counts.skipped);
    if (failed || counts.failed > 0) return 1;
    if (counts.passed > 0) return 0;
    if (counts.skipped > 0) return kSkipped;
    std::printf("no case ran: --gtest_filter=%s\n", GTEST_FLAG_GET(filter).c_str());
    return 1;
}

} // namespace

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    const bool failed = RUN_ALL_TESTS() != 0;
    if (GTEST_FLAG_GET(list_tests)) return failed ? 1 : 0;
    return verdict(*testing::UnitTest::GetInstance(), failed);
}
