// What the orders reach on generated meshes of 40,000 triangles. Independent bounds: meshoptimizer's orders, and the best that strips can
// do on a regular grid.

#include "meshprep/order/order.h"
#include "tests/order/meshes.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <map>

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

} // namespace
} // namespace tegument::order
