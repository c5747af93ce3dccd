#include "meshprep/fur/roots/root_maps.h"

#include "host/support/file.h"

#include <algorithm>
#include <cmath>

namespace tegument {

namespace {

/// The texel of a face of Direct3D's cube that a direction meets: columns to the right, rows down, each 0..1.
struct FacePoint {
    int face = 0;
    glm::dvec2 uv{0};
};

FacePoint onCube(const glm::dvec3& d) {
    const glm::dvec3 a = glm::abs(d);
    if (a.x >= a.y && a.x >= a.z)
        return d.x > 0 ? FacePoint{0, glm::dvec2(-d.z, -d.y) / a.x * 0.5 + 0.5} : FacePoint{1, glm::dvec2(d.z, -d.y) / a.x * 0.5 + 0.5};
    if (a.y >= a.z)
        return d.y > 0 ? FacePoint{2, glm::dvec2(d.x, d.z) / a.y * 0.5 + 0.5} : FacePoint{3, glm::dvec2(d.x, -d.z) / a.y * 0.5 + 0.5};
    if (!(a.z > 0)) return {};
    return d.z > 0 ? FacePoint{4, glm::dvec2(d.x, -d.y) / a.z * 0.5 + 0.5} : FacePoint{5, glm::dvec2(-d.x, -d.y) / a.z * 0.5 + 0.5};
}

glm::dvec3 texel(const Image& image, int x, int y) {
    const auto channel = [&](int c) { return static_cast<double>(image.at(x, y, std::min(c, image.channels < 3 ? 0 : 2))); };
    return {channel(0), channel(1), channel(2)};
}

int addressed(int i, int size, bool repeats) {
    return repeats ? (i % size + size) % size : std::clamp(i, 0, size - 1);
}

glm::dvec3 bilinear(const Image& image, const glm::dvec2& uv, bool repeats) {
    const double x = uv.x * image.width - 0.5;
    const double y = uv.y * image.height - 0.5;
    const int column = static_cast<int>(std::floor(x));
    const int row = static_cast<int>(std::floor(y));
    const auto at = [&](int dx, int dy) {
        return texel(image, addressed(column + dx, image.width, repeats), addressed(row + dy, image.height, repeats));
    };
    const glm::dvec2 part(x - column, y - row);
    return glm::mix(glm::mix(at(0, 0), at(1, 0), part.x), glm::mix(at(0, 1), at(1, 1), part.x), part.y);
}

template <class Vector>
Vector interpolated(const FurSurface& surface, const SurfacePoint& point, const std::vector<Vector>& values) {
    const std::uint32_t* t = &surface.mesh().indices[3 * std::size_t{point.triangle}];
    using Number = typename Vector::value_type;
    const glm::vec<2, Number> weights(point.barycentric);
    return (1 - weights.x - weights.y) * values[t[0]] + weights.x * values[t[1]] + weights.y * values[t[2]];
}

} // namespace

Result<FurMap> FurMap::load(const std::filesystem::path& path) {
    const auto bytes = readFile(path);
    if (!bytes) return bytes.error();
    const std::span<const std::byte> span = std::as_bytes(std::span(*bytes));
    if (isDds(span)) {
        auto texture = decodeDds(span, path.string());
        if (!texture) return texture.error();
        return FurMap(*std::move(texture));
    }
    auto image = decodeImage(span, path.string());
    if (!image) return image.error();
    return FurMap(DdsTexture{.images = {*std::move(image)}});
}

glm::dvec3 FurMap::at(const FurSurface& surface, const SurfacePoint& point) const {
    if (!ofVertices_.empty()) return interpolated(surface, point, ofVertices_);
    if (texture_.isCube()) {
        const FacePoint on = onCube(glm::dvec3(point.position));
        return bilinear(texture_.at(on.face, 0), on.uv, false);
    }
    const glm::dvec2 uv(interpolated(surface, point, surface.mesh().uvs));
    return bilinear(texture_.at(0, 0), uv - glm::floor(uv), true);
}

double shareAt(const FurMap& map, const FurSurface& surface, const SurfacePoint& point) {
    return std::clamp(map.at(surface, point).x, 0.0, 1.0);
}

glm::dvec3 directionAt(const FurMap& map, const FurSurface& surface, const SurfacePoint& point) {
    const glm::dvec3 coded = 2.0 * map.at(surface, point) - 1.0;
    const glm::dvec3 normal(point.normal);
    glm::dvec3 direction = coded;
    if (map.needsUvs()) {
        const glm::dvec4 tangent(interpolated(surface, point, surface.mesh().tangents));
        const glm::dvec3 across = glm::cross(normal, glm::dvec3(tangent)) * (tangent.w < 0 ? -1.0 : 1.0);
        direction = coded.x * glm::dvec3(tangent) + coded.y * across;
    }
    direction -= normal * glm::dot(normal, direction);
    const double length = glm::length(direction);
    return length > 1 ? direction / length : direction;
}

} // namespace tegument
