#include "lab/reference/convolution.h"

#include <algorithm>
#include <cmath>

namespace tegument::reference {

namespace {

/// value(x, y) of every valid texel; the others stay invalid.
template <class Value>
Map forEachValid(const Map& map, Value value) {
    Map result{.size = map.size, .texels = std::vector<glm::dvec4>(map.texels.size(), glm::dvec4(0)), .valid = map.valid};
    for (int y = 0; y < map.size; ++y)
        for (int x = 0; x < map.size; ++x)
            if (map.has(x, y)) result.texels[map.index(x, y)] = value(x, y);
    return result;
}

struct Sum {
    glm::dvec4 value{0};
    double weight = 0;

    void add(const Map& map, int x, int y, double share) {
        if (!map.has(x, y)) return;
        value += share * map.texels[map.index(x, y)];
        weight += share;
    }
    [[nodiscard]] glm::dvec4 mean() const { return value / weight; }
};

struct Tap {
    glm::dvec4 value{0};
    bool valid = false;
};

/// Between two texels of a row or column; where one is invalid, the other.
Tap between(const Map& map, int x, int y, bool alongU, double offset) {
    const int left = static_cast<int>(std::floor(offset));
    const double f = offset - left;
    Sum sum;
    sum.add(map, alongU ? x + left : x, alongU ? y : y + left, 1 - f);
    if (f > 0) sum.add(map, alongU ? x + left + 1 : x, alongU ? y : y + left + 1, f);
    return sum.weight > 0 ? Tap{sum.mean(), true} : Tap{};
}

} // namespace

bool Map::lookUp(const glm::dvec2& uv, glm::dvec4& value) const {
    const glm::dvec2 place = uv * static_cast<double>(size) - 0.5;
    const glm::dvec2 corner = glm::floor(place);
    const glm::dvec2 f = place - corner;
    const int x = static_cast<int>(corner.x);
    const int y = static_cast<int>(corner.y);
    Sum sum;
    sum.add(*this, x, y, (1 - f.x) * (1 - f.y));
    sum.add(*this, x + 1, y, f.x * (1 - f.y));
    sum.add(*this, x, y + 1, (1 - f.x) * f.y);
    sum.add(*this, x + 1, y + 1, f.x * f.y);
    value = sum.weight > 0 ? sum.mean() : glm::dvec4(0);
    return sum.weight > 0;
}

std::vector<double> gridGaussian(double variance) {
    if (variance <= 0) return {1};
    // I_{n-1}(t) - I_{n+1}(t) = 2 n / t I_n(t), downwards from far beyond what counts (Miller); the sum over all n is exp(t).
    constexpr double kRest = 1e-7;
    const auto far = static_cast<std::size_t>(20 + 8 * std::sqrt(variance) + variance / 4);
    std::vector<double> weights(far + 2, 0.0);
    weights[far] = 1e-200;
    for (std::size_t n = far; n >= 1; --n) {
        weights[n - 1] = weights[n + 1] + 2 * static_cast<double>(n) / variance * weights[n];
        if (weights[n - 1] > 1e200)
            for (double& w : weights)
                w *= 1e-200;
    }
    double sum = weights[0];
    for (std::size_t n = 1; n < weights.size(); ++n)
        sum += 2 * weights[n];
    for (double& w : weights)
        w /= sum;
    while (weights.size() > 1 && weights.back() < kRest)
        weights.pop_back();
    return weights;
}

Map gaussian(const Map& map, const std::function<Spread(int, int)>& spread) {
    return forEachValid(map, [&](int x, int y) {
        const Spread s = spread(x, y);
        const std::vector<double> across = gridGaussian(s.u);
        const std::vector<double> down = gridGaussian(s.v);
        const int reachX = static_cast<int>(across.size()) - 1;
        const int reachY = static_cast<int>(down.size()) - 1;
        Sum sum;
        for (int j = -reachY; j <= reachY; ++j)
            for (int i = -reachX; i <= reachX; ++i)
                sum.add(map, x + i, y + j, across[static_cast<std::size_t>(std::abs(i))] * down[static_cast<std::size_t>(std::abs(j))]);
        return sum.mean();
    });
}

Map sevenTaps(const Map& map, bool alongU, const std::function<double(int, int)>& spacing) {
    constexpr double kLargestAlpha = 0.99;
    return forEachValid(map, [&](int x, int y) {
        const double s = spacing(x, y);
        const glm::dvec4 centre = map.texels[map.index(x, y)];
        glm::dvec4 sum(0);
        for (int j = -3; j <= 3; ++j) {
            const Tap tap = between(map, x, y, alongU, j * s);
            sum += kPrintedKernel[static_cast<std::size_t>(j + 3)] * (tap.valid ? tap.value : centre);
        }
        sum.w = std::min(sum.w, kLargestAlpha);
        return sum;
    });
}

namespace {

glm::dvec2 pointOf(const Disc& disc, std::size_t i) {
    glm::dvec2 mean(0);
    for (const auto& p : kPrintedDisc)
        mean += glm::dvec2(p[0], p[1]) / 12.0;
    const glm::dvec2 p = glm::dvec2(kPrintedDisc[i][0], kPrintedDisc[i][1]) - (disc.centred ? mean : glm::dvec2(0));
    const double c = std::cos(disc.turn);
    const double s = std::sin(disc.turn);
    return glm::dvec2(p.x * c - p.y * s, p.x * s + p.y * c) * disc.radius;
}

} // namespace

Map poisson(const Map& map, const std::function<Disc(int, int)>& disc) {
    return forEachValid(map, [&](int x, int y) {
        const Disc d = disc(x, y);
        const glm::dvec4 centre = map.texels[map.index(x, y)];
        Sum sum;
        sum.add(map, x, y, 1);
        for (std::size_t i = 0; i < kPrintedDisc.size(); ++i) {
            const glm::dvec2 tap = glm::floor(glm::dvec2(x, y) + 0.5 + pointOf(d, i));
            const int tapX = std::clamp(static_cast<int>(tap.x), 0, map.size - 1);
            const int tapY = std::clamp(static_cast<int>(tap.y), 0, map.size - 1);
            const bool valid = map.has(tapX, tapY);
            if (valid)
                sum.add(map, tapX, tapY, 1);
            else if (d.repair)
                sum.add(map, x, y, 1);
        }
        return glm::dvec4(glm::dvec3(sum.mean()), centre.w);
    });
}

} // namespace tegument::reference
