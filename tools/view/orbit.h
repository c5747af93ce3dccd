#pragma once
// Camera and light as the mouse moves them. Lengths in mm of the world, angles in radians.

#include "host/scene/workspace.h"

namespace tegument::view {

/// The camera's axes in the world.
struct Axes {
    glm::dvec3 right;
    glm::dvec3 up;
    glm::dvec3 back;
};
[[nodiscard]] Axes axesOf(const Camera& camera);

/// About the target: `right` about the world's up of the camera, `up` about its right axis, short of the poles.
void orbit(Camera& camera, double right, double up);
/// Camera and target together, by shares of the picture's width.
void pan(Camera& camera, double right, double up);
/// The distance to the target times `factor`.
void dolly(Camera& camera, double factor);

/// The light about the camera's target, parallel light by its direction: it moves on the screen the way the mouse does while it is in
/// front.
void orbitLight(Light& light, const Camera& camera, double right, double up);
/// A point light's distance changes no brightness at the centre: `color` is what arrives there.
void dollyLight(Light& light, const Camera& camera, double factor);

} // namespace tegument::view
