#pragma once
// meshoptimizer's simplification: quadric errors after M. Garland, P. Heckbert, Surface simplification using quadric error metrics,
// SIGGRAPH 1997.

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

namespace tegument::prep {

enum class Simplifier {
    Older,     // version 0.18, Debian's
    Newer,     // the version that ./bootstrap fetches
    Attributes // the newer one, which counts errors of normals and texture coordinates, too
};

/// Those that this build has.
[[nodiscard]] std::span<const Simplifier> simplifiers();

/// Normal and texture coordinates.
using SimplifiedAttributes = std::array<float, 5>;

struct Simplification {
    std::span<const std::uint32_t> from;                // corners of triangles
    std::span<const glm::vec3> positions;               // of unit size
    std::span<const SimplifiedAttributes> attributes{}; // of each position, for Simplifier::Attributes
    std::size_t triangles = 0;                          // that are wanted; there may be more
    bool keepBorders = false;
    std::set<std::uint32_t> locked{}; // vertices that stay; not together with `keepBorders`
};

/// `simplifier`: one of `simplifiers()`.
[[nodiscard]] std::vector<std::uint32_t> simplify(const Simplification& what, Simplifier simplifier = Simplifier::Older);

/// The newer ones alone.
[[nodiscard]] std::vector<std::uint32_t> simplifyNewer(const Simplification& what, bool byAttributes);

} // namespace tegument::prep
