// Effects of other hosts against Microsoft: the picture of the respelt shaders on Vulkan beside that of the binary which Microsoft's
// compiler makes of the same file, drawn by ID3DXEffect of Direct3D 9 with the same values.

#include "tests/d3d/cases.h"
#include "tools/direct3d9/reference.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

constexpr int kSide = 160;
constexpr std::size_t kLeast = 20;

/// Where the two differ, and why.
const std::map<std::string, std::string>& explained() {
    static const std::map<std::string, std::string> kAll = {
        {"cloth_volume", "a picture of two dimensions stands in for volumes, which Direct3D 9 reads otherwise"},
        {"volume_noise", "likewise"},
        {"fetches", "tex1D of a picture of two dimensions: the column that Direct3D 9 reads is what else stands in the register"},
        {"fetch_water_projected",
         "anisotropic look-ups with gradients of the shader's own: Mesa's software device draws nothing of use, and dies of "
         "them on Vulkan, where this host leaves the anisotropy out"},
        {"gamebryo_like", "its first technique is assembly with VertexShaderConstant, of which Microsoft's binary draws nothing in Wine; "
                          "the cause is not known"},
        {"odd_spelling", "Microsoft's compiler takes a switch over a constant for its default in shader model 3"},
    };
    return kAll;
}

fs::path folder() {
    return drawings().parent_path() / "foreign";
}

/// Seen as tegument render shows foreign effects.
Workspace workspaceFor() {
    Workspace workspace;
    workspace.camera.position = {2.4F, 1.2F, 5.6F};
    workspace.camera.target = {0, 0, 0};
    workspace.camera.horizontalFov = 25;
    workspace.camera.nearPlane = 0.1F;
    workspace.camera.farPlane = 100;
    workspace.cameraRelative = false;
    return workspace;
}

std::vector<ReferencePicture> all() {
    std::vector<ReferencePicture> list;
    for (const auto& entry : fs::directory_iterator("tests/adopt/effects"))
        if (entry.path().extension() == ".fx") list.push_back({.name = entry.path().stem().string(), .file = entry.path()});
    std::ranges::sort(list, {}, &ReferencePicture::name);
    return list;
}

std::string missing() {
    if (std::string reason = direct3dClientMissing(); !reason.empty()) return reason;
    return compilerAvailable(Compiler::Dxc) ? "" : "DXC was left out of this build (./bootstrap test brings it)";
}

TEST(ForeignPicture, is_that_of_microsofts_binary) {
    if (const std::string reason = missing(); !reason.empty()) GTEST_SKIP() << reason;
    auto device = gpu::Device::create({});
    ASSERT_TRUE(device) << format(device.error());
    fs::remove_all(folder());
    fs::create_directories(folder());
    const Mesh mesh = ball();
    std::vector<ReferencePicture> list = all();
    const RunOptions options{.width = kSide, .height = kSide, .compiler = Compiler::Dxc};
    for (ReferencePicture& picture : list)
        drawForReference(*device, picture, &mesh, workspaceFor(), options, folder());
    const auto drawn = drawByMicrosoft(list, folder());
    ASSERT_TRUE(drawn) << format(drawn.error());
    std::size_t agree = 0;
    std::size_t compared = 0;
    for (const ReferencePicture& picture : list) {
        if (!picture.why.empty()) {
            fmt::print("{:<28} not compared: {}\n", picture.name, picture.why);
            continue;
        }
        const auto error = referenceError(folder(), picture.name);
        ASSERT_TRUE(error) << format(error.error());
        ++compared;
        agree += error->equal() ? 1 : 0;
        fmt::print("{:<28} {:.2f} % of the pixels differ\n", picture.name, error->share * 100);
        if (!explained().contains(picture.name)) {
            EXPECT_TRUE(error->equal()) << picture.name;
        }
    }
    fmt::print("{} of {} agree\n", agree, compared);
    EXPECT_GE(compared, kLeast);
    EXPECT_GE(static_cast<double>(agree), 0.9 * static_cast<double>(compared));
}

} // namespace
} // namespace tegument::test
