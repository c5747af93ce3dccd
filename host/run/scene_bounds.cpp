#include "host/run/scene_bounds.h"

namespace tegument::run {

Bounds boundsOf(const SessionScene& scene) {
    if (!scene.objects.empty()) {
        std::vector<PlacedMesh> meshes;
        for (const RunObject& object : scene.objects)
            meshes.push_back({.mesh = object.mesh, .placement = object.placement});
        return boundsOfAll(meshes);
    }
    if (scene.mesh) return scene.mesh->bounds;
    return {.minimum = glm::vec3(-1), .maximum = glm::vec3(1), .centre = glm::vec3(0), .radius = 1};
}

Workspace inWorld(const Workspace& workspace, const SessionScene& scene) {
    const PlacedScene placed = placeScene(workspace, boundsOf(scene));
    Workspace world = workspace;
    world.cameraRelative = false;
    world.lightRelative = false;
    world.camera = placed.camera;
    world.camera.nearPlane = workspace.camera.nearPlane;
    world.camera.farPlane = workspace.camera.farPlane;
    world.light = placed.light;
    return world;
}

} // namespace tegument::run
