// PLY, text and both byte orders. Elements may come in any order and carry any properties; only vertices and faces are used.

#include "host/scene/mesh_file.h"
#include "host/scene/ply_header.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace tegument::meshfile {

namespace {

/// The values of the data section, one after the other. The first error is kept; after it every value is 0.
class Values {
public:
    Values(const Source& source, const PlyHeader& header)
        : source_(source), format_(header.format), offset_(header.size), line_(header.lines + 1) {}

    double next(PlyType type) {
        if (error_) return 0;
        return format_ == PlyFormat::Ascii ? nextText(type) : nextBinary(type);
    }

    /// A list's length, already held against what is left of the file.
    std::size_t nextCount(const PlyProperty& property) {
        const double count = next(*property.listCount);
        const std::size_t least = format_ == PlyFormat::Ascii ? 2 : byteSize(property.type);
        if (count < 0 || count * static_cast<double>(least) > static_cast<double>(source_.bytes.size() - offset_ + 1)) {
            fail(overclaimed(at(), fmt::format("a list '{}' of {} entries, but only {} bytes are left", property.name, count,
                                               source_.bytes.size() - offset_)));
            return 0;
        }
        return static_cast<std::size_t>(count);
    }

    void fail(Error error) {
        if (!error_) error_ = std::move(error);
    }
    [[nodiscard]] const std::optional<Error>& error() const { return error_; }
    [[nodiscard]] SourcePosition at() const {
        return format_ == PlyFormat::Ascii ? source_.atLine(line_) : source_.atByte(std::min(offset_, source_.bytes.size()));
    }

private:
    double nextText(PlyType type) {
        const std::string_view bytes = source_.bytes;
        while (offset_ < bytes.size() && std::string_view(" \t\r\n").find(bytes[offset_]) != std::string_view::npos)
            line_ += bytes[offset_++] == '\n';
        const std::size_t end = std::min(bytes.find_first_of(" \t\r\n", offset_), bytes.size());
        const std::string_view word = bytes.substr(offset_, end - offset_);
        if (word.empty()) {
            fail(truncated(source_.atByte(bytes.size()), "more values are announced in its header"));
            return 0;
        }
        offset_ = end;
        double value = 0;
        const bool number = parseReal(word, value);
        if (!number) fail(malformed(at(), fmt::format("'{}' is not a number", word.substr(0, 40))));
        const bool wholeWanted = type != PlyType::Float32 && type != PlyType::Float64;
        if (number && wholeWanted && !(value == std::floor(value))) fail(malformed(at(), fmt::format("'{}' is not a whole number", word)));
        return value;
    }

    double nextBinary(PlyType type) {
        const std::size_t size = byteSize(type);
        if (size > source_.bytes.size() - offset_) {
            fail(truncated(source_.atByte(source_.bytes.size()), "more values are announced in its header"));
            return 0;
        }
        std::array<char, 8> raw{};
        std::memcpy(raw.data(), source_.bytes.data() + offset_, size);
        offset_ += size;
        const bool swap = (format_ == PlyFormat::BigEndian) != (std::endian::native == std::endian::big);
        if (swap) std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(size));
        return decode(raw, type);
    }

    template <class T>
    static double as(const std::array<char, 8>& raw) {
        T value{};
        std::memcpy(&value, raw.data(), sizeof(T));
        return static_cast<double>(value);
    }

    static double decode(const std::array<char, 8>& raw, PlyType type) {
        switch (type) {
        case PlyType::Int8: return as<std::int8_t>(raw);
        case PlyType::Uint8: return as<std::uint8_t>(raw);
        case PlyType::Int16: return as<std::int16_t>(raw);
        case PlyType::Uint16: return as<std::uint16_t>(raw);
        case PlyType::Int32: return as<std::int32_t>(raw);
        case PlyType::Uint32: return as<std::uint32_t>(raw);
        case PlyType::Float32: return as<float>(raw);
        case PlyType::Float64: return as<double>(raw);
        }
        return 0;
    }

    const Source& source_;
    PlyFormat format_;
    std::size_t offset_;
    int line_;
    std::optional<Error> error_;
};

/// Which property of a vertex row is what.
struct VertexLayout {
    std::optional<std::size_t> x, y, z, nx, ny, nz, u, v;

    explicit VertexLayout(const PlyElement& element)
        : x(element.find({"x"})), y(element.find({"y"})), z(element.find({"z"})), nx(element.find({"nx"})), ny(element.find({"ny"})),
          nz(element.find({"nz"})), u(element.find({"u", "s", "texture_u"})), v(element.find({"v", "t", "texture_v"})) {}

    [[nodiscard]] bool hasNormals() const { return nx && ny && nz; }
    [[nodiscard]] bool hasUvs() const { return u && v; }
};

class PlyReader {
public:
    PlyReader(const Source& source, const PlyHeader& header) : source_(source), header_(header), values_(source, header) {}

    Result<Mesh> read() {
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex" && !verticesRead_)
                readVertices(element);
            else if (element.name == "face")
                readFaces(element);
            else
                skip(element);
            if (values_.error()) return *values_.error();
        }
        if (const auto wrong = checkIndices()) return *wrong;
        if (smallFaces_ > 0)
            warn(mesh_, 5322, source_.whole(), fmt::format("{} faces of fewer than three corners are left out", smallFaces_));
        mesh_.parts.push_back(
            {.name = source_.path.stem().string(), .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh_.indices.size())});
        return std::move(mesh_);
    }

private:
    void readRow(const PlyElement& element, std::vector<double>& row) {
        row.assign(element.properties.size(), 0);
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (!property.listCount)
                row[i] = values_.next(property.type);
            else
                skipList(property);
        }
    }

    void skipList(const PlyProperty& property) {
        for (std::size_t left = values_.nextCount(property); left > 0 && !values_.error(); --left)
            values_.next(property.type);
    }

    void skip(const PlyElement& element) {
        std::vector<double> row;
        if (element.properties.empty()) return;
        for (std::uint64_t i = 0; i < element.count && !values_.error(); ++i)
            readRow(element, row);
    }

    void readVertices(const PlyElement& element) {
        const VertexLayout layout(element);
        verticesRead_ = true;
        if (!layout.x || !layout.y || !layout.z)
            return values_.fail(malformed(source_.atLine(element.line), "the vertices have no x, y and z"));
        if (element.count > kMaxVertices) return values_.fail(tooLarge(source_.atLine(element.line)));
        std::vector<double> row;
        for (std::uint64_t i = 0; i < element.count; ++i) {
            readRow(element, row);
            const glm::vec3 position = scaled({row[*layout.x], row[*layout.y], row[*layout.z]}, source_.unitMm);
            if (!isFinite(position)) values_.fail(notFinite(values_.at(), fmt::format("vertex {} has a coordinate that is not finite", i)));
            if (values_.error()) return;
            mesh_.positions.push_back(position);
            if (layout.hasNormals()) mesh_.normals.emplace_back(row[*layout.nx], row[*layout.ny], row[*layout.nz]);
            if (layout.hasUvs()) mesh_.uvs.emplace_back(row[*layout.u], 1 - row[*layout.v]); // PLY's v points up, as in OBJ
        }
    }

    void readFaces(const PlyElement& element) {
        const auto list = element.find({"vertex_indices", "vertex_index"});
        if (!list || !element.properties[*list].listCount)
            return values_.fail(malformed(source_.atLine(element.line), "the faces have no list vertex_indices"));
        std::vector<std::int64_t> corners;
        for (std::uint64_t face = 0; face < element.count && !values_.error(); ++face) {
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                const PlyProperty& property = element.properties[i];
                if (i == *list)
                    readCorners(property, corners);
                else if (property.listCount)
                    skipList(property);
                else
                    values_.next(property.type);
            }
            addFan(corners, face);
        }
    }

    void readCorners(const PlyProperty& property, std::vector<std::int64_t>& corners) {
        corners.clear();
        for (std::size_t left = values_.nextCount(property); left > 0 && !values_.error(); --left) {
            const double index = values_.next(property.type);
            // vertices may follow, so only what no vertex can have is refused here
            if (!(index >= 0 && index < static_cast<double>(kMaxVertices)))
                values_.fail(badIndex(values_.at(), fmt::format("a face refers to vertex {}", index)));
            else
                corners.push_back(static_cast<std::int64_t>(index));
        }
    }

    void addFan(const std::vector<std::int64_t>& corners, std::uint64_t face) {
        if (values_.error()) return;
        smallFaces_ += corners.size() < 3;
        for (std::size_t i = 2; i < corners.size(); ++i)
            for (const std::int64_t corner : {corners[0], corners[i - 1], corners[i]})
                mesh_.indices.push_back(static_cast<std::uint32_t>(corner));
        if (corners.size() >= 3) lastIndexOfFace_.emplace_back(mesh_.indices.size(), face);
        if (mesh_.indices.size() > kMaxIndices) values_.fail(tooLarge(values_.at()));
    }

    [[nodiscard]] std::optional<Error> checkIndices() const {
        const auto wrong = std::ranges::find_if(mesh_.indices, [&](std::uint32_t index) { return index >= mesh_.positions.size(); });
        if (wrong == mesh_.indices.end()) return std::nullopt;
        const auto at = static_cast<std::size_t>(wrong - mesh_.indices.begin());
        const auto face = std::ranges::upper_bound(lastIndexOfFace_, at, {}, &std::pair<std::size_t, std::uint64_t>::first);
        return badIndex(source_.whole(), fmt::format("face {} refers to vertex {} of {}", face->second, *wrong, mesh_.positions.size()));
    }

    const Source& source_;
    const PlyHeader& header_;
    Values values_;
    Mesh mesh_;
    std::vector<std::pair<std::size_t, std::uint64_t>> lastIndexOfFace_; // (indices so far, face)
    std::size_t smallFaces_ = 0;
    bool verticesRead_ = false;
};

} // namespace

Result<Mesh> readPly(const Source& source) {
    const Result<PlyHeader> header = readPlyHeader(source);
    if (!header) return header.error();
    return PlyReader(source, *header).read();
}

} // namespace tegument::meshfile
