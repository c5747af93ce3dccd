// hlsl/peers on the pixels of a picture: geometry, the separable kernel. References: docs/design/peers.md,
// lab/reference/peers.h.

#include "lab/reference/peers.h"
#include "tests/hlsl/peer_cases.h"

namespace tegument::test {

namespace {

/// Of the two neighbours along an axis the one whose depth is nearer, and how steep counts as one surface.
struct Neighbours {
    double nearer = 0;
    double apart = 0; // by how much nearer
    double steepest = 0;

    Neighbours(const TestMap& map, const dvec2& uv, const dvec2& axis, const dvec2& frustum) {
        const double z = map.at(uv).x;
        const double back = z - map.at(uv - axis).x;
        const double ahead = map.at(uv + axis).x - z;
        nearer = abs(ahead) < abs(back) ? ahead : back;
        apart = abs(abs(ahead) - abs(back));
        steepest = 16 * 2 * z * (abs(axis.x) * frustum.x + abs(axis.y) * frustum.y);
    }
};

/// Change of depth to the next pixel.
double slopeOf(const TestMap& map, const dvec2& uv, const dvec2& axis, const dvec2& frustum) {
    const Neighbours found(map, uv, axis, frustum);
    return abs(found.nearer) < found.steepest ? found.nearer : 0;
}

/// Whether no rounding decides which neighbour tells, and whether it counts; nor, on the border of two texels, which pixel is asked.
bool slopeIsClear(const TestMap& map, const dvec2& uv, const dvec2& axis, const dvec2& frustum) {
    const Neighbours found(map, uv, axis, frustum);
    const dvec2 within = fract(uv * double{kTestMapSize});
    return abs(abs(found.nearer) - found.steepest) > 3e-4 && found.apart > 3e-4 &&
           min({within.x, 1 - within.x, within.y, 1 - within.y}) > 1e-3;
}

} // namespace

dvec3 pixelTangent(const TestMap& map, const dvec2& uv, const dvec2& axis, const dvec2& frustum) {
    const double z = map.at(uv).x;
    const double change = slopeOf(map, uv, axis, frustum);
    return 0.5 * (viewPlace(uv + axis, z + change, frustum) - viewPlace(uv - axis, z - change, frustum));
}

namespace {

constexpr double kPixel = 1.0 / kTestMapSize;
/// Slopes about as steep as counts: a pixel of 1.5 to 9 um, sixteen of which the map's waves of .17 mm a texel come to, along an axis and
/// back.
void steepSlopes(Cases& cases) {
    for (const dvec2& along : {dvec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
        const dvec2 axis = kPixel * along;
        cases.add({"tgScreenSlope", "float2 axis = float2(" + std::to_string(along.x) + ", " + std::to_string(along.y) +
                                        ") / kTgMapSize; return float4(tgScreenSlope(TG_SAMPLER2D_ARG(gTest), a0, axis, a1), 0, 0, 0);"},
                  {peerUv(), linear(3e-4, 2e-3, 2)}, {2, 0, 1.3e-4, "depths of about 600, whose ULP is 6e-5"}, {.map = &halvesMap()},
                  [axis](In x) { return slopeOf(halvesMap(), x.vec2(0), axis, x.vec2(1)); });
        cases.back().domain = [axis](In x) { return slopeIsClear(halvesMap(), x.vec2(0), axis, x.vec2(1)); };
    }
}

void geometry(Cases& cases) {
    cases.add(
        {"tgScreenFrustum", "float4x4 m = {a0, 0, 0, 0, 0, a1, 0, 0, 0, 0, 1, 1, 0, 0, -1, 0}; return float4(tgScreenFrustum(m), 0, 0);"},
        {logarithmic(0.1, 100), logarithmic(0.1, 100)}, {3, 0, 0, "two quotients"}, [](In x) { return values(1 / x[0], 1 / x[1]); });
    cases.back().domain = [](In x) { return x[0] > 0.05 && x[1] > 0.05; };
    cases.add("tgScreenPosition(a0, a1, a2)", {peerUv(), logarithmic(1, 1e4), linear(0.05, 1, 2)},
              {4, 1, 0, "a sum that cancels in the middle, which the slack of uv stands for"},
              [](In x) { return viewPlace(x.vec2(0), x[1], x.vec2(2)); });
    cases.add("tgScreenCoordinate(a0, a1)", {linear(1, 1000, 3), linear(0.05, 1, 2)}, {6, 2, 1e-6, "quotients and a sum with 0.5"},
              [](In x) { return viewUv(x.vec3(0), x.vec2(1)); });
    cases.back().domain = [](In x) { return x.scalar(0, 2) > 1e-2 && x[1] > 0.04 && x.scalar(1, 1) > 0.04; };
    for (const auto& [axis, body] :
         {std::pair(dvec2(kPixel, 0), "float2(1.0 / kTgMapSize, 0)"), std::pair(dvec2(0, kPixel), "float2(0, 1.0 / kTgMapSize)")}) {
        cases.add({"tgScreenSlope", std::string("return float4(tgScreenSlope(TG_SAMPLER2D_ARG(gTest), a0, ") + body + ", a1), 0, 0, 0);"},
                  {peerUv(), linear(0.1, 0.5, 2)}, {2, 2, 1.3e-4, "a difference of depths of about 600, whose ULP is 6e-5"},
                  {.map = &halvesMap()}, [along = axis](In x) { return slopeOf(halvesMap(), x.vec2(0), along, x.vec2(1)); });
        cases.add({"tgScreenTangent", std::string("return float4(tgScreenTangent(TG_SAMPLER2D_ARG(gTest), a0, ") + body + ", a1), 0);"},
                  {peerUv(), linear(0.1, 0.5, 2)}, {8, 2, 1.5e-4, "a difference of places that are up to 300 mm away, whose ULP is 3e-5"},
                  {.map = &halvesMap()}, [along = axis](In x) { return pixelTangent(halvesMap(), x.vec2(0), along, x.vec2(1)); });
    }
    // both halves hold the depth: multiples below 2048, and what is left to 2^-11 of it
    cases.add({"tgScreenDepthStep", "float s = tgScreenDepthStep(a0); float2 h = tgHalvesOf(a0, s); return float4(s, abs(h.x / s) <= "
                                    "2048.0, abs(f16tof32(f32tof16(h.x)) + f16tof32(f32tof16(h.y)) - a0) <= s / 2048.0, 0);"},
              {logarithmic(1, 65000)}, {0, 0, 0, "powers of two"}, [](In x) {
                  return values(x[0] < 2048 ? 1 : x[0] < 16384 ? 8 : 64, 1, 1);
              });
    cases.back().domain = [](In x) { return x[0] < 65000; };
    cases.add("tgScreenNoise(floor(a0))", {linear(0, 256, 2)},
              {0, 0, 2e-4, "the inner fraction keeps 1e-6 of 18, times 53; neither fraction near its jump"},
              [](In x) { return ScreenNoise(x.vec2(0)).value; });
    cases.back().domain = [](In x) { return ScreenNoise(x.vec2(0)).isClear(); };
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
    return values(dvec4(sample.weight, sample.offset));
}

/// Share of its own light that a tap keeps.
double share(const dvec3& way, const dvec3& along, double scale, bool corrected) {
    if (!corrected) return 1 - saturate(scale * abs(way.z));
    const double ahead = dot(way, along);
    return ahead * ahead / max(dot(way, way), 1e-12);
}

/// Printed: 300 width |dz| / tan(fov / 2) in units of the demonstration, of which 0.012 are the width and 1.5 units of the kernel.
double depthScale(double frustumY, double unit) {
    return 300 * 0.012 * 0.012 / 1.5 / (frustumY * unit);
}

/// The whole blur along one axis, sample after sample.
Values convolved(const dvec2& uv, const dvec2& axis, double unit, const dvec3& strength, int samples, bool corrected) {
    const TestMap& map = halvesMap();
    const double z = map.at(uv).x;
    if (z <= 0) return values(0);
    const dvec3 centre = map.at(uv);
    const dvec3 next = pixelTangent(map, uv, axis, kFrustum);
    const dvec2 direction = axis / length(axis);
    const dvec2 step = corrected ? axis * unit / length(next) : direction * (0.5 * unit / (kFrustum.y * z));
    dvec3 sum(0);
    for (const reference::KernelSample& sample : kernelOf(samples, corrected)) {
        const dvec2 at = uv + sample.offset * step;
        const dvec4 tap = map.at(at);
        const dvec3 way = viewPlace(at, tap.x, kFrustum) - viewPlace(uv, z, kFrustum);
        const double kept = sample.offset == 0 ? 0 : share(way, normalize(next), depthScale(kFrustum.y, unit), corrected);
        sum += sample.weight * (kept * dvec3(tap) + (1 - kept * tap.w) * centre);
    }
    return values(kScale * dvec4(centre + strength * (sum - centre), 1));
}

void kernels(Cases& cases) {
    cases.add("tgSeparableTap((int)a0)", {whole(0, 31)}, {10, 0, 6e-7, "weights are written with seven digits, offsets with six"},
              {.settings = {0, 1, 2}}, [](In x) { return row(static_cast<int>(x[0]), x.corrected()); });
    cases.add("tgSeparableStep(a0, a1, a2, a3, a4)",
              {linear(-1e-2, 1e-2, 2), vector(3, 0.01, 100), logarithmic(1, 1e4), linear(0.05, 1, 2), linear(0.01, 10)},
              {8, 2, 1e-12, "a length and two quotients; one axis is 0"}, {.settings = {0, 2}}, [](In x) {
                  const double printed = 0.5 * x[4] / (x.scalar(3, 1) * max(x[2], 1e-3));
                  if (!x.corrected()) return x[0] > 0 ? dvec2(printed, 0) : dvec2(0, printed);
                  return x.vec2(0) * (x[4] / max(length(x.vec3(1)), 1e-6));
              });
    cases.back().domain = [](In x) { return x.scalar(3, 1) > 0.04 && length(x.vec3(1)) > 1e-5; };
    cases.add("tgSeparableShare(a0, a1, a2)", {vector(3, 1e-3, 100), unit(), logarithmic(1e-3, 10)},
              {16, 4, 2e-6, "a dot product that may cancel, squared"}, {.settings = {0, 2}},
              [](In x) { return share(x.vec3(0), x.vec3(1), x[2], x.corrected()); });
    cases.back().domain = [](In x) { return length(x.vec3(0)) > 1e-4; };
    cases.add("tgSeparableScale(a0, a1)", {linear(0.05, 1, 2), linear(0.01, 10)}, {6, 2, 0, "a quotient"},
              [](In x) { return depthScale(x.scalar(0, 1), max(x[1], 1e-6)); });
    cases.back().domain = [](In x) { return x.scalar(0, 1) > 0.04; };
    cases.add({"tgSeparableLight", std::string(kFrustumCode) + "return " + kScaleCode +
                                       "tgSeparableLight(TG_SAMPLER2D_ARG(gTest), TG_SAMPLER2D_ARG(gTest), a0, tgScreenPosition(a0, 1, f), "
                                       "tgScreenPosition(a1, 600, f), a2, a3);"},
              {peerUv(), peerUv(), unit(), logarithmic(1e-3, 1)}, {16, 4, 5e-6, "a share that keeps 2e-6"},
              {.settings = {0, 2}, .map = &halvesMap()}, [](In x) {
                  const dvec4 tap = halvesMap().at(x.vec2(0));
                  const dvec3 way = viewPlace(x.vec2(0), tap.x, kFrustum) - viewPlace(x.vec2(1), 600, kFrustum);
                  return kScale * tap * share(way, x.vec3(2), x[3], x.corrected());
              });
    for (const Table& table : kTables) {
        cases.add(
            {"tgSeparableConvolve",
             std::string(kFrustumCode) + "float2 axis = a3 > 0.5 ? float2(1.0 / kTgMapSize, 0) : float2(0, 1.0 / kTgMapSize); " +
                 "return " + kScaleCode +
                 "tgSeparableConvolve(TG_SAMPLER2D_ARG(gTest), TG_SAMPLER2D_ARG(gTest), TG_SAMPLER2D_ARG(gTest), a0, axis, f, a1, a2, " +
                 std::to_string(table.first) + ", " + std::to_string(table.samples / 2) + ");"},
            {peerUv(0.2, 0.8), linear(0.2, 6), linear(0, 1, 3), whole(0, 1)},
            {32, 4, 1e-4, "light up to 600; near taps keep a share from a difference of places, 3e-5 of their distance of 0.01 mm"},
            {.settings = {0, 2}, .samples = 1024, .map = &halvesMap()}, [samples = table.samples](In x) {
                const dvec2 axis = x[3] > 0.5 ? dvec2(kPixel, 0) : dvec2(0, kPixel);
                return convolved(x.vec2(0), axis, x[1], x.vec3(2), samples, x.corrected());
            });
        cases.back().domain = [](In x) { return x[1] > 0.1; };
    }
}

} // namespace

Cases peerScreenCases() {
    return together(geometry, steepSlopes, kernels);
}

} // namespace tegument::test
