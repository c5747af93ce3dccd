// glTF 2.0 scenes -> one mesh: the default scene's nodes with their transforms applied, every primitive a part.

#include "host/mesh/gltf_draco.h"
#include "host/mesh/gltf_images.h"
#include "host/mesh/gltf_losses.h"
#include "host/mesh/gltf_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

namespace tegument::meshfile {

namespace {

/// The vertices of one primitive before they are carried.
struct Attributes {
    std::vector<float> positions, normals, tangents, uvs, colors;
    std::size_t colorComponents = 4;
    std::vector<MeshAttribute> others;
};

/// How the colour map of a primitive's material reads its texture coordinates: another set than the first, KHR_texture_transform.
struct UvUse {
    std::string set = "TEXCOORD_0";
    glm::dvec2 offset{0};
    glm::dvec2 scale{1};
    double rotation = 0;

    [[nodiscard]] glm::vec2 operator()(const glm::dvec2& uv) const {
        const glm::dvec2 p = scale * uv;
        const double c = std::cos(rotation), s = std::sin(rotation); // counter-clockwise where v is down
        return offset + glm::dvec2(c * p.x + s * p.y, c * p.y - s * p.x);
    }
};

Result<UvUse> uvUseOf(const GltfDocument& document, const GltfValue& primitive) {
    UvUse use;
    const GltfValue materials = document.root()["materials"];
    const auto material = primitive.whole("material", materials.size(), SIZE_MAX);
    if (!material || *material >= materials.size()) return use; // an error is found when the part is read
    const GltfValue surface = materials[*material]["pbrMetallicRoughness"];
    if (!surface.has("baseColorTexture")) return use;
    const GltfValue texture = surface["baseColorTexture"];
    const GltfValue transform = texture["extensions"]["KHR_texture_transform"];
    const auto own = texture.whole("texCoord", 64, 0);
    if (!own) return own.error();
    const auto set = transform.whole("texCoord", 64, *own);
    if (!set) return set.error();
    const auto offset = transform.numbers("offset", 2, {0, 0});
    if (!offset) return offset.error();
    const auto scale = transform.numbers("scale", 2, {1, 1});
    if (!scale) return scale.error();
    if (const std::string name = fmt::format("TEXCOORD_{}", *set); primitive["attributes"].has(name.c_str())) use.set = name;
    use.offset = {(*offset)[0], (*offset)[1]};
    use.scale = {(*scale)[0], (*scale)[1]};
    if (transform.has("rotation") && transform.json()["rotation"].is_number()) use.rotation = transform.json()["rotation"].get<double>();
    return use;
}

/// "TEXCOORD_1" and "COLOR_1" are kept under these names, "_name" without its underscore. Empty for what is read apart or not kept.
std::string nameToKeep(const std::string& name) {
    const bool numbered = (name.starts_with("TEXCOORD_") && name != "TEXCOORD_0") || (name.starts_with("COLOR_") && name != "COLOR_0");
    if (numbered) return name;
    return name.size() > 1 && name.front() == '_' ? name.substr(1) : "";
}

class SceneReader {
public:
    explicit SceneReader(const GltfDocument& document) : document_(document), source_(document.source()), textures_(document) {}

    Result<ReadMesh> read() {
        mesh_.attribution = document_.root()["asset"].text("copyright");
        auto draws = drawsOf(document_, mesh_);
        if (!draws) return draws.error();
        draws_ = std::move(*draws);
        exactFrom_ = draws_.empty() ? glm::dvec3(0) : glm::dvec3(draws_.front().carrier.matrix[3]);
        moved_ = std::ranges::any_of(draws_, [](const GltfDraw& draw) { return glm::dvec3(draw.carrier.matrix[3]) != glm::dvec3(0); });
        for (const GltfDraw& draw : draws_)
            if (auto error = readMesh(document_.root()["meshes"][draw.mesh], draw.nodeName, draw.carrier)) return *error;
        // Attributes that only some primitives have are not usable for all: normals and tangents are made anew, UVs are filled.
        if (!allNormals_) mesh_.normals.clear();
        if (!allTangents_) mesh_.tangents.clear();
        finishUvs();
        if (skipped_ > 0) warn(mesh_, 5323, source_.whole(), fmt::format("{} primitives that are points or lines are left out", skipped_));
        counts_.vertices = mesh_.positions.size();
        if (source_.carryMaterials) {
            mesh_.materials = carriedMaterials(document_, mesh_);
            warnOfLosses(document_, usedMeshes(), mesh_);
        }
        return ReadMesh{.mesh = std::move(mesh_), .counts = counts_, .exact = std::move(exact_), .exactFrom = exactFrom_};
    }

private:
    [[nodiscard]] std::vector<std::size_t> usedMeshes() const {
        std::vector<std::size_t> meshes;
        for (const GltfDraw& draw : draws_)
            meshes.push_back(draw.mesh);
        return meshes;
    }

    std::optional<Error> readMesh(const GltfValue& mesh, const std::string& nodeName, const GltfCarrier& carrier) {
        const std::string name = mesh.text("name").empty() ? nodeName : mesh.text("name");
        if (mesh_.name.empty()) mesh_.name = name;
        vertexBase_.clear(); // shared vertices are carried once per node
        const GltfValue primitives = mesh["primitives"];
        for (std::size_t i = 0; i < primitives.size(); ++i)
            if (auto error = readPrimitive(primitives[i], name, carrier)) return error;
        return std::nullopt;
    }

    std::optional<Error> readPrimitive(const GltfValue& primitive, const std::string& meshName, const GltfCarrier& carrier) {
        const auto mode = primitive.whole("mode", 7, 4);
        if (!mode) return mode.error();
        if (*mode < 4) {
            ++skipped_;
            return std::nullopt;
        }
        const auto vertices = vertexRange(primitive, carrier);
        if (!vertices) return vertices.error();
        const bool packed = isDraco(primitive);
        const std::uint32_t restart = packed || *mode == 4 ? kNoRestart : restartOf(primitive);
        auto corners = packed ? packedCorners(primitive) : readCorners(primitive, vertices->count, restart);
        if (!corners) return corners.error();
        const auto first = static_cast<std::uint32_t>(mesh_.indices.size());
        for (auto from = corners->begin(); from != corners->end();) {
            const auto to = restart == kNoRestart ? corners->end() : std::find(from, corners->end(), restart);
            addTriangles(std::span(from, to), packed ? 4 : *mode, *vertices, carrier.mirrors);
            from = to == corners->end() ? to : to + 1;
        }
        if (mesh_.indices.size() > kMaxIndices) return tooLarge(source_.whole());
        return addPart(primitive, meshName, first);
    }

    struct VertexRange {
        std::size_t base = 0;
        std::size_t count = 0;
    };

    /// Primitives of one mesh that name the same accessors share their vertices.
    Result<VertexRange> vertexRange(const GltfValue& primitive, const GltfCarrier& carrier) {
        std::string key = primitive["attributes"].json().dump(-1, ' ', true, Json::error_handler_t::replace);
        if (isDraco(primitive)) key += primitive["extensions"].json().dump(-1, ' ', true, Json::error_handler_t::replace);
        const auto uses = source_.carryMaterials ? Result<UvUse>(UvUse()) : uvUseOf(document_, primitive);
        if (!uses) return uses.error();
        key += fmt::format("{} {} {} {} {} {}", uses->set, uses->offset.x, uses->offset.y, uses->scale.x, uses->scale.y, uses->rotation);
        if (const auto known = vertexBase_.find(key); known != vertexBase_.end()) return known->second;
        auto attributes = readAttributes(primitive, uses->set.c_str());
        if (!attributes) return attributes.error();
        for (std::size_t i = 0; i + 1 < attributes->uvs.size() && !source_.carryMaterials; i += 2) {
            const glm::vec2 uv = (*uses)({attributes->uvs[i], attributes->uvs[i + 1]});
            attributes->uvs[i] = uv.x;
            attributes->uvs[i + 1] = uv.y;
        }
        const VertexRange range{.base = mesh_.positions.size(), .count = attributes->positions.size() / 3};
        if (range.base + range.count > kMaxVertices) return tooLarge(source_.whole());
        if (auto error = addVertices(*attributes, carrier, primitive)) return *error;
        vertexBase_[key] = range;
        return range;
    }

    static bool isDraco(const GltfValue& primitive) { return primitive["extensions"].has("KHR_draco_mesh_compression"); }

    /// Decoded once for the attributes and the corners of a primitive.
    Result<const DracoMesh*> draco(const GltfValue& primitive) {
        if (dracoPath_ == primitive.path()) return &draco_;
        auto read = readDraco(document_, primitive);
        if (!read) return read.error();
        draco_ = std::move(*read);
        dracoPath_ = primitive.path();
        return &draco_;
    }

    Result<std::vector<std::uint32_t>> packedCorners(const GltfValue& primitive) {
        const auto mesh = draco(primitive);
        if (!mesh) return mesh.error();
        return (*mesh)->corners;
    }

    /// The numbers of an attribute, from its accessor or from what Draco holds. `components`: 0 takes what is there.
    Result<DracoMesh::Values> valuesOf(const GltfValue& primitive, const std::string& name, std::size_t components) {
        if (isDraco(primitive)) {
            const auto mesh = draco(primitive);
            if (!mesh) return mesh.error();
            if (const auto found = (*mesh)->attributes.find(name); found != (*mesh)->attributes.end()) {
                if (components != 0 && found->second.components != components)
                    return primitive.wrong(fmt::format("has {} numbers in {}, {} are needed", found->second.components, name, components));
                return found->second;
            }
        }
        const auto index = primitive["attributes"].whole(name.c_str(), SIZE_MAX, {});
        if (!index) return index.error();
        const std::size_t own = components != 0 ? components : std::max<std::size_t>(document_.components(*index), 1);
        auto numbers = document_.floats(*index, own);
        if (!numbers) return numbers.error();
        return DracoMesh::Values{.components = own, .numbers = std::move(*numbers)};
    }

    Result<Attributes> readAttributes(const GltfValue& primitive, const char* uvs) {
        const GltfValue list = primitive["attributes"];
        if (!list.has("POSITION")) return primitive.wrong("has no POSITION");
        Attributes attributes;
        const std::array<std::tuple<const char*, std::size_t, std::vector<float>*>, 4> wanted = {{{"POSITION", 3, &attributes.positions},
                                                                                                  {"NORMAL", 3, &attributes.normals},
                                                                                                  {"TANGENT", 4, &attributes.tangents},
                                                                                                  {uvs, 2, &attributes.uvs}}};
        for (const auto& [name, components, values] : wanted) {
            if (!list.has(name)) continue;
            auto found = valuesOf(primitive, name, components);
            if (!found) return found.error();
            std::vector<float>* read = &found->numbers;
            if (read->size() / components != attributes.positions.size() / 3 && values != &attributes.positions)
                return list.wrong(fmt::format("has {} elements of {} for {} positions", read->size() / components, name,
                                              attributes.positions.size() / 3));
            *values = std::move(*read);
        }
        if (auto error = readRest(primitive, attributes)) return *error;
        return attributes;
    }

    std::optional<Error> readRest(const GltfValue& primitive, Attributes& attributes) {
        const GltfValue list = primitive["attributes"];
        for (const auto& [name, unused] : list.json().items()) {
            const std::string kept = nameToKeep(name);
            if (kept.empty() && name != "COLOR_0") continue;
            auto values = valuesOf(primitive, name, 0);
            if (!values) return values.error();
            if (values->numbers.size() / values->components != attributes.positions.size() / 3)
                return list.wrong(fmt::format("has {} elements of {} for {} positions", values->numbers.size() / values->components, name,
                                              attributes.positions.size() / 3));
            if (name == "COLOR_0") {
                if (values->components < 3) return list.wrong("has a COLOR_0 of fewer than three numbers");
                attributes.colorComponents = values->components;
                attributes.colors = std::move(values->numbers);
            } else {
                attributes.others.push_back(stored(primitive, name, kept, *values));
            }
        }
        return std::nullopt;
    }

    /// Whole numbers of 8 and 16 bits as they lie in the file; all else as floats.
    MeshAttribute stored(const GltfValue& primitive, const std::string& name, const std::string& kept,
                         const DracoMesh::Values& values) const {
        MeshAttribute attribute{.name = kept, .components = values.components, .values = {values.numbers.begin(), values.numbers.end()}};
        const auto index = primitive["attributes"].whole(name.c_str(), document_.root()["accessors"].size(), {});
        if (!index) return attribute;
        const GltfValue accessor = document_.root()["accessors"][*index];
        constexpr std::array<std::pair<NumberType, double>, 4> kWhole = {
            {{NumberType::Int8, 127}, {NumberType::Uint8, 255}, {NumberType::Int16, 32767}, {NumberType::Uint16, 65535}}};
        constexpr std::size_t kFirstType = 5120; // BYTE; the others follow
        const auto type = accessor.whole("componentType", kFirstType + kWhole.size(), {});
        if (!type || *type < kFirstType) return attribute;
        attribute.type = kWhole[*type - kFirstType].first;
        attribute.normalised = accessor.has("normalized") && accessor.json()["normalized"] == true;
        for (double& value : attribute.values)
            if (attribute.normalised) value = std::round(value * kWhole[*type - kFirstType].second);
        return attribute;
    }

    /// What only some primitives have is white, or 0, in the others.
    void addRest(const Attributes& from, std::size_t before, std::size_t count) {
        if (!from.colors.empty() || !mesh_.colors.empty()) mesh_.colors.resize(before, glm::vec4(1));
        for (std::size_t i = 0; i < from.colors.size() / from.colorComponents; ++i) {
            const float* c = &from.colors[i * from.colorComponents];
            mesh_.colors.emplace_back(c[0], c[1], c[2], from.colorComponents == 4 ? c[3] : 1.0f);
        }
        if (!mesh_.colors.empty()) mesh_.colors.resize(before + count, glm::vec4(1));
        for (const MeshAttribute& other : from.others) {
            auto known = std::ranges::find(mesh_.attributes, other.name, &MeshAttribute::name);
            if (known == mesh_.attributes.end())
                known = mesh_.attributes.insert(
                    known,
                    {.name = other.name, .type = other.type, .normalised = other.normalised, .components = other.components, .values = {}});
            if (known->components != other.components || known->type != other.type) continue;
            known->values.resize(before * known->components, 0);
            known->values.insert(known->values.end(), other.values.begin(), other.values.end());
        }
        for (MeshAttribute& attribute : mesh_.attributes)
            attribute.values.resize((before + count) * attribute.components, 0);
    }

    std::optional<Error> addVertices(const Attributes& from, const GltfCarrier& carrier, const GltfValue& primitive) {
        const std::size_t count = from.positions.size() / 3;
        allNormals_ = allNormals_ && !from.normals.empty();
        allTangents_ = allTangents_ && !from.tangents.empty();
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec4 local(from.positions[3 * i], from.positions[3 * i + 1], from.positions[3 * i + 2], 1);
            const glm::vec3 position = glm::vec3(glm::dvec3(carrier.matrix * local));
            if (!source_.keepNotFinite && !isFinite(position))
                return notFinite(source_.whole(), fmt::format("{}: vertex {} is not finite", primitive.path(), i));
            mesh_.positions.push_back(position);
            if (moved_) exact_.push_back(carrier.linear * glm::dvec3(local) + (glm::dvec3(carrier.matrix[3]) - exactFrom_));
            addDirections(from, i, carrier);
            mesh_.uvs.push_back(from.uvs.empty() ? glm::vec2(0) : glm::vec2(from.uvs[2 * i], from.uvs[2 * i + 1]));
        }
        withoutUvs_ += from.uvs.empty() ? count : 0;
        addRest(from, mesh_.positions.size() - count, count);
        return std::nullopt;
    }

    void addDirections(const Attributes& from, std::size_t i, const GltfCarrier& carrier) {
        if (allNormals_)
            mesh_.normals.push_back(
                carrier.direction(carrier.normals, {from.normals[3 * i], from.normals[3 * i + 1], from.normals[3 * i + 2]}));
        if (!allTangents_) return;
        const glm::vec3 tangent(from.tangents[4 * i], from.tangents[4 * i + 1], from.tangents[4 * i + 2]);
        const float sign = from.tangents[4 * i + 3] * (carrier.mirrors ? -1.0f : 1.0f);
        mesh_.tangents.emplace_back(carrier.direction(carrier.linear, tangent), sign);
    }

    static constexpr std::uint32_t kNoRestart = 0; // what no strip begins anew by

    /// The greatest index of its type begins a strip or fan anew (EXT_mesh_primitive_restart); no vertex may have it.
    [[nodiscard]] std::uint32_t restartOf(const GltfValue& primitive) const {
        const GltfValue accessors = document_.root()["accessors"];
        const auto index = primitive.whole("indices", accessors.size(), {});
        if (!index) return kNoRestart;
        const auto type = accessors[*index].whole("componentType", 65536, 0);
        return !type ? kNoRestart : *type == 5121 ? UINT8_MAX : *type == 5123 ? UINT16_MAX : UINT32_MAX;
    }

    /// The corners in drawing order, each below `vertices` or `restart`.
    Result<std::vector<std::uint32_t>> readCorners(const GltfValue& primitive, std::size_t vertices, std::uint32_t restart) const {
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
        const auto wrong = std::ranges::find_if(*corners, [&](std::uint32_t index) { return index >= vertices && index != restart; });
        if (wrong == corners->end() || source_.dropBadFaces) return corners;
        return badIndex(source_.whole(),
                        fmt::format("{}: index {} is {} of {} vertices", primitive.path(), wrong - corners->begin(), *wrong, vertices));
    }

    /// Triangles, strips (every other triangle turned) and fans, as the specification's 3.7.2.1 numbers them.
    void addTriangles(std::span<const std::uint32_t> corners, std::size_t mode, const VertexRange& vertices, bool flip) {
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
        std::optional<std::uint32_t> material;
        if (primitive.has("material")) {
            const GltfValue materials = document_.root()["materials"];
            const auto index = primitive.whole("material", materials.size(), {});
            if (!index) return index.error();
            if (name.empty()) name = materials[*index].text("name");
            material = static_cast<std::uint32_t>(*index);
            if (!source_.carryMaterials)
                if (auto error = textures_.add(materials[*index], mesh_)) return error;
        }
        mesh_.parts.push_back({.name = name.empty() ? meshName : name,
                               .firstIndex = first,
                               .indexCount = static_cast<std::uint32_t>(mesh_.indices.size()) - first});
        if (source_.carryMaterials) mesh_.parts.back().material = material;
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
    std::vector<GltfDraw> draws_;
    std::map<std::string, VertexRange> vertexBase_;
    std::vector<glm::dvec3> exact_; // positions from exactFrom_ on, where a node moves some
    glm::dvec3 exactFrom_{0};
    bool moved_ = false;
    DracoMesh draco_;
    std::string dracoPath_; // of the primitive that draco_ was read from
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
