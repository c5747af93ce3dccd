// Wavefront OBJ: polygons with texture coordinates and normals, groups, objects and materials as parts. One vertex per distinct triple of
// indices.

#include "host/scene/mesh_file.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <memory>
#include <unordered_map>

namespace tegument::meshfile {

namespace {

/// Indices from 0; -1 where the corner names none.
struct Corner {
    std::int64_t position = -1;
    std::int64_t uv = -1;
    std::int64_t normal = -1;
    bool operator==(const Corner&) const = default;
};

struct CornerHash {
    std::size_t operator()(const Corner& corner) const {
        // three large odd multipliers spread the three indices over the word
        const auto u = [](std::int64_t value) { return static_cast<std::uint64_t>(value); };
        const std::uint64_t mixed =
            u(corner.position) * 0x9e3779b97f4a7c15u ^ u(corner.uv) * 0xc2b2ae3d27d4eb4fu ^ u(corner.normal) * 0x165667b19e3779f9u;
        return static_cast<std::size_t>(mixed ^ mixed >> 32);
    }
};

struct Triangle {
    std::array<Corner, 3> corners;
    int line = 0;
};

struct Part {
    std::string name;
    std::vector<Triangle> triangles;
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

    Result<Mesh> read() {
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
        if (positions_.size() > kMaxVertices || triangleCount_ * 3 > kMaxIndices) fail(tooLarge(here()));
    }

    /// At least `least` numbers, at most the array's size; the rest of the line is not looked at.
    template <std::size_t N>
    std::array<double, N> numbers(std::string_view line, std::size_t least) {
        std::array<double, N> values{};
        for (std::size_t i = 0; i < N && !error_; ++i) {
            const std::string_view word = nextWord(line);
            if (word.empty() && i >= least) break;
            if (!parseReal(word, values[i]))
                fail(malformed(here(), word.empty() ? fmt::format("{} numbers are needed here", least)
                                                    : fmt::format("'{}' is not a number", word.substr(0, 40))));
        }
        return values;
    }

    void readPosition(std::string_view line) {
        const auto [x, y, z] = numbers<3>(line, 3);
        const glm::vec3 position = scaled({x, y, z}, source_.unitMm);
        if (!isFinite(position)) fail(notFinite(here(), "a coordinate is not finite"));
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

    /// "7", "7/2", "7//3", "7/2/3", each from 1, or negative: counted back from the latest.
    Corner readCorner(std::string_view word) {
        Corner corner;
        const std::array<std::pair<std::int64_t*, std::size_t>, 3> fields = {
            {{&corner.position, positions_.size()}, {&corner.uv, uvs_.size()}, {&corner.normal, normals_.size()}}};
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
                *fields[field].first = absolute(index, fields[field].second, word);
        }
        return corner;
    }

    std::int64_t absolute(std::int64_t index, std::size_t soFar, std::string_view word) {
        const std::int64_t fromZero = index < 0 ? index + static_cast<std::int64_t>(soFar) : index - 1;
        if (fromZero < 0) fail(badIndex(here(), fmt::format("the corner '{}' refers to an element before the first", word.substr(0, 40))));
        return fromZero;
    }

    void readFace(std::string_view line) {
        std::vector<Corner> corners;
        for (std::string_view word = nextWord(line); !word.empty() && !error_; word = nextWord(line))
            corners.push_back(readCorner(word));
        if (error_) return;
        smallFaces_ += corners.size() < 3;
        for (std::size_t i = 2; i < corners.size(); ++i) {
            currentPart().triangles.push_back({.corners = {corners[0], corners[i - 1], corners[i]}, .line = line_});
            ++triangleCount_;
        }
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
        if (isNew) parts_.push_back(std::make_unique<Part>(Part{.name = name, .triangles = {}}));
        part_ = parts_[entry->second].get();
        return *part_;
    }

    Result<Mesh> build() {
        for (const auto& part : parts_) {
            const auto first = static_cast<std::uint32_t>(mesh_.indices.size());
            for (const Triangle& triangle : part->triangles)
                for (const Corner& corner : triangle.corners)
                    if (!addCorner(corner, triangle.line)) return *error_;
            const auto count = static_cast<std::uint32_t>(mesh_.indices.size()) - first;
            mesh_.parts.push_back({.name = part->name, .firstIndex = first, .indexCount = count});
        }
        dropIncomplete();
        addWarnings();
        return std::move(mesh_);
    }

    bool addCorner(const Corner& corner, int line) {
        if (!inRange(corner, line)) return false;
        const auto [entry, isNew] = vertexOf_.emplace(corner, static_cast<std::uint32_t>(mesh_.positions.size()));
        mesh_.indices.push_back(entry->second);
        if (!isNew) return true;
        const auto at = [](const auto& list, std::int64_t index) {
            return index < 0 ? typename std::decay_t<decltype(list)>::value_type(0) : list[static_cast<std::size_t>(index)];
        };
        mesh_.positions.push_back(positions_[static_cast<std::size_t>(corner.position)]);
        mesh_.uvs.push_back(at(uvs_, corner.uv));
        mesh_.normals.push_back(at(normals_, corner.normal));
        withoutUv_ += corner.uv < 0;
        withoutNormal_ += corner.normal < 0;
        return true;
    }

    bool inRange(const Corner& corner, int line) {
        const auto check = [&](std::int64_t index, std::size_t size, const char* what) {
            if (index < static_cast<std::int64_t>(size)) return;
            fail(badIndex(source_.atLine(line), fmt::format("the face refers to {} {} of {}", what, index + 1, size)));
        };
        check(corner.position, positions_.size(), "vertex");
        check(corner.uv, uvs_.size(), "texture coordinate");
        check(corner.normal, normals_.size(), "normal");
        return !error_;
    }

    /// Normals that some corners lack are made anew for all; UVs that all lack do not exist.
    void dropIncomplete() {
        if (withoutNormal_ > 0) mesh_.normals.clear();
        if (withoutUv_ == mesh_.positions.size()) mesh_.uvs.clear();
    }

    void addWarnings() {
        for (const auto& [keyword, line] : unknown_)
            warn(mesh_, 5323, source_.atLine(line), fmt::format("the OBJ statement '{}' is ignored", keyword));
        if (smallFaces_ > 0)
            warn(mesh_, 5322, source_.whole(), fmt::format("{} faces of fewer than three corners are left out", smallFaces_));
        if (!mesh_.uvs.empty() && withoutUv_ > 0)
            warn(mesh_, 5325, source_.whole(),
                 fmt::format("{} of {} vertices have no texture coordinates: (0, 0) is used", withoutUv_, mesh_.positions.size()));
    }

    void fail(Error error) {
        if (!error_) error_ = std::move(error);
    }
    [[nodiscard]] SourcePosition here() const { return source_.atLine(line_); }

    const Source& source_;
    std::vector<glm::vec3> positions_;
    std::vector<glm::vec2> uvs_;
    std::vector<glm::vec3> normals_;
    std::string object_, group_, material_, joined_;
    std::vector<std::unique_ptr<Part>> parts_;
    std::map<std::string, std::size_t> partByName_;
    Part* part_ = nullptr;
    std::map<std::string, int> unknown_; // keyword -> first line
    std::unordered_map<Corner, std::uint32_t, CornerHash> vertexOf_;
    std::size_t triangleCount_ = 0, smallFaces_ = 0, withoutUv_ = 0, withoutNormal_ = 0;
    int line_ = 0;
    Mesh mesh_;
    std::optional<Error> error_;
};

} // namespace

Result<Mesh> readObj(const Source& source) {
    return ObjReader(source).read();
}

} // namespace tegument::meshfile
