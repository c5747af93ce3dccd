// Strands on roots as ribbons (effects/passes/fur_root_strands.fxh): how they are lit, where they run, which are drawn, in double
// precision.

#include "tests/hlsl/strand_roots.h"

namespace tegument::test {

namespace {

/// Arguments: normal, lean, (share, tint, along), way to the eye, way to the light, offset.
struct LitStrand {
    dvec3 normal, axis, toEye, toLight, albedo;
    double height;

    explicit LitStrand(In x)
        : normal(x.vec3(0)), toEye(normalize(x.vec3(3) - x.vec3(5))), toLight(normalize(x.vec3(4) - x.vec3(5))),
          albedo(mix(kFurDark, kFurPale, x.scalar(2, 2)) * x.scalar(2, 1)), height(x[2] * x.scalar(2, 2)) {
        axis = normalize(normal + 2 * height * x.vec3(1));
    }
    [[nodiscard]] dvec3 by(const dvec3& light, const dvec3& colour) const {
        return strandsLit(albedo, axis, light, toEye) * colour * coatLeaves(height, dot(normal, light));
    }
    [[nodiscard]] dvec3 radiance() const { return strandsInCoat(albedo, axis, normal, toLight, toEye, height); }
};

void colours(Cases& cases) {
    const char* body = "RootStrand s = (RootStrand)0; s.normal = a0; s.lean = a1; s.share = a2.x; s.tint = a2.y; RibbonFrame f = "
                       "(RibbonFrame)0; f.toEye = a3; f.toLight = a4; return float4(rootStrandColor(s, f, a5, a2.z, (TgVertexInput)0), 0);";
    for (const bool lamps : {false, true}) {
        cases += strandRootCase(
            {"rootStrandColor", body},
            {unit(), linear(-0.5, 0.5, 3), linear(0.3, 1, 3), vector(3, 20, 90), vector(3, 20, 90), linear(-5, 5, 3)},
            {64, 8, lamps ? 4e-3 : 1e-3, "sines are roots of differences; the 40th power of a cosine; of each lamp, too"}, [=](In x) {
                const LitStrand s(x);
                dvec3 sum = s.radiance();
                for (std::size_t i = 0; lamps && i < kFurLampWays.size(); ++i)
                    sum += s.by(furTurnedBack(kFurLampWays[i]), kFurLampColours[i]);
                return sum;
            });
        if (lamps) addLamps(cases.back());
        cases.back().domain = [](In x) {
            return isUnit(x.vec3(0)) && length(x.vec3(0) + 2 * x[2] * x.scalar(2, 2) * x.vec3(1)) > 0.3 &&
                   length(x.vec3(3) - x.vec3(5)) > 1 && length(x.vec3(4) - x.vec3(5)) > 1 &&
                   abs(dot(LitStrand(x).axis, LitStrand(x).toLight)) < 0.999;
        };
    }
}

constexpr double kCoat = 5; // mm, as the spacing
constexpr double kSpacing = 2;
constexpr double kPerMm = 1.6;

/// Arguments: normal, lean, side, (share, along), way to the eye.
dvec3 axisAt(In x, double height) {
    const dvec3 across = cross(x.vec3(0), x.vec3(2));
    const dvec2 turn(wave(1.3 * height), wave(1.3 * height + 0.75));
    const dvec3 stray = height * ((0.4 * height + 0.15 * turn.x) * x.vec3(2) + 0.15 * turn.y * across);
    return kCoat * height * (x.vec3(0) + height * x.vec3(1)) + kSpacing * stray;
}

void places(Cases& cases) {
    const char* body = "RootStrand s = (RootStrand)0; s.normal = a0; s.lean = a1; s.side = a2; s.across = cross(a0, a2); s.share = a3.x; "
                       "s.coat = 5.0; s.spacing = 2.0; RibbonFrame f = (RibbonFrame)0; f.toEye = a4; f.perMm = 1.6; "
                       "RibbonPlace p = strandPlace(s, f, a3.y); ";
    const auto add = [&](const char* returned, Reference expected) {
        FunctionCase made = strandRootCase({"strandPlace", std::string(body) + "return float4(" + returned + ", 0);"},
                                           {unit(), linear(-1, 1, 3), linear(-1, 1, 3), linear(0.3, 1, 2), vector(3, 400, 4000)},
                                           {16, 4, 2e-4, "differences of 5 to 4e-7, by 0.1"}, std::move(expected));
        made.globals["gFurTufts"] = {0};
        made.domain = [](In x) { return isUnit(x.vec3(0)) && length(x.vec3(4)) > 1; };
        return made;
    };
    cases += add("p.offset", [](In x) { return kPerMm * axisAt(x, x[3] * x.scalar(3, 1)); });
    cases += add("p.tangent", [](In x) { // of few pixels: partly its chord, so that a ribbon does not turn over
        const double height = x[3] * x.scalar(3, 1);
        const dvec3 tangent = (axisAt(x, height) - axisAt(x, height - 0.02)) / (0.02 * kCoat);
        const dvec3 chord = x.vec3(0) + x[3] * x.vec3(1);
        const double pixels = kCoat * x[3] * kPerMm / length(x.vec3(4)) / kFurPixel;
        return mix(tangent, chord, 0.6 * saturate(2 - pixels / 4));
    });
}

void vertices(Cases& cases) {
    for (const bool core : {false, true}) {
        const auto distance = [](In x) { return length(kFurEye - furWorld(x.vec3(0))); };
        cases += strandRootCase(
            {"strandVarying",
             std::string(
                 "TgVertexInput i = (TgVertexInput)0; i.normal = float3(0, 0, 1); i.position = a0; i.tangent.w = a2 > 0.5 ? 1 : -1; "
                 "i.uv = float2(a3 / 32.0, a1); RibbonVarying v = strandVarying(i, ") +
                 (core ? "true" : "false") + "); return float4(v.edge, v.color.w, 0);"},
            {linear(-1500, 1500, 3), whole(4000, 8000), whole(0, 1), whole(0, 31)},
            {32, 2, 1e-4, "a coat of 1e-5 mm beside distances of up to 4,000"}, [=](In x) {
                const double address = round(x[1]);
                const double pixel = kFurPixel * distance(x);
                const bool thin = 2 * strandWidest() < 0.7 * pixel;
                if (address < 4096 || rootRank(address) >= kStrandShare || (core && thin)) return values(0);
                const double radius = strandRadius(address, 0) * (1 - round(x[3]) / 31) / pixel;
                const double half = max(radius, 0.5);
                return values((x[2] > 0.5 ? 1 : -1) * (half + 0.4), half, radius / half);
            });
        flattenStrands(cases.back());
        cases.back().domain = [=](In x) {
            return abs(rootRank(round(x[1])) - kStrandShare) > 2e-3 && abs(2 * strandWidest() / (0.7 * kFurPixel * distance(x)) - 1) > 1e-4;
        };
    }
}

} // namespace

Cases strandRibbonCases() {
    return together(colours, places, vertices);
}

} // namespace tegument::test
