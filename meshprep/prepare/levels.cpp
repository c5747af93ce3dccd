// Simplification by meshoptimizer (quadric errors after M. Garland, P. Heckbert, Surface simplification using quadric error metrics,
// SIGGRAPH 1997) or on half-edges. docs/meshprep.md has both measured.

#include "meshprep/prepare/levels.h"

#include "meshprep/prepare/local_vertices.h"
#include "meshprep/prepare/manifold_levels.h"
#include "meshprep/prepare/unit_size.h"

#include <meshoptimizer.h>

#include <limits>

namespace tegument::prep {

namespace {

constexpr std::size_t kStep = 4;         // as the levels of the Stanford scans, 4.2 on average
constexpr double kLeastReduction = 0.75; // a level that keeps more of the one before is not worth its bytes

using Indices = std::vector<std::uint32_t>;

Indices simplifyAny(const Indices& indices, const std::vector<glm::vec3>& positions, std::size_t target, bool keepBorder) {
    Indices simplified(indices.size());
    simplified.resize(meshopt_simplify(simplified.data(), indices.data(), indices.size(), &positions[0].x, positions.size(),
                                       sizeof(glm::vec3), 3 * target, std::numeric_limits<float>::max(),
                                       keepBorder ? meshopt_SimplifyLockBorder : 0, nullptr));
    return simplified;
}

/// A part on half-edges, which know the full surface from level to level.
struct ManifoldPart {
    std::unique_ptr<ManifoldSimplifier> simplifier; // null: left to meshoptimizer
    std::vector<std::uint32_t> global;              // vertex of the mesh, by the simplifier's number
};

class Coarsening {
public:
    Coarsening(const Mesh& mesh, LevelMethod method) : positions_(atUnitSize(mesh.positions)), part_(positions_.size()) {
        for (const MeshPart& part : mesh.parts) {
            ManifoldPart& manifold = manifolds_.emplace_back();
            origins_.push_back(origins_.size());
            if (method != LevelMethod::OpenMesh) continue;
            const Indices& indices = part_.enter(trianglesOf(part, mesh.indices));
            manifold = {ManifoldSimplifier::make(indices, part_.gathered(positions_), mesh.parts.size() > 1), part_.global()};
            leftOver_ += !manifold.simplifier;
        }
    }

    MeshLevel coarser(const MeshLevel& fine) {
        MeshLevel level;
        std::vector<std::size_t> origins;
        for (std::size_t i = 0; i < fine.parts.size(); ++i) {
            const Indices simplified = simplify(manifolds_[origins_[i]], trianglesOf(fine.parts[i], fine.indices), fine.parts.size() > 1);
            if (simplified.empty()) continue;
            origins.push_back(origins_[i]);
            level.parts.push_back({.name = fine.parts[i].name,
                                   .firstIndex = static_cast<std::uint32_t>(level.indices.size()),
                                   .indexCount = static_cast<std::uint32_t>(simplified.size())});
            level.indices.insert(level.indices.end(), simplified.begin(), simplified.end());
        }
        origins_ = std::move(origins);
        return level;
    }

    [[nodiscard]] std::size_t leftOver() const { return leftOver_; }

private:
    static std::span<const std::uint32_t> trianglesOf(const MeshPart& part, const Indices& indices) {
        return std::span(indices).subspan(part.firstIndex, part.indexCount);
    }

    Indices simplify(const ManifoldPart& manifold, std::span<const std::uint32_t> triangles, bool keepBorder) {
        const std::size_t target = triangles.size() / 3 / kStep;
        if (manifold.simplifier) return inMesh(manifold.simplifier->reduceTo(target), manifold.global);
        const Indices& indices = part_.enter(triangles);
        return inMesh(simplifyAny(indices, part_.gathered(positions_), target, keepBorder), part_.global());
    }

    static Indices inMesh(Indices indices, const std::vector<std::uint32_t>& global) {
        for (std::uint32_t& index : indices)
            index = global[index];
        return indices;
    }

    std::vector<glm::vec3> positions_;
    LocalVertices part_;
    std::vector<ManifoldPart> manifolds_; // of the full mesh's parts
    std::vector<std::size_t> origins_;    // of the parts of the level made last: which of the full mesh's they are
    std::size_t leftOver_ = 0;
};

} // namespace

Levels makeLevels(const Mesh& mesh, int count, LevelMethod method) {
    Coarsening coarsening(mesh, method);
    Levels result{.levels = {}, .leftOver = coarsening.leftOver()};
    MeshLevel last{.indices = mesh.indices, .parts = mesh.parts, .errorMm = 0};
    for (int i = 1; i < count && last.indices.size() / 3 / kStep >= kLeastTriangles; ++i) {
        MeshLevel next = coarsening.coarser(last);
        if (next.indices.empty() || static_cast<double>(next.indices.size()) > kLeastReduction * static_cast<double>(last.indices.size()))
            break;
        const SurfaceDistance error = distance(mesh.positions, mesh.indices, next.indices);
        next.errorMm = error.greatest;
        last = next;
        result.levels.push_back({.mesh = std::move(next), .error = error});
    }
    return result;
}

} // namespace tegument::prep
