// OFF (Geomview's object file format, text form): [ST][C][N]OFF, numbers of vertices, faces and edges, then the vertices and the faces.
//
// The format separates numbers by any space, and programs write what it does not say: colours of three numbers or four, colours without a
// C, no number of edges. So each vertex and each face is a line where there are as many lines, and counted by numbers only where not.

#include "host/mesh/polygons.h"
#include "host/mesh/text_words.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <span>

namespace tegument::meshfile {

namespace {

class OffReader {
public:
    explicit OffReader(const Source& source) : source_(source), words_(source, '#') {}

    Result<ReadMesh> read() {
        if (const auto wrong = readHeader()) return *wrong;
        byLines_ = words_.linesLeft() >= result_.counts.vertices + result_.counts.faces;
        for (std::size_t i = 0; i < result_.counts.vertices && !words_.error(); ++i)
            readVertex();
        for (std::size_t face = 0; face < result_.counts.faces && !words_.error(); ++face)
            readFace(face);
        readMoreFaces();
        if (words_.error()) return *words_.error();
        finishColours();
        result_.floats = false;
        addWarnings();
        Mesh& mesh = result_.mesh;
        if (const auto wrong = polygons_.cut(source_, mesh.positions, result_.exact, mesh.indices)) return *wrong;
        mesh.parts.push_back(
            {.name = source_.path.stem().string(), .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())});
        return std::move(result_);
    }

private:
    /// The keyword says what a vertex has: texture coordinates behind all else, colours behind the normal. It may be missing, and some
    /// files have no space behind it.
    std::optional<Error> readHeader() {
        std::string_view keyword = words_.next();
        const auto take = [&](std::string_view prefix) {
            const bool there = keyword.starts_with(prefix);
            if (there) keyword.remove_prefix(prefix.size());
            return there;
        };
        uvs_ = take("ST");
        colours_ = take("C");
        normals_ = take("N");
        const bool named = take("OFF");
        if (keyword.find_first_not_of("0123456789") != std::string_view::npos || (keyword.empty() && !named))
            return malformed(words_.at(), "the file does not start with OFF, or has vertices of other than 3 coordinates",
                             "save it as PLY");
        if (keyword.empty()) keyword = words_.next();
        if (keyword == "BINARY") return unsupported(words_.at(), "binary OFF cannot be read", "save it as text, or as PLY");
        result_.counts.vertices = countOf(keyword, "the number of vertices", 6); // "0 0 0 " are the fewest bytes of one
        if (result_.counts.vertices > kMaxVertices) return tooLarge(words_.at());
        result_.counts.faces = countOf(words_.next(), "the number of faces", 2);
        std::string_view rest = withoutComment(words_.restOfLine()); // the number of edges, which nothing needs
        if (words_.error()) return words_.error();
        if (const std::string_view edges = nextWord(rest); !edges.empty()) {
            countOf(edges, "the number of edges", 0);
        } else if (TextWords ahead(words_); result_.counts.vertices > 0) { // it may stand in a line of its own
            ahead.next();
            if (withoutComment(ahead.restOfLine()).empty()) words_.next();
        }
        return words_.error();
    }

    static std::string_view withoutComment(std::string_view line) { return trim(meshfile::withoutComment(line)); }

    std::size_t countOf(std::string_view word, std::string_view what, std::size_t leastBytes) {
        std::size_t count = 0;
        const auto parsed = std::from_chars(word.data(), word.data() + word.size(), count);
        if (word.empty() || parsed.ec != std::errc() || parsed.ptr != word.data() + word.size())
            words_.fail(malformed(words_.at(), fmt::format("'{}' is not {}", word.substr(0, 40), what)));
        else if (leastBytes > 0 && count > (words_.bytesLeft() + 1) / leastBytes)
            words_.fail(overclaimed(words_.at(), fmt::format("{} is {}, but only {} bytes follow", what, count, words_.bytesLeft())));
        return words_.error() ? 0 : count;
    }

    /// The numbers of a line, at least `least`; where items are no lines, so many numbers.
    void readRow(std::size_t least, std::string_view what) {
        row_.clear();
        if (byLines_) {
            row_.push_back(words_.nextNumber(what));
            std::string_view rest = withoutComment(words_.restOfLine());
            for (std::string_view word = nextWord(rest); !word.empty() && !words_.error(); word = nextWord(rest)) {
                row_.push_back(0);
                if (!parseReal(word, row_.back())) words_.fail(notANumber(words_.at(), word));
            }
        }
        while (row_.size() < least && !words_.error()) {
            if (byLines_)
                words_.fail(malformed(words_.at(), fmt::format("the line has {} numbers: {} is missing", row_.size(), what)));
            else
                row_.push_back(words_.nextNumber(what));
        }
        row_.resize(std::max(row_.size(), least), 0);
    }

    void readVertex() {
        const std::size_t place = 3, normal = normals_ ? 3 : 0, uv = uvs_ ? 2 : 0;
        readRow(place + normal + uv + (colours_ ? (byLines_ ? 3 : 4) : 0), "a number of a vertex");
        if (words_.error()) return;
        Mesh& mesh = result_.mesh;
        result_.exact.push_back(glm::dvec3(row_[0], row_[1], row_[2]) * source_.unitMm);
        mesh.positions.emplace_back(result_.exact.back());
        if (!source_.keepNotFinite && !isFinite(mesh.positions.back())) words_.fail(notFinite(words_.at(), "a coordinate is not finite"));
        if (normals_) mesh.normals.emplace_back(row_[3], row_[4], row_[5]);
        const std::size_t more = row_.size() - place - normal - uv;
        if (colours_) addColour(std::span(row_).subspan(place + normal, std::min<std::size_t>(more, 4)));
        vertexRest_ |= more > (colours_ ? 4U : 0U);
        if (uvs_) mesh.uvs.emplace_back(row_[row_.size() - 2], 1 - row_.back()); // v points up, as in OBJ
    }

    void addColour(std::span<const double> channels) {
        glm::dvec4 colour(kOpaque);
        for (std::size_t i = 0; i < channels.size(); ++i)
            colour[static_cast<glm::length_t>(i)] = channels[i];
        encoded_.push_back(colour);
    }

    /// 0 to 1; some programs write 0 to 255.
    void finishColours() {
        const bool bytes = std::ranges::any_of(encoded_, [](const glm::dvec4& c) { return std::max({c.r, c.g, c.b, c.a}) > 1; });
        for (glm::dvec4 colour : encoded_) {
            if (bytes) colour /= 255.0;
            if (colour.a < 0) colour.a = 1;
            result_.mesh.colors.push_back(linearColor(colour));
        }
    }

    /// "3 0 1 2", and perhaps a colour to the end of the line.
    void readFace(std::size_t face) {
        readRow(1, "a face's number of corners");
        const auto count = static_cast<std::size_t>(std::clamp(row_[0], 0.0, 1e9));
        if (words_.error()) return;
        if (static_cast<double>(count) != row_[0] || count > (words_.bytesLeft() + row_.size() * 32 + 1) / 2)
            return words_.fail(overclaimed(words_.at(), fmt::format("{:g} corners of a face cannot be", row_[0])));
        if (byLines_ && row_.size() <= count)
            return words_.fail(malformed(words_.at(), fmt::format("face {} has {} of its {} corners", face, row_.size() - 1, count)));
        while (!byLines_ && row_.size() <= count && !words_.error())
            row_.push_back(words_.nextNumber("a corner"));
        if (!byLines_) faceRest_ |= !withoutComment(words_.restOfLine()).empty();
        faceRest_ |= row_.size() > count + 1;
        addFace(face, std::span(row_).subspan(1, std::min(count, row_.size() - 1)));
    }

    void addFace(std::size_t face, std::span<const double> row) {
        corners_.clear();
        for (const double index : row) {
            const bool exists = index >= 0 && index < static_cast<double>(result_.counts.vertices) && index == std::floor(index);
            if (exists) corners_.push_back(static_cast<std::uint32_t>(index));
            if (!exists && !words_.error() && !source_.dropBadFaces)
                words_.fail(badIndex(words_.at(), fmt::format("face {} refers to vertex {} of {}", face, index, result_.counts.vertices)));
        }
        if (words_.error()) return;
        if (corners_.size() < row.size()) {
            ++result_.counts.badFaces;
            return;
        }
        result_.counts.smallFaces += corners_.size() < 3;
        polygons_.add(corners_, result_.mesh.indices);
        if (result_.mesh.indices.size() > kMaxIndices) words_.fail(tooLarge(words_.at()));
    }

    /// Faces behind those that the header announces. What is no face is an error: the file may be another shape than was read.
    void readMoreFaces() {
        const std::size_t announced = result_.counts.faces;
        while (!words_.error() && words_.linesLeft() > 0)
            readFace(result_.counts.faces++);
        if (!words_.error() && result_.counts.faces > announced)
            warn(result_.mesh, 5323, source_.whole(),
                 fmt::format("the header announces {} faces, the file holds {}: all are read", announced, result_.counts.faces));
    }

    void addWarnings() {
        if (vertexRest_)
            warn(result_.mesh, 5331, source_.whole(),
                 "what vertices carry behind their coordinates is left out: the keyword does not name it",
                 "a file with colours of its vertices begins with COFF");
        if (faceRest_)
            warn(result_.mesh, 5331, source_.whole(), "what the faces carry behind their corners (colours) is left out",
                 "give the colours to the vertices");
    }

    static constexpr double kOpaque = -1; // in place of an alpha that the file does not give

    const Source& source_;
    TextWords words_;
    ReadMesh result_;
    Polygons polygons_;
    std::vector<std::uint32_t> corners_;
    std::vector<glm::dvec4> encoded_; // colours
    std::vector<double> row_;
    bool normals_ = false, colours_ = false, uvs_ = false;
    bool byLines_ = false, vertexRest_ = false, faceRest_ = false;
};

} // namespace

Result<ReadMesh> readOff(const Source& source) {
    return OffReader(source).read();
}

} // namespace tegument::meshfile
