#pragma once
// meshoptimizer's simplification: quadric errors after M. Garland, P. Heckbert, Surface simplification using quadric error metrics,
// SIGGRAPH 1997.

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace tegument::prep {

struct Simplifier {
    enum class Version {
        Older, // 0.18, Debian's
        Newer, // that ./bootstrap fetches: after 0.22
        Newest // 1.3, that it fetches where it can
    };
    Version version = Version::Older;
    float normals = 0; // but Older: weight of an error of normals against one of places in the unit box; of texture coordinates, twice that

    bool operator==(const Simplifier&) const = default;
};

/// Those that this build has, the one that is nearest most often first.
[[nodiscard]] std::span<const Simplifier> simplifiers();

/// Normal and texture coordinates.
using SimplifiedAttributes = std::array<float, 5>;

struct Simplification {
    std::span<const std::uint32_t> from;                           // corners of triangles
    std::span<const glm::vec3> positions;                          // of unit size
    std::span<const SimplifiedAttributes> attributes{};            // of each position, for simplifiers that weigh them
    std::size_t counted = std::tuple_size_v<SimplifiedAttributes>; // of each's numbers: the first so many
    std::size_t triangles = 0;                                     // that are wanted; there may be more
    bool keepBorders = false;
    std::set<std::uint32_t> locked{}; // vertices that stay; not together with `keepBorders`
};

/// `simplifier`: one of `simplifiers()`.
[[nodiscard]] std::vector<std::uint32_t> simplify(const Simplification& what, Simplifier simplifier = {});

/// Those versions alone; nothing where this build lacks them.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> simplifyNewer(const Simplification& what, float normals);
[[nodiscard]] std::optional<std::vector<std::uint32_t>> simplifyNewest(const Simplification& what, float normals);

} // namespace tegument::prep
