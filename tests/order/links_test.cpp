#include "meshprep/order/links.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tegument::order {
namespace {

using Indices = std::vector<std::uint32_t>;

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

} // namespace
} // namespace tegument::order
