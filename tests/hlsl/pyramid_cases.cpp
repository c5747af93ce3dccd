// Pyramid and ladder, the metric of texels, and planar shadows against double precision: the best weights by going through all sets of
// steps, eigenvalues of the first fundamental form, rays that meet planes.

#include "host/scene/presets.h"
#include "tests/hlsl/function_case.h"
#include "tests/hlsl/maps.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tegument::test {

namespace {

constexpr double kPresent = 1.0 / 12 + 1.0 / 6; // texels^2
constexpr double kApart = 1.3;
constexpr double kPixel = 0.0064; // mm^2
constexpr double kTexel = 1.0 / kTestMapSize;

double levelVariance(double level) {
    return (pow(4.0, level) - 1) / 2 + kPresent;
}

/// Weights (RGB) and variances of the skins among the presets, and of 2007, as HLSL has them.
std::vector<std::string> skins() {
    std::vector<std::string> all = {
        "{{.233,.455,.649,.0064},{.1,.336,.344,.0484},{.118,.198,0,.187},{.113,.007,.007,.567},{.358,.004,0,1.99},{.078,0,0,7.41}}"};
    const auto presets = loadPresets("effects/Pyramid.fx");
    for (const Preset& preset : *presets) {
        const auto weights = preset.parameters.find("gGaussianWeight");
        if (weights == preset.parameters.end()) continue;
        std::string rows;
        for (std::size_t i = 0; i < 24; i += 4)
            rows += fmt::format("{}{{{}}}", i > 0 ? "," : "", fmt::join(std::span(weights->second).subspan(i, 4), ","));
        all.push_back("{" + rows + "}");
    }
    return all;
}

/// The steps on the ladder.
std::vector<double> ladder(double density, int top) {
    std::vector<double> variances = {kPixel};
    for (int level = 0; level <= top; ++level)
        if (levelVariance(level) / density > kApart * kPixel) variances.push_back(levelVariance(level) / density);
    return variances;
}

/// The unknowns of a system of equations, each row with its right side (Gauss, Jordan).
std::vector<double> solved(std::vector<std::vector<double>> rows) {
    const std::size_t n = rows.size();
    for (std::size_t i = 0; i < n; ++i) {
        std::swap(rows[i], *std::max_element(rows.begin() + static_cast<std::ptrdiff_t>(i), rows.end(),
                                             [&](const auto& a, const auto& b) { return abs(a[i]) < abs(b[i]); }));
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t k = n + 1; j != i && k-- > i;)
                rows[j][k] -= rows[i][k] * (rows[j][i] / rows[i][i]);
    }
    std::vector<double> unknowns;
    for (std::size_t i = 0; i < n; ++i)
        unknowns.push_back(rows[i][n] / rows[i][i]);
    return unknowns;
}

/// Share of a point's light that goes farther than `radius` mm, of one Gaussian of this variance by the best weights that are not below 0:
/// of all sets of steps those whose weights, found with no bound, are none, and that come nearest at an edge.
double beyond(double variance, double density, double radius) {
    const auto steps = ladder(density, 6);
    double least = 1e9;
    double share = 0;
    for (unsigned set = 1; set < 1U << steps.size(); ++set) {
        std::vector<double> v;
        for (std::size_t i = 0; i < steps.size(); ++i)
            if ((set >> i & 1U) != 0) v.push_back(steps[i]);
        std::vector<std::vector<double>> rows(v.size() + 1, std::vector<double>(v.size() + 2, 1));
        for (std::size_t i = 0; i < v.size(); ++i) {
            for (std::size_t j = 0; j < v.size(); ++j)
                rows[i][j] = sqrt(v[i] + v[j]);
            rows[i].back() = sqrt(v[i] + variance);
        }
        rows.back()[v.size()] = 0;
        const auto w = solved(rows);
        double off = -sqrt(2 * variance);
        double far = 0;
        for (std::size_t i = 0; i < v.size(); ++i) {
            off += w[i] * (2 * sqrt(v[i] + variance));
            for (std::size_t j = 0; j < v.size(); ++j)
                off -= w[i] * w[j] * sqrt(v[i] + v[j]);
            far += w[i] * exp(-radius * radius / (2 * v[i]));
        }
        if (off < least && *std::min_element(w.begin(), w.end() - 1) >= 0) {
            least = off;
            share = far;
        }
    }
    return share;
}

/// Whether rounding may choose other steps.
bool undecided(double density) {
    for (int level = 0; level <= 6; ++level)
        if (abs(levelVariance(level) / (kApart * kPixel * density) - 1) < 1e-4) return true;
    return false;
}

/// Of the first two arguments.
dvec2 texelOf(In x) {
    return {x[0], x[1]};
}

double stored(double depth) {
    return depth > 0 ? depth : 1e9;
}

Cases ladderCases() {
    Cases cases;
    cases.add({"tgLadderVariance", "return tgLadderVariance(a0);"}, {whole(0, 8)}, {8, 0, 0, "a power of two and two sums"}, [](In x) {
        const double v = levelVariance(x[0]);
        return values(v, v, v, v);
    });
    cases.add({"tgLadderStep", "return float4(tgLadderStep(a0, a1, 6.0), tgLadderStep(a0, a1, 2.0), 0, 0);"},
              {whole(0, 7), linear(0.1, 2000)}, {8, 2, 0, "a power of two, two sums and a quotient"}, [](In x) {
                  const double level = levelVariance(x[0] - 1) / x[1];
                  const double on = x[0] < 0.5 ? kPixel : level > kApart * kPixel ? level : 0;
                  return values(on, x[0] > 3.5 ? 0 : on);
              });
    cases.back().domain = [](In x) { return !undecided(x[1]); };
    cases.add("tgLadderAt(4.0 * a0, a1)", {whole(0, 1), whole(0, 7)}, {0, 0, 0, "whole numbers"}, [](In x) {
        Values at = {};
        for (int i = 0; i < 4; ++i)
            at[static_cast<std::size_t>(i)] = 4 * x[0] + i == x[1] ? 1 : 0;
        return at;
    });
    // one Gaussian: what goes farther than a2 mm
    cases.add({"tgLadderWeight", "float4 p[6] = {{1,1,1,a0},{0,0,0,1},{0,0,0,1},{0,0,0,1},{0,0,0,1},{0,0,0,1}}; float far = 0; for (float "
                                 "s = 0; s < 8; s++) { float v = tgLadderStep(s, a1, 6.0); if (v > 0) far += tgLadderWeight(p, s, a1, "
                                 "6.0).x * exp(-a2 * a2 / (2 * v)); } return float4(far, 0, 0, 0);"},
              {linear(0.01, 8), linear(0.1, 25), linear(0.05, 4)}, {4, 2, 0.01, "32 rounds are within as much of the limit"},
              {.samples = 64}, [](In x) { return beyond(x[0], x[1], x[2]); });
    cases.back().domain = [](In x) { return !undecided(x[1]); };
    for (const std::string& skin : skins())
        // at a0 texels per mm: all of the light, nowhere less than none, in the profile's order of colours
        cases.add(
            {"tgLadderWeight",
             "float4 p[6] = " + skin +
                 "; float4 off = 0; float3 all = 0; float3 far = 0; float3 meant = 0; float3 kernel = 0; "
                 "for (int i = 0; i < 6; i++) { off.rgb -= p[i].rgb; all += p[i].rgb; meant += p[i].rgb * exp(-a1 * a1 / (2 * p[i].w)); } "
                 "for (float s = 0; s < 8; s++) { float v = tgLadderStep(s, a0 * a0, 6.0); float3 w = tgLadderWeight(p, s, a0 * a0, 6.0); "
                 "off.rgb += w; off.w = min(off.w, min(w.r, min(w.g, w.b))); if (v > 0) { far += w * exp(-a1 * a1 / (2 * v)); "
                 "kernel += w * exp(-a1 * a1 / (2 * v)) / v; } } "
                 "far /= all; meant /= all; off.w = min(off.w, min(kernel.r, min(kernel.g, kernel.b))); "
                 "if (meant.r >= meant.g) off.w = min(off.w, far.r - far.g + 0.001); "
                 "if (meant.g >= meant.b) off.w = min(off.w, far.g - far.b + 0.001); return off;"},
            {linear(0.3, 5), linear(0.01, 12)}, {4, 2, 1e-5, "sums of the profile, in which no energy is lost"}, {.samples = 128},
            [](In) { return 0; });
    cases.add("tgLadderCoordinate(a0, a1)", {whole(0, 31), linear(0.02, 10000)},
              {8, 2, 1e-6, "a logarithm, whose error is absolute near 1"},
              [](In x) { return values((log2(x[1]) + 6) * 8 / 160, (x[0] + 0.5) / 64); });
    cases.add("tgLadderDensity(a0)", {linear(0, 1)}, {40, 8, 0, "exp2 of up to 14: 3 + 2 |x| ULP in Vulkan"},
              [](In x) { return exp2(20 * x[0] - 6); });
    return cases;
}

/// 1 2 1 along a direction: so far aside that the variance of a texel of this level comes to be what it is across.
FunctionCase roundAlong() {
    constexpr double kLevel = 1;
    static const double kAside = sqrt(2 * (0.5 * (exp2(2 * kLevel) - 1) + 0.25) / exp2(2 * kLevel)); // texels
    const auto taps = [](In x) {
        const dvec2 uv = (texelOf(x) + 0.5) * kTexel;
        const dvec2 aside = kAside * x.vec2(2) * kTexel;
        return 0.5 * irradianceMap().at(uv) + 0.25 * (irradianceMap().at(uv + aside) + irradianceMap().at(uv - aside));
    };
    FunctionCase made = check("tgPyramidRound(TG_SAMPLER2D_ARG(gTest), (float2(a0, a1) + 0.5) / 256.0, 256.0, 1.0, a2)",
                              {whole(0, kTestMapSize - 1), whole(0, kTestMapSize - 1), linear(-3, 3, 2)},
                              {16, 0, 1e-6, "a sum of three, a quotient"}, {.map = &irradianceMap()}, [=](In x) {
                                  const dvec4 sum = taps(x);
                                  return dvec4(dvec3(sum) / sum.w, sum.w);
                              });
    made.domain = [=](In x) {
        const dvec2 place = fract(0.5 + kAside * x.vec2(2)); // in a texel, away from its borders on either side
        return taps(x).w > 0.1 && min({place.x, place.y, 1 - place.x, 1 - place.y}) > 1e-3;
    };
    return made;
}

Cases mapCases() {
    Cases cases;
    // texels that lie along both directions: denser along U, or along V
    cases.add({"tgMetric", "return float4(abs(tgMetric(float3(a0, 0, 0), float3(0, a1, 0))), 0);"}, {linear(0.1, 0.5), linear(0.1, 0.5)},
              {64, 16, 2e-3, "as below"}, [](In x) {
                  const double u = x[0] * x[0];
                  const double v = x[1] * x[1];
                  const double dense = sqrt(min(max(u, v) / min(u, v), 9.0) - 1);
                  return values(u < v ? dense : 0, u < v ? 0 : dense, 1 / max(u, v));
              });
    cases.back().domain = [](In x) {
        const double u = x[0] * x[0];
        const double v = x[1] * x[1];
        return min(u, v) > 1e-3 && abs(u - v) > 0.01 * (u + v);
    };
    cases.add({"tgMetric", "float3 m = tgMetric(a0, a1); return float4(m.x * m.x, m.x * m.y, m.y * m.y, m.z);"},
              {linear(-0.5, 0.5, 3), linear(-0.5, 0.5, 3)}, {64, 16, 2e-3, "eigenvectors of a form that is nearly round"}, [](In x) {
                  const double e = dot(x.vec3(0), x.vec3(0));
                  const double f = dot(x.vec3(0), x.vec3(1));
                  const double g = dot(x.vec3(1), x.vec3(1));
                  const double root = sqrt((e - g) * (e - g) / 4 + f * f);
                  const double large = (e + g) / 2 + root;
                  const double small = max((e + g) / 2 - root, large / 9);
                  const double turn = atan2(2 * f, e - g) / 2 + 1.5707963267948966; // of the smaller eigenvalue
                  const dvec2 d = sqrt(large / small - 1) * dvec2(cos(turn), sin(turn));
                  return values(d.x * d.x, d.x * d.y, d.y * d.y, 1 / large);
              });
    cases.back().domain = [](In x) {
        const double e = dot(x.vec3(0), x.vec3(0));
        const double f = dot(x.vec3(0), x.vec3(1));
        const double g = dot(x.vec3(1), x.vec3(1));
        return hypot(e - g, 2 * f) > 0.05 * (e + g) && e + g > 0.01;
    };
    // From the middle of a texel of half as many: 1 3 3 1 of four texels along each side.
    cases.add("tgPyramidReduce(TG_SAMPLER2D_ARG(gTest), float2(a0, a1) / 256.0, 256.0)",
              {whole(2, kTestMapSize - 2), whole(2, kTestMapSize - 2)}, {8, 0, 4e-3, "weights of a linear filter, of 8 bits"},
              {.map = &irradianceMap(), .filtered = true}, [](In x) {
                  constexpr std::array kWeights = {1.0, 3.0, 3.0, 1.0};
                  dvec4 sum(0);
                  for (int j = 0; j < 4; ++j)
                      for (int i = 0; i < 4; ++i)
                          sum += kWeights[static_cast<std::size_t>(i)] * kWeights[static_cast<std::size_t>(j)] *
                                 irradianceMap().at((texelOf(x) - 1.5 + dvec2(i, j)) * kTexel);
                  return sum / 64.0;
              });
    cases.add("tgPyramidAround(TG_SAMPLER2D_ARG(gTest), (float2(a0, a1) + 0.5) / 256.0, 256.0)",
              {whole(0, kTestMapSize - 1), whole(0, kTestMapSize - 1)}, {8, 0, 1e-6, "a sum of eight"}, {.map = &irradianceMap()},
              [](In x) {
                  dvec4 sum(0);
                  for (int j = -1; j <= 1; ++j)
                      for (int i = -1; i <= 1; ++i)
                          if (i != 0 || j != 0) sum += irradianceMap().at((texelOf(x) + 0.5 + dvec2(i, j)) * kTexel);
                  return sum;
              });
    cases.add("tgPyramidRound(TG_SAMPLER2D_ARG(gTest), (float2(a0, a1) + 0.5) / 256.0, 256.0, 1.0, float2(0, 0))",
              {whole(0, kTestMapSize - 1), whole(0, kTestMapSize - 1)}, {16, 0, 1e-6, "a sum of eight at most, a quotient"},
              {.map = &irradianceMap()}, [](In x) {
                  const dvec2 uv = (texelOf(x) + 0.5) * kTexel;
                  dvec4 sum = irradianceMap().at(uv);
                  double covered = sum.w;
                  if (sum.w < 1e-3) {
                      sum = dvec4(0);
                      for (int j = -1; j <= 1; ++j)
                          for (int i = -1; i <= 1; ++i)
                              if (i != 0 || j != 0) sum += irradianceMap().at(uv + dvec2(i, j) * kTexel);
                      covered = sum.w / 8;
                  }
                  return dvec4(sum.w > 1e-6 ? dvec3(sum) / sum.w : dvec3(0), covered);
              });
    cases += roundAlong();
    return cases;
}

/// Of the texel number i, -1 to 2, where the look-up is f behind the middle of texel 0.
double nearestWeight(int i, double f) {
    return (i == -1 ? 1 - f : i == 2 ? f : 1) / 3;
}

/// Of the plane with this normal under a light that looks down: to the next tap of a turned square, mm.
dvec3 tapWay(const dvec3& normal, double apart, bool down) {
    const dvec3 side = normalize(dvec3(1, 0, 0) - normal * normal.x);
    const dvec3 other = cross(normal, side);
    const double c = 4 / sqrt(17.0);
    const double s = 1 / sqrt(17.0);
    return apart * (down ? c * other - s * side : c * side + s * other);
}

void shadowTaps(Cases& cases) {
    const std::string onPlane =
        "TgShadowTaps t = tgShadowTapsOnPlane(a3, a0, float3(1, 0, 0), float3(0, 1, 0), float3(0, 0, -1), a2, a1); ";
    const Arguments plane = {unit(), linear(0.05, 1), linear(0.1, 2), linear(-3, 3, 2)};
    const auto turned = [](In x) { return isUnit(x.vec3(0)) && abs(x[0]) < 0.98; };
    cases.add({"tgShadowTapsOnPlane", onPlane + "return float4(t.alongU, t.alongV);"}, plane,
              {64, 8, 1e-5, "unit vectors, from 0.2 of one"}, [](In x) {
                  const dvec3 u = tapWay(x.vec3(0), x[1], false) / x[2];
                  const dvec3 v = tapWay(x.vec3(0), x[1], true) / x[2];
                  return values(u.x, -u.y, v.x, -v.y);
              });
    cases.back().domain = turned;
    cases.add({"tgShadowTapsOnPlane", onPlane + "return float4(t.beside, t.columns.x + t.rows.w, t.steep);"}, plane,
              {64, 8, 1e-4, "a difference of products of up to 60"}, [](In x) {
                  const auto beside = [&](bool down) {
                      const dvec3 way = tapWay(x.vec3(0), x[1], down);
                      return -way.z - dot(x.vec2(3), dvec2(way.x, -way.y)) / x[2];
                  };
                  return values(beside(false), beside(true), 0.5, 1);
              });
    cases.back().domain = turned;
    cases.add({"tgShadowTapsOfTexels", "TgShadowTaps t = tgShadowTapsOfTexels(a0); return float4(t.columns.x - t.columns.z, t.columns.w, "
                                       "t.rows.x - t.rows.y, t.rows.w) + dot(t.beside, 1.0) + float4(t.alongU, t.alongV) * t.steep;"},
              {linear(0, 1, 2)}, {4, 4, 1e-5, "the share of a texel keeps 1.5e-5"}, [](In x) {
                  const dvec2 f = fract(x.vec2(0) * double{kTestMapSize} - 0.5);
                  return values(3 - f.x / 3, f.x / 3, -f.y / 3, 3 + f.y / 3);
              });
    cases.back().domain = [](In x) {
        const dvec2 f = fract(x.vec2(0) * double{kTestMapSize} - 0.5);
        return glm::all(glm::lessThan(abs(f - 0.5), dvec2(0.499)));
    };
    cases.add({"tgShadowTapped", "TgShadowTaps t; t.alongU = float2(1.3, 0.4); t.alongV = float2(-0.4, 1.3); t.beside = float2(3, -2); "
                                 "t.columns = float4(0.1, 0.2, 0.3, 0.4); t.rows = float4(0.4, 0.3, 0.2, 0.1); t.steep = 2.0; return "
                                 "float4(tgShadowTapped(TG_SAMPLER2D_ARG(gTest), a0, a1, a2, t), 0, 0, 0);"},
              {linear(0.1, 0.9, 2), linear(400, 700), linear(-30, 30, 2)},
              {4, 16, 0.33, "a tap on the border of a texel may see either, twice its .16"}, {.map = &shadowMap()}, [](In x) {
                  double sum = 0;
                  for (int j = 0; j < 4; ++j)
                      for (int i = 0; i < 4; ++i) {
                          const dvec2 texel = x.vec2(0) * double{kTestMapSize} + (i - 1.5) * dvec2(1.3, 0.4) + (j - 1.5) * dvec2(-0.4, 1.3);
                          const double depth =
                              x[1] + 3 * (i - 1.5) - 2 * (j - 1.5) + dot(x.vec2(2), floor(texel) + 0.5 - x.vec2(0) * double{kTestMapSize});
                          if (depth <= stored(shadowMap().at(texel / double{kTestMapSize}).x)) sum += 0.1 * (i + 1) * 0.1 * (4 - j);
                      }
                  return saturate(2 * (sum - 0.5) + 0.5);
              });
}

void shadowCasesOfPlanes(Cases& cases) {
    cases.add("tgShadowPlanarDepth(float4(0, 0, a0, 1), a1, a2)", {linear(-1, 1), linear(-500, 500, 3), unit()},
              {4, 2, 2e-4, "a sum of three products of up to 500 that may cancel"},
              [](In x) { return x[0] > 0 ? -dot(x.vec3(1), x.vec3(2)) : 0; });
    cases.add({"tgShadowPlanarSlope", "float3 axis = cross(float3(1, 0, 0), float3(0, 1, 0)); return float4(tgShadowPlanarSlope(a0, "
                                      "float3(1, 0, 0), float3(0, 1, 0), normalize(float3(a1, 1)), -axis, a2), 0, 0);"},
              {unit(), linear(-0.4, 0.4, 2), linear(0.01, 1)}, {16, 4, 1e-3, "the reference takes a difference quotient"}, [](In x) {
                  // The light looks along -z from 500 mm over the point; rays through neighbouring texels meet the point's
                  // plane.
                  const dvec3 normal = x.vec3(0);
                  const double far = 500;
                  const dvec3 ray = dvec3(-x.vec2(1), -1); // to the point, per mm of depth
                  const double facing = -dot(normal, ray);
                  if (facing <= 0) return values(0);
                  const double plane = dot(normal, far * ray);
                  const double step = 1e-6 * x[2] / far;
                  const auto depth = [&](double u, double v) {
                      const dvec3 other = ray + dvec3(u, -v, 0);
                      const double towards = min(dot(normal, other), -0.15);
                      return plane / towards;
                  };
                  const double here = plane / dot(normal, ray);
                  return values((depth(step, 0) - here) * 1e6, (depth(0, step) - here) * 1e6);
              });
    cases.back().domain = [](In x) { return -dot(x.vec3(0), dvec3(-x.vec2(1), -1)) > 0.2; };
    cases.add("tgShadowPlanarAside(a0, normalize(float3(a1, 1)), float3(0, 0, -1), a2, a3)",
              {unit(), linear(-0.4, 0.4, 2), linear(-3, 3, 2), linear(0.5, 1)}, {16, 4, 1e-5, "N.L is a sum that may cancel, times 13"},
              [](In x) {
                  // None where the plane is followed, from N.L of .15 on, and all of it from half of that on.
                  const double facing = dot(x.vec3(0), dvec3(x.vec2(1), 1));
                  const double share = saturate((0.15 - facing) / 0.075);
                  const dvec2 aside = normalize(x.vec2(2)) * (share * x[3]);
                  return values(aside.x, aside.y);
              });
    cases.back().domain = [](In x) { return length(x.vec2(2)) > 1e-3; };
    cases.add("tgShadowPlanarHorizon(a0)", {linear(-1, 1)}, {4, 0, 0, "a quotient"}, [](In x) { return saturate(x[0] / 0.01); });
    cases.add("tgShadowSharp(TG_SAMPLER2D_ARG(gTest), a0, a1, a2)", {linear(-0.1, 1.1, 2), linear(400, 700), linear(-2, 2, 2)},
              {4, 4, 2e-4, "the share of a texel keeps 1.2e-7 of 256; drawn three times as steep"}, {.map = &shadowMap()}, [](In x) {
                  const dvec2 beyond = x.vec2(0) - clamp(x.vec2(0), 0.0, 1.0);
                  if (beyond != dvec2(0)) return 1.0;
                  const dvec2 place = x.vec2(0) * double{kTestMapSize} - 0.5;
                  const dvec2 f = fract(place);
                  double sum = 0; // a box of three texels over one of one
                  for (int j = -1; j < 3; ++j)
                      for (int i = -1; i < 3; ++i) {
                          const double plane = x[1] + x[2] * (i - f.x) + x.scalar(2, 1) * (j - f.y);
                          const auto corner = glm::ivec2(floor(place));
                          if (plane <= stored(shadowMap().texel(corner.x + i, corner.y + j).x))
                              sum += nearestWeight(i, f.x) * nearestWeight(j, f.y);
                      }
                  return saturate(3 * (sum - 0.5) + 0.5);
              });
    // beyond the map's border
    cases.add("tgShadowOnPlane(TG_SAMPLER2D_ARG(gTest), a0, 1000.0, float2(0, 0), float3(0, 0, 1), float3(1, 0, 0), float3(0, 1, 0), "
              "float3(0, 0, -1), 0.2, 0.1)",
              {linear(1.1, 4, 2)}, {0, 0, 0, "there is no map: lit"}, {.map = &shadowMap()}, [](In) { return 1; });
    cases.back().domain = [](In x) { return min(x[0], x.scalar(0, 1)) > 1.05; };
    cases.add("tgShadowOnPlane(TG_SAMPLER2D_ARG(gTest), a0, a1, a2, float3(0, 0, 1), float3(1, 0, 0), float3(0, 1, 0), float3(0, 0, -1), "
              "0.2, 0.1)",
              {linear(0.1, 0.9, 2), linear(400, 700), linear(-30, 30, 2)}, {4, 16, 0.07, "a tap on the border of a texel may see either"},
              {.map = &shadowMap()}, [](In x) {
                  const dvec3 side(1, 0, 0);
                  const dvec3 other = cross(dvec3(0, 0, 1), side);
                  double sum = 0;
                  for (int j = 0; j < 4; ++j)
                      for (int i = 0; i < 4; ++i) {
                          const double a = 0.1 * (i - 1.5);
                          const double b = 0.1 * (j - 1.5);
                          const double c = 0.9701425;
                          const double s = 0.2425356;
                          const dvec3 tap = a * (c * side + s * other) + b * (c * other - s * side);
                          const dvec2 uv = x.vec2(0) + dvec2(tap.x, -tap.y) / (0.2 * kTestMapSize);
                          const dvec2 texel = uv * double{kTestMapSize};
                          const double plane = x[1] + dot(x.vec2(2), floor(texel) + 0.5 - texel);
                          sum += plane <= stored(shadowMap().at(uv).x) ? 1.0 / 16 : 0;
                      }
                  return sum;
              });
}

} // namespace

Cases pyramidCases() {
    return together(ladderCases(), mapCases(), shadowTaps, shadowCasesOfPlanes);
}

} // namespace tegument::test
