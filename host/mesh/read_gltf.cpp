// glTF 2.0 scenes -> one mesh: the default scene's nodes with their transforms applied, every primitive a part.

#include "host/mesh/gltf_document.h"
#include "host/mesh/gltf_draco.h"
#include "host/mesh/gltf_motion.h"
#include "host/mesh/materials.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>

namespace tegument::meshfile {

namespace {

/// A mesh as one node draws it.
struct GltfDraw {
    std::size_t mesh = 0;
    std::optional<std::size_t> node{};
    std::string nodeName{};
    Carrier carrier;
};

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
            draws_.push_back({.mesh = i, .carrier = Carrier(unit)});
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
        if (node["extensions"].has("EXT_mesh_gpu_instancing"))
            return drawInstances(node, node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"], *index, world, visit.node);
        draws_.push_back({.mesh = *index, .node = visit.node, .nodeName = node.text("name"), .carrier = Carrier(world)});
        return std::nullopt;
    }

    /// EXT_mesh_gpu_instancing: a place, a turn and a size for each instance; what is absent is as in a node.
    std::optional<Error> drawInstances(const GltfValue& node, const GltfValue& attributes, std::size_t mesh, const glm::dmat4& world,
                                       std::size_t number) {
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
            draws_.push_back({.mesh = mesh, .node = number, .nodeName = node.text("name"), .carrier = Carrier(world * local)});
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

/// The meshes of the default scene's nodes, one entry for each node or instance that draws one. TG5302 where nodes are no trees, TG5310
/// where they draw more than a mesh may hold. Skins that are ignored are warnings, unless materials are carried.
Result<std::vector<GltfDraw>> drawsOf(const GltfDocument& document, Mesh& mesh) {
    return SceneWalk(document, mesh).walk();
}

class Losses {
public:
    Losses(const GltfDocument& document, Mesh& mesh) : root_(document.root()), mesh_(mesh) {}

    void tell(std::size_t count, std::string_view what, std::string hint = {}) {
        if (count > 0) warn(mesh_, 5331, root_.source().whole(), fmt::format("{} {}", count, what), std::move(hint));
    }

    void ofMeshes(const std::vector<std::size_t>& meshes, bool moves) {
        const std::set<std::size_t> used(meshes.begin(), meshes.end());
        std::size_t targets = 0;
        std::size_t weighted = 0;
        std::size_t variants = 0;
        for (const std::size_t index : used) {
            const GltfValue primitives = root_["meshes"][index]["primitives"];
            for (std::size_t i = 0; i < primitives.size(); ++i) {
                targets += moves ? 0 : primitives[i]["targets"].size();
                weighted += !moves && primitives[i]["attributes"].has("JOINTS_0");
                variants += primitives[i]["extensions"].has("KHR_materials_variants");
            }
        }
        tell(targets, "morph targets are left out: the mesh is as it was modelled", "export the shape that is wanted");
        tell(weighted, "primitives lose the joints and weights of their skin: the mesh is as it was modelled",
             "export the pose that is wanted");
        tell(variants, "primitives lose their other materials (KHR_materials_variants)");
        tell(meshes.size() - used.size(), "copies of meshes that several nodes or instances draw become triangles of their own");
    }

    void ofScene(bool moves) {
        if (!moves) tell(root_["animations"].size(), "animations are left out");
        if (!moves) tell(root_["cameras"].size(), "cameras are left out");
        if (!moves) tell(root_["extensions"]["KHR_lights_punctual"]["lights"].size(), "lights are left out");
        if (root_["scenes"].size() > 1) tell(root_["scenes"].size() - 1, "scenes besides the default one are left out");
    }

private:
    GltfValue root_;
    Mesh& mesh_;
};

/// One warning (TG5331) for each kind of thing that goes: morph targets, skins, animations, copies that were drawn by one mesh ...
/// `meshes`: the mesh of each draw. `moves`: nodes, skins, morph targets and animations are kept.
void warnOfLosses(const GltfDocument& document, const std::vector<std::size_t>& meshes, bool moves, Mesh& mesh) {
    Losses losses(document, mesh);
    losses.ofMeshes(meshes, moves);
    losses.ofScene(moves);
}

/// Collects the textures of the materials that are drawn: "color" (baseColorTexture), "normal" (normalTexture), and whatever a material's
/// `extras.tegumentTextures` names as {"role": texture index}. Several of a role become a sheet (material_sheet.cpp), but not where there
/// are such extras, or the mesh's own coordinates are asked for: then the first of each role.
class GltfTextures {
public:
    explicit GltfTextures(const GltfDocument& document) : document_(document) {}
    /// Of each part in turn; an empty value: a part without a material.
    [[nodiscard]] std::optional<Error> add(const GltfValue& material, Mesh& mesh);
    void addPlain() { materialOfPart_.push_back(numberOf({}, glm::vec3(1))); }
    void finish(ReadMesh& read);

private:
    struct Picture {
        std::string path; // of what refers to it
        std::optional<Image> image;
        PictureEdges edges{};
    };

    [[nodiscard]] std::optional<Error> load(const std::string& role, std::size_t texture, const GltfValue& from, Mesh& mesh);
    using Textures = std::vector<std::pair<std::string, std::size_t>>; // of each role
    /// The first texture of the same picture and sampler.
    [[nodiscard]] std::size_t firstLike(std::size_t texture) const;
    [[nodiscard]] std::size_t numberOf(const Textures& textures, const glm::vec3& factor);
    [[nodiscard]] DrawnMaterial drawn(std::size_t material) const;
    void useFirst(Mesh& mesh);

    const GltfDocument& document_;
    std::map<std::pair<std::string, std::size_t>, Picture> pictures_; // by role and texture
    struct Material {
        Textures textures;
        glm::vec3 factor{1};

        bool operator==(const Material&) const = default;
    };
    std::vector<Material> materials_; // each once
    std::vector<std::size_t> materialOfPart_;
};

PictureEdges edgesOf(const GltfValue& texture, const GltfValue& samplers) {
    PictureEdges edges = {PictureEdge::Repeat, PictureEdge::Repeat};
    const auto sampler = texture.whole("sampler", samplers.size(), SIZE_MAX);
    if (!sampler || *sampler >= samplers.size()) return edges;
    for (const std::size_t axis : {0U, 1U}) {
        constexpr std::size_t kClamp = 33071, kMirror = 33648;
        const auto wrap = samplers[*sampler].whole(axis == 0 ? "wrapS" : "wrapT", 65536, 10497);
        if (wrap && *wrap == kClamp) edges[axis] = PictureEdge::Clamp;
        if (wrap && *wrap == kMirror) edges[axis] = PictureEdge::Mirror;
    }
    return edges;
}

/// How messages name a picture.
std::string nameOf(const GltfDocument& document, std::size_t image) {
    const GltfValue images = document.root()["images"];
    const std::string uri = image < images.size() ? images[image].text("uri") : "";
    return uri.empty() || uri.starts_with("data:") ? fmt::format("images[{}]", image) : fmt::format("'{}'", uri.substr(0, 80));
}

Result<std::string> pictureBytes(const GltfDocument& document, std::size_t image) {
    const GltfValue images = document.root()["images"];
    if (image >= images.size()) return malformed(images.source().whole(), fmt::format("images[{}] does not exist", image));
    const GltfValue value = images[image];
    if (!value.has("bufferView")) return document.resolveUri(value, value.text("uri"));
    const auto index = value.whole("bufferView", SIZE_MAX, {});
    if (!index) return index.error();
    const auto bytes = document.view(*index);
    if (!bytes) return bytes.error();
    return std::string(*bytes);
}

constexpr const char* kExportAgain = "put the pictures where the file says, or export it again";

/// A texture names its picture itself, and in extensions the same in other forms.
void renumber(Json& texture, const std::map<std::size_t, std::size_t>& number) {
    if (!texture.is_object()) return;
    if (texture.contains("source")) {
        const auto known = texture["source"].is_number_unsigned() ? number.find(texture["source"].get<std::size_t>()) : number.end();
        if (known != number.end())
            texture["source"] = known->second;
        else
            texture.erase("source");
    }
    if (!texture.contains("extensions") || !texture["extensions"].is_object()) return;
    Json kept = Json::object();
    for (auto& [name, extension] : texture["extensions"].items()) {
        renumber(extension, number);
        if (extension.is_object() && extension.contains("source")) kept[name] = extension;
    }
    texture.erase("extensions");
    if (!kept.empty()) texture["extensions"] = std::move(kept);
}

std::optional<Error> GltfTextures::add(const GltfValue& material, Mesh& mesh) {
    Textures textures;
    const auto addTexture = [&](const std::string& role, const Result<std::size_t>& index, const GltfValue& from) -> std::optional<Error> {
        if (!index) return index.error();
        const std::size_t first = firstLike(*index);
        textures.emplace_back(role, first);
        return load(role, first, from, mesh);
    };
    const GltfValue surface = material["pbrMetallicRoughness"];
    const GltfValue base = surface["baseColorTexture"];
    if (surface.has("baseColorTexture"))
        if (auto error = addTexture("color", base.whole("index", SIZE_MAX, {}), base)) return error;
    if (material.has("normalTexture")) {
        const GltfValue normal = material["normalTexture"]; // one set of coordinates is drawn with: the colour map's
        if (normal["extensions"]["KHR_texture_transform"].json() != base["extensions"]["KHR_texture_transform"].json())
            warn(mesh, 5323, document_.source().whole(),
                 normal.path() + ": its KHR_texture_transform is not the colour map's, and is ignored");
        if (auto error = addTexture("normal", normal.whole("index", SIZE_MAX, {}), normal)) return error;
    }
    const GltfValue own = material["extras"]["tegumentTextures"];
    if (own.json().is_object())
        for (const auto& [role, texture] : own.json().items())
            if (auto error = addTexture(role, own.whole(role.c_str(), SIZE_MAX, {}), own)) return error;
    const auto factor = surface.numbers("baseColorFactor", 4, {1, 1, 1, 1});
    if (!factor) return factor.error();
    materialOfPart_.push_back(
        numberOf(textures, glm::clamp(glm::vec3((*factor)[0], (*factor)[1], (*factor)[2]), glm::vec3(0), glm::vec3(1))));
    return std::nullopt;
}

std::size_t GltfTextures::firstLike(std::size_t texture) const {
    const GltfValue textures = document_.root()["textures"];
    const auto isLike = [&](std::size_t other) {
        return std::ranges::all_of(std::array{"source", "sampler", "extensions"},
                                   [&](const char* key) { return textures[other][key].json() == textures[texture][key].json(); });
    };
    for (std::size_t other = 0; other < std::min(texture, textures.size()); ++other)
        if (texture < textures.size() && isLike(other)) return other;
    return texture;
}

std::size_t GltfTextures::numberOf(const Textures& textures, const glm::vec3& factor) {
    const Material material{.textures = textures, .factor = factor};
    const auto known = std::ranges::find(materials_, material);
    if (known != materials_.end()) return static_cast<std::size_t>(known - materials_.begin());
    materials_.push_back(material);
    return materials_.size() - 1;
}

std::optional<Error> GltfTextures::load(const std::string& role, std::size_t texture, const GltfValue& from, Mesh& mesh) {
    const GltfValue textures = document_.root()["textures"];
    if (texture >= textures.size()) return from.wrong(fmt::format("names texture {} of {}", texture, textures.size()));
    const auto [known, isNew] = pictures_.emplace(std::pair(role, texture), Picture{.path = from.path()});
    if (!isNew) return std::nullopt;
    const auto image = textures[texture].whole("source", SIZE_MAX, {});
    if (!image) { // an extension names it, in a form that is not read
        warn(mesh, 5328, document_.source().whole(), fmt::format("the '{}' texture is left out: it is no PNG or JPEG file", role),
             "export the textures as PNG or JPEG");
        return std::nullopt;
    }
    const auto bytes = pictureBytes(document_, *image);
    const int code = bytes ? 0 : bytes.error().diagnostics.front().code;
    if (!bytes && code != 5001 && code != kOutside) return bytes.error(); // the glTF itself is wrong
    const std::string name = fmt::format("{}#images[{}]", from.source().name(), *image);
    auto loaded = bytes ? decodeImage(std::as_bytes(std::span(*bytes)), name) : Result<Image>(bytes.error());
    if (!loaded) {
        warn(
            mesh, 5328, document_.source().whole(),
            fmt::format("the '{}' texture {} cannot be read: {}", role, nameOf(document_, *image), loaded.error().diagnostics.front().text),
            hintFor(loaded.error(), "put the pictures where the file says, or give one: --set gSkinMap=FILE"));
        return std::nullopt;
    }
    known->second.image = std::move(*loaded);
    known->second.edges = edgesOf(textures[texture], document_.root()["samplers"]);
    return std::nullopt;
}

DrawnMaterial GltfTextures::drawn(std::size_t material) const {
    DrawnMaterial drawn{.factor = materials_[material].factor};
    for (const auto& [role, texture] : materials_[material].textures) {
        const Picture& picture = pictures_.at({role, texture});
        (role == "color" ? drawn.colour : drawn.normal) = picture.image;
        if (role == "color" || !drawn.colour) drawn.edges = picture.edges;
    }
    return drawn;
}

void GltfTextures::useFirst(Mesh& mesh) {
    std::map<std::string, std::size_t> first;
    std::vector<PictureEdges> edges;
    for (const Material& material : materials_)
        for (const auto& [role, texture] : material.textures) {
            Picture& picture = pictures_.at({role, texture});
            const auto [known, isNew] = first.emplace(role, texture);
            if (!isNew && known->second != texture)
                warn(mesh, 5326, document_.source().whole(),
                     fmt::format("{}: a second '{}' texture is ignored: one mesh carries one of each role", picture.path, role),
                     "name the texture in the workspace, or split the mesh");
            if (!isNew || !picture.image) continue;
            edges.push_back(picture.edges);
            mesh.textures.push_back({.role = role, .image = std::move(*picture.image)});
            if (role == "color") tint(material.factor, mesh.textures.back().image);
        }
    layOutPictures(document_.source(), edges, mesh);
}

void GltfTextures::finish(ReadMesh& read) {
    const auto isOwn = [](const auto& entry) { return entry.first.first != "color" && entry.first.first != "normal"; };
    const bool pictured = std::ranges::any_of(pictures_, [](const auto& entry) { return entry.second.image.has_value(); });
    if (materials_.size() > 1 && pictured && !read.mesh.uvs.empty() && !document_.source().ownCoordinates &&
        std::ranges::none_of(pictures_, isOwn)) {
        std::vector<DrawnMaterial> materials;
        for (std::size_t i = 0; i < materials_.size(); ++i)
            materials.push_back(drawn(i));
        if (layOutMaterials(materials, materialOfPart_, read)) return;
    }
    useFirst(read.mesh);
}

/// Whether what is carried has the types that glTF gives it: numbers, arrays of numbers, objects, and references to textures that are
/// there.
bool isWellTyped(const Json& value, const std::string& key, std::size_t textures) {
    const auto all = [&](const auto& good) { return std::ranges::all_of(value, good); };
    if (key == "index") return value.is_number_unsigned() && value.get<std::size_t>() < textures;
    if (key.ends_with("Factor") || key == "scale" || key == "strength" || key == "alphaCutoff" || key == "offset" || key == "rotation")
        return value.is_number() || (value.is_array() && all([](const Json& number) { return number.is_number(); }));
    if (key == "texCoord") return value.is_number_unsigned();
    const bool isReference = key.ends_with("Texture");
    const bool isObject = isReference || key.empty() || key == "pbrMetallicRoughness" || key == "extensions" || key.starts_with("KHR_");
    if (!isObject) return true;
    if (!value.is_object() || (isReference && !value.contains("index"))) return false;
    return std::ranges::all_of(value.items(), [&](const auto& entry) { return isWellTyped(entry.value(), entry.key(), textures); });
}

/// All materials as they are, with the files of their pictures. One of other types than glTF's becomes plain, with a warning (TG5331). A
/// picture that is not there or is none is left out: TG5328, a warning.
MaterialSet carriedMaterials(const GltfDocument& document, Mesh& mesh) {
    const GltfValue root = document.root();
    MaterialSet set;
    if (root["materials"].size() == 0) return set;
    Json json = Json::object();
    for (const char* list : {"materials", "samplers", "textures"})
        if (root[list].size() > 0) json[list] = root[list].json();
    for (std::size_t i = 0; i < json["materials"].size(); ++i) {
        Json& material = json["materials"][i];
        if (isWellTyped(material, "", root["textures"].size())) continue;
        warn(mesh, 5331, root.source().whole(), fmt::format("materials[{}] is left out: its values are not of glTF's types", i),
             kExportAgain);
        material = Json::object();
    }
    std::map<std::size_t, std::size_t> number; // of a picture, among those that are kept
    for (std::size_t i = 0; i < root["images"].size(); ++i) {
        auto bytes = pictureBytes(document, i);
        const std::string_view type = bytes ? pictureType(*bytes) : "";
        if (type.empty()) {
            warn(mesh, 5328, root.source().whole(),
                 fmt::format("{} is left out: {}", nameOf(document, i),
                             bytes ? "no whole PNG, JPEG, WebP, KTX2 or DDS file" : bytes.error().diagnostics.front().text),
                 bytes ? kExportAgain : hintFor(bytes.error(), kExportAgain));
            continue;
        }
        number[i] = set.images.size();
        Json image = {{"mimeType", type}};
        if (const std::string name = root["images"][i].text("name"); !name.empty()) image["name"] = name;
        json["images"].push_back(std::move(image));
        set.images.push_back(std::move(*bytes));
    }
    if (json.contains("textures") && json["textures"].is_array())
        for (Json& texture : json["textures"])
            renumber(texture, number);
    set.json = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    return set;
}

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
        if (auto error = readWhatMoves()) return *error;
        for (const GltfDraw& draw : draws_)
            if (auto error = readMesh(document_.root()["meshes"][draw.mesh], draw)) return *error;
        // Attributes that only some primitives have are not usable for all: normals and tangents are made anew, UVs are filled.
        if (!allNormals_) mesh_.normals.clear();
        if (!allTangents_) mesh_.tangents.clear();
        finishUvs();
        if (skipped_ > 0) warn(mesh_, 5323, source_.whole(), fmt::format("{} primitives that are points or lines are left out", skipped_));
        counts_.vertices = mesh_.positions.size();
        if (source_.carryMaterials) {
            mesh_.materials = carriedMaterials(document_, mesh_);
            warnOfLosses(document_, usedMeshes(), motion_ != nullptr, mesh_);
        }
        if (motion_) {
            findKinds(*motion_);
            mesh_.motion = motion_;
            mesh_.motionRoot = glm::dmat4(glm::dmat3(source_.unitMm));
        }
        ReadMesh read{.mesh = std::move(mesh_), .counts = counts_, .exact = std::move(exact_), .exactFrom = exactFrom_};
        if (!source_.carryMaterials) textures_.finish(read);
        return read;
    }

private:
    [[nodiscard]] std::vector<std::size_t> usedMeshes() const {
        std::vector<std::size_t> meshes;
        for (const GltfDraw& draw : draws_)
            meshes.push_back(draw.mesh);
        return meshes;
    }

    std::optional<Error> readWhatMoves() {
        std::vector<std::size_t> nodes;
        for (const GltfDraw& draw : draws_)
            if (draw.node) nodes.push_back(*draw.node);
        auto motion = readMotion(document_, nodes, mesh_);
        if (!motion) return motion.error();
        motion_ = std::move(*motion);
        if (!motion_) return std::nullopt;
        rest_ = stateAt(*motion_, nullptr, 0);
        shape_.emplace(*motion_, rest_, glm::dmat4(glm::dmat3(source_.unitMm)));
        return std::nullopt;
    }

    std::optional<Error> readMesh(const GltfValue& mesh, const GltfDraw& draw) {
        const std::string name = mesh.text("name").empty() ? draw.nodeName : mesh.text("name");
        if (mesh_.name.empty()) mesh_.name = name;
        vertexBase_.clear(); // shared vertices are carried once per node
        const GltfValue primitives = mesh["primitives"];
        for (std::size_t i = 0; i < primitives.size(); ++i)
            if (auto error = readPrimitive(mesh, primitives[i], name, draw)) return error;
        return std::nullopt;
    }

    std::optional<Error> readPrimitive(const GltfValue& mesh, const GltfValue& primitive, const std::string& meshName,
                                       const GltfDraw& draw) {
        const auto mode = primitive.whole("mode", 7, 4);
        if (!mode) return mode.error();
        if (*mode < 4) {
            ++skipped_;
            return std::nullopt;
        }
        const auto vertices = vertexRange(mesh, primitive, draw);
        if (!vertices) return vertices.error();
        const bool mirrors =
            shape_ && vertices->count > 0 ? shape_->carrier(static_cast<std::uint32_t>(vertices->base)).mirrors : draw.carrier.mirrors;
        const bool packed = isDraco(primitive);
        const std::uint32_t restart = packed || *mode == 4 ? kNoRestart : restartOf(primitive);
        auto corners = packed ? packedCorners(primitive) : readCorners(primitive, vertices->count, restart);
        if (!corners) return corners.error();
        const auto first = static_cast<std::uint32_t>(mesh_.indices.size());
        for (auto from = corners->begin(); from != corners->end();) {
            const auto to = restart == kNoRestart ? corners->end() : std::find(from, corners->end(), restart);
            addTriangles(std::span(from, to), packed ? 4 : *mode, *vertices, mirrors);
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
    Result<VertexRange> vertexRange(const GltfValue& mesh, const GltfValue& primitive, const GltfDraw& draw) {
        std::string key = primitive["attributes"].json().dump(-1, ' ', true, Json::error_handler_t::replace);
        key += primitive["targets"].json().dump(-1, ' ', true, Json::error_handler_t::replace);
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
        if (auto error = motion_ ? addRun(*attributes, mesh, primitive, draw) : std::nullopt) return *error;
        if (auto error = addVertices(*attributes, draw.carrier, primitive)) return *error;
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
                    known, {.name = other.name, .type = other.type, .normalised = other.normalised, .components = other.components});
            if (known->components != other.components || known->type != other.type) continue;
            known->values.resize(before * known->components, 0);
            known->values.insert(known->values.end(), other.values.begin(), other.values.end());
        }
        for (MeshAttribute& attribute : mesh_.attributes)
            attribute.values.resize((before + count) * attribute.components, 0);
    }

    std::optional<Error> addRun(const Attributes& from, const GltfValue& mesh, const GltfValue& primitive, const GltfDraw& draw) {
        const std::size_t count = from.positions.size() / 3;
        MotionRun run{.node = *draw.node, .meshName = mesh.text("name"), .firstVertex = mesh_.positions.size(), .count = count};
        run.hasNormals = !from.normals.empty();
        run.hasTangents = !from.tangents.empty();
        const auto floats = [&](const std::string& name) -> Result<std::vector<float>> {
            auto values = valuesOf(primitive, name, 4);
            if (!values) return values.error();
            return std::move(values->numbers);
        };
        if (auto error = readRun(document_, mesh, primitive, floats, *motion_, run, mesh_)) return error;
        motion_->runs.push_back(std::move(run));
        for (std::size_t i = 0; i < count; ++i) {
            const auto at = [&](const std::vector<float>& list, std::size_t width, std::size_t c) {
                return list.empty() ? 0.0f : list[width * i + c];
            };
            const auto vector = [&](const std::vector<float>& list, std::size_t width) {
                return glm::vec3(at(list, width, 0), at(list, width, 1), at(list, width, 2));
            };
            motion_->positions.push_back(vector(from.positions, 3));
            motion_->normals.push_back(vector(from.normals, 3));
            motion_->tangents.emplace_back(vector(from.tangents, 4), at(from.tangents, 4, 3));
            mesh_.motionVertices.push_back(static_cast<std::uint32_t>(motion_->positions.size() - 1));
        }
        return std::nullopt;
    }

    std::optional<Error> addVertices(const Attributes& from, const Carrier& ofNode, const GltfValue& primitive) {
        const std::size_t count = from.positions.size() / 3;
        allNormals_ = allNormals_ && !from.normals.empty();
        allTangents_ = allTangents_ && !from.tangents.empty();
        for (std::size_t i = 0; i < count; ++i) {
            const Carrier carrier = shape_ ? shape_->carrier(static_cast<std::uint32_t>(mesh_.positions.size())) : ofNode;
            const glm::dvec4 local(morphed(&from.positions[3 * i], &MorphTarget::positions), 1);
            const glm::vec3 position = glm::vec3(glm::dvec3(carrier.matrix * local));
            if (!source_.keepNotFinite && !isFinite(position))
                return notFinite(source_.whole(), fmt::format("{}: vertex {} is not finite", primitive.path(), i));
            addDirections(from, i, carrier);
            mesh_.positions.push_back(position);
            if (moved_) exact_.push_back(carrier.linear * glm::dvec3(local) + (glm::dvec3(carrier.matrix[3]) - exactFrom_));
            mesh_.uvs.push_back(from.uvs.empty() ? glm::vec2(0) : glm::vec2(from.uvs[2 * i], from.uvs[2 * i + 1]));
        }
        withoutUvs_ += from.uvs.empty() ? count : 0;
        addRest(from, mesh_.positions.size() - count, count);
        return std::nullopt;
    }

    /// Of the vertex that comes next.
    [[nodiscard]] glm::dvec3 morphed(const float* v, std::vector<glm::vec3> MorphTarget::*list) const {
        const glm::dvec3 own(v[0], v[1], v[2]);
        return shape_ ? shape_->morphed(static_cast<std::uint32_t>(mesh_.positions.size()), own, list) : own;
    }

    void addDirections(const Attributes& from, std::size_t i, const Carrier& carrier) {
        if (allNormals_)
            mesh_.normals.push_back(carrier.direction(carrier.normals, glm::vec3(morphed(&from.normals[3 * i], &MorphTarget::normals))));
        if (!allTangents_) return;
        const glm::vec3 tangent(morphed(&from.tangents[4 * i], &MorphTarget::tangents));
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
            if (auto error = source_.carryMaterials ? std::nullopt : textures_.add(materials[*index], mesh_)) return error;
        } else {
            textures_.addPlain();
        }
        mesh_.parts.push_back({.name = name.empty() ? meshName : name,
                               .firstIndex = first,
                               .indexCount = static_cast<std::uint32_t>(mesh_.indices.size()) - first});
        if (source_.carryMaterials) mesh_.parts.back().material = material;
        return readClusters(primitive["extras"]["tegument"], mesh_.parts.back());
    }

    /// Of our own files (meshprep/write): how many indices each has. Their balls and cones are made anew, in whatever place the mesh has.
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
    std::shared_ptr<Motion> motion_; // and its default pose
    MotionState rest_;
    std::optional<MotionShape> shape_;
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

Result<std::vector<GltfPlace>> gltfPlaces(const GltfDocument& document, Mesh& warnings) {
    const auto draws = drawsOf(document, warnings);
    if (!draws) return draws.error();
    std::vector<GltfPlace> places;
    for (const GltfDraw& draw : *draws)
        places.push_back({.mesh = draw.mesh, .matrix = draw.carrier.matrix});
    return places;
}

Result<ReadMesh> readGltf(const Source& source) {
    const auto document = GltfDocument::open(source);
    if (!document) return document.error();
    return SceneReader(**document).read();
}

} // namespace tegument::meshfile
