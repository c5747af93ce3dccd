// The colour map of an OBJ file: what the materials of its libraries name as map_Kd.

#include "host/mesh/mesh_file.h"
#include "host/mesh/obj_file.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <map>

namespace tegument::meshfile {

namespace {

namespace fs = std::filesystem;

/// Material to file.
std::map<std::string, fs::path> colourMaps(const Source& source, const fs::path& library, Mesh& mesh) {
    std::map<std::string, fs::path> maps;
    const auto text = readNamed(source, library);
    if (!text) {
        const Diagnostic& why = text.error().diagnostics.front(); // scans often travel without: no warning
        if (why.code == kOutside) warn(mesh, 5328, source.whole(), "its material library is left out: " + why.text, why.hint);
        return maps;
    }
    std::string material;
    for (std::string_view left = withoutMark(*text); !left.empty();) {
        const std::size_t end = std::min(left.find_first_of("\r\n"), left.size());
        std::string_view line = trim(left.substr(0, end));
        left.remove_prefix(std::min(end + 1, left.size()));
        const std::string keyword = toLower(std::string(nextWord(line)));
        if (keyword == "newmtl") material = trim(line);
        if (keyword == "map_kd" && !objPictureName(line).empty())
            maps.emplace(material, objFileIn(library.parent_path(), objPictureName(line)));
    }
    return maps;
}

constexpr std::string_view kTileMark = "<UDIM>";

/// Painters of skin spread a head over squares of the plane, each with a picture of its own: 1001 is the unit square, 1002 the one to its
/// right, 1011 the one above. Those in use become one picture, side by side.
void useTiles(const Source& source, const std::string& pattern, Mesh& mesh) {
    std::vector<glm::ivec2> tileOf(mesh.uvs.size());
    std::map<int, std::string> pictures;
    const auto number = [](const glm::ivec2& tile) { return 1001 + tile.x + 10 * tile.y; };
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::uint32_t* t = &mesh.indices[i];
        const glm::vec2 middle = (mesh.uvs[t[0]] + mesh.uvs[t[1]] + mesh.uvs[t[2]]) / 3.0F;
        constexpr float kMost = 9; // by ten tiles; in height as many
        const glm::ivec2 tile(glm::clamp(glm::floor(glm::vec2(middle.x, 1 - middle.y)), 0.0F, kMost));
        for (int corner = 0; corner < 3; ++corner)
            tileOf[t[corner]] = tile;
        std::string& picture = pictures[number(tile)];
        if (picture.empty())
            picture = std::string(pattern).replace(pattern.find(kTileMark), kTileMark.size(), std::to_string(number(tile)));
    }
    std::vector<std::string> names;
    for (const auto& [tile, name] : pictures)
        names.push_back(name);
    for (std::size_t v = 0; v < mesh.uvs.size(); ++v) {
        const auto place = std::distance(pictures.begin(), pictures.lower_bound(number(tileOf[v])));
        mesh.uvs[v].x = (mesh.uvs[v].x + static_cast<float>(place - tileOf[v].x)) / static_cast<float>(names.size());
        mesh.uvs[v].y += static_cast<float>(tileOf[v].y);
    }
    useColourSheet(source, names, mesh);
}

} // namespace

bool namesTiles(const Source& source, const ObjFile& file) {
    for (const std::string& library : file.libraries)
        for (const fs::path& path : objLibrariesIn(source.path.parent_path(), library))
            if (const auto text = readNamed(source, path); text && text->find(kTileMark) != std::string::npos) return true;
    return false;
}

void addObjTextures(const Source& source, const ObjFile& file, Mesh& mesh) {
    std::map<std::string, fs::path> maps;
    for (const std::string& library : file.libraries)
        for (const fs::path& path : objLibrariesIn(source.path.parent_path(), library))
            maps.merge(colourMaps(source, path, mesh));
    fs::path used;
    for (std::size_t i = 0; i < file.sections.size(); ++i) {
        const auto map = maps.find(file.sections[i].material);
        if (map == maps.end() || file.endOf(i) == file.sections[i].firstFace || map->second == used) continue;
        if (!used.empty()) {
            warn(mesh, 5326, source.whole(),
                 fmt::format("material '{}': a second colour map is ignored: one mesh carries one", map->first.substr(0, 40)),
                 "name the texture in the workspace, or split the mesh");
            break;
        }
        used = map->second;
    }
    if (used.string().find(kTileMark) != std::string::npos)
        useTiles(source, used.lexically_relative(source.path.parent_path()).string(), mesh);
    else if (!used.empty())
        useColourMap(source, used, mesh);
}

namespace {

std::optional<Image> colourMap(const Source& source, const fs::path& file, Mesh& mesh) {
    const auto bytes = readNamed(source, file);
    auto image = bytes ? decodeImage(std::as_bytes(std::span(*bytes)), file.string()) : Result<Image>(bytes.error());
    if (image) return std::move(*image);
    const Diagnostic& why = image.error().diagnostics.front();
    warn(mesh, 5328, source.whole(),
         fmt::format("its colour map '{}' {}: {}", file.filename().string(), why.code == kOutside ? "is left out" : "is not there",
                     why.text),
         hintFor(image.error(), "put the pictures of a mesh beside it, or give one: --set gSkinMap=FILE"));
    return std::nullopt;
}

} // namespace

void useColourMap(const Source& source, const fs::path& used, Mesh& mesh) {
    if (auto image = colourMap(source, used, mesh)) mesh.textures.push_back({.role = "color", .image = std::move(*image)});
}

void useColourSheet(const Source& source, const std::vector<std::string>& pictures, Mesh& mesh) {
    std::vector<std::optional<Image>> images;
    Image sheet{.width = 1, .height = 1, .channels = 4, .bitsPerChannel = 8};
    for (const std::string& picture : pictures) {
        images.push_back(colourMap(source, objFileIn(source.path.parent_path(), picture), mesh));
        if (!images.back()) continue;
        sheet.width = std::max(sheet.width, images.back()->width);
        sheet.height = std::max(sheet.height, images.back()->height);
        sheet.bitsPerChannel = std::max(sheet.bitsPerChannel, images.back()->bitsPerChannel);
    }
    constexpr int kMostSide = 16384; // texels of a picture
    const int each = sheet.width = std::min(sheet.width, std::max(kMostSide / static_cast<int>(pictures.size()), 1));
    sheet.width *= static_cast<int>(pictures.size());
    sheet.pixels.assign(static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height) * 4, 1.0F);
    for (std::size_t i = 0; i < images.size(); ++i)
        for (int y = 0; images[i] && y < sheet.height; ++y)
            for (int x = 0; x < each; ++x)
                for (int c = 0; c < 4; ++c) {
                    const Image& from = *images[i];
                    const int channel = from.channels < 3 ? (c == 3 ? from.channels - 1 : 0) : c; // grey, grey and alpha
                    const bool absent = c == 3 && from.channels % 2 == 1;
                    if (!absent)
                        sheet.at(static_cast<int>(i) * each + x, y, c) =
                            from.at(x * from.width / each, y * from.height / sheet.height, channel);
                }
    mesh.textures.push_back({.role = "color", .image = std::move(sheet)});
}

} // namespace tegument::meshfile
