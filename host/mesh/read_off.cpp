// OFF (Geomview's object file format, text form): [ST][C][N]OFF, numbers of vertices, faces and edges, then the vertices and the faces.

#include "host/mesh/polygons.h"
#include "host/mesh/text_words.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace tegument::meshfile {

namespace {

class OffReader {
public:
    explicit OffReader(const Source& source) : source_(source), words_(source, '#') {}

    Result<ReadMesh> read() {
        if (const auto wrong = readHeader()) return *wrong;
        readVertices();
        for (std::size_t face = 0; face < result_.counts.faces && !words_.error(); ++face)
            readFace(face);
        if (words_.error()) return *words_.error();
        finishColours();
        Mesh& mesh = result_.mesh;
        result_.floats = false;
        if (faceColours_)
            warn(mesh, 5331, source_.whole(), "what the faces carry behind their corners (colours) is left out",
                 "give the colours to the vertices");
        if (const auto wrong = polygons_.cut(source_, mesh.positions, result_.exact, mesh.indices)) return *wrong;
        mesh.parts.push_back(
            {.name = source_.path.stem().string(), .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())});
        return std::move(result_);
    }

private:
    /// The keyword says what a vertex has: texture coordinates behind all else, colours behind the normal. It may be missing.
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
        const bool named = keyword == "OFF";
        const bool number = !keyword.empty() && keyword.find_first_not_of("0123456789") == std::string_view::npos;
        if (!named && !number)
            return malformed(words_.at(), "the file does not start with OFF, or has vertices of other than 3 coordinates",
                             "save it as PLY");
        result_.counts.vertices = // "0 0 0 " are the fewest bytes of one
            countOf(named ? words_.next() : keyword, "the number of vertices", 6);
        if (result_.counts.vertices > kMaxVertices) return tooLarge(words_.at());
        result_.counts.faces = nextCount("the number of faces", 2);
        nextCount("the number of edges", 0);
        return words_.error();
    }

    std::size_t nextCount(std::string_view what, std::size_t leastBytes) { return countOf(words_.next(), what, leastBytes); }

    std::size_t countOf(std::string_view word, std::string_view what, std::size_t leastBytes) {
        std::size_t count = 0;
        const auto parsed = std::from_chars(word.data(), word.data() + word.size(), count);
        if (word.empty() || parsed.ec != std::errc() || parsed.ptr != word.data() + word.size())
            words_.fail(malformed(words_.at(), fmt::format("'{}' is not {}", word.substr(0, 40), what)));
        else if (leastBytes > 0 && count > (words_.bytesLeft() + 1) / leastBytes)
            words_.fail(overclaimed(words_.at(), fmt::format("{} is {}, but only {} bytes follow", what, count, words_.bytesLeft())));
        return words_.error() ? 0 : count;
    }

    void readVertices() {
        Mesh& mesh = result_.mesh;
        for (std::size_t i = 0; i < result_.counts.vertices && !words_.error(); ++i) {
            result_.exact.push_back(words_.nextPosition("a coordinate"));
            mesh.positions.emplace_back(result_.exact.back());
            if (normals_) mesh.normals.push_back(vector("a normal"));
            if (colours_) readColour();
            if (!uvs_) continue;
            const double u = words_.nextNumber("a texture coordinate");
            mesh.uvs.emplace_back(u, 1 - words_.nextNumber("a texture coordinate")); // v points up, as in OBJ
        }
    }

    /// 0 to 1; some programs write 0 to 255.
    void readColour() {
        glm::dvec4 colour(0);
        for (glm::length_t channel = 0; channel < 4; ++channel)
            colour[channel] = words_.nextNumber("a colour");
        encoded_.push_back(colour);
    }

    void finishColours() {
        const bool bytes = std::ranges::any_of(encoded_, [](const glm::dvec4& c) { return std::max({c.r, c.g, c.b, c.a}) > 1; });
        for (const glm::dvec4& colour : encoded_)
            result_.mesh.colors.push_back(linearColor(bytes ? colour / 255.0 : colour));
    }

    glm::vec3 vector(std::string_view what) {
        const double x = words_.nextNumber(what);
        const double y = words_.nextNumber(what);
        return {x, y, words_.nextNumber(what)};
    }

    /// "3 0 1 2", and perhaps a colour to the end of the line.
    void readFace(std::size_t face) {
        const std::size_t count = nextCount("a face's number of corners", 2);
        corners_.clear();
        bool usable = true;
        for (std::size_t i = 0; i < count && !words_.error(); ++i) {
            const double index = words_.nextNumber("a corner");
            const bool exists = index >= 0 && index < static_cast<double>(result_.counts.vertices) && index == std::floor(index);
            if (exists) corners_.push_back(static_cast<std::uint32_t>(index));
            usable &= exists;
            if (!exists && !words_.error() && !source_.dropBadFaces)
                words_.fail(badIndex(words_.at(), fmt::format("face {} refers to vertex {} of {}", face, index, result_.counts.vertices)));
        }
        faceColours_ |= !trim(words_.restOfLine()).empty();
        if (words_.error()) return;
        result_.counts.badFaces += !usable;
        if (!usable) return;
        result_.counts.smallFaces += corners_.size() < 3;
        polygons_.add(corners_, result_.mesh.indices);
        if (result_.mesh.indices.size() > kMaxIndices) words_.fail(tooLarge(words_.at()));
    }

    const Source& source_;
    TextWords words_;
    ReadMesh result_;
    Polygons polygons_;
    std::vector<std::uint32_t> corners_;
    std::vector<glm::dvec4> encoded_; // colours
    bool normals_ = false, colours_ = false, uvs_ = false, faceColours_ = false;
};

} // namespace

Result<ReadMesh> readOff(const Source& source) {
    return OffReader(source).read();
}

} // namespace tegument::meshfile
