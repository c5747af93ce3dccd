// Strands that grow on the surface (hlsl/fur/cells, cones, sweep, roots) against whole-number arithmetic, searches and sums of their own.

#include "tests/hlsl/function_case.h"
#include "tests/hlsl/fur_cone.h"
#include "tests/hlsl/fur_numbers.h"
#include "tests/hlsl/maps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>

namespace tegument::test {

namespace {

Residues whole3(const Inputs& x) {
    return {std::llround(x.scalar(0)), std::llround(x.scalar(1)), std::llround(x.scalar(2))};
}

Values valuesOf(const Residues& v) {
    return values(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]));
}

std::vector<FunctionCase> cells() {
    const Tolerance exact{.forward = 0, .backward = 0, .why = "whole numbers below 2^22"};
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgFurResidue",
                     .body = "return float4(tgFurResidue(float3(a0, a1, a2)), 0);",
                     .arguments = {whole(-4190000, 4190000), whole(-1019, 1019), whole(0, 4190000)},
                     .expected =
                         [](const Inputs& x) {
                             const Residues v = whole3(x);
                             return valuesOf({residue(v[0]), residue(v[1]), residue(v[2])});
                         },
                     .tolerance = exact});
    cases.push_back({.function = "tgFurMixed",
                     .body = "return float4(tgFurMixed(float3(a0, a1, a2)), 0);",
                     .arguments = {whole(0, 1018), whole(0, 1018), whole(0, 1018)},
                     .expected = [](const Inputs& x) { return valuesOf(mixedWhole(whole3(x))); },
                     .tolerance = exact});
    cases.push_back({.function = "tgFurCellResidue",
                     .body = "return float4(tgFurCellResidue(float3(a0, a1, a2)), 0);",
                     .arguments = {whole(-2399, 2399), whole(-2399, 2399), whole(-2399, 2399)},
                     .expected = [](const Inputs& x) { return valuesOf(mixedWhole(mixedWhole(whole3(x)))); },
                     .tolerance = exact});
    cases.push_back({.function = "tgFurUnit",
                     .body = "return float4(tgFurUnit(a0), 0);",
                     .arguments = {linear(0, 1018, 3)},
                     .expected = [](const Inputs& x) { return values((x.vec3(0) + 0.5) / 1019.0); },
                     .tolerance = {.forward = 3, .backward = 1, .why = "a sum and a product with a rounded reciprocal"}});
    cases.push_back(
        {.function = "tgFurNearness",
         .body = "return float4(tgFurNearness(a0, a1), 0, 0, 0);",
         .arguments = {linear(-1, 1), linear(0.1, 1)},
         .expected = [](const Inputs& x) { return values(std::clamp(4 * (1 - std::abs(x.scalar(0)) / x.scalar(1)), 0.0, 1.0)); },
         .tolerance = {.forward = 4, .backward = 2, .absolute = 2e-6, .why = "a difference of numbers up to 4"}});
    cases.push_back(
        {.function = "tgFurWave",
         .body = "return float4(tgFurWave(a0), 0);",
         .arguments = {linear(-50, 50, 3)},
         .expected = [](const Inputs& x) { return values(waves(x.vec3(0))); },
         .tolerance = {.forward = 4, .backward = 2, .absolute = 1e-5, .why = "the fraction of numbers up to 50 rounds at 4e-6"}});
    cases.push_back({.function = "tgFurTuft",
                     .body = "return float4(tgFurTuft(a0), 0);",
                     .arguments = {linear(-50, 50, 3)},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec3 p = x.vec3(0);
                             return values(waves(0.31 * glm::dvec3(p.y, p.z, p.x) + 0.4 * waves(0.19 * glm::dvec3(p.z, p.x, p.y))));
                         },
                     .tolerance = {.forward = 4, .backward = 2, .absolute = 2e-5, .why = "waves of waves, slopes up to 3"}});
    return cases;
}

double section(double radius, double distance, double width) {
    const double wide = std::max(radius, width / 2);
    return std::clamp((wide - distance) / width + 0.5, 0.0, 1.0) * std::clamp(radius / wide, 0.0, 1.0);
}

MetCone meeting(const Inputs& x) {
    return {x.vec3(0), x.vec3(1), x.scalar(2), x.scalar(3) * glm::length(x.vec3(1))};
}

std::vector<FunctionCase> cones() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgFurSection",
                     .body = "return float4(tgFurSection(a0, a1, a2), 0, 0);",
                     .arguments = {linear(-0.5, 2, 2), linear(0, 3, 2), logarithmic(1e-2, 4)},
                     .expected =
                         [](const Inputs& x) {
                             return values(section(x.scalar(0), x.scalar(1), x.scalar(2)),
                                           section(x.scalar(0, 1), x.scalar(1, 1), x.scalar(2)));
                         },
                     .tolerance = {.forward = 4, .backward = 2, .absolute = 1e-4, .why = "a difference up to 3 over as little as 1e-2"}});
    // Sideways the ray is less steep than the cone; from above it is steeper. Either may begin above the tip, in the cone's other half,
    // too.
    for (const bool above : {false, true})
        cases.push_back(
            {.function = "tgFurCone",
             .body = "return float4(tgFurCone(a0, a1, a2, a3 * length(a1), a4), 0, 0);",
             .arguments = {vector(3, 0.05, 1.5), vector(3, 0.2, 2), linear(-0.4, 0.5), above ? linear(1.1, 4) : linear(0, 0.9),
                           logarithmic(0.05, 1)},
             .expected =
                 [](const Inputs& x) {
                     const MetCone m = meeting(x);
                     const double nearest = m.nearest();
                     const double already = section(m.radius, glm::length(m.from), x.scalar(4));
                     const double covered = section(m.radius + m.growth * nearest, glm::length(m.from + m.along * nearest), x.scalar(4));
                     return values(std::clamp((covered - already) / std::max(1 - already, 1e-4), 0.0, 1.0), m.entry(nearest));
                 },
             .tolerance = {.forward = 16,
                           .backward = 4,
                           .absolute = 2e-3,
                           .why = "the way aside is the root of a difference: 3e-4 where the ray aims at the axis, over a pixel of 0.05; "
                                  "the entry is the root of a discriminant"},
             .samples = 2048,
             .domain =
                 [](const Inputs& x) {
                     const MetCone m = meeting(x);
                     const double nearest = m.nearest();
                     // Grazing: whether and where the ray enters is the rounding's.
                     if (glm::length(m.along) < 1e-3) return false;
                     return section(m.radius, glm::length(m.from), x.scalar(4)) < 0.9 && std::abs(m.inside(nearest)) > 0.02;
                 }});
    return cases;
}

/// A layer's triangle and the ray through it: a0 view, a1 strand, a2 and a3 what a pixel across and down changes of the coat's point.
struct Slope {
    double way = 0;    // along the ray, from the triangle to where a triangle moved down by the strand meets it
    double cosine = 0; // of the ray and the triangle's normal
    glm::dvec2 pixels{0};
};

/// The way from one linear system, then shortened as c^2 / (c^2 + 0.01^2) at grazing angles; the pixels by least squares.
Slope slope(const Inputs& x) {
    Slope result;
    result.way = (glm::inverse(glm::dmat3(x.vec3(2), x.vec3(3), -x.vec3(0))) * x.vec3(1)).z;
    result.cosine = glm::dot(glm::normalize(glm::cross(x.vec3(2), x.vec3(3))), x.vec3(0));
    result.way *= result.cosine * result.cosine / (result.cosine * result.cosine + 1e-4);
    const glm::dvec3 along = x.vec3(1) + x.vec3(0) * result.way;
    const double mixed = glm::dot(x.vec3(2), x.vec3(3));
    const glm::dmat2 normalEquations(glm::dot(x.vec3(2), x.vec3(2)), mixed, mixed, glm::dot(x.vec3(3), x.vec3(3)));
    result.pixels = glm::inverse(normalEquations) * glm::dvec2(glm::dot(along, x.vec3(2)), glm::dot(along, x.vec3(3)));
    return result;
}

/// s - bow s^2 / 2 of a ray that falls no further than its deepest point, at s = 1 / bow, by summing up slopes.
double fallen(double bow, double s) {
    constexpr int kSteps = 20000;
    double height = 0;
    for (int i = 0; i < kSteps; ++i)
        height += std::max(1 - bow * s * (i + 0.5) / kSteps, 0.0) * s / kSteps;
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
    const double from = std::max(h, s);
    constexpr int kSteps = 1000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        sum += 1 - h / (from + (1 - from) * (i + 0.5) / kSteps);
    return sum / kSteps * (1 - from) / (1 - s);
}

std::vector<FunctionCase> sweeps() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgFurAlong",
                     .body = "return float4(tgFurAlong(a0), 0);",
                     .arguments = {vector(3, 1e-3, 1e6)},
                     .expected = [](const Inputs& x) { return values(x.vec3(0) / std::max(glm::length(x.vec3(0)), 1e-30)); },
                     .tolerance = {.forward = 8, .backward = 2, .absolute = 1e-6, .why = "an inverse square root of a sum with 1e-20"},
                     .domain = [](const Inputs& x) { return glm::length(x.vec3(0)) == 0 || glm::length(x.vec3(0)) > 1e-6; }});
    cases.push_back({.function = "tgFurPath",
                     .body = "TgFurSlopes s; s.across = a2; s.down = a3; s.placeAcross = a4; s.placeDown = a5; "
                             "s.normalAcross = a5.yzx; s.normalDown = a4.zxy; "
                             "TgFurPath p = tgFurPath(a0, a1, 2.0, 1e-4, s); return float4(p.travel + 100.0 * p.turn, p.bow);",
                     .arguments = {unit(), vector(3, 0.5, 4), vector(3, 0.5, 2), vector(3, 0.5, 2), vector(3, 0.5, 2), vector(3, 0.5, 2)},
                     .expected =
                         [](const Inputs& x) {
                             const Slope path = slope(x);
                             const glm::dvec2 pixels = 2.0 * path.pixels;
                             const glm::dvec3 a = x.vec3(4);
                             const glm::dvec3 b = x.vec3(5);
                             const glm::dvec3 turn = glm::dvec3(b.y, b.z, b.x) * pixels.x + glm::dvec3(a.z, a.x, a.y) * pixels.y;
                             return values(glm::dvec4(a * pixels.x + b * pixels.y + 100.0 * turn, glm::dot(x.vec3(0), turn) * path.way));
                         },
                     .tolerance = {.forward = 64,
                                   .backward = 32,
                                   .absolute = 0.05,
                                   .why = "quotients by an area and a cosine of 0.2, of ways up to 1e3"},
                     .domain =
                         [](const Inputs& x) {
                             const double sine =
                                 glm::length(glm::cross(x.vec3(2), x.vec3(3))) / (glm::length(x.vec3(2)) * glm::length(x.vec3(3)));
                             return std::min(glm::length(x.vec3(2)), glm::length(x.vec3(3))) > 0.1 && sine > 0.2 &&
                                    std::abs(slope(x).cosine) > 0.2 && std::abs(glm::length(x.vec3(0)) - 1) < 1e-6;
                         }});
    cases.push_back({.function = "tgFurFall",
                     .body = "return float4(tgFurFall(a0, a1), 0, 0, 0);",
                     .arguments = {linear(-1, 20), logarithmic(1e-3, 1)},
                     .expected = [](const Inputs& x) { return values(fall(std::max(x.scalar(0), 1e-3), x.scalar(1))); },
                     .tolerance = {.forward = 8, .backward = 8, .absolute = 1e-6, .why = "the root of a difference near 0"},
                     .domain = [](const Inputs& x) { return std::abs(1 - 2 * x.scalar(0) * x.scalar(1)) > 1e-4; }});
    cases.push_back(
        {.function = "tgFurFallen",
         .body = "return float4(tgFurFallen(a0, a1), 0, 0, 0);",
         .arguments = {linear(-1, 20), linear(0, 4)},
         .expected = [](const Inputs& x) { return values(fallen(std::max(x.scalar(0), 1e-3), x.scalar(1))); },
         .tolerance = {.forward = 8, .backward = 4, .absolute = 1e-6, .why = "a sum of 20,000 slopes, the one with the kink by 1e-8"}});
    cases.push_back(
        {.function = "tgFurSpare",
         .body = "return float4(tgFurSpare(a0, a1, a2, a3), 0, 0, 0);",
         .arguments = {whole(1, 512), logarithmic(0.1, 1000), logarithmic(0.5, 16), whole(1, 64)},
         .expected =
             [](const Inputs& x) { return values(std::log2(x.scalar(0)) - std::log2(std::max(x.scalar(1) / x.scalar(2), x.scalar(3)))); },
         .tolerance = {.forward = 4, .backward = 2, .absolute = 2e-6, .why = "a logarithm of a quotient"},
         .domain = [](const Inputs& x) { return x.scalar(0) >= 1 && x.scalar(2) >= 0.5 && x.scalar(3) >= 1; }});
    cases.push_back({.function = "tgFurStride",
                     .body = "return float4(tgFurStride(a0), 0, 0, 0);",
                     .arguments = {linear(-4, 9)},
                     .expected =
                         [](const Inputs& x) { // how often 2 goes into it
                             double stride = 1;
                             for (double spare = x.scalar(0) + 0.02; spare >= 1; spare -= 1)
                                 stride *= 2;
                             return values(stride);
                         },
                     .tolerance = {.forward = 2, .backward = 0, .why = "powers of two from a rounded exponential"},
                     .domain = [](const Inputs& x) { return std::abs(x.scalar(0) + 0.02 - std::round(x.scalar(0) + 0.02)) > 1e-5; }});
    cases.push_back({.function = "tgFurMeanRadius",
                     .body = "return float4(tgFurMeanRadius(a0, a1), 0, 0);",
                     .arguments = {linear(0, 1, 2), linear(0.1, 0.9)},
                     .expected =
                         [](const Inputs& x) {
                             const double s = x.scalar(1);
                             return values(meanRadius(x.scalar(0, 0), s), meanRadius(x.scalar(0, 1), s));
                         },
                     .tolerance = {.forward = 8, .backward = 4, .absolute = 1e-5, .why = "1 - least + h ln(least) cancels near the tips"},
                     .samples = 1024});
    cases.push_back({.function = "tgFurExpected",
                     .body = "return float4(tgFurExpected(a0, a1, a2), 0, 0, 0);",
                     .arguments = {linear(0, 2), linear(0, 0.5, 2), linear(0, 20)},
                     .expected =
                         [](const Inputs& x) {
                             const double a = x.scalar(1, 0);
                             const double b = x.scalar(1, 1);
                             const double sideways = 2 * x.scalar(2) * std::midpoint(a, b); // twice the mean radius, along the way
                             const double above = std::numbers::pi * (b * b - a * a);
                             return values(-std::expm1(-x.scalar(0) * (sideways + above)));
                         },
                     .tolerance = {.forward = 60, .backward = 4, .absolute = 1e-6, .why = "1 - exp: exp errs by 3 + 2|x| ULP of 1"},
                     .domain = [](const Inputs& x) { return x.scalar(1, 1) >= x.scalar(1, 0); }}); // strands grow wider downwards
    return cases;
}

/// Texels and tables of the map as if it were kTgFurRootsWidth = 4096 wide and three texels high.
constexpr std::int64_t kWidth = 4096;
constexpr std::int64_t kRows = 3;

double tableEntry(std::int64_t first, std::int64_t index) {
    const std::int64_t texel = first + index / 4;
    const std::int64_t row = texel / kWidth;
    const glm::dvec2 uv((static_cast<double>(texel % kWidth) + 0.5) / kWidth, (static_cast<double>(row) + 0.5) / kRows);
    return addressMap().at(uv)[static_cast<int>(index % 4)];
}

using Cell = glm::tvec3<std::int64_t>;

std::int64_t number(const Cell& cell, const Cell& count) {
    return cell.x + count.x * (cell.y + count.y * cell.z);
}

const Cell kBricks(4, 3, 5);

/// In cells, from the corner of a grid of these bricks of `side` cells each.
glm::dvec3 inGrid(const glm::dvec3& place, std::int64_t side) {
    return glm::clamp((place - glm::dvec3(1, 2, 3)) / 7.0, glm::dvec3(0), glm::dvec3(kBricks * side) - 0.5);
}

double rootList(const glm::dvec3& place) {
    constexpr std::int64_t kSide = 4;
    const Cell cell(inGrid(place, kSide));
    const double table = tableEntry(50 + number(cell / kSide, kBricks), 0);
    if (table == 0) return 0;
    return tableEntry(std::llround(table), number(cell - cell / kSide * kSide, Cell(kSide)));
}

/// Between the nodes of a brick of 8 cells, 4 apart: along x, then y, then z.
glm::dvec4 rootCoat(const glm::dvec3& place) {
    constexpr std::int64_t kSide = 8;
    const glm::dvec3 cells = inGrid(place, kSide);
    const Cell brick = Cell(cells) / kSide;
    const double table = tableEntry(50 + number(brick, kBricks), 0);
    if (table == 0) return glm::dvec4(0);
    const glm::dvec3 within = (cells - glm::dvec3(brick * kSide)) / 4.0;
    const Cell low = glm::min(Cell(within), Cell(1));
    const auto at = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
        const std::int64_t texel = std::llround(table) + kSide * kSide * kSide / 4 + number(low + Cell(x, y, z), Cell(3));
        return glm::dvec4(tableEntry(texel, 0), tableEntry(texel, 1), tableEntry(texel, 2), tableEntry(texel, 3));
    };
    const glm::dvec3 t = within - glm::dvec3(low);
    const auto along = [&](std::int64_t y, std::int64_t z) { return glm::mix(at(0, y, z), at(1, y, z), t.x); };
    const auto across = [&](std::int64_t z) { return glm::mix(along(0, z), along(1, z), t.y); };
    return glm::mix(across(0), across(1), t.z);
}

bool offFaces(const glm::dvec3& place) { // of cells, where rounding decides
    const glm::dvec3 c = (place - glm::dvec3(1, 2, 3)) / 7.0;
    const glm::dvec3 off = glm::abs(c - glm::round(c));
    return std::min({off.x, off.y, off.z}) > 1e-5;
}

std::vector<FunctionCase> roots() {
    const Tolerance exact{.forward = 0, .backward = 0, .why = "whole numbers"};
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgFurTexel",
                     .body = "return float4(tgFurTexel(a0, a1), 0, 0);",
                     .arguments = {whole(0, 8000000), whole(1, 4000)},
                     .expected =
                         [](const Inputs& x) {
                             const auto index = std::llround(x.scalar(0));
                             const auto row = index / kWidth;
                             return values((static_cast<double>(index % kWidth) + 0.5) / kWidth,
                                           (static_cast<double>(row) + 0.5) / x.scalar(1));
                         },
                     .tolerance = {.forward = 4, .backward = 0, .why = "two quotients and their sum; a texel's border is 1,000 ULP away"}});
    cases.push_back({.function = "tgFurRootPlace",
                     .body = "return float4(tgFurRootPlace(a0, a1, float4(a2, a3)), 0);",
                     .arguments = {vector(3, 1e-6, 1e6), logarithmic(1e-6, 1e6), vector(3, 0.1, 1e3), logarithmic(1, 1e3)},
                     .expected =
                         [](const Inputs& x) { // as many radii from the centre of one ball as of the other
                             return values(x.vec3(2) + x.scalar(3) * (x.vec3(0) / x.scalar(1)));
                         },
                     .tolerance = {.forward = 4, .backward = 4, .absolute = 1e-4, .why = "a sum of up to 1e3 that may cancel"},
                     .domain = [](const Inputs& x) { return x.scalar(1) >= 1e-6 && glm::length(x.vec3(0)) < 2 * x.scalar(1); }});
    cases.push_back({.function = "tgFurPick",
                     .body = "return float4(tgFurPick(a0, a1), 0, 0, 0);",
                     .arguments = {linear(-5, 5, 4), whole(0, 3)},
                     .expected = [](const Inputs& x) { return values(x.scalar(0, static_cast<std::size_t>(std::llround(x.scalar(1))))); },
                     .tolerance = exact});
    cases.push_back(
        {.function = "tgFurCellNumber",
         .body = "return float4(tgFurCellNumber(float3(a0, a1, a2), float3(a3, a4, 100)), 0, 0, 0);",
         .arguments = {whole(0, 99), whole(0, 99), whole(0, 99), whole(1, 100), whole(1, 100)},
         .expected =
             [](const Inputs& x) { return values(x.scalar(0) + x.scalar(3) * x.scalar(1) + x.scalar(3) * x.scalar(4) * x.scalar(2)); },
         .tolerance = exact});
    cases.push_back({.function = "tgFurTable",
                     .body = "return float4(tgFurTable(TG_SAMPLER2D_ARG(gTest), 3.0, a0, a1), 0, 0, 0);",
                     .arguments = {whole(0, 8000), whole(0, 1000)},
                     .expected = [](const Inputs& x) { return values(tableEntry(std::llround(x.scalar(0)), std::llround(x.scalar(1)))); },
                     .tolerance = exact,
                     .map = &addressMap()});
    cases.push_back(
        {.function = "tgFurRootList",
         .body =
             "return float4(tgFurRootList(TG_SAMPLER2D_ARG(gTest), a0, float4(1, 2, 3, 7), float4(4, 3, 5, 4), float2(3, 50)), 0, 0, 0);",
         .arguments = {linear(-20, 150, 3)},
         .expected = [](const Inputs& x) { return values(rootList(x.vec3(0))); },
         .tolerance = exact,
         .map = &addressMap(),
         .domain = [](const Inputs& x) { return offFaces(x.vec3(0)); }});
    cases.push_back(
        {.function = "tgFurBrick",
         .body = "TgFurBrick b = tgFurBrick(TG_SAMPLER2D_ARG(gTest), a0, float4(1, 2, 3, 7), float4(4, 3, 5, 4), float2(3, 50)); "
                 "return float4(b.cell + b.place, b.address);",
         .arguments = {linear(-20, 150, 3)},
         .expected =
             [](const Inputs& x) {
                 const glm::dvec3 cells = inGrid(x.vec3(0), 4);
                 const Cell brick = Cell(cells) / std::int64_t(4);
                 const glm::dvec3 corner(brick * std::int64_t(4));
                 return values(glm::dvec4(glm::floor(cells) + cells - 2.0 * corner, tableEntry(50 + number(brick, kBricks), 0)));
             },
         .tolerance = {.forward = 4, .backward = 2, .absolute = 2e-5, .why = "cells up to 20, by a division"},
         .map = &addressMap(),
         .domain = [](const Inputs& x) { return offFaces(x.vec3(0)); }});
    cases.push_back(
        {.function = "tgFurRootCoat",
         .body = "return tgFurRootCoat(TG_SAMPLER2D_ARG(gTest), a0, float4(1, 2, 3, 7), float4(4, 3, 5, 8), float2(3, 50), 4.0);",
         .arguments = {linear(-20, 300, 3)},
         .expected = [](const Inputs& x) { return values(rootCoat(x.vec3(0))); },
         .tolerance = {.forward = 16,
                       .backward = 8,
                       .absolute = 0.05,
                       .why = "between whole numbers of up to 8,000, at places that err by 1e-6 cells"},
         .map = &addressMap(),
         .domain = [](const Inputs& x) { return offFaces(x.vec3(0)); }});
    return cases;
}

} // namespace

std::vector<FunctionCase> furRootsCases() {
    return together(cells(), cones(), sweeps(), roots());
}

} // namespace tegument::test
