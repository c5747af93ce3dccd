#include "meshprep/order/piece.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <tuple>

namespace tegument::order {
namespace {

/// Quads in two triangles each, their diagonals all the same way or, with a seed, by lot. `count` more vertices.
void addGrid(std::vector<std::uint32_t>& out, std::uint32_t side, std::uint32_t& count, unsigned seed = 0) {
    std::mt19937 random(seed);
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) {
            const std::uint32_t a = count + y * (side + 1) + x, b = a + 1, c = a + side + 1, d = c + 1;
            if (seed == 0 || random() % 2 == 0)
                out.insert(out.end(), {a, c, b, b, c, d});
            else
                out.insert(out.end(), {a, c, d, a, d, b});
        }
    count += (side + 1) * (side + 1);
}

std::vector<std::size_t> facesOfPieces(const Pieces& pieces) {
    std::vector<std::size_t> faces;
    for (std::size_t i = 0; i < pieces.size(); ++i)
        faces.push_back(pieces.piece(i).faceCount());
    return faces;
}

/// By the mesh alone: what is regular from 12,000 faces on, the rest from 40,000; finely, both from 8,000 on.
TEST(Pieces, are_halves_of_what_is_large) {
    using Cut = Pieces::Cut;
    for (const auto& [cut, side, seed, expected] :
         {std::tuple(Cut::Components, 76u, 0u, std::size_t{1}), std::tuple(Cut::Components, 80u, 0u, std::size_t{2}),
          std::tuple(Cut::Components, 80u, 1u, std::size_t{1}), std::tuple(Cut::Components, 140u, 1u, std::size_t{1}),
          std::tuple(Cut::Components, 144u, 1u, std::size_t{2}), std::tuple(Cut::Finely, 63u, 0u, std::size_t{1}),
          std::tuple(Cut::Finely, 64u, 0u, std::size_t{2}), std::tuple(Cut::Finely, 63u, 1u, std::size_t{1}),
          std::tuple(Cut::Finely, 64u, 1u, std::size_t{2}), std::tuple(Cut::Whole, 144u, 0u, std::size_t{1}),
          std::tuple(Cut::Nowhere, 144u, 0u, std::size_t{1})}) {
        std::vector<std::uint32_t> mesh;
        std::uint32_t vertices = 0;
        addGrid(mesh, side, vertices, seed);
        const auto faces = facesOfPieces(Pieces(mesh, vertices, cut));
        EXPECT_EQ(faces.size(), expected) << "side " << side << ", seed " << seed;
        EXPECT_EQ(faces[0], mesh.size() / 3 / expected) << "side " << side << ", seed " << seed;
    }
}

/// A machine's screws, with a plate between them.
TEST(Pieces, that_are_equal_are_told_together) {
    std::vector<std::uint32_t> mesh;
    std::uint32_t vertices = 0;
    for (const std::uint32_t side : {23u, 30u, 23u, 23u})
        addGrid(mesh, side, vertices);
    EXPECT_EQ(Pieces(mesh, vertices).equals(), (std::vector<std::vector<std::size_t>>{{0, 2, 3}, {1}}));
    std::swap(mesh[0], mesh[1]); // one triangle turned round
    EXPECT_EQ(Pieces(mesh, vertices).equals(), (std::vector<std::vector<std::size_t>>{{0}, {1}, {2, 3}}));
}

/// A component of 11,858 of 21,658 faces: cut at half of all it would leave 1,029.
TEST(Pieces, are_not_cut_where_little_would_be_left) {
    std::vector<std::uint32_t> mesh;
    std::uint32_t vertices = 0;
    addGrid(mesh, 77, vertices);
    addGrid(mesh, 70, vertices);
    auto faces = facesOfPieces(Pieces(mesh, vertices));
    std::ranges::sort(faces);
    EXPECT_EQ(faces, (std::vector<std::size_t>{std::size_t{2} * 70 * 70, std::size_t{2} * 77 * 77}));
}

/// What is given back and taken again is there once.
TEST(Pieces, hold_every_face_once) {
    for (const std::uint32_t second : {60u, 70u, 20u}) {
        std::vector<std::uint32_t> mesh;
        std::uint32_t vertices = 0;
        addGrid(mesh, 5, vertices);
        addGrid(mesh, 77, vertices);
        addGrid(mesh, second, vertices);
        const Pieces pieces(mesh, vertices);
        std::vector<std::uint32_t> restored(mesh.size());
        for (std::size_t i = 0; i < pieces.size(); ++i)
            pieces.restore(i, pieces.piece(i).corners, restored);
        const auto sorted = [](const std::vector<std::uint32_t>& corners) {
            std::vector<std::array<std::uint32_t, 3>> faces;
            for (std::size_t f = 0; f < corners.size(); f += 3)
                faces.push_back({corners[f], corners[f + 1], corners[f + 2]});
            std::ranges::sort(faces);
            return faces;
        };
        EXPECT_EQ(sorted(restored), sorted(mesh)) << "second grid of " << second;
    }
}

} // namespace
} // namespace tegument::order
