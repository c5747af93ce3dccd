// The materials of an OBJ file's libraries as glTF has them (Wavefront's MTL, and the statements for physical shading that exporters
// added).

#include "host/image/image.h"
#include "host/mesh/materials.h"
#include "host/mesh/mesh_file.h"
#include "host/mesh/obj_file.h"
#include "host/support/text.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace tegument::meshfile {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Material {
    std::map<std::string, std::string> statements; // by keyword in small letters
    fs::path folder;
};

class Library {
public:
    Library(const Source& source, Mesh& mesh) : source_(source), mesh_(mesh) {}

    void read(const std::string& name) {
        for (const fs::path& path : objLibrariesIn(source_.path.parent_path(), name))
            read(path, name);
    }

    void read(const fs::path& path, const std::string& name) {
        const auto text = readNamed(source_, path);
        if (!text) {
            const Diagnostic& why = text.error().diagnostics.front();
            warn(mesh_, 5328, source_.whole(),
                 fmt::format("the material library '{}' is {}", name.substr(0, 80),
                             why.code == kOutside ? "left out: " + why.text : "not there"),
                 hintFor(text.error(), "put the library and its pictures beside the OBJ file"));
            return;
        }
        Material* material = nullptr;
        for (std::string_view left = withoutMark(*text); !left.empty();) {
            const std::size_t end = std::min(left.find_first_of("\r\n"), left.size());
            std::string_view line = trim(left.substr(0, end));
            left.remove_prefix(std::min(end + 1, left.size()));
            if (line.starts_with('#')) continue;
            const std::string keyword = toLower(std::string(nextWord(line)));
            if (keyword == "newmtl") {
                material = &materials_[std::string(trim(line))];
                material->folder = path.parent_path();
            } else if (material && !keyword.empty()) {
                material->statements.emplace(keyword, trim(line));
            }
        }
    }

    /// A material that is a picture, and nothing else.
    void add(const std::string& name, const std::string& picture) {
        materials_[name] = {.statements = {{"map_kd", picture}}, .folder = source_.path.parent_path()};
    }

    /// Its number among the materials that are written; none for one that no library has.
    std::optional<std::uint32_t> use(const std::string& name) {
        const auto found = materials_.find(name);
        if (found == materials_.end()) return std::nullopt;
        const auto [entry, isNew] = numbers_.emplace(name, static_cast<std::uint32_t>(numbers_.size()));
        if (isNew) {
            Json material = written(name, found->second); // which may add lists to json_, and move them
            json_["materials"].push_back(std::move(material));
        }
        return entry->second;
    }

    void finish() {
        if (json_.contains("materials")) mesh_.materials.json = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
        if (left_.empty()) return;
        warn(mesh_, 5331, source_.whole(),
             fmt::format("what glTF has no place for is left out of the materials: {}", fmt::join(left_, ", ")),
             "glTF takes Kd, d, Tr, Ke, Ns, Pr, Pm, map_Kd, map_Ke and norm");
    }

private:
    Json written(const std::string& name, const Material& from) {
        const auto number = [&](const char* key, double absent) {
            const auto found = from.statements.find(key);
            std::string_view text = found == from.statements.end() ? std::string_view() : std::string_view(found->second);
            double value = absent;
            return parseReal(nextWord(text), value) && std::isfinite(value) ? value : absent;
        };
        const std::array<double, 3> diffuse = threeOf(from, "kd", 1);
        const double opacity =
            std::clamp(from.statements.contains("tr") && !from.statements.contains("d") ? 1 - number("tr", 0) : number("d", 1), 0.0, 1.0);
        Json surface = {{"metallicFactor", std::clamp(number("pm", 0), 0.0, 1.0)},
                        {"roughnessFactor", std::clamp(number("pr", std::sqrt(2 / (std::max(number("ns", 0), 0.0) + 2))), 0.0, 1.0)}};
        surface["baseColorFactor"] = {diffuse[0], diffuse[1], diffuse[2], opacity};
        Json material = {{"name", name}};
        if (!mesh_.uvs.empty()) addPicture(from, "map_kd", surface["baseColorTexture"]);
        if (surface["baseColorTexture"].is_null())
            surface.erase("baseColorTexture");
        else if (diffuse == std::array<double, 3>{}) // exporters write black where a picture says it all
            surface["baseColorFactor"] = {1, 1, 1, opacity};
        material["pbrMetallicRoughness"] = std::move(surface);
        for (const auto& [key, role] : {std::pair("norm", "normalTexture"), std::pair("map_ke", "emissiveTexture")}) {
            Json texture;
            if (!mesh_.uvs.empty()) addPicture(from, key, texture);
            if (!texture.is_null()) material[role] = std::move(texture);
        }
        const std::array<double, 3> emitted = threeOf(from, "ke", material.contains("emissiveTexture") ? 1 : 0);
        if (emitted != std::array<double, 3>{}) material["emissiveFactor"] = emitted;
        if (opacity < 1) material["alphaMode"] = "BLEND";
        static const std::set<std::string> kRead = {"kd", "d", "tr", "ke", "ns", "pr", "pm", "map_kd", "map_ke", "norm"};
        for (const auto& [keyword, unused] : from.statements)
            if (!kRead.contains(keyword)) left_.insert(keyword.substr(0, 40));
        return material;
    }

    static std::array<double, 3> threeOf(const Material& from, const char* key, double absent) {
        std::array<double, 3> values = {absent, absent, absent};
        const auto found = from.statements.find(key);
        if (found == from.statements.end()) return values;
        std::string_view text = found->second;
        for (double& value : values) {
            double read = 0;
            value = parseReal(nextWord(text), read) && std::isfinite(read) ? std::clamp(read, 0.0, 1.0) : value;
        }
        return values;
    }

    void addPicture(const Material& from, const char* key, Json& texture) {
        const auto found = from.statements.find(key);
        if (found == from.statements.end() || objPictureName(found->second).empty()) return;
        const fs::path path = objFileIn(from.folder, objPictureName(found->second));
        const auto [entry, isNew] = pictures_.emplace(path, std::nullopt);
        if (isNew) entry->second = load(path, key);
        if (entry->second) texture = {{"index", *entry->second}};
    }

    /// As it is where glTF takes it; else as PNG.
    std::optional<std::size_t> load(const fs::path& path, const char* key) {
        auto bytes = readNamed(source_, path);
        std::string why = bytes ? "" : bytes.error().diagnostics.front().text;
        constexpr const char* kBeside = "put the pictures of a mesh beside it, as PNG or JPEG";
        const std::string hint = bytes ? kBeside : hintFor(bytes.error(), kBeside);
        std::string_view type = bytes ? pictureType(*bytes) : "";
        if (bytes && type != "image/png" && type != "image/jpeg") {
            const auto image = decodeImage(std::as_bytes(std::span(*bytes)), path.string());
            Result<std::string> png = image ? encodePng(*image, PngEncoding::Raw) : Result<std::string>(image.error());
            if (!png) why = png.error().diagnostics.front().text;
            type = png ? "image/png" : "";
            bytes = std::move(png);
        }
        if (type.empty()) {
            warn(mesh_, 5328, source_.whole(), fmt::format("a picture of {}, '{}', is left out: {}", key, path.filename().string(), why),
                 hint);
            return std::nullopt;
        }
        const std::size_t index = mesh_.materials.images.size();
        json_["images"].push_back({{"name", path.filename().string()}, {"mimeType", type}});
        json_["textures"].push_back(Json::object());
        json_["textures"].back()["source"] = index;
        mesh_.materials.images.push_back(std::move(*bytes));
        return index;
    }

    const Source& source_;
    Mesh& mesh_;
    std::map<std::string, Material> materials_;
    std::map<std::string, std::uint32_t> numbers_;
    std::map<fs::path, std::optional<std::size_t>> pictures_;
    std::set<std::string> left_;
    Json json_;
};

} // namespace

void carryObjMaterials(const Source& source, const ObjFile& file, const std::vector<std::string>& names, Mesh& mesh) {
    Library library(source, mesh);
    for (const std::string& name : std::set(file.libraries.begin(), file.libraries.end()))
        library.read(name);
    for (std::size_t i = 0; i < names.size() && i < mesh.parts.size(); ++i)
        if (!names[i].empty()) mesh.parts[i].material = library.use(names[i]);
    library.finish();
}

void carryColourMap(const Source& source, const std::string& picture, Mesh& mesh) {
    Library library(source, mesh);
    library.add("texture", picture);
    for (MeshPart& part : mesh.parts)
        part.material = library.use("texture");
    library.finish();
}

} // namespace tegument::meshfile
