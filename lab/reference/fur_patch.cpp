#include "lab/reference/fur_patch.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tegument::reference {

namespace {

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

/// The largest h at which the ray is inside the cone, or kNoHit. Inside means
/// f(h) = (x + run (1 - h) - cx)^2 + (y - cy)^2 - r0^2 (1 - h / L)^2 <= 0 with h <= L, a quadratic in h.
double highestInside(const FurPatch& patch, const FurRay& ray, const Cone& cone) {
    const double top = cone.length;
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
        return h >= 0 && h <= top ? h : kNoHit;
    }
    const double discriminant = b * b - a * c;
    if (discriminant < 0) return kNoHit;
    const double root = std::sqrt(discriminant);
    // Outside at the top, so the highest point inside is a root below it; the larger one first.
    const double upper = std::max((-b + root) / a, (-b - root) / a);
    const double lower = std::min((-b + root) / a, (-b - root) / a);
    if (upper >= 0 && upper <= top) return upper;
    return lower >= 0 && lower <= top ? lower : kNoHit;
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
            [&](const Cone& cone) { best = std::max(best, highestInside(patch, ray, cone)); });
    return best;
}

double heightOver(const FurPatch& patch, double x, double y) {
    double height = -1;
    strands(patch, cell(x) - 1, cell(x) + 1, cell(y), [&](const Cone& cone) {
        height = std::max(height, cone.length * (1 - std::hypot(x - cone.x, y - cone.y) / patch.baseRadius));
    });
    return height;
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
