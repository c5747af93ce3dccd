// Links of skin against integrals in closed form: planes, sheets, borders.

#include "host/mesh/triangles.h"
#include "meshprep/skin/link_cells.h"
#include "meshprep/skin/skin_links.h"
#include "meshprep/skin/wide_texels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <sys/resource.h>

namespace tegument::test {

namespace {

constexpr std::array kVariances = {1.99, 7.41};

/// A square of `side` mm at height z, over the square of the map with this corner and side.
void addSheet(Mesh& mesh, double side, double z, glm::dvec2 corner, double mapSide) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i < 4; ++i) {
        const glm::dvec2 at(i % 2, i / 2);
        mesh.positions.emplace_back((at.x - 0.5) * side, (at.y - 0.5) * side, z);
        mesh.uvs.emplace_back(corner + at * mapSide);
    }
    addGrid(mesh.indices, 1, 1, "abccbd", first);
}

/// What is left of a Gaussian for links: receivers of this side (mm) are read by a spline (docs/design/modules/Pyramid.md). How wide
/// sources are makes no difference.
double lessened(double variance, double receiver) {
    return variance - 0.25 * receiver * receiver;
}

/// Variance along an axis of what a texel of a pyramid gathers, in squares of its side: (1 - 1/4^n) / 2 of n reductions by 1 3 3 1, and the
/// base texel's own square.
constexpr double kGathered = 0.48;

struct Read {
    std::array<double, 2> sum{}; // of the weights
    glm::dvec2 uv{0};            // mean place of the sources, by the second weight
    std::size_t count = 0;
    std::array<double, 2> beyond{}; // weights of sources with v > 1/2
    std::array<double, 2> lit{};    // light that comes if all with u below a border send 1
};

/// The list of a texel, as the effect reads it: the last texel of the sheet says how many tiles there are.
Read listOf(const SkinLinks& links, int x, int y, double border = 1) {
    const Image& sheet = links.sheet;
    const int tiles = static_cast<int>(sheet.at(sheet.width - 1, sheet.height - 1, 0));
    Read read;
    for (int k = 0; k < kMostLinks; ++k) {
        const int u = k % tiles * kLinkSide + x;
        const int v = k / tiles * (sheet.height / tiles) + y;
        if (k >= tiles * tiles || sheet.at(u, v, 0) == 0) break;
        const glm::dvec2 uv(std::abs(sheet.at(u, v, 0)), std::abs(sheet.at(u, v, 1)));
        const std::array<double, 2> weight = {std::abs(sheet.at(u, v, 2)), std::abs(sheet.at(u, v, 3))};
        const int level = (sheet.at(u, v, 0) < 0 ? 1 : 0) + (sheet.at(u, v, 1) < 0 ? 2 : 0) + (sheet.at(u, v, 3) < 0 ? 4 : 0);
        const double source = std::ldexp(1.0, level) / 512; // its side
        for (std::size_t i = 0; i < 2; ++i) {
            read.sum[i] += weight[i];
            read.beyond[i] += uv.y > 0.5 ? weight[i] : 0;
            read.lit[i] += weight[i] * 0.5 * std::erfc((uv.x - border) / (source * std::sqrt(2 * kGathered)));
        }
        read.uv += weight[1] * uv;
        ++read.count;
    }
    read.uv /= read.sum[1];
    return read;
}

} // namespace

TEST(SkinLinks, TheMiddleOfALargePlaneGetsAllOfItsLight) {
    Mesh plane;
    addSheet(plane, 100, 0, {0.05, 0.05}, 0.9);
    const auto links = makeSkinLinks(plane);
    ASSERT_TRUE(links) << format(links.error());
    const Read read = listOf(*links, 128, 128);
    // Beyond 3.5 widths of the wider Gaussian exp(-6.1) = 0.2 % of it is lost, of the narrower one nothing.
    EXPECT_NEAR(read.sum[0], 1, 0.003);
    EXPECT_NEAR(read.sum[1], 1, 0.004);
    EXPECT_NEAR(read.uv.x, 128.5 / 256, 0.002) << "sources lie around the texel";
    EXPECT_NEAR(read.uv.y, 128.5 / 256, 0.002);
    EXPECT_GT(read.count, 10U);
    EXPECT_LE(read.count, static_cast<std::size_t>(kMostLinks));
}

TEST(SkinLinks, ALargeBodyLosesNoLightThoughItsTexelsAreWiderThanLightSpreads) {
    for (const double side : {300.0, 1000.0, 10000.0}) { // mm to the map: texels of 1.2 to 39 mm
        Mesh plane;
        addSheet(plane, 0.4 * side, 0, {0.3, 0.3}, 0.4);
        const auto links = makeSkinLinks(plane);
        ASSERT_TRUE(links) << format(links.error());
        for (const int at : {100, 128, 131}) {
            const Read read = listOf(*links, at, 128);
            // 1.1 % by the sum over cells, and 0.4 % beyond the reach.
            EXPECT_NEAR(read.sum[0], 1, 0.015) << side << " mm, at " << at;
            EXPECT_NEAR(read.sum[1], 1, 0.015) << side << " mm, at " << at;
        }
    }
}

TEST(SkinLinks, TheBorderOfLightIsAsWideAsTheGaussianThoughSourcesAreWide) {
    constexpr double kSide = 200;      // mm to the map: near sources are 0.8 mm large
    constexpr double kMeasured = 0.03; // 0.025: least squares over sources whose sizes double from one to the next; without them 0.042
    Mesh plane;
    addSheet(plane, 0.5 * kSide, 0, {0.25, 0.25}, 0.5);
    const auto links = makeSkinLinks(plane);
    ASSERT_TRUE(links) << format(links.error());
    for (const int at : {120, 127})
        for (const double away : {-4.0, -2.0, -1.0, 0.0, 0.7, 1.5, 3.0}) { // of the border from the texel, mm
            const Read read = listOf(*links, at, 128, (at + 0.5) / kLinkSide + away / kSide);
            for (std::size_t i = 0; i < 2; ++i)
                EXPECT_NEAR(read.lit[i], 0.5 * std::erfc(-away / std::sqrt(2 * lessened(kVariances[i], kSide / kLinkSide))), kMeasured)
                    << at << " " << i << " " << away << " mm";
        }
}

// Across a gap nothing is interpolated: what a receiver's side takes from the Gaussian in its plane it must not take there.
TEST(SkinLinks, LightDiesAwayAcrossAGapAsTheGaussianDoesHoweverWideTheReceiver) {
    constexpr double kApart = 2.5;                   // mm
    constexpr double kShare = 0.2;                   // of the map's side: what lies farther from the middle brings nothing
    for (const double side : {45.0, 150.0, 300.0}) { // mm in .45 of it: receivers of 0.4, 1.3 and 2.6 mm
        Mesh sheets;
        addSheet(sheets, side * kShare / 0.45, 0, {0.02, 0.02}, kShare);
        addSheet(sheets, side * kShare / 0.45, kApart, {0.02, 0.53}, kShare);
        const auto links = makeSkinLinks(sheets);
        ASSERT_TRUE(links) << format(links.error());
        const int middle = static_cast<int>((0.02 + 0.5 * kShare) * kLinkSide);
        const Read read = listOf(*links, middle, middle);
        for (std::size_t i = 0; i < 2; ++i) {
            const double expected = std::exp(-kApart * kApart / (2 * kVariances[i]));
            EXPECT_NEAR(read.beyond[i] / (read.sum[i] - read.beyond[i]), expected, 0.03) << side << " mm, " << i;
            EXPECT_NEAR(read.sum[i], 1 + expected, 0.03) << side << " mm, not normalised: the other sheet adds to the light";
        }
    }
}

TEST(SkinLinks, HalfOfTheLightReachesTheBorderAndLessWhatLiesBeyond) {
    Mesh plane;
    addSheet(plane, 100, 0, {0.0, 0.25}, 0.5); // ends at u = 1/2, a texel's border, and at v = 1/4
    const auto links = makeSkinLinks(plane);
    ASSERT_TRUE(links) << format(links.error());
    const double texel = 100.0 / 128; // mm
    for (const int beyond : {-3, -1, 0, 1}) {
        const double away = (beyond + 0.5) * texel; // of the texel's middle from the border
        const Read read = listOf(*links, 128 + beyond, 128);
        for (std::size_t i = 0; i < 2; ++i)
            EXPECT_NEAR(read.sum[i], 0.5 * std::erfc(away / std::sqrt(2 * lessened(kVariances[i], texel))), 0.025) << beyond << " " << i;
    }
    EXPECT_EQ(listOf(*links, 128 + 3, 128).count, 0U) << "nothing farther out";
}

/// Two halves of a plane, each in a chart of its own.
Mesh cutPlane(double side) {
    Mesh mesh;
    addSheet(mesh, side, 0, {0.02, 0.02}, 0.45);
    addSheet(mesh, side, 0, {0.02, 0.53}, 0.45);
    for (std::size_t i = 4; i < 8; ++i)
        mesh.positions[i].x += static_cast<float>(side);
    return mesh;
}

TEST(SkinLinks, WhatPyramidsMissOfTheFourthGaussianBeyondTheBorderOfAChartComesAlongWithTheFifth) {
    constexpr double kSide = 45;
    const LinkOptions options;
    const auto links = makeSkinLinks(cutPlane(kSide), options);
    ASSERT_TRUE(links) << format(links.error());
    const double texel = kSide / 0.45 / kLinkSide;
    for (const int x : {110, 117, 118, 119, 120, 121}) {
        const double away = (0.47 * kLinkSide - x - 0.5) * texel; // of the border from the texel's middle
        const Read read = listOf(*links, x, 62);
        const double beyond = 0.5 * std::erfc(away / std::sqrt(2 * lessened(options.fourth, texel)));
        EXPECT_NEAR(read.sum[0], 1 + options.fourthShare * beyond, 0.02) << away << " mm";
        EXPECT_NEAR(read.sum[1], 1, 0.02) << away << " mm";
    }
}

TEST(SkinLinks, WhatTheMeshCallsNoSkinSendsNothing) {
    Mesh plane;
    addSheet(plane, 100, 0, {0, 0}, 1);
    Image color{.width = 2, .height = 1, .channels = 4, .pixels = {1, 1, 1, 1, 1, 1, 1, 0}, .metadata = {}};
    plane.textures.push_back({.role = "color", .image = color});
    const auto links = makeSkinLinks(plane);
    ASSERT_TRUE(links) << format(links.error());
    EXPECT_NEAR(listOf(*links, 64, 128).sum[1], 1, 0.02);
    EXPECT_EQ(listOf(*links, 192, 128).count, 0U);
}

/// A plane cut into squares, each a chart of its own, in any order.
Mesh shreddedPlane(int along, double side) {
    Mesh mesh;
    std::vector<int> order(static_cast<std::size_t>(along * along));
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937(7));
    for (std::size_t i = 0; i < order.size(); ++i) {
        const int k = static_cast<int>(i);
        const glm::dvec2 slot = (glm::dvec2(order[i] % along, order[i] / along) + 0.125) / static_cast<double>(along);
        const std::size_t first = mesh.positions.size();
        addSheet(mesh, side / along, 0, slot, 0.75 / along);
        for (std::size_t v = first; v < mesh.positions.size(); ++v)
            mesh.positions[v] += glm::vec3((k % along + 0.5) * side / along, (k / along + 0.5) * side / along, 0);
    }
    return mesh;
}

long peakMegabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
}

TEST(SkinLinks, MapsOfThousandsOfChartsTakeNoMoreMemoryAndBringTheirLight) {
    for (const auto& [along, side] : {std::pair(24, 60.0), std::pair(64, 120.0), std::pair(64, 20.0)}) {
        const Mesh mesh = shreddedPlane(along, side);
        const long before = peakMegabytes();
        const auto links = makeSkinLinks(mesh);
        ASSERT_TRUE(links) << format(links.error());
        EXPECT_LT(peakMegabytes() - before, 400) << along << " charts along a side of " << side << " mm";
        std::size_t probes = 0;
        double sum = 0;
        for (int y = 2; y < kLinkSide; y += 12)
            for (int x = 2; x < kLinkSide; x += 12) {
                const Read read = listOf(*links, x, y);
                if (read.count == 0) continue;
                EXPECT_LE(read.count, static_cast<std::size_t>(kMostLinks));
                ++probes;
                sum += read.sum[0];
            }
        ASSERT_GT(probes, 50U);
        // Of the narrower Gaussian, which ends at the plane's border: within 9 mm of it some is lost.
        EXPECT_NEAR(sum / static_cast<double>(probes), side > 30 ? 0.97 : 0.87, 0.08)
            << along << " charts along a side of " << side << " mm";
    }
}

TEST(SkinLinks, ScatteredChartsOfWideTexelsAskForNoMoreListsThanTheyMay) {
    const auto links = makeSkinLinks(shreddedPlane(32, 700)); // texels of 2.7 mm, two thirds of them at borders
    ASSERT_TRUE(links) << format(links.error());
    ASSERT_EQ(links->warnings.size(), 1U);
    EXPECT_EQ(links->warnings.front().code, 7045) << "TG7045";
    EXPECT_LE(links->quarters, 4 * kMostScatteredBlocks);
    Mesh plane; // as wide, and one chart
    addSheet(plane, 350, 0, {0.25, 0.25}, 0.5);
    const auto whole = makeSkinLinks(plane);
    ASSERT_TRUE(whole) << format(whole.error());
    EXPECT_TRUE(whole->warnings.empty());
    EXPECT_GT(whole->quarters, 4 * kMostScatteredBlocks);
}

TEST(SkinLinks, MeshesWithoutTextureCoordinatesAreRefused) {
    Mesh plane;
    addSheet(plane, 100, 0, {0, 0}, 1);
    plane.uvs.clear();
    const auto links = makeSkinLinks(plane);
    ASSERT_FALSE(links);
    EXPECT_EQ(links.error().diagnostics.front().code, 7044) << "TG7044";
}

TEST(SkinLinks, TheyAreTheSameWithAnyNumberOfThreads) {
    Mesh plane;
    addSheet(plane, 22, 0, {0.1, 0.1}, 0.3);
    const auto one = makeSkinLinks(plane, {.threads = 1});
    const auto many = makeSkinLinks(plane, {.threads = 3});
    ASSERT_TRUE(one && many);
    EXPECT_TRUE(one->sheet.pixels == many->sheet.pixels);
}

} // namespace tegument::test
