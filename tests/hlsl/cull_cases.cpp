// hlsl/cull against the definitions of docs/design/skin.md (passes 2, 3) and docs/design/modules/Main.md (culling).

#include "tests/hlsl/maps.h"

#include <algorithm>
#include <cmath>

namespace tegument::test {

namespace {

constexpr int kTiles = 64;
constexpr int kTileTexels = kTestMapSize / kTiles;

bool outside(const glm::dvec4& clip) {
    return clip.w <= 0 || std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w;
}

/// (Whether any texel of the tile is needed, its largest texels per mm along U and V, 1). The map serves as that of the stretch too, whose
/// densities outside the charts (alpha above 1/2) setting seed ignores.
glm::dvec4 tileMaximum(int tileX, int tileY, bool seed) {
    glm::dvec4 largest(0);
    for (int j = 0; j < kTileTexels; ++j)
        for (int i = 0; i < kTileTexels; ++i) {
            const glm::dvec4 texel = needMap().texel(tileX * kTileTexels + i, tileY * kTileTexels + j);
            const glm::dvec2 stretch = seed && texel.w > 0.5 ? glm::dvec2(1) : glm::dvec2(texel);
            largest = glm::max(largest, glm::dvec4(texel.x, stretch / 102.4 * double{kTestMapSize}, 1));
        }
    return largest;
}

/// The tile's middle texel: the map stands in for a map of tiles, read at their middles.
glm::dvec4 tile(int x, int y) {
    return needMap().texel(std::clamp(x, 0, kTiles - 1) * kTileTexels + kTileTexels / 2,
                           std::clamp(y, 0, kTiles - 1) * kTileTexels + kTileTexels / 2);
}

/// Whether a needed tile in this direction is no further than `reach`: mm times the largest density on the way, texels besides, and two
/// tiles.
double reached(int x, int y, int stepX, int stepY, glm::dvec2 reach) {
    double density = 0;
    for (int k = 0; k < kTiles; ++k) {
        const glm::dvec4 t = tile(x + k * stepX, y + k * stepY);
        density = std::max(density, stepX != 0 ? t.y : t.z);
        if (t.x > 0 && (k - 2) * kTileTexels <= reach.x * density + reach.y) return 1;
    }
    return 0;
}

constexpr const char* kTileUv = "float2 uv = (float2(a0, a1) + 0.51) / kTgCullTiles; ";

std::vector<Argument> tileArguments() {
    return {whole(0, kTiles - 1), whole(0, kTiles - 1), whole(0, 1), vector(2, 0.1, 30)};
}

std::vector<FunctionCase> visibility() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgCullOutside",
                     .body = "return float4(tgCullOutside(a0) ? 1 : 0, 0, 0, 0);",
                     .arguments = {vector(4, 0.1, 1000)},
                     .expected = [](const Inputs& x) { return values(outside(x.vec4(0)) ? 1 : 0); },
                     .tolerance = {.forward = 0, .backward = 0, .why = "comparisons of given numbers"}});
    cases.push_back({.function = "tgCullOutsideView",
                     .body = "return float4(tgCullOutsideView(a0) ? 1 : 0, 0, 0, 0);",
                     .arguments = {vector(4, 0.1, 1000)},
                     .expected =
                         [](const Inputs& x) {
                             if (x.corrected()) return values(outside(x.vec4(0)) ? 1 : 0);
                             const double w = std::abs(x.scalar(0, 3)) > 1e-6 ? x.scalar(0, 3) : 1e-6;
                             return values(x.scalar(0) / w > 1 || x.scalar(0, 1) / w > 1 ? 1 : 0);
                         },
                     .tolerance = {.forward = 0, .backward = 4, .why = "quotients against a threshold"},
                     .settings = {0, 1, 2}});
    cases.push_back({.function = "tgCullBackFace",
                     .body = "return float4(tgCullBackFace(a0, a1, a2) ? 1 : 0, 0, 0, 0);",
                     .arguments = {unit(), unit(), linear(0, 0.5)},
                     .expected = [](const Inputs& x) { return values(glm::dot(x.vec3(0), x.vec3(1)) < -x.scalar(2) ? 1 : 0); },
                     .tolerance = {.forward = 0, .backward = 4, .why = "a dot product against a threshold"}});
    cases.push_back({.function = "tgCullBlack",
                     .body = "return float4(tgCullBlack(a0) ? 1 : 0, 0, 0, 0);",
                     .arguments = {linear(0, 0.002, 3)},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec3 c = x.vec3(0);
                             return values(std::max({c.x, c.y, c.z}) <= (x.corrected() ? 2 / 255.0 / 12.92 : 0) ? 1 : 0);
                         },
                     .tolerance = {.forward = 0, .backward = 2, .why = "a comparison with a rounded constant"},
                     .settings = {0, 2}});
    return cases;
}

std::vector<FunctionCase> reach() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgReachOfCascade",
                     .body = "return float4(tgReachOfCascade(a0, a1), 0, 0);",
                     .arguments = {linear(0, 3, 4), linear(0, 3, 2)},
                     .expected =
                         [](const Inputs& x) {
                             const double sigma[] = {x.scalar(0),    x.scalar(0, 1), x.scalar(0, 2),
                                                     x.scalar(0, 3), x.scalar(1),    x.scalar(1, 1)};
                             double sum = 0;
                             for (int i = 0; i < 5; ++i)
                                 sum += std::sqrt(std::max(sigma[i + 1] * sigma[i + 1] - sigma[i] * sigma[i], 0.0));
                             return values(3 * sum, 17); // 5 convolutions of 3 texels, 2 for the look-up
                         },
                     .tolerance = {.forward = 8, .backward = 8, .why = "roots of differences of squares"}});
    cases.push_back({.function = "tgReachOfBlurs",
                     .body = "return float4(tgReachOfBlurs(a0, a1), 0, 0);",
                     .arguments = {linear(0, 20), whole(0, 6)},
                     .expected =
                         [](const Inputs& x) {
                             constexpr double kLongest = 1.01; // point of the disc
                             const double n = x.scalar(1);
                             if (x.corrected()) return values(x.scalar(0) * kLongest * n, 3.5 * n + 2);
                             return values(0, (2 * x.scalar(0) * kLongest + 0.5) * n + 2);
                         },
                     .tolerance = {.forward = 4, .backward = 2, .why = "a few products"},
                     .settings = {0, 2}});
    cases.push_back(
        {.function = "tgReachTile",
         .body = std::string(kTileUv) + "return tgReachTile(TG_SAMPLER2D_ARG(gTest), TG_SAMPLER2D_ARG(gTest), uv);",
         .arguments = {whole(0, kTiles - 1), whole(0, kTiles - 1)},
         .expected =
             [](const Inputs& x) { return values(tileMaximum(static_cast<int>(x.scalar(0)), static_cast<int>(x.scalar(1)), x.seed())); },
         .tolerance = {.forward = 4, .backward = 0, .why = "the largest of sixteen; densities are a quotient and a product"},
         .settings = {0, 2},
         .map = &needMap()});
    cases.push_back(
        {.function = "tgReachFrom",
         .body = std::string(kTileUv) +
                 "float2 axis = (a2 < 0.5 ? float2(1, 0) : float2(0, -1)) / kTgCullTiles;"
                 "return float4(tgReachFrom(TG_SAMPLER2D_ARG(gTest), uv, axis, a2 < 0.5 ? float2(1, 0) : float2(0, 1), a3), 0, 0, 0);",
         .arguments = tileArguments(),
         .expected =
             [](const Inputs& x) {
                 const bool u = x.scalar(2) < 0.5;
                 return values(reached(static_cast<int>(x.scalar(0)), static_cast<int>(x.scalar(1)), u ? 1 : 0, u ? 0 : -1, x.vec2(3)));
             },
         .tolerance = {.forward = 0, .backward = 4, .why = "a product against a threshold"},
         .map = &needMap()});
    cases.push_back(
        {.function = "tgReachAlong",
         .body = std::string(kTileUv) + "return tgReachAlong(TG_SAMPLER2D_ARG(gTest), uv, a2 < 0.5 ? float2(1, 0) : float2(0, 1), a3);",
         .arguments = tileArguments(),
         .expected =
             [](const Inputs& x) {
                 const int column = static_cast<int>(x.scalar(0));
                 const int row = static_cast<int>(x.scalar(1));
                 const bool u = x.scalar(2) < 0.5;
                 const double forwards = reached(column, row, u ? 1 : 0, u ? 0 : 1, x.vec2(3));
                 const double backwards = reached(column, row, u ? -1 : 0, u ? 0 : -1, x.vec2(3));
                 const glm::dvec4 here = tile(column, row);
                 return values(std::max(forwards, backwards), here.y, here.z, 1);
             },
         .tolerance = {.forward = 0, .backward = 4, .why = "as tgReachFrom"},
         .map = &needMap()});
    return cases;
}

} // namespace

std::vector<FunctionCase> cullCases() {
    return together(visibility(), reach());
}

} // namespace tegument::test
