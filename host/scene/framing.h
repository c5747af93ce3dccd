#pragma once
// A camera that shows the whole of a mesh.

#include "host/mesh/mesh.h"
#include "host/scene/workspace.h"

namespace tegument {

/// Which way is up in a mesh file: glTF and most scans have y, programs for construction and printing z.
enum class UpAxis { Y, Z };

/// A vector of the frame in which y is up and z comes towards the viewer, along the axes of a mesh that has another up.
[[nodiscard]] glm::vec3 alongUp(UpAxis up, const glm::vec3& v);

/// The camera looks against `direction` (from the mesh to the eye, y up), as near as it can be with all vertices within kFramedShare of the
/// picture's width and height, as much room on one side as on the other. `aspect` is width over height. World millimetres. The mesh has a
/// vertex.
[[nodiscard]] Camera frameMesh(const Mesh& mesh, const glm::vec3& direction, UpAxis up, float horizontalFov, double aspect);

/// The same for all that the mesh covers while it turns about the vertical through the centre of its bounding sphere.
[[nodiscard]] Camera frameTurningMesh(const Mesh& mesh, const glm::vec3& direction, UpAxis up, float horizontalFov, double aspect);

/// What is seen once the mesh has turned by `angle` (radians, counter-clockwise from above) about the axis through `pivot` along the
/// camera's up: camera and light, both of the frame "world", go round it the other way. World millimetres.
[[nodiscard]] Workspace turnedScene(const Workspace& workspace, const glm::dvec3& pivot, double angle);

/// The rest is for what stands out from the mesh, such as fur.
inline constexpr double kFramedShare = 0.84;

} // namespace tegument
