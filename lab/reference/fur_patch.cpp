#include "lab/reference/fur_patch.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tegument::reference {

namespace {

constexpr double kBareSkin = 0.05;
constexpr double kRoot = 0.15;
constexpr double kTip = 1.0;

using Cone = FurStrand;

/// SplitMix64 of the cell: independent of the shaders' hashes.
std::uint64_t scrambled(std::uint64_t v) {
    v += 0x9e3779b97f4a7c15U;
    v = (v ^ (v >> 30U)) * 0xbf58476d1ce4e5b9U;
    v = (v ^ (v >> 27U)) * 0x94d049bb133111ebU;
    return v ^ (v >> 31U);
}

double unit(std::uint64_t bits) {
    return static_cast<double>(bits & 0xfffffU) / static_cast<double>(0x100000U);
}

int cell(double coordinate) {
    return static_cast<int>(std::floor(coordinate));
}

/// Calls visit(cone) for the strands of cells [x0, x1] x [y - 1, y + 1]: a root strays 0.3 and a strand is 0.38 wide, so that none further
/// away reaches.
template <class Visit>
void strands(const FurPatch& patch, int x0, int x1, int y, Visit&& visit) {
    for (int j = y - 1; j <= y + 1; ++j)
        for (int i = x0; i <= x1; ++i)
            visit(strandOf(patch, i, j));
}

/// The largest h in [low, high] at which the ray is inside the cone, or kNoHit. Inside means
/// f(h) = (x + run (1 - h) - cx)^2 + (y - cy)^2 - r0^2 (1 - h / L)^2 <= 0 with h <= L, a quadratic in h.
double highestInside(const FurPatch& patch, const FurRay& ray, const Cone& cone, double low, double high) {
    const double top = std::min(high, cone.length);
    if (top < low) return kNoHit;
    const double p = ray.x + ray.run - cone.x; // f = (p - run h)^2 + q^2 - r0^2 (1 - h / L)^2
    const double q = ray.y - cone.y;
    const double r = patch.baseRadius;
    const double s = r / cone.length;
    const auto f = [&](double h) { return (p - ray.run * h) * (p - ray.run * h) + q * q - (r - s * h) * (r - s * h); };
    if (f(top) <= 0) return top;
    const double a = ray.run * ray.run - s * s;
    const double b = -p * ray.run + r * s; // half of the linear term
    const double c = p * p + q * q - r * r;
    if (a == 0) { // as steep as the cone: f is a straight line
        if (b == 0) return kNoHit;
        const double h = -c / (2 * b);
        return h >= low && h <= top ? h : kNoHit;
    }
    const double discriminant = b * b - a * c;
    if (discriminant < 0) return kNoHit;
    const double root = std::sqrt(discriminant);
    // Outside at the top, so the highest point inside is a root below it; the larger one first.
    const double upper = std::max((-b + root) / a, (-b - root) / a);
    const double lower = std::min((-b + root) / a, (-b - root) / a);
    if (upper >= low && upper <= top) return upper;
    return lower >= low && lower <= top ? lower : kNoHit;
}

} // namespace

FurStrand strandOf(const FurPatch& patch, int cellX, int cellY) {
    const auto key = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(cellX)) << 32U) | static_cast<std::uint32_t>(cellY);
    const std::uint64_t bits = scrambled(scrambled(key) + patch.seed);
    return {cellX + 0.5 + patch.jitter * (2 * unit(bits) - 1), cellY + 0.5 + patch.jitter * (2 * unit(bits >> 20U) - 1),
            patch.shortest + (1 - patch.shortest) * unit(bits >> 40U)};
}

double exactHit(const FurPatch& patch, const FurRay& ray) {
    assert(patch.jitter + patch.baseRadius <= 1);
    double best = kNoHit;
    strands(patch, cell(ray.x) - 1, cell(ray.x + ray.run) + 1, cell(ray.y),
            [&](const Cone& cone) { best = std::max(best, highestInside(patch, ray, cone, 0, 1)); });
    return best;
}

double layerHeight(double share, double exponent) {
    return exponent == 1 ? share : std::pow(share, exponent);
}

double shellHit(const FurPatch& patch, const FurRay& ray, int layers, double exponent) {
    for (int l = layers; l >= 1; --l) {
        const double h = layerHeight((l - 0.5) / layers, exponent);
        const double x = ray.x + ray.run * (1 - h);
        bool inside = false;
        strands(patch, cell(x) - 1, cell(x) + 1, cell(ray.y), [&](const Cone& cone) {
            const double radius = patch.baseRadius * (1 - h / cone.length);
            inside = inside || (h <= cone.length && std::hypot(x - cone.x, ray.y - cone.y) <= radius);
        });
        if (inside) return h;
    }
    return kNoHit;
}

double sweptHit(const FurPatch& patch, const FurRay& ray, int layers, int cells, double exponent) {
    for (int l = layers; l >= 1; --l) {
        const double high = layerHeight(static_cast<double>(l) / layers, exponent);
        const double low = layerHeight(static_cast<double>(l - 1) / layers, exponent);
        const int first = cell(ray.x + ray.run * (1 - high)) - 1;
        const int last = std::min(cell(ray.x + ray.run * (1 - low)) + 1, first + cells - 1);
        double best = kNoHit;
        strands(patch, first, last, cell(ray.y),
                [&](const Cone& cone) { best = std::max(best, highestInside(patch, ray, cone, low, high)); });
        if (best != kNoHit) return best;
    }
    return kNoHit;
}

double heightOver(const FurPatch& patch, double x, double y) {
    double height = -1;
    strands(patch, cell(x) - 1, cell(x) + 1, cell(y), [&](const Cone& cone) {
        height = std::max(height, cone.length * (1 - std::hypot(x - cone.x, y - cone.y) / patch.baseRadius));
    });
    return height;
}

double hitOf(const FurPatch& patch, const FurRay& ray, const FurMethod& method) {
    if (method.kind == FurMethod::Kind::Shells) return shellHit(patch, ray, method.layers, method.exponent);
    if (method.kind == FurMethod::Kind::Swept) return sweptHit(patch, ray, method.layers, method.cells, method.exponent);
    return exactHit(patch, ray);
}

namespace {

/// Calls visit(ray) for every sample of every pixel, pixel after pixel.
template <class Visit>
void rays(const FurPatch& patch, const FurView& view, Visit&& visit) {
    const double run = patch.coat * std::tan(view.tilt);
    const double stretch = view.pixel / std::cos(view.tilt); // along x a pixel covers more of a tilted patch
    for (int j = 0; j < view.size; ++j)
        for (int i = 0; i < view.size; ++i)
            for (int v = 0; v < view.samples; ++v)
                for (int u = 0; u < view.samples; ++u)
                    visit(FurRay{
                        .x = (i + (u + 0.5) / view.samples) * stretch, .y = (j + (v + 0.5) / view.samples) * view.pixel, .run = run});
}

} // namespace

std::vector<double> drawPatch(const FurPatch& patch, const FurView& view, const FurMethod& method) {
    const int samples = view.samples * view.samples;
    std::vector<double> picture;
    picture.reserve(static_cast<std::size_t>(view.size) * static_cast<std::size_t>(view.size));
    double sum = 0;
    int count = 0;
    rays(patch, view, [&](const FurRay& ray) {
        const double h = hitOf(patch, ray, method);
        sum += h == kNoHit ? kBareSkin : kRoot + (kTip - kRoot) * h;
        if (++count < samples) return;
        picture.push_back(sum / samples);
        sum = 0;
        count = 0;
    });
    return picture;
}

double coverageGap(const FurPatch& patch, const FurView& view, const FurMethod& method) {
    double covered = 0;
    double missed = 0;
    rays(patch, view, [&](const FurRay& ray) {
        if (exactHit(patch, ray) == kNoHit) return;
        covered += 1;
        if (hitOf(patch, ray, method) == kNoHit) missed += 1;
    });
    return covered > 0 ? missed / covered : 0;
}

double outlineGap(const FurPatch& patch, int layers, double exponent) {
    constexpr int kSide = 64;
    double sum = 0;
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) {
            const double tip = strandOf(patch, i, j).length;
            double shown = 0;
            for (int l = layers; l >= 1 && shown == 0; --l)
                if (const double h = layerHeight((l - 0.5) / layers, exponent); h <= tip) shown = h;
            sum += tip - shown;
        }
    return patch.coat * sum / (kSide * kSide);
}

FurError furError(const std::vector<double>& picture, const std::vector<double>& truth) {
    assert(picture.size() == truth.size() && !truth.empty());
    FurError error;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double difference = picture[i] - truth[i];
        error.rms += difference * difference;
        error.bias += difference;
    }
    error.rms = std::sqrt(error.rms / static_cast<double>(truth.size()));
    error.bias /= static_cast<double>(truth.size());
    return error;
}

} // namespace tegument::reference
