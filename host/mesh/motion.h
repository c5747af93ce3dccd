#pragma once
// What moves a mesh: the nodes, skins, morph targets and animations of a glTF file. `Motion` is the file's own, in its unit, and never
// changes; a mesh tells for each vertex which of the file's it is, so that welding, splitting and ordering need move one number.

#include "host/mesh/mesh.h"

#include <span>
#include <utility>

namespace tegument {

struct MotionNode {
    std::string name;
    std::optional<std::size_t> parent;
    std::optional<glm::dmat4> matrix; // in place of the three
    glm::dvec3 translation{0};
    glm::dvec4 rotation{0, 0, 0, 1}; // x, y, z, w
    glm::dvec3 scale{1};
    std::vector<double> weights; // of the morph targets of its mesh
};

struct MotionSkin {
    std::string name;
    std::vector<std::size_t> joints; // nodes
    std::vector<glm::dmat4> inverseBinds;
};

struct MotionChannel {
    enum class Path { Translation, Rotation, Scale, Weights };
    enum class Between { Linear, Step, CubicSpline };

    std::size_t node = 0;
    Path path = Path::Translation;
    Between between = Between::Linear;
    std::vector<float> times; // seconds, increasing
    std::vector<float> values;
    std::size_t width = 3; // numbers at each time; of a cubic spline three times as many: in-tangent, value, out-tangent
};

struct MotionAnimation {
    std::string name; // or its number
    double seconds = 0;
    std::vector<MotionChannel> channels;
};

/// Differences to the vertices of a run; a list is empty where the target does not change that.
struct MorphTarget {
    std::string name; // or its number
    std::vector<glm::vec3> positions, normals, tangents;
};

/// Vertices that one node draws, as the accessors of a primitive list them.
struct MotionRun {
    std::size_t node = 0;
    std::optional<std::size_t> skin;
    std::string meshName;
    std::size_t firstVertex = 0;
    std::size_t count = 0;
    std::size_t influences = 0; // joints and weights of each vertex
    bool hasNormals = false, hasTangents = false;
    std::vector<std::uint16_t> joints; // of the skin
    std::vector<float> weights;        // as in the file, whatever their sum
    std::vector<MorphTarget> targets;
};

struct Motion {
    std::vector<MotionNode> nodes;
    std::vector<std::size_t> order; // of the nodes: parents first
    std::vector<MotionSkin> skins;
    std::vector<MotionAnimation> animations;
    std::vector<MotionRun> runs;
    std::vector<glm::vec3> positions, normals; // of all runs, in the file's unit
    std::vector<glm::vec4> tangents;
    std::vector<std::uint32_t> kinds; // of each vertex the first that moves as it does

    /// What a file is written with again: an object with "nodes", "skins", "animations", "cameras", "scene" and "extensions" as the file
    /// has them. Their accessors are numbers of `lists`.
    std::string json;
    struct List {
        std::size_t components = 1;
        std::vector<float> numbers;
    };
    std::vector<List> lists;

    [[nodiscard]] const MotionRun& runOf(std::uint32_t vertex) const;
};

/// Where the nodes are at a time.
struct MotionState {
    std::vector<glm::dmat4> worlds;           // of the nodes
    std::vector<std::vector<double>> weights; // of the morph targets, by node
};

/// How positions, normals and tangents are carried.
struct Carrier {
    glm::dmat4 matrix{1};
    glm::dmat3 linear{1};
    glm::dmat3 normals{1}; // the inverse transpose without its division, so it exists for flattened meshes too
    bool mirrors = false;
    bool turns = true; // false: a uniform scale leaves directions bit for bit as they are

    explicit Carrier(const glm::dmat4& m);
    [[nodiscard]] glm::vec3 direction(const glm::dmat3& by, const glm::vec3& v) const;
};

/// The file's vertices as a state has them.
class MotionShape {
public:
    /// `root`: from the file's world to where the mesh is wanted.
    MotionShape(const Motion& motion, const MotionState& state, const glm::dmat4& root);
    [[nodiscard]] Carrier carrier(std::uint32_t vertex) const;
    /// A vertex or direction of the file's with its morph targets; `list`: `positions` or another of MorphTarget.
    [[nodiscard]] glm::dvec3 morphed(std::uint32_t vertex, const glm::dvec3& at, std::vector<glm::vec3> MorphTarget::*list,
                                     double sign = 1) const;
    /// The file's own normal or tangent where `v` of the mesh is what it becomes; else what would become it. Without morph targets.
    [[nodiscard]] glm::dvec3 inFile(std::uint32_t vertex, const Carrier& by, const glm::vec3& v, bool isNormal) const;

private:
    const Motion& motion_;
    const MotionState& state_;
    std::vector<glm::dmat4> places_;              // of the nodes
    std::vector<std::vector<glm::dmat4>> joints_; // of the skins
};

/// Without an animation the file's default. Before the first key and after the last it stands still.
[[nodiscard]] MotionState stateAt(const Motion& motion, const MotionAnimation* animation, double seconds);

/// A moment as a command line says it.
struct PoseChoice {
    std::string animation;                              // name or number; empty: the first, where a time is given
    std::optional<double> time;                         // seconds; none: 0 where an animation is given, else the default pose
    std::vector<std::pair<std::string, double>> morphs; // name or number, weight

    [[nodiscard]] bool any() const { return !animation.empty() || time || !morphs.empty(); }
};
/// The animation that is meant, or null. TG5336 the mesh does not move, or has no such animation or morph target.
[[nodiscard]] Result<const MotionAnimation*> chosenAnimation(const Mesh& mesh, const PoseChoice& choice);
/// Moves positions, normals, tangents, clusters and bounds of a mesh in its default pose. Errors as above.
[[nodiscard]] Result<void> poseMesh(Mesh& mesh, const PoseChoice& choice);

} // namespace tegument
