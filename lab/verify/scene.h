#pragma once
// Inside lab/verify: what is drawn, as the renderer and as the references see it.

#include "host/scene/view.h"
#include "host/scene/workspace.h"
#include "lab/verify/verify.h"

namespace tegument::verify {

struct Scene {
    Mesh mesh;
    Workspace workspace;
};

/// A square in z = 0, facing +z, `half` of its side from the middle each way (mm); it fills its texture.
[[nodiscard]] Mesh squareMesh(float half);

/// The options' mesh and workspace, else the built-in body under a light from the upper left, in front.
[[nodiscard]] Scene sceneOf(const VerifyOptions& options);

/// The light on the other side of the mesh: what faces the camera is lit through the body.
[[nodiscard]] Scene backlit(Scene scene);

} // namespace tegument::verify
