#pragma once
// One normal for everything at one place: what shells of fur and smooth shading need.

#include "meshprep/prepare/surface.h"

namespace tegument::prep {

enum class NormalMode {
    Sum,             // of the normals of all corners at the place
    Seed,            // of those that differ in any bit, as the source document prints it
    UniqueTolerance, // of those that differ by more than kSameNormal
    Angle,           // of the face normals, each weighted by its angle at the place
    Keep             // the file's own
};

/// Which corners share a normal.
enum class NormalSharing {
    Place, // all at one place
    Sheet, // so, but the two sides of components made of triangles back to back do not: the sum of their normals would be 0
    Fan    // triangles round a place that are joined by edges
};

struct NormalOptions {
    NormalMode mode = NormalMode::Angle;
    NormalSharing sharing = NormalSharing::Sheet;
};

struct NormalChanges {
    std::size_t normals = 0; // vertices whose normal is new
    std::size_t split = 0;   // vertices added, where one place needs several normals
};

/// Sum, Seed and UniqueTolerance take a corner's normal from the file where it has usable ones, otherwise from the corner's triangle.
/// All normals are unit, whatever the mesh's size; where a sum is 0, one of the normals that went into it is taken.
NormalChanges makeNormals(Surface& surface, const NormalOptions& options);

} // namespace tegument::prep
