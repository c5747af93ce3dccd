// Surroundings in the techniques of skin: a body in an even light, and in a sky of one closed form.
// Lobes from afar: a relief that the normal map no longer shows makes them wider, and the picture stays the mean of the one near by.

#include "host/image/dds.h"
#include "meshprep/light/environment.h"
#include "tests/run/fixture.h"
#include "tests/run/sphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace tegument::test {
namespace {

constexpr int kPicture = 64;
constexpr double kPi = std::numbers::pi;

class Surroundings : public Run {
protected:
    static std::string environment(const std::string& name, const std::function<double(const glm::dvec3&)>& radiance) {
        constexpr int kHeight = 64;
        Image image{.width = 2 * kHeight, .height = kHeight, .channels = 3};
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
            effectFile, {.defines = {{"TEGUMENT_SURROUNDINGS", "1"}, {"TEGUMENT_MAP_SIZE", "256"}, {"TEGUMENT_SETTING", setting}}});
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
        // Seen from straight in front: L rho_s F pi / (4 pi), and what wide lobes add to it.
        const float intensity = setting == std::string("2") ? 1.0F : 0.18F;
        const float mirrored = with->image.at(32, 32, 0) - without->image.at(32, 32, 0);
        EXPECT_GT(mirrored, 0.5F * intensity * 0.02F * 0.25F) << setting;
        EXPECT_LT(mirrored, 0.5F * intensity * 0.2F) << setting;
    }
}

constexpr int kFar = 16;
constexpr int kShare = 32; // pixels of the near picture along the side of a far one: 16 texels

/// Noise of variance 1 without a pattern, each value with its neighbours' over three texels: look-ups between texels would take away more
/// than half of the variance of texels that know nothing of each other, and the near picture would have less relief than the map.
std::vector<double> smoothNoise(std::mt19937& random, int size) {
    const auto side = static_cast<std::size_t>(size);
    std::vector<double> values(side * side);
    for (double& value : values)
        value = static_cast<double>(random()) / 4294967296.0 - 0.5;
    for (int pass = 0; pass < 6; ++pass) { // three along each axis, around the border
        const std::vector<double> before = values;
        const std::size_t step = pass % 2 == 0 ? 1 : side;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const std::size_t place = i / step % side;
            const std::size_t line = i - place * step;
            values[i] = before[line + (place + side - 1) % side * step] + before[i] + before[line + (place + 1) % side * step];
        }
    }
    double squares = 0;
    for (const double value : values)
        squares += value * value;
    for (double& value : values)
        value *= std::sqrt(static_cast<double>(values.size()) / squares);
    return values;
}

/// Slopes of this standard deviation along each axis.
Image noisyNormals(double slope, unsigned seed) {
    constexpr int kSize = 512;
    std::mt19937 random(seed);
    const std::vector<double> across = smoothNoise(random, kSize);
    const std::vector<double> down = smoothNoise(random, kSize);
    Image image{.width = kSize, .height = kSize, .channels = 4, .bitsPerChannel = 8};
    for (std::size_t i = 0; i < across.size(); ++i) {
        const glm::dvec3 normal = glm::normalize(glm::dvec3(slope * across[i], slope * down[i], 1));
        for (const double value : {normal.x, normal.y, normal.z})
            image.pixels.push_back(static_cast<float>(std::round(255 * (0.5 + 0.5 * value)) / 255));
        image.pixels.push_back(1);
    }
    return image;
}

class Lobes : public Run {
protected:
    struct Look {
        double relief = 1;
        double rougher = 1; // times both roughnesses and the intensity, as parameters
        double intenser = 1;
        bool second = true;   // with a second lobe
        bool compiled = true; // with the code for it
        std::vector<EmbeddedTexture> textures = {{.role = "normal", .image = noisyNormals(0.2, 1)}};
    };

    Result<Image> draw(int size, const Look& look) {
        const auto effect = loadEffect("effects/Specular.fx", {.defines = {{"TEGUMENT_LOBES", look.compiled ? "1" : "0"}}});
        if (!effect) return effect.error();
        std::map<std::string, std::vector<double>> parameters = {{"gRoughness", {0.25 * look.rougher}},
                                                                 {"gSpecularIntensity", {0.2 * look.intenser}}};
        if (look.compiled) {
            parameters["gSecondRoughness"] = {0.12 * look.rougher};
            parameters["gSecondLobe"] = {look.second ? 0.3 : 0};
            parameters["gLostRelief"] = {look.relief};
        }
        Mesh mesh = sphere();
        mesh.textures = look.textures;
        auto drawn = runEffect(*device_, *effect, &mesh, closeUp(),
                               {.technique = "SpecularUnshadowed",
                                .width = size,
                                .height = size,
                                .compiler = defaultCompiler(),
                                .parameters = parameters,
                                .plainSkin = std::array{0.8F, 0.6F, 0.5F, 1.0F}});
        if (!drawn) return drawn.error();
        return std::move(drawn->image);
    }
};

/// Adds to each value of a far picture the mean of the pixels of a near one there.
void addMeans(const Image& near, std::vector<double>& sums) {
    const int share = near.width / kFar;
    for (int y = 0; y < near.height; ++y)
        for (int x = 0; x < near.width; ++x)
            sums[static_cast<std::size_t>(y / share * kFar + x / share)] += static_cast<double>(near.at(x, y, 0)) / (share * share);
}

double relativeL2(const std::vector<double>& values, const std::vector<double>& truth) {
    double squares = 0;
    double all = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        squares += std::pow(values[i] - truth[i], 2);
        all += truth[i] * truth[i];
    }
    return std::sqrt(squares / all);
}

TEST_F(Lobes, of_a_relief_from_afar_are_the_mean_of_what_is_seen_near_by) {
    constexpr unsigned kMaps = 12; // a far pixel has a dozen bumps, whose mean is no lobe yet
    std::map<double, std::vector<double>> sums;
    for (unsigned seed = 1; seed <= kMaps; ++seed)
        for (const auto& [relief, size] : {std::pair(-1.0, kFar * kShare), std::pair(0.0, kFar), std::pair(1.0, kFar)}) {
            const Look look{.relief = std::max(relief, 0.0), .textures = {{.role = "normal", .image = noisyNormals(0.2, seed)}}};
            const auto picture = draw(size, look);
            ASSERT_TRUE(succeeded(picture));
            addMeans(*picture, sums.try_emplace(relief, kFar * kFar).first->second);
        }
    const double without = relativeL2(sums.at(0), sums.at(-1));
    const double with = relativeL2(sums.at(1), sums.at(-1));
    RecordProperty("without", std::to_string(without));
    RecordProperty("with", std::to_string(with));
    // A relief of 0.2 beside m = 0.25 and 0.12: without it the highlight is half as wide and four times as bright.
    EXPECT_GT(without, 0.5);
    EXPECT_LT(with, 0.12) << "0.10: the mean of a lobe's shapes over a pixel is not quite a lobe; 1 / |n| - 1 would be off by 0.13";
}

/// One texel, as the map stores it: 128 is 1.
EmbeddedTexture shineOf(float roughness, float intensity) {
    return {.role = "shine",
            .image = {.width = 1, .height = 1, .channels = 3, .pixels = {roughness / 255, intensity / 255, 0}, .bitsPerChannel = 8}};
}

double farthest(const Image& a, const Image& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        most = std::max(most, std::abs(static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i])));
    return most;
}

TEST_F(Lobes, by_the_shine_map_are_those_of_its_factors) {
    // One rounding of the map's 255ths; highlights reach 1.
    constexpr double kRounding = 2e-5;
    const auto plain = draw(64, Look{.textures = {}});
    const auto neutral = draw(64, Look{.textures = {shineOf(128, 128)}});
    const auto half = draw(64, Look{.textures = {shineOf(64, 192)}});
    const auto meant = draw(64, Look{.rougher = 0.5, .intenser = 1.5, .textures = {}});
    const auto single = draw(64, Look{.second = false, .textures = {}});
    const auto without = draw(64, Look{.compiled = false, .textures = {}});
    ASSERT_TRUE(succeeded(plain) && succeeded(neutral) && succeeded(half) && succeeded(meant) && succeeded(single) && succeeded(without));
    EXPECT_LT(farthest(*single, *without), kRounding); // where there is no map, its factors are 1
    EXPECT_LT(farthest(*plain, *neutral), kRounding);
    EXPECT_LT(farthest(*half, *meant), kRounding);
    EXPECT_GT(farthest(*half, *plain), 0.01); // and there is something to compare
}

} // namespace
} // namespace tegument::test
