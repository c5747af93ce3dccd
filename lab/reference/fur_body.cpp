#include "lab/reference/fur_body.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace tegument::reference {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// Where along the ray, and how high along the cone, the ray enters it; none if it does not from `begin` on.
struct ConeHit {
    double distance = kFar;
    double along = 0;
};

/// |X - axis|^2 = (r (1 - a / L))^2 with a = (X - root) . n, a quadratic along the ray; of its roots those with a in [0, L].
ConeHit meetStraightCone(const FurCone& cone, const glm::dvec3& origin, const glm::dvec3& direction, double begin) {
    const glm::dvec3 from = origin - cone.root;
    const double a0 = glm::dot(from, cone.normal);
    const double a1 = glm::dot(direction, cone.normal);
    const glm::dvec3 p = from - a0 * cone.normal;
    const glm::dvec3 q = direction - a1 * cone.normal;
    const double slope = cone.radius / cone.length;
    const double r0 = cone.radius - slope * a0;
    const double r1 = -slope * a1;
    const double a = glm::dot(q, q) - r1 * r1;
    const double b = glm::dot(p, q) - r0 * r1;
    const double c = glm::dot(p, p) - r0 * r0;
    const double discriminant = b * b - a * c;
    ConeHit hit;
    if (discriminant < 0 || a == 0) return hit;
    for (const double t : {(-b - std::sqrt(discriminant)) / a, (-b + std::sqrt(discriminant)) / a}) {
        const double height = a0 + a1 * t;
        if (t < begin || t >= hit.distance || height < 0 || height > cone.length) continue;
        hit = {t, height / cone.length};
    }
    return hit;
}

} // namespace

OnFurBody onFurBody(const FurBody& body, const glm::dvec3& point) {
    const double across = std::hypot(point.x, point.z);
    const glm::dvec3 centre = across > 0 ? glm::dvec3(point.x, 0, point.z) * (body.ring / across) : glm::dvec3(body.ring, 0, 0);
    const glm::dvec3 out = point - centre;
    const double distance = glm::length(out);
    const glm::dvec3 normal = distance > 0 ? out / distance : glm::dvec3(0, 1, 0);
    return {.skin = centre + body.radius * normal, .normal = normal, .distance = distance - body.radius};
}

FurOnBody::FurOnBody(const FurBody& body, double coat, std::vector<FurCone> strands)
    : body_(body), coat_(coat), strands_(std::move(strands)) {
    assert(!strands_.empty());
    for (const FurCone& cone : strands_)
        radius_ += cone.radius / static_cast<double>(strands_.size());
    cell_ = 4 * radius_;
    const glm::dvec3 half(body.ring + body.radius + coat + cell_, body.radius + coat + cell_, body.ring + body.radius + coat + cell_);
    origin_ = -half;
    cells_ = glm::ivec3(glm::ceil(2.0 * half / cell_));
    grid_.resize(static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.y) * static_cast<std::size_t>(cells_.z));
    for (std::uint32_t i = 0; i < strands_.size(); ++i)
        list(i);
}

std::size_t FurOnBody::cell(const glm::dvec3& point) const {
    const glm::dvec3 c = glm::clamp(glm::floor((point - origin_) / cell_), glm::dvec3(0), glm::dvec3(cells_ - 1));
    return static_cast<std::size_t>(c.x + cells_.x * (c.y + cells_.y * c.z));
}

void FurOnBody::list(std::uint32_t strand) {
    const FurCone& cone = strands_[strand];
    const glm::dvec3 tip = cone.root + cone.length * cone.normal;
    // A section carried by the skin is as much wider as the coat: at most twice here.
    const glm::dvec3 wide(2 * cone.radius);
    const glm::ivec3 low(glm::floor((glm::min(cone.root, tip) - wide - origin_) / cell_));
    const glm::ivec3 high(glm::floor((glm::max(cone.root, tip) + wide - origin_) / cell_));
    const double near = 2 * cone.radius + cell_ * std::sqrt(0.75);
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x) {
                const glm::dvec3 centre = origin_ + cell_ * (glm::dvec3(x, y, z) + 0.5);
                const double along = std::clamp(glm::dot(centre - cone.root, cone.normal), 0.0, cone.length);
                if (glm::distance(centre, cone.root + along * cone.normal) > near) continue;
                grid_[cell(centre)].push_back(strand);
            }
}

std::vector<FurOnBody::Stretch> FurOnBody::inCoat(const glm::dvec3& origin, const glm::dvec3& direction) const {
    // Steps of the distance to the coat lead to it, and those of the distance to either of its sides through it, without missing either.
    const double near = 1e-6 * body_.radius;
    const double away = glm::length(origin) + body_.ring + body_.radius + coat_;
    std::vector<Stretch> parts;
    bool within = false;
    for (double t = 0; t < 2 * away;) {
        const double distance = onFurBody(body_, origin + t * direction).distance;
        if (within != (distance < coat_)) {
            within = !within;
            if (within)
                parts.push_back({.begin = t});
            else
                parts.back().end = t;
        }
        if (distance < near) {
            parts.back().end = t;
            parts.back().skin = true;
            return parts;
        }
        t += std::max(near, within ? std::min(distance, std::max(coat_ - distance, near)) : distance - coat_);
    }
    return parts;
}

std::optional<double> FurOnBody::meetCones(const glm::dvec3& origin, const glm::dvec3& direction, const Stretch& part) const {
    ConeHit nearest{.distance = part.end};
    bool found = false;
    const glm::dvec3 inverse = 1.0 / direction;
    for (double t = part.begin; t < nearest.distance;) {
        const glm::dvec3 at = origin + t * direction;
        for (const std::uint32_t i : grid_[cell(at)]) {
            const ConeHit hit = meetStraightCone(strands_[i], origin, direction, part.begin);
            if (hit.distance >= nearest.distance) continue;
            nearest = hit;
            found = true;
        }
        // A little beyond the cell's face, so that rounding does not find the same cell again.
        const glm::dvec3 corner = origin_ + cell_ * (glm::floor((at - origin_) / cell_) + glm::step(0.0, direction));
        const glm::dvec3 exits = (corner - at) * inverse;
        double out = kFar;
        for (int c = 0; c < 3; ++c)
            if (direction[c] != 0) out = std::min(out, exits[c]);
        t += out + 1e-6 * cell_;
    }
    return found ? std::optional(nearest.along) : std::nullopt;
}

std::optional<double> FurOnBody::meetSections(const glm::dvec3& origin, const glm::dvec3& direction, const Stretch& part,
                                              double step) const {
    const auto steps = static_cast<std::size_t>(std::ceil((part.end - part.begin) / (step * radius_)));
    for (std::size_t i = 0; i < steps; ++i) {
        const double t = part.begin + static_cast<double>(i) * step * radius_;
        const glm::dvec3 point = origin + t * direction;
        const OnFurBody at = onFurBody(body_, point);
        std::optional<double> lowest;
        for (const std::uint32_t strand : grid_[cell(point)]) {
            const FurCone& cone = strands_[strand];
            const double along = at.distance / cone.length;
            const glm::dvec3 aside = at.skin - cone.root;
            const double distance = glm::length(aside - at.normal * glm::dot(aside, at.normal));
            if (along >= 0 && along < 1 && distance <= cone.radius * (1 - along)) lowest = std::min(lowest.value_or(1), along);
        }
        if (lowest) return lowest;
    }
    return std::nullopt;
}

std::optional<FurOnBody::Hit> FurOnBody::meet(const glm::dvec3& origin, const glm::dvec3& direction, FurShape shape, double step) const {
    const auto parts = inCoat(origin, direction);
    for (const Stretch& part : parts) {
        const auto along = shape == FurShape::Cones ? meetCones(origin, direction, part) : meetSections(origin, direction, part, step);
        if (along) return Hit{.strand = true, .along = *along};
        if (part.skin) return Hit{.strand = false, .along = 0};
    }
    return std::nullopt;
}

} // namespace tegument::reference
