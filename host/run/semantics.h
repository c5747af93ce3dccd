#pragma once
// Values that the host binds to parameters by semantic (docs/conventions.md, "What the host binds").
// Where a session's scene is, and its camera and light in the world. Needs no GPU.

#include "host/effect/model.h"
#include "host/mesh/mesh.h"
#include "host/run/run_options.h"
#include "host/run/target_desc.h"
#include "host/scene/view.h"
#include "host/scene/workspace.h"

#include <optional>
#include <string>
#include <vector>

namespace tegument::run {

/// Everything that semantics can ask for, in units of the world.
struct SceneView {
    bool hasMesh = false;
    float unitMm = 1; // millimetres in one unit of the world
    Bounds bounds;    // of the mesh, where it stands; at rest
    Bounds seen;      // the same as a pose has it: for camera and light
    glm::dmat4 world{1};
    PlacedScene placed;
    Matrices camera;
    Matrices light;
};

/// `mesh` may be null: then camera and light look at a unit sphere, and bounds have no value.
[[nodiscard]] SceneView viewScene(const Workspace& workspace, const Mesh* mesh, Extent picture);

/// Where a mesh stands, and the scene's camera and light.
struct PlacedObject {
    Placement placement;
    PlacedScene scene; // mm
    float worldUnitMm = 1;
};
[[nodiscard]] SceneView viewScene(const PlacedObject& object, const Mesh& mesh, Extent picture);

/// Whether the world exchanges left and right: front faces are clockwise in it.
[[nodiscard]] bool isMirrored(const SceneView& scene);

/// Numbers in row order as Parameter::defaultValue holds them. nullopt: the host binds nothing to this parameter, or it asks for a mesh
/// that is not there. TG4013: the semantic's value does not have the parameter's type; TG4014: unknown Object. VIEWPORTPIXELSIZE depends on
/// the target and is not bound here.
[[nodiscard]] Result<std::optional<std::vector<double>>> semanticValue(const Parameter& parameter, const SceneView& scene);

/// One of the BOUNDING... semantics.
[[nodiscard]] bool asksForMesh(const Parameter& parameter);
[[nodiscard]] bool isViewportSize(const Parameter& parameter);

/// Every semantic that numbers can have, for hints.
[[nodiscard]] const std::vector<std::string>& numericSemantics();

/// Of the mesh, or of all objects where they stand, in mm; without either the unit sphere, as semantics have it.
[[nodiscard]] Bounds boundsOf(const SessionScene& scene);

/// The workspace with camera and light in world millimetres, whatever their frames were: they can be moved on. Planes that were fitted stay
/// to be fitted.
[[nodiscard]] Workspace inWorld(const Workspace& workspace, const SessionScene& scene);

} // namespace tegument::run
