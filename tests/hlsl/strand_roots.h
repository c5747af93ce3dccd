#pragma once
// Roots whose strands are ribbons: a texture of them, and how wide their strands are.

#include "tests/hlsl/fur_light.h"
#include "tests/hlsl/lock_scene.h"
#include "tests/hlsl/maps.h"

namespace tegument::test {

inline constexpr double kStrandShare = 0.9;                // of the strands that is drawn
inline constexpr double kStrandBall = 90;                  // radius of the roots' mesh, mm
inline constexpr double kStrandGap = 2.5;                  // spacing of the roots, mm
inline constexpr double kStrandUnits = 80.0 / kStrandBall; // world units in a mm
inline constexpr double kStrandFirst = 4100;               // address of the first root

/// Two rows: the header, then numbers of roots, of which any three texels side by side may be one.
inline const TestMap& strandRootsMap() {
    static const TestMap kMap = [] {
        TestMap map{.size = 4096, .texels = std::vector<std::array<float, 4>>(2 * 4096), .height = 2};
        map.texels[2] = {2, 50, 0, 0};
        map.texels[3] = texelOf(0, 0.4, 0, 1 / (kStrandGap * kStrandGap));
        map.texels[4] = texelOf(5, -6, 7, kStrandBall);
        map.texels[6] = texelOf(kStrandFirst, 4);
        for (std::size_t at = 4096; at < map.texels.size(); ++at) {
            const auto i = static_cast<double>(at);
            map.texels[at] = texelOf(sin(i), cos(2 * i), 1.5, 0.4 + 0.2 * sin(3 * i));
        }
        return map;
    }();
    return kMap;
}

inline FunctionCase strandRootCase(Call call, Arguments arguments, Tolerance tolerance, Reference expected) {
    static const TestMap kNone = oneTexel(0);
    const Globals more = {{"gFurRadius", {kFurRootRadius}},
                          {"gFurTurns", {1.3}},
                          {"gFurScatter", {0.4}},
                          {"gFurCurls", {0.15}},
                          {"gFurTuftSize", {4}},
                          {"gFurVariation", {0.4}},
                          {"gFurShare", {kStrandShare}},
                          {"gFurEdge", {0.4}},
                          {"gRibbonThin", {0.7}},
                          {"gCoatSegments", {6}}};
    FunctionCase made =
        passCase("FurCoat.fx", with(furScene(), more), std::move(call), std::move(arguments), std::move(tolerance), std::move(expected));
    made.map = &kNone;
    made.maps = {{"gFurRootsMap", &strandRootsMap()}};
    return made;
}

/// Strands of no length and without curls: they stand on their roots.
inline void flattenStrands(FunctionCase& made) {
    setAll(made, {"gFurScatter", "gFurCurls", "gFurTufts"}, {0});
    made.globals["gFurLength"] = {1e-7};
}

/// Of a root of the usual width, world units, as those that are drawn stand for all.
inline double strandWidest() {
    return kFurRootRadius * kStrandGap * kStrandUnits / kStrandShare;
}

/// At the place along the strand, where roots have 0.4 as the usual width.
inline double strandRadius(double address, double along) {
    const double own = strandRootsMap().texels[static_cast<std::size_t>(std::llround(address))][3];
    return strandWidest() * own / 0.4 * (1 - along);
}

} // namespace tegument::test
