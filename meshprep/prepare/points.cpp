#include "meshprep/prepare/points.h"

#include "host/mesh/welding.h"

#include <cmath>

namespace tegument::prep {

namespace {

template <std::size_t N>
std::array<std::uint32_t, 2 * N> words(const std::array<double, N>& values) {
    std::array<std::uint32_t, 2 * N> result{};
    for (std::size_t i = 0; i < N; ++i) {
        const auto bits = std::bit_cast<std::uint64_t>(values[i] == 0 ? 0.0 : values[i]);
        result[2 * i] = static_cast<std::uint32_t>(bits);
        result[2 * i + 1] = static_cast<std::uint32_t>(bits >> 32);
    }
    return result;
}

/// By coordinates times 10^decimals, rounded to even as printf does. A negative value that rounds to 0 is printed "-0": that is 0 here.
std::vector<std::uint32_t> samePrinted(const std::vector<glm::vec3>& positions, int decimals) {
    const double scale = std::pow(10.0, decimals);
    return firstEqual(positions.size(), [&](std::uint32_t i) {
        const glm::dvec3 p = glm::dvec3(positions[i]) * scale;
        return words<3>({std::nearbyint(p.x), std::nearbyint(p.y), std::nearbyint(p.z)});
    });
}

/// Places on a grid of cells as wide as epsilon: whatever is near a point lies in its own cell or in one of the 26 around it.
class NearPlaces {
public:
    NearPlaces(const std::vector<glm::vec3>& positions, double epsilon) : positions_(positions), epsilon_(epsilon) {}

    /// A vertex joins the nearest place so far, or begins one. Places do not move, so that a row of near points does not melt into one.
    std::vector<std::uint32_t> find() {
        std::vector<std::uint32_t> first(positions_.size());
        next_.assign(positions_.size(), kNone);
        for (std::uint32_t i = 0; i < positions_.size(); ++i) {
            first[i] = nearest(i);
            if (first[i] == i) add(i);
        }
        return first;
    }

private:
    static constexpr std::uint32_t kNone = UINT32_MAX;
    using Cell = std::array<double, 3>;

    [[nodiscard]] Cell cellOf(std::uint32_t vertex) const {
        const glm::dvec3 p = glm::floor(glm::dvec3(positions_[vertex]) / epsilon_);
        return {p.x, p.y, p.z};
    }

    [[nodiscard]] std::uint32_t nearest(std::uint32_t vertex) const {
        const Cell centre = cellOf(vertex);
        std::uint32_t best = vertex;
        double bestDistance = epsilon_;
        for (int n = 0; n < 27; ++n) {
            const glm::ivec3 step(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
            const Cell cell = {centre[0] + step.x, centre[1] + step.y, centre[2] + step.z};
            const auto head = cells_.find(hashWords(words<3>(cell)), [&](std::uint32_t other) { return cellOf(other) == cell; });
            for (std::uint32_t place = head.value_or(kNone); place != kNone; place = next_[place]) {
                const double distance = glm::distance(glm::dvec3(positions_[place]), glm::dvec3(positions_[vertex]));
                if (distance > bestDistance || (distance == bestDistance && best != vertex)) continue;
                best = place;
                bestDistance = distance;
            }
        }
        return best;
    }

    void add(std::uint32_t vertex) {
        const Cell cell = cellOf(vertex);
        const std::uint32_t head =
            cells_.findOrAdd(hashWords(words<3>(cell)), vertex, [&](std::uint32_t other) { return cellOf(other) == cell; });
        if (head == vertex) return;
        next_[vertex] = next_[head];
        next_[head] = vertex;
    }

    const std::vector<glm::vec3>& positions_;
    double epsilon_;
    UniqueItems cells_;               // by the first place in each
    std::vector<std::uint32_t> next_; // place in the same cell
};

std::vector<std::uint32_t> firstOfPlace(const std::vector<glm::vec3>& positions, const SamePlace& same) {
    if (same.decimals) return samePrinted(positions, *same.decimals);
    if (same.epsilon > 0) return NearPlaces(positions, same.epsilon).find();
    return weldPositions(positions);
}

} // namespace

std::size_t findPlaces(Surface& surface, const SamePlace& same) {
    std::vector<glm::vec3>& positions = surface.mesh.positions;
    surface.point = firstOfPlace(positions, same);
    surface.pointCount = 0;
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        const std::uint32_t first = surface.point[i]; // at most i, so its number is known
        positions[i] = positions[first] + 0.0f;       // -0 becomes 0: the sign would come back as a difference later
        surface.point[i] = first == i ? surface.pointCount++ : surface.point[first];
    }
    return positions.size() - surface.pointCount;
}

} // namespace tegument::prep
