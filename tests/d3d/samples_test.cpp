// The samples of docs/samples, run as a reader would run them.

#include "host/gpu/gpu.h"
#include "host/image/image.h"
#include "host/support/file.h"
#include "tests/d3d/engines.h"
#include "tools/direct3d/microsoft.h"
#include "tools/direct3d/microsoft_messages.h"
#include "tools/direct3d/wine.h"
#include "tools/emit/emit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = TEGUMENT_SAMPLES;

std::string missing() {
    if (std::string lacking = microsoftCompilerMissing(); !lacking.empty()) return lacking;
    std::error_code code;
    if (!fs::exists(TEGUMENT_D3D9_SAMPLE, code)) return "d3d9_sample.exe was not built (g++-mingw-w64-x86-64 was not installed)";
    if (!fs::exists(cacheFolder() / "human" / "human.glb", code)) return "the human was not made (./bootstrap demo makes it)";
    const auto device = gpu::Device::create({});
    return device ? "" : format(device.error());
}

std::string runVulkan() {
    const auto run = runProcess({.arguments = {TEGUMENT_VULKAN_SAMPLE, "effects/Main.fx", (cacheFolder() / "human" / "human.glb").string(),
                                               (kFolder / "vulkan.png").string(), (kFolder / "mesh.bin").string()}},
                                120);
    return !run ? format(run.error()) : run->exitCode == 0 ? "" : "the Vulkan sample failed: " + run->output;
}

/// Beside its executable: Microsoft's compiler, which D3DX calls for effects in source form.
std::string runDirect3D9() {
    std::error_code code;
    const fs::path program = kFolder / "d3d9_sample.exe";
    fs::create_symlink(TEGUMENT_D3D9_SAMPLE, program, code);
    fs::create_symlink(microsoftCompilerLibrary(), kFolder / "d3dcompiler_47.dll", code);
    const auto inWindows = [](const fs::path& path) { return windowsPath(fs::absolute(path)); };
    const fs::path human = cacheFolder() / "human";
    const auto run = runInWine(program,
                               {inWindows("effects"), inWindows(kFolder / "mesh.bin"), inWindows(human / "color.png"),
                                inWindows(human / "normal.png"), inWindows(kFolder / "d3d9.png")},
                               240);
    return !run ? format(run.error()) : run->exitCode == 0 ? "" : "the Direct3D 9 sample failed: " + run->output;
}

/// From what `tegument check --emit` writes.
std::string runDirect3D12() {
    const CheckOptions options{.variants = {{.defines = {{"TEGUMENT_MAP_SIZE", "512"}}}}};
    const CheckReport report =
        checkEffects({"effects/Stretch.fx", "effects/EnergyAttenuation.fx", "effects/Main.fx"}, {Target::Sm5}, options);
    for (const FileReport& file : report.files)
        if (const auto written = emitEffect(file, {.folder = kFolder / "emitted", .kinds = {Target::Sm5}}); !written)
            return format(written.error());
    std::error_code code;
    const fs::path program = kFolder / "d3d12_sample.exe";
    fs::create_symlink(TEGUMENT_D3D12_SAMPLE, program, code);
    const auto inWindows = [](const fs::path& path) { return windowsPath(fs::absolute(path)); };
    const fs::path human = cacheFolder() / "human";
    const auto run = runInWine12(program,
                                 {inWindows(kFolder / "emitted"), inWindows(kFolder / "mesh.bin"), inWindows(human / "color.png"),
                                  inWindows(human / "normal.png"), inWindows(kFolder / "d3d12.png")},
                                 240);
    return !run ? format(run.error()) : run->exitCode == 0 ? "" : "the Direct3D 12 sample failed: " + run->output;
}

/// All pictures, drawn once.
struct Pictures {
    std::string missing;
    std::string failure;
    Image vulkan;
    Image direct3D9;
    Image direct3D12;
};

Pictures draw() {
    Pictures pictures{.missing = missing()};
    if (!pictures.missing.empty()) return pictures;
    fs::remove_all(kFolder);
    fs::create_directories(kFolder);
    pictures.failure = runVulkan();
    if (pictures.failure.empty()) pictures.failure = runDirect3D9();
    if (pictures.failure.empty()) pictures.failure = runDirect3D12();
    if (!pictures.failure.empty()) return pictures;
    auto vulkan = loadImage(kFolder / "vulkan.png");
    auto direct3D9 = loadImage(kFolder / "d3d9.png");
    auto direct3D12 = loadImage(kFolder / "d3d12.png");
    for (const auto* image : {&vulkan, &direct3D9, &direct3D12})
        if (!*image) pictures.failure = format(image->error());
    if (!pictures.failure.empty()) return pictures;
    pictures.vulkan = std::move(*vulkan);
    pictures.direct3D9 = std::move(*direct3D9);
    pictures.direct3D12 = std::move(*direct3D12);
    return pictures;
}

class Samples : public testing::Test {
protected:
    void SetUp() override {
        static const Pictures drawn = draw();
        if (!drawn.missing.empty()) GTEST_SKIP() << drawn.missing;
        ASSERT_EQ(drawn.failure, "");
        pictures_ = &drawn;
    }
    [[nodiscard]] const Image& vulkan() const { return pictures_->vulkan; }
    [[nodiscard]] const Image& direct3D9() const { return pictures_->direct3D9; }
    [[nodiscard]] const Image& direct3D12() const { return pictures_->direct3D12; }

private:
    const Pictures* pictures_ = nullptr;
};

/// Of the pixels brighter than the background and the shadow: the share whose red exceeds green, and green blue.
double skinShare(const Image& image) {
    constexpr float kLit = 0.35F;
    int lit = 0;
    int skin = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            if (image.at(x, y, 0) < kLit) continue;
            ++lit;
            skin += image.at(x, y, 0) > image.at(x, y, 1) && image.at(x, y, 1) > image.at(x, y, 2);
        }
    EXPECT_GT(lit, image.width * image.height / 20) << "the head fills more than a twentieth of the picture";
    return lit == 0 ? 0 : static_cast<double>(skin) / lit;
}

// Eyes are white; highlights are nearly so.
TEST_F(Samples, direct3d_9_draws_skin) {
    EXPECT_GT(skinShare(direct3D9()), 0.9);
}

TEST_F(Samples, direct3d_12_draws_skin) {
    EXPECT_GT(skinShare(direct3D12()), 0.9);
}

TEST_F(Samples, vulkan_draws_skin) {
    EXPECT_GT(skinShare(vulkan()), 0.9);
}

// The Direct3D samples make their own matrices, mip chains (in sRGB, not in linear light) and Stretch map, Direct3D 9 keeps radiance as
// halves: one of the display's 255 steps nearly everywhere, more at the outline, the eyes and the edge of shadow.
void expectTheSame(const Image& drawn, const Image& vulkan) {
    ASSERT_EQ(drawn.width, vulkan.width);
    ASSERT_EQ(drawn.height, vulkan.height);
    constexpr double kSteps = 4.5 / 255;
    int apart = 0;
    double sum = 0;
    for (int y = 0; y < vulkan.height; ++y)
        for (int x = 0; x < vulkan.width; ++x) {
            double largest = 0;
            for (int channel = 0; channel < 3; ++channel)
                largest = std::max(largest, static_cast<double>(std::abs(drawn.at(x, y, channel) - vulkan.at(x, y, channel))));
            apart += largest > kSteps;
            sum += largest;
        }
    const double pixels = static_cast<double>(vulkan.width) * vulkan.height;
    EXPECT_LT(apart / pixels, 0.01);
    EXPECT_LT(sum / pixels, 1.5 / 255);
}

TEST_F(Samples, direct3d_9_draws_the_picture_of_vulkan) {
    expectTheSame(direct3D9(), vulkan());
}

TEST_F(Samples, direct3d_12_draws_the_picture_of_vulkan) {
    expectTheSame(direct3D12(), vulkan());
}

} // namespace
} // namespace tegument::test
