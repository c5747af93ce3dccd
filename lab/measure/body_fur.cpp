#include "lab/measure/body_fur.h"

#include "host/image/dds.h"
#include "host/mesh/triangles.h"
#include "host/support/parallel.h"
#include "lab/measure/plain_strands.h"
#include "lab/reference/pinhole.h"
#include "meshprep/fur/roots/root_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unistd.h>

namespace tegument::measure {

namespace {

namespace fs = std::filesystem;
using reference::FurBody;
using reference::onFurBody;

constexpr double kAway = 40; // of the eye, mm
constexpr int kAlong = 384;  // quads of the mesh: it leaves the surface by less than a thousandth of a coat
constexpr int kAcross = 192;

/// Point of the surface: `u` along the ring, `v` along the tube's circle (a ball: from pole to pole), in turns.
glm::dvec3 pointOf(const FurBody& body, double u, double v) {
    const double a = 2 * std::numbers::pi * u;
    const double b = 2 * std::numbers::pi * v;
    const double across = body.ring + body.radius * std::cos(b);
    return {across * std::cos(a), body.radius * std::sin(b), -across * std::sin(a)};
}

Mesh meshOf(const FurBody& body) {
    Mesh mesh;
    mesh.name = "body";
    const double first = body.ring > 0 ? -0.5 : -0.25;
    for (int j = 0; j <= kAcross; ++j)
        for (int i = 0; i <= kAlong; ++i) {
            const glm::dvec3 p = pointOf(body, static_cast<double>(i) / kAlong, first * (1 - 2.0 * j / kAcross));
            mesh.positions.emplace_back(p);
            mesh.normals.emplace_back(onFurBody(body, p).normal);
        }
    addGrid(mesh.indices, kAlong, kAcross, "abdadc");
    mesh.parts = {{.name = mesh.name, .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    computeBounds(mesh);
    return mesh;
}

} // namespace

struct BodyFur::Body {
    gpu::Device& device;
    FurBody body;
    BodyCoat coat;
    Mesh mesh;
    fs::path file;
    std::unique_ptr<reference::FurOnBody> strands;

    Body(gpu::Device& on, const FurBody& shape, const BodyCoat& of, fs::path roots)
        : device(on), body(shape), coat(of), mesh(meshOf(shape)), file(std::move(roots)) {}
    Body(const Body&) = delete;
    Body& operator=(const Body&) = delete;
    ~Body() {
        std::error_code code;
        fs::remove(file, code);
    }

    Result<void> grow() {
        const double radius = static_cast<double>(mesh.bounds.radius);
        auto set = makeRoots(mesh, {.density = 1 / (coat.spacing * coat.spacing),
                                    .radius = coat.radius,
                                    .thinnest = 1,
                                    .shortest = coat.shortest,
                                    .curl = 0,
                                    .furLength = coat.length / radius});
        if (!set) return set.error();
        const auto texture = buildRootTexture(*set);
        if (!texture) return texture.error();
        std::vector<reference::FurCone> cones;
        for (const Root& root : set->roots) {
            const auto place = onFurBody(body, glm::dvec3(root.position));
            cones.push_back({.root = place.skin,
                             .normal = place.normal,
                             .length = std::min(static_cast<double>(root.share) * coat.length, static_cast<double>(root.limit)),
                             .radius = static_cast<double>(root.radius)});
        }
        strands = std::make_unique<reference::FurOnBody>(body, coat.length, std::move(cones));
        return writeDds(file, makeDds(texture->image, DdsFormat::Rgba32F, false));
    }

    [[nodiscard]] Workspace workspace(const BodyView& view) const {
        const glm::dvec3 place = pointOf(body, 0, view.around / (2 * std::numbers::pi));
        const glm::dvec3 normal = onFurBody(body, place).normal;
        const glm::dvec3 alongRing(0, 0, -1);
        const glm::dvec3 sideways = view.across ? glm::cross(alongRing, normal) : alongRing;
        const glm::dvec3 target = place + 0.5 * coat.length * normal;
        Workspace workspace = worldWorkspace();
        workspace.camera.target = glm::vec3(target);
        workspace.camera.position = glm::vec3(target + kAway * (std::cos(view.tilt) * normal + std::sin(view.tilt) * sideways));
        workspace.camera.up = glm::vec3(view.across ? normal : glm::cross(normal, alongRing));
        workspace.camera.horizontalFov = static_cast<float>(glm::degrees(2 * std::atan(view.pixel * coat.spacing * view.size / 2 / kAway)));
        workspace.camera.nearPlane = static_cast<float>(kAway - 2 * (body.ring + body.radius + coat.length));
        workspace.camera.farPlane = static_cast<float>(kAway + 2 * (body.ring + body.radius + coat.length));
        workspace.light.position = workspace.camera.position;
        workspace.light.color = glm::vec3(0); // the fill's light alone
        return workspace;
    }
};

BodyFur::BodyFur(std::unique_ptr<Body> body) : body_(std::move(body)) {}
BodyFur::BodyFur(BodyFur&&) noexcept = default;
BodyFur& BodyFur::operator=(BodyFur&&) noexcept = default;
BodyFur::~BodyFur() = default;

Result<BodyFur> BodyFur::create(gpu::Device& device, const FurBody& body, const BodyCoat& coat) {
    static int count = 0;
    auto own = std::make_unique<Body>(device, body, coat,
                                      fs::temp_directory_path() / fmt::format("tegument-body-fur-{}-{}.dds", ::getpid(), ++count));
    if (const auto grown = own->grow(); !grown) return grown.error();
    return BodyFur(std::move(own));
}

Result<BodyPicture> BodyFur::draw(const BodyView& view, int layers, int fewest, bool fringes) const {
    const auto effect = loadEffect("effects/FurRoots.fx", {.defines = {{"TEGUMENT_MAP_SIZE", "16"}}});
    if (!effect) return effect.error();
    RunOptions options{.technique = "Roots", .width = view.size, .height = view.size, .compiler = defaultCompiler()};
    options.parameters =
        plainStrands(body_->coat.length / static_cast<double>(body_->mesh.bounds.radius), body_->coat.radius, kRootShade, 1);
    options.parameters["gFurLayers"] = {static_cast<double>(layers)};
    options.parameters["gFurFewest"] = {static_cast<double>(fewest)};
    options.parameters["gFurFringes"] = {fringes ? 1.0 : 0.0};
    options.parameters["gFurKajiyaKay"] = {1};
    options.textures = {{"gFurRootsMap", body_->file.string()}};
    const auto run = runEffect(body_->device, *effect, &body_->mesh, body_->workspace(view), options);
    if (!run) return run.error();
    BodyPicture picture;
    for (int y = 0; y < view.size; ++y)
        for (int x = 0; x < view.size; ++x) {
            picture.shade.push_back(static_cast<double>(run->image.at(x, y, 0)));
            picture.covered.push_back(static_cast<double>(run->image.at(x, y, 3)));
        }
    return picture;
}

BodyPicture BodyFur::truth(const BodyView& view, reference::FurShape shape) const {
    const Workspace workspace = body_->workspace(view);
    const int side = view.size * view.samples;
    const auto camera =
        reference::pinhole(glm::dvec3(workspace.camera.position), glm::dvec3(workspace.camera.target), glm::dvec3(workspace.camera.up),
                           glm::radians(static_cast<double>(workspace.camera.horizontalFov)), side, side);
    const auto pixels = static_cast<std::size_t>(view.size) * static_cast<std::size_t>(view.size);
    BodyPicture picture{.shade = std::vector<double>(pixels, 0.0), .covered = std::vector<double>(pixels, 0.0)};
    forEachInParallel(pixels, [&](std::size_t pixel) {
        const int x = static_cast<int>(pixel % static_cast<std::size_t>(view.size)) * view.samples;
        const int y = static_cast<int>(pixel / static_cast<std::size_t>(view.size)) * view.samples;
        const double share = 1.0 / (view.samples * view.samples);
        for (int j = 0; j < view.samples; ++j)
            for (int i = 0; i < view.samples; ++i)
                if (const auto hit = body_->strands->meet(camera.eye, camera.ray(x + i, y + j), shape)) {
                    picture.shade[pixel] += share * std::lerp(kRootShade, 1.0, hit->along);
                    picture.covered[pixel] += share;
                }
    });
    return picture;
}

BodyError bodyError(const BodyPicture& picture, const BodyPicture& truth, const BodyView& view) {
    BodyError error;
    double mean = 0;
    const auto count = static_cast<double>(truth.shade.size());
    for (std::size_t i = 0; i < truth.shade.size(); ++i) {
        const double difference = picture.shade[i] - truth.shade[i];
        error.rms += difference * difference / count;
        error.bias += difference / count;
        mean += truth.shade[i] / count;
        error.outline += std::abs(picture.covered[i] - truth.covered[i]) / view.size;
        error.outside += (picture.covered[i] - truth.covered[i]) / view.size;
    }
    error.rms = std::sqrt(error.rms);
    error.bias /= mean;
    return error;
}

} // namespace tegument::measure
