#include "meshprep/order/order.h"
#include "meshprep/order/portfolio.h"

#include <gtest/gtest.h>

#include <meshoptimizer.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace tegument::order {
namespace {

using Indices = std::vector<std::uint32_t>;

constexpr Method kMethods[] = {Method::LinYu, Method::Hoppe, Method::Tipsify, Method::Meshopt, Method::Best};
constexpr CacheModel kModels[] = {fifo(3), fifo(16), fifo(64), lru(16), kWarp};

struct Input {
    const char* name;
    Indices indices;
    std::size_t vertices = 0;
};

Indices grid(std::uint32_t side) {
    Indices out;
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) {
            const std::uint32_t a = y * (side + 1) + x;
            const std::uint32_t c = a + side + 1;
            out.insert(out.end(), {a, c, a + 1, a + 1, c, c + 1});
        }
    return out;
}

Indices fan(std::uint32_t valence) {
    Indices out;
    for (std::uint32_t i = 0; i < valence; ++i)
        out.insert(out.end(), {0, 1 + i, 1 + (i + 1) % valence});
    return out;
}

/// Corners anywhere: every edge crowded, corners repeated, triangles repeated.
Indices soup(std::size_t faces, std::uint32_t vertices) {
    std::mt19937 random(5);
    Indices out(3 * faces);
    for (std::uint32_t& index : out)
        index = static_cast<std::uint32_t>(random() % vertices);
    return out;
}

Indices twice(Indices indices) {
    const Indices once = indices;
    indices.insert(indices.end(), once.begin(), once.end());
    return indices;
}

/// Every triangle and the same seen from behind.
Indices doubled(Indices indices) {
    const Indices front = indices;
    for (std::size_t i = 0; i < front.size(); i += 3)
        indices.insert(indices.end(), {front[i], front[i + 2], front[i + 1]});
    return indices;
}

std::vector<Input> hardInputs() {
    return {{"nothing", {}, 0},
            {"vertices without triangles", {}, 5},
            {"one triangle", {2, 1, 0}, 3},
            {"one triangle among many vertices", {900, 7, 30}, 1000},
            {"a triangle of one vertex", {0, 0, 0, 0, 1, 2}, 3},
            {"triangles of two vertices", {0, 1, 0, 1, 1, 2, 3, 2, 2, 0, 1, 2}, 4},
            {"a triangle many times", Indices(300, 4), 5},
            {"a grid", grid(20), 441},
            {"a grid twice", twice(grid(12)), 169},
            {"a grid seen from both sides", doubled(grid(12)), 169},
            {"a fan", fan(3000), 3001},
            {"a book of pages on one edge",
             [] {
                 Indices book;
                 for (std::uint32_t i = 2; i < 2000; ++i)
                     book.insert(book.end(), {i % 2, 1 - i % 2, i});
                 return book;
             }(),
             2000},
            {"a soup", soup(3000, 500), 500},
            {"a soup of few vertices", soup(3000, 8), 8},
            {"unconnected triangles",
             [] {
                 Indices all(9000);
                 for (std::uint32_t i = 0; i < all.size(); ++i)
                     all[i] = i;
                 return all;
             }(),
             9000}};
}

TEST(Orders, keep_every_triangle_and_its_winding) {
    for (const Input& input : hardInputs())
        for (const Method method : kMethods)
            for (const CacheModel& model : kModels) {
                const auto out = reorder(input.indices, input.vertices, method, model);
                ASSERT_TRUE(out) << input.name;
                EXPECT_TRUE(samePermutation(input.indices, *out)) << input.name << ", " << name(method) << ", " << name(model);
            }
}

TEST(Orders, are_never_worse_than_what_came_in_when_the_best_is_asked_for) {
    for (const Input& input : hardInputs())
        for (const CacheModel& model : kModels) {
            const auto out = reorder(input.indices, input.vertices, Method::Best, model);
            ASSERT_TRUE(out) << input.name;
            EXPECT_LE(measure(model, *out, input.vertices).misses, measure(model, input.indices, input.vertices).misses) << input.name;
        }
}

/// Round lids of all sizes, each a component, with triangles turned at random: a figure with eyes, teeth and buckles.
Indices pieces(std::uint32_t& vertices) {
    std::mt19937 random(22);
    Indices out;
    vertices = 0;
    for (const std::uint32_t side : {70u, 30u, 41u, 9u, 9u, 5u, 26u, 3u, 2u, 33u, 12u, 50u}) {
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x) {
                const std::uint32_t a = vertices + y * (side + 1) + x;
                const std::uint32_t b = a + 1, c = a + side + 1, d = c + 1;
                if (random() % 2 == 0)
                    out.insert(out.end(), {a, c, b, b, c, d});
                else
                    out.insert(out.end(), {a, c, d, a, d, b});
            }
        vertices += (side + 1) * (side + 1);
    }
    return out;
}

Indices shuffled(const Indices& indices, std::uint32_t vertices, unsigned seed) {
    std::mt19937 random(seed);
    Indices numbers(vertices), faces(indices.size() / 3), out;
    std::iota(numbers.begin(), numbers.end(), 0u);
    std::iota(faces.begin(), faces.end(), 0u);
    std::ranges::shuffle(numbers, random);
    std::ranges::shuffle(faces, random);
    for (const std::uint32_t f : faces)
        for (std::size_t c = 0; c < 3; ++c)
            out.push_back(numbers[indices[3 * f + c]]);
    return out;
}

/// Every order of the library, and meshoptimizer's called as its users do, on the list as it came.
std::size_t fewestOfOthers(const Indices& indices, std::uint32_t vertices, const CacheModel& model) {
    std::size_t fewest = measure(model, indices, vertices).misses;
    for (const Method method : {Method::LinYu, Method::Hoppe, Method::Tipsify, Method::Meshopt})
        fewest = std::min(fewest, measure(model, *reorder(indices, vertices, method, model), vertices).misses);
    Indices out(indices.size());
    meshopt_optimizeVertexCache(out.data(), indices.data(), indices.size(), vertices);
    fewest = std::min(fewest, measure(model, out, vertices).misses);
    meshopt_optimizeVertexCacheStrip(out.data(), indices.data(), indices.size(), vertices);
    fewest = std::min(fewest, measure(model, out, vertices).misses);
    meshopt_optimizeVertexCacheFifo(out.data(), indices.data(), indices.size(), vertices, model.entries);
    return std::min(fewest, measure(model, out, vertices).misses);
}

TEST(Orders, of_meshes_of_many_pieces_are_never_worse_than_another_s_when_the_best_is_asked_for) {
    std::uint32_t vertices = 0;
    const Indices mesh = pieces(vertices);
    for (const Indices& input : {mesh, shuffled(mesh, vertices, 1), shuffled(mesh, vertices, 2)})
        for (const CacheModel& model : {fifo(16), fifo(24), fifo(32), lru(16), kWarp}) {
            const auto out = reorder(input, vertices, Method::Best, model);
            ASSERT_TRUE(out);
            EXPECT_LE(measure(model, *out, vertices).misses, fewestOfOthers(input, vertices, model)) << name(model);
        }
}

TEST(Orders, of_shuffled_pieces_are_as_good_within_one_per_cent) {
    std::uint32_t vertices = 0;
    const Indices mesh = pieces(vertices);
    for (const CacheModel& model : {fifo(16), lru(16), kWarp}) {
        const auto misses = [&](const Indices& input) {
            return static_cast<double>(measure(model, *reorder(input, vertices, Method::Best, model), vertices).misses);
        };
        const double asItCame = misses(mesh);
        for (const unsigned seed : {1u, 2u, 3u})
            EXPECT_LE(misses(shuffled(mesh, vertices, seed)), 1.01 * asItCame) << name(model) << ", seed " << seed;
    }
}

/// Halves of a large component are ordered at the same time: nothing is lost where they meet, and who orders them does not matter. A quad
/// grid in strips of 14 quads: 15/14 runs per vertex; 3 % for ends of strips and the border between the halves.
TEST(Orders, of_a_large_component_s_halves_are_one_good_order) {
    constexpr std::uint32_t kSide = 230;
    constexpr std::size_t kVertices = std::size_t{kSide + 1} * (kSide + 1);
    const Indices mesh = grid(kSide);
    ASSERT_GT(mesh.size() / 3, 100'000u);
    const auto out = reorder(mesh, kVertices, Method::Best, fifo(16));
    ASSERT_TRUE(out);
    EXPECT_TRUE(samePermutation(mesh, *out));
    EXPECT_LE(measure(fifo(16), *out, kVertices).atvr(), 1.03 * 15 / 14);
    const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(*reorder(mesh, kVertices, Method::Best, fifo(16)), *out);
}

/// A machine's screws: the second costs no order of its own, and gets the same one. A list known already is still refused when its vertices
/// are too few.
TEST(Orders, of_parts_that_are_equal_are_those_of_each_by_itself) {
    const Indices screw = shuffled(grid(20), 441, 1);
    const Indices other = shuffled(grid(20), 441, 2);
    for (const CacheModel& model : {fifo(16), lru(16), kWarp}) {
        PartsReorder parts(Method::Best, model);
        for (const Indices* part : {&screw, &other, &screw, &other})
            EXPECT_EQ(*parts(*part, 441), *reorder(*part, 441, Method::Best, model)) << name(model);
        EXPECT_EQ(parts(screw, 440).error().diagnostics.front().code, 7042);
    }
}

/// The same triangles at other places: where sorting by place is among what is tried, each part is judged with its own.
TEST(Orders, of_equal_parts_whose_places_take_part_are_those_of_each_by_itself) {
    constexpr std::uint32_t kSide = 12;
    constexpr std::uint32_t kVertices = (kSide + 1) * (kSide + 1);
    const Indices part = soup(600, kVertices);
    std::vector<float> along, across;
    for (std::uint32_t v = 0; v < kVertices; ++v) {
        along.insert(along.end(), {static_cast<float>(v), 0, 0});
        across.insert(across.end(), {static_cast<float>(v * 37 % kVertices), static_cast<float>(v * 59 % kVertices), 0});
    }
    ASSERT_NE(*reorder(part, kVertices, Method::Best, lru(16), along), *reorder(part, kVertices, Method::Best, lru(16), across));
    PartsReorder parts(Method::Best, lru(16));
    for (const std::vector<float>* places : {&along, &across})
        EXPECT_EQ(*parts(part, kVertices, *places), *reorder(part, kVertices, Method::Best, lru(16), *places));
}

TEST(Orders, of_the_same_input_are_the_same) {
    const Indices input = soup(2000, 700);
    for (const Method method : kMethods)
        EXPECT_EQ(*reorder(input, 700, method, fifo(16)), *reorder(input, 700, method, fifo(16))) << name(method);
}

TEST(Orders, refuse_an_index_that_names_no_vertex) {
    const Indices input = {0, 1, 2, 2, 1, 3};
    const auto out = reorder(input, 3, Method::Best, fifo(16));
    ASSERT_FALSE(out);
    EXPECT_EQ(out.error().diagnostics.front().code, 7042);
    EXPECT_EQ(out.error().diagnostics.front().text, "triangle 1 names vertex 3 of 3");
}

TEST(Orders, refuse_a_list_that_is_not_of_triangles) {
    const Indices input = {0, 1, 2, 0};
    const auto out = reorder(input, 3, Method::Best, fifo(16));
    ASSERT_FALSE(out);
    EXPECT_EQ(out.error().diagnostics.front().code, 7042);
}

TEST(Orders, are_written_as_they_are_named) {
    for (const Method method : kMethods) {
        const auto parsed = parseMethod(name(method));
        ASSERT_TRUE(parsed);
        EXPECT_EQ(*parsed, method);
    }
}

TEST(Orders, of_other_names_are_refused) {
    for (const char* text : {"", "linyu", "Best", "forsyth"}) {
        const auto parsed = parseMethod(text);
        ASSERT_FALSE(parsed) << text;
        EXPECT_EQ(parsed.error().diagnostics.front().code, 7041);
    }
}

TEST(SamePermutation, sees_a_lost_triangle_a_repeated_one_and_a_turned_winding) {
    const Indices two = {0, 1, 2, 2, 1, 3};
    EXPECT_TRUE(samePermutation(two, Indices{1, 3, 2, 1, 2, 0}));
    EXPECT_FALSE(samePermutation(two, Indices{0, 1, 2}));
    EXPECT_FALSE(samePermutation(two, Indices{0, 1, 2, 0, 1, 2}));
    EXPECT_FALSE(samePermutation(two, Indices{0, 1, 2, 1, 2, 3}));
}

TEST(BetterSorted, takes_the_order_by_place_where_it_misses_less_and_only_there) {
    constexpr std::uint32_t kSide = 40;
    const Indices indices = grid(kSide);
    constexpr std::size_t kVertices = std::size_t{kSide + 1} * (kSide + 1);
    std::vector<float> places;
    for (std::uint32_t y = 0; y <= kSide; ++y)
        for (std::uint32_t x = 0; x <= kSide; ++x)
            places.insert(places.end(), {static_cast<float>(x), static_cast<float>(y), 0});
    Indices faces(indices.size() / 3), random;
    std::iota(faces.begin(), faces.end(), 0U);
    std::ranges::shuffle(faces, std::mt19937(5));
    for (const std::uint32_t face : faces)
        random.insert(random.end(), indices.begin() + 3 * face, indices.begin() + 3 * face + 3);
    for (const CacheModel& cache : {fifo(16), lru(16)}) {
        const Indices best = bestOrder(indices, kVertices, cache).corners;
        EXPECT_LE(countMisses(cache, betterSorted(best, indices, kVertices, cache, places), kVertices),
                  countMisses(cache, best, kVertices));
        EXPECT_LT(countMisses(cache, betterSorted(random, indices, kVertices, cache, places), kVertices),
                  countMisses(cache, random, kVertices) / 2)
            << "a random order misses at nearly every corner";
    }
}

} // namespace
} // namespace tegument::order
