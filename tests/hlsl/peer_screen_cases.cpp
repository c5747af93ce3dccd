// hlsl/peers on the pixels of a picture: geometry, the separable kernel. References: docs/design/peers.md,
// lab/reference/peers.h.

#include "lab/reference/peers.h"
#include "tests/hlsl/peer_cases.h"

#include <algorithm>
#include <map>

namespace tegument::test {

namespace {

/// Of the two neighbours along an axis the one whose depth is nearer, and how steep counts as one surface.
struct Neighbours {
    double nearer = 0;
    double apart = 0; // by how much nearer
    double steepest = 0;

    Neighbours(const TestMap& map, const glm::dvec2& uv, const glm::dvec2& axis, const glm::dvec2& frustum) {
        const double z = map.at(uv).x;
        const double back = z - map.at(uv - axis).x;
        const double ahead = map.at(uv + axis).x - z;
        nearer = std::abs(ahead) < std::abs(back) ? ahead : back;
        apart = std::abs(std::abs(ahead) - std::abs(back));
        steepest = 16 * 2 * z * (std::abs(axis.x) * frustum.x + std::abs(axis.y) * frustum.y);
    }
};

/// Change of depth to the next pixel.
double slopeOf(const TestMap& map, const glm::dvec2& uv, const glm::dvec2& axis, const glm::dvec2& frustum) {
    const Neighbours found(map, uv, axis, frustum);
    return std::abs(found.nearer) < found.steepest ? found.nearer : 0;
}

/// Whether no rounding decides which neighbour tells, and whether it counts; nor, on the border of two texels, which pixel is asked.
bool slopeIsClear(const TestMap& map, const glm::dvec2& uv, const glm::dvec2& axis, const glm::dvec2& frustum) {
    const Neighbours found(map, uv, axis, frustum);
    const glm::dvec2 within = glm::fract(uv * double{kTestMapSize});
    return std::abs(std::abs(found.nearer) - found.steepest) > 3e-4 && found.apart > 3e-4 &&
           std::min({within.x, 1 - within.x, within.y, 1 - within.y}) > 1e-3;
}

} // namespace

glm::dvec3 pixelTangent(const TestMap& map, const glm::dvec2& uv, const glm::dvec2& axis, const glm::dvec2& frustum) {
    const double z = map.at(uv).x;
    const double change = slopeOf(map, uv, axis, frustum);
    return 0.5 * (viewPlace(uv + axis, z + change, frustum) - viewPlace(uv - axis, z - change, frustum));
}

namespace {

constexpr double kPixel = 1.0 / kTestMapSize;
/// Slopes about as steep as counts: a pixel of 1.5 to 9 um, sixteen of which the map's waves of .17 mm a texel come to, along an axis and
/// back.
std::vector<FunctionCase> steepSlopes() {
    std::vector<FunctionCase> cases;
    for (const glm::dvec2& along : {glm::dvec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
        const glm::dvec2 axis = kPixel * along;
        cases.push_back({.function = "tgScreenSlope",
                         .body = "float2 axis = float2(" + std::to_string(along.x) + ", " + std::to_string(along.y) +
                                 ") / kTgMapSize; return float4(tgScreenSlope(TG_SAMPLER2D_ARG(gTest), a0, axis, a1), 0, 0, 0);",
                         .arguments = {peerUv(), linear(3e-4, 2e-3, 2)},
                         .expected = [axis](const Inputs& x) { return values(slopeOf(halvesMap(), x.vec2(0), axis, x.vec2(1))); },
                         .tolerance = {.forward = 2, .backward = 0, .absolute = 1.3e-4, .why = "depths of about 600, whose ULP is 6e-5"},
                         .map = &halvesMap(),
                         .domain = [axis](const Inputs& x) { return slopeIsClear(halvesMap(), x.vec2(0), axis, x.vec2(1)); }});
    }
    return cases;
}

std::vector<FunctionCase> geometry() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgScreenFrustum",
                     .body = "float4x4 m = {a0, 0, 0, 0, 0, a1, 0, 0, 0, 0, 1, 1, 0, 0, -1, 0}; return float4(tgScreenFrustum(m), 0, 0);",
                     .arguments = {logarithmic(0.1, 100), logarithmic(0.1, 100)},
                     .expected = [](const Inputs& x) { return values(1 / x.scalar(0), 1 / x.scalar(1)); },
                     .tolerance = {.forward = 3, .backward = 0, .why = "two quotients"},
                     .domain = [](const Inputs& x) { return x.scalar(0) > 0.05 && x.scalar(1) > 0.05; }});
    cases.push_back(
        {.function = "tgScreenPosition",
         .body = "return float4(tgScreenPosition(a0, a1, a2), 0);",
         .arguments = {peerUv(), logarithmic(1, 1e4), linear(0.05, 1, 2)},
         .expected = [](const Inputs& x) { return values(viewPlace(x.vec2(0), x.scalar(1), x.vec2(2))); },
         .tolerance = {.forward = 4, .backward = 1, .why = "a sum that cancels in the middle, which the slack of uv stands for"}});
    cases.push_back({.function = "tgScreenCoordinate",
                     .body = "return float4(tgScreenCoordinate(a0, a1), 0, 0);",
                     .arguments = {linear(1, 1000, 3), linear(0.05, 1, 2)},
                     .expected = [](const Inputs& x) { return values(viewUv(x.vec3(0), x.vec2(1))); },
                     .tolerance = {.forward = 6, .backward = 2, .absolute = 1e-6, .why = "quotients and a sum with 0.5"},
                     .domain = [](const Inputs& x) { return x.scalar(0, 2) > 1e-2 && x.scalar(1) > 0.04 && x.scalar(1, 1) > 0.04; }});
    for (const auto& [axis, body] : {std::pair(glm::dvec2(kPixel, 0), "float2(1.0 / kTgMapSize, 0)"),
                                     std::pair(glm::dvec2(0, kPixel), "float2(0, 1.0 / kTgMapSize)")}) {
        cases.push_back({.function = "tgScreenSlope",
                         .body = std::string("return float4(tgScreenSlope(TG_SAMPLER2D_ARG(gTest), a0, ") + body + ", a1), 0, 0, 0);",
                         .arguments = {peerUv(), linear(0.1, 0.5, 2)},
                         .expected = [along = axis](const Inputs& x) { return values(slopeOf(halvesMap(), x.vec2(0), along, x.vec2(1))); },
                         .tolerance = {.forward = 2,
                                       .backward = 2,
                                       .absolute = 1.3e-4,
                                       .why = "a difference of depths of about 600, whose ULP is 6e-5"},
                         .map = &halvesMap()});
        cases.push_back(
            {.function = "tgScreenTangent",
             .body = std::string("return float4(tgScreenTangent(TG_SAMPLER2D_ARG(gTest), a0, ") + body + ", a1), 0);",
             .arguments = {peerUv(), linear(0.1, 0.5, 2)},
             .expected = [along = axis](const Inputs& x) { return values(pixelTangent(halvesMap(), x.vec2(0), along, x.vec2(1))); },
             .tolerance = {.forward = 8,
                           .backward = 2,
                           .absolute = 1.5e-4,
                           .why = "a difference of places that are up to 300 mm away, whose ULP is 3e-5"},
             .map = &halvesMap()});
    }
    cases.push_back({.function = "tgScreenDepthStep", // both halves hold the depth: multiples below 2048, and what is left to 2^-11 of it
                     .body = "float s = tgScreenDepthStep(a0); float2 h = tgHalvesOf(a0, s); return float4(s, abs(h.x / s) <= 2048.0, "
                             "abs(f16tof32(f32tof16(h.x)) + f16tof32(f32tof16(h.y)) - a0) <= s / 2048.0, 0);",
                     .arguments = {logarithmic(1, 65000)},
                     .expected = [](const Inputs& x) { return values(x.scalar(0) < 2048    ? 1
                                                                     : x.scalar(0) < 16384 ? 8
                                                                                           : 64,
                                                                     1, 1); },
                     .tolerance = {.forward = 0, .backward = 0, .why = "powers of two"},
                     .domain = [](const Inputs& x) { return x.scalar(0) < 65000; }});
    cases.push_back({.function = "tgScreenNoise",
                     .body = "return float4(tgScreenNoise(floor(a0)), 0, 0, 0);",
                     .arguments = {linear(0, 256, 2)},
                     .expected = [](const Inputs& x) { return values(ScreenNoise(x.vec2(0)).value); },
                     .tolerance = {.forward = 0,
                                   .backward = 0,
                                   .absolute = 2e-4,
                                   .why = "the inner fraction keeps 1e-6 of 18, times 53; neither fraction near its jump"},
                     .domain = [](const Inputs& x) { return ScreenNoise(x.vec2(0)).isClear(); }});
    return cases;
}

// Kernels.
// ----------------------------------------------------------------------------------------------------------------------------------

struct Table {
    int first = 0;
    int samples = 0;
};
/// Rows of the shader's tables: one side of each kernel.
constexpr std::array<Table, 4> kTables = {{{0, 7}, {4, 11}, {10, 17}, {19, 25}}};

/// Made once: the judge asks for it thousands of times.
const reference::Kernel& kernelOf(int samples, bool corrected) {
    static std::map<std::pair<int, bool>, reference::Kernel> made;
    reference::Kernel& kernel = made[{samples, corrected}];
    if (kernel.empty())
        kernel = corrected ? reference::separableKernel(reference::skinProfile(), samples, reference::separableReach(samples))
                           : reference::separableKernelPrinted(samples);
    return kernel;
}

Values row(int i, bool corrected) {
    const Table* table = &kTables[0];
    for (const Table& one : kTables)
        if (i >= one.first) table = &one;
    const reference::Kernel& kernel = kernelOf(table->samples, corrected);
    const reference::KernelSample& sample = kernel.at(static_cast<std::size_t>(table->samples / 2 + i - table->first));
    return values(glm::dvec4(sample.weight, sample.offset));
}

/// Share of its own light that a tap keeps.
double share(const glm::dvec3& way, const glm::dvec3& along, double scale, bool corrected) {
    if (!corrected) return 1 - std::clamp(scale * std::abs(way.z), 0.0, 1.0);
    const double ahead = glm::dot(way, along);
    return ahead * ahead / std::max(glm::dot(way, way), 1e-12);
}

/// Printed: 300 width |dz| / tan(fov / 2) in units of the demonstration, of which 0.012 are the width and 1.5 units of the kernel.
double depthScale(double frustumY, double unit) {
    return 300 * 0.012 * 0.012 / 1.5 / (frustumY * unit);
}

/// The whole blur along one axis, sample after sample.
Values convolved(const glm::dvec2& uv, const glm::dvec2& axis, double unit, const glm::dvec3& strength, int samples, bool corrected) {
    const TestMap& map = halvesMap();
    const double z = map.at(uv).x;
    if (z <= 0) return values(0);
    const glm::dvec3 centre = map.at(uv);
    const glm::dvec3 next = pixelTangent(map, uv, axis, kFrustum);
    const glm::dvec2 direction = axis / glm::length(axis);
    const glm::dvec2 step = corrected ? axis * unit / glm::length(next) : direction * (0.5 * unit / (kFrustum.y * z));
    glm::dvec3 sum(0);
    for (const reference::KernelSample& sample : kernelOf(samples, corrected)) {
        const glm::dvec2 at = uv + sample.offset * step;
        const glm::dvec4 tap = map.at(at);
        const glm::dvec3 way = viewPlace(at, tap.x, kFrustum) - viewPlace(uv, z, kFrustum);
        const double kept = sample.offset == 0 ? 0 : share(way, glm::normalize(next), depthScale(kFrustum.y, unit), corrected);
        sum += sample.weight * (kept * glm::dvec3(tap) + (1 - kept * tap.w) * centre);
    }
    return values(kScale * glm::dvec4(centre + strength * (sum - centre), 1));
}

std::vector<FunctionCase> kernels() {
    std::vector<FunctionCase> cases;
    cases.push_back(
        {.function = "tgSeparableTap",
         .body = "return tgSeparableTap((int)a0);",
         .arguments = {whole(0, 31)},
         .expected = [](const Inputs& x) { return row(static_cast<int>(x.scalar(0)), x.corrected()); },
         .tolerance = {.forward = 10, .backward = 0, .absolute = 6e-7, .why = "weights are written with seven digits, offsets with six"},
         .settings = {0, 1, 2}});
    cases.push_back({.function = "tgSeparableStep",
                     .body = "return float4(tgSeparableStep(a0, a1, a2, a3, a4), 0, 0);",
                     .arguments = {linear(-1e-2, 1e-2, 2), vector(3, 0.01, 100), logarithmic(1, 1e4), linear(0.05, 1, 2), linear(0.01, 10)},
                     .expected =
                         [](const Inputs& x) {
                             const double printed = 0.5 * x.scalar(4) / (x.scalar(3, 1) * std::max(x.scalar(2), 1e-3));
                             if (!x.corrected()) return values(x.scalar(0) > 0 ? glm::dvec2(printed, 0) : glm::dvec2(0, printed));
                             return values(x.vec2(0) * (x.scalar(4) / std::max(glm::length(x.vec3(1)), 1e-6)));
                         },
                     .tolerance = {.forward = 8, .backward = 2, .absolute = 1e-12, .why = "a length and two quotients; one axis is 0"},
                     .settings = {0, 2},
                     .domain = [](const Inputs& x) { return x.scalar(3, 1) > 0.04 && glm::length(x.vec3(1)) > 1e-5; }});
    cases.push_back({.function = "tgSeparableShare",
                     .body = "return float4(tgSeparableShare(a0, a1, a2), 0, 0, 0);",
                     .arguments = {vector(3, 1e-3, 100), unit(), logarithmic(1e-3, 10)},
                     .expected = [](const Inputs& x) { return values(share(x.vec3(0), x.vec3(1), x.scalar(2), x.corrected())); },
                     .tolerance = {.forward = 16, .backward = 4, .absolute = 2e-6, .why = "a dot product that may cancel, squared"},
                     .settings = {0, 2},
                     .domain = [](const Inputs& x) { return glm::length(x.vec3(0)) > 1e-4; }});
    cases.push_back({.function = "tgSeparableScale",
                     .body = "return float4(tgSeparableScale(a0, a1), 0, 0, 0);",
                     .arguments = {linear(0.05, 1, 2), linear(0.01, 10)},
                     .expected = [](const Inputs& x) { return values(depthScale(x.scalar(0, 1), std::max(x.scalar(1), 1e-6))); },
                     .tolerance = {.forward = 6, .backward = 2, .why = "a quotient"},
                     .domain = [](const Inputs& x) { return x.scalar(0, 1) > 0.04; }});
    cases.push_back({.function = "tgSeparableLight",
                     .body = std::string(kFrustumCode) + "return " + kScaleCode +
                             "tgSeparableLight(TG_SAMPLER2D_ARG(gTest), TG_SAMPLER2D_ARG(gTest), a0, tgScreenPosition(a0, 1, f), "
                             "tgScreenPosition(a1, 600, f), a2, a3);",
                     .arguments = {peerUv(), peerUv(), unit(), logarithmic(1e-3, 1)},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec4 tap = halvesMap().at(x.vec2(0));
                             const glm::dvec3 way = viewPlace(x.vec2(0), tap.x, kFrustum) - viewPlace(x.vec2(1), 600, kFrustum);
                             return values(kScale * tap * share(way, x.vec3(2), x.scalar(3), x.corrected()));
                         },
                     .tolerance = {.forward = 16, .backward = 4, .absolute = 5e-6, .why = "a share that keeps 2e-6"},
                     .settings = {0, 2},
                     .map = &halvesMap()});
    for (const Table& table : kTables)
        cases.push_back(
            {.function = "tgSeparableConvolve",
             .body =
                 std::string(kFrustumCode) + "float2 axis = a3 > 0.5 ? float2(1.0 / kTgMapSize, 0) : float2(0, 1.0 / kTgMapSize); " +
                 "return " + kScaleCode +
                 "tgSeparableConvolve(TG_SAMPLER2D_ARG(gTest), TG_SAMPLER2D_ARG(gTest), TG_SAMPLER2D_ARG(gTest), a0, axis, f, a1, a2, " +
                 std::to_string(table.first) + ", " + std::to_string(table.samples / 2) + ");",
             .arguments = {peerUv(0.2, 0.8), linear(0.2, 6), linear(0, 1, 3), whole(0, 1)},
             .expected =
                 [samples = table.samples](const Inputs& x) {
                     const glm::dvec2 axis = x.scalar(3) > 0.5 ? glm::dvec2(kPixel, 0) : glm::dvec2(0, kPixel);
                     return convolved(x.vec2(0), axis, x.scalar(1), x.vec3(2), samples, x.corrected());
                 },
             .tolerance = {.forward = 32,
                           .backward = 4,
                           .absolute = 1e-4,
                           .why = "light up to 600; near taps keep a share from a difference of places, 3e-5 of their distance of 0.01 mm"},
             .settings = {0, 2},
             .samples = 1024,
             .map = &halvesMap(),
             .domain = [](const Inputs& x) { return x.scalar(1) > 0.1; }});
    return cases;
}

} // namespace

std::vector<FunctionCase> peerScreenCases() {
    return together(geometry(), steepSlopes(), kernels());
}

} // namespace tegument::test
