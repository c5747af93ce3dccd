#include "meshprep/fur/roots/root_maps.h"

#include "host/mesh/welding.h"
#include "host/support/file.h"
#include "host/support/text.h"
#include "meshprep/fur/roots/vertex_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
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

/// loadMesh leaves vertices out and splits others, but moves none: they are found by their place.
std::vector<glm::dvec3> atVertices(const Mesh& mesh, const VertexValues& file) {
    std::vector<glm::vec3> places = file.positions;
    places.insert(places.end(), mesh.positions.begin(), mesh.positions.end());
    const std::vector<std::uint32_t> first = weldPositions(places);
    std::vector<glm::dvec4> sums(file.positions.size(), glm::dvec4(0));
    for (std::size_t i = 0; i < file.positions.size(); ++i) {
        glm::dvec4 value(0, 0, 0, 1);
        for (std::size_t k = 0; k < file.values.size(); ++k)
            value[static_cast<glm::length_t>(k)] = file.values[k][i];
        sums[first[i]] += value;
    }
    std::vector<glm::dvec3> values;
    values.reserve(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const std::uint32_t place = first[file.positions.size() + i];
        assert(place < sums.size());
        values.emplace_back(glm::dvec3(sums[place]) / sums[place].w);
    }
    return values;
}

Result<void> check(const std::filesystem::path& path, const VertexValues& file, std::span<const std::string> names, bool shares) {
    for (std::size_t k = 0; k < names.size(); ++k) {
        const std::vector<double>& values = file.values[k];
        const auto wrong = std::ranges::find_if(values, [&](double v) { return shares ? !(v >= 0 && v <= 1) : !std::isfinite(v); });
        if (wrong == values.end()) continue;
        const SourcePosition at{.file = path.string()};
        const std::string what = fmt::format("vertex {} has {} {}", wrong - values.begin(), names[k], *wrong);
        if (!std::isfinite(*wrong)) return inputError(7108, at, what + ", which is not finite", "mend the values of the vertices");
        const auto [low, high] = std::ranges::minmax(values);
        return inputError(7108, at, what + ", which is no share",
                          fmt::format("they lie between {:g} and {:g}: scale them to 0 to 1", low, high));
    }
    return {};
}

Result<VertexValues> checkedValues(const std::filesystem::path& path, std::span<const std::string> names, const Mesh& mesh, bool shares) {
    auto values = readVertexValues(path, names, mesh.unitMm);
    if (!values) return values.error();
    if (const auto checked = check(path, *values, names, shares); !checked) return checked.error();
    return values;
}

std::vector<std::string> split(std::string_view list) {
    std::vector<std::string> names;
    while (true) {
        const std::size_t end = list.find(',');
        names.emplace_back(trim(list.substr(0, end)));
        if (end == std::string_view::npos) break;
        list.remove_prefix(end + 1);
    }
    return names;
}

Result<std::vector<std::string>> threeOf(const std::string& list, const char* what) {
    std::vector<std::string> names = split(list);
    if (names.size() == 3) return names;
    return usageError(7103, fmt::format("'{}' names {} properties for a {}", list, names.size(), what),
                      "name three with commas between, as nx,ny,nz or red,green,blue");
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

Result<FurMap> readVertexShares(const std::filesystem::path& path, const std::string& name, const Mesh& mesh) {
    const std::vector<std::string> names{name};
    const auto values = checkedValues(path, names, mesh, true);
    if (!values) return values.error();
    return FurMap(atVertices(mesh, *values));
}

Result<FurMap> readVertexColors(const std::filesystem::path& path, const std::string& list, const Mesh& mesh) {
    const auto names = threeOf(list, "colour");
    if (!names) return names.error();
    auto values = checkedValues(path, *names, mesh, true);
    if (!values) return values.error();
    for (std::size_t k = 0; k < names->size(); ++k)
        if (values->whole[k])
            for (double& value : values->values[k])
                value = static_cast<double>(srgbToLinear(static_cast<float>(value)));
    return FurMap(atVertices(mesh, *values));
}

Result<FurMap> readVertexDirections(const std::filesystem::path& path, const std::string& list, const Mesh& mesh) {
    const auto three = threeOf(list, "direction");
    if (!three) return three.error();
    const std::vector<std::string>& names = *three;
    auto values = checkedValues(path, names, mesh, false);
    if (!values) return values.error();
    for (std::size_t k = 0; k < names.size(); ++k)
        if (!values->whole[k])
            for (double& value : values->values[k])
                value = (value + 1) / 2; // as maps hold it
    return FurMap(atVertices(mesh, *values));
}

} // namespace tegument
