#pragma once
// What a glb says about itself, for tests; and small glTF files as text.

#include "host/support/file.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace tegument::testing_prep {

using Json = nlohmann::json;

inline std::uint32_t wordAt(const std::string& bytes, std::size_t at) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}

inline Json jsonOf(const std::filesystem::path& glb) {
    const auto bytes = readFile(glb);
    if (!bytes || bytes->size() < 20) return {};
    return Json::parse(bytes->substr(20, wordAt(*bytes, 12)));
}

/// The bytes of a buffer view.
inline std::string viewOf(const std::filesystem::path& glb, std::size_t view) {
    const auto bytes = readFile(glb);
    if (!bytes) return {};
    const std::size_t binary = 20 + wordAt(*bytes, 12) + 8;
    const Json json = jsonOf(glb);
    return bytes->substr(binary + json["bufferViews"][view]["byteOffset"].get<std::size_t>(),
                         json["bufferViews"][view]["byteLength"].get<std::size_t>());
}

/// A glTF file in the making: views of one buffer, padded to 4 bytes.
class GltfText {
public:
    template <class T>
    std::size_t addView(const std::vector<T>& values) {
        return addBytes({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
    }
    std::size_t addBytes(const std::string& bytes) {
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}});
        binary += bytes;
        binary.resize((binary.size() + 3) / 4 * 4, '\0');
        return json["bufferViews"].size() - 1;
    }
    template <class T>
    std::size_t addAccessor(const std::vector<T>& values, int componentType, const char* type, std::size_t components) {
        json["accessors"].push_back(
            {{"bufferView", addView(values)}, {"componentType", componentType}, {"count", values.size() / components}, {"type", type}});
        return json["accessors"].size() - 1;
    }
    [[nodiscard]] std::string glb() const {
        Json whole = json;
        whole["asset"] = {{"version", "2.0"}};
        if (!binary.empty()) whole["buffers"][0]["byteLength"] = binary.size();
        std::string text = whole.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::string bytes = "glTF";
        const auto word = [&](std::size_t value) {
            const auto w = static_cast<std::uint32_t>(value);
            bytes.append(reinterpret_cast<const char*>(&w), 4);
        };
        word(2);
        word(12 + 8 + text.size() + 8 + binary.size());
        word(text.size());
        bytes += "JSON" + text;
        word(binary.size());
        return bytes + std::string("BIN\0", 4) + binary;
    }

    Json json;
    std::string binary;
};

/// A tetrahedron of 10 mm as one primitive of one node.
inline GltfText tetrahedron() {
    GltfText gltf;
    const auto position = gltf.addAccessor<float>({0, 0, 0, 10, 0, 0, 0, 10, 0, 0, 0, 10}, 5126, "VEC3", 3);
    const auto index = gltf.addAccessor<std::uint16_t>({0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}, 5123, "SCALAR", 1);
    gltf.json["meshes"] =
        Json::array({{{"name", "tetra"}, {"primitives", Json::array({{{"attributes", {{"POSITION", position}}}, {"indices", index}}})}}});
    gltf.json["nodes"] = Json::array({{{"mesh", 0}}});
    gltf.json["scenes"] = Json::array({{{"nodes", {0}}}});
    return gltf;
}

} // namespace tegument::testing_prep
