#pragma once
// Grooms: strands of hair and fur as curves, whatever program made them. docs/design/grooms.md.

#include "host/support/result.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace tegument {

/// What the control points of a strand stand for. The last two pass from the second control point to the last but one.
enum class Spline { Linear, Bezier, BSpline, CatmullRom };

/// Lists are as long as there are points, or strands, or empty.
struct Groom {
    std::vector<glm::vec3> points;       // control points, from root to tip, one strand after the other; in units of the file
    std::vector<std::uint32_t> first{0}; // point of each strand, and of one behind the last
    std::vector<float> widths{};         // of each point: the strand's diameter there, in the same unit
    std::vector<glm::vec3> colors{};     // of each point: linear albedo
    std::vector<glm::vec2> rootUvs{};    // of each strand: texture coordinates of the skin at its root, v up
    std::vector<std::int32_t> ids{};     // of each strand
    std::vector<std::int32_t> guides{};  // of each strand: 1 a guide, by which others were made; 0 a strand to draw
    std::vector<std::int32_t> clumps{};  // of each strand: those of one number belong together
    Spline spline = Spline::Linear;
    bool pinned = false; // B-splines and Catmull-Rom splines that pass from the first control point to the last
    double unitMm = 1;   // of the points
    bool zIsUp = false;  // else y
    std::vector<Diagnostic> warnings{};

    [[nodiscard]] std::size_t strands() const { return first.size() - 1; }
    [[nodiscard]] std::size_t length(std::size_t strand) const { return first[strand + 1] - first[strand]; }
    [[nodiscard]] std::span<const glm::vec3> strand(std::size_t i) const { return std::span(points).subspan(first[i], length(i)); }
    /// The points gathered since the last strand become one.
    void endStrand() { first.push_back(static_cast<std::uint32_t>(points.size())); }
};

/// Control points of a strand, at least, for there to be a curve.
[[nodiscard]] std::size_t leastPoints(Spline spline);

/// As chains of points on the curves: so many to a span of a Bezier curve, half as many to one of a B-spline or a Catmull-Rom spline.
/// Linear strands stay as they are.
[[nodiscard]] Groom evaluated(Groom groom, std::size_t steps = 8);

/// Strands that `keep(i)` says.
template <class Keep>
[[nodiscard]] Groom strandsOf(const Groom& groom, Keep&& keep);

/// In millimetres, y up: lengths times the unit, z turned upwards where it was not.
[[nodiscard]] Groom inMillimetres(Groom groom);
/// The other way: in units of so many mm, with that axis up.
[[nodiscard]] Groom inUnits(Groom groom, double unitMm, bool zIsUp);

/// Places at equal distances along a chain of points, the first and the last among them, as a place between two points each: point n + t is
/// the share t behind point n.
[[nodiscard]] std::vector<float> evenPlaces(std::span<const glm::vec3> chain, std::size_t count);

/// Likewise, all points of the chain and more between them, in its longest segments: the curve stays where it is. `count`: at least as
/// many.
[[nodiscard]] std::vector<float> dividedPlaces(std::span<const glm::vec3> chain, std::size_t count);
/// What is there, of values at the points.
[[nodiscard]] inline glm::vec3 atPlace(std::span<const glm::vec3> list, float place) {
    const auto i = std::min(static_cast<std::size_t>(place), list.size() - 2);
    return glm::mix(list[i], list[i + 1], place - static_cast<float>(i));
}

/// Of strands as chains of points, in mm.
struct GroomFigures {
    std::size_t strands = 0;
    std::size_t guides = 0;
    std::size_t points = 0;
    std::size_t fewest = 0; // points of a strand
    std::size_t most = 0;
    glm::vec3 length{0}; // shortest, median, longest
    glm::vec3 width{0};  // likewise; 0: the file says nothing
    glm::vec3 low{0};
    glm::vec3 high{0};
};
[[nodiscard]] GroomFigures figuresOf(const Groom& groom);

template <class Keep>
Groom strandsOf(const Groom& groom, Keep&& keep) {
    Groom kept{.points = {}, .spline = groom.spline, .pinned = groom.pinned, .unitMm = groom.unitMm, .zIsUp = groom.zIsUp};
    kept.warnings = groom.warnings;
    for (std::size_t i = 0; i < groom.strands(); ++i) {
        if (!keep(i)) continue;
        const auto from = static_cast<std::ptrdiff_t>(groom.first[i]), to = static_cast<std::ptrdiff_t>(groom.first[i + 1]);
        const auto pointwise = [&](const auto& list, auto& copy) {
            if (!list.empty()) copy.insert(copy.end(), list.begin() + from, list.begin() + to);
        };
        pointwise(groom.points, kept.points);
        pointwise(groom.widths, kept.widths);
        pointwise(groom.colors, kept.colors);
        const auto whole = [&](const auto& list, auto& copy) {
            if (!list.empty()) copy.push_back(list[i]);
        };
        whole(groom.rootUvs, kept.rootUvs);
        whole(groom.ids, kept.ids);
        whole(groom.guides, kept.guides);
        whole(groom.clumps, kept.clumps);
        kept.endStrand();
    }
    return kept;
}

} // namespace tegument
