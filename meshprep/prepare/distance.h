#pragma once
// How far two surfaces are from one another.

#include <glm/glm.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace tegument::prep {

struct SurfaceDistance {
    double greatest = 0; // no point of either surface is further from the other one
    double reached = 0;  // some point is as far as this
    double rms = 0;      // of corners and centroids of the first surface from the second; of many, a sample in equal steps
};

/// What is told of it: the bound, where it is near to what was reached. Where the surfaces lie nearly within one another it is not, and
/// says nothing of them: then what was reached, whose error by sampling is the rest.
[[nodiscard]] inline double told(const SurfaceDistance& distance) {
    constexpr double kNearBound = 1.1;
    return distance.greatest <= kNearBound * distance.reached ? distance.greatest : distance.reached;
}

/// Soon known, and seldom far from the truth. Where thousands of triangles cross one another it names no places.
struct RoughDistance {
    struct Bridge {
        std::uint32_t triangle = 0; // of the second surface
        std::uint32_t nearest = 0;  // the nearest corner of the first one
    };
    double greatest = 0;              // of the first surface's corners and of many points of the other
    std::vector<std::uint32_t> peaks; // corners of the first surface where it is at least half as much, from the greatest on
    std::vector<Bridge> bridges;      // likewise triangles of the other one
};

/// What is told of a surface that is too far off.
enum class TooFar {
    HasPeaks, // how far its corners are
    IsLeft    // that it is: nothing else is looked at
};

/// Distances of surfaces over the same positions from one of them.
class DistanceFrom {
public:
    DistanceFrom(const std::vector<glm::vec3>& positions, std::span<const std::uint32_t> triangles);
    ~DistanceFrom();
    DistanceFrom(const DistanceFrom&) = delete;
    DistanceFrom& operator=(const DistanceFrom&) = delete;

    /// `greatest` is at most 2 % above `reached`, unless the surfaces lie nearly within one another: then it may be more, and is still
    /// true. Safe to call from several threads.
    [[nodiscard]] SurfaceDistance to(std::span<const std::uint32_t> triangles) const;

    /// As `reached` of `to`; of what is further than `enough`, some distance that is more than that.
    [[nodiscard]] double reached(std::span<const std::uint32_t> triangles, double enough) const;

    /// Infinite for no triangles. `most`: peaks, and bridges. What is further than `enough` is too far: of that some distance is told that
    /// is reached.
    [[nodiscard]] RoughDistance roughly(std::span<const std::uint32_t> triangles, std::size_t most,
                                        double enough = std::numeric_limits<double>::infinity(), TooFar tooFar = TooFar::HasPeaks) const;

private:
    struct State;
    class Both;
    std::unique_ptr<State> state_;
};

[[nodiscard]] SurfaceDistance distance(const std::vector<glm::vec3>& positions, std::span<const std::uint32_t> from,
                                       std::span<const std::uint32_t> to);

} // namespace tegument::prep
