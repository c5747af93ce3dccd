// glTF materials -> textures by role. Images are decoded by host/image, by content.

#include "host/mesh/gltf_images.h"

#include <fmt/format.h>

namespace tegument::meshfile {

std::optional<Error> GltfTextures::add(const GltfValue& material, Mesh& mesh) {
    const auto addReference = [&](const std::string& role, const GltfValue& reference) -> std::optional<Error> {
        const auto index = reference.whole("index", SIZE_MAX, {});
        if (!index) return index.error();
        if (reference.has("extensions") && reference["extensions"].has("KHR_texture_transform"))
            warn(mesh, 5323, document_.root().source().whole(), reference.path() + ": KHR_texture_transform is ignored");
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
    if (!image) return image.error();
    const auto [known, isNew] = imageOfRole_.emplace(role, *image);
    if (!isNew) {
        if (known->second != *image)
            warn(mesh, 5326, document_.root().source().whole(),
                 fmt::format("{}: a second '{}' texture is ignored: one mesh carries one of each role", from.path(), role),
                 "name the texture in the workspace, or split the mesh");
        return std::nullopt;
    }
    auto loaded = load(*image);
    if (!loaded) return loaded.error();
    mesh.textures.push_back({.role = role, .image = std::move(*loaded)});
    return std::nullopt;
}

Result<Image> GltfTextures::load(std::size_t image) const {
    const GltfValue images = document_.root()["images"];
    const Source& source = images.source();
    if (image >= images.size()) return malformed(source.whole(), fmt::format("images[{}] does not exist", image));
    const GltfValue value = images[image];
    const std::string name = fmt::format("{}#images[{}]", source.name(), image);
    if (value.has("bufferView")) {
        const auto index = value.whole("bufferView", SIZE_MAX, {});
        if (!index) return index.error();
        const auto bytes = document_.view(*index);
        if (!bytes) return bytes.error();
        return decodeImage(std::as_bytes(std::span(*bytes)), name);
    }
    const std::string uri = value.text("uri");
    const auto bytes = document_.resolveUri(value, uri);
    if (!bytes) return bytes.error();
    return decodeImage(std::as_bytes(std::span(*bytes)), uri.starts_with("data:") ? name : uri);
}

} // namespace tegument::meshfile
