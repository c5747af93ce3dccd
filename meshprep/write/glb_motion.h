#pragma once
// Inside this room: nodes, skins, morph targets and animations written back into a glb, as the file had them.

#include "host/mesh/motion.h"

#include <nlohmann/json.hpp>

#include <functional>

namespace tegument::meshfile {

using MotionJson = nlohmann::ordered_json;

/// The mesh with positions, normals and tangents in the file's unit, as its nodes and skins take them; other fields as they were.
[[nodiscard]] Mesh inFile(const Mesh& mesh);

/// A run of vertices of the mesh.
struct VertexSpan {
    std::size_t first = 0;
    std::size_t count = 0;
};

/// `place`: in mm, where the mesh's positions count from.
class MotionWriter {
public:
    using AddView = std::function<std::size_t(const void* data, std::size_t size, std::optional<int> target)>;

    MotionWriter(const Mesh& mesh, MotionJson& json, AddView addView, const glm::dvec3& place);
    /// What draws a part: that of its vertices.
    [[nodiscard]] const MotionRun& runOf(std::uint32_t vertex) const { return motion_.runOf(mesh_.motionVertices[vertex]); }
    /// Whether the node turns triangles over, so that those of the file are the other way round.
    [[nodiscard]] bool mirrors(std::uint32_t vertex) const { return rest_.carrier(mesh_.motionVertices[vertex]).mirrors; }
    /// Adds joints, weights and morph targets of a run to a primitive.
    void addTo(MotionJson& primitive, const MotionRun& run, const VertexSpan& vertices);
    /// The mesh that a node draws; `level` 1 and on: in place of which, by MSFT_lod.
    void draw(const MotionRun& run, std::size_t mesh, std::size_t level);
    /// Nodes, skins, animations and scene.
    void finish();

private:
    [[nodiscard]] std::size_t addNumbers(const std::vector<float>& numbers, std::size_t components, std::optional<int> target);
    [[nodiscard]] std::size_t addChanges(const std::vector<glm::vec3>& changes);
    void placeScene(const glm::dvec3& place);
    void moveLevels();

    const Mesh& mesh_;
    const Motion& motion_;
    MotionState state_;
    MotionShape rest_;
    MotionJson& json_;
    AddView addView_;
    MotionJson own_;                                     // what the file had
    std::vector<std::vector<std::size_t>> levelsOfNode_; // nodes
};

} // namespace tegument::meshfile
