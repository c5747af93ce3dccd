#include "meshprep/prepare/simplify.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <limits>

namespace tegument::prep {

namespace {

std::vector<std::uint32_t> simplifyOlder(std::span<const std::uint32_t> from, std::span<const glm::vec3> positions, std::size_t triangles,
                                         bool keepBorders) {
    std::vector<std::uint32_t> coarse(from.size());
    coarse.resize(meshopt_simplify(coarse.data(), from.data(), from.size(), &positions[0].x, positions.size(), sizeof(glm::vec3),
                                   std::min(3 * triangles, from.size()), std::numeric_limits<float>::max(),
                                   keepBorders ? meshopt_SimplifyLockBorder : 0, nullptr));
    return coarse;
}

/// Version 0.18 takes no list of vertices that stay, but it leaves those alone at which several borders meet: each gets two loose
/// triangles, which go afterwards.
std::vector<std::uint32_t> simplifyOlderBut(const Simplification& what) {
    const auto own = static_cast<std::uint32_t>(what.positions.size());
    std::vector<glm::vec3> positions(what.positions.begin(), what.positions.end());
    for (const float x : {0.4f, 0.45f, 0.55f, 0.6f}) // places that no vertex is likely to have
        positions.emplace_back(x, 0.5371f, 0.4629f);
    std::vector<std::uint32_t> from(what.from.begin(), what.from.end());
    for (const std::uint32_t vertex : what.locked)
        from.insert(from.end(), {vertex, own, own + 1, vertex, own + 2, own + 3});
    std::vector<std::uint32_t> coarse = simplifyOlder(from, positions, what.triangles + 2 * what.locked.size(), false);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < coarse.size(); i += 3) {
        if (std::max({coarse[i], coarse[i + 1], coarse[i + 2]}) >= own) continue;
        std::copy_n(&coarse[i], 3, &coarse[kept]);
        kept += 3;
    }
    coarse.resize(kept);
    return coarse;
}

/// Half is what the library's documentation recommends, and best for scans; without normals machines come out better. What lies between is
/// as near on average: which one wins is chance, so the more are tried the better.
constexpr std::array kNormals = {0.5f, 0.0f, 0.1f, 0.25f, 0.05f, 0.02f, 0.15f, 0.07f, 0.35f, 0.01f, 0.2f, 0.7f, 1.0f};
constexpr std::size_t kBeforeOlder = 2; // of them

std::vector<Simplifier> makeSimplifiers() {
    using enum Simplifier::Version;
    const std::array<std::uint32_t, 3> corners = {0, 1, 2};
    const std::array<glm::vec3, 3> triangle = {glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)};
    const Simplification one{.from = corners, .positions = triangle, .triangles = 1};
    const bool newer = simplifyNewer(one, 0).has_value();
    const bool newest = simplifyNewest(one, 0).has_value();
    std::vector<Simplifier> all;
    for (std::size_t i = 0; i < kNormals.size() && (newer || newest); ++i) {
        if (i == kBeforeOlder) all.push_back({});
        if (newest) all.push_back({Newest, kNormals[i]});
        if (newer) all.push_back({Newer, kNormals[i]});
    }
    if (all.empty()) all.push_back({});
    return all;
}

} // namespace

std::span<const Simplifier> simplifiers() {
    static const std::vector<Simplifier> kAll = makeSimplifiers();
    return kAll;
}

std::vector<std::uint32_t> simplify(const Simplification& what, Simplifier simplifier) {
    if (simplifier.version == Simplifier::Version::Newer) return *simplifyNewer(what, simplifier.normals);
    if (simplifier.version == Simplifier::Version::Newest) return *simplifyNewest(what, simplifier.normals);
    return what.locked.empty() ? simplifyOlder(what.from, what.positions, what.triangles, what.keepBorders) : simplifyOlderBut(what);
}

} // namespace tegument::prep
