// hlsl/peers/burley.fxh: Burley's disc on the pixels of a picture. References: docs/design/peers.md, lab/reference/peers.h.

#include "lab/reference/peers.h"
#include "tests/hlsl/peer_cases.h"

#include <algorithm>

namespace tegument::test {

namespace {

dvec2 middleOf(const dvec2& uv, const dvec2& viewport) {
    return (floor(uv * viewport) + 0.5) / viewport;
}

dvec3 weight(double apart, double radius, const dvec3& d, double widest, bool corrected) {
    dvec3 result;
    for (int c = 0; c < 3; ++c)
        result[c] = reference::burleyProfile(apart, d[c]) / reference::burleyProfile(radius, widest);
    return corrected ? result : result * (apart / radius); // what the published weight leaves out
}

/// Radii of the taps for a profile of 1 mm.
const std::vector<double>& unitRadii(int count) {
    static std::map<int, std::vector<double>> made;
    std::vector<double>& radii = made[count];
    for (int i = static_cast<int>(radii.size()); i < count; ++i)
        radii.push_back(reference::burleyRadius((i + 0.5) / count, 1));
    return radii;
}

/// A map with holes where no depth is, but light, as a picture has beside a body.
const TestMap& holesMap() {
    static const TestMap kMap = [] {
        TestMap map = halvesMap();
        for (auto& texel : map.texels)
            if (texel[0] <= 0) texel = {0, 300, 0.4F, 1};
        return map;
    }();
    return kMap;
}

/// Place of a tap in the picture, in pixels.
dvec2 tapAt(const dvec3& here, const dvec3& u, const dvec3& v, double radius, double angle) {
    return viewUv(here + radius * (cos(angle) * u + sin(angle) * v), kFrustum) * double{kTestMapSize};
}

/// The disc in the tangent plane or facing the eye, tap after tap.
Values gathered(In x, int count, const TestMap& map, double turn) {
    const dvec2 uv = x.vec2(0);
    const dvec2 viewport(kTestMapSize);
    const double z = map.at(uv).x;
    if (z <= 0) return values(0);
    const dvec3 u = normalize(x.vec3(1));
    const dvec3 v = normalize(cross(normalize(x.vec3(2)), u));
    const dvec3 normal = cross(u, v);
    const dvec3 here = viewPlace(uv, z, kFrustum);
    const dvec3 d = x.vec3(3);
    const double widest = max({d.x, d.y, d.z});
    dvec3 sum(0);
    dvec3 total(0);
    for (int i = 0; i < count; ++i) {
        const double radius = widest * unitRadii(count)[static_cast<std::size_t>(i)];
        const double angle = kGoldenAngle * i + 2 * kPeerPi * turn;
        const dvec3 at = here + radius * (cos(angle) * u + sin(angle) * v);
        const dvec2 pixel = middleOf(viewUv(at, kFrustum), viewport);
        const dvec4 tap = map.at(pixel);
        if (tap.x <= 0) continue;
        const dvec3 way = viewPlace(pixel, tap.x, kFrustum) - here;
        const double departure = x.corrected() ? dot(way, normal) : way.z;
        const dvec3 w = weight(hypot(radius, departure), radius, d, widest, x.corrected());
        sum += w * dvec3(tap);
        total += w * tap.w;
    }
    const dvec3 light = total.z > 1e-6 ? sum / total : dvec3(map.at(uv));
    return values(kScale * dvec4(light, 1));
}

/// Of few taps and near, so that none lies on the border of two pixels: turned from pixel to pixel, beside holes.
FunctionCase turnedDisc(const FunctionCase& straight) {
    constexpr int kTaps = 4;
    FunctionCase made = straight;
    made.body.replace(made.body.rfind("0.0, 20)"), 8, "1.0, 4)");
    made.arguments = {peerUv(0.2, 0.8), unit(), unit(), linear(0.1, 0.5, 3)};
    made.expected = [](In x) { return gathered(x, kTaps, holesMap(), ScreenNoise(x.vec2(0) * double{kTestMapSize}).value); };
    made.tolerance = {32, 0, 1e-4, "the pattern's turn is known to 2e-4; light up to 600"};
    made.map = &holesMap();
    made.domain = [domain = straight.domain](In x) {
        const dvec2 pixel = x.vec2(0) * double{kTestMapSize};
        const ScreenNoise noise(pixel);
        if (!domain(x) || !noise.isClear() || holesMap().at(x.vec2(0)).x <= 0) return false;
        const dvec3 u = normalize(x.vec3(1));
        const dvec3 v = normalize(cross(normalize(x.vec3(2)), u));
        const dvec3 here = viewPlace(x.vec2(0), holesMap().at(x.vec2(0)).x, kFrustum);
        const dvec3 d = x.vec3(3);
        double border = 1;
        for (int i = -1; i < kTaps; ++i) { // the pixel itself, too
            const double radius = i < 0 ? 0 : max({d.x, d.y, d.z}) * unitRadii(kTaps)[static_cast<std::size_t>(i)];
            const dvec2 f = fract(tapAt(here, u, v, radius, kGoldenAngle * i + 2 * kPeerPi * noise.value));
            border = min({border, f.x, 1 - f.x, f.y, 1 - f.y});
        }
        return border > 0.02;
    };
    return made;
}

Cases discs() {
    Cases cases;
    cases.add("tgBurleyRadius(a0)", {linear(0, 0.9999)},
              {8, 2, 2e-6, "the logarithm of a number near 1 for small shares: 2^-21 absolute in Vulkan"},
              [](In x) { return reference::burleyRadius(std::clamp(x[0], 0.0, 0.9999999), 1); });
    cases.back().domain = [](In x) { return x[0] >= 0 && x[0] < 0.99995; };
    cases.add("tgBurleyPolar(a0, a1)", {logarithmic(1e-4, 20), linear(0.05, 5, 3)},
              {400, 4, 1e-30, "exp: 3 + 2|x| ULP with |x| up to 130, cubed"}, [](In x) {
                  dvec3 sum;
                  for (int c = 0; c < 3; ++c)
                      sum[c] = 8 * kPeerPi * x[0] * reference::burleyProfile(x[0], x.vec3(1)[c]);
                  return sum;
              });
    cases.back().domain = [](In x) { return x[0] > 5e-5 && min({x.vec3(1).x, x.vec3(1).y, x.vec3(1).z}) > 0.04; };
    cases.add("tgBurleyWeight(a0 * a1, a1, a2, a3)", {linear(1, 3), logarithmic(1e-3, 7), linear(0.05, 0.45, 3), linear(0.45, 1)},
              {400, 8, 1e-30, "two of the exponentials of tgBurleyPolar"}, {.settings = {0, 2}},
              [](In x) { return weight(x[0] * x[1], x[1], x.vec3(2), x[3], x.corrected()); });
    cases.back().domain = [](In x) { return x[0] > 0.5 && x[1] > 5e-4 && min({x.vec3(2).x, x.vec3(2).y, x.vec3(2).z}) > 0.04; };
    cases.add("tgBurleyDirection(a0, a1)", {whole(0, 79), linear(0, 1)}, {4, 0, 5e-5, "an angle of up to 200 radians keeps 2e-5"},
              [](In x) {
                  const double angle = kGoldenAngle * x[0] + 2 * kPeerPi * x[1];
                  return values(cos(angle), sin(angle));
              });
    cases.add("tgBurleyPixel(a0, a1)", {peerUv(), whole(1, 2000)}, {4, 2, 1e-7, "on the border of two pixels it may be either"},
              [](In x) { return middleOf(x.vec2(0), x.vec2(1)); });
    cases.back().arguments[1].components = 2;
    cases.add("tgBurleyPlace(a0, a1)", {linear(0, 1, 2), linear(0, 1, 2)}, {0, 0, 0, "a choice"}, {.settings = {0, 2}},
              [](In x) { return x.vec2(x.corrected() ? 0 : 1); });
    cases.add("tgBurleyApart(a0, a1, a2)", {vector(3, 1e-2, 20), unit(), logarithmic(1e-3, 10)},
              {8, 4, 1e-6, "a dot product that may cancel"}, {.settings = {0, 2}}, [](In x) {
                  const double departure = x.corrected() ? dot(x.vec3(0), x.vec3(1)) : x.scalar(0, 2);
                  return hypot(x[2], departure);
              });
    cases.add(
        {"tgBurleyGather",
         std::string(kFrustumCode) +
             "float3 u = tgSafeNormalize(a1); float3 v = tgSafeNormalize(cross(tgSafeNormalize(a2), u)); return float4(.001, 1, 1, 1) * "
             "tgBurleyGather(TG_SAMPLER2D_ARG(gTest), TG_SAMPLER2D_ARG(gTest), a0, float2(kTgMapSize, kTgMapSize), f, u, v, a3, 0.0, 20);"},
        {peerUv(0.2, 0.8), unit(), unit(), linear(0.1, 2, 3)},
        {32, 4, 1e-4, "one of twenty taps on the border of two pixels may be either, up to 9 mm of depth apart; the mean of depths of 600"},
        {.settings = {0, 2}, .samples = 512, .map = &halvesMap()}, [](In x) { return gathered(x, 20, halvesMap(), 0); });
    cases.back().domain = [](In x) {
        const bool lengths = length(x.vec3(1)) > 0.5 && length(x.vec3(2)) > 0.5;
        return lengths && length(cross(x.vec3(1), x.vec3(2))) > 0.3 && min({x.vec3(3).x, x.vec3(3).y, x.vec3(3).z}) > 0.08;
    };
    cases += turnedDisc(cases.back());
    return cases;
}

} // namespace

Cases peerDiscCases() {
    return discs();
}

} // namespace tegument::test
