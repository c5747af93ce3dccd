// Simplification by meshoptimizer (quadric errors after M. Garland, P. Heckbert, Surface simplification using quadric error metrics,
// SIGGRAPH 1997). docs/meshprep.md has the measurement that chose it.

#include "meshprep/prepare/levels.h"

#include "meshprep/prepare/local_vertices.h"
#include "meshprep/prepare/unit_size.h"

#include <meshoptimizer.h>

#include <limits>

namespace tegument::prep {

namespace {

constexpr std::size_t kStep = 4;         // as the levels of the Stanford scans, 4.2 on average
constexpr double kLeastReduction = 0.75; // a level that keeps more of the one before is not worth its bytes

MeshLevel coarser(const MeshLevel& fine, const std::vector<glm::vec3>& positions, LocalVertices& part) {
    MeshLevel level;
    const unsigned options = fine.parts.size() > 1 ? meshopt_SimplifyLockBorder : 0;
    std::vector<std::uint32_t> simplified;
    for (const MeshPart& from : fine.parts) {
        const auto& indices = part.enter(std::span(fine.indices).subspan(from.firstIndex, from.indexCount));
        const std::vector<glm::vec3> own = part.gathered(positions);
        const std::size_t target = indices.size() / 3 / kStep * 3;
        simplified.resize(indices.size());
        simplified.resize(meshopt_simplify(simplified.data(), indices.data(), indices.size(), &own[0].x, own.size(), sizeof(glm::vec3),
                                           target, std::numeric_limits<float>::max(), options, nullptr));
        if (simplified.empty()) continue;
        level.parts.push_back({.name = from.name,
                               .firstIndex = static_cast<std::uint32_t>(level.indices.size()),
                               .indexCount = static_cast<std::uint32_t>(simplified.size())});
        for (const std::uint32_t corner : simplified)
            level.indices.push_back(part.global()[corner]);
    }
    return level;
}

} // namespace

std::vector<Level> makeLevels(const Mesh& mesh, int count) {
    std::vector<Level> levels;
    const std::vector<glm::vec3> positions = atUnitSize(mesh.positions);
    LocalVertices part(positions.size());
    MeshLevel last{.indices = mesh.indices, .parts = mesh.parts, .errorMm = 0};
    for (int i = 1; i < count && last.indices.size() / 3 / kStep >= kLeastTriangles; ++i) {
        MeshLevel next = coarser(last, positions, part);
        if (next.indices.empty() || static_cast<double>(next.indices.size()) > kLeastReduction * static_cast<double>(last.indices.size()))
            break;
        const SurfaceDistance error = distance(mesh.positions, mesh.indices, next.indices);
        next.errorMm = error.greatest;
        last = next;
        levels.push_back({.mesh = std::move(next), .error = error});
    }
    return levels;
}

} // namespace tegument::prep
