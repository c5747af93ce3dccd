#include "meshprep/prepare/chunks.h"

#include "host/mesh/triangles.h"
#include "meshprep/prepare/figures.h"

namespace tegument::prep {

namespace {

class Cutter {
public:
    explicit Cutter(std::size_t vertices) : lastChunk_(vertices, 0), number_(vertices, 0) {}

    /// Replaces parts and indices; the new vertices are behind those of earlier calls.
    void cut(std::vector<std::uint32_t>& indices, std::vector<MeshPart>& parts) {
        std::vector<MeshPart> pieces;
        for (const MeshPart& part : parts) {
            begin(part, part.firstIndex, pieces);
            for (std::uint32_t i = part.firstIndex; i < part.firstIndex + part.indexCount; i += 3) {
                if (used_ + newVertices(&indices[i]) > kMost16BitVertices) begin(part, i, pieces);
                for (std::uint32_t corner = i; corner < i + 3; ++corner)
                    indices[corner] = vertexOf(indices[corner]);
                pieces.back().indexCount += 3;
            }
        }
        parts = std::move(pieces);
    }

    [[nodiscard]] const std::vector<std::uint32_t>& from() const { return from_; }

private:
    void begin(const MeshPart& part, std::uint32_t firstIndex, std::vector<MeshPart>& pieces) {
        pieces.push_back({.name = part.name, .firstIndex = firstIndex, .indexCount = 0, .material = part.material});
        ++chunk_;
        used_ = 0;
    }

    [[nodiscard]] std::size_t newVertices(const std::uint32_t* triangle) const {
        std::size_t count = 0; // one vertex counted twice ends a piece three vertices early at most
        for (int i = 0; i < 3; ++i)
            count += lastChunk_[triangle[i]] != chunk_;
        return count;
    }

    std::uint32_t vertexOf(std::uint32_t vertex) {
        if (lastChunk_[vertex] != chunk_) {
            lastChunk_[vertex] = chunk_;
            number_[vertex] = static_cast<std::uint32_t>(from_.size());
            from_.push_back(vertex);
            ++used_;
        }
        return number_[vertex];
    }

    std::vector<std::uint32_t> lastChunk_; // by old vertex; chunks count from 1
    std::vector<std::uint32_t> number_;
    std::vector<std::uint32_t> from_;
    std::uint32_t chunk_ = 0;
    std::size_t used_ = 0;
};

} // namespace

Chunks cutIntoChunks(Mesh& mesh, std::span<MeshLevel* const> levels) {
    const std::size_t before = mesh.positions.size();
    Cutter cutter(before);
    cutter.cut(mesh.indices, mesh.parts);
    const Chunks result{.count = mesh.parts.size(), .duplicates = cutter.from().size() - before};
    for (MeshLevel* level : levels)
        cutter.cut(level->indices, level->parts);
    gatherVertices(mesh, cutter.from());
    return result;
}

} // namespace tegument::prep
