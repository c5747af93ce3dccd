#include "host/reference/fur_swept.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument::reference {

namespace {

constexpr double kLeastCosine = 0.02; // rays that fall less steeply, or rise, are taken as falling so
constexpr double kMostSteps = 8;      // of one spacing each; beyond, coverage is expected
constexpr double kFarSegment = 64;    // spacings that a segment may have where only coverage is expected
constexpr double kSeen = 0.004;       // an 8-bit target would not show less

glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : v;
}

glm::dvec3 tangential(const glm::dvec3& v, const glm::dvec3& normal) {
    return v - normal * glm::dot(v, normal);
}

/// Between -1 and 1, period 1: from 1 at 0 to -1 at 1/2 and back by the cubic 3 t^2 - 2 t^3.
double wave(double x) {
    const double t = std::abs(2 * (x - std::floor(x)) - 1);
    return 2 * (3 * t * t - 2 * t * t * t) - 1;
}

glm::dvec3 waves(const glm::dvec3& x) {
    return {wave(x.x), wave(x.y), wave(x.z)};
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

/// The part of the ray that a layer shows, in (place, height): a straight line.
struct Sweep {
    glm::dvec3 normal{0};
    glm::dvec3 top{0};
    glm::dvec3 bottom{0};
    double height = 0;
    double low = 0;
    double width = 0; // of a pixel

    [[nodiscard]] glm::dvec3 place(double share) const { return glm::mix(top, bottom, share); }
    [[nodiscard]] double heightAt(double share) const { return std::lerp(height, low, share); }
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

    /// All strands near a piece of the sweep, given by its ends as shares of it.
    void meetAll(const FurStrandsAt& strands, double from, double to) {
        const double top = sweep.heightAt(from);
        const double low = sweep.heightAt(to);
        const glm::dvec3 begin = furTufted(fur, sweep.place(from), top);
        const glm::dvec3 end = furTufted(fur, sweep.place(to), low);
        const glm::dvec3 aside = tangential(end - begin, sweep.normal);
        // A strand covers up to a pixel from its axis, which stands aside from its root.
        const double bends = std::max(glm::length(furAxis(fur, top)), glm::length(furAxis(fur, low)));
        const FurPlace place{.begin = begin,
                             .middle = begin + 0.5 * aside,
                             .normal = sweep.normal,
                             .reach = fur.radius * (1 - low) + sweep.width + bends + 0.5 * glm::length(aside),
                             .off = std::abs(glm::dot(begin - sweep.place(from), sweep.normal))};
        std::vector<FurStand> near;
        strands(place, near);
        for (const FurStand& strand : near)
            if (strand.length > low) meet(strand, begin, end, top, low);
    }

    void meet(const FurStand& strand, const glm::dvec3& begin, const glm::dvec3& end, double top, double low) {
        const glm::dvec3 side = strand.stray * unit(tangential(strand.random - 0.5, sweep.normal));
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

/// The place that a point of the coat, moved along a ray until it is at another height, stands over: the skin counts as flat.
glm::dvec3 placeBelow(const glm::dvec3& place, const glm::dvec3& ray, const glm::dvec3& normal, const glm::dvec3& rise) {
    // place + rise lies on the ray's way; the place there, again in the skin's plane, is what is left when its rise is taken off.
    const glm::dvec3 start = place + rise;
    const double way = -glm::dot(rise, normal) / glm::dot(ray, normal);
    return start + way * ray;
}

Sweep sweepOf(const FurSwept& fur, const FurFragment& fragment, const glm::dvec3& ray, double bottom) {
    Sweep sweep{.normal = unit(fragment.normal), .top = fragment.rest / fur.spacing, .height = fragment.height, .low = bottom};
    const double coat = std::max(fur.thickness / fur.spacing, 1.0);
    const glm::dvec3 lean = fragment.lean + fur.lean;
    const auto strand = [&](double h) { return coat * h * (sweep.normal + h * lean); };
    const double falling = std::max(-glm::dot(ray, sweep.normal), kLeastCosine);
    const glm::dvec3 way = tangential(ray, sweep.normal) - falling * sweep.normal;
    sweep.bottom = placeBelow(sweep.top, way, sweep.normal, strand(sweep.height) - strand(bottom));
    return sweep;
}

} // namespace

glm::dvec2 furAxis(const FurSwept& fur, double height) {
    const double turn = fur.turns * height;
    return height * (glm::dvec2(fur.scatter * height, 0) + fur.curls * glm::dvec2(wave(turn), wave(turn + 0.75)));
}

glm::dvec3 furTufted(const FurSwept& fur, const glm::dvec3& place, double height) {
    const glm::dvec3 p = place / fur.tuftSize;
    const glm::dvec3 inner = 0.4 * waves(0.19 * glm::dvec3(p.z, p.x, p.y));
    return place + fur.tufts * height * height * waves(0.31 * glm::dvec3(p.y, p.z, p.x) + inner);
}

FurSpan furSpan(const FurSwept& fur, int layer, double across, double far) {
    // The largest power of two that leaves as many layers as are needed; a tenth of a doubling before it changes, layers sweep twice as
    // far.
    const double needed = std::max(across / (fur.segment + far * kFarSegment), fur.fewest);
    const double spare = std::log2(fur.layers / needed);
    const auto stride = [&](double zone) { return static_cast<int>(std::exp2(std::floor(std::max(spare + zone, 0.0)))); };
    const auto off = [&](double zone) { return std::abs(spare + zone - std::round(spare + zone)); };
    FurSpan span;
    span.drawn = (fur.layers - layer) % stride(0.02) == 0;
    span.decided = spare < -0.2 || std::min(off(0.02), off(0.1)) > 1e-4;
    const int spans = far > 0 ? stride(0.02) : stride(0.1);
    span.bottom = std::max(0.0, static_cast<double>(layer - spans) / fur.layers);
    return span;
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

FurExpected expectedCover(const FurSwept& fur, double top, double bottom, double way) {
    if (top <= bottom) return {};
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
    return {.covered = -std::expm1(-fur.density * swept), .height = width > 0 ? moment / width : top};
}

FurSeen sweepLayer(const FurSwept& fur, const FurStrandsAt& strands, const FurFragment& fragment, const FurEye& eye) {
    const glm::dvec3 toFragment = fragment.position - eye.position;
    const double distance = glm::length(toFragment);
    const glm::dvec3 ray = toFragment / distance;
    const double width = eye.pixel * distance / fur.spacing;
    const double far = std::clamp(width - 1, 0.0, 1.0);

    const double cosine = std::clamp(-glm::dot(ray, unit(fragment.normal)), -1.0, 1.0);
    const double coat = std::max(fur.thickness / fur.spacing, 1.0);
    const double across = coat * std::sqrt(1 - cosine * cosine) / std::max(cosine, kLeastCosine);
    const FurSpan span = furSpan(fur, fragment.layer, across, far);
    FurSeen seen{.met = {}, .drawn = span.drawn, .decided = span.decided};
    if (!span.drawn) return seen;

    Sweep sweep = sweepOf(fur, fragment, ray, span.bottom);
    sweep.width = width;
    const double way = glm::length(sweep.bottom - sweep.top);
    const double pieces = far < 1 ? std::clamp(std::ceil(way), 1.0, kMostSteps) : 0;
    const double step = 1 / std::max({pieces, 1.0, way}); // share of the sweep
    Meeting meeting{.fur = fur, .sweep = sweep};
    for (int i = 0; i < static_cast<int>(pieces); ++i)
        meeting.meetAll(strands, i * step, (i + 1) * step);

    const double share = std::lerp(std::min(pieces * step, 1.0), 0.0, far);
    const FurExpected beyond = expectedCover(fur, sweep.heightAt(share), sweep.low, way * (1 - share));
    for (double* sum : {&meeting.covered, &meeting.height, &meeting.along, &meeting.tint})
        *sum *= 1 - far;
    meeting.add(beyond.covered, beyond.height, std::clamp(2 * beyond.height / (1 + fur.shortest), 0.0, 1.0), 1);
    if (meeting.covered < kSeen) {
        seen.drawn = false;
        return seen;
    }
    const double all = meeting.covered;
    seen.met = {.covered = all, .height = meeting.height / all, .along = meeting.along / all, .tint = meeting.tint / all};
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
