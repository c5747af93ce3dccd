#include "lab/reference/bssrdf.h"

#include "host/support/cache.h"
#include "host/support/parallel.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace tegument::reference {

namespace fs = std::filesystem;

namespace {

void addMesh(CacheKey& key, const Mesh& mesh) {
    key.add(mesh.positions);
    key.add(mesh.normals);
    key.add(mesh.tangents);
    key.add(mesh.uvs);
    key.add(mesh.indices);
    for (const EmbeddedTexture& texture : mesh.textures) {
        key.add(texture.role);
        key.add(texture.image.width);
        key.add(texture.image.channels);
        key.add(texture.image.pixels);
    }
}

/// A function has no content; its values have.
void addProfile(CacheKey& key, const RadialProfile& profile) {
    constexpr int kValues = 256;
    key.add(profile.reach);
    key.add(profile.finest);
    for (int i = 0; i < kValues; ++i)
        key.add(profile.density(profile.reach * (i + 0.5) * (i + 0.5) / (kValues * kValues)));
    if (profile.flesh != glm::dvec3(0)) key.add(profile.flesh);
}

/// Of everything that D depends on: mesh, maps, light, settings, profile, quadrature, points.
fs::path diffusedFile(const SkinScene& scene, std::span<const ShadedPoint> points, const BssrdfOptions& options) {
    CacheKey key("bssrdf 4"); // take another number with every change of what is computed
    addMesh(key, scene.mesh());
    addProfile(key, options.profile);
    key.add(scene.light().eye);
    key.add(scene.lightColour());
    const SkinSettings& settings = scene.settings();
    key.add(settings.mix);
    key.add(settings.roughness); // of rho_dt
    key.add(settings.attenuation);
    key.add(settings.fresnel0);
    key.add(settings.printedAlbedo);
    key.add(scene.more().lamps);
    key.add(scene.more().lampSide);
    key.add(scene.more().diffuseSky);
    key.add(options.quadrature.fineness);
    key.add(options.quadrature.negligible);
    key.add(options.quadrature.halvings);
    key.add(points.size());
    for (const ShadedPoint& point : points) {
        key.add(point.point.place.triangle);
        key.add(point.point.place.weights);
    }
    return fs::path("reference") / (key.text() + ".bin");
}

/// Bits of x and y by turns: neighbours along the curve are neighbours in the picture.
std::uint64_t zOrder(int x, int y) {
    std::uint64_t key = 0;
    for (unsigned bit = 0; bit < 16; ++bit) {
        key |= ((static_cast<std::uint64_t>(x) >> bit) & 1U) << (2 * bit);
        key |= ((static_cast<std::uint64_t>(y) >> bit) & 1U) << (2 * bit + 1);
    }
    return key;
}

/// SplitMix64.
std::uint64_t mixed(std::uint64_t value) {
    value += 0x9e3779b97f4a7c15U;
    value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9U;
    value = (value ^ (value >> 27U)) * 0x94d049bb133111ebU;
    return value ^ (value >> 31U);
}

std::vector<ShadedPoint> coveredPixels(const SkinScene& scene, const Pinhole& camera) {
    std::vector<std::vector<ShadedPoint>> rows(static_cast<std::size_t>(camera.height));
    forEachInParallel(rows.size(), [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < camera.width; ++x)
            if (const auto hit = scene.rays().nearest(camera.eye, camera.ray(x, y)))
                rows[row].push_back({x, y, interpolate(scene.mesh(), hit->place)});
    });
    std::vector<ShadedPoint> all;
    for (const auto& row : rows)
        all.insert(all.end(), row.begin(), row.end());
    return all;
}

constexpr double kSkin = 0.5; // of the colour map's alpha: more is skin

bool isSkin(const SkinScene& scene, const SurfacePoint& point) {
    return scene.colour(point).w > kSkin;
}

/// E of docs/design/skin.md, without a ray where the surface is turned away.
Irradiance enteringSkin(const SkinScene& scene) {
    return [&scene](const SurfacePoint& point) {
        if (!isSkin(scene, point)) return glm::dvec3(0);
        const glm::dvec3 light = scene.entering(point, true);
        const glm::dvec3 more = scene.more().none() ? glm::dvec3(0) : scene.enteringMore(point);
        return more + (light != glm::dvec3(0) && scene.lit(point) ? light : glm::dvec3(0));
    };
}

std::vector<Diffused> diffuseAll(const SkinScene& scene, std::span<const ShadedPoint> points, const BssrdfOptions& options) {
    const fs::path file = options.cached ? diffusedFile(scene, points, options) : fs::path();
    if (options.cached)
        if (auto known = loadCachedList<Diffused>(file); known && known->size() == points.size()) return std::move(*known);
    const Irradiance irradiance = enteringSkin(scene);
    std::vector<Diffused> all(points.size());
    const auto one = [&](std::size_t i) {
        const SurfacePoint& point = points[i].point;
        if (scene.colour(point).w > 0)
            all[i] = diffuse(scene.rays(), irradiance, options.profile, point.position, options.quadrature, glm::normalize(point.normal));
    };
    forEachInParallel(points.size(), one, options.progress);
    if (options.cached) storeCached(file, bytesOf(all));
    return all;
}

Radiance towardsEye(const SkinScene& scene, const SurfacePoint& point, const glm::dvec3& eye, const Diffused& diffused) {
    const bool lit = scene.lit(point);
    const glm::dvec3 normal = scene.mappedNormal(point);
    const glm::dvec4 colour = scene.colour(point);
    const double facing = lit ? std::max(0.0, glm::dot(normal, scene.toLight(point))) : 0;
    const glm::dvec3 plain = glm::dvec3(colour) * scene.lightColour() * facing;
    const bool alone = scene.more().none();
    const glm::dvec3 plainMore = alone || colour.w >= 1 ? glm::dvec3(0) : scene.plainMore(point);
    const glm::dvec3 mirroredMore = alone ? glm::dvec3(0) : scene.reflectedMore(point, normal, eye);
    return {.diffuse = glm::mix(plain + plainMore, diffused.light * scene.leaving(point, eye), colour.w),
            .specular = scene.reflected(point, normal, eye, lit) + mirroredMore,
            .share = diffused.share};
}

} // namespace

std::vector<ShadedPoint> spreadEvenly(std::vector<ShadedPoint> points, std::size_t count, std::uint64_t seed) {
    if (count == 0 || count >= points.size()) return points;
    std::ranges::sort(points, {}, [](const ShadedPoint& p) { return zOrder(p.x, p.y); });
    std::vector<ShadedPoint> chosen;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t first = i * points.size() / count;
        const std::size_t last = (i + 1) * points.size() / count;
        chosen.push_back(points[first + mixed(mixed(seed) + i) % (last - first)]);
    }
    return chosen;
}

std::vector<ShadedPoint> visiblePoints(const SkinScene& scene, const Pinhole& camera, std::size_t count, std::uint64_t seed) {
    return spreadEvenly(coveredPixels(scene, camera), count, seed);
}

std::vector<Radiance> radiance(const SkinScene& scene, std::span<const ShadedPoint> points, const glm::dvec3& eye,
                               const BssrdfOptions& options) {
    const std::vector<Diffused> diffused = diffuseAll(scene, points, options);
    std::vector<Radiance> all;
    for (std::size_t i = 0; i < points.size(); ++i)
        all.push_back(towardsEye(scene, points[i].point, eye, diffused[i]));
    return all;
}

} // namespace tegument::reference
