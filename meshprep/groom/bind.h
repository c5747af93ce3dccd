#pragma once
// Grooms on a skin, as what effects draw: ribbons, and a texture of roots that holds the curves. docs/design/grooms.md.

#include "host/image/image.h"
#include "host/mesh/mesh.h"
#include "host/support/result.h"
#include "meshprep/groom/groom.h"

namespace tegument {

struct BindOptions {
    std::optional<double> snap;  // mm: roots that near are moved onto the skin; default: a fiftieth of its radius
    std::optional<double> width; // mm, of every strand; default: as the groom says, else kUsualWidth
    unsigned threads = 0;
};
inline constexpr double kUsualWidth = 0.08; // mm: human hair

struct BoundFigures {
    std::size_t strands = 0;
    std::size_t points = 0;    // of each
    std::size_t guides = 0;    // that are not drawn
    std::size_t off = 0;       // strands whose roots are further from the skin: they stay where they are
    double moved = 0;          // mm: how far a root was moved, the median
    double error = 0;          // mm: how far a root is from the skin then, at most
    std::size_t resampled = 0; // strands of more points, which have fewer now
    double resampledError = 0; // mm: how far a point that went is from the strand that is left, at most
    bool madeSkin = false;
};

/// Gives the mesh the groom's strands in place of those it has; a mesh without triangles gets a point amid the roots as its skin. Returns
/// the texture of roots, which writeDds takes. Both in mm, y up where the mesh is: the groom as readGroom gives it. TG7110 more strands
/// than the texture holds.
[[nodiscard]] Result<Image> bindGroom(Mesh& mesh, Groom groom, const BindOptions& options, BoundFigures& figures);

/// The strands that a texture of roots says: its curves, or where there are none, root + length (normal t + lean t²), in mm of the mesh.
/// `length`: of the coat, a share of the mesh's radius. TG7109 no roots.
[[nodiscard]] Result<Groom> groomOfRoots(const Mesh& mesh, const Image& roots, double length);

} // namespace tegument
