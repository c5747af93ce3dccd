#include "host/mesh/facing.h"

#include "host/mesh/normals.h"
#include "host/mesh/welding.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace tegument {

namespace {

/// Up to here every edge and triangle is looked at; above, one of sixteen: hashing all of a scan of millions would take seconds.
constexpr std::size_t kAllTriangles = 200'000;
constexpr std::uint64_t kOneOf = 16;

bool looked(std::uint64_t hash, std::size_t triangles) {
    return triangles <= kAllTriangles || (hash >> 40) % kOneOf == 0; // bits that the sets below do not begin with
}

using Corners = std::array<std::uint32_t, 3>;

Corners placesOf(const Mesh& mesh, std::span<const std::uint32_t> places, std::size_t triangle) {
    const std::uint32_t* t = &mesh.indices[3 * triangle];
    return {places[t[0]], places[t[1]], places[t[2]]};
}

/// The same three places, whatever the corner that it begins with: the least first.
Corners turned(Corners c) {
    std::rotate(c.begin(), std::ranges::min_element(c), c.end()); // not ranges::rotate: clang 14 cannot read libstdc++ 12's
    return c;
}

struct EdgeSides {
    std::array<std::uint32_t, 2> ends{}; // the smaller first
    std::uint32_t forwards = 0;
    std::uint32_t backwards = 0;
};

double opposedEdges(const Mesh& mesh, std::span<const std::uint32_t> places) {
    const std::size_t triangles = mesh.indices.size() / 3;
    std::vector<EdgeSides> edges;
    UniqueItems unique;
    for (std::size_t i = 0; i < triangles; ++i) {
        const Corners c = placesOf(mesh, places, i);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = c[k];
            const std::uint32_t b = c[(k + 1) % 3];
            const std::array<std::uint32_t, 2> ends{std::min(a, b), std::max(a, b)};
            const std::uint64_t hash = hashWords(ends);
            if (a == b || !looked(hash, triangles)) continue;
            const auto next = static_cast<std::uint32_t>(edges.size());
            const std::uint32_t at = unique.findOrAdd(hash, next, [&](std::uint32_t other) { return edges[other].ends == ends; });
            if (at == next) edges.push_back({.ends = ends});
            ++(a < b ? edges[at].forwards : edges[at].backwards);
        }
    }
    const auto pairs = std::ranges::count_if(edges, [](const EdgeSides& e) { return e.forwards + e.backwards == 2; });
    const auto opposed = std::ranges::count_if(edges, [](const EdgeSides& e) { return e.forwards + e.backwards == 2 && e.forwards != 1; });
    return pairs == 0 ? 0 : static_cast<double>(opposed) / static_cast<double>(pairs);
}

double doubledTriangles(const Mesh& mesh, std::span<const std::uint32_t> places) {
    const std::size_t triangles = mesh.indices.size() / 3;
    std::vector<Corners> kept;
    UniqueItems unique;
    for (std::size_t i = 0; i < triangles; ++i) {
        const Corners c = turned(placesOf(mesh, places, i));
        const Corners sorted{c[0], std::min(c[1], c[2]), std::max(c[1], c[2])};
        const std::uint64_t hash = hashWords(sorted);
        if (c[0] == c[1] || c[1] == c[2] || c[0] == c[2] || !looked(hash, triangles)) continue;
        kept.push_back(c);
        (void)unique.findOrAdd(hashWords(c), static_cast<std::uint32_t>(kept.size() - 1),
                               [&](std::uint32_t other) { return kept[other] == c; });
    }
    const auto doubled = std::ranges::count_if(kept, [&](const Corners& c) {
        const Corners back{c[0], c[2], c[1]};
        return unique.find(hashWords(back), [&](std::uint32_t other) { return kept[other] == back; }).has_value();
    });
    return kept.empty() ? 0 : static_cast<double>(doubled) / static_cast<double>(kept.size());
}

} // namespace

double outwardFacing(const Mesh& mesh) {
    const std::size_t triangles = mesh.indices.size() / 3;
    const auto each = [&](auto use) {
        for (std::size_t i = 0; i < triangles; ++i) {
            const std::array<glm::dvec3, 3> p = cornersOf(mesh, i);
            use((p[0] + p[1] + p[2]) / 3.0, glm::cross(p[1] - p[0], p[2] - p[0]));
        }
    };
    glm::dvec3 sum(0);
    double area = 0;
    each([&](const glm::dvec3& at, const glm::dvec3& normal) {
        sum += glm::length(normal) * at;
        area += glm::length(normal);
    });
    if (!(area > 0)) return 0;
    glm::dvec3 front(0); // of a closed surface the sum cancels; half a ball has 0.5 of its area, a hollow in the ground nearly all
    double out = 0;
    double all = 0;
    each([&](const glm::dvec3& at, const glm::dvec3& normal) {
        front += normal;
        out += glm::dot(normal, at - sum / area);
        all += glm::length(normal) * glm::length(at - sum / area);
    });
    constexpr double kOpen = 0.3; // a bust that ends at the neck has 0.1
    return all > 0 && glm::length(front) < kOpen * area ? out / all : 0;
}

Facing examineFacing(const Mesh& mesh, std::span<const std::uint32_t> places) {
    return {.outward = outwardFacing(mesh), .opposed = opposedEdges(mesh, places), .doubled = doubledTriangles(mesh, places)};
}

std::optional<Diagnostic> facingFault(const Facing& facing, const std::string& file) {
    // A body with arms and legs has 0.2, the Bunny 0.6. What is open, as a face or a piece of ground, is not judged.
    constexpr double kInwards = -0.1;
    constexpr double kOpposed = 0.01; // a surface without two sides, or two parts that were joined, have less
    constexpr double kDoubled = 0.5;  // leaves and cloth are drawn so on purpose, but are seldom most of a mesh
    const auto warning = [&](int code, std::string text) {
        return inputWarning(code, {.file = file}, std::move(text),
                            "effects draw and light their front only: tegument prep MESH --orient -o NEW.glb turns them");
    };
    if (facing.doubled > kDoubled)
        return warning(5334, fmt::format("{:.0f} % of the triangles are there twice, once for each side", 100 * facing.doubled));
    if (facing.opposed > kOpposed)
        return warning(5333, fmt::format("at {:.0f} % of the edges two triangles face opposite ways", 100 * facing.opposed));
    if (facing.outward < kInwards) return warning(5332, "the mesh is inside out: its triangles face inwards");
    return std::nullopt;
}

} // namespace tegument
