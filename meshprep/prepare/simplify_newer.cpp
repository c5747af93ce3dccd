// Compiled against the newer meshoptimizer, whose functions have names of their own here (CMakeLists.txt).
#include "meshprep/prepare/simplify.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <limits>

namespace tegument::prep {

std::span<const Simplifier> simplifiers() {
    static constexpr std::array kAll = {Simplifier::Older, Simplifier::Newer, Simplifier::Attributes};
    return kAll;
}

std::vector<std::uint32_t> simplifyNewer(const Simplification& what, bool byAttributes) {
    // Against a position in the unit box: what the library's documentation recommends for normals, and twice that for texture coordinates.
    constexpr SimplifiedAttributes kWeights = {0.5f, 0.5f, 0.5f, 1, 1};
    const bool counted = byAttributes && !what.attributes.empty();
    std::vector<unsigned char> locked(what.locked.empty() ? 0 : what.positions.size(), 0);
    for (const std::uint32_t vertex : what.locked)
        locked[vertex] = 1;
    std::vector<std::uint32_t> coarse(what.from.size());
    coarse.resize(meshopt_simplifyWithAttributes(
        coarse.data(), what.from.data(), what.from.size(), &what.positions[0].x, what.positions.size(), sizeof(glm::vec3),
        counted ? what.attributes[0].data() : nullptr, sizeof(SimplifiedAttributes), kWeights.data(), counted ? kWeights.size() : 0,
        locked.empty() ? nullptr : locked.data(), std::min(3 * what.triangles, what.from.size()), std::numeric_limits<float>::max(),
        what.keepBorders ? meshopt_SimplifyLockBorder : 0, nullptr));
    return coarse;
}

} // namespace tegument::prep
