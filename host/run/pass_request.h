#pragma once
// What a library that knows a mesh is asked of a pass before it is recorded (RunOptions::assets). Needs no GPU.

#include "host/effect/model.h"
#include "host/mesh/mesh.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tegument {

/// A run of indices that is drawn as one.
struct ListedRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t firstInstance = 0;
    std::uint32_t instances = 0; // 0: as many as the pass has
    bool operator==(const ListedRange&) const = default;
};

/// What a pass draws of a mesh, in place of all of its part.
struct DrawList {
    std::vector<std::uint32_t> indices; // that the ranges count in; none: the mesh's own
    std::vector<ListedRange> ranges;    // in order; none: nothing is drawn
};

/// A pass that draws a mesh, or computes for one.
struct PassRequest {
    const Effect& effect;
    const Pass& pass;
    const Mesh& mesh;
    glm::dmat4 world{1};             // of the mesh, GLM's order
    glm::dmat4 viewProjection{1};    // of the camera, from the world into clip space
    glm::dvec3 eye{0};               // in the mesh's own space, mm
    double horizontalFov = 0;        // radians
    std::uint32_t viewportWidth = 0; // pixels, of what it draws into
    std::uint32_t instances = 1;
    /// Value of a numeric parameter of the effect, by any of its names' spellings; TG4018 where it has none.
    std::function<Result<std::vector<double>>(const Parameter&)> value;
    /// Rows of a target of the effect; none where it has no such target.
    std::function<std::optional<std::uint32_t>(const std::string& target)> rows;
};

} // namespace tegument
