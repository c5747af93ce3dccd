#include "host/mesh/materials.h"

#include <nlohmann/json.hpp>

namespace tegument {

namespace {

using Json = nlohmann::ordered_json;

/// Every "...Texture" that is an object with an index, wherever an extension puts it.
void strip(Json& value) {
    if (value.is_array())
        for (Json& item : value)
            strip(item);
    if (!value.is_object()) return;
    for (auto it = value.begin(); it != value.end();) {
        const bool reference = it.key().ends_with("Texture") && it.value().is_object() && it.value().contains("index");
        if (!reference) strip(it.value());
        it = reference || it.key() == "tegumentTextures" ? value.erase(it) : std::next(it);
    }
}

} // namespace

std::size_t dropTextures(MaterialSet& materials) {
    const std::size_t pictures = materials.images.size();
    materials.images.clear();
    if (materials.json.empty()) return 0;
    Json json = Json::parse(materials.json);
    for (const char* list : {"textures", "samplers", "images"})
        json.erase(list);
    strip(json);
    materials.json = json.dump();
    return pictures;
}

std::string_view pictureType(std::string_view bytes) {
    using namespace std::string_view_literals;
    const auto endsWith = [&](std::string_view mark) { return bytes.rfind(mark) != std::string_view::npos; };
    if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv)) return endsWith("IEND\xae\x42\x60\x82"sv) ? "image/png"sv : ""sv;
    if (bytes.starts_with("\xff\xd8\xff"sv)) return endsWith("\xff\xd9"sv) ? "image/jpeg"sv : ""sv;
    if (bytes.starts_with("RIFF"sv) && bytes.substr(8).starts_with("WEBP"sv)) return "image/webp"sv;
    if (bytes.starts_with("\xabKTX 20\xbb"sv)) return "image/ktx2"sv;
    return bytes.starts_with("DDS "sv) ? "image/vnd-ms.dds"sv : ""sv;
}

} // namespace tegument
