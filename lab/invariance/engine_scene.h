#pragma once
// Inside lab/invariance: a scene as an engine hands it to an effect, and the ways to put the same scene otherwise.

#include "host/mesh/mesh.h"
#include "host/scene/placement.h"
#include "host/scene/workspace.h"

#include <map>
#include <string>
#include <vector>

namespace tegument::invariance {

/// Camera and light stand in the world, in the world's unit.
struct EngineScene {
    Mesh mesh; // in its file's own unit and axes
    Placement placement;
    Workspace workspace;
    std::map<std::string, std::vector<double>> set; // as --set gives them
    bool split = false;                             // each draw of the mesh is two draws, of two ranges of its indices
    bool mirrored = false;                          // left and right are exchanged in the picture
};

/// The mesh's file has another unit; the world matrix scales back.
void changeMeshUnit(EngineScene& scene, double millimetres);
/// World matrix, camera and light in another unit, which gUnitMm tells the effect.
void changeWorldUnit(EngineScene& scene, double millimetres);
/// The host gives shaders another unit: the workspace is in millimetres as it was, but its lamps, which no semantic binds, are in the
/// world's.
void changeHostUnit(EngineScene& scene, double millimetres);
/// Everything larger: not the same scene for an effect that knows millimetres.
void enlarge(EngineScene& scene, double factor);

/// Mesh, camera, light and gravity turned together, then moved; the light's map is turned along. `degrees` as in Placement, `offset` in the
/// world's unit. The mesh must not be turned already.
void turnWorld(EngineScene& scene, const glm::vec3& degrees, const glm::vec3& offset);
/// Turned only; the host makes the light's matrix anew, whose up is the world's: the same map where the turn is about the vertical.
void turnWorldAndAim(EngineScene& scene, const glm::vec3& degrees);
/// Moved only; the host makes the light's matrix anew.
void moveWorld(EngineScene& scene, const glm::vec3& offset);

/// The file's axes and origin are others; the world matrix turns and moves back. The mesh must not be turned already.
void turnMesh(EngineScene& scene, const glm::vec3& degrees);
void moveMesh(EngineScene& scene, const glm::vec3& offset);

/// The file is its own mirror image; the world matrix mirrors it back.
void mirrorMesh(EngineScene& scene);
/// Mesh, camera and light in a mirror: the picture is mirrored.
void mirrorWorld(EngineScene& scene);

/// Triangles, their corners' order (not their sense) and vertices are shuffled.
void shuffle(EngineScene& scene);

} // namespace tegument::invariance
