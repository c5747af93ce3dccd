// Nodes of glTF 2.0: their trees, their transforms, their instances.

#include "host/mesh/gltf_scene.h"

#include <glm/gtc/quaternion.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace tegument::meshfile {

namespace {

/// A node to visit, with the product of the transforms above it (GLM's order: column vectors, as the specification writes them).
struct Visit {
    std::size_t node = 0;
    glm::dmat4 parent{1};
};

class SceneWalk {
public:
    SceneWalk(const GltfDocument& document, Mesh& mesh) : document_(document), source_(document.source()), mesh_(mesh) {}

    Result<std::vector<GltfDraw>> walk() {
        if (auto error = visitScene()) return *error;
        if (auto error = checkTotal()) return *error;
        return std::move(draws_);
    }

private:
    std::optional<Error> visitScene() {
        const GltfValue root = document_.root();
        const glm::dmat4 unit = glm::dmat4(glm::dmat3(source_.unitMm));
        std::vector<Visit> stack;
        if (const std::size_t scenes = root["scenes"].size(); scenes > 0) {
            const auto scene = root.whole("scene", scenes, 0);
            if (!scene) return scene.error();
            if (auto error = pushAll(root["scenes"][*scene]["nodes"], unit, stack)) return error;
        } else {
            for (const std::size_t node : rootNodes())
                stack.push_back({.node = node, .parent = unit});
        }
        while (!stack.empty()) {
            const Visit visit = stack.back();
            stack.pop_back();
            if (auto error = visitNode(visit, stack)) return error;
        }
        if (!anyNodeDraws() && root["meshes"].size() > 0) drawWithoutNodes(unit);
        return std::nullopt;
    }

    [[nodiscard]] bool anyNodeDraws() const {
        const GltfValue nodes = document_.root()["nodes"];
        for (std::size_t i = 0; i < nodes.size(); ++i)
            if (nodes[i].has("mesh")) return true;
        return false;
    }

    /// A library of meshes: the specification lets them stand without a node, and nothing says where.
    void drawWithoutNodes(const glm::dmat4& unit) {
        const std::size_t count = document_.root()["meshes"].size();
        warn(mesh_, 5323, source_.whole(),
             fmt::format("no node of the scene refers to the file's {} meshes: all are read, where they are", count));
        for (std::size_t i = 0; i < count; ++i)
            draws_.push_back({.mesh = i, .nodeName = {}, .carrier = GltfCarrier(unit)});
    }

    /// In reverse, so that the stack gives them back in the file's order.
    std::optional<Error> pushAll(const GltfValue& list, const glm::dmat4& parent, std::vector<Visit>& stack) const {
        for (std::size_t i = list.size(); i-- > 0;) {
            const auto node = list[i].whole(document_.root()["nodes"].size());
            if (!node) return node.error();
            stack.push_back({.node = *node, .parent = parent});
        }
        return std::nullopt;
    }

    [[nodiscard]] std::vector<std::size_t> rootNodes() const {
        const GltfValue nodes = document_.root()["nodes"];
        std::set<std::size_t> children;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const GltfValue list = nodes[i]["children"];
            for (std::size_t k = 0; k < list.size(); ++k)
                if (const auto child = list[k].whole(nodes.size())) children.insert(*child);
        }
        std::vector<std::size_t> roots;
        for (std::size_t i = nodes.size(); i-- > 0;)
            if (!children.contains(i)) roots.push_back(i);
        return roots;
    }

    std::optional<Error> visitNode(const Visit& visit, std::vector<Visit>& stack) {
        const GltfValue node = document_.root()["nodes"][visit.node];
        if (!visited_.insert(visit.node).second) return node.wrong("is reached twice: nodes must form trees");
        const auto local = localTransform(node);
        if (!local) return local.error();
        const glm::dmat4 world = visit.parent * *local;
        if (auto error = pushAll(node["children"], world, stack)) return error;
        if (!node.has("mesh")) return std::nullopt;
        const GltfValue meshes = document_.root()["meshes"];
        const auto index = node.whole("mesh", meshes.size(), {});
        if (!index) return index.error();
        if (node.has("skin") && !source_.carryMaterials)
            warn(mesh_, 5323, source_.whole(), node.path() + ": its skin is ignored, the mesh is read as it was modelled");
        if (node["extensions"].has("EXT_mesh_gpu_instancing"))
            return drawInstances(node, node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"], *index, world);
        draws_.push_back({.mesh = *index, .nodeName = node.text("name"), .carrier = GltfCarrier(world)});
        return std::nullopt;
    }

    /// EXT_mesh_gpu_instancing: a place, a turn and a size for each instance; what is absent is as in a node.
    std::optional<Error> drawInstances(const GltfValue& node, const GltfValue& attributes, std::size_t mesh, const glm::dmat4& world) {
        const std::array<std::pair<const char*, std::size_t>, 3> kNames = {{{"TRANSLATION", 3}, {"ROTATION", 4}, {"SCALE", 3}}};
        std::array<std::vector<float>, 3> values;
        std::size_t count = SIZE_MAX;
        for (std::size_t i = 0; i < 3; ++i) {
            if (!attributes.has(kNames[i].first)) continue;
            const auto accessor = attributes.whole(kNames[i].first, SIZE_MAX, {});
            if (!accessor) return accessor.error();
            auto read = document_.floats(*accessor, kNames[i].second);
            if (!read) return read.error();
            values[i] = std::move(*read);
            count = std::min(count, values[i].size() / kNames[i].second);
        }
        if (count == SIZE_MAX) return attributes.wrong("has none of TRANSLATION, ROTATION and SCALE");
        for (std::size_t i = 0; i < count; ++i) {
            const auto at = [&](std::size_t which, std::size_t c, double absent) {
                return values[which].empty() ? absent : static_cast<double>(values[which][i * kNames[which].second + c]);
            };
            const glm::dquat turn(at(1, 3, 1), at(1, 0, 0), at(1, 1, 0), at(1, 2, 0));
            glm::dmat4 local = glm::length(turn) > 0 ? glm::mat4_cast(glm::normalize(turn)) : glm::dmat4(1);
            for (glm::length_t c = 0; c < 3; ++c)
                local[c] *= at(2, static_cast<std::size_t>(c), 1);
            local[3] = glm::dvec4(at(0, 0, 0), at(0, 1, 0), at(0, 2, 0), 1);
            draws_.push_back({.mesh = mesh, .nodeName = node.text("name"), .carrier = GltfCarrier(world * local)});
        }
        return std::nullopt;
    }

    /// Held against the limit before memory is taken: a small file can draw one primitive by many nodes.
    [[nodiscard]] std::optional<Error> checkTotal() const {
        const GltfValue meshes = document_.root()["meshes"];
        const GltfValue accessors = document_.root()["accessors"];
        std::size_t total = 0;
        for (const GltfDraw& draw : draws_) {
            const GltfValue primitives = meshes[draw.mesh]["primitives"];
            std::set<std::size_t> counted;
            for (std::size_t i = 0; i < primitives.size(); ++i) {
                const auto accessor = primitives[i]["attributes"].whole("POSITION", accessors.size(), SIZE_MAX);
                if (!accessor || *accessor == SIZE_MAX || !counted.insert(*accessor).second) continue; // errors are found when it is read
                const auto count = accessors[*accessor].whole("count", kMaxVertices, 0);
                total += count ? *count : 0;
            }
            if (total > kMaxVertices) return tooLarge(source_.whole());
        }
        return std::nullopt;
    }

    static Result<glm::dmat4> localTransform(const GltfValue& node) {
        glm::dmat4 matrix(1);
        if (node.has("matrix")) {
            const auto m = node.numbers("matrix", 16, {});
            if (!m) return m.error();
            for (glm::length_t i = 0; i < 16; ++i)
                matrix[i / 4][i % 4] = (*m)[static_cast<std::size_t>(i)];
            return matrix;
        }
        const auto t = node.numbers("translation", 3, {0, 0, 0});
        const auto r = node.numbers("rotation", 4, {0, 0, 0, 1});
        const auto s = node.numbers("scale", 3, {1, 1, 1});
        if (!t) return t.error();
        if (!r) return r.error();
        if (!s) return s.error();
        const glm::dquat rotation((*r)[3], (*r)[0], (*r)[1], (*r)[2]);
        if (rotation != glm::dquat(1, 0, 0, 0)) {
            if (!(glm::length(rotation) > 0)) return node.wrong("has a rotation of length 0");
            matrix = glm::mat4_cast(glm::normalize(rotation));
        }
        for (glm::length_t i = 0; i < 3; ++i)
            matrix[i] *= (*s)[static_cast<std::size_t>(i)];
        matrix[3] = glm::dvec4((*t)[0], (*t)[1], (*t)[2], 1);
        return matrix;
    }

    const GltfDocument& document_;
    const Source& source_;
    Mesh& mesh_;
    std::vector<GltfDraw> draws_;
    std::set<std::size_t> visited_;
};

} // namespace

Result<std::vector<GltfDraw>> drawsOf(const GltfDocument& document, Mesh& mesh) {
    return SceneWalk(document, mesh).walk();
}

} // namespace tegument::meshfile
