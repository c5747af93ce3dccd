// Layers of fur as the device draws them: at edges of triangles with several samples a pixel, and where one part's fringe lies before
// another part's coat.

#include "host/mesh/triangles.h"
#include "lab/measure/body_fur.h"
#include "tests/gpu/with_device.h"

#include "lab/reference/fur_body.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument::test {

namespace {

using FurDrawn = WithDevice;

/// A square of 200 mm in the plane z = 0, cut into so many quads along each side.
Mesh squareOf(int quads) {
    Mesh mesh;
    mesh.name = "square";
    for (int j = 0; j <= quads; ++j)
        for (int i = 0; i <= quads; ++i) {
            mesh.positions.emplace_back(200.0F * static_cast<float>(i) / static_cast<float>(quads) - 100,
                                        200.0F * static_cast<float>(j) / static_cast<float>(quads) - 100, 0);
            mesh.normals.emplace_back(0, 0, 1);
        }
    addGrid(mesh.indices, static_cast<std::uint32_t>(quads), static_cast<std::uint32_t>(quads), "abdadc");
    mesh.parts = {{.name = mesh.name, .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    computeBounds(mesh);
    return mesh;
}

/// Seen from above at 45 degrees, so near that the square fills the picture, and strands so fine that a pixel holds several of them: all
/// that differs between pixels is their place.
Result<Image> expected(gpu::Device& device, int quads) {
    const auto effect = loadEffect("effects/FurRoots.fx", {});
    if (!effect) return effect.error();
    const Mesh mesh = squareOf(quads);
    Workspace workspace = worldWorkspace();
    workspace.camera.position = {0, -300, 300};
    workspace.camera.target = {0, 0, 0};
    workspace.camera.horizontalFov = 12;
    workspace.light.position = {100, -200, 400};
    RunOptions options{.technique = "Cellular", .width = 48, .height = 48, .samples = 4, .compiler = defaultCompiler()};
    options.parameters = {{"gFurLayers", {8}}, {"gFurFewest", {8}}, {"gFurSpacing", {0.004}}, {"gFurLength", {0.03}}, {"gFurLean", {0}}};
    const auto run = runEffect(device, *effect, &mesh, workspace, options);
    if (!run) return run.error();
    return run->image;
}

} // namespace

TEST_F(FurDrawn, edges_of_triangles_do_not_show_with_several_samples) {
    const auto whole = expected(*device_, 1);
    ASSERT_TRUE(whole) << format(whole.error());
    const auto cut = expected(*device_, 96); // an edge through every pixel
    ASSERT_TRUE(cut) << format(cut.error());
    double off = 0;
    double sum = 0;
    for (int y = 0; y < whole->height; ++y)
        for (int x = 0; x < whole->width; ++x) {
            const double truth = static_cast<double>(whole->at(x, y, 1));
            off += std::pow(static_cast<double>(cut->at(x, y, 1)) - truth, 2);
            sum += truth * truth;
        }
    EXPECT_GT(sum, 0);
    // What is left: shading at centroids instead of centres, less than half a pixel aside. By derivatives of centroid places: 0.018.
    EXPECT_LT(std::sqrt(off / sum), 0.003);
}

TEST_F(FurDrawn, soft_fringes_show_the_coat_behind_them) {
    const auto fur = measure::BodyFur::create(*device_, {.ring = 2, .radius = 1}, {});
    ASSERT_TRUE(fur) << format(fur.error());
    const measure::BodyView view{
        .tilt = std::numbers::pi / 2, .around = 110 * std::numbers::pi / 180, .across = true, .pixel = 0.125, .size = 32, .samples = 4};
    const auto truth = fur->truth(view, reference::FurShape::Cones);
    const auto one = fur->draw(view, 32, 4, false);
    const auto two = fur->draw(view, 32, 4, true);
    ASSERT_TRUE(one) << format(one.error());
    ASSERT_TRUE(two) << format(two.error());
    int differing = 0;
    double offOne = 0;
    double offTwo = 0;
    for (std::size_t i = 0; i < truth.shade.size(); ++i) {
        if (std::abs(one->shade[i] - two->shade[i]) < 0.004) continue; // what 8 bits show
        ++differing;
        offOne += std::pow(one->shade[i] - truth.shade[i], 2);
        offTwo += std::pow(two->shade[i] - truth.shade[i], 2);
    }
    EXPECT_GT(differing, 20) << "a fringe runs through the picture";
    // 0.6 is measured; what is left is the outline's own error, of strands that lie half in a pixel.
    EXPECT_LT(std::sqrt(offTwo), 0.75 * std::sqrt(offOne)) << differing << " pixels";
}

} // namespace tegument::test
