#include "lab/reference/fur_regression.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument::reference {

namespace {

constexpr double kLeastCosine = 0.01;  // of a ray with the layer
constexpr double kFarCosine = 1.0 / 6; // where only coverage is expected: a pixel's skin bends, and no triangle's tilt is all of it
constexpr double kStraight = 1e-3;     // least bow: over hollow skin rays are taken as straight
constexpr double kMostSteps = 8;       // of one spacing each; beyond, coverage is expected
constexpr double kFarSegment = 64;     // spacings that a segment may have where only coverage is expected
constexpr double kMargin = 0.02;       // doublings: whole numbers stay on one side
constexpr double kSeen = 0.004;        // an 8-bit target would not show less

glm::dvec3 unitOf(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : v;
}

glm::dvec3 tangential(const glm::dvec3& v, const glm::dvec3& normal) {
    return v - normal * glm::dot(v, normal);
}

/// Between -1 and 1, period 1: from 1 at 0 to -1 at 1/2 and back by the cubic 3 t^2 - 2 t^3.
double waveOfLayers(double x) {
    const double t = std::abs(2 * (x - std::floor(x)) - 1);
    return 2 * (3 * t * t - 2 * t * t * t) - 1;
}

glm::dvec3 waves(const glm::dvec3& x) {
    return {waveOfLayers(x.x), waveOfLayers(x.y), waveOfLayers(x.z)};
}

/// Share of a pixel that a strand covers at this distance from its axis; what is narrower is drawn a pixel wide, and fainter.
double section(double radius, double distance, double width) {
    const double wide = std::max(radius, width / 2);
    return std::clamp((wide - distance) / width + 0.5, 0.0, 1.0) * std::clamp(radius / wide, 0.0, 1.0);
}

/// Mean of max(1 - h / L, 0) for lengths L evenly between the shortest and 1, by the midpoint rule on the part where it is not 0.
double meanTaper(double height, double shortest) {
    constexpr int kNodes = 64;
    const double from = std::clamp(height, std::min(shortest, 0.999), 1.0);
    double sum = 0;
    for (int i = 0; i < kNodes; ++i)
        sum += 1 - height / (from + (1 - from) * (i + 0.5) / kNodes);
    return sum / kNodes * (1 - from) / std::max(1 - shortest, 1e-3);
}

/// The way of the ray from a layer to the next.
struct Sweep {
    FurPath path;
    glm::dvec3 normal{0};
    glm::dvec3 place{0}; // where it begins
    double height = 0;
    double width = 0; // of a pixel

    /// Behind its deepest point the ray stays there.
    [[nodiscard]] double heightAt(double s) const {
        const double deepest = std::min(s, 1 / path.bow);
        return height - deepest + path.bow * deepest * deepest / 2;
    }
    /// The place in the skin's tangent plane, and how far the skin has sunk below that.
    [[nodiscard]] glm::dvec3 placeAt(double s) const { return place + s * path.travel; }
    [[nodiscard]] glm::dvec3 sunk(double s) const { return -normal * (s * s / 2 * glm::dot(path.travel, path.turn)); }

    /// s where the height is `depth` less; where the ray never gets there, s where it is back at the layer.
    [[nodiscard]] double end(double depth) const {
        if (1 / (2 * path.bow) < depth) return 2 / path.bow;
        double low = 0;
        double high = 1 / path.bow;
        for (int i = 0; i < 60; ++i)
            (height - heightAt((low + high) / 2) < depth ? low : high) = (low + high) / 2;
        return high;
    }
};

/// Strands of a piece added to what was met before.
struct Meeting {
    const FurSwept& fur;
    const Sweep& sweep;
    double covered = 0; // the rest: shares of coverage times what FurMet has means of
    double height = 0;
    double along = 0;
    double tint = 0;

    void add(double share, double h, double a, double t) {
        const double free = (1 - covered) * share;
        covered += free;
        height += free * h;
        along += free * a;
        tint += free * t;
    }

    /// All strands near a piece of the sweep.
    void meetAll(const FurStrandsAt& strands, double from, double to) {
        const double top = sweep.heightAt(from);
        const double low = sweep.heightAt(to);
        const auto looked = [&](double s, double h) {
            return sweep.placeAt(s) + furTuft(fur, sweep.placeAt(s), h, sweep.normal) + sweep.sunk(s);
        };
        const glm::dvec3 begin = looked(from, top);
        const glm::dvec3 end = looked(to, low);
        const glm::dvec3 aside = tangential(end - begin, sweep.normal);
        // A strand covers up to a pixel from its axis, which stands aside from its root.
        const double bends = std::max(glm::length(furAxis(fur, top)), glm::length(furAxis(fur, low)));
        const FurPlace place{.begin = begin,
                             .middle = begin + 0.5 * aside,
                             .normal = sweep.normal,
                             .reach = fur.radius * (1 - low) + sweep.width + bends + 0.5 * glm::length(aside)};
        std::vector<FurStand> near;
        strands(place, near);
        for (const FurStand& strand : near)
            if (strand.length > low) meet(strand, begin, end, top, low);
    }

    void meet(const FurStand& strand, const glm::dvec3& begin, const glm::dvec3& end, double top, double low) {
        const glm::dvec3 side = strand.stray * unitOf(tangential(strand.random - 0.5, sweep.normal));
        const glm::dvec3 across = glm::cross(sweep.normal, side);
        const auto fromAxis = [&](const glm::dvec3& place, double h) {
            const glm::dvec2 axis = furAxis(fur, h);
            return tangential(place - strand.root, sweep.normal) - axis.x * side - axis.y * across;
        };
        const auto radius = [&](double h) { return strand.radius * (1 - h / strand.length); };
        const FurPieceMet met = meetCone(fromAxis(begin, top), fromAxis(end, low), radius(top), radius(low), sweep.width);
        if (met.covered <= 0) return;
        const double h = std::lerp(top, low, met.entry);
        add(met.covered, h, std::clamp(h / strand.length, 0.0, 1.0), 1 + fur.variation * (strand.random.z - 0.5));
    }
};

/// Height of the coat, spacings.
double coatOf(const FurSwept& fur) {
    return std::max(fur.thickness / fur.spacing, 1.0);
}

/// 0 strands, 1 only coverage to expect.
double farOf(double width) {
    return std::clamp(width - 1, 0.0, 1.0);
}

} // namespace

glm::dvec2 furAxis(const FurSwept& fur, double height) {
    const double turn = fur.turns * height;
    return height * (glm::dvec2(fur.scatter * height, 0) + fur.curls * glm::dvec2(waveOfLayers(turn), waveOfLayers(turn + 0.75)));
}

glm::dvec3 furTuft(const FurSwept& fur, const glm::dvec3& place, double height, const glm::dvec3& normal) {
    const glm::dvec3 p = place / fur.tuftSize;
    const glm::dvec3 inner = 0.4 * waves(0.19 * glm::dvec3(p.z, p.x, p.y));
    return tangential(fur.tufts * height * height * waves(0.31 * glm::dvec3(p.y, p.z, p.x) + inner), normal);
}

double furSpare(const FurSwept& fur, double across, double far) {
    return std::log2(fur.layers / std::max(across / (fur.segment + far * kFarSegment), fur.fewest));
}

FurPath furPath(const FurSwept& fur, const FurFacet& facet, const glm::dvec3& ray, const glm::dvec3& strand, double upright, double least) {
    const glm::dvec3 u = (facet.positions[1] - facet.positions[0]) / fur.spacing;
    const glm::dvec3 v = (facet.positions[2] - facet.positions[0]) / fur.spacing;
    const glm::dvec3 plane = unitOf(glm::cross(u, v));
    // Rays along the plane are kept from going on for ever: they are taken as falling a little more steeply.
    const double fall = glm::dot(ray, plane);
    const glm::dvec3 falling = ray + plane * (least / fall);
    // The point of the coat that is 1 below the point (x, y) of the triangle's plane lies on the ray: x u + y v - strand = z ray.
    const glm::dvec3 met = glm::inverse(glm::dmat3(u, v, -falling)) * strand;
    FurPath path;
    path.travel = (met.x * (facet.rest[1] - facet.rest[0]) + met.y * (facet.rest[2] - facet.rest[0])) / fur.spacing;
    path.turn = met.x * (facet.normals[1] - facet.normals[0]) + met.y * (facet.normals[2] - facet.normals[0]);
    // The height changes along the ray by its cosine with the normal, which turns on the way.
    path.bow = std::max(glm::dot(ray, path.turn) * met.z / upright, kStraight);
    return path;
}

FurPieceMet meetCone(const glm::dvec3& begin, const glm::dvec3& end, double radiusAtBegin, double radiusAtEnd, double width) {
    // How deep inside: concave along the piece, for distances from a line are convex.
    const auto inside = [&](double t) { return std::lerp(radiusAtBegin, radiusAtEnd, t) - glm::length(glm::mix(begin, end, t)); };
    const double already = section(radiusAtBegin, glm::length(begin), width);
    constexpr double kGolden = 1 / std::numbers::phi;
    double low = 0;
    double high = 1;
    for (double a = 1 - kGolden, b = kGolden, fa = inside(a), fb = inside(b); high - low > 1e-9;) {
        if (fa < fb) {
            low = a;
            a = b;
            fa = fb;
            fb = inside(b = low + kGolden * (high - low));
        } else {
            high = b;
            b = a;
            fb = fa;
            fa = inside(a = high - kGolden * (high - low));
        }
    }
    const double deepest = (low + high) / 2;
    const double there = section(std::lerp(radiusAtBegin, radiusAtEnd, deepest), glm::length(glm::mix(begin, end, deepest)), width);
    FurPieceMet met{.covered = std::clamp((there - already) / std::max(1 - already, 1e-4), 0.0, 1.0), .entry = deepest};
    if (met.covered > 0 && inside(deepest) > 0) {
        double out = 0;
        double in = inside(0) >= 0 ? 0 : deepest;
        while (in - out > 1e-9)
            (inside((out + in) / 2) < 0 ? out : in) = (out + in) / 2;
        met.entry = in;
    }
    return met;
}

FurExpected expectedCover(const FurSwept& fur, double share, double top, double bottom, double way) {
    constexpr int kNodes = 32;
    double width = 0;
    double moment = 0;
    for (int i = 0; i < kNodes; ++i) {
        const double h = std::lerp(bottom, top, (i + 0.5) / kNodes);
        const double r = fur.radius * meanTaper(h, fur.shortest);
        width += r / kNodes;
        moment += r * h / kNodes;
    }
    const double wide = fur.radius * meanTaper(bottom, fur.shortest);
    const double narrow = fur.radius * meanTaper(top, fur.shortest);
    const double swept = 2 * width * way + std::numbers::pi * std::max(wide * wide - narrow * narrow, 0.0);
    return {.covered = -std::expm1(-share * fur.density * swept), .height = width > 0 ? moment / width : top};
}

namespace {

/// What is known at the corners of a layer's triangle, interpolated.
struct Here {
    double width = 0; // of a pixel
    double spare = 0; // furSpare
    double least = 0; // square of the cosine at which rays go on for longest
};

Here hereOf(const FurSwept& fur, const FurFragment& fragment, const FurFacet& facet, const FurEye& eye) {
    Here here;
    for (int c = 0; c < 3; ++c) {
        const auto corner = static_cast<std::size_t>(c);
        const glm::dvec3 way = facet.positions[corner] - eye.position;
        const double width = eye.pixel * glm::length(way) / fur.spacing;
        const double cosine = std::clamp(-glm::dot(unitOf(way), unitOf(facet.normals[corner])), -1.0, 1.0);
        const double across = coatOf(fur) * std::sqrt(1 - cosine * cosine) / std::max(cosine, kLeastCosine);
        here.width += fragment.weights[c] * width;
        here.spare += fragment.weights[c] * furSpare(fur, across, farOf(width));
        here.least += fragment.weights[c] * std::pow(std::lerp(kLeastCosine, kFarCosine, farOf(width)), 2);
    }
    return here;
}

/// Strands along the sweep, then coverage to expect for what lies beyond them and for strands that are too thin.
FurMet along(const FurSwept& fur, const FurStrandsAt& strands, const Sweep& sweep, double bottom, double share) {
    const double far = farOf(sweep.width);
    const double end = sweep.end(sweep.height - bottom);
    const double way = glm::length(sweep.path.travel) * end;
    const double step = end / std::max(way, 1.0);
    const int pieces = far < 1 ? static_cast<int>(std::min(way, kMostSteps - 1) + 1) : 0;
    Meeting meeting{.fur = fur, .sweep = sweep};
    for (int i = 0; i < pieces; ++i)
        meeting.meetAll(strands, std::min(i * step, end), std::min((i + 1) * step, end));

    const double reached = sweep.heightAt(std::min(pieces * step, end));
    const FurExpected beyond =
        expectedCover(fur, share, std::lerp(reached, sweep.height, far), bottom, std::max(way - kMostSteps, way * far));
    for (double* sum : {&meeting.covered, &meeting.height, &meeting.along, &meeting.tint})
        *sum *= 1 - far;
    meeting.add(beyond.covered, beyond.height, std::clamp(2 * beyond.height / (1 + fur.shortest), 0.0, 1.0), 1);
    const double all = meeting.covered;
    return all > 0 ? FurMet{all, meeting.height / all, meeting.along / all, meeting.tint / all} : FurMet{};
}

} // namespace

FurSeen sweepLayer(const FurSwept& fur, const FurStrandsAt& strands, const FurFragment& fragment, const FurFacet& facet,
                   const FurEye& eye) {
    const Here here = hereOf(fur, fragment, facet, eye);
    const double doublings = std::max(here.spare + kMargin, 0.0);
    const int stride = static_cast<int>(std::exp2(std::floor(doublings)));
    FurSeen seen{.drawn = (fur.layers - fragment.layer) % stride == 0,
                 .decided = doublings == 0 || std::abs(doublings - std::round(doublings)) > 1e-4};
    if (!seen.drawn) return seen;

    const double bottom = std::max(0.0, static_cast<double>(fragment.layer - stride) / fur.layers);
    const glm::dvec3 normal = unitOf(fragment.normal);
    const glm::dvec3 strand = coatOf(fur) * (normal + (fragment.height + bottom) * (fragment.lean + fur.lean));
    const Sweep sweep{.path = furPath(fur, facet, unitOf(fragment.position - eye.position), strand, coatOf(fur), here.least),
                      .normal = normal,
                      .place = fragment.rest / fur.spacing,
                      .height = fragment.height,
                      .width = here.width};
    seen.met = along(fur, strands, sweep, bottom, fragment.share);
    seen.drawn = seen.met.covered >= kSeen;
    return seen;
}

glm::dvec3 sweptRadiance(const FurCoat& coat, const FurFragment& fragment, const FurMet& met, const FurLight& light, const glm::dvec3& eye,
                         bool lit) {
    FurCoat strands = coat;
    strands.kajiyaKay = 1; // whatever the skin's
    FurFragment at = fragment;
    at.height = met.height;
    return furRadiance(strands, at, furAlbedo(coat, met.along) * met.tint, light, eye, lit);
}

} // namespace tegument::reference
