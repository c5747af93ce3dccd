#pragma once
// Charts: triangles of a surface laid out in the plane. What finds them, judges them and packs them; unwrap.cpp puts it together.

#include "meshprep/prepare/surface.h"

#include <array>
#include <span>

namespace tegument::prep {

/// `places[i]` lays out triangle `faces[i]`, in mm: corners at one point of the surface have one place in a chart.
struct Chart {
    std::vector<std::uint32_t> faces;
    std::vector<std::array<glm::dvec2, 3>> places;
};

/// What the charts of a surface are made of: its triangles, with their normals and neighbours.
class Triangles {
public:
    static constexpr std::uint32_t kNone = UINT32_MAX;

    explicit Triangles(const Surface& surface);

    [[nodiscard]] const glm::dvec3& normal(std::uint32_t face) const { return normals_[face]; } // unit; 0 without an area
    [[nodiscard]] double area(std::uint32_t face) const { return areas_[face]; }
    [[nodiscard]] std::uint32_t point(std::uint32_t face, std::size_t corner) const { return surface_->pointAt(3 * face + corner); }
    [[nodiscard]] glm::dvec3 place(std::uint32_t face, std::size_t corner) const {
        return glm::dvec3(surface_->mesh.positions[surface_->mesh.indices[3 * face + corner]]);
    }
    /// The triangle of the same part beyond the edge from `corner` to the next: kNone at a border, and where more than two meet.
    [[nodiscard]] std::uint32_t beyond(std::uint32_t face, std::size_t corner) const { return beyond_[3 * face + corner]; }
    [[nodiscard]] std::size_t count() const { return areas_.size(); }

private:
    const Surface* surface_;
    std::vector<glm::dvec3> normals_;
    std::vector<double> areas_;
    std::vector<std::uint32_t> beyond_;
};

using Faces = std::vector<std::uint32_t>;

/// The triangles with an area in connected pieces of at most `most`; what is connected and no larger stays whole.
[[nodiscard]] std::vector<Faces> cutIntoPieces(const Triangles& triangles, std::size_t most);

/// Makes the chart as large as its part of the surface.
void scaleToSurface(const Triangles& triangles, Chart& chart);

/// Whether no two triangles of the chart overlap, none is turned over, and none is far smaller in the plane than the others.
[[nodiscard]] bool liesFlat(const Triangles& triangles, const Chart& chart);

/// Charts that lie flat, whatever the surface: of bounded turn of the normals, each seen from one side, smaller ones where these overlap.
[[nodiscard]] std::vector<Chart> boundedCharts(const Triangles& triangles, const Faces& piece);

/// Charts of a piece as xatlas makes them: any of them may overlap itself.
[[nodiscard]] std::vector<Chart> xatlasCharts(const Triangles& triangles, const Faces& piece);

struct Packing {
    std::vector<std::vector<std::array<glm::dvec2, 3>>> places; // of each chart, in the unit square
};

/// All charts beside each other in the unit square, by xatlas.
[[nodiscard]] Packing pack(std::span<const Chart> charts);

} // namespace tegument::prep
