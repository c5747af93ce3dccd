#pragma once
// What the printed pipeline does to the edge of a shadow on a plane: its passes in one dimension, in double precision, against the closed
// form.

#include "lab/reference/profile.h"

#include <functional>
#include <vector>

namespace tegument::reference {

/// A response to light on x > 0, by position in mm.
using EdgeResponse = std::function<glm::dvec3(double x)>;

struct EdgeError {
    glm::dvec3 largest{0}; // worst over the phases
    glm::dvec3 rms{0};     // over 10 mm on both sides and all phases
};

/// Error of `response(phase)` against the profile's half-plane, both seen through a pixel `footprint` mm wide; phases are the positions of
/// the edge between two texel centres, 0 .. 1 in `phases` steps.
[[nodiscard]] EdgeError edgeError(const std::function<EdgeResponse(double phase)>& response, double footprint, int phases);

struct EdgePipeline {
    double texel = 0.3;      // mm
    bool normalised = false; // kernel divided by its sum, spacings from its variance less that of interpolation; the texel's own counted
    double countedFirst = 0; // variance that map 1 counts for before the first blur, mm^2, where not normalised
    int exact = 0;           // narrowest Gaussians evaluated per pixel instead of taken from their maps
    bool sharpFirst = false; // the narrowest is the sharp edge itself, per pixel
};

/// Texels hold the mean of the light over them; map 1 is that, each further map is blurred from the one before by the seven printed taps,
/// the sum is read back linearly between texels.
[[nodiscard]] EdgeResponse edgeOf(const EdgePipeline& pipeline, double phase);

/// Light itself, not diffused.
[[nodiscard]] EdgeResponse sharpEdge();

} // namespace tegument::reference
