#pragma once
// Lines on two logarithmic axes, as SVG.

#include <string>
#include <vector>

namespace tegument::measure {

struct Line {
    std::string label;
    std::string color; // "#rrggbb"
    bool dashed = false;
    std::vector<std::pair<double, double>> points; // > 0
};

struct Chart {
    std::string title;
    std::string across;
    std::string up;
    std::vector<double> acrossTicks; // their first and last are the axis
    std::vector<double> upTicks;
    std::vector<Line> lines;
};

/// What lies outside of the axes is cut off.
[[nodiscard]] std::string svg(const Chart& chart);

} // namespace tegument::measure
