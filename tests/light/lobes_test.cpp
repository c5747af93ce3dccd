// Lobes from afar: a relief that the normal map no longer shows makes them wider, and the picture stays the mean of the one near by.

#include "tests/run/fixture.h"
#include "tests/run/sphere.h"

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>

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
    Result<Image> draw(int size, double relief) {
        const auto effect = loadEffect("effects/Specular.fx", {.defines = {{"TEGUMENT_LOBES", "1"}}, .includeFolders = {}});
        if (!effect) return effect.error();
        Mesh mesh = sphere();
        mesh.textures = {{.role = "normal", .image = noisyNormals(0.2)}};
        auto drawn = runEffect(
            *device_, *effect, &mesh, closeUp(),
            {.technique = "SpecularUnshadowed",
             .width = size,
             .height = size,
             .compiler = defaultCompiler(),
             .parameters = {{"gRoughness", {0.25}}, {"gSecondRoughness", {0.12}}, {"gSecondLobe", {0.3}}, {"gLostRelief", {relief}}},
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

} // namespace
} // namespace tegument::test
