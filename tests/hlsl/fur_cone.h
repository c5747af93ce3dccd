#pragma once
// What a ray meets of a strand between two layers, searched instead of solved: radius - distance is concave along the piece.

#include "tests/hlsl/function_case.h"

namespace tegument::test {

struct MetCone {
    dvec3 from;  // of the ray from the strand's axis, where the piece begins,
    dvec3 along; // and how that changes
    double radius = 0;
    double growth = 0;

    [[nodiscard]] double inside(double t) const { return radius + growth * t - length(from + along * t); }
    [[nodiscard]] double nearest() const {
        double low = 0;
        double high = 1;
        for (int i = 0; i < 80; ++i) {
            const double a = low + (high - low) / 3;
            const double b = high - (high - low) / 3;
            (inside(a) < inside(b) ? low : high) = inside(a) < inside(b) ? a : b;
        }
        return (low + high) / 2;
    }
    [[nodiscard]] double entry(double nearest) const {
        if (inside(nearest) < 0) return nearest;
        if (inside(0) >= 0) return 0;
        double low = 0;
        double high = nearest;
        for (int i = 0; i < 60; ++i)
            (inside((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
        return high;
    }
    /// Share of a pixel of this width.
    [[nodiscard]] double section(double t, double width) const {
        const double wide = max(radius + growth * t, width / 2);
        const double distance = length(from + along * t);
        return saturate((wide - distance) / width + 0.5) * saturate((radius + growth * t) / wide);
    }
    /// Of what is still free.
    [[nodiscard]] double covered(double nearest, double width) const {
        const double already = section(0, width);
        return saturate((section(nearest, width) - already) / max(1 - already, 1e-4));
    }
};

/// A piece of a ray in (place, height), and strands that bend: along their own side, and across it.
struct MetPiece {
    dvec3 normal, begin, along;
    double top = 1;
    double low = 0;
    dvec2 bend{0};
    dvec2 bendLow{0};
    double width = 0.3;
    double variation = 0.4;

    /// root: way from it to the begin. share: of the coat's height; stray: share of what the strand bends; random: of the strand.
    [[nodiscard]] MetCone cone(const dvec3& root, double share, double radius, double stray, const dvec3& random) const {
        const dvec3 flat = random - 0.5 - normal * dot(random - 0.5, normal);
        const dvec3 side = stray * normalize(flat);
        const dvec3 across = cross(normal, side);
        const dvec3 axis = bend.x * side + bend.y * across;
        const dvec3 axisLow = bendLow.x * side + bendLow.y * across;
        const double first = radius * (1 - top / share);
        return {root - axis, along + axis - axisLow, first, radius * (1 - low / share) - first};
    }
    /// x: coverage; y to w: shares of coverage times height, place along the strand, brightness.
    [[nodiscard]] dvec4 meet(const dvec4& met, const MetCone& cone, double share, const dvec3& random) const {
        const double nearest = cone.nearest();
        const double height = mix(top, low, cone.entry(nearest));
        const double tint = 1 + variation * (random.z - 0.5);
        const double more = (1 - met.x) * cone.covered(nearest, width);
        return met + more * dvec4(1, height, saturate(height / share), tint);
    }
};

} // namespace tegument::test
