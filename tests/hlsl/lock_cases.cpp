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

Arguments strandArguments() {
    return {unit(),           linear(-1, 1, 3),     linear(-1, 1, 3),     linear(-0.2, 0.2, 3),
            linear(-1, 1, 3), linear(-0.3, 0.3, 3), linear(-0.3, 0.3, 3), linear(0, 1, 4),
            linear(0, 3),     linear(0, 1)};
}

/// Where a strand is without its turns, and which way they point: cosine and sine.
struct Bent {
    dvec3 place;
    dvec2 turn;

    Bent(In x, double t)
        : place(x[7] * (x.vec3(0) * (t - x.scalar(7, 1) * t * t) + x.vec3(1) * (0.4 * t + 0.6 * t * t)) +
                x.vec3(2) * (1 - x.scalar(7, 2) * (3 * t * t - 2 * t * t * t)) + x.vec3(4) * t * t - x.vec3(3)),
          turn(wave(x[8] * t + x.scalar(7, 3)), wave(x[8] * t + x.scalar(7, 3) + 0.75)) {}
};

dvec3 strandOffset(In x) {
    const double t = x[9];
    const Bent bent(x, t);
    return bent.place + t * (bent.turn.x * x.vec3(5) + bent.turn.y * x.vec3(6));
}

/// By differences of places; of the turns as of a circle, which waves nearly are.
dvec3 strandAlong(In x) {
    constexpr double kStep = 1e-4; // places are cubic: differences of both sides are exact but for its square
    const double t = x[9];
    const double angle = 2 * std::numbers::pi * x[8] * t;
    const dvec2 turn = Bent(x, t).turn;
    return (Bent(x, t + kStep).place - Bent(x, t - kStep).place) / (2 * kStep) + (turn.x - angle * turn.y) * x.vec3(5) +
           (turn.y + angle * turn.x) * x.vec3(6);
}

void places(Cases& cases) {
    const Tolerance waved{8, 4, 1e-5, "sums of up to 8; the fraction of a wave's place"};
    cases += lock({"lockPlace", std::string(kStrandBody) + "return float4(place.offset, 0);"}, strandArguments(), waved,
                  [](In x) { return strandOffset(x); });
    cases += lock({"lockPlace", std::string(kStrandBody) + "return float4(place.tangent, 0);"}, strandArguments(),
                  {8, 4, 1e-4, "of a sum of up to 30, no shorter than 0.5"}, [](In x) { return normalize(strandAlong(x)); });
    cases.back().domain = [](In x) { return length(strandAlong(x)) > 0.5; };
    cases += lock("lockWaves(a0)", {linear(-1, 1, 3)}, {4, 2, 4e-5, "waves of waves, slopes up to 3, places up to 14"}, [](In x) {
        const dvec3 p = x.vec3(0);
        const dvec3 first = waves(1.25 * dvec3(p.z, p.x, p.y));
        return waves(2.6 * dvec3(p.y, p.z, p.x) + 0.3 + 0.35 * first) + 0.5 * waves(13.0 * dvec3(p.z, p.x, p.y) + 0.1 + 0.5 * first);
    });
    cases += lock("lockNoise(a0, a1)", {whole(4096, 4000000), whole(0, 96)},
                  {3, 0, 0, "whole numbers, a sum and a product with a rounded reciprocal"}, [](In x) { return lockNumbers(x[0], x[1]); });
    cases += lock({"lockBlownBy", "TgVertexInput v = (TgVertexInput)0; v.position = a0; LockLooks l = (LockLooks)0; l.lock.x = a1; "
                                  "return float4(lockBlownBy(l, v, a2, a3), 0);"},
                  {linear(-100, 100, 3), linear(0, 1), linear(-2, 2, 3), linear(0, 20)}, {8, 2, 4e-5, "the fraction of numbers up to 17"},
                  [](In x) {
                      const dvec3 place = (x.vec3(0) - kLockCentre) / kLockMesh;
                      const double phase = 0.8 * (place.x + place.y + place.z) + 0.25 * x[1] - 0.7 * x[3];
                      return x.vec3(2) * (1 + 0.5 * wave(phase));
                  });
}

constexpr const char* kShareBody =
    "TgVertexInput v = (TgVertexInput)0; v.uv.y = a0; LockShare s = lockShare(v, a1, a2, a3, max(a4, 0.01), a5); ";

/// Which of a lock's strands are drawn.
struct Share {
    double thin, share, rank, width, afar, begin;

    explicit Share(In x) {
        const double thinnest = x[3];
        thin = 2 * kLockRadius * kLockMesh / (thinnest * max(x[4], 0.01));
        share = 0.9 * std::clamp(thin, 0.33, 1.0);
        const double root = rootRank(x[0]) + x[5];
        rank = (x[1] + root - floor(root)) / x[2];
        width = saturate(8 * (1 - rank / share)) / (share * (1 - 0.5 / 8)); // the mean over even ranks is the strands' own
        afar = thin - share * kLockAfar / thinnest;
        begin = min({-1.75 * (thin - kLockAfar / thinnest), 1.05 * thin - 0.175, 0.35});
    }
};

void shares(Cases& cases) {
    const Arguments arguments = {whole(4096, 30000), whole(0, 3), whole(4, 8), linear(0.3, 2), logarithmic(0.01, 1), linear(0, 1)};
    const Tolerance ranked{16, 4, 2e-3, "sums of up to 2,500, of which the fraction is left"};
    const auto away = [](In x) { // from where the fraction leaps
        const double rank = rootRank(x[0]);
        const double sum = rank + x[5];
        return min(rank, 1 - rank) > 1e-3 && abs(sum - round(sum)) > 1e-3 && x[5] > 0;
    };
    cases += lock({"lockShare", std::string(kShareBody) + "return float4(s.share, s.rank, s.width, s.afar);"}, arguments, ranked, [](In x) {
        const Share s(x);
        return values(s.share, s.rank, s.width, s.afar);
    });
    cases.back().tolerance.absolute = 8e-3; // widths change by 8 / share of what ranks do
    cases.back().domain = away;
    cases += lock({"lockShare", std::string(kShareBody) + "return float4(s.begin, s.rank, 0, 0);"}, arguments, ranked,
                  [](In x) { return values(Share(x).begin, Share(x).rank); });
    cases.back().domain = away;
    cases += lock({"lockShareOf", "TgVertexInput v = (TgVertexInput)0; v.uv.y = 5000; LockShare s = lockShareOf(v, 1, a0, max(a1, "
                                  "0.01)); return float4(s.share, s.afar, s.begin, s.rank);"},
                  {whole(0, 1), logarithmic(0.01, 1)}, ranked, [](In x) {
                      const bool under = x[0] > 0.5;
                      const double thinnest = under ? 1.05 : 0.7;
                      const double thin = 2 * kLockRadius * kLockMesh / (thinnest * max(x[1], 0.01));
                      const double share = 0.9 * std::clamp(thin, 0.33, 1.0);
                      const double begin = min({-1.75 * (thin - kLockAfar / thinnest), 1.05 * thin - 0.175, 0.35});
                      return values(share, under ? 1 : thin - share * kLockAfar / thinnest, under ? 0 : begin,
                                    (1 + rootRank(5000)) / (under ? 3 : 4));
                  });
    cases +=
        lock({"lockRadius",
              "LockLooks l = (LockLooks)0; l.more = float3(0, a0, 0); l.guard = a1; return float4(lockRadius(l, a2, a3), 0, 0, 0);"},
             {linear(0, 1), whole(0, 1), linear(0, 1), whole(0, 1)}, {8, 4, 0, "products, and a difference of 1 and a power"}, [](In x) {
                 const double even = kLockRadius * kLockMesh * (0.75 + 0.5 * x[0]) * (1 + 0.3 * x[1] - 0.25 * x[3]);
                 return even * (1 - pow(x[2], 3));
             });
    // a ramp from 0.05 to 0.25 thicknesses
    cases += lock("lockFar(a0)", {linear(0, 2)}, {8, 4, 4e-7, "a difference of numbers up to 1.25"},
                  [](In x) { return saturate((x[0] / (kLockLength * kLockMesh) - 0.05) / 0.2); });
}

} // namespace

Cases lockCases() {
    return together(places, shares);
}

} // namespace tegument::test
