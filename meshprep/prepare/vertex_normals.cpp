#include "meshprep/prepare/vertex_normals.h"

#include "host/mesh/normals.h"
#include "host/mesh/triangles.h"
#include "host/mesh/welding.h"
#include "meshprep/prepare/clean.h"
#include "meshprep/prepare/topology.h"

#include <algorithm>
#include <cmath>

namespace tegument::prep {

namespace {

/// Cosine of 0.26 degrees: float normals of one flat face differ by less, faces of a smooth scan by more.
constexpr double kSameNormal = 0.99999;

/// Places whose corners do not all share one normal. By sheets: those of components in which every triangle has another on its back, as
/// a leaf that is seen from both sides. Folds that decimation leaves in a surface stay joined: the surface beside gives them a direction.
std::vector<bool> dividedPlaces(const Surface& surface, NormalSharing sharing, const std::vector<std::uint32_t>& back) {
    std::vector<bool> divided(surface.pointCount, true);
    if (sharing != NormalSharing::Sheet) return divided;
    DisjointSets components(surface.pointCount);
    for (std::size_t corner = 0; corner < surface.mesh.indices.size(); ++corner)
        components.join(surface.pointAt(corner), surface.pointAt(corner - corner % 3));
    std::vector<bool> single(surface.pointCount, false);
    for (std::size_t triangle = 0; triangle < surface.triangles(); ++triangle)
        if (back[triangle] == triangle) single[components.find(surface.pointAt(3 * triangle))] = true;
    for (std::uint32_t point = 0; point < surface.pointCount; ++point)
        divided[point] = !single[components.find(point)];
    return divided;
}

/// Group of each corner: its place, or its fan where the place is divided.
std::vector<std::uint32_t> cornerGroups(const Surface& surface, NormalSharing sharing) {
    std::vector<std::uint32_t> groups(surface.mesh.indices.size());
    for (std::size_t corner = 0; corner < groups.size(); ++corner)
        groups[corner] = surface.pointAt(corner);
    if (sharing == NormalSharing::Place) return groups;
    const std::vector<std::uint32_t> back = backToBack(surface);
    const std::vector<bool> divided = dividedPlaces(surface, sharing, back);
    if (std::ranges::find(divided, true) == divided.end()) return groups;
    DisjointSets fans = cornerFans(surface, EdgeTable(surface), back);
    for (std::uint32_t corner = 0; corner < groups.size(); ++corner)
        if (divided[groups[corner]]) groups[corner] = surface.pointCount + fans.find(corner);
    return groups;
}

/// Copies vertices whose corners are of several groups. Gives the group of each vertex.
std::vector<std::uint32_t> splitByGroup(Surface& surface, const std::vector<std::uint32_t>& groupOfCorner) {
    constexpr std::uint32_t kNone = UINT32_MAX;
    std::vector<std::uint32_t> from(surface.mesh.positions.size());
    for (std::uint32_t i = 0; i < from.size(); ++i)
        from[i] = i;
    std::vector<std::uint32_t> groupOfVertex(from.size(), kNone);
    UniqueItems copies; // by (original, group)
    for (std::size_t corner = 0; corner < groupOfCorner.size(); ++corner) {
        std::uint32_t& vertex = surface.mesh.indices[corner];
        const std::uint32_t group = groupOfCorner[corner];
        if (groupOfVertex[vertex] == kNone) groupOfVertex[vertex] = group;
        if (groupOfVertex[vertex] == group) continue;
        const auto next = static_cast<std::uint32_t>(from.size());
        const std::uint32_t original = vertex;
        const auto isCopy = [&](std::uint32_t other) { return from[other] == original && groupOfVertex[other] == group; };
        vertex = copies.findOrAdd(hashWords(std::array{original, group}), next, isCopy);
        if (vertex != next) continue;
        from.push_back(original);
        groupOfVertex.push_back(group);
    }
    gatherVertices(surface.mesh, from);
    for (std::size_t i = surface.point.size(); i < from.size(); ++i)
        surface.point.push_back(surface.point[from[i]]);
    return groupOfVertex;
}

/// Numbers without gaps.
void compact(std::vector<std::uint32_t>& groups) {
    std::vector<std::uint32_t> number(groups.empty() ? 0 : std::size_t{*std::ranges::max_element(groups)} + 1, UINT32_MAX);
    std::uint32_t count = 0;
    for (std::uint32_t& group : groups) {
        if (number[group] == UINT32_MAX) number[group] = count++;
        group = number[group];
    }
}

glm::vec3 unitOrZero(const glm::vec3& v) {
    const double length = glm::length(glm::dvec3(v));
    return length > 0 && std::isfinite(length) ? glm::vec3(glm::dvec3(v) / length) : glm::vec3(0);
}

bool usable(const std::vector<glm::vec3>& normals) {
    return !normals.empty() && std::ranges::all_of(normals, [](const glm::vec3& n) { return unitOrZero(n) != glm::vec3(0); });
}

/// The normals that one group has met, and the sum of those that are new.
class NormalSums {
public:
    NormalSums(std::size_t groups, NormalMode mode) : mode_(mode), sums_(groups, glm::dvec3(0)), any_(groups, glm::vec3(0, 0, 1)) {}

    void add(std::uint32_t group, const glm::vec3& normal) {
        if (normal == glm::vec3(0)) return;
        any_[group] = normal;
        if (mode_ == NormalMode::Sum || isNew({.group = group, .normal = normal})) sums_[group] += glm::dvec3(normal);
    }

    [[nodiscard]] glm::vec3 of(std::uint32_t group) const {
        const double length = glm::length(sums_[group]);
        return length > 1e-9 ? glm::vec3(sums_[group] / length) : any_[group]; // below it only rounding is left of a sum that cancels
    }

private:
    struct Used {
        std::uint32_t group = 0;
        glm::vec3 normal{0};
    };

    /// Bit for bit as the document's list of used normals; or on a grid of directions, whose cells are as wide as the tolerance.
    bool isNew(const Used& candidate) {
        const double cell = std::acos(kSameNormal);
        const auto cellAt = [&](const glm::vec3& n) -> glm::vec3 {
            return mode_ == NormalMode::Seed ? n : glm::vec3(glm::floor(glm::dvec3(n) / cell));
        };
        const glm::vec3 home = cellAt(candidate.normal);
        const auto keyOf = [](std::uint32_t group, const glm::vec3& at) {
            const auto bits = floatKey<3>({at.x, at.y, at.z});
            return hashWords(std::array{group, bits[0], bits[1], bits[2]});
        };
        const int reach = mode_ == NormalMode::Seed ? 0 : 1;
        for (int x = -reach; x <= reach; ++x)
            for (int y = -reach; y <= reach; ++y)
                for (int z = -reach; z <= reach; ++z)
                    if (used_.find(keyOf(candidate.group, home + glm::vec3(x, y, z)),
                                   [&](std::uint32_t other) { return same(list_[other], candidate); }))
                        return false;
        const auto next = static_cast<std::uint32_t>(list_.size());
        list_.push_back(candidate);
        used_.findOrAdd(keyOf(candidate.group, home), next, [](std::uint32_t) { return false; });
        return true;
    }

    [[nodiscard]] bool same(const Used& a, const Used& b) const {
        if (a.group != b.group) return false;
        if (mode_ == NormalMode::Seed) return a.normal == b.normal;
        return glm::dot(glm::dvec3(a.normal), glm::dvec3(b.normal)) > kSameNormal;
    }

    NormalMode mode_;
    std::vector<glm::dvec3> sums_;
    std::vector<glm::vec3> any_;
    std::vector<Used> list_;
    UniqueItems used_;
};

std::vector<glm::vec3> summedNormals(const Surface& surface, const std::vector<std::uint32_t>& group, NormalMode mode) {
    const Mesh& mesh = surface.mesh;
    const bool fromFile = usable(mesh.normals);
    NormalSums sums(group.empty() ? 0 : std::size_t{*std::ranges::max_element(group)} + 1, mode);
    for (std::size_t triangle = 0; triangle < surface.triangles(); ++triangle) {
        const glm::vec3 face = fromFile ? glm::vec3(0) : glm::vec3(faceNormal(cornersOf(mesh, triangle)));
        for (std::size_t corner = 3 * triangle; corner < 3 * triangle + 3; ++corner) {
            const std::uint32_t vertex = mesh.indices[corner];
            sums.add(group[vertex], fromFile ? unitOrZero(mesh.normals[vertex]) : face);
        }
    }
    std::vector<glm::vec3> normals;
    normals.reserve(group.size());
    for (const std::uint32_t g : group)
        normals.push_back(sums.of(g));
    return normals;
}

std::vector<glm::vec3> keptNormals(const std::vector<glm::vec3>& normals) {
    std::vector<glm::vec3> kept;
    kept.reserve(normals.size());
    for (const glm::vec3& normal : normals)
        kept.push_back(unitOrZero(normal));
    return kept;
}

} // namespace

NormalChanges makeNormals(Surface& surface, const NormalOptions& options) {
    NormalChanges changes;
    Mesh& mesh = surface.mesh;
    const std::size_t before = mesh.positions.size();
    std::vector<glm::vec3> normals;
    if (options.mode == NormalMode::Keep && usable(mesh.normals)) {
        normals = keptNormals(mesh.normals);
    } else {
        std::vector<std::uint32_t> group = splitByGroup(surface, cornerGroups(surface, options.sharing));
        compact(group);
        const bool summed = options.mode != NormalMode::Angle && options.mode != NormalMode::Keep;
        normals = summed ? summedNormals(surface, group, options.mode) : angleWeightedNormals(mesh, group);
    }
    changes.split = mesh.positions.size() - before;
    for (std::size_t i = 0; i < normals.size(); ++i)
        changes.normals += mesh.normals.empty() || mesh.normals[i] != normals[i];
    mesh.normals = std::move(normals);
    mesh.tangents.clear(); // of the old normals
    return changes;
}

} // namespace tegument::prep
