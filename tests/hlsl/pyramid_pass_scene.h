#pragma once
// The ladder's table, the metric and the maps that cases of the pyramid's passes read, and what a level weighs by them
// (docs/design/modules/Ladder.md, Pyramid.md).

#include "tests/hlsl/skin_scene.h"

namespace tegument::test {

/// Texels of the metric along U: densities from below what is told apart to above it; w: whether a chart is near.
inline constexpr int kMetricTexels = 8;

[[nodiscard]] const TestMap& ladderTable();
[[nodiscard]] const TestMap& metricRow();
/// Light that enters times coverage, and coverage: of map 0 along U.
[[nodiscard]] const TestMap& entryRow();
/// Of the maps of the other levels, everywhere.
[[nodiscard]] glm::dvec4 entryOf(int level);
[[nodiscard]] glm::dvec4 lightOf(int level);

/// What the table has in a row at a density: it rises evenly along its columns.
[[nodiscard]] glm::dvec3 ladderAt(double row, double density);
/// Share of the fifth Gaussian that levels bring: as texels of the links' map, mapSize / 256 of the base each, grow from 2.6 to 3.4 mm, or
/// from 5.2 to 6.8 where there are quarters.
[[nodiscard]] double fifthBrought(double density, int mapSize);
/// What a step weighs beside links: the first four Gaussians, and what links leave of the fifth.
[[nodiscard]] glm::dvec3 weightBesideLinks(double step, double density, int mapSize);
/// A level by itself. texel: light times coverage, and coverage.
[[nodiscard]] glm::dvec4 levelAlone(const glm::dvec4& texel, double level, double density, bool linked, bool fourth, int mapSize);

/// A case of Pyramid.fx with all these maps at this size of the base.
[[nodiscard]] FunctionCase pyramidCase(const char* function, std::string body, std::vector<Argument> arguments,
                                       std::function<Values(const Inputs&)> expected, int mapSize = kTestMapSize);

} // namespace tegument::test
