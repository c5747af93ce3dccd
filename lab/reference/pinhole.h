#pragma once
// A camera, or a light's pyramid or box, as rays: where a pixel looks. Right-handed, looks from `eye` to `target`; the field of view is
// horizontal. Rays of a parallel view start on the plane of `eye` and go along `forward`.

#include "host/scene/workspace.h"

#include <glm/glm.hpp>

namespace tegument::reference {

struct Pinhole {
    glm::dvec3 eye{0};
    glm::dvec3 right{1, 0, 0};
    glm::dvec3 up{0, 1, 0};
    glm::dvec3 forward{0, 0, -1};
    double tangentX = 1; // of half the angle; parallel: half the width, mm
    double tangentY = 1;
    int width = 1;
    int height = 1;
    bool parallel = false;

    /// Through the centre of pixel (x, y), row 0 at the top. Unit.
    [[nodiscard]] glm::dvec3 ray(int x, int y) const;
    /// Where that ray starts.
    [[nodiscard]] glm::dvec3 start(int x, int y) const;
    /// Where the ray to a point starts.
    [[nodiscard]] glm::dvec3 origin(const glm::dvec3& point) const;
    /// Where a point appears, in 0..1 from the upper left.
    [[nodiscard]] glm::dvec2 project(const glm::dvec3& point) const;
    /// In front of the eye and in the picture; within `margin` pixels of its border too.
    [[nodiscard]] bool shows(const glm::dvec3& point, double margin = 0) const;
    /// The point, moved aside at its own depth to where it appears at a corner of a grid of this many pixels a side: rasterisers round the
    /// corners of triangles so. In front of the eye only.
    [[nodiscard]] glm::dvec3 onGrid(const glm::dvec3& point, double grid) const;
    /// mm across a pixel at this distance along the view.
    [[nodiscard]] double footprint(double distance) const { return 2 * (parallel ? 1 : distance) * tangentX / width; }

    /// From the axis to the pixel's centre, 1 in front of the eye, or on its plane.
    [[nodiscard]] glm::dvec3 aside(int x, int y) const;
};

/// `horizontalFov` in radians.
[[nodiscard]] Pinhole pinhole(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up, double horizontalFov, int width,
                              int height);

/// The square pyramid from `eye` that a sphere just fits into (docs/conventions.md: semantics of PointLight0), y up; the radius is enlarged
/// by a thousandth, as the host does it. From inside of the sphere, or so near that the angle would be wider, 160 degrees.
[[nodiscard]] Pinhole lightPyramid(const glm::dvec3& eye, const glm::dvec3& centre, double radius, int size);

/// The same for light that goes along `direction` everywhere: the cube around that sphere, seen from the middle of its near side.
[[nodiscard]] Pinhole lightBox(const glm::dvec3& direction, const glm::dvec3& centre, double radius, int size);
/// What the light's map of `size` texels covers: fitted to the bounds, or as the light itself says.
[[nodiscard]] Pinhole lightView(const Light& light, const Bounds& bounds, int size);

} // namespace tegument::reference
