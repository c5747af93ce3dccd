#include "meshprep/fur/roots/strata.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace tegument {

namespace {

constexpr double kFinest = 1.0 / (1 << 19); // side of a cube in a ball of radius 1: Morton numbers of 3 x 21 bits

std::uint64_t spread(std::uint64_t bits) {
    bits = (bits | bits << 32U) & 0x1f00000000ffffU;
    bits = (bits | bits << 16U) & 0x1f0000ff0000ffU;
    bits = (bits | bits << 8U) & 0x100f00f00f00f00fU;
    bits = (bits | bits << 4U) & 0x10c30c30c30c30c3U;
    return (bits | bits << 2U) & 0x1249249249249249U;
}

std::uint64_t mortonKey(const glm::vec3& position, double side) {
    // The unit ball, with room for rounding.
    const glm::dvec3 cell = glm::clamp(glm::floor((glm::dvec3(position) + 1.0) / side) + 1.0, 0.0, 2097151.0);
    return spread(static_cast<std::uint64_t>(cell.x)) | spread(static_cast<std::uint64_t>(cell.y)) << 1U |
           spread(static_cast<std::uint64_t>(cell.z)) << 2U;
}

} // namespace

Strata::Strata(const FurSurface& surface, double side, std::size_t wanted, const DensityAt& density) : surface_(surface), wanted_(wanted) {
    const double cube = std::max(side, kFinest);
    cutTriangles(cube / 2, 4 * wanted + 4096);
    gather(cube);
    shareOut(wanted, density);
}

glm::vec3 Strata::positionOf(const Piece& piece, const glm::vec2& weights) const {
    const std::uint32_t* t = &surface_.mesh().indices[3 * std::size_t{piece.triangle}];
    const auto& p = surface_.positions();
    return (1 - weights.x - weights.y) * p[t[0]] + weights.x * p[t[1]] + weights.y * p[t[2]];
}

/// At the middle of the longest edge, again and again. A mesh of long needles may ask for more pieces than there is use for: then some stay
/// longer, and counts are a little less local there.
void Strata::cutTriangles(double longest, std::size_t mostPieces) {
    const std::size_t triangles = surface_.mesh().indices.size() / 3;
    pieces_.reserve(triangles);
    std::vector<Piece> left;
    std::size_t cuts = 0;
    for (std::uint32_t triangle = 0; triangle < triangles; ++triangle) {
        left.push_back({.triangle = triangle});
        while (!left.empty()) {
            const Piece piece = left.back();
            left.pop_back();
            const std::array<glm::vec3, 3> p{positionOf(piece, piece.corners[0]), positionOf(piece, piece.corners[1]),
                                             positionOf(piece, piece.corners[2])};
            const std::array<float, 3> edges{glm::distance(p[1], p[2]), glm::distance(p[2], p[0]), glm::distance(p[0], p[1])};
            const auto opposite = static_cast<std::size_t>(std::ranges::max_element(edges) - edges.begin());
            if (!(static_cast<double>(edges[opposite]) > longest) || cuts >= mostPieces) {
                pieces_.push_back(piece);
                continue;
            }
            ++cuts;
            const std::size_t a = (opposite + 1) % 3;
            const std::size_t b = (opposite + 2) % 3;
            const glm::vec2 middle = 0.5F * (piece.corners[a] + piece.corners[b]);
            left.push_back(piece);
            left.back().corners[a] = middle;
            left.push_back(piece);
            left.back().corners[b] = middle;
        }
    }
}

void Strata::gather(double side) {
    std::unordered_map<std::uint64_t, std::uint32_t> numbers;
    std::vector<std::uint32_t> ofPiece;
    ofPiece.reserve(pieces_.size());
    std::vector<std::pair<std::uint64_t, std::uint32_t>> cubes; // Morton number, number by first sight
    for (const Piece& piece : pieces_) {
        const glm::vec2 middle = (piece.corners[0] + piece.corners[1] + piece.corners[2]) / 3.0F;
        const std::uint64_t key = mortonKey(positionOf(piece, middle), side);
        const auto [found, isNew] = numbers.try_emplace(key, static_cast<std::uint32_t>(cubes.size()));
        if (isNew) cubes.emplace_back(key, found->second);
        ofPiece.push_back(found->second);
    }
    std::ranges::sort(cubes);
    std::vector<std::uint32_t> rank(cubes.size());
    for (std::uint32_t i = 0; i < cubes.size(); ++i) {
        rank[cubes[i].second] = i;
        strata_.push_back({.key = cubes[i].first});
    }
    // Counted, then dealt out: pieces keep their order within a stratum.
    std::vector<std::uint32_t> next(cubes.size() + 1, 0);
    for (std::uint32_t& stratum : ofPiece)
        ++next[(stratum = rank[stratum]) + 1];
    for (std::size_t i = 0; i < strata_.size(); ++i) {
        strata_[i].firstPiece = next[i];
        next[i + 1] += next[i];
    }
    std::vector<Piece> ordered(pieces_.size());
    stratumOfPiece_.resize(pieces_.size());
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const std::uint32_t to = next[ofPiece[i]]++;
        ordered[to] = pieces_[i];
        stratumOfPiece_[to] = ofPiece[i];
    }
    pieces_ = std::move(ordered);
}

double Strata::meanDensity(const Piece& piece, const DensityAt& density) const {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) // the middles of the edges are exact for polynomials of the second degree
        sum += density(surface_.at(piece.triangle, 0.5F * (piece.corners[i] + piece.corners[(i + 1) % 3])));
    return sum / 3;
}

void Strata::shareOut(std::size_t wanted, const DensityAt& density) {
    area_.assign(1, 0);
    if (density) weight_.assign(1, 0);
    for (const Piece& piece : pieces_) {
        const auto& c = piece.corners;
        const glm::dvec3 a(positionOf(piece, c[0]));
        const glm::dvec3 normal = glm::cross(glm::dvec3(positionOf(piece, c[1])) - a, glm::dvec3(positionOf(piece, c[2])) - a);
        const double area = glm::length(normal) / 2;
        area_.push_back(area_.back() + area);
        if (density) weight_.push_back(weight_.back() + area * meanDensity(piece, density));
    }
    const std::vector<double>& weight = density ? weight_ : area_;
    const double perWeight = weight.back() > 0 ? static_cast<double>(wanted) / weight.back() : 0;
    for (Stratum& stratum : strata_)
        stratum.rootsBefore = static_cast<std::size_t>(std::floor(weight[stratum.firstPiece] * perWeight + 0.5));
}

double Strata::density(const Run& run) const {
    if (weight_.empty()) return 1;
    const std::size_t from = firstPiece(run.first);
    const std::size_t to = firstPiece(run.last);
    const double area = area_[to] - area_[from];
    return area > 0 ? (weight_[to] - weight_[from]) / area : 0;
}

Strata::Place Strata::point(const Run& run, const glm::dvec3& uniform) const {
    const auto from = area_.begin() + static_cast<std::ptrdiff_t>(firstPiece(run.first));
    const auto to = area_.begin() + static_cast<std::ptrdiff_t>(firstPiece(run.last));
    const double at = std::min(*from + uniform.x * (*to - *from), std::nextafter(*to, *from)); // the sum rounds
    const auto piece = static_cast<std::size_t>(std::upper_bound(from + 1, to, at) - 1 - area_.begin());
    const std::array<glm::vec2, 3>& c = pieces_[piece].corners;
    const double root = std::sqrt(uniform.y); // R. Osada et al., Shape Distributions, 2002, eq. 1
    const auto second = static_cast<float>(root * (1 - uniform.z));
    const auto third = static_cast<float>(root * uniform.z);
    const glm::vec2 weights = (1 - second - third) * c[0] + second * c[1] + third * c[2];
    return {.point = surface_.at(pieces_[piece].triangle, weights), .stratum = stratumOfPiece_[piece]};
}

} // namespace tegument
