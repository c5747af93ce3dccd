#include "lab/measure/chart.h"

#include <fmt/format.h>

#include <cmath>

namespace tegument::measure {

namespace {

constexpr double kLeft = 70;
constexpr double kTop = 40;
constexpr double kWide = 440;
constexpr double kHigh = 320;
constexpr double kLegend = 230;

double share(double value, const std::vector<double>& ticks) {
    return std::log(value / ticks.front()) / std::log(ticks.back() / ticks.front());
}

struct Axes {
    const Chart& chart;
    [[nodiscard]] double x(double value) const { return kLeft + kWide * share(value, chart.acrossTicks); }
    [[nodiscard]] double y(double value) const { return kTop + kHigh * (1 - share(value, chart.upTicks)); }
};

std::string grid(const Axes& axes) {
    std::string out;
    for (const double tick : axes.chart.acrossTicks)
        out += fmt::format("<path d='M{0:.1f} {1}v{2}' stroke='#ddd'/><text x='{0:.1f}' y='{3}' text-anchor='middle'>{4:g}</text>\n",
                           axes.x(tick), kTop, kHigh, kTop + kHigh + 18, tick);
    for (const double tick : axes.chart.upTicks)
        out += fmt::format("<path d='M{0} {1:.1f}h{2}' stroke='#ddd'/><text x='{3}' y='{4:.1f}' text-anchor='end'>{5:g}</text>\n", kLeft,
                           axes.y(tick), kWide, kLeft - 8, axes.y(tick) + 4, tick);
    return out;
}

std::string polyline(const Axes& axes, const Line& line) {
    std::string points;
    for (const auto& [across, up] : line.points)
        points += fmt::format("{:.1f},{:.1f} ", axes.x(across), axes.y(up));
    std::string out = fmt::format("<polyline points='{}' fill='none' stroke='{}' stroke-width='1.6'{} clip-path='url(#c)'/>\n", points,
                                  line.color, line.dashed ? " stroke-dasharray='5 4'" : "");
    if (line.dashed) return out;
    for (const auto& [across, up] : line.points)
        out += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='2.8' fill='{}' clip-path='url(#c)'/>\n", axes.x(across), axes.y(up),
                           line.color);
    return out;
}

std::string legend(const Chart& chart) {
    std::string out;
    double y = kTop + 10;
    for (const Line& line : chart.lines) {
        out += fmt::format("<path d='M{} {}h26' stroke='{}' stroke-width='1.6'{}/><text x='{}' y='{}'>{}</text>\n", kLeft + kWide + 18, y,
                           line.color, line.dashed ? " stroke-dasharray='5 4'" : "", kLeft + kWide + 52, y + 4, line.label);
        y += 20;
    }
    return out;
}

} // namespace

std::string svg(const Chart& chart) {
    const Axes axes{chart};
    std::string out = fmt::format("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' "
                                  "font-family='sans-serif' font-size='12'>\n<rect width='100%' height='100%' fill='#fff'/>\n"
                                  "<clipPath id='c'><rect x='{2}' y='{3}' width='{4}' height='{5}'/></clipPath>\n",
                                  kLeft + kWide + kLegend, kTop + kHigh + 50, kLeft, kTop, kWide, kHigh);
    out += grid(axes);
    for (const Line& line : chart.lines)
        out += polyline(axes, line);
    out += legend(chart);
    out += fmt::format("<text x='{}' y='22' font-size='14'>{}</text>\n<text x='{}' y='{}' text-anchor='middle'>{}</text>\n"
                       "<text transform='translate(18 {}) rotate(-90)' text-anchor='middle'>{}</text>\n</svg>\n",
                       kLeft, chart.title, kLeft + kWide / 2, kTop + kHigh + 40, chart.across, kTop + kHigh / 2, chart.up);
    return out;
}

} // namespace tegument::measure
