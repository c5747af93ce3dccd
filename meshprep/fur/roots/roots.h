#pragma once
// Everything about the roots of fur on a mesh: where they stand, and how each strand is long, thick, inclined. docs/design/fur.md, "Roots".
// Lean and density of the coat at any place, from samples on the surface: what vertices of shells need, which lie between roots.

#include "meshprep/fur/roots/fur_surface.h"
#include "meshprep/fur/roots/point_grid.h"
#include "meshprep/fur/roots/root_maps.h"

#include <optional>
#include <span>

namespace tegument {

/// A point of the surface, mm, mesh space.
struct CoatSample {
    glm::vec3 position{0};
    glm::vec3 normal{0, 0, 1};
    glm::vec3 lean{0};
    float density = 1; // share of the full density, 0..1
};

/// Moving least squares: at each place the linear function that fits the samples around best, near ones counting more (D. Levin, The
/// approximation power of moving least-squares, 1998). A mean alone would be wrong beside the surface, where grids have most of their
/// nodes.
class CoatField {
public:
    /// `samples` must outlive this. Those farther than `radius` do not count.
    CoatField(std::span<const CoatSample> samples, float radius);

    /// Lean and density; (0, 0, 0, 0) where no sample is near. No lean is longer than the longest of a sample.
    [[nodiscard]] glm::vec4 at(const glm::vec3& place) const;

private:
    std::span<const CoatSample> samples_;
    float radius_;
    float longest_ = 0;
    PointGrid grid_;
};

/// Lengths in units of the mean spacing 1 / sqrt(density), unless stated.
struct RootOptions {
    std::size_t count = 70'000;    // roots where the density map is 1 everywhere
    std::optional<double> density; // roots per mm^2 instead; the count is then this times the mesh's area
    double spacing = 0.72;         // least distance of two roots
    double radius = 0.3;           // of a strand at its root
    double thinnest = 0.8;         // strands' radii lie evenly between this share and 1
    double shortest = 0.7;         // strands' lengths lie evenly between this share and 1
    double reach = 1.5;            // how far from its root a strand can be looked up
    double cell = 1.0;             // side of the grid's cells
    double lean = 0.0;             // how far tips lean along `comb` or the direction map, in lengths of the strand
    glm::dvec3 comb{0, -1, 0};     // mesh space; where there is no direction map
    double curl = 1.0;             // strands' curl lies evenly between 0 and this, at most 1
    double furLength = 0.06;       // for the report only: share of the ball's radius for which shortened strands are counted
    std::uint32_t seed = 1;
    unsigned threads = 0; // 0: all
    std::optional<FurMap> densityMap;
    std::optional<FurMap> lengthMap;
    std::optional<FurMap> directionMap;
};

/// Lengths in mm, mesh space.
struct Root {
    glm::vec3 position{0};
    glm::vec3 normal{0, 0, 1};
    glm::vec3 lean{0}; // perpendicular to the normal
    float radius = 0;
    float share = 1; // of the coat's length, (0, 1]
    float limit = 0; // longest that does not cross other layers
    float curl = 0;
    float random = 0; // a multiple of 2^-24, [0, 1)
    std::uint32_t triangle = 0;
};

struct RootSet {
    std::vector<Root> roots;
    std::vector<CoatSample>
        coat;               // about one to a root of the full density, bald parts too; none where lean and density are the same everywhere
    std::size_t wanted = 0; // fewer stand where the spacing leaves no room, or where the length map is 0
    double area = 0;        // mm^2
    double density = 0;     // full density, roots per mm^2
    double distance = 0;    // least, mm
    double radius = 0;      // greatest, mm
    double reach = 0;       // mm
    double cell = 0;        // mm
    glm::dvec3 centre{0};   // of the mesh's minimal ball
    double ballRadius = 0;
    SurfaceFigures figures;               // of the mesh
    std::size_t shortenedByCurvature = 0; // of those that a coat of furLength would make longer
    std::size_t shortenedByOpposite = 0;
    struct Seconds {
        double surface = 0;
        double scatter = 0;
        double limits = 0;
        double strands = 0;
    } seconds;
};

/// More do not fit into a texture of 4096 x 4096 texels, the largest of Direct3D 9.
inline constexpr double kMostRoots = 1.5e6;

/// The mesh as loadMesh gives it: normals, bounds, tangents where there are texture coordinates. TG7103 options that make no sense, TG7104
/// too many roots, TG7105 no area, TG7106 a map that the mesh has no coordinates for.
[[nodiscard]] Result<RootSet> makeRoots(const Mesh& mesh, const RootOptions& options);

} // namespace tegument
