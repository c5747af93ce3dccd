#include "meshprep/order/cache.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <random>
#include <vector>

namespace tegument::order {
namespace {

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

} // namespace
} // namespace tegument::order
