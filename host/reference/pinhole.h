#pragma once
// A camera, or a light's pyramid, as rays: where a pixel looks. Right-handed, looks from `eye` to `target`; the field of view is
// horizontal.

#include <glm/glm.hpp>

namespace tegument::reference {

struct Pinhole {
    glm::dvec3 eye{0};
    glm::dvec3 right{1, 0, 0};
    glm::dvec3 up{0, 1, 0};
    glm::dvec3 forward{0, 0, -1};
    double tangentX = 1; // of half the angle
    double tangentY = 1;
    int width = 1;
    int height = 1;

    /// Through the centre of pixel (x, y), row 0 at the top. Unit.
    [[nodiscard]] glm::dvec3 ray(int x, int y) const;
    /// Where a point appears, in 0..1 from the upper left.
    [[nodiscard]] glm::dvec2 project(const glm::dvec3& point) const;
    /// The point, moved aside at its own depth to where it appears at a corner of a grid of this many pixels a side: rasterisers round the
    /// corners of triangles so. In front of the eye only.
    [[nodiscard]] glm::dvec3 onGrid(const glm::dvec3& point, double grid) const;
    /// mm across a pixel at this distance along the view.
    [[nodiscard]] double footprint(double distance) const { return 2 * distance * tangentX / width; }
};

/// `horizontalFov` in radians.
[[nodiscard]] Pinhole pinhole(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up, double horizontalFov, int width,
                              int height);

/// The square pyramid from `eye` that a sphere just fits into (docs/conventions.md: semantics of PointLight0), y up; the radius is enlarged
/// by a thousandth, as the host does it.
[[nodiscard]] Pinhole lightPyramid(const glm::dvec3& eye, const glm::dvec3& centre, double radius, int size);

} // namespace tegument::reference
