// STL (3D Systems, StereoLithography Interface Specification, 1988), text and binary: facets that share no vertices. Their normals are not
// read: many programs leave them 0, and the corners give them.

#include "host/mesh/text_words.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace tegument::meshfile {

namespace {

constexpr std::size_t kHeaderBytes = 84; // 80 of free text and the number of facets
constexpr std::size_t kFacetBytes = 50;  // normal, three corners, two bytes without agreed meaning

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian and is read as it is");

std::size_t facetCount(std::string_view bytes) {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + kHeaderBytes - sizeof count, sizeof count);
    return count;
}

/// Some binary files begin with "solid" too: a text goes on with "facet", and its length is no matter of arithmetic.
bool isText(std::string_view bytes) {
    if (!equalsIgnoreCase(trim(bytes.substr(0, 80)).substr(0, 5), "solid")) return false; // some are indented, some in capitals
    if (bytes.size() >= kHeaderBytes && bytes.size() == kHeaderBytes + facetCount(bytes) * kFacetBytes) return false;
    return bytes.substr(0, 1024).find('\0') == std::string_view::npos;
}

ReadMesh soup(std::vector<glm::vec3> positions, const Source& source, std::vector<glm::dvec3> exact = {}) {
    ReadMesh result;
    result.floats = exact.empty();
    result.exact = std::move(exact);
    result.counts = {.vertices = positions.size(), .faces = positions.size() / 3};
    result.mesh.positions = std::move(positions);
    result.mesh.indices.resize(result.mesh.positions.size());
    for (std::uint32_t i = 0; i < result.mesh.indices.size(); ++i)
        result.mesh.indices[i] = i;
    result.mesh.parts.push_back(
        {.name = source.path.stem().string(), .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(result.mesh.indices.size())});
    return result;
}

Result<ReadMesh> readBinary(const Source& source) {
    if (source.bytes.size() < kHeaderBytes) return truncated(source.atByte(source.bytes.size()), "a binary STL has a header of 84 bytes");
    std::size_t count = facetCount(source.bytes);
    const std::size_t held = (source.bytes.size() - kHeaderBytes) / kFacetBytes;
    const bool whole = (source.bytes.size() - kHeaderBytes) % kFacetBytes == 0;
    const bool unsaid = held > 0 && whole && (count == 0 || count == UINT32_MAX); // what writes as it goes does not know it at the start
    if (unsaid) count = held;
    if (count > held) return overclaimed(source.atByte(80), fmt::format("{} facets are announced, the file holds {}", count, held));
    if (count > kMaxVertices / 3) return tooLarge(source.atByte(80));
    std::vector<glm::vec3> positions;
    positions.reserve(3 * count);
    bool colours = false;
    for (std::size_t facet = 0; facet < count; ++facet) {
        const std::size_t offset = kHeaderBytes + facet * kFacetBytes;
        std::array<float, 12> values{};
        std::memcpy(values.data(), source.bytes.data() + offset, sizeof values);
        colours |= source.bytes[offset + kFacetBytes - 2] != 0 || source.bytes[offset + kFacetBytes - 1] != 0;
        for (std::size_t i = 3; i < 12; i += 3) {
            positions.push_back(scaled({values[i], values[i + 1], values[i + 2]}, source.unitMm));
            if (!source.keepNotFinite && !isFinite(positions.back()))
                return notFinite(source.atByte(offset + 4 * i), fmt::format("facet {} has a coordinate that is not finite", facet));
        }
    }
    ReadMesh read = soup(std::move(positions), source);
    if (unsaid)
        warn(read.mesh, 5323, source.atByte(80),
             fmt::format("the number of facets is not in the header: all {} of the file are read", count));
    if (colours)
        warn(read.mesh, 5331, source.whole(),
             "the two bytes that some facets carry besides are left out: programs write colours there, each in its way",
             "export PLY or glTF to keep colours");
    return read;
}

/// solid NAME / facet normal X Y Z / outer loop / vertex X Y Z (three) / endloop / endfacet / endsolid NAME
class TextReader {
public:
    explicit TextReader(const Source& source) : source_(source), words_(source, 0) {}

    Result<ReadMesh> read() {
        words_.next();
        words_.skipLine();
        while (!words_.error()) {
            const std::string word = toLower(words_.next());
            if (word == "facet")
                readFacet();
            else if (word == "endsolid" || word == "solid") // several bodies may follow each other
                endBody(word == "endsolid");
            else if (word == "end") {
                expect("solid");
                endBody(true);
            } else if (word.empty())
                break;
            else
                words_.fail(malformed(words_.at(), fmt::format("'{}' where 'facet' or 'endsolid' is expected", word.substr(0, 40))));
        }
        if (words_.error()) return *words_.error();
        if (!ended_ && exact_.empty()) return truncated(source_.atByte(source_.bytes.size()), "endsolid is missing");
        std::vector<glm::vec3> positions(exact_.begin(), exact_.end());
        ReadMesh read = soup(std::move(positions), source_, std::move(exact_));
        if (!ended_)
            warn(read.mesh, 5323, source_.atByte(source_.bytes.size()),
                 fmt::format("endsolid is missing behind {} facets: the file may have been longer", read.counts.faces));
        return read;
    }

private:
    void expect(std::string_view wanted) {
        if (words_.error()) return;
        const std::string_view word = words_.next();
        if (word.empty())
            words_.fail(truncated(source_.atByte(source_.bytes.size()), fmt::format("'{}' is missing", wanted)));
        else if (!equalsIgnoreCase(word, wanted))
            words_.fail(malformed(words_.at(), fmt::format("'{}' where '{}' is expected", word.substr(0, 40), wanted)));
    }

    /// "endloop", or "end loop" as some programs write it.
    void expectEnd(const std::string& of) {
        if (words_.error()) return;
        if (const std::string word = toLower(words_.next()); word == "end")
            expect(of);
        else if (word.empty())
            words_.fail(truncated(source_.atByte(source_.bytes.size()), fmt::format("'end{}' is missing", of)));
        else if (word != "end" + of)
            words_.fail(malformed(words_.at(), fmt::format("'{}' where 'end{}' is expected", word.substr(0, 40), of)));
    }

    void readFacet() {
        expect("normal");
        for (int i = 0; i < 3; ++i)
            words_.nextNumber("the facet's normal");
        expect("outer");
        expect("loop");
        for (int i = 0; i < 3; ++i) {
            expect("vertex");
            exact_.push_back(words_.nextPosition("a coordinate"));
        }
        expectEnd("loop");
        expectEnd("facet");
        if (exact_.size() > kMaxVertices) words_.fail(tooLarge(words_.at()));
    }

    void endBody(bool ended) {
        ended_ = ended;
        words_.skipLine();
    }

    const Source& source_;
    TextWords words_;
    std::vector<glm::dvec3> exact_;
    bool ended_ = false;
};

} // namespace

Result<ReadMesh> readStl(const Source& source) {
    return isText(source.bytes) ? TextReader(source).read() : readBinary(source);
}

} // namespace tegument::meshfile
