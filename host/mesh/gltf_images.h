#pragma once
// Inside host/mesh only: the textures that a glTF material names.

#include "host/mesh/gltf_document.h"

#include <map>

namespace tegument::meshfile {

/// Collects the textures of the materials that are drawn, one per role: "color" (baseColorTexture), "normal" (normalTexture), and whatever
/// the material's `extras.tegumentTextures` names as {"role": texture index}.
class GltfTextures {
public:
    explicit GltfTextures(const GltfDocument& document) : document_(document) {}
    [[nodiscard]] std::optional<Error> add(const GltfValue& material, Mesh& mesh);

private:
    [[nodiscard]] std::optional<Error> addTexture(const std::string& role, std::size_t texture, const GltfValue& from, Mesh& mesh);

    const GltfDocument& document_;
    std::map<std::string, std::size_t> imageOfRole_;
};

/// All materials as they are, with the files of their pictures. A picture that is not there or is none is left out: TG5328, a warning.
[[nodiscard]] MaterialSet carriedMaterials(const GltfDocument& document, Mesh& mesh);

} // namespace tegument::meshfile
