#include "lab/reference/spline_pyramid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tegument::reference {

namespace {

using Row = std::vector<double>;

Row convolved(const Row& a, const Row& b) {
    Row result(a.size() + b.size() - 1, 0.0);
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j)
            result[i + j] += a[i] * b[j];
    return result;
}

Row gatheredBy(int level) {
    const auto side = std::size_t{1} << static_cast<unsigned>(level);
    const Row box(side, 1.0 / static_cast<double>(side));
    return convolved(convolved(box, box), box);
}

/// Linear between the middles of the entries, constant beyond them.
double read(const Row& row, double at) {
    const double place = std::clamp(at - 0.5, 0.0, static_cast<double>(row.size() - 1));
    const auto left = static_cast<std::size_t>(place);
    const std::size_t right = std::min(left + 1, row.size() - 1);
    return std::lerp(row[left], row[right], place - static_cast<double>(left));
}

Row reduced(const Row& row) {
    Row result(row.size() / 2);
    const auto texel = [&](std::size_t i, int offset) {
        const auto at = static_cast<std::ptrdiff_t>(2 * i) + offset;
        return row[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(at, 0, static_cast<std::ptrdiff_t>(row.size()) - 1))];
    };
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = (texel(i, -1) + 3 * texel(i, 0) + 3 * texel(i, 1) + texel(i, 2)) / 8;
    return result;
}

Row broughtUp(const Row& row) {
    Row result(row.size() * 2);
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = read(row, (static_cast<double>(i) + 0.5) / 2);
    return result;
}

Row throughLevel(Row row, int level) {
    for (int i = 0; i < level; ++i)
        row = reduced(row);
    for (int i = 0; i < level; ++i)
        row = broughtUp(row);
    return row;
}

} // namespace

Image splineLevel(const Image& base, int level) {
    const Row weights = gatheredBy(level);
    const int side = 1 << level;
    Image result{.width = base.width / side, .height = base.height / side, .channels = base.channels};
    const auto inside = [&](int first, int size) { return first >= 0 && first + static_cast<int>(weights.size()) <= size; };
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
            const int left = x * side - (side - 1);
            const int top = y * side - (side - 1);
            const bool known = inside(left, base.width) && inside(top, base.height);
            for (int c = 0; c < base.channels; ++c) {
                double sum = known ? 0 : std::numeric_limits<double>::quiet_NaN();
                for (std::size_t j = 0; known && j < weights.size(); ++j)
                    for (std::size_t i = 0; i < weights.size(); ++i)
                        sum += weights[i] * weights[j] * base.at(left + static_cast<int>(i), top + static_cast<int>(j), c);
                result.pixels.push_back(static_cast<float>(sum));
            }
        }
    return result;
}

EdgeAnswer splineEdge(int level) {
    constexpr int kReach = 6;          // texels of the level
    constexpr int kPlaces = 4;         // of the edge in a texel of the base
    constexpr int kStepsOfALevel = 16; // of the answer, in a texel of the level
    const int side = 1 << level;
    const auto texels = static_cast<std::size_t>(4 * kReach * side);
    EdgeAnswer answer{.first = -static_cast<double>(kReach * side), .step = static_cast<double>(side) / kStepsOfALevel};
    answer.values.assign(2 * kReach * kStepsOfALevel + 1, 0.0);
    const int edges = side * kPlaces;
    for (int k = 0; k < edges; ++k) {
        const double edge = static_cast<double>(texels) / 2 + (k + 0.5) / kPlaces;
        Row light(texels);
        for (std::size_t i = 0; i < texels; ++i)
            light[i] = std::clamp(static_cast<double>(i) + 1 - edge, 0.0, 1.0);
        const Row seen = throughLevel(std::move(light), level);
        for (std::size_t i = 0; i < answer.values.size(); ++i)
            answer.values[i] += read(seen, edge + answer.first + answer.step * static_cast<double>(i)) / edges;
    }
    return answer;
}

double EdgeAnswer::at(double distance) const {
    const double place = (distance - first) / step;
    if (place <= 0) return 0;
    if (place >= static_cast<double>(values.size() - 1)) return 1;
    const auto left = static_cast<std::size_t>(place);
    return std::lerp(values[left], values[left + 1], place - static_cast<double>(left));
}

} // namespace tegument::reference
