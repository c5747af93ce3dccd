// Triangles of an OBJ file: one vertex per distinct triple of indices; groups, objects and materials as parts.

#include "host/mesh/obj_file.h"
#include "host/mesh/polygons.h"
#include "host/mesh/welding.h"

#include <fmt/format.h>

#include <map>
#include <memory>

namespace tegument::meshfile {

namespace {

struct Part {
    std::string name;
    std::string material;
    std::vector<std::uint32_t> indices; // of vertices
    Polygons polygons;
};

class ObjReader {
public:
    ObjReader(const Source& source, const ObjFile& file) : source_(source), file_(file) {}

    Result<ReadMesh> read() {
        for (std::size_t section = 0; section < file_.sections.size(); ++section) {
            Part& part = partOf(file_.sections[section]);
            for (std::size_t face = file_.sections[section].firstFace; face < file_.endOf(section); ++face)
                addFace(file_.cornersOf(face), part);
        }
        if (vertices_.size() > kMaxVertices) return tooLarge(source_.whole());
        result_.counts.vertices = file_.positions.size();
        result_.counts.faces = file_.faces.size() + file_.badFaces;
        result_.counts.badFaces = file_.badFaces;
        for (const ObjCorner& vertex : vertices_)
            addVertex(vertex);
        for (const auto& part : parts_)
            if (const auto wrong = addPart(*part)) return *wrong;
        dropIncomplete();
        addWarnings();
        result_.floats = false;
        return std::move(result_);
    }

private:
    void addFace(std::span<const ObjCorner> corners, Part& part) {
        corners_.clear();
        for (const ObjCorner& corner : corners)
            corners_.push_back(vertexOf(corner));
        result_.counts.smallFaces += corners_.size() < 3;
        part.polygons.add(corners_, part.indices);
    }

    std::uint32_t vertexOf(const ObjCorner& corner) {
        const auto next = static_cast<std::uint32_t>(vertices_.size());
        const auto vertex = unique_.findOrAdd(hashWords(std::array{corner.position, corner.uv, corner.normal}), next,
                                              [&](std::uint32_t other) { return vertices_[other] == corner; });
        if (vertex == next) vertices_.push_back(corner);
        return vertex;
    }

    /// The group's name, else the object's; a material is added behind a colon, or stands alone.
    Part& partOf(const ObjSection& section) {
        std::string name = section.group.empty() ? section.object : section.group;
        if (!section.material.empty()) name = name.empty() ? section.material : name + ":" + section.material;
        const auto [entry, isNew] = partByName_.emplace(name, parts_.size());
        if (isNew) parts_.push_back(std::make_unique<Part>(Part{.name = name, .material = section.material}));
        return *parts_[entry->second];
    }

    void addVertex(const ObjCorner& corner) {
        const auto at = [](const auto& list, std::uint32_t index) {
            return index < list.size() ? list[index] : typename std::decay_t<decltype(list)>::value_type(0);
        };
        usable_.push_back(file_.holds(corner));
        mesh().positions.push_back(at(file_.positions, corner.position));
        result_.exact.push_back(at(file_.exact, corner.position));
        if (!file_.colors.empty()) mesh().colors.push_back(at(file_.colors, corner.position));
        const glm::dvec2 uv = at(file_.uvs, corner.uv);
        mesh().uvs.emplace_back(uv.x, corner.uv < file_.uvs.size() ? 1 - uv.y : 0); // v up in the file, down here
        mesh().normals.push_back(at(file_.normals, corner.normal));
        withoutUv_ += corner.uv == ObjCorner::kNone;
        withoutNormal_ += corner.normal == ObjCorner::kNone;
        anyUnusable_ |= !usable_.back();
    }

    [[nodiscard]] std::optional<Error> addPart(Part& part) {
        if (auto wrong = part.polygons.cut(source_, mesh().positions, result_.exact, part.indices)) return wrong;
        if (anyUnusable_) dropUnusable(part);
        mesh().parts.push_back({.name = part.name,
                                .firstIndex = static_cast<std::uint32_t>(mesh().indices.size()),
                                .indexCount = static_cast<std::uint32_t>(part.indices.size())});
        mesh().indices.insert(mesh().indices.end(), part.indices.begin(), part.indices.end());
        result_.materialNames.push_back(part.material);
        part.indices = {};
        return std::nullopt;
    }

    void dropUnusable(Part& part) {
        std::vector<std::uint32_t> kept;
        for (std::size_t i = 0; i < part.indices.size(); i += 3) {
            const auto* t = &part.indices[i];
            const bool usable = usable_[t[0]] && usable_[t[1]] && usable_[t[2]];
            if (usable) kept.insert(kept.end(), t, t + 3);
            result_.counts.badFaces += !usable;
        }
        part.indices = std::move(kept);
    }

    /// Normals that some corners lack are made anew for all; UVs that all lack do not exist.
    void dropIncomplete() {
        if (withoutNormal_ > 0) mesh().normals.clear();
        if (withoutUv_ == mesh().positions.size()) mesh().uvs.clear();
    }

    void addWarnings() {
        for (const auto& [keyword, line] : file_.otherStatements)
            warn(mesh(), 5323, source_.atLine(line), fmt::format("the OBJ statement '{}' is ignored", keyword));
        if (file_.absentNormals > 0)
            warn(mesh(), 5324, source_.whole(),
                 fmt::format("{} corners name normals that the file has not: all are made anew", file_.absentNormals));
        if (file_.absentUvs > 0)
            warn(mesh(), 5325, source_.whole(),
                 fmt::format("{} corners name texture coordinates that the file has not: they have none", file_.absentUvs));
        if (!mesh().uvs.empty() && withoutUv_ > 0)
            warn(mesh(), 5325, source_.whole(),
                 fmt::format("{} of {} vertices have no texture coordinates: (0, 0) is used", withoutUv_, mesh().positions.size()));
    }

    Mesh& mesh() { return result_.mesh; }

    const Source& source_;
    const ObjFile& file_;
    std::vector<std::unique_ptr<Part>> parts_;
    std::map<std::string, std::size_t> partByName_;
    std::vector<ObjCorner> vertices_;
    UniqueItems unique_; // vertices
    std::vector<std::uint32_t> corners_;
    std::vector<bool> usable_; // by vertex: everything it refers to exists
    bool anyUnusable_ = false;
    std::size_t withoutUv_ = 0, withoutNormal_ = 0;
    ReadMesh result_;
};

} // namespace

Result<ReadMesh> readObj(const Source& source) {
    const Result<ObjFile> file = parseObj(source);
    if (!file) return file.error();
    auto read = ObjReader(source, *file).read();
    if (read && source.carryMaterials && !namesTiles(source, *file))
        carryObjMaterials(source, *file, read->materialNames, read->mesh);
    else if (read && !read->mesh.uvs.empty())
        addObjTextures(source, *file, *read);
    return read;
}

} // namespace tegument::meshfile
