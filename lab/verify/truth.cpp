#include "lab/verify/truth.h"

#include "host/run/semantics.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::verify {

namespace {

reference::Pinhole cameraOf(const PlacedScene& placed, int size) {
    return reference::pinhole(glm::dvec3(placed.camera.position), glm::dvec3(placed.camera.target), glm::dvec3(placed.camera.up),
                              glm::radians(static_cast<double>(placed.camera.horizontalFov)), size, size);
}

} // namespace

Truth truthOf(const Scene& scene, const VerifyOptions& options) {
    const PlacedScene placed = placeScene(scene.workspace, scene.mesh.bounds);
    const auto light = reference::lightView(placed.light, scene.mesh.bounds, options.mapSize);
    const Matrices planes = lightMatrices(placed.light, scene.mesh.bounds);
    return {.camera = cameraOf(placed, options.pictureSize),
            .light = light,
            .lightNear = static_cast<double>(planes.nearPlane),
            .lightFar = static_cast<double>(planes.farPlane),
            .skin = reference::SkinScene(scene.mesh, light, glm::dvec3(placed.light.color), reference::skinSettings(options.setting))};
}

double Truth::zOverW(const glm::dvec3& point) const {
    const double along = glm::dot(point - light.eye, light.forward);
    const double share = (along - lightNear) / (lightFar - lightNear);
    return light.parallel ? share : share * lightFar / along;
}

Seen look(const reference::SkinScene& skin, const reference::Pinhole& view) {
    Seen seen{.width = view.width, .height = view.height};
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const auto hit = skin.rays().nearest(view.start(x, y), view.ray(x, y));
            seen.pixels.push_back(hit ? std::optional(reference::interpolate(skin.mesh(), hit->place)) : std::nullopt);
            seen.distances.push_back(hit ? hit->distance : 0);
        }
    return seen;
}

Seen lookUnwrapped(const Mesh& mesh, int size) {
    Seen seen{.width = size, .height = size};
    for (const auto& place : reference::unwrap(mesh, size).texels)
        seen.pixels.push_back(place ? std::optional(reference::interpolate(mesh, *place)) : std::nullopt);
    seen.distances.assign(seen.pixels.size(), 0);
    return seen;
}

std::vector<std::uint8_t> covered(const Seen& seen) {
    std::vector<std::uint8_t> mask;
    for (const auto& pixel : seen.pixels)
        mask.push_back(pixel ? 1 : 0);
    return mask;
}

std::vector<std::uint8_t> interior(const Seen& seen) {
    constexpr double kOneSurface = 0.05;
    std::vector<std::uint8_t> mask(seen.pixels.size(), 0);
    for (int y = 1; y + 1 < seen.height; ++y)
        for (int x = 1; x + 1 < seen.width; ++x) {
            const auto& here = seen.pixels[seen.index(x, y)];
            bool same = here.has_value();
            for (int j = -1; j <= 1 && same; ++j)
                for (int i = -1; i <= 1 && same; ++i) {
                    const auto& there = seen.pixels[seen.index(x + i, y + j)];
                    same = there && glm::length(there->uv - here->uv) < kOneSurface;
                }
            mask[seen.index(x, y)] = same ? 1 : 0;
        }
    return mask;
}

std::vector<std::uint8_t> awayFromShadowEdges(const Truth& truth, const Seen& seen) {
    auto mask = interior(seen);
    for (std::size_t i = 0; i < mask.size(); ++i)
        if (mask[i] != 0 && truth.skin.nearShadowEdge(*seen.pixels[i], kShadowEdge)) mask[i] = 0;
    return mask;
}

/// Points turned away from the light whose way through the body the map can tell: its neighbours three texels away are crossed by nearly
/// the same length.
bool thicknessIsKnown(const Truth& truth, const reference::SurfacePoint& point) {
    constexpr double kJump = 3; // mm
    const auto here = truth.skin.entry(point);
    const glm::dvec3 l = truth.skin.toLight(point);
    const glm::dvec3 normal = glm::normalize(point.normal);
    if (!here || glm::dot(normal, l) > -0.15) return false;
    const double step = kShadowEdge * truth.light.footprint(glm::dot(point.position - truth.light.eye, truth.light.forward));
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
            reference::SurfacePoint there = point;
            const glm::dvec3 sideways = step * (static_cast<double>(i) * truth.light.right + static_cast<double>(j) * truth.light.up);
            there.position += sideways - l * (glm::dot(normal, sideways) / glm::dot(normal, l));
            const auto entry = truth.skin.entry(there);
            if (!entry || std::abs(entry->path - here->path) > kJump) return false;
        }
    return true;
}

Image rgb(const Image& image) {
    Image three = plainImage(image.width, image.height, 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c)
                three.at(x, y, c) = image.at(x, y, c);
    return three;
}

Image channel(const Image& image, int which) {
    Image one = plainImage(image.width, image.height, 1);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            one.at(x, y, 0) = image.at(x, y, which);
    return one;
}

void noteApart(ModuleReport& report, const std::string& subject, const std::vector<std::uint8_t>& counts,
               const std::vector<std::uint8_t>& covered, const std::string& why) {
    report.notes.push_back(fmt::format("{}: {:.1f} % of what is covered is left out: {}", subject, 100 * shareApart(counts, covered), why));
}

} // namespace tegument::verify
