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

} // namespace

std::vector<std::uint32_t> simplify(const Simplification& what, Simplifier simplifier) {
    if (simplifier.version == Simplifier::Version::Newer) return simplifyNewer(what, simplifier.normals);
    return what.locked.empty() ? simplifyOlder(what.from, what.positions, what.triangles, what.keepBorders) : simplifyOlderBut(what);
}

} // namespace tegument::prep
