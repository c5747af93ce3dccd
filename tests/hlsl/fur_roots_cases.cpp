// Strands that grow on the surface (hlsl/fur/cells, cones, sweep, roots) against whole-number arithmetic, searches and sums of their own.

#include "tests/hlsl/function_case.h"
#include "tests/hlsl/fur_cone.h"
#include "tests/hlsl/fur_numbers.h"
#include "tests/hlsl/maps.h"

#include <cstdint>
#include <numbers>
#include <numeric>

namespace tegument::test {

namespace {

Residues whole3(In x) {
    return {std::llround(x[0]), std::llround(x[1]), std::llround(x[2])};
}

Values valuesOf(const Residues& v) {
    return values(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]));
}

void cells(Cases& cases) {
    const Tolerance exact{0, 0, 0, "whole numbers below 2^22"};
    cases.add("tgFurResidue(float3(a0, a1, a2))", {whole(-4190000, 4190000), whole(-1019, 1019), whole(0, 4190000)}, exact, [](In x) {
        const Residues v = whole3(x);
        return valuesOf({residue(v[0]), residue(v[1]), residue(v[2])});
    });
    cases.add("tgFurMixed(float3(a0, a1, a2))", {whole(0, 1018), whole(0, 1018), whole(0, 1018)}, exact,
              [](In x) { return valuesOf(mixedWhole(whole3(x))); });
    cases.add("tgFurCellResidue(float3(a0, a1, a2))", {whole(-2399, 2399), whole(-2399, 2399), whole(-2399, 2399)}, exact,
              [](In x) { return valuesOf(mixedWhole(mixedWhole(whole3(x)))); });
    cases.add("tgFurUnit(a0)", {linear(0, 1018, 3)}, {3, 1, 0, "a sum and a product with a rounded reciprocal"},
              [](In x) { return (x.vec3(0) + 0.5) / 1019.0; });
    cases.add("tgFurNearness(a0, a1)", {linear(-1, 1), linear(0.1, 1)}, {4, 2, 2e-6, "a difference of numbers up to 4"},
              [](In x) { return saturate(4 * (1 - abs(x[0]) / x[1])); });
    cases.add("tgFurWave(a0)", {linear(-50, 50, 3)}, {4, 2, 1e-5, "the fraction of numbers up to 50 rounds at 4e-6"},
              [](In x) { return waves(x.vec3(0)); });
    cases.add("tgFurTuft(a0)", {linear(-50, 50, 3)}, {4, 2, 2e-5, "waves of waves, slopes up to 3"}, [](In x) {
        const dvec3 p = x.vec3(0);
        return waves(0.31 * dvec3(p.y, p.z, p.x) + 0.4 * waves(0.19 * dvec3(p.z, p.x, p.y)));
    });
}

double section(double radius, double distance, double width) {
    const double wide = max(radius, width / 2);
    return saturate((wide - distance) / width + 0.5) * saturate(radius / wide);
}

MetCone meeting(In x) {
    return {x.vec3(0), x.vec3(1), x[2], x[3] * length(x.vec3(1))};
}

void cones(Cases& cases) {
    cases.add("tgFurSection(a0, a1, a2)", {linear(-0.5, 2, 2), linear(0, 3, 2), logarithmic(1e-2, 4)},
              {4, 2, 1e-4, "a difference up to 3 over as little as 1e-2"},
              [](In x) { return values(section(x[0], x[1], x[2]), section(x.scalar(0, 1), x.scalar(1, 1), x[2])); });
    // Sideways the ray is less steep than the cone; from above it is steeper. Either may begin above the tip, in the cone's other half,
    // too.
    for (const bool above : {false, true}) {
        cases.add(
            "tgFurCone(a0, a1, a2, a3 * length(a1), a4)",
            {vector(3, 0.05, 1.5), vector(3, 0.2, 2), linear(-0.4, 0.5), above ? linear(1.1, 4) : linear(0, 0.9), logarithmic(0.05, 1)},
            {16, 4, 2e-3,
             "the way aside is the root of a difference: 3e-4 where the ray aims at the axis, over a pixel of 0.05; the entry is the root "
             "of a discriminant"},
            {.samples = 2048}, [](In x) {
                const MetCone m = meeting(x);
                const double nearest = m.nearest();
                const double already = section(m.radius, length(m.from), x[4]);
                const double covered = section(m.radius + m.growth * nearest, length(m.from + m.along * nearest), x[4]);
                return values(saturate((covered - already) / max(1 - already, 1e-4)), m.entry(nearest));
            });
        cases.back().domain = [](In x) {
            const MetCone m = meeting(x);
            const double nearest = m.nearest();

            // Grazing: whether and where the ray enters is the rounding's.
            if (length(m.along) < 1e-3) return false;
            return section(m.radius, length(m.from), x[4]) < 0.9 && abs(m.inside(nearest)) > 0.02;
        };
    }
}

/// A layer's triangle and the ray through it: a0 view, a1 strand, a2 and a3 what a pixel across and down changes of the coat's point.
struct Slope {
    double way = 0;    // along the ray, from the triangle to where a triangle moved down by the strand meets it
    double cosine = 0; // of the ray and the triangle's normal
    dvec2 pixels{0};
};

/// The way from one linear system, then shortened as c^2 / (c^2 + 0.01^2) at grazing angles; the pixels by least squares.
Slope slope(In x) {
    Slope result;
    result.way = (inverse(dmat3(x.vec3(2), x.vec3(3), -x.vec3(0))) * x.vec3(1)).z;
    result.cosine = dot(normalize(cross(x.vec3(2), x.vec3(3))), x.vec3(0));
    result.way *= result.cosine * result.cosine / (result.cosine * result.cosine + 1e-4);
    const dvec3 along = x.vec3(1) + x.vec3(0) * result.way;
    const double mixed = dot(x.vec3(2), x.vec3(3));
    const dmat2 normalEquations(dot(x.vec3(2), x.vec3(2)), mixed, mixed, dot(x.vec3(3), x.vec3(3)));
    result.pixels = inverse(normalEquations) * dvec2(dot(along, x.vec3(2)), dot(along, x.vec3(3)));
    return result;
}

/// s - bow s^2 / 2 of a ray that falls no further than its deepest point, at s = 1 / bow, by summing up slopes.
double fallen(double bow, double s) {
    constexpr int kSteps = 20000;
    double height = 0;
    for (int i = 0; i < kSteps; ++i)
        height += max(1 - bow * s * (i + 0.5) / kSteps, 0.0) * s / kSteps;
    return height;
}

/// Least s with s - bow s^2 / 2 = depth, by bisection; where there is none, the s at which the parabola is back at 0.
double fall(double bow, double depth) {
    if (1 / (2 * bow) < depth) return 2 / bow;
    double low = 0;
    double high = 1 / bow;
    for (int i = 0; i < 200; ++i) {
        const double s = (low + high) / 2;
        (s - bow * s * s / 2 < depth ? low : high) = s;
    }
    return high;
}

/// Mean of max(1 - h / L, 0) over L in [s, 1], by the midpoint rule on the part where it is not 0.
double meanRadius(double h, double s) {
    const double from = max(h, s);
    constexpr int kSteps = 1000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        sum += 1 - h / (from + (1 - from) * (i + 0.5) / kSteps);
    return sum / kSteps * (1 - from) / (1 - s);
}

void sweeps(Cases& cases) {
    cases.add("tgFurAlong(a0)", {vector(3, 1e-3, 1e6)}, {8, 2, 1e-6, "an inverse square root of a sum with 1e-20"},
              [](In x) { return x.vec3(0) / max(length(x.vec3(0)), 1e-30); });
    cases.back().domain = [](In x) { return length(x.vec3(0)) == 0 || length(x.vec3(0)) > 1e-6; };
    cases.add({"tgFurPath",
               "TgFurSlopes s; s.across = a2; s.down = a3; s.placeAcross = a4; s.placeDown = a5; s.normalAcross = a5.yzx; s.normalDown = "
               "a4.zxy; TgFurPath p = tgFurPath(a0, a1, 2.0, 1e-4, s); return float4(p.travel + 100.0 * p.turn, p.bow);"},
              {unit(), vector(3, 0.5, 4), vector(3, 0.5, 2), vector(3, 0.5, 2), vector(3, 0.5, 2), vector(3, 0.5, 2)},
              {64, 32, 0.05, "quotients by an area and a cosine of 0.2, of ways up to 1e3"}, [](In x) {
                  const Slope path = slope(x);
                  const dvec2 pixels = 2.0 * path.pixels;
                  const dvec3 a = x.vec3(4);
                  const dvec3 b = x.vec3(5);
                  const dvec3 turn = dvec3(b.y, b.z, b.x) * pixels.x + dvec3(a.z, a.x, a.y) * pixels.y;
                  return dvec4(a * pixels.x + b * pixels.y + 100.0 * turn, dot(x.vec3(0), turn) * path.way);
              });
    cases.back().domain = [](In x) {
        const double sine = length(cross(x.vec3(2), x.vec3(3))) / (length(x.vec3(2)) * length(x.vec3(3)));
        return min(length(x.vec3(2)), length(x.vec3(3))) > 0.1 && sine > 0.2 && abs(slope(x).cosine) > 0.2 &&
               abs(length(x.vec3(0)) - 1) < 1e-6;
    };
    cases.add("tgFurFall(a0, a1)", {linear(-1, 20), logarithmic(1e-3, 1)}, {8, 8, 1e-6, "the root of a difference near 0"},
              [](In x) { return fall(max(x[0], 1e-3), x[1]); });
    cases.back().domain = [](In x) { return abs(1 - 2 * x[0] * x[1]) > 1e-4; };
    cases.add("tgFurFallen(a0, a1)", {linear(-1, 20), linear(0, 4)}, {8, 4, 1e-6, "a sum of 20,000 slopes, the one with the kink by 1e-8"},
              [](In x) { return fallen(max(x[0], 1e-3), x[1]); });
    cases.add("tgFurSpare(a0, a1, a2, a3)", {whole(1, 512), logarithmic(0.1, 1000), logarithmic(0.5, 16), whole(1, 64)},
              {4, 2, 2e-6, "a logarithm of a quotient"}, [](In x) { return log2(x[0]) - log2(max(x[1] / x[2], x[3])); });
    cases.back().domain = [](In x) { return x[0] >= 1 && x[2] >= 0.5 && x[3] >= 1; };
    // how often 2 goes into it
    cases.add("tgFurStride(a0)", {linear(-4, 9)}, {2, 0, 0, "powers of two from a rounded exponential"}, [](In x) {
        double stride = 1;
        for (double spare = x[0] + 0.02; spare >= 1; spare -= 1)
            stride *= 2;
        return stride;
    });
    cases.back().domain = [](In x) { return abs(x[0] + 0.02 - round(x[0] + 0.02)) > 1e-5; };
    cases.add("tgFurMeanRadius(a0, a1)", {linear(0, 1, 2), linear(0.1, 0.9)}, {8, 4, 1e-5, "1 - least + h ln(least) cancels near the tips"},
              {.samples = 1024}, [](In x) {
                  const double s = x[1];
                  return values(meanRadius(x.scalar(0, 0), s), meanRadius(x.scalar(0, 1), s));
              });
    cases.add("tgFurExpected(a0, a1, a2)", {linear(0, 2), linear(0, 0.5, 2), linear(0, 20)},
              {60, 4, 1e-6, "1 - exp: exp errs by 3 + 2|x| ULP of 1"}, [](In x) {
                  const double a = x.scalar(1, 0);
                  const double b = x.scalar(1, 1);
                  const double sideways = 2 * x[2] * std::midpoint(a, b); // twice the mean radius, along the way
                  const double above = std::numbers::pi * (b * b - a * a);
                  return -std::expm1(-x[0] * (sideways + above));
              });
    cases.back().domain = [](In x) { return x.scalar(1, 1) >= x.scalar(1, 0); }; // strands grow wider downwards
}

/// Texels and tables of the map as if it were kTgFurRootsWidth = 4096 wide and three texels high.
constexpr std::int64_t kWidth = 4096;
constexpr std::int64_t kRows = 3;

double tableEntry(std::int64_t first, std::int64_t index) {
    const std::int64_t texel = first + index / 4;
    const std::int64_t row = texel / kWidth;
    const dvec2 uv((static_cast<double>(texel % kWidth) + 0.5) / kWidth, (static_cast<double>(row) + 0.5) / kRows);
    return addressMap().at(uv)[static_cast<int>(index % 4)];
}

using Cell = glm::tvec3<std::int64_t>;

std::int64_t number(const Cell& cell, const Cell& count) {
    return cell.x + count.x * (cell.y + count.y * cell.z);
}

const Cell kBricks(4, 3, 5);

/// In cells, from the corner of a grid of these bricks of `side` cells each.
dvec3 inGrid(const dvec3& place, std::int64_t side) {
    return clamp((place - dvec3(1, 2, 3)) / 7.0, dvec3(0), dvec3(kBricks * side) - 0.5);
}

double rootList(const dvec3& place) {
    constexpr std::int64_t kSide = 4;
    const Cell cell(inGrid(place, kSide));
    const double table = tableEntry(50 + number(cell / kSide, kBricks), 0);
    if (table == 0) return 0;
    return tableEntry(std::llround(table), number(cell - cell / kSide * kSide, Cell(kSide)));
}

/// Between the nodes of a brick of 8 cells, 4 apart: along x, then y, then z.
dvec4 rootCoat(const dvec3& place) {
    constexpr std::int64_t kSide = 8;
    const dvec3 cells = inGrid(place, kSide);
    const Cell brick = Cell(cells) / kSide;
    const double table = tableEntry(50 + number(brick, kBricks), 0);
    if (table == 0) return dvec4(0);
    const dvec3 within = (cells - dvec3(brick * kSide)) / 4.0;
    const Cell low = min(Cell(within), Cell(1));
    const auto at = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
        const std::int64_t texel = std::llround(table) + kSide * kSide * kSide / 4 + number(low + Cell(x, y, z), Cell(3));
        return dvec4(tableEntry(texel, 0), tableEntry(texel, 1), tableEntry(texel, 2), tableEntry(texel, 3));
    };
    const dvec3 t = within - dvec3(low);
    const auto along = [&](std::int64_t y, std::int64_t z) { return mix(at(0, y, z), at(1, y, z), t.x); };
    const auto across = [&](std::int64_t z) { return mix(along(0, z), along(1, z), t.y); };
    return mix(across(0), across(1), t.z);
}

bool offFaces(const dvec3& place) { // of cells, where rounding decides
    const dvec3 c = (place - dvec3(1, 2, 3)) / 7.0;
    const dvec3 off = abs(c - round(c));
    return min({off.x, off.y, off.z}) > 1e-5;
}

void roots(Cases& cases) {
    const Tolerance exact{0, 0, 0, "whole numbers"};
    cases.add("tgFurTexel(a0, a1)", {whole(0, 8000000), whole(1, 4000)},
              {4, 0, 0, "two quotients and their sum; a texel's border is 1,000 ULP away"}, [](In x) {
                  const auto index = std::llround(x[0]);
                  const auto row = index / kWidth;
                  return values((static_cast<double>(index % kWidth) + 0.5) / kWidth, (static_cast<double>(row) + 0.5) / x[1]);
              });
    // as many radii from the centre of one ball as of the other
    cases.add("tgFurRootPlace(a0, a1, float4(a2, a3))",
              {vector(3, 1e-6, 1e6), logarithmic(1e-6, 1e6), vector(3, 0.1, 1e3), logarithmic(1, 1e3)},
              {4, 4, 1e-4, "a sum of up to 1e3 that may cancel"}, [](In x) { return x.vec3(2) + x[3] * (x.vec3(0) / x[1]); });
    cases.back().domain = [](In x) { return x[1] >= 1e-6 && length(x.vec3(0)) < 2 * x[1]; };
    cases.add("tgFurPick(a0, a1)", {linear(-5, 5, 4), whole(0, 3)}, exact,
              [](In x) { return x.scalar(0, static_cast<std::size_t>(std::llround(x[1]))); });
    cases.add("tgFurCellNumber(float3(a0, a1, a2), float3(a3, a4, 100))",
              {whole(0, 99), whole(0, 99), whole(0, 99), whole(1, 100), whole(1, 100)}, exact,
              [](In x) { return x[0] + x[3] * x[1] + x[3] * x[4] * x[2]; });
    cases.add("tgFurTable(TG_SAMPLER2D_ARG(gTest), 3.0, a0, a1)", {whole(0, 8000), whole(0, 1000)}, exact, {.map = &addressMap()},
              [](In x) { return tableEntry(std::llround(x[0]), std::llround(x[1])); });
    cases.add("tgFurRootList(TG_SAMPLER2D_ARG(gTest), a0, float4(1, 2, 3, 7), float4(4, 3, 5, 4), float2(3, 50))", {linear(-20, 150, 3)},
              exact, {.map = &addressMap()}, [](In x) { return rootList(x.vec3(0)); });
    cases.back().domain = [](In x) { return offFaces(x.vec3(0)); };
    cases.add({"tgFurBrick", "TgFurBrick b = tgFurBrick(TG_SAMPLER2D_ARG(gTest), a0, float4(1, 2, 3, 7), float4(4, 3, 5, 4), float2(3, "
                             "50)); return float4(b.cell + b.place, b.address);"},
              {linear(-20, 150, 3)}, {4, 2, 2e-5, "cells up to 20, by a division"}, {.map = &addressMap()}, [](In x) {
                  const dvec3 cells = inGrid(x.vec3(0), 4);
                  const Cell brick = Cell(cells) / std::int64_t(4);
                  const dvec3 corner(brick * std::int64_t(4));
                  return dvec4(floor(cells) + cells - 2.0 * corner, tableEntry(50 + number(brick, kBricks), 0));
              });
    cases.back().domain = [](In x) { return offFaces(x.vec3(0)); };
    cases.add("tgFurRootCoat(TG_SAMPLER2D_ARG(gTest), a0, float4(1, 2, 3, 7), float4(4, 3, 5, 8), float2(3, 50), 4.0)",
              {linear(-20, 300, 3)}, {16, 8, 0.05, "between whole numbers of up to 8,000, at places that err by 1e-6 cells"},
              {.map = &addressMap()}, [](In x) { return rootCoat(x.vec3(0)); });
    cases.back().domain = [](In x) { return offFaces(x.vec3(0)); };
}

} // namespace

Cases furRootsCases() {
    return together(cells, cones, sweeps, roots);
}

} // namespace tegument::test
