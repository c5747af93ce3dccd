// Times that hold on any machine: against meshoptimizer in the same run, and for vertices of very many triangles.

#include "meshprep/order/order.h"
#include "tests/order/meshes.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <ctime>
#include <limits>
#include <random>

namespace tegument::order {
namespace {

using testing_order::loadTriangles;
using testing_order::shuffled;
using testing_order::Triangles;

double processorSeconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <class Work>
double secondsOf(Work work) {
    const double start = processorSeconds();
    work();
    return processorSeconds() - start;
}

struct Times {
    double ours = std::numeric_limits<double>::infinity();
    double meshoptimizer = ours;
};

/// The least of three, interleaved.
Times timesFor(const Triangles& mesh, const CacheModel& model) {
    std::vector<std::uint32_t> out(mesh.indices.size());
    Times least;
    for (int i = 0; i < 3; ++i) {
        least.meshoptimizer =
            std::min(least.meshoptimizer,
                     secondsOf([&] { meshopt_optimizeVertexCache(out.data(), mesh.indices.data(), out.size(), mesh.positions.size()); }));
        least.ours =
            std::min(least.ours, secondsOf([&] { EXPECT_TRUE(reorder(mesh.indices, mesh.positions.size(), Method::Best, model)); }));
    }
    return least;
}

TEST(OrderTimes, of_the_best_are_at_most_four_to_five_times_meshoptimizer_s) {
    const auto dragon = loadTriangles("dragon_vrip.ply");
    if (!dragon) GTEST_SKIP() << "no dragon_vrip.ply (docs/meshprep.md says where it comes from)";
    for (const CacheModel& model : {fifo(16), fifo(24), fifo(32), kWarp}) {
        const Times inOrder = timesFor(*dragon, model);
        EXPECT_LE(inOrder.ours, 5 * inOrder.meshoptimizer) << name(model) << ", in the file's order";
        const Times random = timesFor(shuffled(*dragon, 1), model);
        EXPECT_LE(random.ours, 4 * random.meshoptimizer) << name(model) << ", shuffled";
    }
}

/// Grids with diagonals by lot, so many; all as the first one or each as it comes.
std::vector<std::uint32_t> grids(std::uint32_t count, bool equal) {
    constexpr std::uint32_t kSide = 32;
    std::vector<std::uint32_t> out;
    std::mt19937 random(22);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (equal) random.seed(22);
        for (std::uint32_t quad = 0; quad < kSide * kSide; ++quad) {
            const std::uint32_t a = (i * (kSide + 1) + quad / kSide) * (kSide + 1) + quad % kSide, b = a + 1, c = b + kSide, d = c + 1;
            if (random() % 2 == 0)
                out.insert(out.end(), {a, c, b, b, c, d});
            else
                out.insert(out.end(), {a, c, d, a, d, b});
        }
    }
    return out;
}

/// The twenty patches of a sphere, a machine's screws: the search and the counts are for all, the order for one.
TEST(OrderTimes, of_equal_pieces_are_half_of_those_of_as_many_others_at_most) {
    constexpr std::uint32_t kCount = 40;
    constexpr std::size_t kVertices = std::size_t{kCount} * 33 * 33;
    const std::vector<std::uint32_t> equal = grids(kCount, true);
    const std::vector<std::uint32_t> different = grids(kCount, false);
    double ofEqual = std::numeric_limits<double>::infinity();
    double ofDifferent = ofEqual;
    for (int i = 0; i < 5; ++i) {
        ofEqual = std::min(ofEqual, secondsOf([&] { EXPECT_TRUE(reorder(equal, kVertices, Method::Best, fifo(16))); }));
        ofDifferent = std::min(ofDifferent, secondsOf([&] { EXPECT_TRUE(reorder(different, kVertices, Method::Best, fifo(16))); }));
    }
    EXPECT_LE(ofEqual, 0.5 * ofDifferent);
}

TEST(OrderTimes, for_a_fan_of_100000_triangles_are_at_most_a_tenth_of_a_second) {
    constexpr std::uint32_t kValence = 100'000;
    std::vector<std::uint32_t> fan;
    for (std::uint32_t i = 0; i < kValence; ++i)
        fan.insert(fan.end(), {0, 1 + i, 1 + (i + 1) % kValence});
    for (const Method method : {Method::LinYu, Method::Hoppe, Method::Tipsify, Method::Meshopt, Method::Best})
        for (const CacheModel& model : {fifo(16), fifo(32), kWarp}) {
            double least = std::numeric_limits<double>::infinity();
            for (int i = 0; i < 3; ++i)
                least = std::min(least, secondsOf([&] { EXPECT_TRUE(reorder(fan, kValence + 1, method, model)); }));
            EXPECT_LE(least, 0.1) << name(method) << ", " << name(model);
        }
}

} // namespace
} // namespace tegument::order
