#pragma once
// Where the lids touch the eyeball: the line from which lid shadow, lashes and the wet rim are measured.

#include "meshprep/human/head_surface.h"

#include <glm/glm.hpp>

#include <vector>

namespace tegument {

/// How far a point of the eyeball's chart lies from the lids, mm along the eyeball; far away where there are none.
struct LidDistances {
    float upper = 1e6f;
    float lower = 1e6f;
};

class EyeOpening {
public:
    EyeOpening() = default;
    /// Seen from the front, the first meeting of skin and eyeball in each direction around the opening's middle.
    EyeOpening(const HeadSurface& head, const Eyeball& eye);

    [[nodiscard]] bool empty() const { return upper_.size() < 2; }
    [[nodiscard]] LidDistances distances(const glm::vec3& position) const;
    /// The line of the upper and of the lower lid, in the eyeball's chart, from the right corner to the left one.
    [[nodiscard]] const std::vector<glm::vec2>& upper() const { return upper_; }
    [[nodiscard]] const std::vector<glm::vec2>& lower() const { return lower_; }
    /// What lids and lashes leave of the light from all around at a point of the eyeball, 0 to 1.
    [[nodiscard]] float light(const glm::vec3& position) const;
    /// Of the film of tears: it climbs the lower lid, in mm above the eyeball.
    [[nodiscard]] float tears(const glm::vec3& position) const;

private:
    Eyeball eye_;
    std::vector<glm::vec2> upper_;
    std::vector<glm::vec2> lower_;
};

} // namespace tegument
