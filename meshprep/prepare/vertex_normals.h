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

/// Corners are grouped by place; or, finer, by fan: triangles that are joined by edges.
enum class NormalSharing { Place, Fan };

struct NormalOptions {
    NormalMode mode = NormalMode::Angle;
    NormalSharing sharing = NormalSharing::Place;
};

struct NormalChanges {
    std::size_t normals = 0; // vertices whose normal is new
    std::size_t split = 0;   // vertices added, where triangles back to back (or fans) need two normals at one place
};

/// Sum, Seed and UniqueTolerance take a corner's normal from the file where it has usable ones, otherwise from the corner's triangle.
/// Triangles back to back never share a normal: it would be 0. All normals are unit, whatever the mesh's size.
NormalChanges makeNormals(Surface& surface, const NormalOptions& options);

} // namespace tegument::prep
