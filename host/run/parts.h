#pragma once
// Which of a mesh's triangles a pass draws: all, or the part that its annotation `Part` names, without the clusters that cannot be seen.

#include "host/effect/model.h"
#include "host/mesh/mesh.h"
#include "host/run/pass_request.h"
#include "host/run/semantics.h"

#include <array>
#include <vector>

namespace tegument::run {

/// What parts may be called "skin" where none is: every part that no pass of the effect names.
inline constexpr const char* kSkinPart = "skin";

/// Whether a pass of the effect names this part.
[[nodiscard]] bool drawsPart(const Effect& effect, const std::string& part);

/// From where clusters are looked at. All in the mesh's own space, mm.
struct PartView {
    std::array<glm::dvec4, 4> edges{}; // of the picture: planes, positive inside, of unit normals
    glm::dvec3 eye{0};
    double reach = 0;   // how far from its clusters' vertices something may be drawn
    double hidden = -1; // what looks away from the eye by a lesser cosine is not seen
};
/// toClip: out of the mesh's space, GLM's order.
[[nodiscard]] PartView partView(const glm::dmat4& toClip, const glm::dvec3& eye, double reach);
[[nodiscard]] glm::dvec3 eyeOf(const SceneView& scene);

/// False only for what lies outside of the picture as a whole, or looks away from the eye as a whole, by more than `hidden` allows.
[[nodiscard]] bool canBeSeen(const MeshCluster& cluster, const PartView& view);
/// Of what grows on a vertex.
[[nodiscard]] bool canBeSeen(const glm::dvec3& place, const glm::dvec3& normal, const PartView& view);
/// In order, those that touch made one; with a view, without the clusters that cannot be seen: perhaps none. TG4060 the mesh has no part of
/// that name.
[[nodiscard]] Result<std::vector<ListedRange>> partOf(const Effect& effect, const Pass& pass, const Mesh& mesh,
                                                      const PartView* view = nullptr);

} // namespace tegument::run
