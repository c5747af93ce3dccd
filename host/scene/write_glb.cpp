// Mesh -> glb. Positions stay in millimetres, as they are in memory; the node's scale of 0.001 makes them glTF's metres. Reading back
// multiplies by 0.001 * 1000, which is exactly 1 in double precision, so every float returns bit for bit.

#include "host/scene/mesh.h"
#include "host/support/file.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <limits>

namespace tegument {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kVertexBuffer = 34962;
constexpr int kIndexBuffer = 34963;

class GlbWriter {
public:
    explicit GlbWriter(const Mesh& mesh) : mesh_(mesh) {
        json_["asset"] = {{"version", "2.0"}, {"generator", "Tegument"}};
        if (!mesh.attribution.empty()) json_["asset"]["copyright"] = mesh.attribution;
        json_["scene"] = 0;
        json_["scenes"] = Json::array({{{"nodes", {0}}}});
        json_["nodes"] = Json::array({{{"name", mesh.name}, {"mesh", 0}, {"scale", {0.001, 0.001, 0.001}}}});
    }

    Result<std::string> write() {
        if (auto error = addTextures()) return *error;
        addPrimitives();
        json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
        return container();
    }

private:
    std::size_t addView(const void* data, std::size_t size, std::optional<int> target) {
        Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}};
        if (target) view["target"] = *target;
        json_["bufferViews"].push_back(std::move(view));
        binary_.append(static_cast<const char*>(data), size);
        binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
        return json_["bufferViews"].size() - 1;
    }

    template <class T>
    std::size_t addVertices(const std::vector<T>& values, const char* type) {
        const std::size_t view = addView(values.data(), values.size() * sizeof(T), kVertexBuffer);
        json_["accessors"].push_back({{"bufferView", view}, {"componentType", kFloat}, {"count", values.size()}, {"type", type}});
        return json_["accessors"].size() - 1;
    }

    Json addAttributes() {
        Json attributes;
        attributes["POSITION"] = addVertices(mesh_.positions, "VEC3");
        Json& position = json_["accessors"].back();
        glm::vec3 low = mesh_.positions.front();
        glm::vec3 high = low;
        for (const glm::vec3& p : mesh_.positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        position["min"] = {low.x, low.y, low.z};
        position["max"] = {high.x, high.y, high.z};
        if (!mesh_.normals.empty()) attributes["NORMAL"] = addVertices(mesh_.normals, "VEC3");
        if (!mesh_.tangents.empty()) attributes["TANGENT"] = addVertices(mesh_.tangents, "VEC4");
        if (!mesh_.uvs.empty()) attributes["TEXCOORD_0"] = addVertices(mesh_.uvs, "VEC2");
        return attributes;
    }

    void addPrimitives() {
        const Json attributes = addAttributes();
        const std::size_t view = addView(mesh_.indices.data(), mesh_.indices.size() * sizeof(std::uint32_t), kIndexBuffer);
        Json primitives = Json::array();
        for (const MeshPart& part : mesh_.parts) {
            json_["accessors"].push_back({{"bufferView", view},
                                          {"byteOffset", part.firstIndex * sizeof(std::uint32_t)},
                                          {"componentType", kUnsignedInt},
                                          {"count", part.indexCount},
                                          {"type", "SCALAR"}});
            primitives.push_back(
                {{"attributes", attributes}, {"indices", json_["accessors"].size() - 1}, {"extras", {{"name", part.name}}}});
            if (!mesh_.textures.empty()) primitives.back()["material"] = 0;
        }
        json_["meshes"] = Json::array({{{"name", mesh_.name}, {"primitives", std::move(primitives)}}});
    }

    std::optional<Error> addTextures() {
        if (mesh_.textures.empty()) return std::nullopt;
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
        const std::size_t length = 12 + 8 + text.size() + 8 + binary_.size();
        if (length > std::numeric_limits<std::uint32_t>::max())
            return inputError(5330, {.byte = {}}, fmt::format("the mesh needs {} bytes as glb, whose limit is 4 GiB", length), "reduce it");
        std::string glb = "glTF";
        const auto word = [&](std::size_t value) {
            for (unsigned i = 0; i < 4; ++i)
                glb.push_back(static_cast<char>(value >> (8 * i) & 255));
        };
        word(2);
        word(length);
        word(text.size());
        glb += "JSON" + text;
        word(binary_.size());
        glb.append("BIN\0", 4).append(binary_);
        return glb;
    }

    const Mesh& mesh_;
    Json json_;
    std::string binary_;
};

/// The file is little-endian.
static_assert(std::endian::native == std::endian::little, "writeGlb copies floats as they are in memory");

} // namespace

Result<void> writeGlb(const std::filesystem::path& path, const Mesh& mesh) {
    assert(!mesh.positions.empty() && !mesh.indices.empty() && !mesh.parts.empty());
    Result<std::string> glb = GlbWriter(mesh).write();
    if (!glb) {
        Error error = glb.error();
        for (Diagnostic& diagnostic : error.diagnostics)
            diagnostic.at.file = path.string();
        return error;
    }
    return writeFile(path, *glb);
}

} // namespace tegument
