// hlsl/light against the formulas of docs/design/light.md.

#include "lab/reference/specular.h"
#include "tests/hlsl/function_case.h"

#include <algorithm>

namespace tegument::test {

namespace {

/// Where the surface mirrors its mean over a hemisphere, weighed by the cosine.
double evenCosine(double m) {
    constexpr double kF0 = 0.04;
    constexpr int kSteps = 64;
    double mean = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double cosine = (i + 0.5) / kSteps;
        mean += 2 * cosine / kSteps * reference::directionalAlbedo(cosine, m, kF0);
    }
    double low = 0.2;
    double high = 0.9;
    for (int i = 0; i < 16; ++i) {
        const double middle = (low + high) / 2;
        (reference::directionalAlbedo(middle, m, kF0) > mean ? low : high) = middle;
    }
    return (low + high) / 2;
}

void surroundings(Cases& cases) {
    cases.add({"kTgEvenCosine", "return float4(kTgEvenCosine, 0, 0, 0);"}, {linear(0.1, 0.5)},
              {4, 2, 0.016, "one number for all m from .1 to .5"}, {.samples = 16}, [](In x) { return evenCosine(x[0]); });
    cases.add("tgSurroundingsLevel(a0)", {linear(0, 2)}, {4, 2, 0, "a quotient, and 0.15 rounded"},
              [](In x) { return min(x[0] / 0.15, 3.0); });
    cases.add("tgSurroundingsDirection(a0, a1)", {unit(), whole(0, 4)}, {8, 2, 1e-6, "exp2, a quotient and two products of about 1"},
              [](In x) {
                  // The face's own coordinate stays, the other two go to the centres of its outermost texels.
                  dvec3 d = x.vec3(0);
                  const dvec3 a = abs(d);
                  const double most = max({a.x, a.y, a.z});
                  const double side = 256 / exp2(x[1]);
                  for (int i = 0; i < 3; ++i)
                      if (a[i] < most) d[i] *= (side - 1) / side;
                  return d;
              });
    // Where two are the largest within rounding, either may be shrunk: both are the same edge of the cube.
    cases.back().domain = [](In x) {
        std::array<double, 3> a = {abs(x.scalar(0, 0)), abs(x.scalar(0, 1)), abs(x.scalar(0, 2))};
        std::ranges::sort(a);
        return a[2] - a[1] > 1e-5;
    };
    cases.add("tgSurroundingsTurned(a0, a1)", {unit(), linear(-1, 1, 2)}, {4, 2, 4e-7, "two products of at most 1, and their sum"},
              [](In x) {
                  const dvec3 d = x.vec3(0);
                  const dvec2 t = x.vec2(1);
                  return dvec3(d.x * t.y - d.z * t.x, d.y, d.x * t.x + d.z * t.y);
              });
    cases.add("tgSurroundingsNormal(a0, a1, a2)", {unit(), unit(), unit()},
              {8, 2, 2e-5, "sums of unit vectors, 6e-8 each, over a length of at least 0.02"},
              [](In x) { return normalize(x.vec3(0) + x.vec3(2) - x.vec3(1)); });
    cases.back().domain = [](In x) { return length(x.vec3(0) + x.vec3(2) - x.vec3(1)) > 0.02; };
    cases.add("tgSurroundingsReflectedShare(a0, a1, a2)", {cosine(), linear(0, 1), linear(0, 1)},
              {8, 4, 4e-6, "exp2 of up to 17: 37 ULP; pow of an exponent of at most 0.5; sums of about 1"}, [](In x) {
                  const double base = max(saturate(x[0]) + x[1], 1e-4);
                  return saturate(pow(base, exp2(-16 * x[2] - 1)) - 1 + x[1]);
              });
    cases.add("tgEnergyAlbedo(a0)", {linear(0, 4)}, {4, 2, 0, "one product, and pi rounded"}, {.settings = {0, 1, 2}},
              [](In x) { return x.corrected() ? x[0] : x[0] / 3.14159265358979; });
}

/// A smooth step, as HLSL's.
double smooth(double share) {
    const double s = saturate(share);
    return s * s * (3 - 2 * s);
}

/// Where the lamp (place, w) of arguments 0 and 2 looks at a sphere of 100 about argument 1 from, and its way there.
struct Eye {
    dvec3 eye{0};
    dvec3 axis{0};
};
Eye lampEye(In x) {
    if (x[2] > 0.5) return {x.vec3(0), normalize(x.vec3(1) - x.vec3(0))};
    return {x.vec3(1) + 200.0 * normalize(x.vec3(0)), -normalize(x.vec3(0))};
}

void lamps(Cases& cases) {
    cases.add("tgLampVector(float4(a0, a2), a1)", {linear(-1000, 1000, 3), linear(-1000, 1000, 3), whole(0, 1)},
              {4, 2, 0, "one difference"}, [](In x) { return x[2] > 0.5 ? x.vec3(0) - x.vec3(1) : x.vec3(0); });
    cases.add("tgLampFalloff(a0, a1)", {logarithmic(1e-2, 1e4), linear(0, 1000)}, {8, 2, 0, "a quotient of 2.5 ULP, squared"},
              [](In x) { return x[1] > 0 ? pow(x[1] / max(x[0], 1e-6), 2) : 1; });
    cases.add("tgLampSpot(a0, a1, a2, a3)", {unit(), unit(), linear(0.5, 1), linear(-2, 0.4)},
              {8, 2, 8e-6, "a cosine of 3e-7 over a range of at least 0.1, and a slope of 1.5"}, [](In x) {
                  const double cosine = -dot(x.vec3(0), x.vec3(1));
                  return smooth((cosine - x[3]) / max(x[2] - x[3], 1e-4));
              });
    cases.add("tgLampAxis(float4(a0, a2), a1)", {linear(-1000, 1000, 3), linear(-100, 100, 3), whole(0, 1)},
              {8, 2, 1e-5, "a difference of 1000, 6e-5 off, of at least 50 in length"}, [](In x) { return lampEye(x).axis; });
    cases.back().domain = [](In x) { return length(x.vec3(0) - x[2] * x.vec3(1)) > 50; };
    cases.add("tgLampDepth(tgLampView(float4(a0, a2), a1, 100, float3(0, 1, 0), float3(1, 0, 0)), a3)",
              {linear(-1000, 1000, 3), linear(-100, 100, 3), whole(0, 1), linear(-200, 200, 3)},
              {8, 2, 0.02, "an axis of 1e-5 times a way of up to 2000"},
              [](In x) { return dot(x.vec3(3) - lampEye(x).eye, lampEye(x).axis); });
    cases.back().domain = [](In x) { return length(x.vec3(0) - x[2] * x.vec3(1)) > 50; };
    // A sphere fits into the view: places on its outline as seen from the lamp lie on the circle that touches the view's sides, and the
    // planes touch it.
    cases.add({"tgLampView", "TgLampView v = tgLampView(float4(a0, a1), float3(10, 20, 30), 100, float3(0, 1, 0), float3(1, 0, 0)); return "
                             "float4(v.spread, v.near, v.far, dot(v.right, v.axis) + dot(v.up, v.right));"},
              {linear(-1000, 1000, 3), whole(0, 1)}, {16, 2, 1e-3, "differences of 1000 and their lengths: 1e-4"}, [](In x) {
                  if (x[1] < 0.5) return dvec4(100, 100, 300, 0);
                  const double away = length(x.vec3(0) - dvec3(10, 20, 30));
                  const double half = away > 100 ? asin(100 / away) : acos(0.0);
                  return dvec4(min(tan(min(half, 1.57)), 2.0), max(away - 100, 2.0), away + 100, 0);
              });
    cases.back().domain = [](In x) { return length(x.vec3(0) - dvec3(10, 20, 30)) > 20; };
    cases.add({"tgLampClip", "float4 c = tgLampClip(tgLampView(float4(a0, a2), a1, 100, float3(0, 1, 0), float3(1, 0, 0)), a3); return "
                             "float4(dot(c.xy, c.xy) / (c.w * c.w), c.z / c.w, c.w, 0);"},
              {linear(-1000, 1000, 3), linear(-100, 100, 3), whole(0, 1), linear(-200, 200, 3)},
              {64, 2, 4e-3, "as above, over a depth of at least 100"}, [](In x) {
                  const Eye eye = lampEye(x);
                  const dvec3 from = x.vec3(3) - eye.eye;
                  const double depth = dot(from, eye.axis);
                  const double away = x[2] > 0.5 ? length(x.vec3(0) - x.vec3(1)) : 200;
                  const double w = x[2] > 0.5 ? depth : 1;
                  const double spread = x[2] > 0.5 ? 100 / sqrt(away * away - 1e4) : 100;
                  const double across = length(from - depth * eye.axis) / (spread * w);
                  const double near = away - 100;
                  const double far = away + 100;
                  const double z = x[2] > 0.5 ? far / (far - near) * (1 - near / depth) : (depth - near) / (far - near);
                  return values(across * across, z, w);
              });
    cases.back().domain = [](In x) {
        const Eye eye = lampEye(x);
        const bool apart = x[2] < 0.5 || length(x.vec3(0) - x.vec3(1)) > 150;
        return length(x.vec3(0)) > 50 && apart && dot(x.vec3(3) - eye.eye, eye.axis) > 100;
    };
}

} // namespace

Cases lightCases() {
    return together(surroundings, lamps);
}

} // namespace tegument::test
