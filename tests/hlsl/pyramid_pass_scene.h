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
[[nodiscard]] dvec4 entryOf(int level);
[[nodiscard]] dvec4 lightOf(int level);

/// What the table has in a row at a density: it rises evenly along its columns.
[[nodiscard]] dvec3 ladderAt(double row, double density);
/// Share of the fifth Gaussian that levels bring: as texels of the links' map, mapSize / 256 of the base each, grow from 2.6 to 3.4 mm, or
/// from 5.2 to 6.8 where there are quarters.
[[nodiscard]] double fifthBrought(double density, int mapSize);
/// What a step weighs beside links: the first four Gaussians, and what links leave of the fifth.
[[nodiscard]] dvec3 weightBesideLinks(double step, double density, int mapSize);
/// A level by itself. texel: light times coverage, and coverage.
[[nodiscard]] dvec4 levelAlone(const dvec4& texel, double level, double density, bool linked, bool fourth, int mapSize);

/// A surface that faces the light, of which nothing but the shadow is asked.
inline constexpr const char* kFacing =
    "LitPoint p = (LitPoint)0; p.normal = float3(0, 0, 1); p.toLight = float3(0, 0, 1); p.axisX = float3(1, 0, 0); "
    "p.axisY = float3(0, 1, 0); p.cosine = 1.0; p.meshNormal = float3(0, 0, 1); ";
inline const Tolerance kTapTolerance = {4, 16, 0.07, "a tap on the border of a texel may see either"};
/// Where shadowMap() shows nothing nearer.
[[nodiscard]] double litAt(const dvec2& uv, double depth);
/// 4 x 4 taps over a square that is turned by atan(1/4), `apart` mm from each other; footprint: of a texel, mm.
[[nodiscard]] double tapsLit(const dvec2& uv, double depth, double footprint, double apart);

/// A case of Pyramid.fx with all these maps at this size of the base.
[[nodiscard]] FunctionCase pyramidCase(Call call, Arguments arguments, int mapSize, Reference expected);
[[nodiscard]] inline FunctionCase pyramidCase(Call call, Arguments arguments, Reference expected) {
    return pyramidCase(std::move(call), std::move(arguments), kTestMapSize, std::move(expected));
}

} // namespace tegument::test
