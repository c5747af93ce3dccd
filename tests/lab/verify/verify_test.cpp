// Every module within its limits, in every setting; and the limits find an error when there is one.
// The errata as measured have the sizes that docs/design/skin.md and docs/design/skin-error.md state.
// Lights other than one that stands far away with its pyramid fitted to the mesh: parallel, with a map smaller than the mesh, near by.

#include "lab/verify/errata.h"
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

class ErrataMeasured : public Verify {
protected:
    /// Measured once for all tests.
    static const Errata& errata(gpu::Device& device) {
        static const Result<Errata> kMeasured = measureErrata(device, {.compiler = defaultCompiler()});
        EXPECT_TRUE(kMeasured) << format(kMeasured.error());
        return *kMeasured;
    }

    static const Erratum& find(const Errata& errata, std::string_view finding, std::string_view quantity) {
        const auto found = std::ranges::find_if(errata.list, [&](const Erratum& e) {
            return e.finding.find(finding) != std::string::npos && e.quantity.find(quantity) != std::string::npos;
        });
        if (found == errata.list.end()) throw std::runtime_error("no erratum " + std::string(finding) + ", " + std::string(quantity));
        return *found;
    }

    static const EdgeRow& row(const Errata& errata, std::string_view name, double texel) {
        const auto found = std::ranges::find_if(
            errata.edges, [&](const EdgeRow& r) { return r.name.starts_with(name) && std::abs(r.texel - texel) < 1e-9; });
        if (found == errata.edges.end()) throw std::runtime_error("no row " + std::string(name));
        return *found;
    }
};

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

TEST_F(ErrataMeasured, the_corrected_form_is_never_further_from_the_truth_than_the_printed_one) {
    for (const Erratum& e : errata(*device_).list)
        EXPECT_LE(std::abs(e.correctedError()), std::abs(e.printedError())) << e.finding << ", " << e.quantity;
}

TEST_F(ErrataMeasured, the_printed_exponent_halves_red_light_behind_two_millimetres) {
    const Erratum& e = find(errata(*device_), "Transmission exponent", "2 mm");
    EXPECT_NEAR(e.printed, 0.094, 5e-4);
    EXPECT_NEAR(e.truth, 0.194, 5e-4);
}

TEST_F(ErrataMeasured, ten_passes_of_the_printed_kernel_gain_one_per_cent) {
    const Erratum& e = find(errata(*device_), "Kernel sums", "ten passes");
    EXPECT_NEAR(e.printed, std::pow(1.001, 10), 1e-5); // float targets
    EXPECT_NEAR(e.corrected, 1, 1e-5);
}

TEST_F(ErrataMeasured, the_seed_s_widest_gaussian_is_wider_by_a_sixth_and_more) {
    const Erratum& e = find(errata(*device_), "own sigma", "Gaussian 6");
    // sqrt of the sum of v_2 .. v_6 is 3.19 mm; the kernel's own variance makes it sqrt(1.0789) times that.
    EXPECT_NEAR(e.printed, 3.19 * std::sqrt(1.0789), 0.02);
    EXPECT_NEAR(e.corrected, e.truth, 0.003);
}

TEST_F(ErrataMeasured, what_is_drawn_in_setting_corrected_is_row_b_of_the_study) {
    for (double texel : {0.15, 0.30}) {
        const EdgeRow& drawn = row(errata(*device_), "drawn, setting corrected", texel);
        const EdgeRow& study = row(errata(*device_), "B:", texel);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(drawn.largest[c], study.largest[c], 5e-4) << texel << " mm, channel " << c; // 32-bit floats
            EXPECT_NEAR(drawn.rms[c], study.rms[c], 2e-4) << texel << " mm, channel " << c;
        }
    }
}

TEST_F(ErrataMeasured, halving_the_texel_helps_more_than_correcting_the_kernel) {
    const EdgeRow& coarse = row(errata(*device_), "drawn, setting deon2007", 0.30);
    const EdgeRow& corrected = row(errata(*device_), "drawn, setting corrected", 0.30);
    const EdgeRow& fine = row(errata(*device_), "drawn, setting deon2007", 0.15);
    for (int c = 0; c < 3; ++c) {
        EXPECT_LT(fine.largest[c], 0.5 * coarse.largest[c]);
        EXPECT_GT(corrected.largest[c], 0.8 * coarse.largest[c]);
    }
}

TEST_F(ErrataMeasured, the_tables_name_every_finding) {
    const std::string text = errataMarkdown(errata(*device_));
    for (const Erratum& e : errata(*device_).list)
        EXPECT_NE(text.find(e.finding), std::string::npos);
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
