// Lamps beside the light of the workspace: they are what that light is, and they add up.

#include "tests/run/fixture.h"
#include "tests/run/sphere.h"

#include <cmath>
#include <map>
#include <string>

namespace tegument::test {
namespace {

constexpr int kLampPicture = 64;
using Parameters = std::map<std::string, std::vector<double>>;

class Lamps : public Run {
protected:
    Result<RunResult> draw(const std::string& effectFile, const std::string& technique, int lamps, const Parameters& parameters,
                           const glm::vec3& light = {0, 0, 0}) {
        const auto effect = loadEffect(
            effectFile, {.defines = {{"TEGUMENT_LAMPS", std::to_string(lamps)}, {"TEGUMENT_MAP_SIZE", "128"}}, .includeFolders = {}});
        if (!effect) return effect.error();
        const Mesh mesh = sphere();
        Workspace workspace = closeUp();
        workspace.light.direction = glm::vec3(-3, -4, -5);
        workspace.light.color = light;
        return runEffect(*device_, *effect, &mesh, workspace,
                         {.technique = technique,
                          .width = kLampPicture,
                          .height = kLampPicture,
                          .compiler = defaultCompiler(),
                          .parameters = parameters,
                          .plainSkin = std::array{0.8F, 0.6F, 0.5F, 1.0F}});
    }
};

/// Four numbers of each of three lamps; the others are dark.
std::vector<double> three(std::vector<double> first, std::vector<double> second = {0, 0, 0, 0}) {
    first.insert(first.end(), second.begin(), second.end());
    first.resize(12);
    return first;
}

constexpr std::array kLitTechniques = {std::pair("effects/Main.fx", "DEonLuebke"), std::pair("effects/Main.fx", "Gosselin"),
                                       std::pair("effects/Pyramid.fx", "Pyramid"), std::pair("effects/Pyramid.fx", "PyramidLinked"),
                                       std::pair("effects/peers/Separable.fx", "Separable17")};

const std::vector<double> kEverywhere = {-1, -2, 1, 1, -1, -2, 1, 1, -1, -2, 1, 1};

// On a sphere, which hides no more of itself than its horizon does: the same direction, the same colour, the same picture.
TEST_F(Lamps, of_parallel_light_light_a_sphere_as_the_workspace_s_own_does) {
    for (const auto& [effect, technique] : kLitTechniques) {
        const auto own = draw(effect, technique, 0, {}, {0.5F, 0.25F, 1.0F});
        const auto lamp = draw(effect, technique, 1, {{"gLampPlace", three({3, 4, 5, 0})}, {"gLampColor", three({0.5, 0.25, 1, 0})}});
        ASSERT_TRUE(succeeded(own) && succeeded(lamp));
        double worst = 0;
        for (int y = 0; y < kLampPicture; ++y)
            for (int x = 0; x < kLampPicture; ++x)
                worst =
                    std::max(worst, std::abs(static_cast<double>(own->image.at(x, y, 0)) - static_cast<double>(lamp->image.at(x, y, 0))));
        // The workspace's light darkens the last degrees before its horizon by its shadow map's texels: up to 0.05 of cosine there.
        EXPECT_LT(worst, 0.5 * 0.05) << technique;
        EXPECT_GT(lamp->image.at(40, 20, 2), 0.2F) << "there is something to see";
    }
}

TEST_F(Lamps, add_up) {
    const Parameters one = {{"gLampPlace", three({3, 4, 5, 0})}, {"gLampColor", three({0.5, 0.25, 1, 0})}, {"gLampSpot", kEverywhere}};
    const Parameters other = {
        {"gLampPlace", three({-300, 100, 200, 1})}, {"gLampColor", three({0.1, 0.8, 0.3, 350})}, {"gLampSpot", kEverywhere}};
    const Parameters both = {{"gLampPlace", three({3, 4, 5, 0}, {-300, 100, 200, 1})},
                             {"gLampColor", three({0.5, 0.25, 1, 0}, {0.1, 0.8, 0.3, 350})},
                             {"gLampAxis", std::vector<double>{0, 0, -1, 0.25, 0, 0, -1, 0.25, 0, 0, -1, 0.25}},
                             {"gLampSpot", kEverywhere}};
    for (const auto& [effect, technique] : kLitTechniques) {
        const auto a = draw(effect, technique, 1, one);
        const auto b = draw(effect, technique, 1, other);
        const auto sum = draw(effect, technique, 2, both);
        ASSERT_TRUE(succeeded(a) && succeeded(b) && succeeded(sum));
        for (int y = 0; y < kLampPicture; y += 3)
            for (int x = 0; x < kLampPicture; x += 3)
                for (int c = 0; c < 3; ++c) // halves: 2^-11 of up to ten sums
                    EXPECT_NEAR(a->image.at(x, y, c) + b->image.at(x, y, c), sum->image.at(x, y, c), 0.006F)
                        << technique << " " << x << " " << y;
    }
}

// Layers are blended by what they cover, not by their light: a picture of fur is linear in it.
TEST_F(Lamps, add_up_on_fur) {
    const Parameters one = {{"gLampPlace", three({3, 4, 5, 0})}, {"gLampColor", three({0.5, 0.25, 1, 0})}, {"gLampSpot", kEverywhere}};
    const Parameters other = {
        {"gLampPlace", three({-300, 100, 200, 1})}, {"gLampColor", three({0.1, 0.8, 0.3, 350})}, {"gLampSpot", kEverywhere}};
    Parameters both = {{"gLampPlace", three({3, 4, 5, 0}, {-300, 100, 200, 1})},
                       {"gLampColor", three({0.5, 0.25, 1, 0}, {0.1, 0.8, 0.3, 350})},
                       {"gLampSpot", kEverywhere}};
    const auto none = draw("effects/Fur.fx", "CubeCombined", 0, {});
    const auto a = draw("effects/Fur.fx", "CubeCombined", 1, one);
    const auto b = draw("effects/Fur.fx", "CubeCombined", 1, other);
    const auto sum = draw("effects/Fur.fx", "CubeCombined", 2, both);
    ASSERT_TRUE(succeeded(none) && succeeded(a) && succeeded(b) && succeeded(sum));
    float brightest = 0;
    for (int y = 0; y < kLampPicture; ++y)
        for (int x = 0; x < kLampPicture; ++x)
            for (int c = 0; c < 3; ++c) {
                const float lamps = a->image.at(x, y, c) + b->image.at(x, y, c) - 2 * none->image.at(x, y, c);
                brightest = std::max(brightest, lamps);
                EXPECT_NEAR(lamps, sum->image.at(x, y, c) - none->image.at(x, y, c), 2e-3F) << x << " " << y; // blended ten times in halves
            }
    EXPECT_GT(brightest, 25 * 2e-3F) << "there is something to see, beside that tolerance";
}

TEST_F(Lamps, of_points_fall_off_with_the_square_of_the_distance) {
    const auto at = [&](double z) {
        return draw("effects/Main.fx", "Lambert", 1,
                    {{"gLampPlace", three({0, 0, z, 1})}, {"gLampColor", three({1, 1, 1, 400})}, {"gSpecularIntensity", {0}}});
    };
    const auto near = at(480);
    const auto far = at(880);
    ASSERT_TRUE(succeeded(near) && succeeded(far));
    // From the sphere's front, at z = 80, they are 400 and 800 mm away.
    EXPECT_NEAR(near->image.at(32, 32, 0), 0.8F, 0.004F);
    EXPECT_NEAR(far->image.at(32, 32, 0), 0.2F, 0.001F);
}

TEST_F(Lamps, of_spots_light_their_cone_only) {
    // 600 mm in front, a cone of 4 degrees: 42 mm at the sphere's front. The picture is 176 mm wide there.
    const double inner = std::cos(3 * 0.0174533);
    const double outer = std::cos(4 * 0.0174533);
    const auto spot = draw("effects/Main.fx", "Lambert", 1,
                           {{"gLampPlace", three({0, 0, 680, 1})},
                            {"gLampColor", three({1, 1, 1, 0})},
                            {"gLampAxis", three({0, 0, -1, 1})},
                            {"gLampSpot", three({inner, outer, 1, 0})}});
    ASSERT_TRUE(succeeded(spot));
    EXPECT_GT(spot->image.at(32, 32, 0), 0.7F);
    EXPECT_EQ(spot->image.at(32, 8, 0), 0.0F);
    EXPECT_EQ(spot->image.at(56, 32, 0), 0.0F);
}

TEST_F(Lamps, in_the_body_or_of_no_size_stay_finite) {
    for (const auto& place : {std::vector<double>{0, 0, 0, 1}, {0, 0, 80, 1}, {0, 0, 0, 0}}) {
        const auto drawn =
            draw("effects/Pyramid.fx", "PyramidLinked", 1,
                 {{"gLampPlace", three(place)}, {"gLampColor", three({1e6, 1e6, 1e6, 100})}, {"gLampAxis", three({0, 0, 0, 0})}});
        ASSERT_TRUE(succeeded(drawn));
        for (const float value : drawn->image.pixels)
            ASSERT_TRUE(std::isfinite(value));
    }
}

} // namespace
} // namespace tegument::test
