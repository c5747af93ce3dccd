#pragma once
// Parameters of effects/FurRoots.fx for strands that exact rays can judge.

#include <map>
#include <string>
#include <vector>

namespace tegument::measure {

/// Straight cones on their roots, lit by the fill alone: brightness goes from `root` to `tip` along each, whatever the light and the view.
/// `length`: in radii of the mesh; `radius`: in spacings.
inline std::map<std::string, std::vector<double>> plainStrands(double length, double radius, double root, double tip) {
    const auto grey = [](double value) { return std::vector<double>{value, value, value}; };
    return {{"gFurLength", {length}},   {"gFurRadius", {radius}}, {"gFurScatter", {0}},  {"gFurCurls", {0}},
            {"gFurTufts", {0}},         {"gFurVariation", {0}},   {"gFurLean", {0}},     {"gFurDensity", {0}},
            {"gFurMultiple", {1}},      {"gFurSpecular", {0}},    {"gFurFill", grey(1)}, {"gFurRootColor", grey(root)},
            {"gFurTipColor", grey(tip)}};
}

} // namespace tegument::measure
