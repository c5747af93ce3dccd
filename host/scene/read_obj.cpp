// Wavefront OBJ: polygons with texture coordinates and normals, groups, objects and materials as parts. One vertex per distinct triple of
// indices.

#include "host/scene/polygons.h"
#include "host/scene/welding.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <memory>

namespace tegument::meshfile {

namespace {

constexpr std::uint32_t kNone = UINT32_MAX; // a corner names no texture coordinate or normal; any other number is an index from 0

struct Corner {
    std::uint32_t position = kNone;
    std::uint32_t uv = kNone;
    std::uint32_t normal = kNone;
    bool operator==(const Corner&) const = default;
};

/// A distinct corner and the line that names it first.
struct Vertex {
    Corner corner;
    int line = 0;
};

struct Part {
    std::string name;
    std::vector<std::uint32_t> indices; // of vertices
    Polygons polygons;
};

std::string_view nextWord(std::string_view& line) {
    line = trim(line);
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    const std::string_view word = line.substr(0, end);
    line.remove_prefix(end);
    return word;
}

template <class Number>
bool parseWhole(std::string_view word, Number& number) {
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto parsed = std::from_chars(word.data(), word.data() + word.size(), number);
    return parsed.ec == std::errc() && parsed.ptr == word.data() + word.size() && !word.empty();
}

/// Statements that describe something other than polygons, and are passed over in silence.
bool isIgnored(std::string_view keyword) {
    static constexpr std::array<std::string_view, 12> kIgnored = {"s",      "mtllib", "l",          "p",         "vp",    "maplib",
                                                                  "usemap", "lod",    "shadow_obj", "trace_obj", "bevel", "mg"};
    return std::ranges::find(kIgnored, keyword) != kIgnored.end();
}

class ObjReader {
public:
    explicit ObjReader(const Source& source) : source_(source) {}

    Result<ReadMesh> read() {
        if (source_.bytes.starts_with("\xff\xfe") || source_.bytes.starts_with("\xfe\xff"))
            return malformed(source_.atByte(0), "the OBJ file is UTF-16", "save it as UTF-8 or ASCII");
        std::string_view left = source_.bytes;
        if (left.starts_with("\xef\xbb\xbf")) left.remove_prefix(3);
        while (!left.empty() && !error_)
            readStatement(takeLine(left));
        if (error_) return *error_;
        return build();
    }

private:
    /// One logical line: a backslash at the end joins the next line.
    std::string_view takeLine(std::string_view& left) {
        joined_.clear();
        while (true) {
            ++line_;
            const std::size_t end = std::min(left.find('\n'), left.size());
            std::string_view line = left.substr(0, end);
            left.remove_prefix(std::min(end + 1, left.size()));
            if (line.ends_with('\r')) line.remove_suffix(1);
            const bool continued = line.ends_with('\\') && !left.empty();
            if (joined_.empty() && !continued) return line;
            if (continued) line.remove_suffix(1);
            joined_.append(line).push_back(' ');
            if (!continued) return joined_;
        }
    }

    void readStatement(std::string_view line) {
        if (const std::size_t comment = line.find('#'); comment != std::string_view::npos) line = line.substr(0, comment);
        const std::string_view keyword = nextWord(line);
        if (keyword.empty() || isIgnored(keyword)) return;
        if (keyword == "v")
            readPosition(line);
        else if (keyword == "vt")
            readUv(line);
        else if (keyword == "vn")
            readNormal(line);
        else if (keyword == "f")
            readFace(line);
        else if (keyword == "o" || keyword == "g")
            startGroup(keyword, trim(line));
        else if (keyword == "usemtl")
            startMaterial(trim(line));
        else
            unknown_.emplace(std::string(keyword.substr(0, 40)), line_);
        if (positions_.size() > kMaxVertices || indexCount_ > kMaxIndices) fail(tooLarge(here()));
    }

    /// At least `least` numbers, at most the array's size; the rest of the line is not looked at.
    template <std::size_t N>
    std::array<double, N> numbers(std::string_view line, std::size_t least) {
        std::array<double, N> values{};
        for (std::size_t i = 0; i < N && !error_; ++i) {
            const std::string_view word = nextWord(line);
            if (word.empty() && i >= least) break;
            if (!parseReal(word, values[i]))
                fail(word.empty() ? malformed(here(), fmt::format("{} numbers are needed here", least)) : notANumber(here(), word));
        }
        return values;
    }

    void readPosition(std::string_view line) {
        const auto [x, y, z] = numbers<3>(line, 3);
        const glm::vec3 position = scaled({x, y, z}, source_.unitMm);
        if (!source_.keepNotFinite && !isFinite(position)) fail(notFinite(here(), "a coordinate is not finite"));
        positions_.push_back(position);
    }

    void readUv(std::string_view line) {
        const auto [u, v] = numbers<2>(line, 1);
        uvs_.emplace_back(u, 1 - v); // v up in the file, down here
    }

    void readNormal(std::string_view line) {
        const auto [x, y, z] = numbers<3>(line, 3);
        normals_.emplace_back(x, y, z);
    }

    /// "7", "7/2", "7//3", "7/2/3", each from 1, or negative: counted back from the latest. Nothing for a corner that refers to none.
    std::optional<Corner> readCorner(std::string_view word) {
        Corner corner;
        const std::array<std::pair<std::uint32_t*, std::size_t>, 3> fields = {
            {{&corner.position, positions_.size()}, {&corner.uv, uvs_.size()}, {&corner.normal, normals_.size()}}};
        bool usable = true;
        std::string_view left = word;
        for (std::size_t field = 0; field < 3 && !error_; ++field) {
            const std::size_t slash = std::min(left.find('/'), left.size());
            const std::string_view text = left.substr(0, slash);
            left.remove_prefix(std::min(slash + 1, left.size()));
            if (text.empty() && field > 0) continue;
            std::int64_t index = 0;
            if (!parseWhole(text, index) || (field == 2 && !left.empty()))
                fail(malformed(here(), fmt::format("'{}' is not a face corner", word.substr(0, 40))));
            else
                usable &= setIndex(*fields[field].first, index, fields[field].second, word);
        }
        return usable ? std::optional(corner) : std::nullopt;
    }

    bool setIndex(std::uint32_t& target, std::int64_t index, std::size_t soFar, std::string_view word) {
        const std::int64_t fromZero = index < 0 ? index + static_cast<std::int64_t>(soFar) : index - 1;
        // what is defined further down is found when everything is read
        const bool possible = fromZero >= 0 && fromZero < static_cast<std::int64_t>(kMaxIndices);
        if (possible) target = static_cast<std::uint32_t>(fromZero);
        if (!possible && !source_.dropBadFaces)
            fail(badIndex(here(), fromZero < 0 ? fmt::format("the corner '{}' refers to an element before the first", word.substr(0, 40))
                                               : fmt::format("the corner '{}' refers to an element behind the last", word.substr(0, 40))));
        return possible;
    }

    void readFace(std::string_view line) {
        corners_.clear();
        bool usable = true;
        for (std::string_view word = nextWord(line); !word.empty() && !error_; word = nextWord(line)) {
            const auto corner = readCorner(word);
            usable &= corner.has_value();
            if (corner) corners_.push_back(vertexOf(*corner));
        }
        if (error_) return;
        ++result_.counts.faces;
        result_.counts.badFaces += !usable;
        if (!usable) return;
        result_.counts.smallFaces += corners_.size() < 3;
        Part& part = currentPart();
        part.polygons.add(corners_, part.indices);
        indexCount_ += corners_.size() < 3 ? 0 : 3 * (corners_.size() - 2);
    }

    std::uint32_t vertexOf(const Corner& corner) {
        const auto next = static_cast<std::uint32_t>(vertices_.size());
        const auto vertex = unique_.findOrAdd(hashWords(std::array{corner.position, corner.uv, corner.normal}), next,
                                              [&](std::uint32_t other) { return vertices_[other].corner == corner; });
        if (vertex == next) vertices_.push_back({.corner = corner, .line = line_});
        return vertex;
    }

    void startGroup(std::string_view keyword, std::string_view name) {
        (keyword == "g" ? group_ : object_) = name;
        if (keyword == "o") group_.clear();
        part_ = nullptr;
    }

    void startMaterial(std::string_view name) {
        material_ = name;
        part_ = nullptr;
    }

    /// The group's name, else the object's; a material is added behind a colon, or stands alone.
    Part& currentPart() {
        if (part_) return *part_;
        std::string name = group_.empty() ? object_ : group_;
        if (!material_.empty()) name = name.empty() ? material_ : name + ":" + material_;
        const auto [entry, isNew] = partByName_.emplace(name, parts_.size());
        if (isNew) parts_.push_back(std::make_unique<Part>(Part{.name = name, .indices = {}, .polygons = {}}));
        part_ = parts_[entry->second].get();
        return *part_;
    }

    Result<ReadMesh> build() {
        if (vertices_.size() > kMaxVertices) return tooLarge(source_.whole());
        result_.counts.vertices = positions_.size();
        for (const Vertex& vertex : vertices_)
            addVertex(vertex);
        if (error_) return *error_;
        for (const auto& part : parts_) {
            if (const auto wrong = part->polygons.cut(source_, mesh().positions, part->indices)) return *wrong;
            if (anyUnusable_) dropUnusable(*part);
            mesh().parts.push_back({.name = part->name,
                                    .firstIndex = static_cast<std::uint32_t>(mesh().indices.size()),
                                    .indexCount = static_cast<std::uint32_t>(part->indices.size())});
            mesh().indices.insert(mesh().indices.end(), part->indices.begin(), part->indices.end());
            part->indices = {};
        }
        dropIncomplete();
        addWarnings();
        return std::move(result_);
    }

    void addVertex(const Vertex& vertex) {
        const auto at = [](const auto& list, std::uint32_t index) {
            return index < list.size() ? list[index] : typename std::decay_t<decltype(list)>::value_type(0);
        };
        const Corner& corner = vertex.corner;
        usable_.push_back(inRange(vertex));
        mesh().positions.push_back(at(positions_, corner.position));
        mesh().uvs.push_back(at(uvs_, corner.uv));
        mesh().normals.push_back(at(normals_, corner.normal));
        withoutUv_ += corner.uv == kNone;
        withoutNormal_ += corner.normal == kNone;
        anyUnusable_ |= !usable_.back();
    }

    bool inRange(const Vertex& vertex) {
        const auto check = [&](std::uint32_t index, std::size_t size, const char* what) {
            if (index < size || index == kNone) return true;
            if (!source_.dropBadFaces)
                fail(badIndex(source_.atLine(vertex.line), fmt::format("the face refers to {} {} of {}", what, index + 1, size)));
            return false;
        };
        const bool position = check(vertex.corner.position, positions_.size(), "vertex");
        const bool uv = check(vertex.corner.uv, uvs_.size(), "texture coordinate");
        return check(vertex.corner.normal, normals_.size(), "normal") && position && uv;
    }

    void dropUnusable(Part& part) {
        std::vector<std::uint32_t> kept;
        for (std::size_t i = 0; i < part.indices.size(); i += 3) {
            const auto* t = &part.indices[i];
            const bool usable = usable_[t[0]] && usable_[t[1]] && usable_[t[2]];
            if (usable) kept.insert(kept.end(), t, t + 3);
            result_.counts.badFaces += !usable;
        }
        part.indices = std::move(kept);
    }

    /// Normals that some corners lack are made anew for all; UVs that all lack do not exist.
    void dropIncomplete() {
        if (withoutNormal_ > 0) mesh().normals.clear();
        if (withoutUv_ == mesh().positions.size()) mesh().uvs.clear();
    }

    void addWarnings() {
        for (const auto& [keyword, line] : unknown_)
            warn(mesh(), 5323, source_.atLine(line), fmt::format("the OBJ statement '{}' is ignored", keyword));
        if (!mesh().uvs.empty() && withoutUv_ > 0)
            warn(mesh(), 5325, source_.whole(),
                 fmt::format("{} of {} vertices have no texture coordinates: (0, 0) is used", withoutUv_, mesh().positions.size()));
    }

    void fail(Error error) {
        if (!error_) error_ = std::move(error);
    }
    [[nodiscard]] SourcePosition here() const { return source_.atLine(line_); }
    Mesh& mesh() { return result_.mesh; }

    const Source& source_;
    std::vector<glm::vec3> positions_;
    std::vector<glm::vec2> uvs_;
    std::vector<glm::vec3> normals_;
    std::string object_, group_, material_, joined_;
    std::vector<std::unique_ptr<Part>> parts_;
    std::map<std::string, std::size_t> partByName_;
    Part* part_ = nullptr;
    std::map<std::string, int> unknown_; // keyword -> first line
    std::vector<Vertex> vertices_;
    UniqueItems unique_; // vertices
    std::vector<std::uint32_t> corners_;
    std::vector<bool> usable_; // by vertex: everything it refers to exists
    bool anyUnusable_ = false;
    std::size_t indexCount_ = 0, withoutUv_ = 0, withoutNormal_ = 0;
    int line_ = 0;
    ReadMesh result_;
    std::optional<Error> error_;
};

} // namespace

Result<ReadMesh> readObj(const Source& source) {
    return ObjReader(source).read();
}

} // namespace tegument::meshfile
