#pragma once
// Where the middle of a mesh is and how far it reaches.

#include "meshprep/prepare/surface.h"

namespace tegument::prep {

enum class CentreMode {
    Ball, // the minimal bounding ball
    Box,  // the source document's: middle of the bounding box, radius half of its diagonal
    None  // stay where it is; bounded by the minimal ball
};

struct Centring {
    glm::dvec3 moved{0};      // added to every position of the file, mm
    glm::dvec3 place{0};      // where the positions of a mesh count from that lies too far out for floats; 0 for others
    double radius = 0;        // of the ball that was asked for
    double minimalRadius = 0; // of the minimal one
    std::size_t vertices = 0; // that moved
};

/// Moves the centre to the origin, and fills `mesh.bounds`.
Centring centre(Surface& surface, CentreMode mode);

} // namespace tegument::prep
