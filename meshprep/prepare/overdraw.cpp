#include "meshprep/prepare/overdraw.h"

#include "meshprep/prepare/unit_size.h"

#include <meshoptimizer.h>

namespace tegument::prep {

Overdraw orderForOverdraw(Mesh& mesh) {
    if (mesh.indices.empty()) return {};
    const std::vector<glm::vec3> positions = atUnitSize(mesh.positions);
    const auto measured = [&] {
        const auto statistics =
            meshopt_analyzeOverdraw(mesh.indices.data(), mesh.indices.size(), &positions[0].x, positions.size(), sizeof(glm::vec3));
        return static_cast<double>(statistics.overdraw);
    };
    Overdraw result{.before = measured(), .after = 0};
    for (const MeshPart& part : mesh.parts) {
        std::vector<std::uint32_t> ordered(part.indexCount);
        std::uint32_t* own = &mesh.indices[part.firstIndex];
        meshopt_optimizeOverdraw(ordered.data(), own, part.indexCount, &positions[0].x, positions.size(), sizeof(glm::vec3),
                                 kOverdrawThreshold);
        std::copy(ordered.begin(), ordered.end(), own);
    }
    result.after = measured();
    return result;
}

} // namespace tegument::prep
