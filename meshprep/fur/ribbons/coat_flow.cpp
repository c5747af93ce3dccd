#include "meshprep/fur/ribbons/coat_flow.h"

#include "host/support/parallel.h"
#include "meshprep/fur/roots/point_grid.h"
#include "meshprep/rays/surface_tree.h"

#include <algorithm>
#include <cmath>

namespace tegument {

namespace {

constexpr std::size_t kMostSamples = 4096; // of the coat: their mean distance is 0.03 to 0.04 of a compact body's radius
constexpr float kReach = 2.0F;             // of a sample's neighbours, in mean distances
constexpr float kSameSheet = 0.2F;         // least cosine of two normals of one sheet
constexpr float kAside = 0.7F;             // and how far, of its distance, a neighbour may lie off the tangent plane
/// How strongly directions follow the comb, against their neighbours: they bend over about 1.4 / sqrt(this) = 8 distances, a quarter of a
/// body's radius. Where the comb has a source or sink, as on a knee that juts out, neighbours decide, and many of them vanish.
constexpr float kFollow = 0.03F;
constexpr int kRounds = 80; // of Gauss and Seidel: a change then reaches farther than directions bend
constexpr int kSmoothings = 6;
constexpr float kThin = 0.10F;  // shares of the radius: thinner parts have short fur, as ears,
constexpr float kThick = 0.38F; // thicker ones long
constexpr float kSharp = 9.0F;  // curvature, 1 / radii: of a nose
constexpr float kRound = 3.0F;  // of a head
// Where a body of its own comb has its head: shares of its length from the front, of its height from below, between which the head begins.
constexpr glm::vec2 kHeadEnds{0.25F, 0.5F};
constexpr glm::vec2 kHeadBegins{0.35F, 0.55F};
constexpr float kFace = 0.35F; // how steeply the comb rises there

float smoothstep(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
    return t * t * (3 - 2 * t);
}

glm::vec3 across(const glm::vec3& v, const glm::vec3& normal) {
    return v - normal * glm::dot(v, normal);
}

/// Turned with the normal along the shortest way from one tangent plane into another.
glm::vec3 carried(const glm::vec3& v, const glm::vec3& from, const glm::vec3& to) {
    const float cosine = glm::dot(from, to);
    const glm::vec3 axis = glm::cross(from, to);
    return v * cosine + glm::cross(axis, v) + axis * (glm::dot(axis, v) / (1 + cosine));
}

struct Neighbour {
    std::uint32_t sample = 0;
    float weight = 0;
};

/// A few thousand places of the coat, and who lies beside whom on the same sheet.
class Samples {
public:
    Samples(const RootedMesh& rooted, std::size_t step)
        : between_(rooted.spacing * std::sqrt(static_cast<float>(step))), grid_(reach(), rooted.roots.size() / step) {
        for (std::size_t i = step / 2; i < rooted.roots.size(); i += step) {
            grid_.add(rooted.roots[i].position, rooted.roots[i].normal, 0);
            of_.push_back(i);
        }
        for (std::size_t i = 0; i < of_.size(); ++i) {
            const PointGrid::Entry& here = grid_.entries()[i];
            first_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
            around(here.position, here.normal, [&](const Neighbour& other) {
                if (other.sample != i) neighbours_.push_back(other);
            });
        }
        first_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
    }

    [[nodiscard]] std::size_t count() const { return of_.size(); }
    [[nodiscard]] std::size_t root(std::size_t sample) const { return of_[sample]; }
    [[nodiscard]] const glm::vec3& position(std::size_t sample) const { return grid_.entries()[sample].position; }
    [[nodiscard]] const glm::vec3& normal(std::size_t sample) const { return grid_.entries()[sample].normal; }
    [[nodiscard]] std::span<const Neighbour> of(std::size_t sample) const {
        return std::span(neighbours_).subspan(first_[sample], first_[sample + 1] - first_[sample]);
    }

    /// The samples on the sheet of a place, once each unless two cells share a bucket, nearer ones weighing more.
    template <class Visit>
    void around(const glm::vec3& position, const glm::vec3& normal, Visit&& visit) const {
        grid_.visit(position, reach(), [&](std::uint32_t i, float squared) {
            const PointGrid::Entry& other = grid_.entries()[i];
            const float off = glm::dot(other.position - position, normal);
            if (glm::dot(other.normal, normal) > kSameSheet && off * off <= kAside * kAside * squared + 1e-12F)
                visit(Neighbour{i, std::exp(-squared / (between_ * between_))});
            return true;
        });
    }

private:
    [[nodiscard]] float reach() const { return kReach * between_; }

    float between_;
    PointGrid grid_;
    std::vector<std::size_t> of_;
    std::vector<std::uint32_t> first_;
    std::vector<Neighbour> neighbours_;
};

/// Directions that follow what they are told and their neighbours: the minimum of sum w |u_i - T u_j|^2 + kFollow sum w |u_i - c_i|^2 (the
/// vector form of a screened Poisson equation; F. Knoeppel et al., Globally Optimal Direction Fields, 2013, has the operator).
std::vector<glm::vec3> directions(const Samples& samples, const std::vector<glm::vec3>& told) {
    std::vector<glm::vec3> u = told;
    for (int round = 0; round < kRounds; ++round)
        for (std::size_t i = 0; i < samples.count(); ++i) {
            glm::vec3 sum(0);
            float weights = 0;
            for (const Neighbour& other : samples.of(i)) {
                sum += other.weight * carried(u[other.sample], samples.normal(other.sample), samples.normal(i));
                weights += other.weight;
            }
            const float own = kFollow * std::max(weights, 1e-6F);
            u[i] = across(sum + own * told[i], samples.normal(i)) / (weights + own);
        }
    return u;
}

/// Of the body below a place: to where a ray along -normal leaves it.
float thickness(const SurfaceTree& tree, const Samples& samples, std::size_t i) {
    const auto hit = tree.nearest(samples.position(i), -samples.normal(i), {.first = 1e-3F, .last = kThick});
    return hit ? hit->distance : kThick;
}

/// Convex curvature: the change of normals along the way between neighbours.
float curvature(const Samples& samples, std::size_t i) {
    float changes = 0;
    float ways = 1e-12F;
    for (const Neighbour& other : samples.of(i)) {
        const glm::vec3 way = samples.position(other.sample) - samples.position(i);
        changes += other.weight * glm::dot(samples.normal(other.sample) - samples.normal(i), way);
        ways += other.weight * glm::dot(way, way);
    }
    return changes / ways;
}

std::vector<float> smoothed(const Samples& samples, std::vector<float> values) {
    std::vector<float> next(values.size());
    for (int round = 0; round < kSmoothings; ++round) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            float sum = values[i];
            float weights = 1;
            for (const Neighbour& other : samples.of(i)) {
                sum += other.weight * values[other.sample];
                weights += other.weight;
            }
            next[i] = sum / weights;
        }
        values.swap(next);
    }
    return values;
}

std::vector<float> shortnessOf(const RootedMesh& rooted, const Samples& samples, unsigned threads) {
    std::vector<glm::vec3> positions;
    positions.reserve(rooted.mesh.positions.size());
    for (const glm::vec3& position : rooted.mesh.positions)
        positions.push_back((position - rooted.mesh.bounds.centre) / rooted.mesh.bounds.radius);
    const SurfaceTree tree(positions, rooted.mesh.indices, {.quick = true, .threads = threads == 1 ? 1U : 0U});
    std::vector<float> values(samples.count());
    inChunks(samples.count(), threads, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i)
            values[i] = std::max(1 - smoothstep(kThin, kThick, thickness(tree, samples, i)),
                                 0.7F * smoothstep(kRound, kSharp, curvature(samples, i)));
    });
    return smoothed(samples, std::move(values));
}

/// The comb at each place. On the head a coat runs from the nose up and back, where the body's runs back and down: its source lies at the
/// nose then, and not on the forehead, which looks against the body's comb.
std::vector<glm::vec3> combsOfBody(std::span<const glm::vec3> places, const glm::vec3& comb, const glm::vec3& up) {
    const glm::vec3 back = comb - up * glm::dot(comb, up);
    std::vector<glm::vec3> combs(places.size(), comb);
    if (!(glm::length(back) > 0.5F) || places.empty()) return combs; // as round as high: it has no head
    const glm::vec3 axis = glm::normalize(back);
    glm::vec2 low(glm::dot(places.front(), axis), glm::dot(places.front(), up));
    glm::vec2 high = low;
    for (const glm::vec3& place : places) {
        const glm::vec2 at(glm::dot(place, axis), glm::dot(place, up));
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
        const glm::vec2 at = (glm::vec2(glm::dot(places[i], axis), glm::dot(places[i], up)) - low) / glm::max(high - low, 1e-6F);
        const float head = (1 - smoothstep(kHeadEnds.x, kHeadEnds.y, at.x)) * smoothstep(kHeadBegins.x, kHeadBegins.y, at.y);
        combs[i] = glm::normalize(glm::mix(comb, axis + kFace * up, head));
    }
    return combs;
}

} // namespace

glm::dvec3 combOfShape(std::span<const glm::vec3> positions, const glm::dvec3& down) {
    const glm::dvec3 up = -glm::normalize(down);
    const glm::dvec3 aside = std::abs(up.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 x = glm::normalize(aside - up * glm::dot(aside, up));
    const glm::dvec3 z = glm::cross(x, up);
    glm::dvec3 mean(0);
    for (const glm::vec3& p : positions)
        mean += glm::dvec3(p) / static_cast<double>(positions.size());
    double xx = 0, xz = 0, zz = 0, xh = 0, zh = 0;
    for (const glm::vec3& position : positions) {
        const glm::dvec3 p = glm::dvec3(position) - mean;
        const double a = glm::dot(p, x), b = glm::dot(p, z), height = glm::dot(p, up);
        xx += a * a, xz += a * b, zz += b * b, xh += a * height, zh += b * height;
    }
    const double angle = 0.5 * std::atan2(2 * xz, xx - zz); // of the longest axis
    const double spreadMost = (xx + zz) / 2 + std::hypot((xx - zz) / 2, xz);
    const double spreadLeast = std::max((xx + zz) / 2 - std::hypot((xx - zz) / 2, xz), 0.0);
    const double longer = spreadMost > 0 ? 1 - std::sqrt(spreadLeast / spreadMost) : 0; // 0 as round as it can be, 1 a line
    const double head = xh * std::cos(angle) + zh * std::sin(angle) > 0 ? 1 : -1;
    const glm::dvec3 back = -head * (x * std::cos(angle) + z * std::sin(angle));
    constexpr double kLong = 0.25; // twice as long as wide has 0.5
    return glm::normalize(back * std::min(longer / kLong, 1.0) - 0.6 * up);
}

CoatFlow flowOfCoat(const RootedMesh& rooted, const FlowOptions& options, unsigned threads) {
    const std::size_t count = rooted.roots.size();
    const Samples samples(rooted, (count + kMostSamples - 1) / kMostSamples);
    CoatFlow flow{.direction = std::vector<glm::vec3>(count), .shortness = std::vector<float>(count, 0.0F)};
    std::vector<glm::vec3> places;
    for (std::size_t i = 0; i < samples.count(); ++i)
        places.push_back(samples.position(i));
    const bool asked = options.comb && glm::length(*options.comb) > 0;
    flow.comb = asked ? glm::normalize(*options.comb) : combOfShape(places, options.down);
    const std::vector<glm::vec3> combs = asked ? std::vector(places.size(), glm::vec3(flow.comb))
                                               : combsOfBody(places, glm::vec3(flow.comb), glm::vec3(-glm::normalize(options.down)));

    std::vector<glm::vec3> told(samples.count());
    for (std::size_t i = 0; i < told.size(); ++i)
        told[i] = options.told.empty() ? across(combs[i], samples.normal(i)) : options.told[samples.root(i)];
    const std::vector<glm::vec3> field = options.told.empty() ? directions(samples, told) : std::vector<glm::vec3>{};
    const std::vector<float> values = options.thickness ? shortnessOf(rooted, samples, threads) : std::vector<float>(samples.count(), 0.0F);

    inChunks(count, threads, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i) {
            const RootedPlace& root = rooted.roots[i];
            glm::vec3 sum = 1e-6F * across(glm::vec3(flow.comb), root.normal); // where no sample is near
            float shortness = 0;
            float weights = 1e-6F;
            samples.around(root.position, root.normal, [&](const Neighbour& other) {
                if (!field.empty()) sum += other.weight * carried(field[other.sample], samples.normal(other.sample), root.normal);
                shortness += other.weight * values[other.sample];
                weights += other.weight;
            });
            flow.direction[i] = options.told.empty() ? across(sum / weights, root.normal) : options.told[i];
            flow.shortness[i] = std::clamp(shortness / weights, 0.0F, 1.0F);
        }
    });
    return flow;
}

} // namespace tegument
