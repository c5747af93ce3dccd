// A layer of strands that a ray falls through (effects/passes/fur_strands.fxh, fur_cellular.fxh) in double precision: what vertices hand
// on, how far and in which steps the ray is followed, what the layer sends.

#include "tests/hlsl/fur_light.h"
#include "tests/hlsl/maps.h"

namespace tegument::test {

namespace {

constexpr double kLayers = 32;
constexpr double kSegment = 3; // spacings
constexpr double kFewest = 4;
constexpr double kNearEnd = 0.01; // 1 / distance of the coat's end, spacings

FunctionCase layerCase(Call call, Arguments arguments, Tolerance tolerance, Reference expected) {
    const Globals more = {{"gFurRadius", {kFurRootRadius}}, {"gFurLayers", {kLayers}}, {"gFurSegment", {kSegment}},
                          {"gFurFewest", {kFewest}},        {"gFurSpacing", {0.02}},   {"gFurShortest", {0.55}}};
    FunctionCase made =
        passCase("FurRoots.fx", with(furScene(), more), std::move(call), std::move(arguments), std::move(tolerance), std::move(expected));
    made.maps = {{"gCoatEndMap", oneTexel(kNearEnd)}, {"gShadowMap", oneTexel(250)}};
    return made;
}

/// Arguments: normal and place in the mesh, layer, lean, spacing.
struct Layer {
    dvec3 normal, world, fromEye;
    double height, spacing, width, fade, thickness;

    explicit Layer(In x) : normal(x.vec3(0)), height((round(x[2]) + 1) / kLayers), spacing(x[4]) {
        const dvec3 hanging = furTurned(normal + height * x.vec3(3)) + kFurLean * height * kFurDown;
        world = furWorld(x.vec3(1)) + hanging * (kFurLength * kFurMesh * height);
        fromEye = furTurnedBack(world - kFurEye) / spacing;
        width = kFurPixel * length(fromEye);
        fade = share(width - 1);
        thickness = max(kFurLength * kFurMesh / spacing, 1.0);
    }
    /// Layers may be halved so often, logarithm: until a segment of an upright coat is as long as it may be, or the fewest are left.
    [[nodiscard]] double spare() const {
        const double cosine = dot(normalize(fromEye), normal);
        const double way = thickness * sqrt(1 - cosine * cosine) / max(-cosine, 0.01);
        return log2(kLayers / max(way / (kSegment + 64 * fade), kFewest));
    }
    [[nodiscard]] double least() const { return pow(mix(0.01, 1.0 / 6, fade), 2); }
};

void vertices(Cases& cases) {
    const char* body = "TgVertexInput i = (TgVertexInput)0; i.normal = a0; i.position = a1; FurGrowth g; g.place = a3.yzx; g.lean = a3; "
                       "g.density = a5; g.spacing = a4; g.shortest = a5; g.data = float3(0.2, 0.3, 0.4); "
                       "StrandsVarying v = strandsVarying(i, a2, g, -1.0); ";
    const Arguments arguments = {unit(), linear(-40, 40, 3), whole(0, 31), linear(-1, 1, 3), linear(0.1, 10), linear(0.3, 1)};
    const auto add = [&](const char* returned, Reference expected) {
        cases += layerCase({"strandsVarying", std::string(body) + "return " + returned + ";"}, arguments,
                           {32, 4, 2e-4, "sums of up to 400, lengths"}, std::move(expected));
        cases.back().domain = [](In x) { return isUnit(x.vec3(0)) && x[4] >= 0.1; };
    };
    add("v.lightClip", [](In x) { return furLightClip(Layer(x).world); });
    add("v.rest", [](In x) { return dvec4(x.scalar(3, 1), x.scalar(3, 2), x.scalar(3, 0), kLayers - 0.5 - round(x[2])); });
    add("v.fromEye / 100.0", [](In x) { return dvec4(Layer(x).fromEye, Layer(x).width) / 100.0; });
    add("v.lean", [](In x) { return dvec4(x.vec3(3) + kFurLean * furTurnedBack(kFurDown), x[5]); });
    add("v.coat / float4(0.01, 1, 1, 1)", [](In x) {
        const double shortest = x[5];
        return values(100 * Layer(x).least(), Layer(x).thickness, min(shortest, 0.999), 2 / (1 + shortest));
    });
    add("float4(strandsData(v), v.normal.w)", [](In x) { return values(0.2, 0.3, -0.4, Layer(x).height); });
    add("float4(v.toLight.w, v.toLight.xyz / 100.0)", [](In x) {
        const Layer layer(x);
        return dvec4(layer.spare(), furTurnedBack(kFurLamp - layer.world) * kFurUnit / 100.0);
    });
    cases.back().domain = [](In x) { // not where a ray that grazes decides
        const Layer layer(x);
        return isUnit(x.vec3(0)) && x[4] >= 0.1 && abs(dot(normalize(layer.fromEye), layer.normal)) < 0.999;
    };
    // cells as wide as the spacing, from the ball's centre on
    cases +=
        layerCase({"cellularVarying", "TgVertexInput i = (TgVertexInput)0; i.position = a0; StrandsVarying v = cellularVarying(i, a1, "
                                      "-1.0); return float4(v.rest.xyz, strandsShortest(v) + strandsDensity(v)) + 0.0 * strandsRound(v);"},
                  {linear(-40, 40, 3), whole(0, 31)}, {8, 2, 2e-5, "sums of up to 100, by 1.6"},
                  [](In x) { return dvec4(furTurnedBack(furWorld(x.vec3(0)) - kFurCentre) / 1.6, 1.55); });
}

/// Slopes of a layer's triangle from pixel to pixel: of the coat's point, of the skin below it, and of the normal.
const dvec3 kAcross = {0.05, 0.01, -0.02};
const dvec3 kDown = {-0.01, 0.06, 0.015};
const dvec3 kPlaceAcross = {0.045, 0.012, -0.018};
const dvec3 kPlaceDown = {-0.008, 0.055, 0.017};
const dvec3 kNormalAcross = {0.004, 0.0005, 0.001};
const dvec3 kNormalDown = {0.0005, 0.003, -0.001};
constexpr double kThick = 8; // of the coat, spacings

/// Arguments: way from the eye, normal, height, width of a pixel, lean, logarithm of the stride, layers above.
struct Sweep {
    double bottom, end, step, beyond, steps, bow, depth, cosine;

    explicit Sweep(In x) {
        const dvec3 view = normalize(x.vec3(0));
        const dvec3 normal = x.vec3(1);
        const double height = x[2];
        const double fade = share(x[3] - 1);
        const double stride = pow(2, round(x[5]));
        bottom = max(height - stride / kLayers, 0.0);
        depth = height - bottom;
        // The triangle that is moved down by the strand meets the ray again there.
        const dvec3 strand = normal + (height + bottom) * x.vec3(4);
        const dvec3 plane = cross(kAcross, kDown);
        cosine = dot(view, normalize(plane));
        const double way = -dot(strand, plane) / dot(view, plane) * cosine * cosine / (cosine * cosine + 1e-4);
        const dvec3 along = strand + view * way;
        const double mixed = dot(kAcross, kDown);
        const dmat2 squares(dot(kAcross, kAcross), mixed, mixed, dot(kDown, kDown));
        const dvec2 pixels = inverse(squares) * dvec2(dot(along, kAcross), dot(along, kDown)) * kThick;
        const dvec3 travel = kPlaceAcross * pixels.x + kPlaceDown * pixels.y;
        bow = max(dot(view, kNormalAcross * pixels.x + kNormalDown * pixels.y) * way, 1e-3);
        end = 1 - 2 * bow * depth > 0 ? (1 - sqrt(1 - 2 * bow * depth)) / bow : 2 / bow;
        const double over = length(travel) * end;
        step = end / max(over, 1.0);
        beyond = max(over - 8, over * fade);
        const double above = round(x[6]) + 0.5;
        const bool own = fmod(above, stride) < 1; // one layer of so many is drawn
        const bool otherRound = 1 / length(x.vec3(0)) > kNearEnd;
        steps = !own || otherRound ? -1 : fade < 1 ? min(over, 7.0) + 1 : 0;
    }
};

void sweeps(Cases& cases) {
    const char* body = "float2 q = fmod(pixel, 2.0); StrandsVarying v = (StrandsVarying)0; v.fromEye = float4(dot(a0, a0) > 1.0 ? a0 : "
                       "float3(0, 0, 99), a3); v.normal = float4(a1, a2); "
                       "v.lean.xyz = a4; v.toLight.w = a5 + 0.5; v.rest = float4(1, 2, 3, a6 + 0.5); v.coat = float4(1e-4, 8, 0.5, 1); "
                       "v.plainFromEye = float4(q.x * float3(0.05, 0.01, -0.02) + q.y * float3(-0.01, 0.06, 0.015), -1); "
                       "v.plainRest.xyz = q.x * float3(0.045, 0.012, -0.018) + q.y * float3(-0.008, 0.055, 0.017); "
                       "v.plainNormal.xyz = q.x * float3(0.004, 0.0005, 0.001) + q.y * float3(0.0005, 0.003, -0.001); "
                       "FurSweep s = furSweep(v, float2(3.5, 4.5)); ";
    const Arguments arguments = {vector(3, 50, 1000),  unit(),      linear(0.05, 1), linear(0.2, 2.5),
                                 linear(-0.3, 0.3, 3), whole(0, 4), whole(0, 31)};
    const auto add = [&](const char* returned, Reference expected) {
        cases += layerCase({"furSweep", std::string(body) + "return float4(" + returned + ");"}, arguments,
                           {64, 16, 2e-3, "quotients by a cosine of 0.3, of ways up to 100"}, std::move(expected));
        cases.back().perQuad = true;
        cases.back().domain = [](In x) { // not where a ray grazes, or a number of steps leaps
            const Sweep s(x);
            return isUnit(x.vec3(1)) && length(x.vec3(0)) > 10 && s.cosine < -0.3 && abs(1 - 2 * s.bow * s.depth) > 0.05 &&
                   abs(x[3] - 2) > 1e-4 && abs(length(x.vec3(0)) * kNearEnd - 1) > 1e-4;
        };
    };
    add("s.bottom, s.end, s.step, s.steps", [](In x) { return values(Sweep(x).bottom, Sweep(x).end, Sweep(x).step, Sweep(x).steps); });
    add("0.1 * s.beyond, s.height, s.width, s.fade", [](In x) { return values(0.1 * Sweep(x).beyond, x[2], x[3], share(x[3] - 1)); });
    add("s.view, s.place.z", [](In x) { return dvec4(normalize(x.vec3(0)), 3); });
    add("s.normal, 0", [](In x) { return x.vec3(1); });
}

/// Arguments: coverage met, its means, heights, (fade, density, beyond), steps.
dvec4 withExpected(In x) {
    const double fade = max(2 * x[3] - 1, 0.0);
    const dvec2 heights(mix(0.5 * x[2], x[2], fade), 0.4 * x[2]);
    const double density = max(2 * x.scalar(3, 1) - 1, 0.0) * 0.8;
    const dvec4 met = (1 - fade) * x[0] * dvec4(1, x.vec3(1));
    return strandsExpected(met, density, 0.55, heights, x.scalar(3, 2));
}

/// The normal, and the strands along it.
const dvec3 kStood = {0.6, 0, 0.8};

void colours(Cases& cases) {
    const char* body =
        "StrandsVarying v = (StrandsVarying)0; v.lean = float4(0, 0, 0, 0.8); v.coat = float4(0, 8, 0.55, 1.0 / 0.775); "
        "v.toLight.xyz = float3(0, 0, 200); v.lightClip = float4(2, 0, 0.5, 1); FurSweep s = (FurSweep)0; "
        "s.normal = float3(0.6, 0, 0.8); s.view = float3(0, 0.6, -0.8); s.height = a2; s.bottom = 0.4 * a2; "
        "s.fade = max(2.0 * a3.x - 1.0, 0.0); s.beyond = a3.z; s.steps = a4; FurPiece p = furFirstPiece(); p.low = 0.5 * a2; "
        "return furStrandColor(v, s, p, a0 * float4(1, a1), max(2.0 * a3.y - 1.0, 0.0));";
    cases +=
        layerCase({"furStrandColor", body}, {logarithmic(1e-3, 0.9), linear(0.2, 1, 3), linear(0.1, 0.9), linear(0, 1, 3), linear(-0.5, 4)},
                  {64, 4, 1e-3, "a sum over 400 lengths"}, [](In x) {
                      const dvec4 met = withExpected(x);
                      if (x[4] < 0 || met.x < 0.004) return kDiscarded;
                      const dvec3 mean(met.y / met.x, met.z / met.x, met.w / met.x);
                      const dvec3 albedo = mix(kFurDark, kFurPale, mean.y) * mean.z;
                      return values(dvec4(strandsInCoat(albedo, kStood, kStood, {0, 0, 1}, {0, -0.6, 0.8}, mean.x), met.x));
                  });
    cases.back().discards = true;
    cases.back().samples = 4096; // a tenth of the threshold is a hundredth of them
    cases.back().domain = [](In x) { return x[0] >= 1e-3 && abs(withExpected(x).x - 0.004) > 2e-6 && x[4] != 0.0; };
    // a surface 250 mm from the light; what is 0.6 mm behind it still counts as it
    cases +=
        layerCase({"furStrandRadiance", "StrandsVarying v = (StrandsVarying)0; v.toLight.xyz = float3(0, 0, a0); v.lightClip = float4(0.1, "
                                        "0.2, 0.5, 1); FurSweep s = (FurSweep)0; s.normal = float3(0.6, 0, 0.8); s.view = float3(0, 0.6, "
                                        "-0.8); return float4(furStrandRadiance(v, s, float4(0.5, 0.25, 0.25, 0.5)), 0);"},
                  {linear(220, 280), linear(0, 1)}, {32, 0, 1e-5, "exponentials, the 40th power of a cosine"}, [](In x) {
                      const dvec3 albedo = mix(kFurDark, kFurPale, 0.5);
                      const dvec3 filled = albedo * kFurAround * coatFilled(0.5);
                      if (x[0] - 0.005 * kFurMesh * kFurUnit > 250) return filled;
                      return strandsInCoat(albedo, kStood, kStood, {0, 0, 1}, {0, -0.6, 0.8}, 0.5);
                  });
    cases.back().domain = [](In x) { return abs(x[0] - 250.6) > 1e-3; };
    cases += layerCase("furFade(a0)", {linear(-1, 4)}, {1, 1, 0, "a difference"}, [](In x) { return share(x[0] - 1); });
    cases +=
        layerCase({"furFirstPiece", "FurPiece p = furFirstPiece(); return float4(p.bend + p.bendLow, p.low + a0, p.top);"}, {linear(1, 2)},
                  {1, 0, 0, "nothing has been met, and the skin is below"}, [](In x) { return values(0, 0, 1 + x[0], 0); });
    cases +=
        layerCase({"CoatEndPS",
                   "StrandsVarying v = (StrandsVarying)0; v.fromEye.xyz = dot(a0, a0) > 0.1 ? a0 : float3(0, 0, 99); return CoatEndPS(v);"},
                  {vector(3, 1, 500)}, {8, 2, 0, "an inverse root"}, [](In x) { return values(1 / length(x.vec3(0)), 0, 0, 1); });
    cases.back().domain = [](In x) { return length(x.vec3(0)) > 0.5; };
}

} // namespace

Cases furLayerCases() {
    return together(vertices, sweeps, colours);
}

} // namespace tegument::test
