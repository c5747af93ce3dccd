#include "host/mesh/gltf_losses.h"

#include <fmt/format.h>

#include <set>

namespace tegument::meshfile {

namespace {

class Losses {
public:
    Losses(const GltfDocument& document, Mesh& mesh) : root_(document.root()), mesh_(mesh) {}

    void tell(std::size_t count, std::string_view what, std::string hint = {}) {
        if (count > 0) warn(mesh_, 5331, root_.source().whole(), fmt::format("{} {}", count, what), std::move(hint));
    }

    void ofMeshes(const std::vector<std::size_t>& meshes) {
        const std::set<std::size_t> used(meshes.begin(), meshes.end());
        std::size_t targets = 0;
        std::size_t weighted = 0;
        std::size_t variants = 0;
        for (const std::size_t index : used) {
            const GltfValue primitives = root_["meshes"][index]["primitives"];
            for (std::size_t i = 0; i < primitives.size(); ++i) {
                targets += primitives[i]["targets"].size();
                weighted += primitives[i]["attributes"].has("JOINTS_0");
                variants += primitives[i]["extensions"].has("KHR_materials_variants");
            }
        }
        tell(targets, "morph targets are left out: the mesh is as it was modelled", "export the shape that is wanted");
        tell(weighted, "primitives lose the joints and weights of their skin: the mesh is as it was modelled",
             "export the pose that is wanted");
        tell(variants, "primitives lose their other materials (KHR_materials_variants)");
        tell(meshes.size() - used.size(), "copies of meshes that several nodes or instances draw become triangles of their own");
    }

    void ofScene() {
        tell(root_["animations"].size(), "animations are left out");
        tell(root_["cameras"].size(), "cameras are left out");
        tell(root_["extensions"]["KHR_lights_punctual"]["lights"].size(), "lights are left out");
        if (root_["scenes"].size() > 1) tell(root_["scenes"].size() - 1, "scenes besides the default one are left out");
    }

private:
    GltfValue root_;
    Mesh& mesh_;
};

} // namespace

void warnOfLosses(const GltfDocument& document, const std::vector<std::size_t>& meshes, Mesh& mesh) {
    Losses losses(document, mesh);
    losses.ofMeshes(meshes);
    losses.ofScene();
}

} // namespace tegument::meshfile
