#pragma once
// The head as the effects get it: triangles with atlas coordinates, still knowing where each corner lies in the source's region masks.

#include "host/mesh/mesh.h"
#include "meshprep/human/bust.h"

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace tegument {

struct HeadSurface {
    Mesh mesh;                        // normals of the limit surface, tangents, parts "skin" and "eyes"; v down
    std::vector<glm::vec2> sourceUvs; // of each corner (as mesh.indices), v up, in the file's atlas
    std::vector<BustPart> parts;      // of each triangle
    std::array<Eyeball, 2> eyes;      // left, right
    std::size_t coarseQuads = 0;      // before subdivision, without support
    std::size_t hiddenQuads = 0;      // of them: taken away because nothing outside sees them
    double texelsPerMmAt1024 = 0;     // mean over the skin, the bottom left out
    double chinToCrownMm = 0;
    float chinHeight = 0;                // y of the lowest point of the chin
    std::vector<std::string> chartNotes; // one line each: area, texels per mm at 1024
};

struct HeadSurfaceOptions {
    int subdivisionLevels = 2;
    float neckMm = 42;           // from the chin down to the level cut
    double gutter = 10.0 / 1024; // of the unit square, between charts
};

/// Subdivides, takes hidden faces away, cuts the neck level and closes it, packs the charts, makes triangles and tangents. TG7006, TG7007
/// when the charts cannot be packed.
[[nodiscard]] Result<HeadSurface> makeHeadSurface(const Bust& bust, const HeadSurfaceOptions& options);

} // namespace tegument
