#pragma once
// Which of a mesh's triangles a pass draws: all, or the part that its annotation `Part` names, without the clusters that cannot be seen.

#include "host/effect/model.h"
#include "host/mesh/mesh.h"
#include "host/run/semantics.h"

#include <array>
#include <vector>

namespace tegument::run {

struct IndexRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    bool operator==(const IndexRange&) const = default;
};

/// What parts may be called "skin" where none is: every part that no pass of the effect names.
inline constexpr const char* kSkinPart = "skin";

/// Whether a pass of the effect names this part.
[[nodiscard]] bool drawsPart(const Effect& effect, const std::string& part);

/// From where clusters are looked at. All in the mesh's own space, mm.
struct PartView {
    std::array<glm::dvec4, 4> edges{}; // of the picture: planes, positive inside, of unit normals
    glm::dvec3 eye{0};
    double reach = 0; // how far from its clusters' vertices something may be drawn
};
/// toClip: out of the mesh's space, GLM's order.
[[nodiscard]] PartView partView(const glm::dmat4& toClip, const glm::dvec3& eye, double reach);
[[nodiscard]] PartView partView(const SceneView& scene, double reach);
[[nodiscard]] glm::dvec3 eyeOf(const SceneView& scene);

/// False only for what lies outside of the picture as a whole, or looks away from the eye as a whole: by more than kHidden, so that what
/// grows there does not reach over the horizon.
[[nodiscard]] bool canBeSeen(const MeshCluster& cluster, const PartView& view);
/// Of what grows on a vertex.
[[nodiscard]] bool canBeSeen(const glm::dvec3& place, const glm::dvec3& normal, const PartView& view);
/// Least cosine between a normal and the way to the eye at which strands are still drawn: over the horizon of a ball of the radius R those
/// of the length 0.67 R reach at -0.8. At -0.62 (0.28 R) pixels of long fur on a small body were missing.
inline constexpr double kHidden = -0.8;

/// In order, those that touch made one; with a view, without the clusters that cannot be seen: perhaps none. TG4060 the mesh has no part of
/// that name.
[[nodiscard]] Result<std::vector<IndexRange>> partOf(const Effect& effect, const Pass& pass, const Mesh& mesh,
                                                     const PartView* view = nullptr);

} // namespace tegument::run
