// Links of texels that are too wide for the fifth Gaussian, read as the effect reads them, against integrals in closed form.

#include "meshprep/skin/skin_links.h"
#include "meshprep/skin/wide_texels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace tegument::test {

namespace {

constexpr std::array kWidths = {1.99, 7.41};
constexpr int kRow = 151; // of the map that light is read along
using Line = std::vector<double>;

/// A surface that is the same along y: a strip of quads over the map's u in `along` and v in `across`, x and z as functions of u.
void addStrip(Mesh& mesh, glm::dvec2 along, glm::dvec2 across, double length, const std::function<glm::dvec2(double u)>& xz) {
    constexpr int kQuads = 512;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i <= kQuads; ++i)
        for (int j = 0; j < 2; ++j) {
            const double u = std::lerp(along.x, along.y, static_cast<double>(i) / kQuads);
            const glm::dvec2 at = xz(u);
            mesh.positions.emplace_back(at.x, j * length, at.y);
            mesh.uvs.emplace_back(u, j == 0 ? across.x : across.y);
        }
    for (std::uint32_t i = 0; i < kQuads; ++i)
        for (const std::uint32_t index : {0U, 2U, 1U, 1U, 2U, 3U})
            mesh.indices.push_back(first + 2 * i + index);
}

/// Weights of the sources that count, of the list that each tile holds at this slot.
double sumAt(const SkinLinks& links, const glm::ivec2& slot, std::size_t gaussian, const std::function<bool(double v)>& counts) {
    double sum = 0;
    for (int k = 0; k < kMostLinks && k < links.tiles * links.tiles; ++k) {
        const int x = k % links.tiles * kLinkSide + slot.x;
        const int y = k / links.tiles * (links.sheet.height / links.tiles) + slot.y;
        if (links.sheet.at(x, y, 0) == 0) break;
        if (counts(std::abs(links.sheet.at(x, y, 1)))) sum += std::abs(links.sheet.at(x, y, static_cast<int>(2 + gaussian)));
    }
    return sum;
}

/// Twice as many along the line: bilinear look-ups.
Line finer(const Line& line) {
    Line twice(2 * line.size());
    const auto last = static_cast<int>(line.size()) - 1;
    for (int i = 0; i <= 2 * last + 1; ++i) {
        const int next = std::clamp(i / 2 + (i % 2 == 0 ? -1 : 1), 0, last);
        twice[static_cast<std::size_t>(i)] = 0.75 * line[static_cast<std::size_t>(i / 2)] + 0.25 * line[static_cast<std::size_t>(next)];
    }
    return twice;
}

/// Light along a row at 2048 places, if all sources that count send 1. `quarters`: as maps of 512 texels and more read the sheet; else only
/// the lists of whole texels.
Line readAlong(const SkinLinks& links, std::size_t gaussian, const std::function<bool(double v)>& counts, bool quarters) {
    const int tile = links.sheet.height / links.tiles;
    const auto where = [&](int x) { // of the quarters of a texel
        std::array<float, 4> found{};
        for (int c = 0; c < 4; ++c)
            found[static_cast<std::size_t>(c)] = links.sheet.at((links.tiles - 1) * kLinkSide + x, (links.tiles - 1) * tile + kRow, c);
        return found;
    };
    quarters = quarters && tile > kLinkSide;
    Line whole(kLinkSide);
    for (int x = 0; x < kLinkSide; ++x)
        if (!quarters || where(x)[3] < 0.5F) whole[static_cast<std::size_t>(x)] = sumAt(links, {x, kRow}, gaussian, counts);
    Line line = finer(whole);
    for (int x = 0; quarters && x < 2 * kLinkSide; ++x)
        if (const auto at = where(x / 2); at[1] > 0.5F)
            line[static_cast<std::size_t>(x)] +=
                sumAt(links, {2 * (at[1] - 1) + static_cast<float>(x % 2), kLinkSide + 2 * at[2]}, gaussian, counts);
    return finer(finer(line));
}

/// Skin over a flat, lit sheet, as far from it as a wave says: above an endless plane exp(-z^2 / 2v) of its light arrives, whatever the
/// slope of what receives it.
constexpr double kTexel = 3.2; // mm, of the links' map
double thickness(double u) {
    constexpr double kPeriod = 5; // texels
    return 4 + 1.5 * std::sin(2 * std::numbers::pi * u * kLinkSide / kPeriod);
}

Mesh wavyWall() {
    Mesh mesh;
    const auto x = [](double u) { return u * kLinkSide * kTexel; };
    constexpr double kLength = 0.12 * kLinkSide * kTexel;
    addStrip(mesh, {0.35, 0.65}, {0.53, 0.65}, kLength, [&](double u) { return glm::dvec2(x(u), thickness(u)); });
    addStrip(mesh, {0.35, 0.65}, {0.05, 0.17}, kLength, [&](double u) { return glm::dvec2(x(u), 0); });
    return mesh;
}

double wallError(const SkinLinks& links, std::size_t gaussian, bool quarters) {
    const Line line = readAlong(
        links, gaussian, [](double v) { return v < 0.5; }, quarters);
    double wrong = 0;
    double all = 0;
    for (std::size_t i = line.size() * 2 / 5; i < line.size() * 3 / 5; ++i) {
        const double z = thickness((static_cast<double>(i) + 0.5) / static_cast<double>(line.size()));
        const double truth = std::exp(-z * z / (2 * kWidths[gaussian]));
        wrong += (line[i] - truth) * (line[i] - truth);
        all += truth * truth;
    }
    return std::sqrt(wrong / all);
}

} // namespace

TEST(WideTexels, LightThroughAWallOfChangingThicknessIsReadRightBetweenTexels) {
    const auto links = makeSkinLinks(wavyWall());
    ASSERT_TRUE(links) << format(links.error());
    EXPECT_GT(links->quarters, 0U);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_LT(wallError(*links, i, true), i == 0 ? 0.055 : 0.025) << i << ": splines of 1.6 mm, and sources as wide; .037 and .015";
    EXPECT_GT(wallError(*links, 0, false), 0.2) << "whole texels alone do not know it";
}

TEST(WideTexels, NoLightIsLostOrDoubledWhereTexelsBecomeWide) {
    Mesh mesh; // flat; texels of 2.2 mm, from u = 1/2 on of 2.8 mm
    addStrip(mesh, {0.35, 0.65}, {0.53, 0.65}, 0.12 * kLinkSide * 2.5,
             [](double u) { return glm::dvec2(kLinkSide * (u < 0.5 ? 2 * (u - 0.5) : 3.2 * (u - 0.5)), 0); });
    const auto links = makeSkinLinks(mesh);
    ASSERT_TRUE(links) << format(links.error());
    ASSERT_GT(links->quarters, 0U);
    for (std::size_t gaussian = 0; gaussian < 2; ++gaussian) {
        const Line line = readAlong(
            *links, gaussian, [](double) { return true; }, true);
        for (std::size_t i = line.size() * 2 / 5; i < line.size() * 3 / 5; ++i)
            EXPECT_NEAR(line[i], 1, 0.02) << gaussian << ": " << i;
    }
}

TEST(WideTexels, MeshesWithoutThemHaveNoQuarters) {
    Mesh mesh;
    addStrip(mesh, {0.35, 0.65}, {0.53, 0.65}, 0.12 * kLinkSide * 2, [](double u) { return glm::dvec2(u * kLinkSide * 2, 0); });
    const auto links = makeSkinLinks(mesh);
    ASSERT_TRUE(links) << format(links.error());
    EXPECT_EQ(links->quarters, 0U);
    EXPECT_EQ(links->sheet.width, links->sheet.height);
}

} // namespace tegument::test
