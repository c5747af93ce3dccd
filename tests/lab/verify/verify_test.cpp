// Every module within its limits, in every setting; and the limits find an error when there is one.

#include "tests/lab/verify/fixture.h"

#include <cstdlib>
#include <iostream>
#include <set>

using namespace tegument;
using namespace tegument::test;

namespace {

struct Case {
    std::string module;
    std::string setting;
    int size = 128;
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.module << ", " << c.setting << ", " << c.size;
}

/// In seconds: setting corrected, and the printed forms where they are cheap.
std::vector<Case> quick() {
    static const std::set<std::string> kDear = {"EnergyAttenuation", "Main", "OriginalTexture", "Beckmann", "Stretch", "TSM", "Pyramid"};
    std::vector<Case> all;
    for (const std::string& module : verifiableModules()) {
        all.push_back({module, "corrected"});
        if (!kDear.contains(module)) all.push_back({module, "seed"});
    }
    return all;
}

std::vector<Case> full() {
    std::vector<Case> all;
    for (const std::string& module : verifiableModules())
        for (const char* setting : {"seed", "deon2007", "corrected"})
            all.push_back({module, setting, 256});
    return all;
}

const auto kModuleName = [](const auto& each) { return each.param.module + "_" + each.param.setting; };

class Modules : public Verify, public testing::WithParamInterface<Case> {};

} // namespace

TEST_P(Modules, draw_what_the_reference_says) {
    const Case& c = GetParam();
    const auto report =
        verifyModule(*device_, c.module, {.setting = c.setting, .compiler = defaultCompiler(), .mapSize = c.size, .pictureSize = c.size});
    expectPass(report);
    if (!report || !std::getenv("TEGUMENT_VERBOSE")) return;
    for (const Metric& metric : report->metrics)
        std::cout << (metric.pass ? "  pass " : "  FAIL ") << metric.name << " = " << metric.value << " (limit " << metric.limit << ")\n";
    for (const std::string& note : report->notes)
        std::cout << "  note: " << note << "\n";
}

INSTANTIATE_TEST_SUITE_P(Quick, Modules, testing::ValuesIn(quick()), kModuleName);
INSTANTIATE_TEST_SUITE_P(Full, Modules, testing::ValuesIn(full()), kModuleName);

TEST_F(Verify, an_unknown_module_is_refused_with_the_nearest_name) {
    const auto report = verifyModule(*device_, "Bekmann");
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().diagnostics.front().code, 4050);
    EXPECT_NE(report.error().diagnostics.front().hint.find("Beckmann"), std::string::npos);
}

TEST_F(Verify, a_setting_among_the_modules_is_sent_to_its_option) {
    const auto report = verifyModule(*device_, "corrected");
    ASSERT_FALSE(report);
    EXPECT_NE(report.error().diagnostics.front().hint.find("--setting corrected"), std::string::npos);
}

TEST_F(Verify, an_unknown_setting_is_refused) {
    const auto report = verifyModule(*device_, "Beckmann", {.setting = "sede"});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().diagnostics.front().code, 4051);
}
