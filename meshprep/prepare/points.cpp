#include "meshprep/prepare/points.h"

#include "host/mesh/extent.h"
#include "host/mesh/welding.h"
#include "meshprep/prepare/edges.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
    if (same.epsilon.value_or(0) > 0) return NearPlaces(positions, *same.epsilon).find();
    return weldPositions(positions);
}

/// Numbers the places, given the first vertex of each vertex's place.
void number(Surface& surface, const std::vector<std::uint32_t>& firsts) {
    std::vector<glm::vec3>& positions = surface.mesh.positions;
    surface.point.resize(positions.size());
    surface.pointCount = 0;
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        const std::uint32_t first = firsts[i];  // at most i, so its number is known
        positions[i] = positions[first] + 0.0f; // -0 becomes 0: the sign would come back as a difference later
        surface.point[i] = first == i ? surface.pointCount++ : surface.point[first];
    }
}

/// Corners that some program computed twice, and once rounded the other way: a crack that nobody sees and every later step stumbles over.
class Cracks {
public:
    Cracks(const Surface& surface, double reach) : surface_(surface), shortest_(surface.pointCount, 0) {
        const Extent extent = extentOf(surface.mesh.positions);
        const double greatest = std::max(extent.longest / 2, reach);
        const auto step = static_cast<float>(greatest);
        width_ =
            std::sqrt(3.0) * (static_cast<double>(std::nextafter(step, std::numeric_limits<float>::max())) - static_cast<double>(step));
    }

    [[nodiscard]] double width() const { return width_; }

    /// For each place the one that it is joined to, or itself. `firsts`: the first vertex of each vertex's place.
    std::vector<std::uint32_t> close(const std::vector<std::uint32_t>& firsts) {
        std::vector<std::uint32_t> joined = firsts;
        if (!(width_ > 0) || !std::isfinite(width_) || !findBorder()) return joined;
        measureSides();
        std::vector<std::uint32_t> vertices; // the first ones of places on borders
        std::vector<glm::vec3> places;
        for (std::uint32_t v = 0; v < firsts.size(); ++v)
            if (firsts[v] == v && onBorder_[surface_.point[v]]) {
                vertices.push_back(v);
                places.push_back(surface_.mesh.positions[v]);
            }
        const std::vector<std::uint32_t> near = NearPlaces(places, width_).find();
        for (std::size_t i = 0; i < near.size(); ++i)
            if (near[i] != i && fits(vertices[i], vertices[near[i]])) joined[vertices[i]] = vertices[near[i]];
        for (std::uint32_t v = 0; v < joined.size(); ++v)
            joined[v] = joined[joined[v]]; // of vertices at an exactly equal place, too
        return joined;
    }

private:
    static constexpr double kMostOfSide = 0.01;

    bool findBorder() {
        onBorder_.assign(surface_.pointCount, false);
        bool any = false;
        EdgeTable(surface_).forEach([&](std::span<const HalfEdge> sides) {
            if (sides.size() != 1) return;
            onBorder_[surface_.pointAt(sides[0].corner)] = true;
            onBorder_[surface_.pointAt(nextCorner(sides[0].corner))] = true;
            any = true;
        });
        return any;
    }

    /// The shortest side of the triangles at each place.
    void measureSides() {
        const Mesh& mesh = surface_.mesh;
        shortest_.assign(surface_.pointCount, std::numeric_limits<double>::infinity());
        for (std::uint32_t corner = 0; corner < mesh.indices.size(); ++corner) {
            const std::uint32_t a = surface_.pointAt(corner);
            const std::uint32_t b = surface_.pointAt(nextCorner(corner));
            if (a == b || (!onBorder_[a] && !onBorder_[b])) continue;
            const double length = glm::distance(glm::dvec3(mesh.positions[mesh.indices[corner]]),
                                                glm::dvec3(mesh.positions[mesh.indices[nextCorner(corner)]]));
            shortest_[a] = std::min(shortest_[a], length);
            shortest_[b] = std::min(shortest_[b], length);
        }
    }

    [[nodiscard]] bool fits(std::uint32_t a, std::uint32_t b) const {
        const auto& positions = surface_.mesh.positions;
        const double apart = glm::distance(glm::dvec3(positions[a]), glm::dvec3(positions[b]));
        return apart < kMostOfSide * std::min(shortest_[surface_.point[a]], shortest_[surface_.point[b]]);
    }

    const Surface& surface_;
    std::vector<bool> onBorder_;
    std::vector<double> shortest_;
    double width_ = 0;
};

} // namespace

Places findPlaces(Surface& surface, const SamePlace& same, double reach) {
    const std::vector<std::uint32_t> firsts = firstOfPlace(surface.mesh.positions, same);
    number(surface, firsts);
    Places places;
    if (!same.epsilon && !same.decimals && !surface.mesh.indices.empty()) {
        Cracks cracks(surface, reach);
        const std::size_t before = surface.pointCount;
        const std::vector<std::uint32_t> joined = cracks.close(firsts);
        if (joined != firsts) number(surface, joined);
        places = {.joined = 0, .cracks = before - surface.pointCount, .crackWidth = cracks.width()};
    }
    places.joined = surface.mesh.positions.size() - surface.pointCount;
    return places;
}

} // namespace tegument::prep
