// hlsl/shadow/soft.fxh against Fernando's definition, tap by tap in double precision; hlsl/shadow/blocks.fxh against least squares.

#include "tests/hlsl/maps.h"

namespace tegument::test {

namespace {

constexpr double kGolden = 2.399963229728653; // pi (3 - sqrt 5)

double softStored(dvec2 uv) {
    if (uv != clamp(uv, 0.0, 1.0)) return 1e9;
    const double depth = shadowMap().at(uv).x;
    return depth > 0 ? depth : 1e9;
}

dvec2 softTap(int i, int count, double turn) {
    return sqrt((i + 0.5) / count) * dvec2(cos(kGolden * i + turn), sin(kGolden * i + turn));
}

/// Share of a disc of so many texels in which nothing lies before `depth`.
double softDisc(dvec2 uv, double depth, double radius, double turn) {
    double lit = 0;
    for (int i = 0; i < 32; ++i)
        lit += depth <= softStored(uv + radius * softTap(i, 32, turn) / double{kTestMapSize}) ? 1.0 / 32 : 0;
    return lit;
}

struct SoftLight {
    double size = 0;
    bool point = false;
    dvec2 slope{0}; // of the plane that it falls on

    /// mm to that plane, so many texels away.
    [[nodiscard]] double plane(double depth, const dvec2& texels) const {
        const double rise = dot(slope, texels);
        return point ? 1 / (1 / depth - rise / (depth * depth)) : depth + rise;
    }
    [[nodiscard]] double width(double gap, double before) const { return size * gap / max(point ? before : 1.0, 1e-3); }
};

constexpr int kBlocks = kTestMapSize / 8;

/// Least squares over 64 texels, or no slope where one of them has no surface.
dvec4 blockOf(const dvec2& block) {
    const auto stored = [&](int x, int y) { return softStored((8.0 * block + dvec2(x, y) + 0.5) / double{kTestMapSize}); };
    dvec2 slope(0);
    bool whole = true;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            whole = whole && stored(x, y) < 1e8;
            slope += stored(x, y) * dvec2(x - 3.5, y - 3.5) / 336.0;
        }
    if (!whole) slope = dvec2(0);
    double least = 1e9;
    double most = 0;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            const double rest = stored(x, y) - dot(slope, dvec2(x - 3.5, y - 3.5));
            least = min(least, rest);
            most = max(most, rest);
        }
    return {least, slope, most - least};
}

/// What a map of blocks holds, at a place: the shadow map itself serves as one.
dvec4 blockAt(const dvec2& texels) {
    const dvec2 block = clamp(floor(texels / 8.0), 0.0, kBlocks - 1.0);
    dvec4 found = shadowMap().at((block + 0.5) / double{kBlocks});
    found.x += dot(dvec2(found.y, found.z), texels - 8.0 * (block + 0.5));
    return found;
}

struct Says {
    double value = 0.5;
    double margin = 1e9; // mm to where it would say something else
};

Says saysOf(const dvec4& block, double depth, const dvec2& slope, double bend, double radius) {
    const dvec2 own(block.y, block.z);
    const double reach = radius * length(slope - own) + 0.5 * (abs(own.x) + abs(own.y));
    const double lit = block.x - (depth + bend + reach);
    const double dark = depth - reach - (block.x + block.w);
    return {dark > 0 ? 0.0 : (lit >= 0 ? 1.0 : 0.5), min(abs(lit), abs(dark))};
}

/// spread: of a light at a point 1; more bends what it sees of a plane by so much more.
Says blocksSay(const dvec2& uv, double depth, const dvec2& slope, double spread, double radius) {
    const dvec2 texels = uv * double{kTestMapSize};
    const double rise = length(slope) * radius;
    const double share = spread / depth;
    const double bend = share * rise * rise / (1 - share * rise);
    Says all;
    double sum = 0;
    for (const dvec2& way : {dvec2(-1, -1), {1, -1}, {-1, 1}, {1, 1}}) {
        dvec4 block = blockAt(texels + radius * way);
        block.x -= radius * dot(dvec2(block.y, block.z), way);
        const Says says = saysOf(block, depth, slope, bend, radius);
        all.margin = min(all.margin, says.margin);
        sum += says.value;
        const dvec2 place = fract((texels + radius * way) / 8.0);
        for (const double f : {place.x, place.y})
            all.margin = min(all.margin, 8 * min(f, 1 - f));
    }
    const dvec2 edge(radius / kTestMapSize);
    const bool inside = uv - edge == clamp(uv - edge, 0.0, 1.0) && uv + edge == clamp(uv + edge, 0.0, 1.0);
    all.margin = min(all.margin, abs(radius - 4));
    all.value = radius > 4 || (sum > 0 && sum < 4) || (sum == 0 && !inside) ? 0.5 : sum / 4;
    return all;
}

constexpr double kFootprint = 0.5;

double softReach(double depth, const SoftLight& light) {
    return max(light.width(depth - 400, 400) / kFootprint, 1.5);
}

double awayFromBorders(const dvec2& texels, double size) {
    const dvec2 f = fract(texels / size);
    return size * min({f.x, 1 - f.x, f.y, 1 - f.y});
}

struct SoftSearch {
    double value = 0;    // the filter's radius; or whether anything may hide the light
    double margin = 1e9; // mm or texels to where one of the taps would say something else
};

/// `beside`: texels that a tap stands for on each side; `stored`: what it reads there.
template <class Stored>
SoftSearch softSearch(const dvec2& uv, double depth, const SoftLight& light, double turn, int taps, double beside, Stored stored) {
    const double search = softReach(depth, light);
    double hiding = 0;
    double widths = 0;
    SoftSearch found;
    for (int i = 0; i < taps; ++i) {
        const dvec2 offset = search * softTap(i, taps, turn);
        const dvec2 texels = uv * double{kTestMapSize} + offset;
        const double plane = light.plane(depth, offset);
        const double away = search * sqrt((i + 0.5) / taps);
        const double before = stored(texels);
        const double width = max(light.width(depth - before, before) / kFootprint, 1.5);
        found.margin =
            min({found.margin, abs(before - plane), abs(width + beside - away), awayFromBorders(texels, beside > 0 ? beside : 1)});
        if (before > plane || away > width + beside) continue;
        hiding += 1;
        widths += width;
    }
    found.value = beside > 0 ? min(hiding, 1.0) : max(hiding > 0 ? widths / hiding : 0, 1.5);
    return found;
}

SoftSearch softGlance(const dvec2& uv, double depth, const SoftLight& light, double turn) {
    return softSearch(uv, depth, light, turn, 32, 8, [](const dvec2& texels) { return blockAt(texels).x; });
}

SoftSearch softRadius(const dvec2& uv, double depth, const SoftLight& light, double turn) {
    return softSearch(uv, depth, light, turn, 64, 0, [](const dvec2& texels) { return softStored(texels / double{kTestMapSize}); });
}

/// By the blocks where they know it, else by taps.
double spared(const dvec2& uv, double depth, bool point, double radius, double turn) {
    const Says says = blocksSay(uv, depth, dvec2(0), point ? 1 : 0, radius);
    return says.value == 0.5 ? softDisc(uv, depth, radius, turn) : says.value;
}

/// Arguments: depth, slope, whether the light is at a point, radius, turn. Of a plane below a level at 600 mm.
Says litOnPlane(In x) {
    const double depth = x[0];
    Says lit{.value = 0};
    for (int i = 0; i < 32; ++i) {
        const double rise = dot(x.vec2(1), x[3] * softTap(i, 32, x[4]));
        const double plane = x[2] > 0.5 ? 1 / (1 / depth - rise / (depth * depth)) : depth + rise;
        lit.value += plane <= 600 ? 1.0 / 32 : 0;
        lit.margin = min(lit.margin, abs(plane - 600));
    }
    return lit;
}

/// Arguments: how far the receiver lies before a level at 600 mm that hides nothing, slope, spread, radius. All of its disc is lit where
/// the plane, bent as from a light at a point, does not reach the level. mm between the two.
double beforeLevel(In x) {
    const double depth = 600 - x[0];
    const double rise = length(x.vec2(1)) * x[3];
    const double share = x[2] / depth;
    return 600 - depth - rise - share * rise * rise / max(1 - share * rise, 0.05);
}

constexpr double kSure = 2e-3; // mm and texels: roundings of 700 and 256
const char* const kTaps = "three taps of 32 on the border of a texel may see either side of it";

Cases blockCases() {
    Cases cases;
    cases.add("tgBlockTexel(TG_SAMPLER2D_ARG(gTest), float2(a0, a1), a2)", {whole(0, kBlocks - 1), whole(0, kBlocks - 1), whole(0, 63)},
              {4, 2, 0, "the map's own number"}, {.map = &shadowMap()}, [](In x) {
                  const dvec2 place(fmod(x[2], 8), floor(x[2] / 8));
                  const double stored = softStored((8.0 * dvec2(x[0], x[1]) + place + 0.5) / double{kTestMapSize});
                  return dvec3(place - 3.5, stored);
              });
    cases.add({"tgShadowBlock", "float4 b = tgShadowBlock(TG_SAMPLER2D_ARG(gTest), float2(a0, a1)); return float4(b.xyz, min(b.w, 1e4));"},
              {whole(0, kBlocks - 1), whole(0, kBlocks - 1)}, {4, 2, 1e-3, "distances of 600, 6e-5 off, times 3.5"}, {.map = &shadowMap()},
              [](In x) {
                  const dvec4 block = blockOf({x[0], x[1]});
                  return dvec4(dvec3(block), min(block.w, 1e4));
              });
    cases.add("tgShadowBlockAt(TG_SAMPLER2D_ARG(gTest), a0)", {linear(-20, 280, 2)}, {4, 2, 1e-3, "a sum of 600 and less than 40"},
              {.map = &shadowMap()}, [](In x) { return blockAt(x.vec2(0)); });
    cases.back().domain = [](In x) {
        const dvec2 f = fract(x.vec2(0) / 8.0);
        return min({f.x, 1 - f.x, f.y, 1 - f.y}) > 1e-4;
    };
    cases.add("tgShadowBlockSays(float4(600, a0, a1), a2, a3, a4, a5)",
              {linear(-0.5, 0.5, 2), linear(0, 4), linear(590, 610), linear(-0.5, 0.5, 2), linear(0, 0.2), linear(0, 4)},
              {4, 2, 0, "0, 0.5 or 1"}, [](In x) {
                  const dvec4 block(600, x.vec2(0), x[1]);
                  return saysOf(block, x[2], x.vec2(3), x[4], x[5]).value;
              });
    cases.back().domain = [](In x) {
        const dvec4 block(600, x.vec2(0), x[1]);
        return saysOf(block, x[2], x.vec2(3), x[4], x[5]).margin > kSure;
    };
    static const TestMap kLevelBlock{.size = 1, .texels = {{600, 0, 0, 5}}};
    cases.add("tgShadowBlocks(TG_SAMPLER2D_ARG(gTest), float2(0.5, 0.5), 600.0 - a0, a1, float2(1, a2), a3)",
              {linear(0, 40), linear(0, 0.7, 2), linear(0, 220), linear(0.5, 4)}, {4, 2, 0, "0.5 or 1"}, {.map = &kLevelBlock},
              [](In x) { return beforeLevel(x) >= 0 ? 1 : 0.5; });
    cases.back().domain = [](In x) { return abs(beforeLevel(x)) > kSure && x[3] < 3.99; };
    for (const int most : {1, 60}) { // the second for what a bend of up to 2 mm changes
        cases.add("tgShadowBlocks(TG_SAMPLER2D_ARG(gTest), a0, a1, a2, float2(1, a3), a4)",
                  {linear(0, 1, 2), linear(580, 620), linear(0, 0.5, 2), whole(0, most), linear(0.5, 5)}, {4, 2, 0, "0, 0.5 or 1"},
                  {.map = &shadowMap()}, [](In x) { return blocksSay(x.vec2(0), x[1], x.vec2(2), x[3], x[4]).value; });
        cases.back().domain = [](In x) { return blocksSay(x.vec2(0), x[1], x.vec2(2), x[3], x[4]).margin > kSure; };
    }
    return cases;
}

Cases spiralCases() {
    Cases cases;
    cases.add("tgSoftWay(a0)", {linear(0, 6.28)}, {4, 2, 2e-6, "Vulkan allows sine and cosine 2^-11; drivers have 2^-20 within a turn"},
              [](In x) { return dvec2(cos(x[0]), sin(x[0])); });
    cases.add("tgSoftNext(a0)", {linear(-1, 1, 2)}, {4, 2, 3e-7, "two products of numbers up to 1, rounded three times"}, [](In x) {
        const dvec2 w = x.vec2(0);
        const double c = cos(kGolden);
        const double s = sin(kGolden);
        return dvec2(c * w.x - s * w.y, s * w.x + c * w.y);
    });
    cases.add("tgSoftShare(a0, 64)", {whole(0, 63)}, {4, 2, 0, "a square root"}, [](In x) { return sqrt((x[0] + 0.5) / 64); });
    return cases;
}

} // namespace

Cases softShadowCases() {
    Cases cases = blockCases();
    for (FunctionCase& each : spiralCases())
        cases.push_back(std::move(each));
    cases.add("tgSoftNoise(a0)", {linear(0, 1024, 2)}, {4, 2, 6e-4, "53 times a sum of up to 75, half an ULP of it 4e-6 twice"}, [](In x) {
        const dvec2 p = floor(x.vec2(0));
        return fract(52.9829189 * fract(0.06711056 * p.x + 0.00583715 * p.y));
    });
    cases.back().domain = [](In x) {
        const dvec2 p = floor(x.vec2(0));
        const double inner = fract(0.06711056 * p.x + 0.00583715 * p.y);
        const double outer = fract(52.9829189 * inner);
        return min(outer, 1 - outer) > 1e-3 && min(inner, 1 - inner) > 1e-4;
    };
    cases.add("tgSoftWidth(float2(a0, a3), a1, a2)", {linear(0, 50), linear(0, 500), linear(1, 1000), whole(0, 1)},
              {8, 2, 0, "a product and a quotient; 1 + 1 (x - 1)"}, [](In x) { return x[0] * x[1] / (x[3] > 0.5 ? x[2] : 1.0); });
    // Along a plane whose distance is the reciprocal of a linear function: a small step and a large one lie on the same plane.
    cases.add("tgSoftPlane(a0, a1, a2, float2(1, a3))", {linear(-20, 20, 2), linear(400, 700), linear(-2, 2, 2), whole(0, 1)},
              {16, 4, 1e-3, "a sum of 700, 6e-5 off, and two quotients"}, [](In x) {
                  const double rise = dot(x.vec2(0), x.vec2(2));
                  const double depth = x[1];
                  return x[3] > 0.5 ? 1 / (1 / depth - rise / (depth * depth)) : depth + rise;
              });
    cases.add("tgSoftStored(TG_SAMPLER2D_ARG(gTest), a0, a1)", {linear(-0.1, 1.1, 2), linear(-20, 20, 2)},
              {4, 2, 0, "the map's own number"}, {.map = &shadowMap()},
              [](In x) { return softStored(x.vec2(0) + x.vec2(1) / double{kTestMapSize}); });
    cases.back().domain = [](In x) {
        const dvec2 f = fract(x.vec2(0) * double{kTestMapSize} + x.vec2(1));
        return min({f.x, 1 - f.x, f.y, 1 - f.y}) > 1e-3;
    };
    cases.add("tgShadowDisc(TG_SAMPLER2D_ARG(gTest), a0, a1, float2(0, 0), float2(1, 1), a2, tgSoftWay(a3))",
              {linear(0.1, 0.9, 2), linear(500, 700), linear(0.5, 4), linear(0, 6.28)},
              {4, 2, 0.0955, "three taps of 32 on the border of a texel may see either side of it"}, {.map = &shadowMap()},
              [](In x) { return softDisc(x.vec2(0), x[1], x[2], x[3]); });
    static const TestMap kLevelMap{.size = 1, .texels = {{600, 0, 0, 1}}};
    cases.add("tgShadowDisc(TG_SAMPLER2D_ARG(gTest), a0, a1, float2(0, 0), float2(1, 1), a2, tgSoftWay(a3))",
              {linear(0.1, 0.9, 2), linear(500, 700), linear(0.5, 4), linear(0, 6.28)}, {4, 2, 1e-6, "32 taps alike"}, {.map = &kLevelMap},
              [](In x) { return x[1] <= 600 ? 1 : 0; });
    cases.back().domain = [](In x) { return abs(x[1] - 600) > 1e-3; };
    // On a plane that falls beneath what lies before it: each tap at its own place.
    cases.add("tgShadowDisc(TG_SAMPLER2D_ARG(gTest), float2(0.5, 0.5), a0, a1, float2(1, a2), a3, tgSoftWay(a4))",
              {linear(595, 605), linear(-2, 2, 2), whole(0, 1), linear(0.5, 4), linear(0, 6.28)}, {0, 0, 1e-6, "parts of 32"},
              {.map = &kLevelMap}, [](In x) { return litOnPlane(x).value; });
    cases.back().domain = [](In x) { return litOnPlane(x).margin > kSure; };
    cases.add(
        "tgShadowDiscSpared(TG_SAMPLER2D_ARG(gTest), TG_SAMPLER2D_ARG(gTest), a0, a1, float2(0, 0), float2(1, a2), a3, tgSoftWay(a4))",
        {linear(0.1, 0.9, 2), linear(580, 620), whole(0, 1), linear(0.5, 6), linear(0, 6.28)}, {4, 2, 0.0955, kTaps}, {.map = &shadowMap()},
        [](In x) { return spared(x.vec2(0), x[1], x[2] > 0.5, x[3], x[4]); });
    cases.back().domain = [](In x) { return blocksSay(x.vec2(0), x[1], dvec2(0), x[2], x[3]).margin > kSure; };
    const auto light = [](In x) { return SoftLight{.size = x[2], .point = x[3] > 0.5}; };
    const auto sloping = [light](In x) {
        SoftLight it = light(x);
        it.slope = x.vec2(5);
        return it;
    };
    const auto glanceOf = [](const auto& of) { return [of](In x) { return softGlance(x.vec2(0), x[1], of(x), x[4]); }; };
    const auto radiusOf = [](const auto& of) { return [of](In x) { return softRadius(x.vec2(0), x[1], of(x), x[4]); }; };
    const Arguments arguments = {linear(0.1, 0.9, 2), linear(500, 700), linear(0.005, 0.02), whole(0, 1), linear(0, 6.28)};
    Arguments withSlope = arguments;
    withSlope.push_back(linear(-1, 1, 2));
    cases.add("tgSoftReach(a1, 0.5, float2(a2, a3), 400)", arguments, {8, 2, 0, "a product and two quotients"},
              [light](In x) { return softReach(x[1], light(x)); });
    cases.add(
        "tgSoftGlance(TG_SAMPLER2D_ARG(gTest), a0, a1, a5, 0.5, float2(a2, a3), tgSoftReach(a1, 0.5, float2(a2, a3), 400), tgSoftWay(a4))",
        withSlope, {4, 2, 0, "0 or 1"}, {.map = &shadowMap()}, [glance = glanceOf(sloping)](In x) { return glance(x).value; });
    cases.back().domain = [glance = glanceOf(sloping)](In x) { return glance(x).margin > kSure; };
    cases.add(
        "tgSoftRadius(TG_SAMPLER2D_ARG(gTest), a0, a1, a5, 0.5, float2(a2, a3), tgSoftReach(a1, 0.5, float2(a2, a3), 400), tgSoftWay(a4))",
        withSlope, {4, 2, 2e-3, "a mean of differences of 600, over 0.5"}, {.map = &shadowMap()},
        [radius = radiusOf(sloping)](In x) { return radius(x).value; });
    cases.back().domain = [radius = radiusOf(sloping)](In x) { return radius(x).margin > kSure; };
    const auto glance = glanceOf(light);
    const auto radius = radiusOf(light);
    const auto filter = [glance, radius](In x) { return glance(x).value > 0 ? radius(x).value : 1.5; };
    cases.add(
        "tgShadowSoft(TG_SAMPLER2D_ARG(gTest), TG_SAMPLER2D_ARG(gTest), a0, a1, float2(0, 0), 0.5, float2(a2, a3), 400, tgSoftWay(a4))",
        arguments, {4, 2, 0.0955, kTaps}, {.map = &shadowMap()},
        [filter](In x) { return spared(x.vec2(0), x[1], x[3] > 0.5, filter(x), x[4]); });
    cases.back().domain = [=](In x) {
        return glance(x).margin > kSure && radius(x).margin > kSure &&
               blocksSay(x.vec2(0), x[1], dvec2(0), x[3] > 0.5, filter(x)).margin > kSure;
    };
    return cases;
}

} // namespace tegument::test
