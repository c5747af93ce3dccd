#include "meshprep/prepare/simplify.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <limits>

namespace tegument::prep {

std::vector<std::uint32_t> simplify(const Simplification& what, float normals) {
    const SimplifiedAttributes weights = {normals, normals, normals, 2 * normals, 2 * normals};
    const bool counted = normals > 0 && !what.attributes.empty();
    std::vector<unsigned char> locked(what.locked.empty() ? 0 : what.positions.size(), 0);
    for (const std::uint32_t vertex : what.locked)
        locked[vertex] = 1;
    std::vector<std::uint32_t> coarse(what.from.size());
    coarse.resize(meshopt_simplifyWithAttributes(
        coarse.data(), what.from.data(), what.from.size(), &what.positions[0].x, what.positions.size(), sizeof(glm::vec3),
        counted ? what.attributes[0].data() : nullptr, sizeof(SimplifiedAttributes), weights.data(), counted ? what.counted : 0,
        locked.empty() ? nullptr : locked.data(), std::min(3 * what.triangles, what.from.size()), std::numeric_limits<float>::max(),
        what.keepBorders ? meshopt_SimplifyLockBorder : 0, nullptr));
    return coarse;
}

} // namespace tegument::prep
