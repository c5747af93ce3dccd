// effects/FurRoots.fx, technique Roots, on the flat patch whose picture is known: the patch's own cones as roots, drawn on the device,
// beside exact rays through the same pixels.

#include "host/image/dds.h"
#include "host/run/run.h"
#include "lab/measure/flat_view.h"
#include "lab/measure/plain_strands.h"
#include "lab/reference/fur_patch.h"
#include "meshprep/fur/roots/root_texture.h"
#include "tests/gpu/with_device.h"
#include "tests/run/slider_ends.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unistd.h>

namespace tegument::test {

namespace {

namespace fs = std::filesystem;
using reference::FurPatch;
using reference::FurView;

Mesh plane() {
    constexpr auto kEdge = static_cast<float>(measure::kPatchHalf);
    Mesh mesh;
    mesh.positions = {{-kEdge, -kEdge, 0}, {kEdge, -kEdge, 0}, {kEdge, kEdge, 0}, {-kEdge, kEdge, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.parts = {{.name = "patch", .firstIndex = 0, .indexCount = 6}};
    computeBounds(mesh);
    return mesh;
}

RootSet rootsOf(const FurPatch& patch, const Mesh& mesh) {
    RootSet set;
    for (int j = -measure::kPatchHalf; j < measure::kPatchHalf; ++j)
        for (int i = -measure::kPatchHalf; i < measure::kPatchHalf; ++i) {
            const reference::FurStrand strand = strandOf(patch, i, j);
            set.roots.push_back({.position = {static_cast<float>(strand.x), static_cast<float>(strand.y), 0},
                                 .radius = static_cast<float>(patch.baseRadius),
                                 .share = static_cast<float>(strand.length),
                                 .limit = 1000});
        }
    set.wanted = set.roots.size();
    set.area = 4.0 * measure::kPatchHalf * measure::kPatchHalf;
    set.density = 1;
    set.radius = patch.baseRadius;
    set.reach = 1.5;
    set.cell = 1;
    set.centre = glm::dvec3(mesh.bounds.centre);
    set.ballRadius = static_cast<double>(mesh.bounds.radius);
    return set;
}

/// The roots as a file of its own, removed in the end.
class RootFile {
public:
    explicit RootFile(const Image& image)
        : path_(fs::temp_directory_path() / fmt::format("tegument-swept-{}-{}.dds", ::getpid(), nextNumber())),
          written_(writeDds(path_, makeDds(image, DdsFormat::Rgba32F, false))) {}
    ~RootFile() {
        std::error_code code;
        fs::remove(path_, code);
    }
    RootFile(const RootFile&) = delete;
    RootFile& operator=(const RootFile&) = delete;
    [[nodiscard]] const Result<void>& written() const { return written_; }
    [[nodiscard]] std::string path() const { return path_.string(); }

private:
    static int nextNumber() {
        static int number = 0;
        return ++number;
    }
    fs::path path_;
    Result<void> written_;
};

/// Seen from the side of -x.
/// No light but the fill's.
Workspace workspaceOf(const FurPatch& patch, const FurView& view) {
    Workspace workspace = measure::flatView(view, patch.coat);
    workspace.light.color = glm::vec3(0);
    return workspace;
}

/// Brightness: `root` to `tip` along a strand, the skin as dark as roots.
struct Shades {
    double root = 0;
    double tip = 1;
};

std::vector<double> drawn(gpu::Device& device, const FurPatch& patch, const FurView& view, const Shades& shades, int fewest = 4) {
    const Mesh mesh = plane();
    RootSet set = rootsOf(patch, mesh);
    const auto texture = buildRootTexture(set);
    EXPECT_TRUE(texture) << format(texture.error());
    const RootFile file(texture->image);
    EXPECT_TRUE(file.written()) << format(file.written().error());
    const auto effect = loadEffect("effects/FurRoots.fx");
    EXPECT_TRUE(effect) << format(effect.error());
    auto parameters =
        measure::plainStrands(patch.coat / static_cast<double>(mesh.bounds.radius), patch.baseRadius, shades.root, shades.tip);
    parameters["gFurLayers"] = {32};
    parameters["gFurFewest"] = {static_cast<double>(fewest)};
    const auto run = runEffect(device, *effect, &mesh, workspaceOf(patch, view),
                               {.technique = "Roots",
                                .width = view.size,
                                .height = view.size,
                                .compiler = defaultCompiler(),
                                .parameters = parameters,
                                .textures = {{"gFurRootsMap", file.path()}}});
    EXPECT_TRUE(run) << format(run.error());
    std::vector<double> picture;
    for (int y = 0; run && y < view.size; ++y)
        for (int x = 0; x < view.size; ++x)
            picture.push_back(static_cast<double>(run->image.at(x, y, 0)));
    return picture;
}

/// By exact rays, samples x samples a pixel.
std::vector<double> truth(const FurPatch& patch, const FurView& view, const Shades& shades) {
    const std::vector<double> hits = measure::exactHits(patch, view);
    const int side = view.size * view.samples;
    std::vector<double> picture(static_cast<std::size_t>(view.size) * static_cast<std::size_t>(view.size), 0.0);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double hit = hits[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x)];
            picture[static_cast<std::size_t>(y / view.samples * view.size + x / view.samples)] +=
                (hit == reference::kNoHit ? shades.root : std::lerp(shades.root, shades.tip, hit)) / (view.samples * view.samples);
        }
    return picture;
}

FurView viewOf(double degrees, double pixel) {
    return {.tilt = degrees * std::numbers::pi / 180, .pixel = pixel, .size = static_cast<int>(std::lround(4 / pixel)), .samples = 8};
}

class Swept : public WithDevice {};

TEST_F(Swept, layers_show_strands_where_and_as_high_as_exact_rays_meet_them) {
    const Shades shades{.root = 0.1, .tip = 1};
    // From above 4 layers are drawn, at 60 degrees 8: segments of up to 3.5 spacings.
    for (const double tilt : {0.0, 30.0, 45.0, 60.0}) {
        const FurPatch patch{.coat = 8, .shortest = 1};
        const FurView view = viewOf(tilt, 0.0625);
        const auto error = reference::furError(drawn(*device_, patch, view, shades), truth(patch, view, shades));
        // One sample a pixel of a sixteenth of a spacing: what edges are off by within it, and pixels shared by strands.
        EXPECT_LT(error.rms, 0.02) << tilt << " degrees";
        EXPECT_LT(std::abs(error.bias), 0.004) << tilt << " degrees";
    }
}

TEST_F(Swept, as_many_layers_as_the_view_asks_for_show_what_all_do) {
    const FurPatch patch{.coat = 8, .shortest = 1};
    const Shades shades{.root = 0.1, .tip = 1};
    for (const double tilt : {0.0, 45.0}) {
        const FurView view = viewOf(tilt, 0.125);
        const auto few = drawn(*device_, patch, view, shades);
        const auto all = drawn(*device_, patch, view, shades, 32);
        const auto error = reference::furError(few, all);
        // From above the edge of a strand is shared by layers, each of which shows its own height of it: a pixel is an eighth of a spacing,
        // a third of the radius.
        EXPECT_LT(error.rms, 0.02) << tilt << " degrees";
    }
}

/// The picture of a technique on the patch, seen aslant.
std::vector<float> aslant(gpu::Device& device, const std::string& technique, const std::map<std::string, std::vector<double>>& parameters) {
    const auto effect = loadEffect("effects/FurRoots.fx", {.defines = {{"TEGUMENT_MAP_SIZE", "64"}}});
    EXPECT_TRUE(effect) << format(effect.error());
    const Mesh mesh = plane();
    const FurPatch patch{.coat = 2};
    RootSet set = rootsOf(patch, mesh);
    const auto texture = buildRootTexture(set);
    EXPECT_TRUE(texture) << format(texture.error());
    const RootFile file(texture->image);
    Workspace workspace;
    workspace.head = false;
    workspace.camera.position = {1, 1, 3};
    workspace.camera.target = glm::vec3(0);
    RunOptions options{.technique = technique, .width = 32, .height = 32, .compiler = defaultCompiler(), .parameters = parameters};
    options.parameters.try_emplace("gFurLayers", std::vector<double>{8});
    options.textures["gFurRootsMap"] = file.path();
    const auto run = runEffect(device, *effect, &mesh, workspace, options);
    EXPECT_TRUE(run) << format(run.error());
    return run ? run->image.pixels : std::vector<float>();
}

TEST_F(Swept, every_slider_s_ends_leave_the_picture_finite) {
    const auto effect = loadEffect("effects/FurRoots.fx");
    ASSERT_TRUE(effect) << format(effect.error());
    const std::vector<SliderEnd> ends = sliderEnds(*effect);
    for (const SliderEnd& end : ends)
        for (const char* technique : {"Cellular", "Roots"}) {
            const auto pixels = aslant(*device_, technique, {{end.parameter, {end.value}}});
            EXPECT_TRUE(std::ranges::all_of(pixels, [](float v) { return std::isfinite(v); }))
                << technique << ", " << end.parameter << " = " << end.value;
        }
    EXPECT_GE(ends.size(), 40U);
}

} // namespace

} // namespace tegument::test
