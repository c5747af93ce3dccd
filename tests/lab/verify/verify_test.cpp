// Every module within its limits, in every setting; and the limits find an error when there is one.
// Lights other than one that stands far away with its pyramid fitted to the mesh: parallel, with a map smaller than the mesh, near by.

#include "lab/verify/scene.h"
#include "tests/lab/verify/fixture.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <set>
#include <string>
#include <string_view>

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

struct LightCase {
    const char* name;
    std::function<void(Light&)> change;
};

/// The body is 40 x 80 mm, its bounding sphere 45 mm wide about the origin; the usual light stands at (-330, 280, 420).
const std::vector<LightCase>& lights() {
    static const std::vector<LightCase> kLights = {{"parallel", [](Light& light) { light.direction = glm::vec3(330, -280, -420); }},
                                                   {"parallel_narrow",
                                                    [](Light& light) {
                                                        light.direction = glm::vec3(330, -280, -420);
                                                        light.width = 36.0F;
                                                    }},
                                                   {"narrow", [](Light& light) { light.fov = 4.0F; }},
                                                   {"wide",
                                                    [](Light& light) {
                                                        light.position = {-20, 16, 46};
                                                    }}, // opens by 110 degrees: most of it is far off its axis
                                                   {"inside", [](Light& light) {
                                                        light.position = {-12, 10, 28};
                                                    }}};
    return kLights;
}

struct LitModule {
    const LightCase* light;
    const char* module;
    const char* setting;
};

void PrintTo(const LitModule& c, std::ostream* out) {
    *out << c.light->name << ", " << c.module << ", " << c.setting;
}

std::vector<LitModule> litModules() {
    std::vector<LitModule> all;
    for (const LightCase& light : lights())
        for (const char* module : {"TSM", "ShadowMap", "Specular", "Irradiance"})
            all.push_back({&light, module, "corrected"});
    for (const char* module : {"TSM", "ShadowMap"}) // maps of z/w
        all.push_back({&lights().front(), module, "seed"});
    return all;
}

class Lights : public Verify, public testing::WithParamInterface<LitModule> {};

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

TEST_P(Lights, are_what_the_reference_says) {
    const LitModule& c = GetParam();
    verify::Scene scene = verify::sceneOf({});
    c.light->change(scene.workspace.light);
    constexpr int kSize = 192;
    expectPass(verifyModule(*device_, c.module,
                            {.setting = c.setting,
                             .compiler = defaultCompiler(),
                             .mapSize = kSize,
                             .pictureSize = kSize,
                             .mesh = &scene.mesh,
                             .workspace = &scene.workspace}));
}

INSTANTIATE_TEST_SUITE_P(All, Lights, testing::ValuesIn(litModules()), [](const auto& each) {
    return std::string(each.param.light->name) + "_" + each.param.module + "_" + each.param.setting;
});
