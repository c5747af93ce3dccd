#pragma once
// Matrices of the camera and of the light's pyramid, as the shaders use them (docs/conventions.md).
//
// Storage: every matrix here is the ROW-VECTOR matrix M of `mul(v, M)`, and `m[row][col]` in GLM's indexing is its element in that row and
// column. Memory is therefore M row by row. Two consequences:
//  * GLM's `m * glm::vec4(v)` computes mul(v, M), and GLM's `b * a` is the matrix "first a, then b": mul(mul(v, A), B).
//  * an HLSL constant with the default packing (column_major) takes the transpose of this memory: glm::transpose(m).

#include "host/mesh/mesh.h"
#include "host/scene/workspace.h"

#include <glm/glm.hpp>

namespace tegument {

/// View space is right-handed: x right, y up, the view looks along -z. Clip space is Direct3D's: z/w is 0 at the near plane and 1 at the
/// far plane, and w is the distance along the view direction in mm.
struct Matrices {
    glm::mat4 view{1};
    glm::mat4 projection{1};
    glm::mat4 viewProjection{1}; // product in double precision, rounded once
    glm::mat4 inverseView{1};    // inverses likewise from double precision
    glm::mat4 inverseProjection{1};
    glm::mat4 inverseViewProjection{1};
    glm::vec3 position{0};   // of the eye or the light, world mm
    float horizontalFov = 0; // radians; 0 where the projection is parallel
    float nearPlane = 0;     // mm along the view direction, > 0; 0 where the projection is parallel
    float farPlane = 0;
};

/// `aspect` is width / height in pixels; the camera's field of view is horizontal. The camera's planes must be set (placeScene does it).
[[nodiscard]] Matrices cameraMatrices(const Camera& camera, double aspect);

/// The light's square pyramid (aspect 1): apex at the light, aimed at the centre of the bounding sphere, field of view and planes fitted to
/// the sphere. A light inside the sphere, or so near that the cone opens wider than 160 degrees, gets a pyramid of 160 degrees and a near
/// plane of 1/1000 of the far plane: what lies outside is not in its map. Light::fov takes the place of the fitted angle.
/// Parallel light: a parallel projection of a square that the sphere just fits into, or of Light::width, along its direction; w is 1
/// everywhere, and `position` is the middle of the near plane.
[[nodiscard]] Matrices lightMatrices(const Light& light, const Bounds& bounds);

} // namespace tegument
