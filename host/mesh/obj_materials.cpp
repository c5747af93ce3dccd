// The colour map of an OBJ file: what the materials of its libraries name as map_Kd.

#include "host/mesh/mesh_file.h"
#include "host/mesh/obj_file.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace tegument::meshfile {

namespace {

namespace fs = std::filesystem;

struct ObjColour {
    fs::path map; // map_Kd
    glm::vec3 diffuse{1};
};

/// By the material's name.
std::map<std::string, ObjColour> coloursIn(const Source& source, const fs::path& library, Mesh& mesh) {
    std::map<std::string, ObjColour> colours;
    const auto text = readNamed(source, library);
    if (!text) {
        const Diagnostic& why = text.error().diagnostics.front(); // scans often travel without: no warning
        if (why.code == kOutside) warn(mesh, 5328, source.whole(), "its material library is left out: " + why.text, why.hint);
        return colours;
    }
    std::string material;
    for (std::string_view left = withoutMark(*text); !left.empty();) {
        const std::size_t end = std::min(left.find_first_of("\r\n"), left.size());
        std::string_view line = trim(left.substr(0, end));
        left.remove_prefix(std::min(end + 1, left.size()));
        const std::string keyword = toLower(std::string(nextWord(line)));
        if (keyword == "newmtl") material = trim(line);
        ObjColour& colour = colours[material];
        if (keyword == "map_kd" && !objPictureName(line).empty() && colour.map.empty())
            colour.map = objFileIn(library.parent_path(), objPictureName(line));
        if (keyword == "kd")
            for (glm::length_t c = 0; c < 3; ++c)
                if (double number = 0; parseReal(nextWord(line), number))
                    colour.diffuse[c] = std::clamp(static_cast<float>(number), 0.0F, 1.0F);
    }
    return colours;
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

/// Whether the parts have several colours, of which one at least is a picture: then they are laid out in a sheet.
bool useColoursOfParts(const Source& source, const std::map<std::string, ObjColour>& colours, ReadMesh& read) {
    std::vector<ObjColour> each;
    std::vector<std::size_t> ofPart;
    for (const std::string& name : read.materialNames) {
        const auto found = colours.find(name);
        ObjColour colour = found == colours.end() ? ObjColour() : found->second;
        if (!colour.map.empty()) colour.diffuse = glm::vec3(1); // exporters write any colour beside a map
        const auto known =
            std::ranges::find_if(each, [&](const ObjColour& other) { return other.map == colour.map && other.diffuse == colour.diffuse; });
        ofPart.push_back(static_cast<std::size_t>(known - each.begin()));
        if (known == each.end()) each.push_back(std::move(colour));
    }
    const auto isTiled = [](const ObjColour& colour) { return colour.map.string().find(kTileMark) != std::string::npos; };
    if (each.size() < 2 || source.ownCoordinates || std::ranges::any_of(each, isTiled)) return false;
    std::vector<DrawnMaterial> materials;
    for (const ObjColour& colour : each) {
        materials.push_back({.factor = colour.diffuse});
        if (!colour.map.empty()) materials.back().colour = colourMap(source, colour.map, read.mesh);
    }
    return std::ranges::any_of(materials, &DrawnMaterial::hasPicture) && layOutMaterials(materials, ofPart, read);
}

} // namespace

bool namesTiles(const Source& source, const ObjFile& file) {
    for (const std::string& library : file.libraries)
        for (const fs::path& path : objLibrariesIn(source.path.parent_path(), library))
            if (const auto text = readNamed(source, path); text && text->find(kTileMark) != std::string::npos) return true;
    return false;
}

void addObjTextures(const Source& source, const ObjFile& file, ReadMesh& read) {
    Mesh& mesh = read.mesh;
    std::map<std::string, ObjColour> colours;
    for (const std::string& library : file.libraries)
        for (const fs::path& path : objLibrariesIn(source.path.parent_path(), library))
            colours.merge(coloursIn(source, path, mesh));
    if (useColoursOfParts(source, colours, read)) return;
    fs::path used;
    for (const std::string& name : read.materialNames) {
        const auto colour = colours.find(name);
        if (colour == colours.end() || colour->second.map.empty() || colour->second.map == used) continue;
        if (!used.empty()) {
            warn(mesh, 5326, source.whole(),
                 fmt::format("material '{}': a second colour map is ignored: one mesh carries one", name.substr(0, 40)),
                 "name the texture in the workspace, or split the mesh");
            break;
        }
        used = colour->second.map;
    }
    if (used.string().find(kTileMark) != std::string::npos)
        useTiles(source, used.lexically_relative(source.path.parent_path()).string(), mesh);
    else if (!used.empty())
        useColourMap(source, used, mesh);
}

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
    const int each = sheet.width = std::min(sheet.width, std::max(kMostPictureSide / static_cast<int>(pictures.size()), 1));
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
