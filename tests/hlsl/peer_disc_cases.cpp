// hlsl/peers/burley.fxh: Burley's disc on the pixels of a picture. References: docs/design/peers.md, lab/reference/peers.h.

#include "lab/reference/peers.h"
#include "tests/hlsl/peer_cases.h"

#include <algorithm>
#include <map>

namespace tegument::test {

namespace {

glm::dvec2 middleOf(const glm::dvec2& uv, const glm::dvec2& viewport) {
    return (glm::floor(uv * viewport) + 0.5) / viewport;
}

glm::dvec3 weight(double apart, double radius, const glm::dvec3& d, double widest, bool corrected) {
    glm::dvec3 result;
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
glm::dvec2 tapAt(const glm::dvec3& here, const glm::dvec3& u, const glm::dvec3& v, double radius, double angle) {
    return viewUv(here + radius * (std::cos(angle) * u + std::sin(angle) * v), kFrustum) * double{kTestMapSize};
}

/// The disc in the tangent plane or facing the eye, tap after tap.
Values gathered(const Inputs& x, int count, const TestMap& map, double turn) {
    const glm::dvec2 uv = x.vec2(0);
    const glm::dvec2 viewport(kTestMapSize);
    const double z = map.at(uv).x;
    if (z <= 0) return values(0);
    const glm::dvec3 u = glm::normalize(x.vec3(1));
    const glm::dvec3 v = glm::normalize(glm::cross(glm::normalize(x.vec3(2)), u));
    const glm::dvec3 normal = glm::cross(u, v);
    const glm::dvec3 here = viewPlace(uv, z, kFrustum);
    const glm::dvec3 d = x.vec3(3);
    const double widest = std::max({d.x, d.y, d.z});
    glm::dvec3 sum(0);
    glm::dvec3 total(0);
    for (int i = 0; i < count; ++i) {
        const double radius = widest * unitRadii(count)[static_cast<std::size_t>(i)];
        const double angle = kGoldenAngle * i + 2 * kPeerPi * turn;
        const glm::dvec3 at = here + radius * (std::cos(angle) * u + std::sin(angle) * v);
        const glm::dvec2 pixel = middleOf(viewUv(at, kFrustum), viewport);
        const glm::dvec4 tap = map.at(pixel);
        if (tap.x <= 0) continue;
        const glm::dvec3 way = viewPlace(pixel, tap.x, kFrustum) - here;
        const double departure = x.corrected() ? glm::dot(way, normal) : way.z;
        const glm::dvec3 w = weight(std::hypot(radius, departure), radius, d, widest, x.corrected());
        sum += w * glm::dvec3(tap);
        total += w * tap.w;
    }
    const glm::dvec3 light = total.z > 1e-6 ? sum / total : glm::dvec3(map.at(uv));
    return values(kScale * glm::dvec4(light, 1));
}

/// Of few taps and near, so that none lies on the border of two pixels: turned from pixel to pixel, beside holes.
FunctionCase turnedDisc(const FunctionCase& straight) {
    constexpr int kTaps = 4;
    FunctionCase made = straight;
    made.body.replace(made.body.rfind("0.0, 20)"), 8, "1.0, 4)");
    made.arguments = {peerUv(0.2, 0.8), unit(), unit(), linear(0.1, 0.5, 3)};
    made.expected = [](const Inputs& x) { return gathered(x, kTaps, holesMap(), ScreenNoise(x.vec2(0) * double{kTestMapSize}).value); };
    made.tolerance = {.forward = 32, .backward = 0, .absolute = 1e-4, .why = "the pattern's turn is known to 2e-4; light up to 600"};
    made.map = &holesMap();
    made.domain = [domain = straight.domain](const Inputs& x) {
        const glm::dvec2 pixel = x.vec2(0) * double{kTestMapSize};
        const ScreenNoise noise(pixel);
        if (!domain(x) || !noise.isClear() || holesMap().at(x.vec2(0)).x <= 0) return false;
        const glm::dvec3 u = glm::normalize(x.vec3(1));
        const glm::dvec3 v = glm::normalize(glm::cross(glm::normalize(x.vec3(2)), u));
        const glm::dvec3 here = viewPlace(x.vec2(0), holesMap().at(x.vec2(0)).x, kFrustum);
        const glm::dvec3 d = x.vec3(3);
        double border = 1;
        for (int i = -1; i < kTaps; ++i) { // the pixel itself, too
            const double radius = i < 0 ? 0 : std::max({d.x, d.y, d.z}) * unitRadii(kTaps)[static_cast<std::size_t>(i)];
            const glm::dvec2 f = glm::fract(tapAt(here, u, v, radius, kGoldenAngle * i + 2 * kPeerPi * noise.value));
            border = std::min({border, f.x, 1 - f.x, f.y, 1 - f.y});
        }
        return border > 0.02;
    };
    return made;
}

std::vector<FunctionCase> discs() {
    std::vector<FunctionCase> cases;
    cases.push_back(
        {.function = "tgBurleyRadius",
         .body = "return float4(tgBurleyRadius(a0), 0, 0, 0);",
         .arguments = {linear(0, 0.9999)},
         .expected = [](const Inputs& x) { return values(reference::burleyRadius(std::clamp(x.scalar(0), 0.0, 0.9999999), 1)); },
         .tolerance = {.forward = 8,
                       .backward = 2,
                       .absolute = 2e-6,
                       .why = "the logarithm of a number near 1 for small shares: 2^-21 absolute in Vulkan"},
         .domain = [](const Inputs& x) { return x.scalar(0) >= 0 && x.scalar(0) < 0.99995; }});
    cases.push_back({.function = "tgBurleyPolar",
                     .body = "return float4(tgBurleyPolar(a0, a1), 0);",
                     .arguments = {logarithmic(1e-4, 20), linear(0.05, 5, 3)},
                     .expected =
                         [](const Inputs& x) {
                             glm::dvec3 sum;
                             for (int c = 0; c < 3; ++c)
                                 sum[c] = 8 * kPeerPi * x.scalar(0) * reference::burleyProfile(x.scalar(0), x.vec3(1)[c]);
                             return values(sum);
                         },
                     .tolerance = {.forward = 400, .backward = 4, .absolute = 1e-30, .why = "exp: 3 + 2|x| ULP with |x| up to 130, cubed"},
                     .domain =
                         [](const Inputs& x) {
                             return x.scalar(0) > 5e-5 && std::min({x.vec3(1).x, x.vec3(1).y, x.vec3(1).z}) > 0.04;
                         }});
    cases.push_back(
        {.function = "tgBurleyWeight",
         .body = "return float4(tgBurleyWeight(a0 * a1, a1, a2, a3), 0);",
         .arguments = {linear(1, 3), logarithmic(1e-3, 7), linear(0.05, 0.45, 3), linear(0.45, 1)},
         .expected =
             [](const Inputs& x) { return values(weight(x.scalar(0) * x.scalar(1), x.scalar(1), x.vec3(2), x.scalar(3), x.corrected())); },
         .tolerance = {.forward = 400, .backward = 8, .absolute = 1e-30, .why = "two of the exponentials of tgBurleyPolar"},
         .settings = {0, 2},
         .domain =
             [](const Inputs& x) {
                 return x.scalar(0) > 0.5 && x.scalar(1) > 5e-4 && std::min({x.vec3(2).x, x.vec3(2).y, x.vec3(2).z}) > 0.04;
             }});
    cases.push_back({.function = "tgBurleyDirection",
                     .body = "return float4(tgBurleyDirection(a0, a1), 0, 0);",
                     .arguments = {whole(0, 79), linear(0, 1)},
                     .expected =
                         [](const Inputs& x) {
                             const double angle = kGoldenAngle * x.scalar(0) + 2 * kPeerPi * x.scalar(1);
                             return values(std::cos(angle), std::sin(angle));
                         },
                     .tolerance = {.forward = 4, .backward = 0, .absolute = 5e-5, .why = "an angle of up to 200 radians keeps 2e-5"}});
    cases.push_back({.function = "tgBurleyPixel",
                     .body = "return float4(tgBurleyPixel(a0, a1), 0, 0);",
                     .arguments = {peerUv(), whole(1, 2000)},
                     .expected = [](const Inputs& x) { return values(middleOf(x.vec2(0), x.vec2(1))); },
                     .tolerance = {.forward = 4, .backward = 2, .absolute = 1e-7, .why = "on the border of two pixels it may be either"}});
    cases.back().arguments[1].components = 2;
    cases.push_back({.function = "tgBurleyPlace",
                     .body = "return float4(tgBurleyPlace(a0, a1), 0, 0);",
                     .arguments = {linear(0, 1, 2), linear(0, 1, 2)},
                     .expected = [](const Inputs& x) { return values(x.vec2(x.corrected() ? 0 : 1)); },
                     .tolerance = {.forward = 0, .backward = 0, .why = "a choice"},
                     .settings = {0, 2}});
    cases.push_back({.function = "tgBurleyApart",
                     .body = "return float4(tgBurleyApart(a0, a1, a2), 0, 0, 0);",
                     .arguments = {vector(3, 1e-2, 20), unit(), logarithmic(1e-3, 10)},
                     .expected =
                         [](const Inputs& x) {
                             const double departure = x.corrected() ? glm::dot(x.vec3(0), x.vec3(1)) : x.scalar(0, 2);
                             return values(std::hypot(x.scalar(2), departure));
                         },
                     .tolerance = {.forward = 8, .backward = 4, .absolute = 1e-6, .why = "a dot product that may cancel"},
                     .settings = {0, 2}});
    cases.push_back(
        {.function = "tgBurleyGather",
         .body =
             std::string(kFrustumCode) +
             "float3 u = tgSafeNormalize(a1); float3 v = tgSafeNormalize(cross(tgSafeNormalize(a2), u)); return float4(.001, 1, 1, 1) * "
             "tgBurleyGather(TG_SAMPLER2D_ARG(gTest), TG_SAMPLER2D_ARG(gTest), a0, float2(kTgMapSize, kTgMapSize), f, u, v, a3, 0.0, 20);",
         .arguments = {peerUv(0.2, 0.8), unit(), unit(), linear(0.1, 2, 3)},
         .expected = [](const Inputs& x) { return gathered(x, 20, halvesMap(), 0); },
         .tolerance =
             {.forward = 32,
              .backward = 4,
              .absolute = 1e-4,
              .why = "one of twenty taps on the border of two pixels may be either, up to 9 mm of depth apart; the mean of depths of 600"},
         .settings = {0, 2},
         .samples = 512,
         .map = &halvesMap(),
         .domain =
             [](const Inputs& x) {
                 const bool lengths = glm::length(x.vec3(1)) > 0.5 && glm::length(x.vec3(2)) > 0.5;
                 return lengths && glm::length(glm::cross(x.vec3(1), x.vec3(2))) > 0.3 &&
                        std::min({x.vec3(3).x, x.vec3(3).y, x.vec3(3).z}) > 0.08;
             }});
    cases.push_back(turnedDisc(cases.back()));
    return cases;
}

} // namespace

std::vector<FunctionCase> peerDiscCases() {
    return discs();
}

} // namespace tegument::test
