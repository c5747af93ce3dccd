// glTF 2.0 scenes -> one mesh: the default scene's nodes with their transforms applied, every primitive a part.

#include "host/mesh/gltf_document.h"
#include "host/mesh/gltf_images.h"

#include <glm/gtc/quaternion.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace tegument::meshfile {

namespace {

/// A node to visit, with the product of the transforms above it (GLM's order: column vectors, as the specification writes them).
struct Visit {
    std::size_t node = 0;
    glm::dmat4 parent{1};
};

/// How positions, normals and tangents of one node are carried into the world.
struct Carrier {
    glm::dmat4 matrix{1};
    glm::dmat3 linear{1};
    glm::dmat3 normals{1};
    bool mirrors = false;
    bool turns = true; // false: a uniform scale leaves directions bit for bit as they are

    explicit Carrier(const glm::dmat4& m) : matrix(m), linear(m) {
        const double scale = linear[0][0];
        turns = !(scale > 0 && linear == glm::dmat3(scale));
        mirrors = glm::determinant(linear) < 0;
        // cofactor matrix: the inverse transpose without its division, so it exists for flattened meshes too
        normals = glm::dmat3(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]), glm::cross(linear[0], linear[1]));
        if (mirrors) normals = -normals;
    }

    [[nodiscard]] glm::vec3 direction(const glm::dmat3& by, const glm::vec3& v) const {
        if (!turns) return v;
        const glm::dvec3 carried = by * glm::dvec3(v);
        const double length = glm::length(carried);
        return length > 0 ? glm::vec3(carried / length) : glm::vec3(0);
    }
};

/// A mesh as one node draws it.
struct Draw {
    std::size_t mesh = 0;
    std::string nodeName;
    Carrier carrier;
};

/// The vertices of one primitive before they are carried.
struct Attributes {
    std::vector<float> positions, normals, tangents, uvs;
};

class SceneReader {
public:
    explicit SceneReader(const GltfDocument& document) : document_(document), source_(document.root().source()), textures_(document) {}

    Result<ReadMesh> read() {
        mesh_.attribution = document_.root()["asset"].text("copyright");
        if (auto error = visitScene()) return *error;
        if (auto error = checkTotal()) return *error;
        for (const Draw& draw : draws_)
            if (auto error = readMesh(document_.root()["meshes"][draw.mesh], draw.nodeName, draw.carrier)) return *error;
        // Attributes that only some primitives have are not usable for all: normals and tangents are made anew, UVs are filled.
        if (!allNormals_) mesh_.normals.clear();
        if (!allTangents_) mesh_.tangents.clear();
        finishUvs();
        if (skipped_ > 0) warn(mesh_, 5323, source_.whole(), fmt::format("{} primitives that are points or lines are left out", skipped_));
        counts_.vertices = mesh_.positions.size();
        return ReadMesh{.mesh = std::move(mesh_), .counts = counts_};
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
        return std::nullopt;
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
        if (node.has("skin"))
            warn(mesh_, 5323, source_.whole(), node.path() + ": its skin is ignored, the mesh is read as it was modelled");
        draws_.push_back({.mesh = *index, .nodeName = node.text("name"), .carrier = Carrier(world)});
        return std::nullopt;
    }

    /// Held against the limit before memory is taken: a small file can draw one primitive by many nodes.
    [[nodiscard]] std::optional<Error> checkTotal() const {
        const GltfValue meshes = document_.root()["meshes"];
        const GltfValue accessors = document_.root()["accessors"];
        std::size_t total = 0;
        for (const Draw& draw : draws_) {
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

    std::optional<Error> readMesh(const GltfValue& mesh, const std::string& nodeName, const Carrier& carrier) {
        const std::string name = mesh.text("name").empty() ? nodeName : mesh.text("name");
        if (mesh_.name.empty()) mesh_.name = name;
        vertexBase_.clear(); // shared vertices are carried once per node
        const GltfValue primitives = mesh["primitives"];
        for (std::size_t i = 0; i < primitives.size(); ++i)
            if (auto error = readPrimitive(primitives[i], name, carrier)) return error;
        return std::nullopt;
    }

    std::optional<Error> readPrimitive(const GltfValue& primitive, const std::string& meshName, const Carrier& carrier) {
        const auto mode = primitive.whole("mode", 7, 4);
        if (!mode) return mode.error();
        if (*mode < 4) {
            ++skipped_;
            return std::nullopt;
        }
        const auto vertices = vertexRange(primitive, carrier);
        if (!vertices) return vertices.error();
        auto corners = readCorners(primitive, vertices->count);
        if (!corners) return corners.error();
        const auto first = static_cast<std::uint32_t>(mesh_.indices.size());
        addTriangles(*corners, *mode, *vertices, carrier.mirrors);
        if (mesh_.indices.size() > kMaxIndices) return tooLarge(source_.whole());
        return addPart(primitive, meshName, first);
    }

    struct VertexRange {
        std::size_t base = 0;
        std::size_t count = 0;
    };

    /// Primitives of one mesh that name the same accessors share their vertices.
    Result<VertexRange> vertexRange(const GltfValue& primitive, const Carrier& carrier) {
        const std::string key = primitive["attributes"].json().dump(-1, ' ', true, Json::error_handler_t::replace);
        if (const auto known = vertexBase_.find(key); known != vertexBase_.end()) return known->second;
        const auto attributes = readAttributes(primitive);
        if (!attributes) return attributes.error();
        const VertexRange range{.base = mesh_.positions.size(), .count = attributes->positions.size() / 3};
        if (range.base + range.count > kMaxVertices) return tooLarge(source_.whole());
        if (auto error = addVertices(*attributes, carrier, primitive)) return *error;
        vertexBase_[key] = range;
        return range;
    }

    Result<Attributes> readAttributes(const GltfValue& primitive) {
        const GltfValue list = primitive["attributes"];
        if (!list.has("POSITION")) return primitive.wrong("has no POSITION");
        Attributes attributes;
        const std::array<std::tuple<const char*, std::size_t, std::vector<float>*>, 4> wanted = {{{"POSITION", 3, &attributes.positions},
                                                                                                  {"NORMAL", 3, &attributes.normals},
                                                                                                  {"TANGENT", 4, &attributes.tangents},
                                                                                                  {"TEXCOORD_0", 2, &attributes.uvs}}};
        for (const auto& [name, components, values] : wanted) {
            if (!list.has(name)) continue;
            const auto index = list.whole(name, SIZE_MAX, {});
            if (!index) return index.error();
            auto read = document_.floats(*index, components);
            if (!read) return read.error();
            if (read->size() / components != attributes.positions.size() / 3 && values != &attributes.positions)
                return list.wrong(fmt::format("has {} elements of {} for {} positions", read->size() / components, name,
                                              attributes.positions.size() / 3));
            *values = std::move(*read);
        }
        return attributes;
    }

    std::optional<Error> addVertices(const Attributes& from, const Carrier& carrier, const GltfValue& primitive) {
        const std::size_t count = from.positions.size() / 3;
        allNormals_ = allNormals_ && !from.normals.empty();
        allTangents_ = allTangents_ && !from.tangents.empty();
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec4 local(from.positions[3 * i], from.positions[3 * i + 1], from.positions[3 * i + 2], 1);
            const glm::vec3 position = glm::vec3(glm::dvec3(carrier.matrix * local));
            if (!source_.keepNotFinite && !isFinite(position))
                return notFinite(source_.whole(), fmt::format("{}: vertex {} is not finite", primitive.path(), i));
            mesh_.positions.push_back(position);
            addDirections(from, i, carrier);
            mesh_.uvs.push_back(from.uvs.empty() ? glm::vec2(0) : glm::vec2(from.uvs[2 * i], from.uvs[2 * i + 1]));
        }
        withoutUvs_ += from.uvs.empty() ? count : 0;
        return std::nullopt;
    }

    void addDirections(const Attributes& from, std::size_t i, const Carrier& carrier) {
        if (allNormals_)
            mesh_.normals.push_back(
                carrier.direction(carrier.normals, {from.normals[3 * i], from.normals[3 * i + 1], from.normals[3 * i + 2]}));
        if (!allTangents_) return;
        const glm::vec3 tangent(from.tangents[4 * i], from.tangents[4 * i + 1], from.tangents[4 * i + 2]);
        const float sign = from.tangents[4 * i + 3] * (carrier.mirrors ? -1.0f : 1.0f);
        mesh_.tangents.emplace_back(carrier.direction(carrier.linear, tangent), sign);
    }

    /// The corners in drawing order, each below `vertices`.
    Result<std::vector<std::uint32_t>> readCorners(const GltfValue& primitive, std::size_t vertices) const {
        if (!primitive.has("indices")) {
            std::vector<std::uint32_t> corners(vertices);
            for (std::size_t i = 0; i < vertices; ++i)
                corners[i] = static_cast<std::uint32_t>(i);
            return corners;
        }
        const auto accessor = primitive.whole("indices", SIZE_MAX, {});
        if (!accessor) return accessor.error();
        auto corners = document_.indices(*accessor);
        if (!corners) return corners.error();
        const auto wrong = std::ranges::find_if(*corners, [&](std::uint32_t index) { return index >= vertices; });
        if (wrong == corners->end() || source_.dropBadFaces) return corners;
        return badIndex(source_.whole(),
                        fmt::format("{}: index {} is {} of {} vertices", primitive.path(), wrong - corners->begin(), *wrong, vertices));
    }

    /// Triangles, strips (every other triangle turned) and fans, as the specification's 3.7.2.1 numbers them.
    void addTriangles(const std::vector<std::uint32_t>& corners, std::size_t mode, const VertexRange& vertices, bool flip) {
        const std::size_t step = mode == 4 ? 3 : 1;
        for (std::size_t i = 0; i + 2 < corners.size(); i += step) {
            std::array<std::size_t, 3> triangle = {i, i + 1, i + 2};
            if (mode == 5 && i % 2 == 1) triangle = {i, i + 2, i + 1};
            if (mode == 6) triangle = {i + 1, i + 2, 0};
            if (flip) std::swap(triangle[1], triangle[2]);
            ++counts_.faces;
            const bool usable = std::ranges::all_of(triangle, [&](std::size_t corner) { return corners[corner] < vertices.count; });
            counts_.badFaces += !usable; // all are usable unless such faces are to be dropped
            if (!usable) continue;
            for (const std::size_t corner : triangle)
                mesh_.indices.push_back(static_cast<std::uint32_t>(vertices.base + corners[corner]));
        }
    }

    std::optional<Error> addPart(const GltfValue& primitive, const std::string& meshName, std::uint32_t first) {
        std::string name = primitive["extras"].text("name");
        if (primitive.has("material")) {
            const GltfValue materials = document_.root()["materials"];
            const auto index = primitive.whole("material", materials.size(), {});
            if (!index) return index.error();
            if (name.empty()) name = materials[*index].text("name");
            if (auto error = textures_.add(materials[*index], mesh_)) return error;
        }
        mesh_.parts.push_back({.name = name.empty() ? meshName : name,
                               .firstIndex = first,
                               .indexCount = static_cast<std::uint32_t>(mesh_.indices.size()) - first});
        return readClusters(primitive["extras"]["tegument"], mesh_.parts.back());
    }

    /// Of our own files (write_glb.cpp): how many indices each has. Their balls and cones are made anew, in whatever place the mesh has.
    static std::optional<Error> readClusters(const GltfValue& extras, MeshPart& part) {
        if (!extras.has("clusters")) return std::nullopt;
        const GltfValue list = extras["clusters"];
        std::uint32_t next = 0;
        for (std::size_t i = 0; i < list.size(); ++i) {
            const auto count = list[i].whole("indices", std::size_t{part.indexCount} - next + 1, {});
            if (!count) return count.error();
            if (*count == 0 || *count % 3 != 0) return list[i].wrong(fmt::format("has {} indices: no whole triangles", *count));
            part.clusters.push_back({.firstIndex = next, .indexCount = static_cast<std::uint32_t>(*count)});
            next += static_cast<std::uint32_t>(*count);
        }
        if (next != part.indexCount) return list.wrong(fmt::format("has {} of the primitive's {} indices", next, part.indexCount));
        return std::nullopt;
    }

    void finishUvs() {
        if (withoutUvs_ == mesh_.positions.size())
            mesh_.uvs.clear();
        else if (withoutUvs_ > 0)
            warn(mesh_, 5325, source_.whole(),
                 fmt::format("{} of {} vertices have no texture coordinates: (0, 0) is used", withoutUvs_, mesh_.positions.size()));
    }

    const GltfDocument& document_;
    const Source& source_;
    GltfTextures textures_;
    Mesh mesh_;
    ReadCounts counts_;
    std::vector<Draw> draws_;
    std::map<std::string, VertexRange> vertexBase_;
    std::set<std::size_t> visited_;
    std::size_t withoutUvs_ = 0;
    std::size_t skipped_ = 0;
    bool allNormals_ = true;
    bool allTangents_ = true;
};

} // namespace

Result<ReadMesh> readGltf(const Source& source) {
    const auto document = GltfDocument::open(source);
    if (!document) return document.error();
    return SceneReader(**document).read();
}

} // namespace tegument::meshfile
