// Every module within its limits, in every setting; and the limits find an error when there is one.

#include "tests/verify/fixture.h"

#include <cstdlib>
#include <iostream>
#include <set>

using namespace tegument;
using namespace tegument::test;

namespace {

struct Case {
    std::string module;
    std::string setting;
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.module << ", " << c.setting;
}

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const std::string& module : verifiableModules())
        for (const char* setting : {"seed", "deon2007", "corrected"}) {
            // These know two cases only: as printed, and corrected.
            static const std::set<std::string> kTwo = {"OriginalTexture", "Beckmann", "EnergyAttenuation", "Stretch", "TSM"};
            if (std::string(setting) != "deon2007" || !kTwo.contains(module)) all.push_back({module, setting});
        }
    return all;
}

class Modules : public Verify, public testing::WithParamInterface<Case> {};

} // namespace

TEST_P(Modules, draws_what_the_reference_says) {
    const auto report = verifyModule(*device_, GetParam().module,
                                     {.setting = GetParam().setting, .compiler = defaultCompiler(), .mapSize = 128, .pictureSize = 128});
    expectPass(report);
    if (!report || !std::getenv("TEGUMENT_VERBOSE")) return;
    for (const Metric& metric : report->metrics)
        std::cout << (metric.pass ? "  pass " : "  FAIL ") << metric.name << " = " << metric.value << " (limit " << metric.limit << ")\n";
    for (const std::string& note : report->notes)
        std::cout << "  note: " << note << "\n";
}

INSTANTIATE_TEST_SUITE_P(All, Modules, testing::ValuesIn(cases()),
                         [](const auto& each) { return each.param.module + "_" + each.param.setting; });

TEST_F(Verify, an_unknown_module_is_refused_with_the_nearest_name) {
    const auto report = verifyModule(*device_, "Bekmann");
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().diagnostics.front().code, 4050);
    EXPECT_NE(report.error().diagnostics.front().hint.find("Beckmann"), std::string::npos);
}

TEST_F(Verify, an_unknown_setting_is_refused) {
    const auto report = verifyModule(*device_, "Beckmann", {.setting = "sede"});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().diagnostics.front().code, 4051);
}
