#include "lab/reference/tissue.h"

#include <algorithm>
#include <cmath>

namespace tegument::reference {

namespace {

/// Rings after the first grow by this factor.
double growth() {
    static const double kGrowth =
        std::pow(RingHistogram::kOutermost / RingHistogram::kInnermost, 1.0 / static_cast<double>(RingHistogram::kRings - 1));
    return kGrowth;
}

} // namespace

double RingHistogram::edge(std::size_t ring) {
    return ring == 0 ? 0 : kInnermost * std::pow(growth(), static_cast<double>(ring - 1));
}

std::size_t RingHistogram::ringOf(double radius) {
    if (radius < kInnermost) return 0;
    const auto ring = 1 + static_cast<std::size_t>(std::log(radius / kInnermost) / std::log(growth()));
    return std::min(ring, kRings - 1);
}

void RingHistogram::add(const RingHistogram& other) {
    for (std::size_t i = 0; i < kRings; ++i)
        energy_[i] += other.energy_[i];
}

void RingHistogram::scale(double factor) {
    for (double& energy : energy_)
        energy *= factor;
}

double RingHistogram::total() const {
    double sum = 0;
    for (const double energy : energy_)
        sum += energy;
    return sum;
}

double RingHistogram::within(double radius) const {
    const std::size_t ring = ringOf(radius);
    double sum = 0;
    for (std::size_t i = 0; i < ring; ++i)
        sum += energy_[i];
    const double share = (radius - edge(ring)) / (edge(ring + 1) - edge(ring));
    return sum + energy_[ring] * std::clamp(share, 0.0, 1.0);
}

double RingHistogram::radiusOf(double share) const {
    double left = share * total();
    for (std::size_t i = 0; i < kRings; ++i) {
        if (energy_[i] >= left && energy_[i] > 0) return edge(i) + (edge(i + 1) - edge(i)) * left / energy_[i];
        left -= energy_[i];
    }
    return kOutermost;
}

} // namespace tegument::reference
