// hlsl/shadow against the definitions of docs/design/modules/TSM.md.

#include "tests/hlsl/maps.h"

#include <algorithm>
#include <cmath>

namespace tegument::test {

namespace {

constexpr double kTexel = 1.0 / kTestMapSize;
constexpr double kUvSlack = 3e-7; // a coordinate near 1, rounded a few times

Argument mapUv() {
    return linear(0.02, 0.98, 2, kUvSlack);
}

constexpr double kNoSurface = 1e9; // what a cleared texel, 0, stands for

double stored(double depth) {
    return depth <= 0 ? kNoSurface + depth : depth;
}

double depthAt(glm::dvec2 uv) {
    return stored(shadowMap().at(uv).x);
}

glm::dvec3 normalOfLitSide(glm::dvec2 uv, const glm::dvec3& axisX, const glm::dvec3& axisY, const glm::dvec3& toLight, double footprint,
                           double range, bool corrected) {
    const double dx = depthAt(uv + glm::dvec2(kTexel, 0)) - depthAt(uv - glm::dvec2(kTexel, 0));
    const double dy = depthAt(uv - glm::dvec2(0, kTexel)) - depthAt(uv + glm::dvec2(0, kTexel)); // up is towards smaller v
    const auto across = [&](const glm::dvec3& axis) {
        const glm::dvec3 back = glm::cross(axisX, axisY);
        return corrected ? axis - back * (glm::dot(toLight, axis) / std::max(glm::dot(toLight, back), 1e-3)) : axis;
    };
    const glm::dvec3 n = 2 * footprint * toLight + range * (dx * across(axisX) + dy * across(axisY));
    return n / std::max(glm::length(n), 1e-10);
}

struct Corner {
    int x, y;
    double fx, fy;

    explicit Corner(glm::dvec2 uv) {
        const glm::dvec2 place = uv * double{kTestMapSize} - 0.5;
        x = static_cast<int>(std::floor(place.x));
        y = static_cast<int>(std::floor(place.y));
        fx = place.x - x;
        fy = place.y - y;
    }
};

/// Interpolated where u, v and coverage of the four texels lie within 0.03, else the nearest.
glm::dvec4 entry(glm::dvec2 uv, const TestMap& map) {
    const Corner c(uv);
    glm::dvec4 four[2][2];
    glm::dvec4 low(1e30);
    glm::dvec4 high(-1e30);
    glm::dvec4 mean(0);
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            four[j][i] = map.texel(c.x + i, c.y + j);
            low = glm::min(low, four[j][i]);
            high = glm::max(high, four[j][i]);
            mean += (i == 0 ? 1 - c.fx : c.fx) * (j == 0 ? 1 - c.fy : c.fy) * four[j][i];
        }
    const glm::dvec4 spread = high - low;
    return std::max({spread.y, spread.z, spread.w}) < 0.03 ? mean : four[c.fy >= 0.5][c.fx >= 0.5];
}

/// Mean over 3 x 3 texels of bilinear comparisons; every texel is compared with the receiver's plane at its own place.
double filtered(glm::dvec2 uv, double depth, glm::dvec2 slope) {
    const Corner c(uv);
    const auto lit = [&](int dx, int dy) {
        const double plane = depth + slope.x * (dx - c.fx) + slope.y * (dy - c.fy);
        const int x = c.x + dx;
        const int y = c.y + dy;
        if (x < 0 || y < 0 || x >= kTestMapSize || y >= kTestMapSize) return 1.0;
        return plane <= stored(shadowMap().texel(c.x + dx, c.y + dy).x) ? 1.0 : 0.0;
    };
    double sum = 0;
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
            sum += (1 - c.fx) * (1 - c.fy) * lit(i, j) + c.fx * (1 - c.fy) * lit(i + 1, j) + (1 - c.fx) * c.fy * lit(i, j + 1) +
                   c.fx * c.fy * lit(i + 1, j + 1);
    return sum / 9;
}

/// Pieces of a surface side by side: of eight columns each, and rows, one is another by u, by v, or by what it covers.
const TestMap& piecesMap() {
    static const TestMap kMap = [] {
        TestMap map{.size = kTestMapSize};
        for (int y = 0; y < kTestMapSize; ++y)
            for (int x = 0; x < kTestMapSize; ++x)
                map.texels.push_back({600 + 0.25F * static_cast<float>(x % 16), x / 8 % 3 == 0 ? 0.2F : 0.3F, x / 8 % 3 == 1 ? 0.4F : 0.5F,
                                      y / 8 % 2 == 0 ? 1.0F : 0.5F});
        return map;
    }();
    return kMap;
}

std::vector<FunctionCase> arithmetic() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgShadowCoordinate",
                     .body = "return float4(tgShadowCoordinate(a0), 0, 0);",
                     .arguments = {vector(4, 1, 1000)},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec4 clip = x.vec4(0);
                             return values(0.5 + 0.5 * clip.x / clip.w, 0.5 - 0.5 * clip.y / clip.w);
                         },
                     .tolerance = {.forward = 4, .backward = 4, .absolute = 1e-7, .why = "a quotient of 2.5 ULP and a sum with 0.5"},
                     .domain = [](const Inputs& x) { return x.scalar(0, 3) > 1e-3; }});
    cases.push_back(
        {.function = "tgShadowDepth",
         .body = "return float4(tgShadowDepth(a0, a1), 0, 0, 0);",
         .arguments = {vector(4, 1, 1000), vector(3, 1e-3, 1e4)},
         .expected =
             [](const Inputs& x) {
                 if (x.scalar(0, 2) <= 0) return values(0);
                 return values(x.seed() ? x.scalar(0, 2) / x.scalar(0, 3) : glm::length(x.vec3(1)));
             },
         .tolerance = {.forward = 6, .backward = 1, .absolute = 1e-19, .why = "length or a quotient; squares of 1e-19 mm are denormal"},
         .settings = {0, 2},
         .domain = [](const Inputs& x) { return x.scalar(0, 3) > 1e-3; }});
    cases.push_back({.function = "tgShadowFootprint",
                     .body = "return float4(tgShadowFootprint(a0, a1), 0, 0, 0);",
                     .arguments = {logarithmic(1, 1e4), logarithmic(1e-3, 1e3)},
                     .expected = [](const Inputs& x) { return values(2 * x.scalar(0) * x.scalar(1) * kTexel); },
                     .tolerance = {.forward = 4, .backward = 1, .absolute = 1e-37, .why = "three products; denormal ones may be 0"}});
    cases.push_back({.function = "tgShadowSlope",
                     .body = "return float4(tgShadowSlope(a0, a1, a2, a3, a4), 0, 0);",
                     .arguments = {unit(), unit(), unit(), unit(), linear(0.01, 10)},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec3 n = x.vec3(0);
                             const double cosine = glm::dot(n, x.vec3(3));
                             if (!x.corrected() || cosine <= 0) return values(0);
                             const glm::dvec3 across = x.scalar(4) * (n / std::max(cosine, 0.15) - x.vec3(3));
                             return values(glm::dot(across, x.vec3(1)), -glm::dot(across, x.vec3(2)));
                         },
                     .tolerance = {.forward = 8, .backward = 4, .absolute = 2e-5, .why = "dot products of up to 70 that may cancel"},
                     .settings = {0, 2}});
    cases.push_back(
        {.function = "tgShadowSlope", // exact: two rays a texel apart, and where they meet the plane through the first one's end
         .body = "return float4(tgShadowSlope(a0, float3(1, 0, 0), float3(0, 1, 0), normalize(float3(a1, 1)), 1e-3 * a2), 0, 0);",
         .arguments = {unit(), linear(-1.5, 1.5, 2), linear(100, 700)},
         .expected =
             [](const Inputs& x) {
                 const glm::dvec3 ray = -glm::dvec3(x.vec2(1), 1); // the light looks along -z; w = a2, a texel is 1e-3 of it
                 const glm::dvec3 place = x.scalar(2) * ray;
                 const auto distance = [&](const glm::dvec2& texels) {
                     const glm::dvec3 next = ray + 1e-3 * glm::dvec3(texels.x, -texels.y, 0);
                     return glm::length(next) * glm::dot(x.vec3(0), place) / glm::dot(x.vec3(0), next);
                 };
                 const double step = 1e-4;
                 return values((distance({step, 0}) - distance({-step, 0})) / (2 * step),
                               (distance({0, step}) - distance({0, -step})) / (2 * step));
             },
         .tolerance = {.forward = 16, .backward = 4, .absolute = 1e-5, .why = "the difference of places 2e-4 texels apart"},
         .domain = [](const Inputs& x) { return glm::dot(x.vec3(0), glm::normalize(glm::dvec3(x.vec2(1), 1))) > 0.2; }});
    cases.push_back({.function = "tgShadowStored",
                     .body = "return tgShadowStored(a0);",
                     .arguments = {linear(-1, 1000, 4)},
                     .expected =
                         [](const Inputs& x) {
                             return values(stored(x.scalar(0)), stored(x.scalar(0, 1)), stored(x.scalar(0, 2)), stored(x.scalar(0, 3)));
                         },
                     .tolerance = {.forward = 1, .backward = 0, .why = "one sum"}});
    cases.push_back({.function = "tgShadowHorizon",
                     .body = "return float4(tgShadowHorizon(a0), 0, 0, 0);",
                     .arguments = {cosine()},
                     .expected = [](const Inputs& x) { return values(x.corrected() ? std::clamp(x.scalar(0) / 0.05, 0.0, 1.0) : 1); },
                     .tolerance = {.forward = 4, .backward = 0, .why = "a product with a rounded constant"},
                     .settings = {0, 2}});
    cases.push_back({.function = "tgShadowBeyond",
                     .body = "return float4(tgShadowBeyond(a0), 0, 0, 0);",
                     .arguments = {linear(-2, 3, 2)},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec2 beyond = x.vec2(0) - glm::clamp(x.vec2(0), 0.0, 1.0);
                             return values(glm::dot(beyond, beyond));
                         },
                     .tolerance = {.forward = 4, .backward = 2, .absolute = 1e-12, .why = "squares and a sum"}});
    cases.push_back({.function = "tgShadowOnMap",
                     .body = "return tgShadowOnMap(a0);",
                     .arguments = {whole(-9, kTestMapSize + 5)},
                     .expected =
                         [](const Inputs& x) {
                             const auto on = [&](int i) { return x.scalar(0) + i >= 0 && x.scalar(0) + i < kTestMapSize ? 1.0 : 0.0; };
                             return values(on(0), on(1), on(2), on(3));
                         },
                     .tolerance = {.forward = 0, .backward = 0, .why = "comparisons of whole numbers"}});
    cases.push_back({.function = "tgTsmAcross",
                     .body = "return float4(tgTsmAcross(a0, a1, a2), 0);",
                     .arguments = {unit(), unit(), unit()},
                     .expected =
                         [](const Inputs& x) {
                             if (!x.corrected()) return values(x.vec3(0));
                             return values(x.vec3(0) - x.vec3(1) * (glm::dot(x.vec3(2), x.vec3(0)) / glm::dot(x.vec3(2), x.vec3(1))));
                         },
                     .tolerance = {.forward = 8, .backward = 4, .absolute = 1e-5, .why = "a quotient of dot products, at most 10"},
                     .settings = {0, 2},
                     .domain = [](const Inputs& x) { return glm::dot(x.vec3(2), x.vec3(1)) > 0.1; }});
    return cases;
}

std::vector<FunctionCase> lookups() {
    std::vector<FunctionCase> cases;
    cases.push_back(
        {.function = "tgTsmNormal",
         .body = "return float4(tgTsmNormal(TG_SAMPLER2D_ARG(gTest), a0, a1, a2, a3, a4, a5), 0);",
         .arguments = {mapUv(), unit(), unit(), unit(), linear(0.01, 2), linear(0.5, 2)},
         .expected =
             [](const Inputs& x) {
                 return values(normalOfLitSide(x.vec2(0), x.vec3(1), x.vec3(2), x.vec3(3), x.scalar(4), x.scalar(5), x.corrected()));
             },
         .tolerance = {.forward = 8, .backward = 4, .absolute = 2e-6, .why = "sums of three vectors that may cancel, normalised"},
         .settings = {0, 2},
         .map = &shadowMap(),
         .domain = [](const Inputs& x) { // the unnormalised sum must not vanish: it does where axes are not axes
             for (std::size_t i : {1U, 2U, 3U})
                 if (glm::length(x.vec3(i)) < 0.5) return false;
             if (glm::dot(x.vec3(3), glm::cross(x.vec3(1), x.vec3(2))) < 0.1) return false;
             return glm::length(normalOfLitSide(x.vec2(0), x.vec3(1), x.vec3(2), x.vec3(3), x.scalar(4), x.scalar(5), x.corrected())) > 0.5;
         }});
    cases.push_back({.function = "tgTsmEntry",
                     .body = "return tgTsmEntry(TG_SAMPLER2D_ARG(gTest), a0);",
                     .arguments = {mapUv()},
                     .expected = [](const Inputs& x) { return values(entry(x.vec2(0), shadowMap())); },
                     .tolerance = {.forward = 8, .backward = 2, .absolute = 2e-7, .why = "three interpolations"},
                     .map = &shadowMap()});
    cases.push_back(cases.back()); // neighbours that differ by u alone, by v, or by their coverage
    cases.back().expected = [](const Inputs& x) { return values(entry(x.vec2(0), piecesMap())); };
    cases.back().map = &piecesMap();
    cases.push_back({.function = "tgShadowLit",
                     .body = "return float4(tgShadowLit(TG_SAMPLER2D_ARG(gTest), a0, a1), 0, 0, 0);",
                     .arguments = {mapUv(), linear(590, 610)},
                     .expected = [](const Inputs& x) { return values(x.scalar(1) <= depthAt(x.vec2(0)) ? 1 : 0); },
                     .tolerance = {.forward = 0, .backward = 0, .why = "a comparison of given numbers"},
                     .map = &shadowMap()});
    for (const char* function : {"tgShadowLit", "tgShadowFiltered", "tgTsmEntry"}) // beyond the map's border
        cases.push_back({.function = function,
                         .body = std::string("return ") +
                                 (function == std::string("tgTsmEntry") ? "tgTsmEntry(TG_SAMPLER2D_ARG(gTest), a0)"
                                  : function == std::string("tgShadowLit")
                                      ? "float4(tgShadowLit(TG_SAMPLER2D_ARG(gTest), a0, 1000.0), 0, 0, 0)"
                                      : "float4(tgShadowFiltered(TG_SAMPLER2D_ARG(gTest), a0, 1000.0, float2(0, 0)), 0, 0, 0)") +
                                 ";",
                         .arguments = {linear(-3, 4, 2)},
                         .expected = [entry = function == std::string("tgTsmEntry")](const Inputs&) { return values(entry ? 0 : 1); },
                         .tolerance = {.forward = 1, .backward = 0, .absolute = 1e-6, .why = "there is no map: lit, and no light entered"},
                         .map = &shadowMap(),
                         .domain =
                             [](const Inputs& x) {
                                 const glm::dvec2 beyond = glm::abs(x.vec2(0) - 0.5) - 0.5;
                                 return std::max(beyond.x, beyond.y) > 2 * kTexel;
                             }});
    cases.push_back({.function = "tgShadowFiltered", // partly on the map
                     .body = "return float4(tgShadowFiltered(TG_SAMPLER2D_ARG(gTest), a0, 640.0, float2(0, 0)), 0, 0, 0);",
                     .arguments = {linear(-2 * kTexel, 2 * kTexel, 2, kUvSlack)},
                     .expected = [](const Inputs& x) { return values(filtered(x.vec2(0), 640, glm::dvec2(0))); },
                     .tolerance = {.forward = 16, .backward = 2, .absolute = 1e-4, .why = "weights from a fraction of a texel"},
                     .map = &shadowMap()});
    cases.push_back({.function = "tgShadowFiltered",
                     .body = "return float4(tgShadowFiltered(TG_SAMPLER2D_ARG(gTest), a0, a1, a2), 0, 0, 0);",
                     .arguments = {mapUv(), linear(590, 610), linear(-2, 2, 2, 1e-6)},
                     .expected = [](const Inputs& x) { return values(filtered(x.vec2(0), x.scalar(1), x.vec2(2))); },
                     .tolerance = {.forward = 16,
                                   .backward = 2,
                                   .absolute = 1e-6,
                                   .why = "sixteen weights from a fraction of a texel that rounds at 3e-5"},
                     .map = &shadowMap()});
    cases.push_back({.function = "tgShadowTest",
                     .body = "return float4(tgShadowTest(TG_SAMPLER2D_ARG(gTest), a0, a1, a2, a3), 0, 0, 0);",
                     .arguments = {mapUv(), linear(590, 610), linear(0, 3), linear(-2, 2, 2, 1e-6)},
                     .expected =
                         [](const Inputs& x) {
                             const double depth = x.scalar(1) - x.scalar(2);
                             if (!x.corrected()) return values(depth <= depthAt(x.vec2(0)) ? 1 : 0);
                             const glm::dvec2 slope = x.vec2(3);
                             return values(filtered(x.vec2(0), depth - std::abs(slope.x) - std::abs(slope.y), slope));
                         },
                     .tolerance = {.forward = 16, .backward = 2, .absolute = 1e-6, .why = "as tgShadowFiltered"},
                     .settings = {0, 1, 2},
                     .map = &shadowMap()});
    return cases;
}

} // namespace

std::vector<FunctionCase> shadowCases() {
    std::vector<FunctionCase> cases = arithmetic();
    for (FunctionCase& lookup : lookups())
        cases.push_back(std::move(lookup));
    return cases;
}

} // namespace tegument::test
