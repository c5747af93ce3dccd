#pragma once
// Where strands stand: random roots that keep a distance from each other (seed 004, "geracao dos pelos"), on a texture that repeats or on
// the sphere of directions. One value of the seed always gives the same fur.

#include "host/support/result.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace tegument {

struct FurOptions {
    double density = 0.08;  // strands per texel of the map; N = density * width * height
    double spacing = 2.0;   // least distance between two roots, in texels; 0 leaves them independent
    double radius = 0.5;    // of a strand at its root, in texels
    double shortest = 1.0;  // lengths lie evenly between this and 1
    bool taper = false;     // strands are cones: the map's alpha falls from the length at the axis to 0 at the radius
    std::uint32_t seed = 1; // of the noise that places roots and lengths
};

struct Strand {
    glm::dvec3 root{0}; // texels (x, y, 0) or a unit direction
    double length = 1;  // share of the longest, (0, 1]
};

struct StrandSet {
    std::vector<Strand> strands;
    std::size_t wanted = 0; // N; fewer stand where the spacing leaves no room
};

/// At most kMostStrands. TG7xxx where density, spacing, radius or length make no sense.
[[nodiscard]] Result<StrandSet> strandsOnTexture(int width, int height, const FurOptions& options);

/// `texels`: how many the map has; a texel's side is then sqrt(4 pi / texels) radians.
[[nodiscard]] Result<StrandSet> strandsOnSphere(std::size_t texels, const FurOptions& options);

/// The side of a texel as an angle, if all have the same area.
[[nodiscard]] double texelAngle(std::size_t texels);

} // namespace tegument
