#include "lab/measure/flat_fur.h"

#include "host/image/dds.h"
#include "lab/measure/flat_view.h"

#include <fmt/format.h>

#include <cmath>
#include <unistd.h>

namespace tegument::measure {

namespace {

namespace fs = std::filesystem;

constexpr int kMapSize = 1280; // 32 texels a spacing
constexpr double kSkin = 0.05; // what exact rays show (truth), as albedo of the skin ...
constexpr double kRoot = 0.15; // ... and of strands, which the map's colour makes brighter than the skin
constexpr double kTip = 1;

fs::path mapFile(const fs::path& folder) {
    return folder / "patch.dds";
}

/// All of it is `value`.
Image evenFace(int size, double value) {
    return plainImage(size, size, 4, static_cast<float>(value));
}

/// Seen from the middle of a cube whose +Z face is the patch, directions are places on it.
Image face(const reference::FurPatch& patch, int size) {
    Image image = evenFace(size, kRoot / kSkin);
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column) {
            const auto place = [&](int i) { return kPatchHalf * (2 * (i + 0.5) / size - 1); };
            image.at(column, row, 3) = static_cast<float>(reference::heightOver(patch, place(column), -place(row)));
        }
    return image;
}

/// Two levels, the coarse one exact like the fine one: a mean of heights would be a map of other strands.
Result<void> writeMap(const fs::path& folder, const reference::FurPatch& patch) {
    DdsTexture cube{.format = DdsFormat::Rgba16F, .faces = 6, .mips = 2};
    for (int side = 0; side < 6; ++side)
        for (const int size : {kMapSize, kMapSize / 2}) {
            constexpr int kAhead = 4; // +Z
            cube.images.push_back(side == kAhead ? face(patch, size) : evenFace(size, 0));
        }
    return writeDds(mapFile(folder), cube);
}

Mesh plane() {
    constexpr float kEdge = static_cast<float>(kPatchHalf);
    Mesh mesh;
    mesh.name = "patch";
    mesh.positions = {{-kEdge, -kEdge, 0}, {kEdge, -kEdge, 0}, {kEdge, kEdge, 0}, {-kEdge, kEdge, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.parts = {{.name = "patch", .firstIndex = 0, .indexCount = 6}};
    computeTangents(mesh);
    computeBounds(mesh);
    return mesh;
}

/// Mean of samples x samples values.
std::vector<double> reduced(const std::vector<double>& fine, const reference::FurView& view) {
    const int side = view.size * view.samples;
    std::vector<double> picture(static_cast<std::size_t>(view.size) * static_cast<std::size_t>(view.size), 0.0);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            picture[static_cast<std::size_t>(y / view.samples * view.size + x / view.samples)] +=
                fine[static_cast<std::size_t>(y * side + x)] / (view.samples * view.samples);
    return picture;
}

} // namespace

FlatFur::FlatFur(gpu::Device& device, const reference::FurPatch& patch)
    : device_(&device), patch_(patch), folder_(fs::temp_directory_path() / fmt::format("tegument-flat-fur-{}", ::getpid())) {}

FlatFur::FlatFur(FlatFur&& other) noexcept
    : device_(other.device_), patch_(other.patch_), folder_(std::exchange(other.folder_, fs::path())) {}

FlatFur& FlatFur::operator=(FlatFur&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(patch_, other.patch_);
    std::swap(folder_, other.folder_);
    return *this;
}

FlatFur::~FlatFur() {
    std::error_code code;
    if (!folder_.empty()) fs::remove_all(folder_, code);
}

Result<FlatFur> FlatFur::create(gpu::Device& device, const reference::FurPatch& patch) {
    FlatFur flat(device, patch);
    if (const auto written = writeMap(flat.folder_, patch); !written) return written.error();
    return flat;
}

Result<std::vector<double>> FlatFur::draw(const reference::FurView& view, int layers, double spread) const {
    // A ball whose radius is the coat's height times 10, its centre where the map's middle is.
    constexpr double kLength = 0.1;
    const double tip = kSkin * kTip / kRoot;
    const auto effect = loadEffect("effects/Fur.fx");
    if (!effect) return effect.error();
    const Mesh mesh = plane();
    const int side = view.size * view.samples;
    const auto run = runEffect(*device_, *effect, &mesh, flatView(view, patch_.coat),
                               {.technique = "CubePosition",
                                .width = side,
                                .height = side,
                                .compiler = defaultCompiler(),
                                .parameters = {{"gBoundingCenter", {0, 0, -kPatchHalf}},
                                               {"gMeshRadius", {patch_.coat / kLength}},
                                               {"gFurLength", {kLength}},
                                               {"gFurLayers", {static_cast<double>(layers)}},
                                               {"gFurSpread", {spread}},
                                               {"gFurTaper", {1}},
                                               {"gFurSoftness", {0}},
                                               {"gFurAlphaTest", {0.5}},
                                               {"gFurLean", {0}},
                                               {"gFurKajiyaKay", {0}},
                                               {"gFurRootColor", {kSkin, kSkin, kSkin}},
                                               {"gFurTipColor", {tip, tip, tip}}},
                                .textures = {{"gFurCubeMap", mapFile(folder_).string()}}});
    if (!run) return run.error();
    std::vector<double> fine;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            fine.push_back(static_cast<double>(run->image.at(x, y, 0)));
    return reduced(fine, view);
}

std::vector<double> FlatFur::truth(const reference::FurView& view) const {
    std::vector<double> fine = exactHits(patch_, view);
    for (double& value : fine)
        value = value == reference::kNoHit ? kSkin : kRoot + (kTip - kRoot) * value;
    return reduced(fine, view);
}

} // namespace tegument::measure
