// effects/Main.fx as a whole, on a small sphere: the whole way from the file to the picture.

#include "tests/run/fixture.h"

#include <algorithm>
#include <numbers>

namespace tegument::test {
namespace {

constexpr int kPicture = 96;

/// A sphere of 80 mm with one chart; a seam at u = 0, poles of many vertices.
Mesh sphere() {
    constexpr int kRings = 24;
    constexpr int kSectors = 48;
    Mesh mesh;
    mesh.name = "sphere";
    for (int ring = 0; ring <= kRings; ++ring)
        for (int sector = 0; sector <= kSectors; ++sector) {
            const float theta = std::numbers::pi_v<float> * static_cast<float>(ring) / kRings;
            const float phi = 2 * std::numbers::pi_v<float> * static_cast<float>(sector) / kSectors;
            const glm::vec3 normal(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
            mesh.positions.push_back(80.0F * normal);
            mesh.normals.push_back(normal);
            mesh.tangents.emplace_back(std::cos(phi), 0, -std::sin(phi), 1);
            mesh.uvs.emplace_back(static_cast<float>(sector) / kSectors, static_cast<float>(ring) / kRings);
        }
    for (std::uint32_t ring = 0; ring < kRings; ++ring)
        for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
            const std::uint32_t a = ring * (kSectors + 1) + sector;
            const std::uint32_t b = a + kSectors + 1;
            for (const std::uint32_t index : {a, b, a + 1, a + 1, b, b + 1})
                mesh.indices.push_back(index);
        }
    mesh.parts = {{.name = "sphere", .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    computeBounds(mesh);
    return mesh;
}

class MainEffect : public Run {
protected:
    Result<RunResult> render(Compiler compiler, const std::string& setting, const std::string& technique = "DEonLuebke",
                             std::vector<std::string> dump = {}) {
        const auto effect =
            loadEffect("effects/Main.fx", {.defines = {{"TEGUMENT_SETTING", setting}, {"TEGUMENT_MAP_SIZE", "128"}}, .includeFolders = {}});
        if (!effect) return effect.error();
        const Mesh mesh = sphere();
        return runEffect(*device_, *effect, &mesh, closeUp(),
                         {.technique = technique, .width = kPicture, .height = kPicture, .compiler = compiler, .dump = std::move(dump)});
    }
};

double meanOf(const Image& image) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        if (i % 4 != 3) sum += image.pixels[i];
    return sum / (0.75 * static_cast<double>(image.pixels.size()));
}

/// Share of pixels of which a colour differs by more than a thousandth of the mean.
double differingShare(const Image& a, const Image& b) {
    const double limit = 1e-3 * meanOf(a);
    int differing = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            double largest = 0;
            for (int channel = 0; channel < 3; ++channel)
                largest = std::max<double>(largest, std::abs(a.at(x, y, channel) - b.at(x, y, channel)));
            differing += largest > limit;
        }
    return differing / (static_cast<double>(a.width) * a.height);
}

TEST_F(MainEffect, both_compilers_draw_the_same_picture_in_every_setting) {
    if (!compilerAvailable(Compiler::Dxc)) GTEST_SKIP() << "DXC is not installed";
    for (const char* setting : {"0", "1", "2"}) {
        const auto dxc = render(Compiler::Dxc, setting);
        const auto glslang = render(Compiler::Glslang, setting);
        ASSERT_TRUE(succeeded(dxc));
        ASSERT_TRUE(succeeded(glslang));
        ASSERT_GT(meanOf(dxc->image), 0.01) << "the picture is not black";
        // The two order sums differently, and a comparison with the shadow map may fall the other way on its edge.
        EXPECT_LT(differingShare(dxc->image, glslang->image), 1e-3) << "setting " << setting;
    }
}

TEST_F(MainEffect, every_target_can_be_read_and_is_finite) {
    for (const char* setting : {"0", "1", "2"}) {
        const auto result = render(defaultCompiler(), setting, "DEonLuebke", {"all"});
        ASSERT_TRUE(succeeded(result));
        for (const char* name : {"gTsmMap", "gTsmDepthMap", "gIrradianceMap", "gIrradiance2Map", "gIrradiance3Map", "gIrradiance4Map",
                                 "gIrradiance5Map", "gIrradiance6Map", "gIrradianceUMap", "gUnwrapDepthMap"})
            EXPECT_TRUE(result->dumped.contains(name)) << name;
        for (const auto& [name, image] : result->dumped)
            EXPECT_TRUE(std::ranges::all_of(image.pixels, [](float value) { return std::isfinite(value); }))
                << name << ", setting " << setting;
    }
}

TEST_F(MainEffect, culling_leaves_every_pixel_as_it_is) {
    const auto all = render(defaultCompiler(), "2", "DEonLuebke");
    const auto culled = render(defaultCompiler(), "2", "DEonLuebkeCulled");
    ASSERT_TRUE(succeeded(all));
    ASSERT_TRUE(succeeded(culled));
    EXPECT_EQ(all->image.pixels, culled->image.pixels);
}

} // namespace
} // namespace tegument::test
