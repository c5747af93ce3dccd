// What the orders reach on generated meshes of 40,000 triangles. Independent bounds: meshoptimizer's orders, and the best that strips can
// do on a regular grid.

#include "meshprep/order/cache.h"
#include "meshprep/order/links.h"
#include "meshprep/order/order.h"
#include "meshprep/order/piece.h"
#include "tests/order/meshes.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <tuple>
#include <vector>

namespace tegument::order {
namespace {

using testing_order::loadTriangles;
using testing_order::shuffled;
using testing_order::Triangles;

class OrderFigures : public testing::TestWithParam<const char*> {
protected:
    static const Triangles& mesh() {
        static std::map<std::string, Triangles> meshes;
        const auto at = meshes.find(GetParam());
        return at != meshes.end() ? at->second : meshes.emplace(GetParam(), *loadTriangles(GetParam())).first->second;
    }

    static double acmr(const Triangles& of, Method method, const CacheModel& model) {
        const auto out = reorder(of.indices, of.positions.size(), method, model);
        EXPECT_TRUE(out);
        return measure(model, *out, of.positions.size()).acmr();
    }

    static double meshoptFifo(const Triangles& of, unsigned entries) {
        std::vector<std::uint32_t> out(of.indices.size());
        meshopt_optimizeVertexCacheFifo(out.data(), of.indices.data(), out.size(), of.positions.size(), entries);
        return measure(fifo(entries), out, of.positions.size()).acmr();
    }
};

INSTANTIATE_TEST_SUITE_P(Generated, OrderFigures, testing::Values("sphere:45", "terrain:141"), [](const auto& parameter) {
    const std::string what = parameter.param;
    return what.substr(0, what.find(':'));
});

/// Strips of k - 2 quads, each row of vertices read once ahead: (k - 1) / (2 (k - 2)) vertices per triangle of an endless grid. The margin
/// of 6 % is for strips that end at boundaries and at each other, every 14 to 30 of the 141 quads, and for rows that nothing reads ahead.
TEST_P(OrderFigures, of_the_best_are_within_six_percent_of_the_best_strips) {
    for (const std::uint32_t seed : {0u, 1u, 2u})
        for (const unsigned k : {16u, 24u, 32u})
            EXPECT_LE(acmr(shuffled(mesh(), seed), Method::Best, fifo(k)), 1.06 * (k - 1) / (2.0 * (k - 2)))
                << "entries " << k << ", seed " << seed;
}

TEST_P(OrderFigures, of_lin_and_yu_are_better_than_meshoptimizer_s_for_the_same_cache) {
    for (const unsigned k : {16u, 32u})
        EXPECT_LT(acmr(mesh(), Method::LinYu, fifo(k)), meshoptFifo(mesh(), k)) << k;
}

TEST_P(OrderFigures, of_hoppe_are_better_than_meshoptimizer_s_for_the_same_cache) {
    for (const unsigned k : {16u, 32u})
        EXPECT_LT(acmr(mesh(), Method::Hoppe, fifo(k)), meshoptFifo(mesh(), k)) << k;
}

/// The same paper twice, by two authors: within 2 %, for the dead ends are left differently.
TEST_P(OrderFigures, of_tipsify_are_those_of_meshoptimizer_s_tipsify) {
    for (const unsigned k : {16u, 32u})
        EXPECT_NEAR(acmr(mesh(), Method::Tipsify, fifo(k)) / meshoptFifo(mesh(), k), 1.0, 0.02) << k;
}

TEST_P(OrderFigures, do_not_depend_on_the_order_that_comes_in) {
    const double seed1 = acmr(shuffled(mesh(), 1), Method::Best, fifo(16));
    const double seed2 = acmr(shuffled(mesh(), 2), Method::Best, fifo(16));
    EXPECT_NEAR(seed1 / seed2, 1.0, 0.01) << "by chance only";
}

TEST_P(OrderFigures, of_the_best_for_warps_are_not_beaten_by_any_order_for_caches) {
    const auto best = reorder(mesh().indices, mesh().positions.size(), Method::Best, kWarp);
    const double warp = measure(kWarp, *best, mesh().positions.size()).atvr();
    for (const Method method : {Method::LinYu, Method::Hoppe, Method::Tipsify, Method::Meshopt}) {
        const auto other = reorder(mesh().indices, mesh().positions.size(), method, fifo(16));
        EXPECT_LE(warp, measure(kWarp, *other, mesh().positions.size()).atvr()) << name(method);
    }
    EXPECT_LT(warp, 1.66) << "24 vertices to 32 triangles, 1.5 per vertex, are the least for a round patch";
}

TEST_P(OrderFigures, of_the_best_for_lru_caches_are_better_than_meshoptimizer_s) {
    EXPECT_LT(acmr(mesh(), Method::Best, lru(16)), acmr(mesh(), Method::Meshopt, lru(16)));
}

using Indices = std::vector<std::uint32_t>;

std::size_t misses(const CacheModel& model, const Indices& indices) {
    return measure(model, indices, 100).misses;
}

int codeOf(std::string_view text) {
    const auto model = parseCacheModel(text);
    return model ? 0 : model.error().diagnostics.front().code;
}

TEST(CacheModels, are_written_as_they_are_named) {
    for (const CacheModel& model : {fifo(16), fifo(kLeastEntries), fifo(kMostEntries), lru(24), kWarp}) {
        const auto parsed = parseCacheModel(name(model));
        ASSERT_TRUE(parsed) << name(model);
        EXPECT_EQ(*parsed, model);
    }
}

TEST(CacheModels, of_other_texts_are_refused) {
    for (const char* text : {"", "fifo", "fifo:", "fifo:2", "fifo:1025", "fifo:16x", "fifo:-16", "LRU:16", "plru:16", "warp:32"})
        EXPECT_EQ(codeOf(text), 7040) << text;
}

TEST(CacheCosts, of_a_fifo_cache_ignore_hits) {
    // With three entries: 0 1 2 miss; 3 pushes 0 out although 0 was just used; then 0 misses.
    EXPECT_EQ(misses(fifo(3), {0, 1, 2, 0, 2, 3, 0, 2, 3}), 5u);
}

TEST(CacheCosts, of_an_lru_cache_keep_what_was_used_last) {
    // With three entries: 3 pushes 1 out, the one not used again.
    EXPECT_EQ(misses(lru(3), {0, 1, 2, 0, 2, 3, 0, 2, 3}), 4u);
}

TEST(CacheCosts, of_batches_start_anew_after_their_last_triangle) {
    Indices one;
    for (int i = 0; i < 33; ++i)
        one.insert(one.end(), {0, 1, 2});
    EXPECT_EQ(misses(kWarp, one), 6u);
}

TEST(CacheCosts, of_batches_start_anew_before_the_vertex_that_does_not_fit) {
    Indices fan; // 32 vertices fill the batch; the next triangle needs one more
    for (std::uint32_t i = 1; i <= 31; ++i)
        fan.insert(fan.end(), {0, i, i + 1});
    EXPECT_EQ(misses(kWarp, fan), 32u + 3u);
}

TEST(CacheCosts, of_a_fan_in_an_endless_cache_are_its_vertices) {
    Indices fan;
    for (std::uint32_t i = 1; i < 99; ++i)
        fan.insert(fan.end(), {0, i, i + 1});
    const CacheCost cost = measure(fifo(1024), fan, 1000);
    EXPECT_EQ(cost.misses, 100u);
    EXPECT_EQ(cost.vertices, 100u) << "vertices that no triangle names do not count";
    EXPECT_DOUBLE_EQ(cost.atvr(), 1.0);
    EXPECT_DOUBLE_EQ(cost.acmr(), 100.0 / 98.0);
}

TEST(CacheCosts, of_nothing_are_nothing) {
    const CacheCost cost = measure(fifo(16), {}, 0);
    EXPECT_EQ(cost.misses, 0u);
    EXPECT_EQ(cost.acmr(), 0.0);
    EXPECT_EQ(cost.atvr(), 0.0);
}

TEST(CacheCosts, agree_with_meshoptimizer_s_on_random_triangles) {
    std::mt19937 random(7);
    Indices indices(3000);
    for (std::uint32_t& index : indices)
        index = static_cast<std::uint32_t>(random() % 100);
    // Its count of a triangle's missing vertices, which decides where a batch ends, takes a repeated corner twice: none here.
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        indices[i + 1] = (indices[i] + 1 + indices[i + 1] % 49) % 100;
        indices[i + 2] = (indices[i] + 50 + indices[i + 2] % 49) % 100;
    }
    for (const CacheModel& model :
         {fifo(3), fifo(16), fifo(32), kWarp, CacheModel{.entries = 14, .batchVertices = 64, .batchTriangles = 128}}) {
        const auto theirs =
            meshopt_analyzeVertexCache(indices.data(), indices.size(), 100, model.entries, model.batchVertices, model.batchTriangles);
        EXPECT_EQ(misses(model, indices), theirs.vertices_transformed) << name(model);
    }
}

std::vector<std::uint32_t> links(const Indices& corners, std::uint32_t vertices) {
    return linkFaces({.corners = corners, .vertexCount = vertices, .around = facesOfVertices(corners, vertices)});
}

TEST(FaceLinks, join_the_same_side_run_both_ways) {
    // The side from 1 to 2 starts at corner 1 of the first face; from 2 to 1 at corner 3, the second face's first.
    EXPECT_EQ(links({0, 1, 2, 2, 1, 3}, 4), (Indices{kNoLink, 3, kNoLink, 1, kNoLink, kNoLink}));
}

TEST(FaceLinks, do_not_join_faces_that_are_seen_from_opposite_sides) {
    EXPECT_EQ(links({0, 1, 2, 1, 2, 3}, 4), Indices(6, kNoLink));
}

TEST(FaceLinks, of_degenerate_faces_do_not_exist) {
    EXPECT_EQ(links({0, 1, 2, 2, 1, 1, 1, 0, 0}, 3), Indices(9, kNoLink));
}

TEST(FaceLinks, of_two_faces_back_to_back_are_one) {
    const auto both = links({0, 1, 2, 0, 2, 1}, 3);
    EXPECT_EQ(std::ranges::count(both, kNoLink), 4);
}

TEST(FaceLinks, of_many_faces_on_one_side_are_pairs) {
    Indices book;
    for (std::uint32_t page = 0; page < 100; ++page)
        book.insert(book.end(), {page % 2, 1 - page % 2, page + 2});
    const auto all = links(book, 102);
    for (std::uint32_t corner = 0; corner < all.size(); ++corner) {
        if (corner % 3 != 0) {
            EXPECT_EQ(all[corner], kNoLink);
            continue;
        }
        ASSERT_NE(all[corner], kNoLink);
        EXPECT_EQ(all[all[corner]], corner);
        EXPECT_NE(all[corner] / 3 % 2, corner / 3 % 2) << "one from each side";
    }
}

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
