// Simplification by meshoptimizer (quadric errors after M. Garland, P. Heckbert, Surface simplification using quadric error metrics,
// SIGGRAPH 1997) or on half-edges. docs/meshprep.md has both measured.

#include "meshprep/prepare/levels.h"

#include "host/support/parallel.h"
#include "meshprep/prepare/local_vertices.h"
#include "meshprep/prepare/manifold_levels.h"
#include "meshprep/prepare/unit_size.h"

#include <fmt/format.h>

#include <meshoptimizer.h>

#include <limits>
#include <memory>

namespace tegument::prep {

namespace {

constexpr std::size_t kStep = 4;         // as the levels of the Stanford scans, 4.2 on average
constexpr double kLeastReduction = 0.75; // a level that keeps more of the one before is not worth its bytes

using Indices = std::vector<std::uint32_t>;

/// Every part's vertices are its own for the simplifier: where parts meet it sees a seam, moves both sides at once and opens no gap. So all
/// parts are simplified together, and each loses what it can spare.
class WholeMesh {
public:
    explicit WholeMesh(const Mesh& mesh) : mesh_(mesh) {
        const std::vector<glm::vec3> unit = atUnitSize(mesh.positions);
        LocalVertices local(mesh.positions.size());
        for (std::uint32_t part = 0; part < mesh.parts.size(); ++part) {
            const auto own = std::span(mesh.indices).subspan(mesh.parts[part].firstIndex, mesh.parts[part].indexCount);
            const auto first = static_cast<std::uint32_t>(original_.size());
            for (const std::uint32_t index : local.enter(own))
                indices_.push_back(first + index);
            original_.insert(original_.end(), local.global().begin(), local.global().end());
            part_.resize(original_.size(), part);
        }
        for (const std::uint32_t vertex : original_)
            positions_.push_back(unit[vertex]);
    }

    [[nodiscard]] MeshLevel simplified(std::size_t triangles) const {
        Indices coarse(indices_.size());
        coarse.resize(meshopt_simplify(coarse.data(), indices_.data(), indices_.size(), &positions_[0].x, positions_.size(),
                                       sizeof(glm::vec3), 3 * triangles, std::numeric_limits<float>::max(), 0, nullptr));
        std::vector<Indices> ofPart(mesh_.parts.size());
        for (std::size_t i = 0; i < coarse.size(); i += 3)
            for (std::size_t k = i; k < i + 3; ++k)
                ofPart[part_[coarse[i]]].push_back(original_[coarse[k]]);
        MeshLevel level;
        for (std::size_t part = 0; part < ofPart.size(); ++part)
            addPart(level, mesh_.parts[part], ofPart[part]);
        return level;
    }

    static void addPart(MeshLevel& level, const MeshPart& from, const Indices& own) {
        if (own.empty()) return;
        level.parts.push_back({.name = from.name,
                               .firstIndex = static_cast<std::uint32_t>(level.indices.size()),
                               .indexCount = static_cast<std::uint32_t>(own.size()),
                               .material = from.material});
        level.indices.insert(level.indices.end(), own.begin(), own.end());
    }

private:
    const Mesh& mesh_;
    Indices indices_;
    std::vector<std::uint32_t> original_; // vertex of the mesh
    std::vector<std::uint32_t> part_;     // of each vertex
    std::vector<glm::vec3> positions_;
};

/// Part by part on half-edges, which know the full surface from level to level; parts that are no manifold go to meshoptimizer.
class ByHalfEdges {
public:
    explicit ByHalfEdges(const Mesh& mesh) : mesh_(mesh), positions_(atUnitSize(mesh.positions)), part_(positions_.size()) {
        for (const MeshPart& part : mesh.parts) {
            const Indices& indices = part_.enter(trianglesOf(part));
            simplifiers_.push_back(ManifoldSimplifier::make(indices, part_.gathered(positions_), mesh.parts.size() > 1));
            global_.push_back(simplifiers_.back() ? part_.global() : Indices());
            leftOver_ += !simplifiers_.back();
        }
    }

    /// Of each part the same share; in the order from fine to coarse.
    MeshLevel simplified(std::size_t triangles) {
        MeshLevel level;
        const double share = static_cast<double>(triangles) / (static_cast<double>(mesh_.indices.size()) / 3);
        for (std::size_t i = 0; i < mesh_.parts.size(); ++i) {
            const auto target = static_cast<std::size_t>(share * mesh_.parts[i].indexCount / 3);
            WholeMesh::addPart(level, mesh_.parts[i],
                               simplifiers_[i] ? inMesh(simplifiers_[i]->reduceTo(target), global_[i]) : simplify(i, target));
        }
        return level;
    }

    [[nodiscard]] std::size_t leftOver() const { return leftOver_; }

private:
    [[nodiscard]] std::span<const std::uint32_t> trianglesOf(const MeshPart& part) const {
        return std::span(mesh_.indices).subspan(part.firstIndex, part.indexCount);
    }

    Indices simplify(std::size_t part, std::size_t target) {
        const Indices& indices = part_.enter(trianglesOf(mesh_.parts[part]));
        const std::vector<glm::vec3> positions = part_.gathered(positions_);
        Indices coarse(indices.size());
        coarse.resize(meshopt_simplify(coarse.data(), indices.data(), indices.size(), &positions[0].x, positions.size(), sizeof(glm::vec3),
                                       3 * target, std::numeric_limits<float>::max(),
                                       mesh_.parts.size() > 1 ? meshopt_SimplifyLockBorder : 0, nullptr));
        return inMesh(std::move(coarse), part_.global());
    }

    static Indices inMesh(Indices indices, const std::vector<std::uint32_t>& global) {
        for (std::uint32_t& index : indices)
            index = global[index];
        return indices;
    }

    const Mesh& mesh_;
    std::vector<glm::vec3> positions_;
    LocalVertices part_;
    std::vector<std::unique_ptr<ManifoldSimplifier>> simplifiers_; // null: left to meshoptimizer
    std::vector<std::vector<std::uint32_t>> global_;               // vertex of the mesh, by the simplifier's number
    std::size_t leftOver_ = 0;
};

/// Beyond this the levels are made one after the other: each needs some 100 bytes per triangle meanwhile.
constexpr std::size_t kMostInParallel = 4'000'000;

std::vector<MeshLevel> allLevels(const Mesh& mesh, const std::vector<std::size_t>& targets, LevelMethod method, std::size_t& leftOver) {
    std::vector<MeshLevel> levels(targets.size());
    if (method == LevelMethod::OpenMesh) {
        ByHalfEdges simplifier(mesh);
        leftOver = simplifier.leftOver();
        for (std::size_t i = 0; i < targets.size(); ++i)
            levels[i] = simplifier.simplified(targets[i]);
        return levels;
    }
    const WholeMesh whole(mesh);
    forEachInParallel(
        targets.size(), [&](std::size_t i) { levels[i] = whole.simplified(targets[i]); }, {},
        mesh.indices.size() / 3 > kMostInParallel ? 1 : 0);
    return levels;
}

} // namespace

Levels makeLevels(const Mesh& mesh, int count, LevelMethod method) {
    Levels result;
    std::vector<std::size_t> targets;
    std::size_t target = mesh.indices.size() / 3 / kStep;
    for (int i = 1; i < count && target >= kLeastTriangles; ++i, target /= kStep)
        targets.push_back(target);
    if (static_cast<int>(targets.size()) + 1 < count)
        result.whyEarly = fmt::format("another would have fewer than {} triangles", kLeastTriangles);
    if (targets.empty()) return result;
    std::vector<MeshLevel> levels = allLevels(mesh, targets, method, result.leftOver);
    std::size_t last = mesh.indices.size();
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const std::size_t size = levels[i].indices.size();
        if (size == 0 || static_cast<double>(size) > kLeastReduction * static_cast<double>(last)) {
            result.whyEarly = size == 0
                                  ? std::string("nothing would be left")
                                  : fmt::format("{} triangles were wanted, {} is the least: the others hold borders, seams or places where "
                                                "several sheets meet",
                                                targets[i], size / 3);
            levels.resize(i);
            break;
        }
        last = size;
    }
    const DistanceFrom distance(mesh.positions, mesh.indices);
    result.levels.resize(levels.size());
    forEachInParallel(levels.size(), [&](std::size_t i) {
        const SurfaceDistance error = distance.to(levels[i].indices);
        levels[i].errorMm = error.greatest;
        result.levels[i] = {.mesh = std::move(levels[i]), .error = error};
    });
    return result;
}

} // namespace tegument::prep
