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
    Image image{.width = kSize, .height = kSize, .channels = 4, .pixels = {}, .bitsPerChannel = 8, .metadata = {}};
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
