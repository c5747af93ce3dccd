#include "meshprep/order/piece.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <unordered_map>

namespace tegument::order {

namespace {

/// Components below this size are gathered: a soup of a million triangles is not a million runs of every order.
constexpr std::size_t kSmallPiece = 1024;

/// Each face's vertices, each once.
template <class Visit>
void forVerticesOf(std::span<const std::uint32_t> corners, std::size_t face, Visit visit) {
    const std::uint32_t a = corners[3 * face], b = corners[3 * face + 1], c = corners[3 * face + 2];
    visit(a);
    if (b != a) visit(b);
    if (c != a && c != b) visit(c);
}

/// In meshes of so many faces a component that has more than half of them is cut in two, which are ordered at the same time. The first is
/// round, so that they have few vertices in common: on average of three orders of the file 0.4 % more misses on the Bunny, 0.2 % fewer on a
/// scan of twice its size. In smaller ones the cut weighs more, 0.2 to 1.6 % in 15,000 faces, but where nearly all vertices have six faces
/// and strips run along it: 0.2 % in 16,000.
constexpr std::size_t kHalvedFaces = 40'000;
constexpr std::size_t kHalvedRegularFaces = 12'000;
constexpr std::size_t kFinelyHalvedFaces = 8'000;
constexpr double kRegular = 0.95;
constexpr std::size_t kLeastOfOther = 4; // a smaller share of the first piece in the second is not worth the cut

/// A search in breadth over the faces; what it reaches is numbered in the order of reaching, anew in each piece.
class Search {
public:
    Search(std::span<const std::uint32_t> indices, std::size_t vertexCount)
        : indices_(indices), around_(facesOfVertices(indices, vertexCount)), number_(vertexCount, 0), taken_(indices.size() / 3, 0) {}

    /// What is taken is written from the beginning of these on, which have room for all.
    void writeTo(std::span<std::uint32_t> corners, std::span<std::uint32_t> reached) {
        corners_ = corners.data();
        reached_ = reached.data();
    }

    [[nodiscard]] bool halved(Pieces::Cut cut) const {
        const std::size_t faces = taken_.size();
        if (cut == Pieces::Cut::Finely) return faces >= kFinelyHalvedFaces;
        return cut == Pieces::Cut::Components && (faces >= kHalvedFaces || (faces >= kHalvedRegularFaces && regular()));
    }

    /// All vertices, those of the fewest faces first: what is cut is searched from one of them, a corner of a border or the pole of what is
    /// regular elsewhere. So the halves do not depend on which face comes first in the file, and a rectangle is cut across.
    [[nodiscard]] std::vector<std::uint32_t> beginnings() const {
        constexpr std::uint32_t kMany = 15; // faces: all such vertices are alike
        std::array<std::uint32_t, kMany + 2> first{};
        const auto vertices = static_cast<std::uint32_t>(number_.size());
        for (std::uint32_t v = 0; v < vertices; ++v)
            ++first[std::min(around_.count(v), kMany) + 1];
        for (std::size_t i = 1; i < first.size(); ++i)
            first[i] += first[i - 1];
        std::vector<std::uint32_t> sorted(vertices);
        for (std::uint32_t v = 0; v < vertices; ++v)
            sorted[first[std::min(around_.count(v), kMany)]++] = v;
        return sorted;
    }
    /// Whose other faces are in the same component.
    [[nodiscard]] std::optional<std::size_t> someFaceOf(std::uint32_t vertex) const {
        return around_.count(vertex) > 0 ? std::optional<std::size_t>(around_.of(vertex).front()) : std::nullopt;
    }

    [[nodiscard]] bool taken(std::size_t face) const { return taken_[face] != 0; }
    [[nodiscard]] bool done() const { return faces_ == taken_.size(); }
    [[nodiscard]] Pieces::Start position() const { return {.face = faces_, .vertex = vertices_}; }

    /// Takes the faces that hang together with this one until there are `most` of all; vertices are numbered from `base` on. Gives the
    /// first face that is left. Plain pointers: this goes before all else, and bytes may alias whatever a vector holds.
    std::optional<std::size_t> spread(std::size_t face, std::size_t base, std::size_t most) {
        const std::uint32_t* const first = around_.first.data();
        const std::uint32_t* const faces = around_.faces.data();
        std::size_t next = vertices_;
        take(face, base);
        for (; next < vertices_; ++next) {
            const std::uint32_t vertex = reached_[next];
            for (std::uint32_t i = first[vertex], end = first[vertex + 1]; i < end; ++i) {
                const std::uint32_t f = faces[i];
                if (taken_[f]) continue;
                if (faces_ >= most) return f;
                take(f, base);
            }
        }
        return std::nullopt;
    }

    /// Forgets all that was taken since.
    void giveBack(const Pieces::Start& then) {
        for (std::size_t i = then.vertex; i < vertices_; ++i) {
            number_[reached_[i]] = 0;
            for (const std::uint32_t face : around_.of(reached_[i]))
                taken_[face] = 0;
        }
        faces_ = then.face;
        vertices_ = then.vertex;
    }

private:
    /// Whether nearly all vertices that lie on no border have six faces.
    [[nodiscard]] bool regular() const {
        std::size_t six = 0;
        std::size_t inside = 0;
        for (std::uint32_t v = 0; v < number_.size(); ++v) {
            six += around_.count(v) == 6;
            inside += around_.count(v) > 3;
        }
        return static_cast<double>(six) > kRegular * static_cast<double>(inside);
    }

    void take(std::size_t face, std::size_t base) {
        taken_[face] = 1;
        const std::uint32_t* const in = &indices_[3 * face];
        std::uint32_t* const out = corners_ + 3 * faces_++;
        out[0] = numberOf(in[0], base);
        out[1] = numberOf(in[1], base);
        out[2] = numberOf(in[2], base);
    }

    std::uint32_t numberOf(std::uint32_t vertex, std::size_t base) {
        std::uint32_t& number = number_[vertex];
        if (number <= base) { // not reached yet, or by a piece before
            reached_[vertices_++] = vertex;
            number = static_cast<std::uint32_t>(vertices_);
        }
        return static_cast<std::uint32_t>(number - 1 - base);
    }

    std::span<const std::uint32_t> indices_;
    VertexFaces around_;
    std::vector<std::uint32_t> number_; // one more than where in `reached_`
    std::vector<std::uint8_t> taken_;
    std::uint32_t* corners_ = nullptr;
    std::uint32_t* reached_ = nullptr;
    std::size_t faces_ = 0;    // taken
    std::size_t vertices_ = 0; // reached
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

Pieces::Pieces(std::span<const std::uint32_t> indices, std::size_t vertexCount, Cut cut) : corners_(indices.size()) {
    const std::size_t all = indices.size() / 3;
    Search search(indices, vertexCount);
    const bool halved = search.halved(cut);
    original_.resize(halved ? 2 * vertexCount : vertexCount); // what one half shares with the rest is there twice
    search.writeTo(corners_, original_);
    const auto gather = [&](std::size_t face) {
        if (search.taken(face)) return;
        const Start before = search.position();
        const bool full = cut != Cut::Nowhere && !pieces_.empty() && before.face - pieces_.back().face >= kSmallPiece;
        if (pieces_.empty() || full) pieces_.push_back(before);
        const Start own = pieces_.back();
        const std::size_t most = halved ? (all + 1) / 2 : all;
        const std::optional<std::size_t> left = search.spread(face, own.vertex, own.face + most);
        if (!left) return;
        const Start other = search.position();
        pieces_.push_back(other);
        search.spread(*left, other.vertex, all);
        if (kLeastOfOther * (search.position().face - other.face) >= most) return;
        pieces_.pop_back();
        search.giveBack(before);
        search.spread(face, own.vertex, all);
    };
    if (halved)
        for (const std::uint32_t vertex : search.beginnings()) {
            if (search.done()) break;
            if (const auto face = search.someFaceOf(vertex)) gather(*face);
        }
    for (std::size_t face = 0; face < all && !search.done(); ++face)
        gather(face);
    original_.resize(search.position().vertex);
}

Piece Pieces::piece(std::size_t i) const {
    const auto corners = cornersOf(i);
    const std::size_t vertices = end(i).vertex - pieces_[i].vertex;
    return {.corners = corners, .vertexCount = static_cast<std::uint32_t>(vertices), .around = facesOfVertices(corners, vertices)};
}

std::vector<std::vector<std::size_t>> Pieces::equals() const {
    std::vector<std::vector<std::size_t>> groups;
    std::unordered_map<std::string_view, std::size_t> known;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const auto corners = cornersOf(i);
        const std::string_view bytes(reinterpret_cast<const char*>(corners.data()), corners.size_bytes());
        const std::size_t group = known.try_emplace(bytes, groups.size()).first->second;
        if (group == groups.size()) groups.emplace_back();
        groups[group].push_back(i);
    }
    return groups;
}

void Pieces::restore(std::size_t i, std::span<const std::uint32_t> corners, std::span<std::uint32_t> out) const {
    const std::span numbers = std::span(original_).subspan(pieces_[i].vertex);
    for (std::size_t c = 0; c < corners.size(); ++c)
        out[3 * pieces_[i].face + c] = numbers[corners[c]];
}

} // namespace tegument::order
