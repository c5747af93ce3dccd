#include "meshprep/order/piece.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace tegument::order {

namespace {

/// Components below this size are gathered: a soup of a million triangles is not a million runs of every order.
constexpr std::size_t kSmallPiece = 1024;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Each face's vertices, each once.
template <class Visit>
void forVerticesOf(std::span<const std::uint32_t> corners, std::size_t face, Visit visit) {
    const std::uint32_t a = corners[3 * face], b = corners[3 * face + 1], c = corners[3 * face + 2];
    visit(a);
    if (b != a) visit(b);
    if (c != a && c != b) visit(c);
}

/// In meshes of more faces a component that has more than half of them is cut in two, which are ordered at the same time. The first is
/// round, so that they have few vertices in common: 0.1 % more misses on scans, and of the Bunny 0.3 %.
constexpr std::size_t kHalvedFaces = 100'000;

/// A search in breadth over the faces; what it reaches is numbered in the order of reaching, anew in each piece.
class Search {
public:
    Search(std::span<const std::uint32_t> indices, std::size_t vertexCount, std::vector<std::uint32_t>& reached)
        : indices_(indices), around_(facesOfVertices(indices, vertexCount)), number_(vertexCount, kNone), taken_(indices.size() / 3, 0),
          reached_(reached) {}

    [[nodiscard]] bool taken(std::size_t face) const { return taken_[face] != 0; }

    /// Takes the faces that hang together with this one until `out` has so many corners; it gets theirs, numbered from `base` on. Gives the
    /// first face that is left.
    std::optional<std::size_t> spread(std::size_t face, std::size_t base, std::size_t most, std::vector<std::uint32_t>& out) {
        std::size_t next = reached_.size();
        take(face, base, out);
        for (; next < reached_.size(); ++next)
            for (const std::uint32_t f : around_.of(reached_[next])) {
                if (taken(f)) continue;
                if (out.size() >= most) return f;
                take(f, base, out);
            }
        return std::nullopt;
    }

private:
    void take(std::size_t face, std::size_t base, std::vector<std::uint32_t>& out) {
        taken_[face] = 1;
        for (const std::uint32_t vertex : indices_.subspan(3 * face, 3)) {
            if (number_[vertex] == kNone || number_[vertex] < base) { // or reached by a piece before
                number_[vertex] = static_cast<std::uint32_t>(reached_.size());
                reached_.push_back(vertex);
            }
            out.push_back(static_cast<std::uint32_t>(number_[vertex] - base));
        }
    }

    std::span<const std::uint32_t> indices_;
    VertexFaces around_;
    std::vector<std::uint32_t> number_;
    std::vector<std::uint8_t> taken_;
    std::vector<std::uint32_t>& reached_;
};

} // namespace

VertexFaces facesOfVertices(std::span<const std::uint32_t> corners, std::size_t vertexCount) {
    VertexFaces around;
    around.first.assign(vertexCount + 1, 0);
    const std::size_t faces = corners.size() / 3;
    for (std::size_t f = 0; f < faces; ++f)
        forVerticesOf(corners, f, [&](std::uint32_t v) { ++around.first[v]; });
    std::uint32_t end = 0;
    for (std::uint32_t& first : around.first)
        first = end += first;
    around.faces.resize(end);
    for (std::size_t f = faces; f-- > 0;)
        forVerticesOf(corners, f, [&](std::uint32_t v) { around.faces[--around.first[v]] = static_cast<std::uint32_t>(f); });
    return around;
}

Pieces::Pieces(std::span<const std::uint32_t> indices, std::size_t vertexCount, Cut cut) {
    Search search(indices, vertexCount, original_);
    corners_.reserve(indices.size());
    const std::size_t all = indices.size() / 3;
    const std::size_t most = cut == Cut::Components && all > kHalvedFaces ? (all + 1) / 2 : all;
    for (std::size_t face = 0; face < all; ++face)
        for (std::optional<std::size_t> from = face; from && !search.taken(*from);) {
            const std::size_t faces = corners_.size() / 3;
            const bool full = cut == Cut::Components && !pieces_.empty() && faces - pieces_.back().face >= kSmallPiece;
            if (pieces_.empty() || full) pieces_.push_back({.face = faces, .vertex = original_.size()});
            from = search.spread(*from, pieces_.back().vertex, 3 * (pieces_.back().face + most), corners_);
        }
}

Piece Pieces::piece(std::size_t i) const {
    const auto corners = std::span(corners_).subspan(3 * pieces_[i].face, 3 * (end(i).face - pieces_[i].face));
    const std::size_t vertices = end(i).vertex - pieces_[i].vertex;
    return {.corners = corners, .vertexCount = static_cast<std::uint32_t>(vertices), .around = facesOfVertices(corners, vertices)};
}

void Pieces::restore(std::size_t i, std::span<const std::uint32_t> corners, std::span<std::uint32_t> out) const {
    const std::span numbers = std::span(original_).subspan(pieces_[i].vertex);
    for (std::size_t c = 0; c < corners.size(); ++c)
        out[3 * pieces_[i].face + c] = numbers[corners[c]];
}

} // namespace tegument::order
