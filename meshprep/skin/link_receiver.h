#pragma once
// What a texel that receives light by links asks of each source.

#include "meshprep/skin/link_cells.h"
#include "meshprep/skin/skin_links.h"

#include <array>
#include <optional>

namespace tegument {

inline constexpr int kLinksBeside = 2; // texels beside the charts that have lists, as if the surface went on: as far as interpolation asks

/// A Gaussian for links: narrower along the receiver's plane, in which a spline reads what it receives, than through it, mm^2.
struct LinkSpread {
    float along = 0;
    float through = 0;
};

/// Where light arrives, and what is left of the Gaussians for links there.
struct LinkReceiver {
    LinkCells::Middle middle;
    glm::vec3 normal{0}; // unit, either way
    std::array<LinkSpread, 2> spreads;
    LinkSpread fourth;
    float fourthReach = 0;
    float reach = 0;                           // mm: sources farther away do not count
    std::array<glm::vec3, 4> beside{};         // middles of the texels beside it,
    std::optional<std::array<float, 2>> whole; // where their light is taken back: variances, mm^2

    /// Of the fifth (0) or sixth (1) Gaussian, from a place, 1/mm^2. Below 0 here and there where light is taken back.
    [[nodiscard]] float sentBy(const glm::vec3& from, std::size_t gaussian) const;
    /// Of the way to a source, 1/mm^2.
    [[nodiscard]] float sent(const glm::vec3& way, const LinkSpread& spread) const;
    [[nodiscard]] float peak(const LinkSpread& spread) const { return sent(glm::vec3(0), spread); }
    /// The same of its distance in the map.
    [[nodiscard]] float sentAlong(const LinkCell& cell, const LinkSpread& spread) const;
    /// Distance in the map, mm in the receiver's own plane.
    [[nodiscard]] float flat(const LinkCell& cell) const;
};

/// A texel of kDestinationLevel: the spline's width is taken off the Gaussians along its plane.
[[nodiscard]] LinkReceiver linkReceiver(const LinkCells& cells, const LinkCells::Middle& middle, const LinkOptions& options);

/// A texel of this level that knows those beside it: an eighth of what each of them receives is taken back, so that the spline through all
/// of them goes through the light where they lie, however the skin is bent between them. None far from skin.
[[nodiscard]] std::optional<LinkReceiver> linkReceiverAmong(const Mesh& mesh, const LinkCells& cells, int level, const glm::ivec2& texel,
                                                            const LinkOptions& options);

} // namespace tegument
