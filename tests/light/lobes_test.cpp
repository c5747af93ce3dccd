// Lobes from afar: a relief that the normal map no longer shows makes them wider, and the picture stays the mean of the one near by.

#include "tests/run/fixture.h"
#include "tests/run/sphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace tegument::test {
namespace {

constexpr int kFar = 32;
constexpr int kShare = 16; // pixels of the near picture along the side of a far one

/// Slopes without a pattern, of this standard deviation along each axis.
Image noisyNormals(double slope) {
    constexpr int kSize = 512;
    std::mt19937 random(1);
    Image image{.width = kSize, .height = kSize, .channels = 4, .pixels = {}, .bitsPerChannel = 8, .metadata = {}};
    const auto gaussian = [&] {
        double sum = -6;
        for (int i = 0; i < 12; ++i)
            sum += static_cast<double>(random()) / 4294967296.0;
        return sum;
    };
    for (int i = 0; i < kSize * kSize; ++i) {
        const glm::dvec3 normal = glm::normalize(glm::dvec3(slope * gaussian(), slope * gaussian(), 1));
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
        std::vector<EmbeddedTexture> textures = {{.role = "normal", .image = noisyNormals(0.2)}};
    };

    Result<Image> draw(int size, double relief) { return draw(size, Look{.relief = relief}); }

    Result<Image> draw(int size, const Look& look) {
        const auto effect =
            loadEffect("effects/Specular.fx", {.defines = {{"TEGUMENT_LOBES", look.compiled ? "1" : "0"}}, .includeFolders = {}});
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

/// Of a far pixel's part of the near picture the mean.
double meanOf(const Image& near, int x, int y) {
    double sum = 0;
    for (int j = 0; j < kShare; ++j)
        for (int i = 0; i < kShare; ++i)
            sum += static_cast<double>(near.at(kShare * x + i, kShare * y + j, 0));
    return sum / (kShare * kShare);
}

TEST_F(Lobes, of_a_relief_from_afar_are_the_mean_of_what_is_seen_near_by) {
    const auto near = draw(kFar * kShare, 0);
    ASSERT_TRUE(succeeded(near));
    std::map<double, double> errors;
    for (const double relief : {0.0, 1.0}) {
        const auto far = draw(kFar, relief);
        ASSERT_TRUE(succeeded(far));
        double squares = 0;
        double all = 0;
        for (int y = 4; y < kFar - 4; ++y)
            for (int x = 4; x < kFar - 4; ++x) {
                const double truth = meanOf(*near, x, y);
                squares += std::pow(static_cast<double>(far->at(x, y, 0)) - truth, 2);
                all += truth * truth;
            }
        errors[relief] = std::sqrt(squares / all);
        RecordProperty("relief " + std::to_string(relief), std::to_string(errors[relief]));
    }
    // A relief of 0.2 beside m = 0.25 and 0.12: without it the highlight is a quarter as wide and four times as bright.
    EXPECT_GT(errors[0], 0.5);
    EXPECT_LT(errors[1], 0.2) << "the mean of a lobe's shapes over a pixel is not quite a lobe";
}

/// One texel, as the map stores it: 128 is 1.
EmbeddedTexture shineOf(float roughness, float intensity) {
    return {
        .role = "shine",
        .image = {
            .width = 1, .height = 1, .channels = 3, .pixels = {roughness / 255, intensity / 255, 0}, .bitsPerChannel = 8, .metadata = {}}};
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
