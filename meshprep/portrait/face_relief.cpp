#include "meshprep/portrait/face_relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace tegument {

namespace {

constexpr double kDeepest = -60; // mm: what lies farther back is no face
constexpr std::array<double, 9> kAcross = {0, 6, 12, 19, 27, 35, 43, 51, 59};
constexpr int kRows = 24;
constexpr std::size_t kCells = kAcross.size() * kRows;
constexpr double kTop = 60; // mm above the nasion
constexpr double kStep = 8; // mm

double bump(double x, double width) {
    return std::exp(-x * x / (2 * width * width));
}

using Relief = std::array<double, kCells>;

const Relief& relief() {
    static const auto kRelief = [] {
        Relief all{};
        for (std::size_t row = 0; row < kRows; ++row)
            for (std::size_t i = 0; i < kAcross.size(); ++i)
                all[row * kAcross.size() + i] = std::max(kDeepest, faceRelief(kAcross[i], kTop - kStep * static_cast<double>(row)));
        return all;
    }();
    return kRelief;
}

/// How far to the front the surface reaches, in cells.
class DepthMap {
public:
    DepthMap(const std::vector<SurfaceSample>& samples, const glm::dvec3& middle, const glm::dvec3& up, const glm::dvec3& front,
             double cell)
        : cell_(cell) {
        const glm::dvec3 left = glm::cross(up, front);
        low_ = INFINITY, high_ = -INFINITY;
        std::vector<glm::dvec3> seen;
        seen.reserve(samples.size());
        for (const SurfaceSample& s : samples) {
            const glm::dvec3 p = s.point - middle;
            seen.emplace_back(std::abs(glm::dot(p, left)), glm::dot(p, up), glm::dot(p, front));
            low_ = std::min(low_, seen.back().y), high_ = std::max(high_, seen.back().y);
            wide_ = std::max(wide_, seen.back().x);
        }
        columns_ = static_cast<int>(wide_ / cell) + 2;
        rows_ = static_cast<int>((high_ - low_) / cell) + 2;
        // Both sides are seen as one: the mean of the two.
        std::array<std::vector<double>, 2> sides;
        for (auto& side : sides)
            side.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), -INFINITY);
        back_.assign(static_cast<std::size_t>(rows_), INFINITY);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const bool right = glm::dot(samples[i].point - middle, left) < 0;
            double& back = back_[static_cast<std::size_t>((seen[i].y - low_) / cell)];
            back = std::min(back, seen[i].z);
            double& depth = sides[right][at(static_cast<int>(seen[i].x / cell), static_cast<int>((seen[i].y - low_) / cell))];
            depth = std::max(depth, seen[i].z);
        }
        depth_.assign(sides[0].size(), -INFINITY);
        for (std::size_t i = 0; i < depth_.size(); ++i)
            depth_[i] = !std::isfinite(sides[0][i])   ? sides[1][i]
                        : !std::isfinite(sides[1][i]) ? sides[0][i]
                                                      : (sides[0][i] + sides[1][i]) / 2;
        fill();
    }

    /// From the foremost place of the middle to the hindmost one at a height.
    [[nodiscard]] double length(double above) const {
        const int row = rowAt(above);
        return depth_[at(0, row)] - back_[static_cast<std::size_t>(row)];
    }
    /// Half the width there.
    [[nodiscard]] double reach(double above) const {
        const int row = rowAt(above);
        int column = columns_ - 1;
        while (column >= 0 && !std::isfinite(depth_[at(column, row)]))
            --column;
        return (column + 1) * cell_;
    }
    [[nodiscard]] double low() const { return low_; }
    [[nodiscard]] double high() const { return high_; }

    /// -INFINITY outside.
    [[nodiscard]] double operator()(double across, double above) const {
        const double x = std::max(0.0, across / cell_ - 0.5), y = (above - low_) / cell_ - 0.5;
        const int column = static_cast<int>(x), row = static_cast<int>(std::floor(y));
        if (row < 0 || row + 1 >= rows_ || column + 1 >= columns_) return -INFINITY;
        const double u = x - column, v = y - row;
        const double a = depth_[at(column, row)], b = depth_[at(column + 1, row)];
        const double c = depth_[at(column, row + 1)], d = depth_[at(column + 1, row + 1)];
        if (!std::isfinite(a) || !std::isfinite(b) || !std::isfinite(c) || !std::isfinite(d)) return -INFINITY;
        return (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d);
    }

private:
    double cell_;
    double low_ = 0, high_ = 0, wide_ = 0;
    int columns_ = 0, rows_ = 0;
    std::vector<double> depth_;
    std::vector<double> back_; // of each row

    [[nodiscard]] int rowAt(double above) const { return std::clamp(static_cast<int>((above - low_) / cell_), 0, rows_ - 1); }
    [[nodiscard]] std::size_t at(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
    }

    /// Cells in which no sample fell have their neighbours' mean, where three have one.
    void fill() {
        const std::vector<double> old = depth_;
        for (int row = 0; row < rows_; ++row)
            for (int column = 0; column < columns_; ++column) {
                if (std::isfinite(old[at(column, row)])) continue;
                double sum = 0;
                int count = 0;
                for (int y = std::max(0, row - 1); y <= std::min(rows_ - 1, row + 1); ++y)
                    for (int x = std::max(0, column - 1); x <= std::min(columns_ - 1, column + 1); ++x)
                        if (std::isfinite(old[at(x, y)])) sum += old[at(x, y)], ++count;
                if (count >= 3) depth_[at(column, row)] = sum / count;
            }
    }
};

/// What is left of a relief once it is bent as little as can be: nose, eyes and mouth without the roundness that any ball has.
Relief detail(const Relief& whole) {
    static const auto kSmooth = [] { // orthonormal: 1, y, y^2, x^2, x^2 y
        std::array<Relief, 5> basis{};
        for (std::size_t k = 0; k < basis.size(); ++k) {
            for (std::size_t i = 0; i < kCells; ++i) {
                const double x = kAcross[i % kAcross.size()] / 60, y = 1 - static_cast<double>(i / kAcross.size()) * 2 / (kRows - 1);
                const std::array<double, 5> powers = {1, y, y * y, x * x, x * x * y};
                basis[k][i] = powers[k];
            }
            for (std::size_t j = 0; j <= k; ++j) {
                double along = 0;
                for (std::size_t i = 0; i < kCells; ++i)
                    along += basis[j][i] * basis[k][i];
                for (std::size_t i = 0; i < kCells; ++i)
                    basis[k][i] = j < k ? basis[k][i] - along * basis[j][i] : basis[k][i] / std::sqrt(along);
            }
        }
        return basis;
    }();
    Relief left = whole;
    for (const Relief& smooth : kSmooth) {
        double along = 0;
        for (std::size_t i = 0; i < kCells; ++i)
            along += smooth[i] * whole[i];
        for (std::size_t i = 0; i < kCells; ++i)
            left[i] -= along * smooth[i];
    }
    return left;
}

double correlation(const Relief& a, const Relief& b) {
    double both = 0, ofA = 0, ofB = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        both += a[i] * b[i], ofA += a[i] * a[i], ofB += b[i] * b[i];
    return ofA > 0 && ofB > 0 ? both / std::sqrt(ofA * ofB) : 0;
}

/// mm before the nasion, the nearest place taken for the tip of the nose; none where nothing is seen.
std::optional<Relief> reliefAt(const DepthMap& map, double above, double millimetre) {
    constexpr double kNose = 24; // mm: the tip's place in the formula
    Relief seen;
    double nearest = -INFINITY;
    for (std::size_t i = 0; i < kCells; ++i) {
        const auto row = static_cast<double>(i / kAcross.size());
        seen[i] = map(kAcross[i % kAcross.size()] * millimetre, above + (kTop - kStep * row) * millimetre) / millimetre;
        nearest = std::max(nearest, seen[i]);
    }
    if (!std::isfinite(nearest)) return std::nullopt;
    for (double& depth : seen)
        depth = std::max(depth - nearest + kNose, kDeepest);
    return seen;
}

/// 1 less the share of the relief that is not the face's, for the best offset and the best of the gains that faces have.
double likenessOf(const Relief& seen) {
    const Relief& face = relief();
    double meanSeen = 0, meanFace = 0;
    for (std::size_t i = 0; i < kCells; ++i)
        meanSeen += seen[i] / kCells, meanFace += face[i] / kCells;
    double both = 0, ofSeen = 0, ofFace = 0;
    for (std::size_t i = 0; i < kCells; ++i) {
        const double a = seen[i] - meanSeen, b = face[i] - meanFace;
        both += a * b, ofSeen += a * a, ofFace += b * b;
    }
    const double gain = std::clamp(both / ofFace, 0.75, 1.3);
    const double left = ofSeen - 2 * gain * both + gain * gain * ofFace;
    return 1 - left / (gain * gain * ofFace);
}

} // namespace

double faceRelief(double across, double above) {
    const double x = across, y = above;
    double z = 2.3 + 45.9 * (std::sqrt(std::max(0.02, 1 - x * x / (63.5 * 63.5))) - 1);
    if (y > 34.5) z -= (y - 34.5) * (y - 34.5) / (2 * 37); // forehead
    z += 7.9 * bump(y - 15.9, 12) * bump(x, 40);           // brows
    z -= 7 * bump(x - 19.3, 11) * bump(y + 11.2, 9);       // eyes, beside the nose
    const double ridge = y > -44.3 ? std::clamp(-y / 44.3, 0.0, 1.0) : std::max(0.0, 1 - (-44.3 - y) / 19.2);
    z += 24 * ridge * bump(x, 7.7 + 2.9 * ridge);     // nose
    z += 7.3 * bump(x, 11.1) * bump(y + 74, 14);      // mouth
    z += 4.3 * bump(x - 19.2, 14) * bump(y + 61, 16); // cheeks
    z += 4.3 * bump(x, 16) * bump(y + 104.9, 9);      // chin
    const double jaw = -114.9 + 36.5 * (x / 59) * (x / 59);
    return z - 3.8 * std::max(0.0, jaw - y);
}

FaceMatch matchFace(const std::vector<SurfaceSample>& samples, const glm::dvec3& middle, const glm::dvec3& up, const glm::dvec3& front,
                    bool fine) {
    glm::dvec3 centre(0);
    for (const SurfaceSample& s : samples)
        centre += s.point / static_cast<double>(samples.size());
    double square = 0;
    for (const SurfaceSample& s : samples)
        square += glm::dot(s.point - centre, s.point - centre) / static_cast<double>(samples.size());
    const double radius = std::sqrt(square);
    const DepthMap map(samples, middle, up, front, radius / 26);
    FaceMatch best;
    double bestAbove = 0;
    // Above a face stands a scalp with hair or a hat, and beside it ears with hair: what is larger is no head that way, or not so small.
    constexpr double kMostAbove = 350; // mm of the nasion
    constexpr double kMostBeside = 150;
    constexpr double kMostBehind = 330;
    const auto take = [&](double above, double millimetre) {
        if (map.high() - above > kMostAbove * millimetre || map.reach(above) > kMostBeside * millimetre ||
            map.length(above) > kMostBehind * millimetre)
            return;
        const auto seen = reliefAt(map, above, millimetre);
        const double likeness = seen ? likenessOf(*seen) : -1;
        if (likeness <= best.likeness) return;
        best.likeness = likeness;
        best.millimetre = millimetre;
        bestAbove = above;
    };
    // A head alone is about 100 mm in root mean square; one with its shoulders more, a face alone less.
    for (double size = 60; size < 215; size *= 1.1) {
        const double millimetre = radius / size;
        for (double above = map.low() + 80 * millimetre; above < map.high() - 20 * millimetre; above += 7 * millimetre)
            take(above, millimetre);
    }
    const FaceMatch coarse = best;
    const double coarseAbove = bestAbove;
    if (fine && best.likeness > 0)
        for (double factor = 0.9; factor < 1.11; factor += 0.02)
            for (double step = -8; step <= 8; step += 1)
                take(coarseAbove + step * coarse.millimetre, coarse.millimetre * factor);
    if (const auto seen = reliefAt(map, bestAbove, best.millimetre); seen && best.likeness > -1)
        best.likeness = (best.likeness + correlation(detail(*seen), detail(relief()))) / 2;
    const double depth = map(0, bestAbove);
    best.nasion = middle + bestAbove * up + (std::isfinite(depth) ? depth : 0) * front;
    return best;
}

} // namespace tegument
