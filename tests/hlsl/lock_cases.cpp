// Strands of a coat of locks (effects/passes/fur_locks.fxh) in double precision: where they go, which are drawn, how wide.

#include "tests/hlsl/function_case.h"
#include "tests/hlsl/fur_numbers.h"
#include "tests/hlsl/lock_scene.h"

#include <algorithm>
#include <numbers>

namespace tegument::test {

namespace {

constexpr const char* kStrandBody =
    "LockStrand s; s.normal = a0; s.flow = a1; s.offset = a2; s.base = a3; s.stray = a4; s.side = a5; s.across = a6; s.height = a7.x; "
    "s.sink = a7.y; s.clump = a7.z; s.phase = a7.w; s.turns = a8; RibbonPlace place = lockPlace(s, a9); ";

std::vector<Argument> strandArguments() {
    return {unit(),           linear(-1, 1, 3),     linear(-1, 1, 3),     linear(-0.2, 0.2, 3),
            linear(-1, 1, 3), linear(-0.3, 0.3, 3), linear(-0.3, 0.3, 3), linear(0, 1, 4),
            linear(0, 3),     linear(0, 1)};
}

/// Where a strand is without its turns, and which way they point: cosine and sine.
struct Bent {
    glm::dvec3 place;
    glm::dvec2 turn;

    Bent(const Inputs& x, double t)
        : place(x.scalar(7) * (x.vec3(0) * (t - x.scalar(7, 1) * t * t) + x.vec3(1) * (0.4 * t + 0.6 * t * t)) +
                x.vec3(2) * (1 - x.scalar(7, 2) * (3 * t * t - 2 * t * t * t)) + x.vec3(4) * t * t - x.vec3(3)),
          turn(wave(x.scalar(8) * t + x.scalar(7, 3)), wave(x.scalar(8) * t + x.scalar(7, 3) + 0.75)) {}
};

glm::dvec3 strandOffset(const Inputs& x) {
    const double t = x.scalar(9);
    const Bent bent(x, t);
    return bent.place + t * (bent.turn.x * x.vec3(5) + bent.turn.y * x.vec3(6));
}

/// By differences of places; of the turns as of a circle, which waves nearly are.
glm::dvec3 strandAlong(const Inputs& x) {
    constexpr double kStep = 1e-4; // places are cubic: differences of both sides are exact but for its square
    const double t = x.scalar(9);
    const double angle = 2 * std::numbers::pi * x.scalar(8) * t;
    const glm::dvec2 turn = Bent(x, t).turn;
    return (Bent(x, t + kStep).place - Bent(x, t - kStep).place) / (2 * kStep) + (turn.x - angle * turn.y) * x.vec3(5) +
           (turn.y + angle * turn.x) * x.vec3(6);
}

std::vector<FunctionCase> places() {
    const Tolerance waved{.forward = 8, .backward = 4, .absolute = 1e-5, .why = "sums of up to 8; the fraction of a wave's place"};
    std::vector<FunctionCase> cases;
    cases.push_back(lock(
        "lockPlace", std::string(kStrandBody) + "return float4(place.offset, 0);", strandArguments(),
        [](const Inputs& x) { return values(strandOffset(x)); }, waved));
    cases.push_back(lock("lockPlace", std::string(kStrandBody) + "return float4(place.tangent, 0);", strandArguments(),
                         [](const Inputs& x) { return values(glm::normalize(strandAlong(x))); },
                         {.forward = 8, .backward = 4, .absolute = 1e-4, .why = "of a sum of up to 30, no shorter than 0.5"}));
    cases.back().domain = [](const Inputs& x) { return glm::length(strandAlong(x)) > 0.5; };
    cases.push_back(lock("lockWaves", "return float4(lockWaves(a0), 0);", {linear(-1, 1, 3)},
                         [](const Inputs& x) {
                             const glm::dvec3 p = x.vec3(0);
                             const glm::dvec3 first = waves(1.25 * glm::dvec3(p.z, p.x, p.y));
                             return values(waves(2.6 * glm::dvec3(p.y, p.z, p.x) + 0.3 + 0.35 * first) +
                                           0.5 * waves(13.0 * glm::dvec3(p.z, p.x, p.y) + 0.1 + 0.5 * first));
                         },
                         {.forward = 4, .backward = 2, .absolute = 4e-5, .why = "waves of waves, slopes up to 3, places up to 14"}));
    cases.push_back(lock("lockNoise", "return float4(lockNoise(a0, a1), 0);", {whole(4096, 4000000), whole(0, 96)},
                         [](const Inputs& x) { return values(lockNumbers(x.scalar(0), x.scalar(1))); },
                         {.forward = 3, .backward = 0, .why = "whole numbers, a sum and a product with a rounded reciprocal"}));
    cases.push_back(lock("lockBlownBy",
                         "TgVertexInput v = (TgVertexInput)0; v.position = a0; LockLooks l = (LockLooks)0; l.lock.x = a1; "
                         "return float4(lockBlownBy(l, v, a2, a3), 0);",
                         {linear(-100, 100, 3), linear(0, 1), linear(-2, 2, 3), linear(0, 20)},
                         [](const Inputs& x) {
                             const glm::dvec3 place = (x.vec3(0) - kLockCentre) / kLockMesh;
                             const double phase = 0.8 * (place.x + place.y + place.z) + 0.25 * x.scalar(1) - 0.7 * x.scalar(3);
                             return values(x.vec3(2) * (1 + 0.5 * wave(phase)));
                         },
                         {.forward = 8, .backward = 2, .absolute = 4e-5, .why = "the fraction of numbers up to 17"}));
    return cases;
}

constexpr const char* kShareBody =
    "TgVertexInput v = (TgVertexInput)0; v.uv.y = a0; LockShare s = lockShare(v, a1, a2, a3, max(a4, 0.01), a5); ";

/// Which of a lock's strands are drawn.
struct Share {
    double thin, share, rank, width, afar, begin;

    explicit Share(const Inputs& x) {
        const double thinnest = x.scalar(3);
        thin = 2 * kLockRadius * kLockMesh / (thinnest * std::max(x.scalar(4), 0.01));
        share = 0.9 * std::clamp(thin, 0.33, 1.0);
        const double root = rootRank(x.scalar(0)) + x.scalar(5);
        rank = (x.scalar(1) + root - std::floor(root)) / x.scalar(2);
        width = std::clamp(8 * (1 - rank / share), 0.0, 1.0) / (share * (1 - 0.5 / 8)); // the mean over even ranks is the strands' own
        afar = thin - share * kLockAfar / thinnest;
        begin = std::min({-1.75 * (thin - kLockAfar / thinnest), 1.05 * thin - 0.175, 0.35});
    }
};

std::vector<FunctionCase> shares() {
    const std::vector<Argument> arguments = {whole(4096, 30000), whole(0, 3),          whole(4, 8),
                                             linear(0.3, 2),     logarithmic(0.01, 1), linear(0, 1)};
    const Tolerance ranked{.forward = 16, .backward = 4, .absolute = 2e-3, .why = "sums of up to 2,500, of which the fraction is left"};
    const auto away = [](const Inputs& x) { // from where the fraction leaps
        const double rank = rootRank(x.scalar(0));
        const double sum = rank + x.scalar(5);
        return std::min(rank, 1 - rank) > 1e-3 && std::abs(sum - std::round(sum)) > 1e-3 && x.scalar(5) > 0;
    };
    std::vector<FunctionCase> cases;
    cases.push_back(lock(
        "lockShare", std::string(kShareBody) + "return float4(s.share, s.rank, s.width, s.afar);", arguments,
        [](const Inputs& x) {
            const Share s(x);
            return values(s.share, s.rank, s.width, s.afar);
        },
        ranked));
    cases.back().tolerance.absolute = 8e-3; // widths change by 8 / share of what ranks do
    cases.back().domain = away;
    cases.push_back(lock(
        "lockShare", std::string(kShareBody) + "return float4(s.begin, s.rank, 0, 0);", arguments,
        [](const Inputs& x) { return values(Share(x).begin, Share(x).rank); }, ranked));
    cases.back().domain = away;
    cases.push_back(lock(
        "lockShareOf",
        "TgVertexInput v = (TgVertexInput)0; v.uv.y = 5000; LockShare s = lockShareOf(v, 1, a0, max(a1, 0.01)); "
        "return float4(s.share, s.afar, s.begin, s.rank);",
        {whole(0, 1), logarithmic(0.01, 1)},
        [](const Inputs& x) {
            const bool under = x.scalar(0) > 0.5;
            const double thinnest = under ? 1.05 : 0.7;
            const double thin = 2 * kLockRadius * kLockMesh / (thinnest * std::max(x.scalar(1), 0.01));
            const double share = 0.9 * std::clamp(thin, 0.33, 1.0);
            const double begin = std::min({-1.75 * (thin - kLockAfar / thinnest), 1.05 * thin - 0.175, 0.35});
            return values(share, under ? 1 : thin - share * kLockAfar / thinnest, under ? 0 : begin,
                          (1 + rootRank(5000)) / (under ? 3 : 4));
        },
        ranked));
    cases.push_back(lock(
        "lockRadius", "LockLooks l = (LockLooks)0; l.more = float3(0, a0, 0); l.guard = a1; return float4(lockRadius(l, a2, a3), 0, 0, 0);",
        {linear(0, 1), whole(0, 1), linear(0, 1), whole(0, 1)},
        [](const Inputs& x) {
            const double even = kLockRadius * kLockMesh * (0.75 + 0.5 * x.scalar(0)) * (1 + 0.3 * x.scalar(1) - 0.25 * x.scalar(3));
            return values(even * (1 - std::pow(x.scalar(2), 3)));
        },
        {.forward = 8, .backward = 4, .why = "products, and a difference of 1 and a power"}));
    cases.push_back(lock("lockFar", "return float4(lockFar(a0), 0, 0, 0);", {linear(0, 2)},
                         [](const Inputs& x) { // a ramp from 0.05 to 0.25 thicknesses
                             return values(std::clamp((x.scalar(0) / (kLockLength * kLockMesh) - 0.05) / 0.2, 0.0, 1.0));
                         },
                         {.forward = 8, .backward = 4, .absolute = 4e-7, .why = "a difference of numbers up to 1.25"}));
    return cases;
}

} // namespace

std::vector<FunctionCase> lockCases() {
    return together(places(), shares());
}

} // namespace tegument::test
