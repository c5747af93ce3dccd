#include "lab/reference/fur_exact.h"

#include "host/support/parallel.h"
#include "meshprep/rays/box_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace tegument::reference {

namespace {

constexpr double kUnmet = std::numeric_limits<double>::infinity();

glm::dvec3 along(const glm::dvec3& v, const glm::dvec3& normal) {
    return v - normal * glm::dot(v, normal);
}

glm::dvec3 unitAlong(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : v;
}

/// From 1 at whole numbers to -1 halfway between them and back, each half a smoothstep.
double wave(double x) {
    const double part = x - std::floor(x);
    const double s = part < 0.5 ? 1 - 2 * part : 2 * part - 1;
    return -1 + 2 * s * s * (3 - 2 * s);
}

/// C. Ericson, Real-Time Collision Detection (2005), 5.1.5.
glm::dvec3 nearestWeights(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
    const glm::dvec3 ab = t[1] - t[0];
    const glm::dvec3 ac = t[2] - t[0];
    const double d1 = glm::dot(ab, p - t[0]);
    const double d2 = glm::dot(ac, p - t[0]);
    if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
    const double d3 = glm::dot(ab, p - t[1]);
    const double d4 = glm::dot(ac, p - t[1]);
    if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
    const double d5 = glm::dot(ab, p - t[2]);
    const double d6 = glm::dot(ac, p - t[2]);
    if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {0, 1 - w, w};
    }
    return glm::dvec3(va, vb, vc) / (va + vb + vc);
}

std::array<glm::dvec3, 3> cornersOf(const Mesh& mesh, std::uint32_t triangle) {
    std::array<glm::dvec3, 3> corners;
    for (std::size_t c = 0; c < 3; ++c)
        corners[c] = glm::dvec3(mesh.positions[mesh.indices[3 * std::size_t{triangle} + c]]);
    return corners;
}

/// The nearest place within `radius`, and how far it is.
std::optional<Place> nearestPlace(const RayScene& skin, const glm::dvec3& point, const glm::dvec3& facing, double radius, double& least) {
    std::optional<Place> nearest;
    least = radius;
    for (const std::uint32_t triangle : skin.around(point, radius)) {
        if (glm::dot(faceNormal(skin.mesh(), triangle), facing) < 0) continue;
        const auto corners = cornersOf(skin.mesh(), triangle);
        const glm::dvec3 weights = nearestWeights(point, corners);
        const double distance = glm::distance(point, weights.x * corners[0] + weights.y * corners[1] + weights.z * corners[2]);
        if (distance > least) continue;
        least = distance;
        nearest = Place{triangle, weights};
    }
    return nearest;
}

} // namespace

std::optional<OnSkin> nearestSkin(const RayScene& skin, const glm::dvec3& point, double radius, const glm::dvec3& facing) {
    constexpr double kFirst = 1.0 / 64; // of the radius: most points are near the skin, and what lies around them is much
    for (double within = kFirst * radius;; within = std::min(4 * within, radius)) {
        double distance = 0;
        if (const auto nearest = nearestPlace(skin, point, facing, within, distance)) {
            const SurfacePoint there = interpolate(skin.mesh(), *nearest);
            return OnSkin{.position = there.position, .normal = unitAlong(there.normal), .distance = distance};
        }
        if (within >= radius) return std::nullopt;
    }
}

namespace {

/// How far a strand's axis has gone aside at this height, without tufts.
glm::dvec3 strayOf(const FurStrandShape& shape, const FurGrown& strand, const glm::dvec3& normal, double h) {
    const glm::dvec3 side = unitAlong(along(strand.side, normal));
    const glm::dvec3 across = glm::cross(normal, side);
    const double angle = shape.turns * h; // turns
    const glm::dvec3 turned = wave(angle) * side + wave(angle + 0.75) * across;
    return strand.stray * shape.spacing * (shape.scatter * h * h * side + shape.curls * h * turned);
}

/// How far aside what is seen at this place of the skin stands without tufts: waves across waves.
glm::dvec3 tuftAt(const FurStrandShape& shape, const OnSkin& place, double h) {
    const glm::dvec3 p = (place.position - shape.origin) / (shape.spacing * shape.tuftSize);
    const glm::dvec3 slow(wave(0.19 * p.z), wave(0.19 * p.x), wave(0.19 * p.y));
    const glm::dvec3 waves(wave(0.31 * p.y + 0.4 * slow.x), wave(0.31 * p.z + 0.4 * slow.y), wave(0.31 * p.x + 0.4 * slow.z));
    return along(shape.tufts * shape.spacing * h * h * waves, place.normal);
}

/// The point of the skin below a strand's axis: the place p for which p + tuft(p) is where the strand would be without tufts. By
/// substitution, which converges where tufts draw strands together less than they are apart.
std::optional<OnSkin> footOf(const RayScene& skin, const FurStrandShape& shape, const OnSkin& root, const glm::dvec3& stray, double h) {
    constexpr int kMost = 60;
    const double reach = glm::length(stray) + 2 * shape.spacing * (shape.tufts + 1);
    const glm::dvec3 aim = root.position + stray;
    auto foot = nearestSkin(skin, aim, reach, root.normal);
    for (int i = 0; foot && shape.tufts > 0 && i < kMost; ++i) {
        const glm::dvec3 before = foot->position;
        // Half a step each time: waves as steep as 1 would leap to and fro.
        foot = nearestSkin(skin, before + 0.5 * (aim - tuftAt(shape, *foot, h) - before), reach, root.normal);
        if (foot && glm::distance(foot->position, before) < 1e-4 * shape.spacing) break;
    }
    return foot;
}

} // namespace

std::vector<FurJoint> axisOf(const RayScene& skin, const FurStrandShape& shape, const FurGrown& strand, int pieces) {
    const auto root = nearestSkin(skin, strand.root, shape.spacing);
    if (!root) return {};
    std::vector<FurJoint> joints;
    for (int i = 0; i <= pieces; ++i) {
        const double part = static_cast<double>(i) / pieces;
        const double h = strand.length * part;
        const auto foot = i == 0 ? root : footOf(skin, shape, *root, strayOf(shape, strand, root->normal, h), h);
        if (!foot) break;
        const glm::dvec3 up = foot->normal + h * (shape.lean + strand.lean);
        joints.push_back({.position = foot->position + shape.thickness * h * up,
                          .normal = foot->normal,
                          .height = h,
                          .radius = strand.radius * (1 - part)});
    }
    return joints;
}

namespace {

struct ConePiece {
    FurJoint from;
    FurJoint to;
    std::uint32_t strand = 0;
    bool round = false;

    /// Where a ray from outside enters: points that are, in the plane through them parallel to the skin, or across the axis, no further
    /// from it than the radius there. |e0 + t e1| = r0 + t r1, and between the ends.
    [[nodiscard]] double enter(const glm::dvec3& origin, const glm::dvec3& direction, double& part) const {
        const glm::dvec3 axis = to.position - from.position;
        const glm::dvec3 up = round ? unitAlong(axis) : unitAlong(from.normal + to.normal);
        const double rise = glm::dot(axis, up);
        if (!(rise > 0)) return kUnmet;
        const double s0 = glm::dot(origin - from.position, up) / rise;
        const double s1 = glm::dot(direction, up) / rise;
        const glm::dvec3 e0 = origin - from.position - s0 * axis;
        const glm::dvec3 e1 = direction - s1 * axis;
        const double r0 = from.radius + s0 * (to.radius - from.radius);
        const double r1 = s1 * (to.radius - from.radius);
        const double a = glm::dot(e1, e1) - r1 * r1;
        const double b = glm::dot(e0, e1) - r0 * r1;
        const double c = glm::dot(e0, e0) - r0 * r0;
        const double discriminant = b * b - a * c;
        double nearest = kUnmet;
        if (discriminant < 0 || a == 0) return nearest;
        for (const double t : {(-b - std::sqrt(discriminant)) / a, (-b + std::sqrt(discriminant)) / a}) {
            const double s = s0 + t * s1;
            if (t <= 0 || t >= nearest || s < 0 || s > 1) continue;
            nearest = t;
            part = s;
        }
        return nearest;
    }
};

PieceBox boxOf(const ConePiece& piece) {
    const double wide = std::max(piece.from.radius, piece.to.radius);
    // Somewhat wider, for boxes are in 32-bit floats.
    const glm::dvec3 margin = wide * 1.001 + 1e-5 * glm::abs(piece.from.position) + 1e-9;
    return {.low = glm::vec3(glm::min(piece.from.position, piece.to.position) - margin),
            .high = glm::vec3(glm::max(piece.from.position, piece.to.position) + margin)};
}

} // namespace

struct FurExact::State {
    const RayScene& skin;
    std::vector<FurGrown> strands;
    std::vector<ConePiece> pieces;
    std::optional<BoxTree> tree;

    State(const RayScene& on, std::vector<FurGrown> all) : skin(on), strands(std::move(all)) {}

    void grow(const FurStrandShape& shape, int count) {
        std::vector<std::vector<FurJoint>> axes(strands.size());
        forEachInParallel(strands.size(), [&](std::size_t i) { axes[i] = axisOf(skin, shape, strands[i], count); });
        for (std::uint32_t i = 0; i < axes.size(); ++i)
            for (std::size_t k = 1; k < axes[i].size(); ++k)
                pieces.push_back({.from = axes[i][k - 1], .to = axes[i][k], .strand = i, .round = shape.round});
    }

    void commit() {
        std::vector<PieceBox> boxes(pieces.size());
        std::ranges::transform(pieces, boxes.begin(), boxOf);
        tree.emplace(boxes);
    }
};

FurExact::FurExact(const RayScene& skin, const FurStrandShape& shape, std::vector<FurGrown> strands, int pieces)
    : state_(std::make_unique<State>(skin, std::move(strands))) {
    state_->grow(shape, pieces);
    state_->commit();
}

FurExact::~FurExact() = default;

std::optional<FurExact::Hit> FurExact::meet(const glm::dvec3& origin, const glm::dvec3& direction) const {
    constexpr double kBeyond = 1 + 1e-5; // what is left of the tree is cut off by a 32-bit float
    const auto skin = state_->skin.nearest(origin, direction);
    double nearest = kUnmet;
    if (skin) nearest = skin->distance;
    double part = 0;
    const ConePiece* met = nullptr;
    state_->tree->meetAlong(glm::vec3(origin), glm::vec3(direction), static_cast<float>(nearest * kBeyond), [&](std::uint32_t i) {
        const ConePiece& piece = state_->pieces[i];
        double at = 0;
        if (const double t = piece.enter(origin, direction, at); t < nearest) {
            nearest = t;
            part = at;
            met = &piece;
        }
        return static_cast<float>(nearest * kBeyond);
    });
    if (met) {
        const FurGrown& strand = state_->strands[met->strand];
        const double height = std::lerp(met->from.height, met->to.height, part);
        return Hit{.distance = nearest,
                   .normal = unitAlong(glm::mix(met->from.normal, met->to.normal, part)),
                   .height = height,
                   .along = height / strand.length,
                   .strand = &strand};
    }
    if (!skin) return std::nullopt;
    return Hit{.distance = skin->distance, .normal = unitAlong(interpolate(state_->skin.mesh(), skin->place).normal)};
}

std::vector<FurGrown> latticeOn(const RayScene& skin, const FurLattice& lattice, const std::function<bool(const glm::dvec3&)>& wanted) {
    constexpr double kNear = 0.5; // spacings from the skin
    std::vector<glm::i64vec3> cubes;
    const auto toLattice = [&](const glm::dvec3& p) { return (p - lattice.centre) / lattice.spacing; };
    for (std::uint32_t t = 0; t < skin.mesh().indices.size() / 3; ++t) {
        const auto [a, b, c] = cornersOf(skin.mesh(), t);
        if (!wanted((a + b + c) / 3.0)) continue;
        const glm::i64vec3 low(glm::floor(toLattice(glm::min(a, glm::min(b, c))) - kNear));
        const glm::i64vec3 high(glm::floor(toLattice(glm::max(a, glm::max(b, c))) + kNear));
        for (auto z = low.z; z <= high.z; ++z)
            for (auto y = low.y; y <= high.y; ++y)
                for (auto x = low.x; x <= high.x; ++x)
                    cubes.emplace_back(x, y, z);
    }
    const auto less = [](const glm::i64vec3& a, const glm::i64vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
    std::ranges::sort(cubes, less);
    cubes.erase(std::unique(cubes.begin(), cubes.end()), cubes.end());

    std::vector<std::optional<FurGrown>> grown(cubes.size());
    forEachInParallel(cubes.size(), [&](std::size_t i) {
        const LatticePoint point = latticePoint(cubes[i]);
        const auto there = nearestSkin(skin, lattice.centre + lattice.spacing * point.place, kNear * lattice.spacing);
        if (!there) return;
        // The outermost quarter of those distances shortens strands, down to nothing, lest they come and go.
        const double share = std::min(1.0, 4 * (1 - there->distance / (kNear * lattice.spacing)));
        const double length = share * std::lerp(lattice.shortest, 1.0, point.random.y);
        if (length <= 0) return;
        grown[i] = {.root = there->position,
                    .length = length,
                    .radius = lattice.radius * lattice.spacing,
                    .side = point.random - 0.5,
                    .tint = 1 + lattice.variation * (point.random.z - 0.5)};
    });
    std::vector<FurGrown> strands;
    for (const auto& strand : grown)
        if (strand) strands.push_back(*strand);
    return strands;
}

} // namespace tegument::reference
