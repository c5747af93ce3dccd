// OBJ with its groups and quads kept. OpenMesh's reader drops both, and the human is found by its groups.

#include "meshprep/human/quad_mesh.h"

#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace tegument {

namespace {

constexpr std::string_view kBlanks = " \t\r";

/// The next word of `rest`, which loses it; empty at the end of the line.
std::string_view takeWord(std::string_view& rest) {
    rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
    const std::string_view word = rest.substr(0, rest.find_first_of(kBlanks));
    rest.remove_prefix(word.size());
    return word;
}

class ObjReader {
public:
    ObjReader(const std::string& file, float unitMm) : unitMm_(unitMm) { at_.file = file; }

    Result<QuadMesh> read(std::string_view text) {
        while (!text.empty()) {
            const std::size_t end = std::min(text.find('\n'), text.size());
            ++at_.line;
            if (auto error = readLine(text.substr(0, end))) return *error;
            text.remove_prefix(std::min(end + 1, text.size()));
        }
        return std::move(mesh_);
    }

private:
    std::optional<Error> readLine(std::string_view line) {
        std::string_view rest = line;
        const std::string_view record = takeWord(rest);
        if (record == "v") return readPosition(rest);
        if (record == "vt") return readUv(rest);
        if (record == "f") return readFace(rest);
        if (record == "g") mesh_.groups.push_back({std::string(trim(rest)), mesh_.quads.size(), 0});
        return std::nullopt;
    }

    std::optional<Error> readPosition(std::string_view rest) {
        glm::vec3 value{};
        for (glm::length_t i = 0; i < 3; ++i)
            if (!readNumber(takeWord(rest), value[i])) return badNumber();
        mesh_.positions.push_back(value * unitMm_);
        return std::nullopt;
    }

    std::optional<Error> readUv(std::string_view rest) {
        glm::vec2 value{};
        for (glm::length_t i = 0; i < 2; ++i)
            if (!readNumber(takeWord(rest), value[i])) return badNumber();
        mesh_.uvs.push_back(value);
        return std::nullopt;
    }

    std::optional<Error> readFace(std::string_view rest) {
        Quad quad;
        for (std::size_t c = 0; c < 4; ++c) {
            const std::string_view corner = takeWord(rest);
            if (corner.empty()) return notQuad();
            const std::size_t slash = corner.find('/');
            if (slash == std::string_view::npos) return notQuad();
            const std::string_view second = corner.substr(slash + 1, corner.find('/', slash + 1) - slash - 1);
            if (!readIndex(corner.substr(0, slash), mesh_.positions.size(), quad.position[c])) return badIndex(corner);
            if (!readIndex(second, mesh_.uvs.size(), quad.uv[c])) return badIndex(corner);
        }
        if (!takeWord(rest).empty()) return notQuad();
        mesh_.quads.push_back(quad);
        if (mesh_.groups.empty()) mesh_.groups.push_back({"", 0, 0});
        ++mesh_.groups.back().count;
        return std::nullopt;
    }

    static bool readNumber(std::string_view word, float& value) {
        const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
        return code == std::errc{} && end == word.data() + word.size() && std::isfinite(value);
    }

    /// OBJ counts from 1.
    static bool readIndex(std::string_view word, std::size_t count, std::uint32_t& index) {
        const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), index);
        if (code != std::errc{} || end != word.data() + word.size() || index < 1 || index > count) return false;
        --index;
        return true;
    }

    [[nodiscard]] Error badNumber() const {
        return inputError(7001, at_, "expected finite numbers after 'v' (three) or 'vt' (two)", "the file is damaged; fetch it again");
    }
    [[nodiscard]] Error notQuad() const {
        return inputError(7002, at_, "a face must have four corners, each position/texture",
                          "subdivision and charts need a mesh of quads with texture coordinates");
    }
    [[nodiscard]] Error badIndex(std::string_view corner) const {
        return inputError(
            7003, at_,
            fmt::format("corner '{}' names a vertex that the file does not have so far ({} positions, {} texture coordinates)", corner,
                        mesh_.positions.size(), mesh_.uvs.size()),
            "the file is damaged; fetch it again");
    }

    float unitMm_;
    SourcePosition at_;
    QuadMesh mesh_;
};

} // namespace

Result<QuadMesh> readQuadObj(std::string_view text, const std::string& file, float unitMm) {
    return ObjReader(file, unitMm).read(text);
}

Result<std::vector<Quad>> quadsOfGroup(const QuadMesh& mesh, std::string_view name, const std::string& file) {
    std::vector<Quad> result;
    std::vector<std::string> names;
    for (const QuadGroup& group : mesh.groups) {
        names.push_back(group.name);
        if (group.name != name) continue;
        const auto first = mesh.quads.begin() + static_cast<std::ptrdiff_t>(group.first);
        result.insert(result.end(), first, first + static_cast<std::ptrdiff_t>(group.count));
    }
    if (!result.empty()) return result;
    return inputError(7004, {.file = file}, fmt::format("there is no face in a group '{}'", name), didYouMean(name, names));
}

} // namespace tegument
