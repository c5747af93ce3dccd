// Mesh -> glb. Positions stay in millimetres, as they are in memory; the node's scale of 0.001 makes them glTF's metres. Reading back
// multiplies by 0.001 * 1000, which is exactly 1 in double precision, so every float returns bit for bit.

#include "host/mesh/materials.h"
#include "host/support/file.h"
#include "meshprep/write/glb.h"
#include "meshprep/write/glb_motion.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <span>

namespace tegument {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kByte = 5120;
constexpr int kUnsignedByte = 5121;
constexpr int kShort = 5122;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;
constexpr int kVertexBuffer = 34962;
constexpr int kIndexBuffer = 34963;
constexpr std::size_t kMost16BitVertices = 65535; // 0xFFFF cuts strips, glTF does not allow it as an index

Json list(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

/// One attribute as it lies in the file; an element begins every `stride` bytes.
struct Attribute {
    std::string name;
    std::string type;
    int componentType = kFloat;
    bool normalized = false;
    std::size_t stride = 0;
    std::size_t view = 0;
};

/// A run of triangles and the vertices that it counts its indices from.
struct Range {
    std::size_t firstVertex = 0;
    std::size_t vertices = 0;
};

class GlbWriter {
public:
    GlbWriter(const Mesh& mesh, const GlbOptions& options) : mesh_(mesh), options_(options), grid_(mesh.positions) {
        json_["asset"] = {{"version", "2.0"}, {"generator", "Tegument"}};
        if (!mesh.attribution.empty()) json_["asset"]["copyright"] = mesh.attribution;
        json_["scene"] = 0;
        json_["scenes"] = Json::array({Json::object()});
    }

    Result<std::string> write() {
        if (mesh_.indices.empty()) return container();
        addMaterials();
        if (auto error = addTextures()) return *error;
        addVertices();
        const bool moves = mesh_.motion != nullptr;
        if (moves) addMoving();
        if (!moves) addMesh(mesh_.indices, mesh_.parts, 0);
        for (const MeshLevel& level : options_.levels)
            if (!moves) addMesh(level.indices, level.parts, level.errorMm);
        if (!moves) addNodes();
        addExtensions();
        json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
        return container();
    }

private:
    [[nodiscard]] glm::dvec3 place() const { return options_.place + mesh_.origin; }
    [[nodiscard]] bool severalRanges() const { return options_.partsOwnVertices || mesh_.motion; }
    [[nodiscard]] bool small() const { return options_.format == VertexFormat::Unorm16; }

    std::size_t addView(const void* data, std::size_t size, std::optional<int> target) {
        Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}};
        if (target) view["target"] = *target;
        json_["bufferViews"].push_back(std::move(view));
        binary_.append(static_cast<const char*>(data), size);
        binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
        return json_["bufferViews"].size() - 1;
    }

    template <class T>
    void addAttribute(Attribute attribute, std::span<const T> values, bool padded = false) {
        attribute.stride = sizeof(T);
        attribute.view = addView(values.data(), values.size_bytes(), kVertexBuffer);
        // parts with vertices of their own are accessors of one view, whose stride glTF wants to be told
        if (padded || severalRanges()) json_["bufferViews"].back()["byteStride"] = sizeof(T);
        attributes_.push_back(std::move(attribute));
    }

    void addVertices() {
        addSurface();
        addColors();
        for (const MeshAttribute& attribute : mesh_.attributes)
            addOther(attribute);
    }

    void addColors() {
        if (mesh_.colors.empty()) return;
        if (!small()) return addAttribute<glm::vec4>({.name = "COLOR_0", .type = "VEC4"}, mesh_.colors);
        std::vector<std::array<std::uint16_t, 4>> colors;
        const auto number = [](float v) {
            return static_cast<std::uint16_t>(std::lround(std::clamp(static_cast<double>(v), 0.0, 1.0) * 65535));
        };
        for (const glm::vec4& c : mesh_.colors)
            colors.push_back({number(c.r), number(c.g), number(c.b), number(c.a)});
        addAttribute<std::array<std::uint16_t, 4>>({.name = "COLOR_0", .type = "VEC4", .componentType = kUnsignedShort, .normalized = true},
                                                   colors);
    }

    /// Elements begin at multiples of 4 bytes.
    template <class T>
    void addWhole(const MeshAttribute& from, int componentType) {
        const std::size_t stride = (from.components * sizeof(T) + 3) / 4 * 4;
        std::string bytes(mesh_.positions.size() * stride, '\0');
        for (std::size_t i = 0; i < mesh_.positions.size(); ++i)
            for (std::size_t c = 0; c < from.components; ++c) {
                const T value = static_cast<T>(from.values[i * from.components + c]);
                std::memcpy(&bytes[i * stride + c * sizeof(T)], &value, sizeof(T));
            }
        Attribute attribute = {.name = gltfName(from), .type = typeOf(from), .componentType = componentType, .normalized = from.normalised};
        attribute.stride = stride;
        attribute.view = addView(bytes.data(), bytes.size(), kVertexBuffer);
        json_["bufferViews"].back()["byteStride"] = stride;
        attributes_.push_back(std::move(attribute));
    }

    static std::string typeOf(const MeshAttribute& from) { return from.components == 1 ? "SCALAR" : fmt::format("VEC{}", from.components); }

    void addOther(const MeshAttribute& from) {
        if (staysWhole(from)) {
            if (from.type == NumberType::Uint8) return addWhole<std::uint8_t>(from, kUnsignedByte);
            if (from.type == NumberType::Int8) return addWhole<std::int8_t>(from, kByte);
            if (from.type == NumberType::Uint16) return addWhole<std::uint16_t>(from, kUnsignedShort);
            return addWhole<std::int16_t>(from, kShort);
        }
        const std::vector<float> values(from.values.begin(), from.values.end());
        Attribute attribute = {.name = gltfName(from), .type = typeOf(from)};
        attribute.stride = from.components * sizeof(float);
        attribute.view = addView(values.data(), values.size() * sizeof(float), kVertexBuffer);
        if (severalRanges()) json_["bufferViews"].back()["byteStride"] = attribute.stride;
        attributes_.push_back(std::move(attribute));
    }

    void addSurface() {
        if (small()) return addSmallVertices();
        addAttribute<glm::vec3>({.name = "POSITION", .type = "VEC3"}, mesh_.positions);
        if (!mesh_.normals.empty()) addAttribute<glm::vec3>({.name = "NORMAL", .type = "VEC3"}, mesh_.normals);
        if (!mesh_.tangents.empty()) addAttribute<glm::vec4>({.name = "TANGENT", .type = "VEC4"}, mesh_.tangents);
        if (!mesh_.uvs.empty()) addAttribute<glm::vec2>({.name = "TEXCOORD_0", .type = "VEC2"}, mesh_.uvs);
    }

    /// Elements begin at multiples of 4 bytes, so three shorts are followed by an unused one.
    void addSmallVertices() {
        using Four = std::array<std::int16_t, 4>;
        std::vector<std::array<std::uint16_t, 4>> positions;
        for (const glm::vec3& p : mesh_.positions) {
            const auto q = grid_.encode(p);
            positions.push_back({q[0], q[1], q[2], 0});
        }
        const Attribute position = {.name = "POSITION", .type = "VEC3", .componentType = kUnsignedShort, .normalized = true};
        addAttribute<std::array<std::uint16_t, 4>>(position, positions, true);
        std::vector<Four> directions;
        for (const glm::vec3& n : mesh_.normals)
            directions.push_back({toSnorm16(n.x), toSnorm16(n.y), toSnorm16(n.z), 0});
        const Attribute normal = {.name = "NORMAL", .type = "VEC3", .componentType = kShort, .normalized = true};
        if (!directions.empty()) addAttribute<Four>(normal, directions, true);
        directions.clear();
        for (const glm::vec4& t : mesh_.tangents)
            directions.push_back({toSnorm16(t.x), toSnorm16(t.y), toSnorm16(t.z), toSnorm16(t.w)});
        const Attribute tangent = {.name = "TANGENT", .type = "VEC4", .componentType = kShort, .normalized = true};
        if (!directions.empty()) addAttribute<Four>(tangent, directions);
        addSmallUvs();
    }

    /// Texture coordinates outside the unit square do not fit: they stay floats.
    void addSmallUvs() {
        if (mesh_.uvs.empty()) return;
        const auto inside = [](const glm::vec2& uv) { return uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1; };
        if (!std::ranges::all_of(mesh_.uvs, inside)) return addAttribute<glm::vec2>({.name = "TEXCOORD_0", .type = "VEC2"}, mesh_.uvs);
        std::vector<std::array<std::uint16_t, 2>> uvs;
        const auto number = [](float value) { return static_cast<std::uint16_t>(std::lround(static_cast<double>(value) * 65535)); };
        for (const glm::vec2& uv : mesh_.uvs)
            uvs.push_back({number(uv.x), number(uv.y)});
        const Attribute attribute = {.name = "TEXCOORD_0", .type = "VEC2", .componentType = kUnsignedShort, .normalized = true};
        addAttribute<std::array<std::uint16_t, 2>>(attribute, uvs);
    }

    Json accessorsFor(const Range& range) {
        Json attributes;
        for (const Attribute& attribute : attributes_) {
            Json accessor = {{"bufferView", attribute.view}, {"componentType", attribute.componentType}};
            if (range.firstVertex > 0) accessor["byteOffset"] = range.firstVertex * attribute.stride;
            if (attribute.normalized) accessor["normalized"] = true;
            accessor["count"] = range.vertices;
            accessor["type"] = attribute.type;
            if (attribute.name == "POSITION") addLimits(accessor, range);
            attributes[attribute.name] = json_["accessors"].size();
            json_["accessors"].push_back(std::move(accessor));
        }
        return attributes;
    }

    /// Of the stored numbers, as glTF wants it.
    void addLimits(Json& accessor, const Range& range) const {
        const auto stored = [&](std::size_t i) {
            if (!small()) return glm::dvec3(mesh_.positions[i]);
            const auto q = grid_.encode(mesh_.positions[i]);
            return glm::dvec3(q[0], q[1], q[2]);
        };
        glm::dvec3 low = stored(range.firstVertex);
        glm::dvec3 high = low;
        for (std::size_t i = range.firstVertex; i < range.firstVertex + range.vertices; ++i) {
            low = glm::min(low, stored(i));
            high = glm::max(high, stored(i));
        }
        const auto numbers = [&](const glm::dvec3& v) -> Json {
            if (!small()) return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
            return {static_cast<int>(v.x), static_cast<int>(v.y), static_cast<int>(v.z)};
        };
        accessor["min"] = numbers(low);
        accessor["max"] = numbers(high);
    }

    [[nodiscard]] Range rangeOf(std::span<const std::uint32_t> indices) const {
        if (!options_.partsOwnVertices) return {.firstVertex = 0, .vertices = mesh_.positions.size()};
        const auto [low, high] = std::ranges::minmax_element(indices);
        return {.firstVertex = *low, .vertices = std::size_t{*high} - *low + 1};
    }

    std::size_t addIndices(std::span<const std::uint32_t> indices, const Range& range) {
        const bool wide = range.vertices > kMost16BitVertices;
        const auto write = [&]<class T>(T) {
            std::vector<T> numbers;
            numbers.reserve(indices.size());
            for (const std::uint32_t index : indices)
                numbers.push_back(static_cast<T>(index - range.firstVertex));
            return addView(numbers.data(), numbers.size() * sizeof(T), kIndexBuffer);
        };
        const std::size_t view = wide ? write(std::uint32_t{}) : write(std::uint16_t{});
        json_["accessors"].push_back(
            {{"bufferView", view}, {"componentType", wide ? kUnsignedInt : kUnsignedShort}, {"count", indices.size()}, {"type", "SCALAR"}});
        return json_["accessors"].size() - 1;
    }

    /// Parts that use the same range of vertices name the same accessors: readers share the vertices by that.
    void addMesh(const std::vector<std::uint32_t>& indices, const std::vector<MeshPart>& parts, double errorMm) {
        Json primitives = Json::array();
        for (const MeshPart& part : parts) {
            const auto own = std::span(indices).subspan(part.firstIndex, part.indexCount);
            const Range range = rangeOf(own);
            if (shared_.is_null() || options_.partsOwnVertices) shared_ = {{"attributes", accessorsFor(range)}};
            primitives.push_back(primitiveOf(part, own, range, shared_));
        }
        addMesh(mesh_.name, std::move(primitives), errorMm);
    }

    void addMesh(const std::string& name, Json primitives, double errorMm) {
        json_["meshes"].push_back({{"name", name}, {"primitives", std::move(primitives)}, {"extras", {{"tegument", extras(errorMm)}}}});
    }

    Json primitiveOf(const MeshPart& part, std::span<const std::uint32_t> indices, const Range& range, const Json& vertices) {
        Json primitive = vertices;
        primitive["indices"] = addIndices(indices, range);
        primitive["extras"]["name"] = part.name;
        if (!part.clusters.empty()) primitive["extras"]["tegument"]["clusters"] = clustersOf(part);
        if (!mesh_.textures.empty()) primitive["material"] = 0;
        if (part.material && *part.material < materials_) primitive["material"] = *part.material;
        return primitive;
    }

    /// A mesh for each node that draws, of the parts whose vertices are its.
    void addMoving() {
        meshfile::MotionWriter motion(
            mesh_, json_, [this](const void* data, std::size_t size, std::optional<int> target) { return addView(data, size, target); },
            place());
        std::map<const MotionRun*, Range> ranges;
        for (const std::uint32_t index : mesh_.indices) {
            Range& range = ranges.try_emplace(&motion.runOf(index), Range{.firstVertex = index, .vertices = 0}).first->second;
            const std::size_t end = std::max(range.firstVertex + range.vertices, std::size_t{index} + 1);
            range.firstVertex = std::min(range.firstVertex, std::size_t{index});
            range.vertices = end - range.firstVertex;
        }
        std::map<std::pair<const MotionRun*, std::size_t>, Json> known;
        for (std::size_t level = 0; level <= options_.levels.size(); ++level) {
            const auto& indices = level == 0 ? mesh_.indices : options_.levels[level - 1].indices;
            std::map<std::size_t, std::pair<const MotionRun*, Json>> drawn; // by node
            for (const MeshPart& part : level == 0 ? mesh_.parts : options_.levels[level - 1].parts) {
                if (part.indexCount == 0) continue;
                std::vector<std::uint32_t> own(&indices[part.firstIndex], &indices[part.firstIndex] + part.indexCount);
                const MotionRun& run = motion.runOf(own.front());
                const Range range = options_.partsOwnVertices ? rangeOf(own) : ranges.at(&run);
                Json& vertices = known[{&run, range.firstVertex}];
                if (vertices.is_null()) {
                    vertices["attributes"] = accessorsFor(range);
                    motion.addTo(vertices, run, {.first = range.firstVertex, .count = range.vertices});
                }
                for (std::size_t i = 0; i < own.size() && motion.mirrors(own.front()); i += 3)
                    std::swap(own[i + 1], own[i + 2]);
                auto& [first, primitives] = drawn[run.node];
                first = &run;
                primitives.push_back(primitiveOf(part, own, range, vertices));
            }
            for (auto& [node, mesh] : drawn) {
                addMesh(mesh.first->meshName, std::move(mesh.second), level == 0 ? 0 : options_.levels[level - 1].errorMm);
                motion.draw(*mesh.first, json_["meshes"].size() - 1, level);
            }
        }
        motion.finish();
        collectExtensions(json_["nodes"]);
        used_.erase("MSFT_lod"); // is told below
        if (json_.contains("extensions")) used_.insert("KHR_lights_punctual");
    }

    /// Ball and cone are for who reads the file elsewhere: read_gltf.cpp makes them anew.
    static Json clustersOf(const MeshPart& part) {
        Json clusters = Json::array();
        for (const MeshCluster& c : part.clusters)
            clusters.push_back({{"indices", c.indexCount},
                                {"centre", list(c.centre)},
                                {"radius", c.radius},
                                {"axis", list(c.axis)},
                                {"cosine", c.cosine}});
        return clusters;
    }

    [[nodiscard]] Json extras(double errorMm) const {
        const Bounds& b = mesh_.bounds;
        Json json = {
            {"bounds", {{"centre", list(b.centre)}, {"radius", b.radius}, {"minimum", list(b.minimum)}, {"maximum", list(b.maximum)}}}};
        if (options_.moved != glm::dvec3(0)) json["moved"] = list(options_.moved);
        if (errorMm > 0) json["errorMm"] = errorMm;
        return json;
    }

    /// The first node is the scene's; those of coarser levels are reached through MSFT_lod only.
    void addNodes() {
        json_["scenes"][0]["nodes"] = {0};
        const double scale = small() ? grid_.step * 65535 * 0.001 : 0.001;
        for (std::size_t i = 0; i < json_["meshes"].size(); ++i) {
            Json node = {{"name", i == 0 ? mesh_.name : fmt::format("{} level {}", mesh_.name, i)}, {"mesh", i}};
            if (small() || place() != glm::dvec3(0))
                node["translation"] = list(((small() ? grid_.origin : glm::dvec3(0)) + place()) * 0.001);
            node["scale"] = {scale, scale, scale};
            json_["nodes"].push_back(std::move(node));
        }
        if (options_.levels.empty()) return;
        Json ids = Json::array();
        for (std::size_t i = 1; i < json_["nodes"].size(); ++i)
            ids.push_back(i);
        json_["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = std::move(ids);
    }

    /// As they came, with their pictures in the file.
    void addMaterials() {
        if (mesh_.materials.json.empty()) return;
        MaterialSet set = mesh_.materials;
        if (mesh_.uvs.empty()) dropTextures(set);
        const Json json = Json::parse(set.json);
        for (const auto& [list, values] : json.items()) {
            json_[list] = values;
            collectExtensions(values);
        }
        for (std::size_t i = 0; i < set.images.size(); ++i)
            json_["images"][i]["bufferView"] = addView(set.images[i].data(), set.images[i].size(), std::nullopt);
        materials_ = json_.contains("materials") ? json_["materials"].size() : 0;
        for (const Json& texture : json_.contains("textures") ? json_["textures"] : Json::array())
            if (texture.contains("extensions") && !texture.contains("source"))
                for (const auto& [name, unused] : texture["extensions"].items())
                    required_.insert(name);
    }

    void collectExtensions(const Json& value) {
        if (value.is_object() && value.contains("extensions") && value["extensions"].is_object())
            for (const auto& [name, unused] : value["extensions"].items())
                used_.insert(name);
        if (value.is_structured())
            for (const Json& item : value)
                collectExtensions(item);
    }

    void addExtensions() {
        for (const std::string& name : used_)
            json_["extensionsUsed"].push_back(name);
        for (const std::string& name : required_)
            json_["extensionsRequired"].push_back(name);
        if (!options_.levels.empty()) json_["extensionsUsed"].push_back("MSFT_lod");
        if (!small()) return;
        json_["extensionsUsed"].push_back("KHR_mesh_quantization");
        json_["extensionsRequired"].push_back("KHR_mesh_quantization");
    }

    std::optional<Error> addTextures() {
        if (mesh_.textures.empty() || materials_ > 0) return std::nullopt;
        Json material = {{"name", mesh_.name}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}};
        json_["samplers"] = Json::array({Json::object()});
        for (const EmbeddedTexture& texture : mesh_.textures) {
            const Result<std::string> png = encodePng(texture.image, PngEncoding::Raw);
            if (!png) return png.error();
            const std::size_t index = json_["textures"].size();
            const std::size_t view = addView(png->data(), png->size(), std::nullopt);
            json_["images"].push_back({{"name", texture.role}, {"bufferView", view}, {"mimeType", "image/png"}});
            json_["textures"].push_back({{"sampler", 0}, {"source", index}});
            if (texture.role == "color")
                material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", index}};
            else if (texture.role == "normal")
                material["normalTexture"] = {{"index", index}};
            else
                material["extras"]["tegumentTextures"][texture.role] = index;
        }
        json_["materials"] = Json::array({std::move(material)});
        return std::nullopt;
    }

    [[nodiscard]] Result<std::string> container() const {
        std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const std::size_t length = 12 + 8 + text.size() + (binary_.empty() ? 0 : 8 + binary_.size());
        if (length > std::numeric_limits<std::uint32_t>::max())
            return inputError(5330, {}, fmt::format("the mesh needs {} bytes as glb, whose limit is 4 GiB", length), "reduce it");
        std::string glb = "glTF";
        glb.reserve(length);
        const auto word = [&](std::size_t value) {
            for (unsigned i = 0; i < 4; ++i)
                glb.push_back(static_cast<char>(value >> (8 * i) & 255));
        };
        word(2);
        word(length);
        word(text.size());
        glb += "JSON" + text;
        if (binary_.empty()) return glb;
        word(binary_.size());
        glb.append("BIN\0", 4).append(binary_);
        return glb;
    }

    const Mesh& mesh_;
    const GlbOptions& options_;
    PositionGrid grid_;
    Json json_;
    Json shared_; // accessors of the last range of vertices
    std::vector<Attribute> attributes_;
    std::string binary_;
    std::size_t materials_ = 0;
    std::set<std::string> used_, required_; // extensions of the materials
};

/// The file is little-endian.
static_assert(std::endian::native == std::endian::little, "writeGlb copies floats as they are in memory");

} // namespace

Result<void> writeGlb(const std::filesystem::path& path, const Mesh& mesh, const GlbOptions& options) {
    assert(mesh.indices.empty() || !mesh.parts.empty());
    const std::optional<Mesh> moving = mesh.motion ? std::optional(meshfile::inFile(mesh)) : std::nullopt;
    Result<std::string> glb = GlbWriter(moving ? *moving : mesh, options).write();
    if (!glb) {
        Error error = glb.error();
        for (Diagnostic& diagnostic : error.diagnostics)
            diagnostic.at.file = path.string();
        return error;
    }
    return writeFile(path, *glb);
}

Result<void> writeGlb(const std::filesystem::path& path, const Mesh& mesh) {
    return writeGlb(path, mesh, GlbOptions{});
}

} // namespace tegument
