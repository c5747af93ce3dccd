#include "meshprep/portrait/mirror_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

namespace tegument {

namespace {

/// Nearest sample by a grid of cells as wide as the farthest that is asked for.
class NearSamples {
public:
    NearSamples(const std::vector<SurfaceSample>& samples, std::size_t every, double reach) : reach_(reach) {
        for (std::size_t i = every / 2; i < samples.size(); i += every)
            points_.push_back(&samples[i]);
        low_ = glm::dvec3(INFINITY);
        glm::dvec3 high(-INFINITY);
        for (const SurfaceSample* s : points_)
            low_ = glm::min(low_, s->point), high = glm::max(high, s->point);
        for (int axis = 0; axis < 3; ++axis)
            side_[axis] = std::clamp(static_cast<int>((high[axis] - low_[axis]) / reach_) + 1, 1, 128);
        cells_.resize(static_cast<std::size_t>(side_.x) * static_cast<std::size_t>(side_.y) * static_cast<std::size_t>(side_.z));
        for (const SurfaceSample* s : points_) {
            const glm::ivec3 cell = glm::clamp(glm::ivec3((s->point - low_) / reach_), glm::ivec3(0), side_ - 1);
            cells_[index(cell)].push_back(s);
        }
    }

    /// None within reach, or none that faces alike.
    [[nodiscard]] const SurfaceSample* find(const glm::dvec3& point, const glm::dvec3& normal) const {
        const glm::dvec3 place = glm::floor((point - low_) / reach_);
        const SurfaceSample* best = nullptr;
        double least = reach_ * reach_;
        for (int z = -1; z <= 1; ++z)
            for (int y = -1; y <= 1; ++y)
                for (int x = -1; x <= 1; ++x) {
                    const glm::dvec3 cell = place + glm::dvec3(x, y, z);
                    if (cell.x < 0 || cell.y < 0 || cell.z < 0 || cell.x >= side_.x || cell.y >= side_.y || cell.z >= side_.z) continue;
                    for (const SurfaceSample* s : cells_[index(glm::ivec3(cell))]) {
                        const glm::dvec3 way = s->point - point;
                        const double distance = glm::dot(way, way);
                        if (distance < least && glm::dot(s->normal, normal) > 0.3) least = distance, best = s;
                    }
                }
        return best;
    }

private:
    double reach_;
    std::vector<const SurfaceSample*> points_;
    glm::dvec3 low_{0};
    glm::ivec3 side_{1};
    std::vector<std::vector<const SurfaceSample*>> cells_;

    [[nodiscard]] std::size_t index(const glm::ivec3& cell) const {
        return (static_cast<std::size_t>(cell.z) * static_cast<std::size_t>(side_.y) + static_cast<std::size_t>(cell.y)) *
                   static_cast<std::size_t>(side_.x) +
               static_cast<std::size_t>(cell.x);
    }
};

/// The eigenvector of the smallest eigenvalue of a symmetric matrix, by Jacobi's rotations.
glm::dvec3 smallestAxis(glm::dmat3 a) {
    glm::dmat3 v(1);
    for (int sweep = 0; sweep < 24; ++sweep)
        for (const auto& [p, q] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
            if (std::abs(a[p][q]) < 1e-300) continue;
            const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
            const double t = (theta >= 0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1));
            const double c = 1 / std::sqrt(t * t + 1), s = t * c;
            glm::dmat3 turn(1);
            turn[p][p] = c, turn[q][q] = c, turn[q][p] = s, turn[p][q] = -s;
            a = glm::transpose(turn) * a * turn;
            v = v * turn;
        }
    int least = 0;
    for (int i = 1; i < 3; ++i)
        if (a[i][i] < a[least][least]) least = i;
    return glm::normalize(v[least]);
}

glm::dvec3 mirrored(const glm::dvec3& v, const glm::dvec3& normal) {
    return v - 2 * glm::dot(v, normal) * normal;
}

class Search {
public:
    explicit Search(const std::vector<SurfaceSample>& samples) : samples_(samples) {
        for (const SurfaceSample& s : samples)
            centre_ += s.point / static_cast<double>(samples.size());
        double square = 0;
        for (const SurfaceSample& s : samples)
            square += glm::dot(s.point - centre_, s.point - centre_) / static_cast<double>(samples.size());
        radius_ = std::sqrt(square);
        coarse_.emplace(samples, std::max<std::size_t>(1, samples.size() / 4000), radius_ / 3);
    }

    [[nodiscard]] double likeness(const MirrorPlane& plane, std::size_t queries) const {
        const double reach = radius_ / 3;
        double sum = 0;
        std::size_t count = 0;
        const std::size_t every = std::max<std::size_t>(1, samples_.size() / queries);
        for (std::size_t i = every / 3; i < samples_.size(); i += every, ++count) {
            const glm::dvec3 image = plane.point + mirrored(samples_[i].point - plane.point, plane.normal);
            const SurfaceSample* near = coarse_->find(image, mirrored(samples_[i].normal, plane.normal));
            sum += near ? std::min(1.0, glm::length(near->point - image) / reach) : 1.0;
        }
        return 1 - sum / static_cast<double>(count);
    }

    /// Moves the plane until each point's mirror image lies as near as can be to the surface.
    void refine(MirrorPlane& plane) const {
        const std::size_t every = std::max<std::size_t>(1, samples_.size() / 800);
        for (int step = 0; step < 15; ++step) {
            const double reach = radius_ / (step < 5 ? 3 : step < 10 ? 8 : 16);
            glm::dvec3 middle(0);
            std::vector<std::pair<glm::dvec3, glm::dvec3>> pairs;
            for (std::size_t i = every / 3; i < samples_.size(); i += every) {
                const glm::dvec3 image = plane.point + mirrored(samples_[i].point - plane.point, plane.normal);
                const SurfaceSample* near = coarse_->find(image, mirrored(samples_[i].normal, plane.normal));
                if (!near) continue;
                // Only how far the image lies off the surface counts: along it samples lie where they happen to.
                const glm::dvec3 off = glm::dot(near->point - image, near->normal) * near->normal;
                if (glm::length(near->point - image) > reach) continue;
                pairs.emplace_back(samples_[i].point, image + off);
                middle += (samples_[i].point + image + off) / 2.0;
            }
            if (pairs.size() < 50) return;
            middle /= static_cast<double>(pairs.size());
            glm::dmat3 sum(0);
            for (const auto& [p, q] : pairs) {
                const glm::dvec3 a = p - middle, b = q - middle;
                sum += glm::outerProduct(a, b) + glm::outerProduct(b, a);
            }
            plane.point = middle;
            plane.normal = smallestAxis(sum);
        }
        plane.point = centre_ - glm::dot(centre_ - plane.point, plane.normal) * plane.normal;
    }

    [[nodiscard]] const glm::dvec3& centre() const { return centre_; }

private:
    const std::vector<SurfaceSample>& samples_;
    glm::dvec3 centre_{0};
    double radius_ = 0;
    std::optional<NearSamples> coarse_;
};

/// One of each pair of opposite directions; all axes of a file are alike among them.
std::vector<glm::dvec3> directions() {
    std::vector<glm::dvec3> all;
    constexpr int kMost = 3;
    for (int x = -kMost; x <= kMost; ++x)
        for (int y = -kMost; y <= kMost; ++y)
            for (int z = 0; z <= kMost; ++z) {
                if (z == 0 && (y < 0 || (y == 0 && x <= 0))) continue;
                if (std::gcd(std::gcd(x, y), z) == 1) all.push_back(glm::normalize(glm::dvec3(x, y, z)));
            }
    return all;
}

} // namespace

std::vector<MirrorPlane> mirrorPlanes(const std::vector<SurfaceSample>& samples) {
    const Search search(samples);
    std::vector<MirrorPlane> planes;
    for (const glm::dvec3& normal : directions()) {
        planes.push_back({.normal = normal, .point = search.centre()});
        planes.back().likeness = search.likeness(planes.back(), 300);
    }
    constexpr std::size_t kRefined = 6;
    std::ranges::sort(planes, std::greater(), &MirrorPlane::likeness);
    planes.resize(std::min(planes.size(), kRefined));
    for (MirrorPlane& plane : planes) {
        search.refine(plane);
        plane.likeness = search.likeness(plane, 2000);
    }
    std::ranges::sort(planes, std::greater(), &MirrorPlane::likeness);
    constexpr double kNearlyAsGood = 0.06;
    constexpr double kSame = 0.97; // cosine
    std::vector<MirrorPlane> kept;
    for (const MirrorPlane& plane : planes) {
        const bool known =
            std::ranges::any_of(kept, [&](const MirrorPlane& k) { return std::abs(glm::dot(k.normal, plane.normal)) > kSame; });
        if (!known && kept.size() < 3 && (kept.empty() || plane.likeness > kept.front().likeness - kNearlyAsGood)) kept.push_back(plane);
    }
    return kept;
}

} // namespace tegument
