#include "meshprep/prepare/clean.h"

#include "host/mesh/triangles.h"
#include "host/mesh/welding.h"

#include <array>

namespace tegument::prep {

namespace {

using Triple = std::array<std::uint32_t, 3>;

Triple pointsOf(const Surface& surface, std::size_t triangle) {
    return {surface.pointAt(3 * triangle), surface.pointAt(3 * triangle + 1), surface.pointAt(3 * triangle + 2)};
}

/// Turned so that the smallest number comes first: equal for triangles that are seen from the same side.
Triple turned(const Triple& t) {
    if (t[0] <= t[1] && t[0] <= t[2]) return t;
    return t[1] <= t[2] ? Triple{t[1], t[2], t[0]} : Triple{t[2], t[0], t[1]};
}

/// Numbers for what tells corners apart: place, and texture coordinates where there are any.
std::vector<std::uint32_t> cornerKinds(const Surface& surface) {
    if (surface.mesh.uvs.empty()) return surface.point;
    return firstEqual(surface.point.size(), [&](std::uint32_t i) {
        const auto uv = floatKey<2>({surface.mesh.uvs[i].x, surface.mesh.uvs[i].y});
        return std::array{surface.point[i], uv[0], uv[1]};
    });
}

} // namespace

std::size_t dropCollapsed(Surface& surface) {
    return keepTriangles(surface.mesh, [&](std::span<const std::uint32_t, 3>, std::size_t triangle) {
        const Triple t = pointsOf(surface, triangle);
        return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
    });
}

std::size_t dropDuplicates(Surface& surface) {
    const std::vector<std::uint32_t> kind = cornerKinds(surface);
    const auto keyOf = [&](std::uint32_t triangle) {
        const std::uint32_t* t = &surface.mesh.indices[3 * std::size_t{triangle}];
        return turned({kind[t[0]], kind[t[1]], kind[t[2]]});
    };
    const std::vector<std::uint32_t> first = firstEqual(surface.triangles(), keyOf);
    return keepTriangles(surface.mesh,
                         [&](std::span<const std::uint32_t, 3>, std::size_t triangle) { return first[triangle] == triangle; });
}

std::size_t dropUnreferenced(Surface& surface) {
    const std::size_t before = surface.point.size();
    const std::vector<std::uint32_t> kept = keepReferenced(surface.mesh);
    if (kept.size() == before) return 0;
    std::vector<std::uint32_t> number(surface.pointCount, UINT32_MAX); // places stay numbered without gaps
    std::vector<std::uint32_t> point;
    point.reserve(kept.size());
    surface.pointCount = 0;
    for (const std::uint32_t vertex : kept) {
        std::uint32_t& place = number[surface.point[vertex]];
        if (place == UINT32_MAX) place = surface.pointCount++;
        point.push_back(place);
    }
    surface.point = std::move(point);
    return before - kept.size();
}

std::vector<std::uint32_t> backToBack(const Surface& surface) {
    const auto count = static_cast<std::uint32_t>(surface.triangles());
    UniqueItems sides(count); // by turned corners
    const auto keyOf = [&](std::uint32_t triangle) { return turned(pointsOf(surface, triangle)); };
    for (std::uint32_t i = 0; i < count; ++i) {
        const Triple key = keyOf(i);
        sides.findOrAdd(hashWords(key), i, [&](std::uint32_t other) { return keyOf(other) == key; });
    }
    std::vector<std::uint32_t> other(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Triple key = keyOf(i);
        const Triple back = {key[0], key[2], key[1]};
        other[i] = sides.find(hashWords(back), [&](std::uint32_t candidate) { return keyOf(candidate) == back; }).value_or(i);
    }
    return other;
}

} // namespace tegument::prep
