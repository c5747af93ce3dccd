// glTF materials -> textures by role. Images are decoded by host/image, by content.

#include "host/mesh/gltf_images.h"

#include "host/mesh/materials.h"

#include <fmt/format.h>

namespace tegument::meshfile {

namespace {

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

} // namespace

std::optional<Error> GltfTextures::add(const GltfValue& material, Mesh& mesh) {
    const auto addReference = [&](const std::string& role, const GltfValue& reference) -> std::optional<Error> {
        const auto index = reference.whole("index", SIZE_MAX, {});
        if (!index) return index.error();
        // One set of coordinates is drawn with: the colour map's (read_gltf.cpp).
        const GltfValue base = material["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"];
        if (reference["extensions"]["KHR_texture_transform"].json() != base.json())
            warn(mesh, 5323, document_.source().whole(),
                 reference.path() + ": its KHR_texture_transform is not the colour map's, and is ignored");
        return addTexture(role, *index, reference, mesh);
    };
    const GltfValue surface = material["pbrMetallicRoughness"];
    if (surface.has("baseColorTexture"))
        if (auto error = addReference("color", surface["baseColorTexture"])) return error;
    if (material.has("normalTexture"))
        if (auto error = addReference("normal", material["normalTexture"])) return error;
    const GltfValue own = material["extras"]["tegumentTextures"];
    if (!own.json().is_object()) return std::nullopt;
    for (const auto& [role, texture] : own.json().items()) {
        const auto index = own.whole(role.c_str(), SIZE_MAX, {});
        if (!index) return index.error();
        if (auto error = addTexture(role, *index, own, mesh)) return error;
    }
    return std::nullopt;
}

std::optional<Error> GltfTextures::addTexture(const std::string& role, std::size_t texture, const GltfValue& from, Mesh& mesh) {
    const GltfValue textures = document_.root()["textures"];
    if (texture >= textures.size()) return from.wrong(fmt::format("names texture {} of {}", texture, textures.size()));
    const auto image = textures[texture].whole("source", SIZE_MAX, {});
    if (!image) { // an extension names it, in a form that is not read
        warn(mesh, 5328, document_.source().whole(), fmt::format("the '{}' texture is left out: it is no PNG or JPEG file", role),
             "export the textures as PNG or JPEG");
        return std::nullopt;
    }
    const auto [known, isNew] = imageOfRole_.emplace(role, *image);
    if (!isNew) {
        if (known->second != *image)
            warn(mesh, 5326, document_.source().whole(),
                 fmt::format("{}: a second '{}' texture is ignored: one mesh carries one of each role", from.path(), role),
                 "name the texture in the workspace, or split the mesh");
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
    mesh.textures.push_back({.role = role, .image = std::move(*loaded)});
    return std::nullopt;
}

MaterialSet carriedMaterials(const GltfDocument& document, Mesh& mesh) {
    const GltfValue root = document.root();
    MaterialSet set;
    if (root["materials"].size() == 0) return set;
    Json json = Json::object();
    for (const char* list : {"materials", "samplers", "textures"})
        if (root[list].size() > 0) json[list] = root[list].json();
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

} // namespace tegument::meshfile
