// hlsl/shadow/soft.fxh against Fernando's definition, tap by tap in double precision; hlsl/shadow/blocks.fxh against least squares.

#include "tests/hlsl/maps.h"

#include <algorithm>
#include <cmath>

namespace tegument::test {

namespace {

constexpr double kGolden = 2.399963229728653; // pi (3 - sqrt 5)

double softStored(glm::dvec2 uv) {
    if (uv != glm::clamp(uv, 0.0, 1.0)) return 1e9;
    const double depth = shadowMap().at(uv).x;
    return depth > 0 ? depth : 1e9;
}

glm::dvec2 softTap(int i, int count, double turn) {
    return std::sqrt((i + 0.5) / count) * glm::dvec2(std::cos(kGolden * i + turn), std::sin(kGolden * i + turn));
}

/// Share of a disc of so many texels in which nothing lies before `depth`.
double softDisc(glm::dvec2 uv, double depth, double radius, double turn) {
    double lit = 0;
    for (int i = 0; i < 32; ++i)
        lit += depth <= softStored(uv + radius * softTap(i, 32, turn) / double{kTestMapSize}) ? 1.0 / 32 : 0;
    return lit;
}

struct SoftLight {
    double size = 0;
    bool point = false;
    glm::dvec2 slope{0}; // of the plane that it falls on

    /// mm to that plane, so many texels away.
    [[nodiscard]] double plane(double depth, const glm::dvec2& texels) const {
        const double rise = glm::dot(slope, texels);
        return point ? 1 / (1 / depth - rise / (depth * depth)) : depth + rise;
    }
    [[nodiscard]] double width(double gap, double before) const { return size * gap / std::max(point ? before : 1.0, 1e-3); }
};

constexpr int kBlocks = kTestMapSize / 8;

/// Least squares over 64 texels, or no slope where one of them has no surface.
glm::dvec4 blockOf(const glm::dvec2& block) {
    const auto stored = [&](int x, int y) { return softStored((8.0 * block + glm::dvec2(x, y) + 0.5) / double{kTestMapSize}); };
    glm::dvec2 slope(0);
    bool whole = true;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            whole = whole && stored(x, y) < 1e8;
            slope += stored(x, y) * glm::dvec2(x - 3.5, y - 3.5) / 336.0;
        }
    if (!whole) slope = glm::dvec2(0);
    double least = 1e9;
    double most = 0;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            const double rest = stored(x, y) - glm::dot(slope, glm::dvec2(x - 3.5, y - 3.5));
            least = std::min(least, rest);
            most = std::max(most, rest);
        }
    return {least, slope, most - least};
}

/// What a map of blocks holds, at a place: the shadow map itself serves as one.
glm::dvec4 blockAt(const glm::dvec2& texels) {
    const glm::dvec2 block = glm::clamp(glm::floor(texels / 8.0), 0.0, kBlocks - 1.0);
    glm::dvec4 found = shadowMap().at((block + 0.5) / double{kBlocks});
    found.x += glm::dot(glm::dvec2(found.y, found.z), texels - 8.0 * (block + 0.5));
    return found;
}

struct Says {
    double value = 0.5;
    double margin = 1e9; // mm to where it would say something else
};

Says saysOf(const glm::dvec4& block, double depth, const glm::dvec2& slope, double bend, double radius) {
    const glm::dvec2 own(block.y, block.z);
    const double reach = radius * glm::length(slope - own) + 0.5 * (std::abs(own.x) + std::abs(own.y));
    const double lit = block.x - (depth + bend + reach);
    const double dark = depth - reach - (block.x + block.w);
    return {dark > 0 ? 0.0 : (lit >= 0 ? 1.0 : 0.5), std::min(std::abs(lit), std::abs(dark))};
}

/// spread: of a light at a point 1; more bends what it sees of a plane by so much more.
Says blocksSay(const glm::dvec2& uv, double depth, const glm::dvec2& slope, double spread, double radius) {
    const glm::dvec2 texels = uv * double{kTestMapSize};
    const double rise = glm::length(slope) * radius;
    const double share = spread / depth;
    const double bend = share * rise * rise / (1 - share * rise);
    Says all;
    double sum = 0;
    for (const glm::dvec2& way : {glm::dvec2(-1, -1), {1, -1}, {-1, 1}, {1, 1}}) {
        glm::dvec4 block = blockAt(texels + radius * way);
        block.x -= radius * glm::dot(glm::dvec2(block.y, block.z), way);
        const Says says = saysOf(block, depth, slope, bend, radius);
        all.margin = std::min(all.margin, says.margin);
        sum += says.value;
        const glm::dvec2 place = glm::fract((texels + radius * way) / 8.0);
        for (const double f : {place.x, place.y})
            all.margin = std::min(all.margin, 8 * std::min(f, 1 - f));
    }
    const glm::dvec2 edge(radius / kTestMapSize);
    const bool inside = uv - edge == glm::clamp(uv - edge, 0.0, 1.0) && uv + edge == glm::clamp(uv + edge, 0.0, 1.0);
    all.margin = std::min(all.margin, std::abs(radius - 4));
    all.value = radius > 4 || (sum > 0 && sum < 4) || (sum == 0 && !inside) ? 0.5 : sum / 4;
    return all;
}

constexpr double kFootprint = 0.5;

double softReach(double depth, const SoftLight& light) {
    return std::max(light.width(depth - 400, 400) / kFootprint, 1.5);
}

double awayFromBorders(const glm::dvec2& texels, double size) {
    const glm::dvec2 f = glm::fract(texels / size);
    return size * std::min({f.x, 1 - f.x, f.y, 1 - f.y});
}

struct SoftSearch {
    double value = 0;    // the filter's radius; or whether anything may hide the light
    double margin = 1e9; // mm or texels to where one of the taps would say something else
};

/// `beside`: texels that a tap stands for on each side; `stored`: what it reads there.
template <class Stored>
SoftSearch softSearch(const glm::dvec2& uv, double depth, const SoftLight& light, double turn, int taps, double beside, Stored stored) {
    const double search = softReach(depth, light);
    double hiding = 0;
    double widths = 0;
    SoftSearch found;
    for (int i = 0; i < taps; ++i) {
        const glm::dvec2 offset = search * softTap(i, taps, turn);
        const glm::dvec2 texels = uv * double{kTestMapSize} + offset;
        const double plane = light.plane(depth, offset);
        const double away = search * std::sqrt((i + 0.5) / taps);
        const double before = stored(texels);
        const double width = std::max(light.width(depth - before, before) / kFootprint, 1.5);
        found.margin = std::min(
            {found.margin, std::abs(before - plane), std::abs(width + beside - away), awayFromBorders(texels, beside > 0 ? beside : 1)});
        if (before > plane || away > width + beside) continue;
        hiding += 1;
        widths += width;
    }
    found.value = beside > 0 ? std::min(hiding, 1.0) : std::max(hiding > 0 ? widths / hiding : 0, 1.5);
    return found;
}

SoftSearch softGlance(const glm::dvec2& uv, double depth, const SoftLight& light, double turn) {
    return softSearch(uv, depth, light, turn, 32, 8, [](const glm::dvec2& texels) { return blockAt(texels).x; });
}

SoftSearch softRadius(const glm::dvec2& uv, double depth, const SoftLight& light, double turn) {
    return softSearch(uv, depth, light, turn, 64, 0, [](const glm::dvec2& texels) { return softStored(texels / double{kTestMapSize}); });
}

/// By the blocks where they know it, else by taps.
double spared(const glm::dvec2& uv, double depth, bool point, double radius, double turn) {
    const Says says = blocksSay(uv, depth, glm::dvec2(0), point ? 1 : 0, radius);
    return says.value == 0.5 ? softDisc(uv, depth, radius, turn) : says.value;
}

/// Arguments: depth, slope, whether the light is at a point, radius, turn. Of a plane below a level at 600 mm.
Says litOnPlane(const Inputs& x) {
    const double depth = x.scalar(0);
    Says lit{.value = 0};
    for (int i = 0; i < 32; ++i) {
        const double rise = glm::dot(x.vec2(1), x.scalar(3) * softTap(i, 32, x.scalar(4)));
        const double plane = x.scalar(2) > 0.5 ? 1 / (1 / depth - rise / (depth * depth)) : depth + rise;
        lit.value += plane <= 600 ? 1.0 / 32 : 0;
        lit.margin = std::min(lit.margin, std::abs(plane - 600));
    }
    return lit;
}

/// Arguments: how far the receiver lies before a level at 600 mm that hides nothing, slope, spread, radius. All of its disc is lit where
/// the plane, bent as from a light at a point, does not reach the level. mm between the two.
double beforeLevel(const Inputs& x) {
    const double depth = 600 - x.scalar(0);
    const double rise = glm::length(x.vec2(1)) * x.scalar(3);
    const double share = x.scalar(2) / depth;
    return 600 - depth - rise - share * rise * rise / std::max(1 - share * rise, 0.05);
}

constexpr double kSure = 2e-3; // mm and texels: roundings of 700 and 256
const char* const kTaps = "three taps of 32 on the border of a texel may see either side of it";

std::vector<FunctionCase> blockCases() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgBlockTexel",
                     .body = "return float4(tgBlockTexel(TG_SAMPLER2D_ARG(gTest), float2(a0, a1), a2), 0);",
                     .arguments = {whole(0, kBlocks - 1), whole(0, kBlocks - 1), whole(0, 63)},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec2 place(std::fmod(x.scalar(2), 8), std::floor(x.scalar(2) / 8));
                             const double stored =
                                 softStored((8.0 * glm::dvec2(x.scalar(0), x.scalar(1)) + place + 0.5) / double{kTestMapSize});
                             return values(glm::dvec3(place - 3.5, stored));
                         },
                     .tolerance = {.why = "the map's own number"},
                     .map = &shadowMap()});
    cases.push_back({.function = "tgShadowBlock",
                     .body = "float4 b = tgShadowBlock(TG_SAMPLER2D_ARG(gTest), float2(a0, a1)); return float4(b.xyz, min(b.w, 1e4));",
                     .arguments = {whole(0, kBlocks - 1), whole(0, kBlocks - 1)},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec4 block = blockOf({x.scalar(0), x.scalar(1)});
                             return values(glm::dvec4(glm::dvec3(block), std::min(block.w, 1e4)));
                         },
                     .tolerance = {.absolute = 1e-3, .why = "distances of 600, 6e-5 off, times 3.5"},
                     .map = &shadowMap()});
    cases.push_back({.function = "tgShadowBlockAt",
                     .body = "return tgShadowBlockAt(TG_SAMPLER2D_ARG(gTest), a0);",
                     .arguments = {linear(-20, 280, 2)},
                     .expected = [](const Inputs& x) { return values(blockAt(x.vec2(0))); },
                     .tolerance = {.absolute = 1e-3, .why = "a sum of 600 and less than 40"},
                     .map = &shadowMap(),
                     .domain =
                         [](const Inputs& x) {
                             const glm::dvec2 f = glm::fract(x.vec2(0) / 8.0);
                             return std::min({f.x, 1 - f.x, f.y, 1 - f.y}) > 1e-4;
                         }});
    cases.push_back(
        {.function = "tgShadowBlockSays",
         .body = "return float4(tgShadowBlockSays(float4(600, a0, a1), a2, a3, a4, a5), 0, 0, 0);",
         .arguments = {linear(-0.5, 0.5, 2), linear(0, 4), linear(590, 610), linear(-0.5, 0.5, 2), linear(0, 0.2), linear(0, 4)},
         .expected =
             [](const Inputs& x) {
                 const glm::dvec4 block(600, x.vec2(0), x.scalar(1));
                 return values(saysOf(block, x.scalar(2), x.vec2(3), x.scalar(4), x.scalar(5)).value);
             },
         .tolerance = {.why = "0, 0.5 or 1"},
         .domain =
             [](const Inputs& x) {
                 const glm::dvec4 block(600, x.vec2(0), x.scalar(1));
                 return saysOf(block, x.scalar(2), x.vec2(3), x.scalar(4), x.scalar(5)).margin > kSure;
             }});
    static const TestMap kLevelBlock{.size = 1, .texels = {{600, 0, 0, 5}}};
    cases.push_back({.function = "tgShadowBlocks",
                     .body = "return float4(tgShadowBlocks(TG_SAMPLER2D_ARG(gTest), float2(0.5, 0.5), 600.0 - a0, a1, float2(1, a2), a3), "
                             "0, 0, 0);",
                     .arguments = {linear(0, 40), linear(0, 0.7, 2), linear(0, 220), linear(0.5, 4)},
                     .expected = [](const Inputs& x) { return values(beforeLevel(x) >= 0 ? 1 : 0.5); },
                     .tolerance = {.why = "0.5 or 1"},
                     .map = &kLevelBlock,
                     .domain = [](const Inputs& x) { return std::abs(beforeLevel(x)) > kSure && x.scalar(3) < 3.99; }});
    for (const int most : {1, 60}) // the second for what a bend of up to 2 mm changes
        cases.push_back(
            {.function = "tgShadowBlocks",
             .body = "return float4(tgShadowBlocks(TG_SAMPLER2D_ARG(gTest), a0, a1, a2, float2(1, a3), a4), 0, 0, 0);",
             .arguments = {linear(0, 1, 2), linear(580, 620), linear(0, 0.5, 2), whole(0, most), linear(0.5, 5)},
             .expected =
                 [](const Inputs& x) { return values(blocksSay(x.vec2(0), x.scalar(1), x.vec2(2), x.scalar(3), x.scalar(4)).value); },
             .tolerance = {.why = "0, 0.5 or 1"},
             .map = &shadowMap(),
             .domain =
                 [](const Inputs& x) { return blocksSay(x.vec2(0), x.scalar(1), x.vec2(2), x.scalar(3), x.scalar(4)).margin > kSure; }});
    return cases;
}

std::vector<FunctionCase> spiralCases() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgSoftWay",
                     .body = "return float4(tgSoftWay(a0), 0, 0);",
                     .arguments = {linear(0, 6.28)},
                     .expected = [](const Inputs& x) { return values(glm::dvec2(std::cos(x.scalar(0)), std::sin(x.scalar(0)))); },
                     .tolerance = {.absolute = 2e-6, .why = "Vulkan allows sine and cosine 2^-11; drivers have 2^-20 within a turn"}});
    cases.push_back({.function = "tgSoftNext",
                     .body = "return float4(tgSoftNext(a0), 0, 0);",
                     .arguments = {linear(-1, 1, 2)},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec2 w = x.vec2(0);
                             const double c = std::cos(kGolden);
                             const double s = std::sin(kGolden);
                             return values(glm::dvec2(c * w.x - s * w.y, s * w.x + c * w.y));
                         },
                     .tolerance = {.absolute = 3e-7, .why = "two products of numbers up to 1, rounded three times"}});
    cases.push_back({.function = "tgSoftShare",
                     .body = "return float4(tgSoftShare(a0, 64), 0, 0, 0);",
                     .arguments = {whole(0, 63)},
                     .expected = [](const Inputs& x) { return values(std::sqrt((x.scalar(0) + 0.5) / 64)); },
                     .tolerance = {.why = "a square root"}});
    return cases;
}

} // namespace

std::vector<FunctionCase> softShadowCases() {
    std::vector<FunctionCase> cases = blockCases();
    for (FunctionCase& each : spiralCases())
        cases.push_back(std::move(each));
    cases.push_back({.function = "tgSoftNoise",
                     .body = "return float4(tgSoftNoise(a0), 0, 0, 0);",
                     .arguments = {linear(0, 1024, 2)},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec2 p = glm::floor(x.vec2(0));
                             return values(glm::fract(52.9829189 * glm::fract(0.06711056 * p.x + 0.00583715 * p.y)));
                         },
                     .tolerance = {.absolute = 6e-4, .why = "53 times a sum of up to 75, half an ULP of it 4e-6 twice"},
                     .domain =
                         [](const Inputs& x) {
                             const glm::dvec2 p = glm::floor(x.vec2(0));
                             const double inner = glm::fract(0.06711056 * p.x + 0.00583715 * p.y);
                             const double outer = glm::fract(52.9829189 * inner);
                             return std::min(outer, 1 - outer) > 1e-3 && std::min(inner, 1 - inner) > 1e-4;
                         }});
    cases.push_back(
        {.function = "tgSoftWidth",
         .body = "return float4(tgSoftWidth(float2(a0, a3), a1, a2), 0, 0, 0);",
         .arguments = {linear(0, 50), linear(0, 500), linear(1, 1000), whole(0, 1)},
         .expected = [](const Inputs& x) { return values(x.scalar(0) * x.scalar(1) / (x.scalar(3) > 0.5 ? x.scalar(2) : 1.0)); },
         .tolerance = {.forward = 8, .why = "a product and a quotient; 1 + 1 (x - 1)"}});
    // Along a plane whose distance is the reciprocal of a linear function: a small step and a large one lie on the same plane.
    cases.push_back({.function = "tgSoftPlane",
                     .body = "return float4(tgSoftPlane(a0, a1, a2, float2(1, a3)), 0, 0, 0);",
                     .arguments = {linear(-20, 20, 2), linear(400, 700), linear(-2, 2, 2), whole(0, 1)},
                     .expected =
                         [](const Inputs& x) {
                             const double rise = glm::dot(x.vec2(0), x.vec2(2));
                             const double depth = x.scalar(1);
                             return values(x.scalar(3) > 0.5 ? 1 / (1 / depth - rise / (depth * depth)) : depth + rise);
                         },
                     .tolerance = {.forward = 16, .backward = 4, .absolute = 1e-3, .why = "a sum of 700, 6e-5 off, and two quotients"}});
    cases.push_back({.function = "tgSoftStored",
                     .body = "return float4(tgSoftStored(TG_SAMPLER2D_ARG(gTest), a0, a1), 0, 0, 0);",
                     .arguments = {linear(-0.1, 1.1, 2), linear(-20, 20, 2)},
                     .expected = [](const Inputs& x) { return values(softStored(x.vec2(0) + x.vec2(1) / double{kTestMapSize})); },
                     .tolerance = {.why = "the map's own number"},
                     .map = &shadowMap(),
                     .domain =
                         [](const Inputs& x) {
                             const glm::dvec2 f = glm::fract(x.vec2(0) * double{kTestMapSize} + x.vec2(1));
                             return std::min({f.x, 1 - f.x, f.y, 1 - f.y}) > 1e-3;
                         }});
    cases.push_back(
        {.function = "tgShadowDisc",
         .body = "return float4(tgShadowDisc(TG_SAMPLER2D_ARG(gTest), a0, a1, float2(0, 0), float2(1, 1), a2, tgSoftWay(a3)), 0, 0, 0);",
         .arguments = {linear(0.1, 0.9, 2), linear(500, 700), linear(0.5, 4), linear(0, 6.28)},
         .expected = [](const Inputs& x) { return values(softDisc(x.vec2(0), x.scalar(1), x.scalar(2), x.scalar(3))); },
         .tolerance = {.absolute = 0.0955, .why = "three taps of 32 on the border of a texel may see either side of it"},
         .map = &shadowMap()});
    static const TestMap kLevelMap{.size = 1, .texels = {{600, 0, 0, 1}}};
    cases.push_back(
        {.function = "tgShadowDisc",
         .body = "return float4(tgShadowDisc(TG_SAMPLER2D_ARG(gTest), a0, a1, float2(0, 0), float2(1, 1), a2, tgSoftWay(a3)), 0, 0, 0);",
         .arguments = {linear(0.1, 0.9, 2), linear(500, 700), linear(0.5, 4), linear(0, 6.28)},
         .expected = [](const Inputs& x) { return values(x.scalar(1) <= 600 ? 1 : 0); },
         .tolerance = {.absolute = 1e-6, .why = "32 taps alike"},
         .map = &kLevelMap,
         .domain = [](const Inputs& x) { return std::abs(x.scalar(1) - 600) > 1e-3; }});
    // On a plane that falls beneath what lies before it: each tap at its own place.
    cases.push_back({.function = "tgShadowDisc",
                     .body = "return float4(tgShadowDisc(TG_SAMPLER2D_ARG(gTest), float2(0.5, 0.5), a0, a1, float2(1, a2), a3, "
                             "tgSoftWay(a4)), 0, 0, 0);",
                     .arguments = {linear(595, 605), linear(-2, 2, 2), whole(0, 1), linear(0.5, 4), linear(0, 6.28)},
                     .expected = [](const Inputs& x) { return values(litOnPlane(x).value); },
                     .tolerance = {.forward = 0, .backward = 0, .absolute = 1e-6, .why = "parts of 32"},
                     .map = &kLevelMap,
                     .domain = [](const Inputs& x) { return litOnPlane(x).margin > kSure; }});
    cases.push_back(
        {.function = "tgShadowDiscSpared",
         .body = "return float4(tgShadowDiscSpared(TG_SAMPLER2D_ARG(gTest), TG_SAMPLER2D_ARG(gTest), a0, a1, float2(0, 0), "
                 "float2(1, a2), a3, tgSoftWay(a4)), 0, 0, 0);",
         .arguments = {linear(0.1, 0.9, 2), linear(580, 620), whole(0, 1), linear(0.5, 6), linear(0, 6.28)},
         .expected = [](const Inputs& x) { return values(spared(x.vec2(0), x.scalar(1), x.scalar(2) > 0.5, x.scalar(3), x.scalar(4))); },
         .tolerance = {.absolute = 0.0955, .why = kTaps},
         .map = &shadowMap(),
         .domain =
             [](const Inputs& x) { return blocksSay(x.vec2(0), x.scalar(1), glm::dvec2(0), x.scalar(2), x.scalar(3)).margin > kSure; }});
    const auto light = [](const Inputs& x) { return SoftLight{.size = x.scalar(2), .point = x.scalar(3) > 0.5}; };
    const auto sloping = [light](const Inputs& x) {
        SoftLight it = light(x);
        it.slope = x.vec2(5);
        return it;
    };
    const auto glanceOf = [](const auto& of) {
        return [of](const Inputs& x) { return softGlance(x.vec2(0), x.scalar(1), of(x), x.scalar(4)); };
    };
    const auto radiusOf = [](const auto& of) {
        return [of](const Inputs& x) { return softRadius(x.vec2(0), x.scalar(1), of(x), x.scalar(4)); };
    };
    const std::vector<Argument> arguments = {linear(0.1, 0.9, 2), linear(500, 700), linear(0.005, 0.02), whole(0, 1), linear(0, 6.28)};
    std::vector<Argument> withSlope = arguments;
    withSlope.push_back(linear(-1, 1, 2));
    cases.push_back({.function = "tgSoftReach",
                     .body = "return float4(tgSoftReach(a1, 0.5, float2(a2, a3), 400), 0, 0, 0);",
                     .arguments = arguments,
                     .expected = [light](const Inputs& x) { return values(softReach(x.scalar(1), light(x))); },
                     .tolerance = {.forward = 8, .why = "a product and two quotients"}});
    cases.push_back({.function = "tgSoftGlance",
                     .body = "return float4(tgSoftGlance(TG_SAMPLER2D_ARG(gTest), a0, a1, a5, 0.5, float2(a2, a3), "
                             "tgSoftReach(a1, 0.5, float2(a2, a3), 400), tgSoftWay(a4)), 0, 0, 0);",
                     .arguments = withSlope,
                     .expected = [glance = glanceOf(sloping)](const Inputs& x) { return values(glance(x).value); },
                     .tolerance = {.why = "0 or 1"},
                     .map = &shadowMap(),
                     .domain = [glance = glanceOf(sloping)](const Inputs& x) { return glance(x).margin > kSure; }});
    cases.push_back({.function = "tgSoftRadius",
                     .body = "return float4(tgSoftRadius(TG_SAMPLER2D_ARG(gTest), a0, a1, a5, 0.5, float2(a2, a3), "
                             "tgSoftReach(a1, 0.5, float2(a2, a3), 400), tgSoftWay(a4)), 0, 0, 0);",
                     .arguments = withSlope,
                     .expected = [radius = radiusOf(sloping)](const Inputs& x) { return values(radius(x).value); },
                     .tolerance = {.absolute = 2e-3, .why = "a mean of differences of 600, over 0.5"},
                     .map = &shadowMap(),
                     .domain = [radius = radiusOf(sloping)](const Inputs& x) { return radius(x).margin > kSure; }});
    const auto glance = glanceOf(light);
    const auto radius = radiusOf(light);
    const auto filter = [glance, radius](const Inputs& x) { return glance(x).value > 0 ? radius(x).value : 1.5; };
    cases.push_back(
        {.function = "tgShadowSoft",
         .body = "return float4(tgShadowSoft(TG_SAMPLER2D_ARG(gTest), TG_SAMPLER2D_ARG(gTest), a0, a1, float2(0, 0), 0.5, "
                 "float2(a2, a3), 400, tgSoftWay(a4)), 0, 0, 0);",
         .arguments = arguments,
         .expected =
             [filter](const Inputs& x) { return values(spared(x.vec2(0), x.scalar(1), x.scalar(3) > 0.5, filter(x), x.scalar(4))); },
         .tolerance = {.absolute = 0.0955, .why = kTaps},
         .map = &shadowMap(),
         .domain =
             [=](const Inputs& x) {
                 return glance(x).margin > kSure && radius(x).margin > kSure &&
                        blocksSay(x.vec2(0), x.scalar(1), glm::dvec2(0), x.scalar(3) > 0.5, filter(x)).margin > kSure;
             }});
    return cases;
}

} // namespace tegument::test
