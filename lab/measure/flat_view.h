#pragma once
// The view of the flat patch of lab/reference/fur_patch.h, as a workspace: who draws the patch with an effect looks at it from here.

#include "host/scene/workspace.h"
#include "lab/reference/fur_patch.h"
#include "lab/reference/pinhole.h"

#include <glm/glm.hpp>

#include <cmath>
#include <vector>

namespace tegument::measure {

constexpr int kPatchHalf = 12;      // the patch reaches so many spacings to each side; a spacing is 1 mm
constexpr double kPatchAway = 4000; // of the eye: rays go astray by a 2000th of their way down, 32-bit positions by a 1000th

/// Seen from the side of -x, so that a ray moves towards +x on its way down (FurRay); light from above. coat: spacings.
inline Workspace flatView(const reference::FurView& view, double coat) {
    Workspace workspace = worldWorkspace();
    const glm::dvec3 middle(0, 0, coat / 2);
    workspace.camera.position = glm::vec3(middle + kPatchAway * glm::dvec3(-std::sin(view.tilt), 0, std::cos(view.tilt)));
    workspace.camera.target = glm::vec3(middle);
    workspace.camera.horizontalFov = static_cast<float>(glm::degrees(2 * std::atan(view.pixel * view.size / 2 / kPatchAway)));
    workspace.camera.nearPlane = static_cast<float>(kPatchAway - 10 * kPatchHalf);
    workspace.camera.farPlane = static_cast<float>(kPatchAway + 10 * kPatchHalf);
    workspace.light.position = {0, 0, static_cast<float>(kPatchAway)};
    return workspace;
}

/// Height at which the exact ray through each sample meets a strand, kNoHit where none does: rows of view.size * view.samples, from the
/// top.
inline std::vector<double> exactHits(const reference::FurPatch& patch, const reference::FurView& view) {
    const Workspace workspace = flatView(view, patch.coat);
    const int side = view.size * view.samples;
    const auto camera = reference::pinhole(glm::dvec3(workspace.camera.position), glm::dvec3(workspace.camera.target), {0, 1, 0},
                                           glm::radians(static_cast<double>(workspace.camera.horizontalFov)), side, side);
    std::vector<double> hits;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const glm::dvec3 way = camera.ray(x, y);
            const glm::dvec3 down = way / -way.z; // for one spacing downwards
            const glm::dvec3 top = camera.eye + (camera.eye.z - patch.coat) * down;
            const glm::dvec3 middle = camera.eye + (camera.eye.z - patch.coat / 2) * down; // sideways it moves by a 2000th of that
            hits.push_back(reference::exactHit(patch, {.x = top.x, .y = middle.y, .run = patch.coat * down.x}));
        }
    return hits;
}

} // namespace tegument::measure
