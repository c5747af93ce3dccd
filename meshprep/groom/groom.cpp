#include "meshprep/groom/groom.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tegument {

namespace {

using Weights = std::array<float, 4>;

/// Of four control points at a place within a span.
Weights weightsAt(Spline spline, float t) {
    const float s = 1 - t;
    if (spline == Spline::Bezier) return {s * s * s, 3 * t * s * s, 3 * t * t * s, t * t * t};
    if (spline == Spline::BSpline)
        return {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * s * s * s - 6 * s * s + 4) / 6, t * t * t / 6};
    return {(-t + 2 * t * t - t * t * t) / 2, (2 - 5 * t * t + 3 * t * t * t) / 2, (t + 4 * t * t - 3 * t * t * t) / 2,
            (-t * t + t * t * t) / 2};
}

/// The control points of a pinned spline have one more at each end, mirrored about it.
template <class Value>
std::vector<Value> withEnds(std::span<const Value> control, bool pinned) {
    std::vector<Value> all(control.begin(), control.end());
    if (!pinned || control.size() < 2) return all;
    all.insert(all.begin(), control[0] * 2.0F - control[1]);
    all.push_back(control.back() * 2.0F - control[control.size() - 2]);
    return all;
}

template <class Value>
void appendCurve(std::span<const Value> control, const Groom& groom, std::size_t steps, std::vector<Value>& points) {
    const std::vector<Value> all = withEnds(control, groom.pinned && groom.spline != Spline::Bezier);
    const std::size_t stride = groom.spline == Spline::Bezier ? 3 : 1;
    for (std::size_t from = 0; from + 3 < all.size(); from += stride)
        for (std::size_t step = from == 0 ? 0 : 1; step <= steps; ++step) {
            const Weights w = weightsAt(groom.spline, static_cast<float>(step) / static_cast<float>(steps));
            points.push_back(all[from] * w[0] + all[from + 1] * w[1] + all[from + 2] * w[2] + all[from + 3] * w[3]);
        }
}

/// Sets places and widths to the unit, and lays one axis where the other was.
void convert(Groom& groom, float scale, float turned) {
    for (glm::vec3& p : groom.points)
        p = (turned == 0 ? p : glm::vec3(p.x, turned * p.z, -turned * p.y)) * scale;
    for (float& width : groom.widths)
        width *= scale;
}

glm::vec3 spread(std::vector<float>& values) {
    if (values.empty()) return glm::vec3(0);
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return {*std::ranges::min_element(values), *middle, *std::ranges::max_element(values)};
}

} // namespace

std::size_t leastPoints(Spline spline) {
    return spline == Spline::Linear ? 2 : 4;
}

Groom evaluated(Groom groom, std::size_t steps) {
    if (groom.spline == Spline::Linear) return groom;
    if (groom.spline != Spline::Bezier) steps = std::max<std::size_t>(1, steps / 2);
    Groom chains;
    for (std::size_t i = 0; i < groom.strands(); ++i) {
        appendCurve(groom.strand(i), groom, steps, chains.points);
        const auto along = [&](const auto& list, auto& points) {
            if (!list.empty()) appendCurve(std::span(list).subspan(groom.first[i], groom.length(i)), groom, steps, points);
        };
        along(groom.widths, chains.widths);
        along(groom.colors, chains.colors);
        chains.endStrand();
    }
    groom.points = std::move(chains.points);
    groom.first = std::move(chains.first);
    groom.widths = std::move(chains.widths);
    groom.colors = std::move(chains.colors);
    groom.spline = Spline::Linear;
    groom.pinned = false;
    return groom;
}

Groom inMillimetres(Groom groom) {
    convert(groom, static_cast<float>(groom.unitMm), groom.zIsUp ? 1 : 0);
    groom.unitMm = 1;
    groom.zIsUp = false;
    return groom;
}

Groom inUnits(Groom groom, double unitMm, bool zIsUp) {
    if (groom.unitMm == unitMm && groom.zIsUp == zIsUp) return groom;
    const float turned = groom.zIsUp == zIsUp ? 0 : zIsUp ? -1 : 1;
    convert(groom, static_cast<float>(groom.unitMm / unitMm), turned);
    groom.unitMm = unitMm;
    groom.zIsUp = zIsUp;
    return groom;
}

std::vector<float> evenPlaces(std::span<const glm::vec3> chain, std::size_t count) {
    std::vector<double> along{0};
    for (std::size_t i = 1; i < chain.size(); ++i)
        along.push_back(along.back() + static_cast<double>(glm::distance(chain[i - 1], chain[i])));
    std::vector<float> places;
    std::size_t segment = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double wanted = along.back() * static_cast<double>(i) / static_cast<double>(count - 1);
        while (segment + 2 < along.size() && along[segment + 1] < wanted)
            ++segment;
        const double step = along[segment + 1] - along[segment];
        places.push_back(
            static_cast<float>(static_cast<double>(segment) + (step > 0 ? std::clamp((wanted - along[segment]) / step, 0.0, 1.0) : 0.0)));
    }
    places.front() = 0;
    places.back() = static_cast<float>(chain.size() - 1);
    return places;
}

std::vector<float> dividedPlaces(std::span<const glm::vec3> chain, std::size_t count) {
    std::vector<std::size_t> parts(chain.size() - 1, 1);
    std::vector<float> lengths;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
        lengths.push_back(glm::distance(chain[i], chain[i + 1]));
    for (std::size_t points = chain.size(); points < count; ++points) {
        std::size_t longest = 0;
        for (std::size_t i = 1; i < parts.size(); ++i)
            if (lengths[i] * static_cast<float>(parts[longest]) > lengths[longest] * static_cast<float>(parts[i])) longest = i;
        ++parts[longest];
    }
    std::vector<float> places;
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (std::size_t k = 0; k < parts[i]; ++k)
            places.push_back(static_cast<float>(i) + static_cast<float>(k) / static_cast<float>(parts[i]));
    places.push_back(static_cast<float>(parts.size()));
    return places;
}

GroomFigures figuresOf(const Groom& groom) {
    const auto unit = static_cast<float>(groom.unitMm);
    GroomFigures figures{.strands = groom.strands(), .points = groom.points.size(), .fewest = SIZE_MAX};
    figures.guides = static_cast<std::size_t>(std::ranges::count(groom.guides, 1));
    std::vector<float> lengths;
    for (std::size_t i = 0; i < groom.strands(); ++i) {
        figures.fewest = std::min(figures.fewest, groom.length(i));
        figures.most = std::max(figures.most, groom.length(i));
        const std::span<const glm::vec3> points = groom.strand(i);
        float length = 0;
        for (std::size_t k = 1; k < points.size(); ++k)
            length += glm::distance(points[k - 1], points[k]);
        lengths.push_back(length * unit);
    }
    figures.length = spread(lengths);
    std::vector<float> widths = groom.widths;
    figures.width = spread(widths) * unit;
    if (groom.points.empty()) return figures;
    figures.low = figures.high = groom.points.front();
    for (const glm::vec3& p : groom.points) {
        figures.low = glm::min(figures.low, p);
        figures.high = glm::max(figures.high, p);
    }
    figures.low *= unit;
    figures.high *= unit;
    return figures;
}

} // namespace tegument
