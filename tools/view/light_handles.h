#pragma once
// Lights as handles on the picture: where each is seen, and how it is turned. Needs no window and no GPU.

#include "tools/view/state.h"

#include <string>
#include <vector>

namespace tegument::view {

struct LightHandle {
    std::string name;      // "light", "lamp 2"
    std::size_t lamp = 0;  // from 1 on; 0: the workspace's light
    glm::vec3 color{1};    // its largest channel 1
    glm::dvec2 place{0.5}; // share of the picture
    bool outside = false;  // where it is lies beyond the picture: `place` is at the edge
    bool behind = false;   // farther than what the camera looks at
};

/// The workspace's light and the lamps that the effect reads. `seen`: the camera of a picture of this aspect. Parallel light stands on a
/// circle about the target.
[[nodiscard]] std::vector<LightHandle> lightHandles(const ViewState& state, const Effect& effect, const Workspace& seen, double aspect);

/// About the camera's target, by shares of the picture's height, so that it follows.
void turnLight(ViewState& state, const Effect& effect, const LightHandle& handle, glm::dvec2 by);

/// How many lamps are lit; what they are read from.
[[nodiscard]] std::size_t lampCount(const ViewState& state, const Effect& effect);
inline constexpr std::size_t kLampNumbers = 4; // of a parameter, for each lamp

} // namespace tegument::view
