#pragma once
// A mesh cut into pieces that share no face and few vertices, numbered so that what is near on the surface is near in memory.

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tegument::order {

/// The faces round each vertex, in ascending order; a face that names a vertex twice is listed once.
struct VertexFaces {
    std::vector<std::uint32_t> first; // into `faces`, one more than there are vertices
    std::vector<std::uint32_t> faces;

    [[nodiscard]] std::uint32_t count(std::uint32_t vertex) const { return first[vertex + 1] - first[vertex]; }
    [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t vertex) const { return {&faces[first[vertex]], count(vertex)}; }
};

[[nodiscard]] VertexFaces facesOfVertices(std::span<const std::uint32_t> corners, std::size_t vertexCount);

/// What the orders work on: vertices 0 to vertexCount - 1, each named by some face.
struct Piece {
    std::span<const std::uint32_t> corners; // three to a face
    std::uint32_t vertexCount = 0;
    VertexFaces around;

    [[nodiscard]] std::uint32_t faceCount() const { return static_cast<std::uint32_t>(corners.size() / 3); }
    [[nodiscard]] std::span<const std::uint32_t, 3> face(std::uint32_t f) const { return corners.subspan(std::size_t{3} * f).first<3>(); }
};

/// The mesh, face by face as a search in breadth finds them. A piece is a component, or half of a large one; components of a few faces are
/// gathered.
class Pieces {
public:
    enum class Cut {
        Components, // and halves of large ones
        Finely,     // of smaller ones, too: costs up to 2 % of the order
        Whole,      // components, none halved
        Nowhere
    };
    Pieces(std::span<const std::uint32_t> indices, std::size_t vertexCount, Cut cut = Cut::Components);

    [[nodiscard]] std::size_t size() const { return pieces_.size(); }
    [[nodiscard]] Piece piece(std::size_t i) const;
    /// The pieces, those together that have the same corners, as the patches of a regular body and its screws do.
    [[nodiscard]] std::vector<std::vector<std::size_t>> equals() const;
    /// Writes a list of corners of piece i, with the vertices' own numbers.
    void restore(std::size_t i, std::span<const std::uint32_t> corners, std::span<std::uint32_t> out) const;
    /// Where the piece's first face lies among all faces.
    [[nodiscard]] std::size_t firstFace(std::size_t i) const { return pieces_[i].face; }

    /// Of a piece, in the lists of all.
    struct Start {
        std::size_t face = 0;
        std::size_t vertex = 0;
    };

private:
    [[nodiscard]] std::span<const std::uint32_t> cornersOf(std::size_t i) const {
        return std::span(corners_).subspan(3 * pieces_[i].face, 3 * (end(i).face - pieces_[i].face));
    }
    [[nodiscard]] Start end(std::size_t i) const {
        return i + 1 < pieces_.size() ? pieces_[i + 1] : Start{corners_.size() / 3, original_.size()};
    }

    std::vector<std::uint32_t> corners_;  // numbered from 0 in each piece
    std::vector<std::uint32_t> original_; // of each vertex, all pieces in one list
    std::vector<Start> pieces_;
};

} // namespace tegument::order
