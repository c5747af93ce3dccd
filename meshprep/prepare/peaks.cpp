#include "meshprep/prepare/peaks.h"

#include "host/support/parallel.h"

namespace tegument::prep {

namespace {

/// More would not change the first two digits.
constexpr std::size_t kMostSamples = 40'000;

} // namespace

double rootMeanSquare(const NearSurface& from, const NearSurface& to, bool dear) {
    const std::size_t most = dear ? kMostSamples / 64 : kMostSamples;
    const std::size_t step = std::max<std::size_t>(1, 4 * from.size() / most);
    const std::size_t samples = (from.size() + step - 1) / step;
    struct Sum {
        double squares = 0;
        std::size_t count = 0;
    };
    std::vector<Sum> ofRun(chunkCount(samples));
    inChunks(samples, 0, [&](std::size_t first, std::size_t last, std::size_t run) {
        std::uint32_t hint = kNoHint;
        for (std::size_t i = first; i < last; ++i) {
            const std::array<glm::dvec3, 3> t = from.triangle(from.alongCurve()[i * step]);
            for (const glm::dvec3& point : {(t[0] + t[1] + t[2]) / 3.0, t[0], t[1], t[2]}) {
                const NearestTriangle near = to.nearest(point, hint);
                if (!std::isfinite(near.distance)) continue;
                hint = near.triangle;
                ofRun[run].squares += near.distance * near.distance;
                ++ofRun[run].count;
            }
        }
    });
    Sum all;
    for (const Sum& sum : ofRun)
        all = {.squares = all.squares + sum.squares, .count = all.count + sum.count};
    return all.count == 0 ? 0 : std::sqrt(all.squares / static_cast<double>(all.count));
}

std::vector<DistancePeak> summits(std::vector<DistancePeak> peaks, double reached, std::size_t most) {
    constexpr std::size_t kMostLookedAt = 4096;
    std::erase_if(peaks, [&](const DistancePeak& peak) { return peak.apart <= kPeak * reached; });
    std::ranges::sort(peaks, [](const DistancePeak& a, const DistancePeak& b) {
        return a.apart > b.apart || (a.apart == b.apart && a.number < b.number);
    });
    if (peaks.size() > kMostLookedAt) peaks.resize(kMostLookedAt);
    std::vector<DistancePeak> kept;
    for (const DistancePeak& peak : peaks) {
        const auto near = [&](const DistancePeak& other) { return glm::distance(other.at, peak.at) < 2 * other.apart; };
        if (kept.size() < most && std::ranges::none_of(kept, near)) kept.push_back(peak);
    }
    return kept;
}

} // namespace tegument::prep
