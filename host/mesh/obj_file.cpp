// The statements of an OBJ file, one logical line after the other.

#include "host/mesh/obj_file.h"
#include "host/mesh/mesh_file.h"
#include "host/support/file.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace tegument {

using namespace meshfile;

namespace {

template <class Number>
bool parseWhole(std::string_view word, Number& number) {
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto parsed = std::from_chars(word.data(), word.data() + word.size(), number);
    return parsed.ec == std::errc() && parsed.ptr == word.data() + word.size() && !word.empty();
}

/// Statements that describe something other than polygons, and are passed over in silence.
bool isIgnored(std::string_view keyword) {
    static constexpr std::array<std::string_view, 10> kIgnored = {"s",   "p",          "vp",        "maplib", "usemap",
                                                                  "lod", "shadow_obj", "trace_obj", "bevel",  "mg"};
    return std::ranges::find(kIgnored, keyword) != kIgnored.end();
}

class ObjParser {
public:
    explicit ObjParser(const Source& source) : source_(source) {}

    Result<ObjFile> parse() {
        if (source_.bytes.starts_with("\xff\xfe") || source_.bytes.starts_with("\xfe\xff"))
            return malformed(source_.atByte(0), "the OBJ file is UTF-16", "save it as UTF-8 or ASCII");
        std::string_view left = withoutMark(source_.bytes);
        while (!left.empty() && !error_)
            readStatement(takeLine(left));
        takePaint();
        if (!file_.colors.empty()) file_.colors.resize(file_.positions.size(), glm::vec4(1));
        for (ObjCorner& corner : file_.corners) {
            forgetAbsent(corner.uv, file_.uvs.size(), file_.absentUvs);
            forgetAbsent(corner.normal, file_.normals.size(), file_.absentNormals);
        }
        if (!source_.dropBadFaces) checkCorners();
        if (error_) return *error_;
        return std::move(file_);
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
        if (line.starts_with("#MRGB ")) readPaint(trim(line.substr(6)));
        line = withoutComment(line);
        const std::string keyword = toLower(nextWord(line)); // some programs write capitals
        if (keyword.empty() || isIgnored(keyword)) return;
        if (keyword == "v")
            readPosition(line);
        else if (keyword == "vt")
            readUv(line);
        else if (keyword == "vn")
            readNormal(line);
        else if (keyword == "f" || keyword == "fo") // the latter is the name of before 1995
            readFace(line);
        else if (keyword == "l")
            readLine(line);
        else if (keyword == "o" || keyword == "g")
            startGroup(keyword, trim(line));
        else if (keyword == "usemtl")
            startMaterial(trim(line));
        else if (keyword == "mtllib")
            file_.libraries.emplace_back(trim(line));
        else
            file_.otherStatements.emplace(keyword.substr(0, 40), line_);
        if (file_.positions.size() > kMaxVertices || indexCount_ > kMaxIndices) fail(tooLarge(here()));
    }

    /// At least `least` numbers, at most the array's size; the rest of the line is not looked at.
    template <std::size_t N>
    std::array<double, N> numbers(std::string_view line, std::size_t least, std::string_view* rest = nullptr) {
        std::array<double, N> values{};
        for (std::size_t i = 0; i < N && !error_; ++i) {
            const std::string_view word = nextWord(line);
            if (word.empty() && i >= least) break;
            if (!parseReal(word, values[i]))
                fail(word.empty() ? malformed(here(), fmt::format("{} numbers are needed here", least)) : notANumber(here(), word));
        }
        if (rest) *rest = line;
        return values;
    }

    void readPosition(std::string_view line) {
        auto [x, y, z] = numbers<3>(line, 3, &line);
        if (const double w = weightIn(line); w != 1) {
            if (w == 0) fail(malformed(here(), "the weight w of the vertex is 0: it lies nowhere"));
            x /= w;
            y /= w;
            z /= w;
        }
        const glm::vec3 position = scaled({x, y, z}, source_.unitMm);
        if (!source_.keepNotFinite && !isFinite(position)) fail(notFinite(here(), "a coordinate is not finite"));
        file_.positions.push_back(position);
        file_.exact.push_back(glm::dvec3(x, y, z) * source_.unitMm);
        if (!trim(line).empty()) readColor(line);
    }

    /// A single number behind a position is its weight w, by which x, y and z are divided.
    static double weightIn(std::string_view line) {
        double w = 1;
        const std::string_view word = nextWord(line);
        return !word.empty() && trim(line).empty() && parseReal(word, w) && std::isfinite(w) ? w : 1;
    }

    /// Colours of ZBrush, in comments: "#MRGB mmrrggbb..." in hexadecimal, of one vertex after the other.
    void readPaint(std::string_view digits) {
        for (; digits.size() >= 8; digits.remove_prefix(8)) {
            std::uint32_t value = 0;
            const auto parsed = std::from_chars(digits.data(), digits.data() + 8, value, 16);
            if (parsed.ec != std::errc() || parsed.ptr != digits.data() + 8) return;
            paint_.push_back(linearColor(glm::dvec4(value >> 16 & 255U, value >> 8 & 255U, value & 255U, 255) / 255.0));
        }
    }

    void takePaint() {
        if (paint_.empty() || !file_.colors.empty()) return;
        if (paint_.size() == file_.positions.size())
            file_.colors = std::move(paint_);
        else
            file_.otherStatements.emplace("#MRGB", 0);
    }

    /// Three more numbers behind a position are its colour, as MeshLab writes it.
    void readColor(std::string_view line) {
        glm::dvec4 color(1);
        for (glm::length_t i = 0; i < 3; ++i) {
            const std::string_view word = nextWord(line);
            if (word.empty() || !parseReal(word, color[i]) || !std::isfinite(color[i])) return;
        }
        file_.colors.resize(file_.positions.size() - 1, glm::vec4(1));
        file_.colors.push_back(linearColor(color));
    }

    void readUv(std::string_view line) {
        const auto [u, v] = numbers<2>(line, 1);
        file_.uvs.emplace_back(u, v);
    }

    void readNormal(std::string_view line) {
        const auto [x, y, z] = numbers<3>(line, 3);
        file_.normals.emplace_back(x, y, z);
    }

    /// A line that names what cannot be is left out: meshes are whole without lines.
    void readLine(std::string_view line) {
        const std::size_t first = file_.lineCorners.size();
        for (std::string_view word = nextWord(line); !word.empty(); word = nextWord(line)) {
            const std::size_t slash = std::min(word.find('/'), word.size());
            const std::string_view uv = word.substr(std::min(slash + 1, word.size()));
            const auto numbered = [](std::string_view text, std::size_t soFar) {
                std::int64_t index = 0;
                const std::int64_t from = parseWhole(text, index) && index < 0 ? static_cast<std::int64_t>(soFar) : -1;
                return index != 0 && index + from >= 0 && index + from < static_cast<std::int64_t>(kMaxIndices)
                           ? static_cast<std::uint32_t>(index + from)
                           : ObjCorner::kNone;
            };
            file_.lineCorners.push_back(
                {.position = numbered(word.substr(0, slash), file_.positions.size()), .uv = numbered(uv, file_.uvs.size())});
            if (file_.lineCorners.back().position == ObjCorner::kNone) return file_.lineCorners.resize(first);
        }
        indexCount_ += file_.lineCorners.size() - first;
        if (file_.lineCorners.size() > first) file_.firstOfLine.push_back(static_cast<std::uint32_t>(first));
    }

    /// "7", "7/2", "7//3", "7/2/3", each from 1, or negative: counted back from the latest. Nothing for a corner that refers to none.
    std::optional<ObjCorner> readCorner(std::string_view word) {
        ObjCorner corner;
        const std::array<std::pair<std::uint32_t*, std::size_t>, 3> fields = {
            {{&corner.position, file_.positions.size()}, {&corner.uv, file_.uvs.size()}, {&corner.normal, file_.normals.size()}}};
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
            else if (field == 0 || !isAbsent(index, fields[field].second, field == 1 ? file_.absentUvs : file_.absentNormals))
                usable &= setIndex(*fields[field].first, index, fields[field].second, word);
        }
        return usable ? std::optional(corner) : std::nullopt;
    }

    /// The shape is whole without normals and texture coordinates, so a corner that names one before the first does without.
    static bool isAbsent(std::int64_t index, std::size_t soFar, std::size_t& count) {
        const bool absent = index == 0 || index < -static_cast<std::int64_t>(soFar);
        count += absent;
        return absent;
    }

    /// So does one that names one behind the last, which is known when everything is read.
    static void forgetAbsent(std::uint32_t& index, std::size_t size, std::size_t& count) {
        if (index == ObjCorner::kNone || index < size) return;
        index = ObjCorner::kNone;
        ++count;
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
        const auto first = static_cast<std::uint32_t>(file_.corners.size());
        bool usable = true;
        for (std::string_view word = nextWord(line); !word.empty() && !error_; word = nextWord(line)) {
            const auto corner = readCorner(word);
            usable &= corner.has_value();
            if (corner) file_.corners.push_back(*corner);
        }
        const std::size_t count = file_.corners.size() - first;
        if (!usable) {
            file_.corners.resize(first);
            ++file_.badFaces;
            return;
        }
        if (!sectionIsOpen_)
            file_.sections.push_back({.object = object_, .group = group_, .material = material_, .firstFace = file_.faces.size()});
        sectionIsOpen_ = true;
        file_.faces.push_back({.firstCorner = first, .line = line_});
        indexCount_ += count < 3 ? 0 : 3 * (count - 2);
    }

    void startGroup(std::string_view keyword, std::string_view name) {
        (keyword == "g" ? group_ : object_) = name;
        if (keyword == "o") group_.clear();
        sectionIsOpen_ = false;
    }

    void startMaterial(std::string_view name) {
        material_ = name;
        sectionIsOpen_ = false;
    }

    /// What corners name may be defined further down: known when everything is read.
    void checkCorners() {
        for (std::size_t face = 0; face < file_.faces.size() && !error_; ++face)
            for (const ObjCorner& corner : file_.cornersOf(face))
                if (corner.position >= file_.positions.size())
                    fail(badIndex(source_.atLine(file_.faces[face].line),
                                  fmt::format("the face refers to vertex {} of {}", corner.position + 1, file_.positions.size())));
    }

    void fail(Error error) {
        if (!error_) error_ = std::move(error);
    }
    [[nodiscard]] SourcePosition here() const { return source_.atLine(line_); }

    const Source& source_;
    std::string object_, group_, material_, joined_;
    std::vector<glm::vec4> paint_;
    bool sectionIsOpen_ = false;
    std::size_t indexCount_ = 0; // of the triangles that the faces will be
    int line_ = 0;
    ObjFile file_;
    std::optional<Error> error_;
};

} // namespace

std::span<const ObjCorner> ObjFile::cornersOf(std::size_t face) const {
    const std::size_t first = faces[face].firstCorner;
    const std::size_t end = face + 1 < faces.size() ? faces[face + 1].firstCorner : corners.size();
    return std::span(corners).subspan(first, end - first);
}

std::size_t ObjFile::endOf(std::size_t section) const {
    return section + 1 < sections.size() ? sections[section + 1].firstFace : faces.size();
}

bool ObjFile::holds(const ObjCorner& corner) const {
    const auto has = [](std::size_t size, std::uint32_t index) { return index < size || index == ObjCorner::kNone; };
    return has(positions.size(), corner.position) && has(uvs.size(), corner.uv) && has(normals.size(), corner.normal);
}

Result<ObjFile> parseObj(std::string_view text, const std::filesystem::path& file) {
    return meshfile::parseObj(Source{.path = file, .bytes = text, .unitMm = 1});
}

Result<ObjFile> meshfile::parseObj(const Source& source) {
    return ObjParser(source).parse();
}

std::filesystem::path objFileIn(const std::filesystem::path& folder, std::string name) {
    std::ranges::replace(name, '\\', '/');
    if (name.size() > 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    std::error_code code;
    const std::filesystem::path written = folder / name;
    if (name.empty() || std::filesystem::exists(written, code)) return written;
    return findInAnyCase(folder, name.substr(name.find_last_of('/') + 1)).value_or(written);
}

std::vector<std::filesystem::path> objLibrariesIn(const std::filesystem::path& folder, const std::string& names) {
    std::error_code code;
    std::vector<std::filesystem::path> all{objFileIn(folder, names)};
    if (std::filesystem::exists(all.front(), code)) return all;
    std::vector<std::filesystem::path> several;
    std::string_view left = names;
    for (std::string_view word = nextWord(left); !word.empty(); word = nextWord(left)) {
        if (!toLower(word).ends_with(".mtl")) return all; // a part of a name with spaces
        several.push_back(objFileIn(folder, std::string(word)));
    }
    return several.size() > 1 ? several : all;
}

std::string objPictureName(std::string_view rest) {
    rest = trim(rest);
    while (rest.starts_with('-')) {
        std::string_view after = rest;
        const std::string option = toLower(nextWord(after));
        const bool vector = option == "-o" || option == "-s" || option == "-t"; // one to three numbers
        const int most = vector ? 3 : option == "-mm" ? 2 : 1;
        for (int i = 0; i < most; ++i) {
            std::string_view next = after;
            const std::string_view word = nextWord(next);
            double number = 0;
            if (trim(next).empty() || (i > 0 && !parseReal(word, number))) break; // the last word is the name
            after = next;
        }
        if (trim(after).empty()) break; // a name that begins so
        rest = trim(after);
    }
    return std::string(rest);
}

} // namespace tegument
