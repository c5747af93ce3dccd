#pragma once
// The surface of a mesh as texels of its own texture space, in a hierarchy: each cell knows where it lies, how large it is, and how far its
// surface reaches. Cells of the charts only; a cell across a gap between charts reaches from one to the other.

#include "host/mesh/mesh.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace tegument {

/// mm and mm^2.
struct LinkCell {
    glm::vec3 place{0}; // centre of its surface
    glm::vec2 uv{0};    // the same in the map, in samples
    float area = 0;     // 0: no chart
    float radius = 0;   // around `place`, over all of its surface
    float covered = 0;  // share of its square that lies on charts
};

inline constexpr int kLinkLevels = 6;        // of the hierarchy: squares of 512, 256 ... 16 cells
inline constexpr int kFinestLinkCells = 512; // along a side
inline constexpr int kSamplesAlongCell = 2;  // of a cell of the finest level, along each side
inline constexpr int kLinkSamples = kFinestLinkCells * kSamplesAlongCell;
inline constexpr std::uint32_t kNoSkin = UINT32_MAX;
inline constexpr int kDestinationLevel = 1; // 256 x 256: the texels that links bring light to

/// Which samples of the unit square are skin, kLinkSamples along each side: alpha of the colour map that travels in the mesh. Empty: all.
[[nodiscard]] std::vector<std::uint8_t> skinMask(const Mesh& mesh);

class LinkCells {
public:
    /// Texture coordinates in the unit square count; where charts overlap, the first triangle does. `skin`: skinMask().
    LinkCells(const Mesh& mesh, const std::vector<std::uint8_t>& skin);

    [[nodiscard]] static constexpr int side(int level) { return kFinestLinkCells >> level; }
    [[nodiscard]] const std::vector<LinkCell>& level(int level) const { return levels_[static_cast<std::size_t>(level)]; }
    [[nodiscard]] const LinkCell& at(int level, int x, int y) const {
        return this->level(level)[static_cast<std::size_t>(y) * static_cast<std::size_t>(side(level)) + static_cast<std::size_t>(x)];
    }
    /// Where a cell's middle lies, and how large the cell is there (mm): of the finest level's nearest skin, continued in its plane. So
    /// cells over the border of a chart, and up to `beside` of them beyond it, stand where the surface would go on. Nothing farther out.
    struct Middle {
        glm::vec3 place{0};
        float side = 0;
        glm::vec2 uv{0};     // in samples
        glm::vec3 alongU{0}; // mm from sample to sample
        glm::vec3 alongV{0};
    };
    [[nodiscard]] std::optional<Middle> middle(const Mesh& mesh, int level, int x, int y, int beside) const;
    /// Side of a usual cell, mm: the square root of the median area of those that lie wholly on charts; 0 without charts.
    [[nodiscard]] float usualSide(int level) const { return usual_[static_cast<std::size_t>(level)]; }

private:
    std::array<std::vector<LinkCell>, kLinkLevels> levels_;
    std::vector<std::uint32_t> corners_; // of each sample: the first index of its triangle, or kNoSkin
    std::array<float, kLinkLevels> usual_{};
};

} // namespace tegument
