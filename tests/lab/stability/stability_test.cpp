// The stability report: what it must find, and that the effects keep its limits on their hard cases.

#include "host/support/file.h"
#include "lab/stability/stability.h"
#include "tests/gpu/with_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <unistd.h>

using namespace tegument;
using namespace tegument::bench;

namespace {

class Stability : public test::WithDevice {
protected:
    /// Tests that look at the same report from different sides share it.
    const StabilityReport& roughness() {
        static const StabilityReport report = measure({"roughness"}, {"Specular"});
        return report;
    }
    const StabilityReport& shadow() {
        static const StabilityReport report = measure({"shadow"}, {"ShadowMap"}, 128);
        return report;
    }

    StabilityReport measure(std::vector<std::string> parts, std::vector<std::string> modules, int size = 64) {
        const auto report = measureStability(
            *device_, {.compiler = defaultCompiler(), .size = size, .parts = std::move(parts), .modules = std::move(modules)});
        EXPECT_TRUE(report) << format(report.error());
        return report ? *report : StabilityReport{};
    }
};

void expectPass(const StabilityReport& report) {
    EXPECT_FALSE(report.rows.empty());
    for (const StabilityRow& row : report.rows)
        EXPECT_TRUE(row.pass()) << row.module << ", " << row.hardCase << ": " << row.figure << " = " << row.value << ", limit "
                                << row.limit.value_or(0) << ", " << row.notFinite << " not finite, caused by " << row.cause;
}

/// Of one module, in order.
std::vector<double> values(const StabilityReport& report, const std::string& module, const std::string& figure) {
    std::vector<double> found;
    for (const StabilityRow& row : report.rows)
        if (row.module == module && row.figure == figure) found.push_back(row.value);
    return found;
}

/// An effect of one full-screen pass that writes this expression of uv, in a folder of its own.
class EffectFolder {
public:
    explicit EffectFolder(const std::string& expression)
        : folder_(std::filesystem::temp_directory_path() / ("tegument-stability-" + std::to_string(::getpid()))) {
        // A copy: an effect reads no file outside of its project.
        std::filesystem::create_directories(folder_ / "effects");
        std::filesystem::copy("hlsl", folder_ / "hlsl", std::filesystem::copy_options::recursive);
        std::filesystem::copy("effects/passes", folder_ / "effects/passes", std::filesystem::copy_options::recursive);
        const std::string text = std::string(R"(#include "hlsl/platform.fxh"
#include "hlsl/workspace.fxh"
#include "effects/passes/quad.fxh"

float gZero = 0.0;
float3 gPadding = { 0.0, 0.0, 0.0 };
float4 BadPS(TgQuadVarying input) : SV_Target0 { return float4()") +
                                 expression + R"(, gPadding.x, 0.0, 1.0); }
#ifdef FX_TECHNIQUES
technique Bad < string Script = "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Bad;"; >
{
    TG_QUAD_PASS(Bad, TgQuadVS, BadPS, TG_STATE_BUFFER)
}
#endif
)";
        const auto written = writeFile(folder_ / "Bad.fx", text);
        EXPECT_TRUE(written) << format(written.error());
    }
    ~EffectFolder() { std::filesystem::remove_all(folder_); }

    [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

private:
    std::filesystem::path folder_;
};

StabilityRow row(double value, std::optional<double> limit, std::size_t notFinite = 0) {
    return {.value = value, .limit = limit, .notFinite = notFinite};
}

} // namespace

TEST(StabilityRows, fail_beyond_their_limit_and_for_every_value_that_is_not_finite) {
    EXPECT_TRUE(row(1, 1).pass());
    EXPECT_TRUE(row(7, std::nullopt).pass());
    EXPECT_FALSE(row(1.001, 1).pass());
    EXPECT_FALSE(row(0, 1, 1).pass());
    EXPECT_FALSE(row(std::numeric_limits<double>::quiet_NaN(), std::nullopt).pass());
}

TEST(StabilityRows, a_report_without_rows_does_not_pass) {
    EXPECT_FALSE(StabilityReport{}.pass());
}

TEST(StabilityRows, come_back_from_json_as_they_were) {
    StabilityReport report{.device = "a device",
                           .driver = "1.2",
                           .compiler = "DXC",
                           .size = 128,
                           .rows = {row(0.25, 0.5), row(2, std::nullopt, 3)},
                           .notes = {"not measured"}};
    report.rows[0].cause = "pixel (1, 2)";
    const auto back = stabilityFromJson(stabilityJson(report));
    ASSERT_TRUE(back);
    EXPECT_EQ(stabilityJson(*back), stabilityJson(report));
    EXPECT_EQ(stabilityMarkdown(*back), stabilityMarkdown(report));
    EXPECT_EQ(back->rows[1].notFinite, 3U);
    EXPECT_FALSE(back->rows[1].limit);
}

TEST(StabilityRows, other_json_is_no_stability_report) {
    EXPECT_FALSE(stabilityFromJson("[]"));
    EXPECT_FALSE(stabilityFromJson("{\"rows\": 3}"));
    EXPECT_FALSE(stabilityFromJson("no json"));
}

TEST_F(Stability, an_unknown_part_is_refused_with_the_nearest_name) {
    const auto report = measureStability(*device_, {.parts = {"shadows"}});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().diagnostics.front().code, 8080);
    EXPECT_NE(report.error().diagnostics.front().hint.find("'shadow'"), std::string::npos);
}

TEST_F(Stability, a_module_that_no_part_draws_is_refused) {
    const auto report = measureStability(*device_, {.parts = {"shadow"}, .modules = {"Beckmann"}});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().diagnostics.front().code, 8081);
}

TEST_F(Stability, a_value_that_is_not_finite_is_found_with_its_target_and_pixel) {
    const EffectFolder folder("1.0 / (floor(input.uv.x * 16.0) - 3.0 + gZero)"); // a column of infinities
    const auto report =
        measureStability(*device_, {.effects = folder.path(), .compiler = defaultCompiler(), .size = 16, .parts = {"finite"}});
    ASSERT_TRUE(report) << format(report.error());
    ASSERT_EQ(report->rows.size(), 1U);
    EXPECT_FALSE(report->pass());
    EXPECT_GT(report->rows.front().notFinite, 0U);
    EXPECT_EQ(report->rows.front().notFinite % 16, 0U) << "one column of sixteen";
    EXPECT_NE(report->rows.front().cause.find("picture (3, 0) is inf"), std::string::npos) << report->rows.front().cause;
}

TEST_F(Stability, a_finite_effect_passes_the_search_for_values_that_are_not) {
    const EffectFolder folder("1.0 / (floor(input.uv.x * 16.0) + 0.5 + gZero)");
    const auto report =
        measureStability(*device_, {.effects = folder.path(), .compiler = defaultCompiler(), .size = 16, .parts = {"finite"}});
    ASSERT_TRUE(report) << format(report.error());
    EXPECT_TRUE(report->pass()) << report->rows.front().cause;
}

TEST_F(Stability, reflection_stays_finite_on_every_hostile_scene) {
    expectPass(measure({"finite"}, {"Specular"}, 32));
}

TEST_F(Stability, reflection_keeps_the_rounding_of_its_half_vector_down_to_the_smallest_m_of_the_sliders) {
    expectPass(roughness());
}

TEST_F(Stability, errors_of_the_reflection_grow_as_the_lobe_narrows) {
    const auto errors = values(roughness(), "Specular", "largest error, of the lobe's peak");
    ASSERT_EQ(errors.size(), 9U);
    for (std::size_t i = 2; i + 1 < 8; ++i) // from m = 0.1 to 0.001
        EXPECT_LT(errors[i], errors[i + 1]) << "step " << i;
}

TEST_F(Stability, pictures_of_shadows_are_the_same_in_scenes_from_1_mm_to_10_m) {
    expectPass(measure({"scale"}, {"ShadowMap"}));
}

TEST_F(Stability, the_printed_comparison_has_acne_at_its_tolerance_and_the_filtered_one_has_none) {
    const StabilityReport& report = shadow();
    expectPass(report);
    const char* const acne = "share of lit points falsely in shadow";
    EXPECT_GT(values(report, "ShadowMap [seed]", acne)[3], 0.05); // 0.005 of z/w
    for (const double share : values(report, "ShadowMap [corrected]", acne))
        EXPECT_EQ(share, 0.0);
}

TEST_F(Stability, a_larger_tolerance_moves_the_shadow_away_by_the_cosine_of_the_light_s_elevation) {
    const auto offsets = values(shadow(), "ShadowMap [deon2007]", "shadow begins behind the wall by, mm");
    ASSERT_EQ(offsets.size(), 6U);
    EXPECT_TRUE(std::ranges::is_sorted(offsets));
    const double texel = 1; // mm on the floor
    EXPECT_NEAR(offsets[5], 5 * std::sqrt(0.5), texel) << "tolerance 5 mm, light at 45 degrees";
}

TEST_F(Stability, constant_light_stays_constant_under_every_chart) {
    expectPass(measure({"charts"}, {"Convolution"}));
}

TEST_F(Stability, half_targets_lose_no_more_than_their_rounding) {
    expectPass(measure({"formats"}, {"Irradiance"}));
}
