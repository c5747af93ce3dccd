#pragma once
// Meshes in false colours (mesh_figures.h), lit from the eye, with their seams as lines.

#include "host/run/run_options.h"
#include "host/scene/view.h"
#include "tools/view/mesh_figures.h"

#include "host/gpu/gpu.h"

#include <memory>

namespace tegument::view {

/// A mesh where it stands.
struct ColoredMesh {
    const Mesh* mesh = nullptr;
    MeshFigures figures;
    glm::dmat4 world{1};
};
[[nodiscard]] std::vector<ColoredMesh> coloredMeshes(const SessionScene& scene);

class MeshCanvas {
public:
    static Result<std::unique_ptr<MeshCanvas>> create(gpu::Device& device, Compiler compiler, const std::vector<ColoredMesh>& meshes,
                                                      MeshShow show);
    ~MeshCanvas();
    /// Other colours, or other meshes.
    [[nodiscard]] Result<void> color(const std::vector<ColoredMesh>& meshes, MeshShow show);
    /// On black; `target` is of the format that a picture is shown from.
    [[nodiscard]] Result<void> draw(gpu::Texture& target, const Matrices& camera);

private:
    struct State;
    explicit MeshCanvas(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace tegument::view
