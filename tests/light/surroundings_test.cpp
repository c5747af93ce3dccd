// Surroundings in the techniques of skin: a body in an even light, and in a sky of one closed form.

#include "host/image/dds.h"
#include "meshprep/light/environment.h"
#include "tests/run/fixture.h"
#include "tests/run/sphere.h"

#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>

namespace tegument::test {
namespace {

constexpr int kPicture = 64;
constexpr double kPi = std::numbers::pi;

class Surroundings : public Run {
protected:
    static std::string environment(const std::string& name, const std::function<double(const glm::dvec3&)>& radiance) {
        constexpr int kHeight = 64;
        Image image{.width = 2 * kHeight, .height = kHeight, .channels = 3, .pixels = {}};
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < 2 * kHeight; ++x)
                image.pixels.insert(image.pixels.end(), 3,
                                    static_cast<float>(radiance(panoramaDirection((x + 0.5) / (2 * kHeight), (y + 0.5) / kHeight))));
        const auto texture = makeEnvironment(image, name);
        EXPECT_TRUE(texture);
        const auto file = std::filesystem::path(testing::TempDir()) / ("surroundings_" + name + ".dds");
        EXPECT_TRUE(writeDds(file, *texture));
        return file.string();
    }

    /// Without the light of the workspace.
    Result<RunResult> draw(const std::string& effectFile, const std::string& technique, const std::string& environment,
                           std::map<std::string, std::vector<double>> parameters, const std::string& setting = "2") {
        const auto effect = loadEffect(
            effectFile, {.defines = {{"TEGUMENT_SURROUNDINGS", "1"}, {"TEGUMENT_MAP_SIZE", "256"}, {"TEGUMENT_SETTING", setting}},
                         .includeFolders = {}});
        if (!effect) return effect.error();
        const Mesh mesh = sphere();
        parameters.insert({"gLightColor", {0, 0, 0}});
        Workspace workspace = closeUp();
        workspace.worldUnitMm = metres_ ? 1000.0F : 1.0F;
        return runEffect(*device_, *effect, &mesh, workspace,
                         {.technique = technique,
                          .width = kPicture,
                          .height = kPicture,
                          .compiler = defaultCompiler(),
                          .parameters = parameters,
                          .textures = {{"gEnvironmentMap", environment}},
                          .plainSkin = std::array{0.8F, 0.6F, 0.5F, 1.0F}});
    }

    bool metres_ = false;
};

constexpr std::array kTechniques = {
    std::pair("effects/Main.fx", "DEonLuebke"),       std::pair("effects/Main.fx", "Lambert"),
    std::pair("effects/Main.fx", "Gosselin"),         std::pair("effects/Pyramid.fx", "Pyramid"),
    std::pair("effects/Pyramid.fx", "PyramidLinked"), std::pair("effects/peers/Separable.fx", "Separable17"),
    std::pair("effects/peers/Burley.fx", "Burley20"), std::pair("effects/peers/Preintegrated.fx", "Preintegrated")};

// Even light is even under the skin of a closed body: diffusion changes nothing, whatever the technique, and what leaves is the colour.
TEST_F(Surroundings, of_one_radiance_show_the_colour_of_skin_that_does_not_shine) {
    const std::string even = environment("even", [](const glm::dvec3&) { return 0.5; });
    for (const auto& [effect, technique] : kTechniques) {
        const auto drawn = draw(effect, technique, even, {{"gSpecularIntensity", {0}}});
        ASSERT_TRUE(succeeded(drawn)) << technique;
        // Half floats on the way, of up to a hundred sums; screen space loses light at the outline: its middle is judged.
        for (const auto& [x, y] : {std::pair(32, 32), std::pair(26, 30), std::pair(36, 40)})
            EXPECT_TRUE(pixelIs(drawn->image, x, y, {0.4F, 0.3F, 0.25F, 1}, 0.006F)) << technique;
    }
}

TEST_F(Surroundings, show_no_more_than_what_comes_in) {
    const std::string even = environment("even", [](const glm::dvec3&) { return 0.5; });
    for (const double roughness : {0.1, 0.3, 0.6}) {
        const auto drawn = draw("effects/Main.fx", "Lambert", even, {{"gSpecularIntensity", {1}}, {"gRoughness", {roughness}}});
        ASSERT_TRUE(succeeded(drawn));
        for (int x = 0; x < kPicture; ++x)
            for (int c = 0; c < 3; ++c)
                EXPECT_LE(drawn->image.at(x, 32, c), 0.501F) << x << " " << roughness;
    }
}

TEST_F(Surroundings, of_a_cosine_sky_light_a_sphere_by_the_closed_form) {
    const std::string sky = environment("cosine", [](const glm::dvec3& d) { return std::max(d.y, 0.0); });
    const auto drawn = draw("effects/Main.fx", "Lambert", sky, {{"gSpecularIntensity", {0}}});
    ASSERT_TRUE(succeeded(drawn));
    // The middle column of the picture looks along the meridian: from five radii a sphere of radius 1 is met at these heights.
    const double half = std::tan(12.5 * kPi / 180);
    int judged = 0;
    for (int y = 0; y < kPicture; ++y) {
        const glm::dvec3 ray = glm::normalize(glm::dvec3(half / kPicture, (1 - 2 * (y + 0.5) / kPicture) * half, -1));
        const glm::dvec3 eye(0, 0, 5);
        const double along = glm::dot(eye, ray);
        const double root = along * along - 24;
        if (root < 0.05) continue;
        const glm::dvec3 normal = eye + (-along - std::sqrt(root)) * ray;
        const double t = std::acos(std::clamp(normal.y, -1.0, 1.0));
        const double irradiance = 2 / (3 * kPi) * (std::sin(t) + (kPi - t) * std::cos(t));
        // The cube map is read between texels of 6 degrees: their chord misses the arc by 0.05^2 / 2 of it; facets turn normals by 0.2 %.
        EXPECT_NEAR(static_cast<double>(drawn->image.at(32, y, 0)), 0.8 * irradiance, 0.8 * 0.004) << y;
        ++judged;
    }
    EXPECT_GT(judged, 40);
}

TEST_F(Surroundings, turn_with_their_parameter) {
    const std::string lamp = environment("lamp", [](const glm::dvec3& d) { return d.x > 0.9 ? 10.0 : 0.0; });
    const auto right = draw("effects/Main.fx", "Lambert", lamp, {});
    const auto left = draw("effects/Main.fx", "Lambert", lamp, {{"gSurroundingsTurn", {180}}});
    ASSERT_TRUE(succeeded(right) && succeeded(left));
    EXPECT_GT(right->image.at(50, 32, 0), 4 * right->image.at(13, 32, 0) + 0.01F);
    for (int x = 8; x < 56; ++x) // facets are not those of the mirrored sphere
        EXPECT_NEAR(right->image.at(x, 32, 0), left->image.at(63 - x, 32, 0), 0.03F) << x;
}

TEST_F(Surroundings, with_one_pixel_of_a_million_stay_finite) {
    const std::string pixel =
        environment("pixel", [](const glm::dvec3& d) { return glm::dot(d, glm::dvec3(0.6, 0, 0.8)) > 0.9995 ? 1e6 : 0.0; });
    for (const auto& [effect, technique] : {std::pair("effects/Main.fx", "DEonLuebke"), std::pair("effects/Pyramid.fx", "PyramidLinked")}) {
        const auto drawn = draw(effect, technique, pixel, {{"gPlainRoughness", {0.05}}, {"gRoughness", {0.05}}, {"gSurroundings", {4}}});
        ASSERT_TRUE(succeeded(drawn)) << technique;
        for (const float value : drawn->image.pixels)
            ASSERT_TRUE(std::isfinite(value) && value >= 0) << technique << " " << value;
        EXPECT_GT(drawn->image.at(45, 32, 0), 1.0F) << technique;
    }
}

TEST_F(Surroundings, do_not_ask_for_the_unit_of_the_world) {
    const std::string sky = environment("unit", [](const glm::dvec3& d) { return std::max(d.x, 0.0); });
    const auto millimetres = draw("effects/Pyramid.fx", "PyramidLinked", sky, {});
    metres_ = true;
    const auto metres = draw("effects/Pyramid.fx", "PyramidLinked", sky, {});
    ASSERT_TRUE(succeeded(millimetres) && succeeded(metres));
    for (std::size_t i = 0; i < metres->image.pixels.size(); ++i) // places are rounded otherwise, and then to halves
        ASSERT_NEAR(millimetres->image.pixels[i], metres->image.pixels[i], 0.002F) << i;
}

TEST_F(Surroundings, that_are_missing_light_nothing_and_cost_nothing) {
    const auto effect = loadEffect("effects/Pyramid.fx", {});
    ASSERT_TRUE(succeeded(effect));
    for (const Parameter& parameter : effect->parameters)
        EXPECT_TRUE(parameter.name != "gEnvironmentMap" && parameter.name != "gOcclusionMap" && parameter.name != "gSurroundings");
}

TEST_F(Surroundings, of_printed_settings_mirror_the_albedo_of_their_lobe) {
    const std::string even = environment("even", [](const glm::dvec3&) { return 0.5; });
    for (const char* setting : {"0", "1", "2"}) {
        const auto with = draw("effects/Main.fx", "Lambert", even, {{"gReflections", {1}}}, setting);
        const auto without = draw("effects/Main.fx", "Lambert", even, {{"gReflections", {0}}}, setting);
        ASSERT_TRUE(succeeded(with) && succeeded(without));
        // rho_s = 0.18, F0 = 0.028, seen from straight in front: L rho_s F pi / (4 pi), and what wide lobes add to it.
        const float mirrored = with->image.at(32, 32, 0) - without->image.at(32, 32, 0);
        EXPECT_GT(mirrored, 0.5F * 0.18F * 0.02F * 0.25F) << setting;
        EXPECT_LT(mirrored, 0.5F * 0.18F * 0.2F) << setting;
    }
}

} // namespace
} // namespace tegument::test
