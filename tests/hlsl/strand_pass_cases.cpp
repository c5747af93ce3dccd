// Strands on roots (effects/passes/fur_strands.fxh, fur_root_strands.fxh) in double precision.

#include "tests/hlsl/fur_light.h"
#include "tests/hlsl/lock_scene.h"

#include <numbers>

namespace tegument::test {

namespace {

/// The texture of roots, and every other map, is one texel.
constexpr std::array<float, 4> kStrandTexel = {0.5F, -3.0F, 2.0F, 0.07032865F};

FunctionCase strandCase(const char* effect, Call call, Arguments arguments, Tolerance tolerance, Reference expected) {
    static const TestMap kMaps{.size = 1, .texels = {kStrandTexel}};
    const Globals more = {{"gFurRadius", {kFurRootRadius}},
                          {"gFurTurns", {1.3}},
                          {"gFurScatter", {0.4}},
                          {"gFurCurls", {0.15}},
                          {"gFurTufts", {1.5}},
                          {"gFurTuftSize", {4}},
                          {"gFurVariation", {0.4}},
                          {"gFurMultiple", {kFurMultiple}},
                          {"gFurSpecular", {kFurMirrored}},
                          {"gFurExponent", {kFurSharpness}},
                          {"gFurDensity", {kFurDense}},
                          {"gFurLean", {0.25}},
                          {"gFurDown", {0, -1, 0}},
                          {"gFurRootColor", numbersOf(kFurDark)},
                          {"gFurTipColor", numbersOf(kFurPale)},
                          {"gLightColor", numbersOf(kFurColour)},
                          {"gFurFill", numbersOf(kFurAround)}};
    FunctionCase made =
        passCase(effect, with(kLockScene, more), std::move(call), std::move(arguments), std::move(tolerance), std::move(expected));
    made.map = &kMaps;
    return made;
}

dvec2 bendAt(double height) {
    const dvec2 turn(wave(1.3 * height), wave(1.3 * height + 0.75));
    return {0.4 * height * height + 0.15 * height * turn.x, 0.15 * height * turn.y};
}

dvec3 tuftAt(const dvec3& p) {
    return waves(0.31 * dvec3(p.y, p.z, p.x) + 0.4 * waves(0.19 * dvec3(p.z, p.x, p.y)));
}

FunctionCase expectedCoverage() {
    FunctionCase made = strandCase("FurRoots.fx", "furExpect(a0, a1, a2, a3, 2.0 / (1.0 + a3), a4, a5)",
                                   {linear(0, 1, 4), linear(0, 1), linear(0, 2), linear(0.3, 0.9), linear(0, 1, 2), linear(0, 4)},
                                   {16, 4, 1e-3, "a sum over 400 lengths"}, [](In x) {
                                       const dvec4 met = (1 - x[1]) * x.vec4(0);
                                       return strandsExpected(met, x[2], x[3], x.vec2(4), x[5]);
                                   });
    made.domain = [](In x) { return x[4] + x.scalar(4, 1) < 1.9; }; // where strands are left
    return made;
}

constexpr const char* kPieceBody =
    "FurPiece last = furFirstPiece(); last.end = a0; last.low = a1; last.bendLow = a2; FurSweep s = (FurSweep)0; s.place = a3; "
    "s.path.travel = a4; s.path.turn = a5; s.step = a6.x; s.end = a6.y; s.height = 0.5 + 0.5 * a6.z; s.path.bow = a6.w; s.normal = a7; "
    "s.width = 0.3; FurPiece piece = furNextPiece(last, s, a8); ";

struct Piece {
    double low, top, reach;
    dvec3 end, along;

    explicit Piece(In x) {
        const double drop = min(x[8] * x[6], x.scalar(6, 1));
        const double bow = max(x.scalar(6, 3), 1e-3);
        const double fallen = drop < 1 / bow ? drop - bow * drop * drop / 2 : 0.5 / bow;
        low = 0.5 + 0.5 * x.scalar(6, 2) - fallen;
        top = x[1];
        const dvec3 normal = x.vec3(7);
        const dvec3 place = x.vec3(3) + drop * x.vec3(4);
        const dvec3 tuft = 1.5 * low * low * tuftAt(place / 4.0);
        end = place + tuft - normal * dot(tuft, normal) - normal * (0.5 * drop * drop * dot(x.vec3(4), x.vec3(5)));
        along = end - x.vec3(0);
        along -= normal * dot(along, normal);
        reach = kFurRootRadius * (1 - low) + top * (0.4 * top + 0.15) + 0.3 + length(along) / 2;
    }
};

void sweeps(Cases& cases) {
    const Tolerance waved{16, 4, 1e-4, "waves of waves, 1.5 times; sums of up to 20"};
    cases += strandCase("FurRoots.fx", {"furBend", "return float4(furBend(a0), furFade(4.0 * a0), 0);"}, {linear(0, 1)},
                        {8, 2, 1e-6, "products, a wave"}, [](In x) { return dvec4(bendAt(x[0]), saturate(4 * x[0] - 1), 0); });
    cases += expectedCoverage();
    const Arguments arguments = {linear(-9, 9, 3), linear(0, 1),    linear(-1, 1, 2), linear(-9, 9, 3), linear(-2, 2, 3),
                                 linear(-1, 1, 3), linear(0, 1, 4), unit(),           whole(0, 4)};
    const auto add = [&](const char* returned, Reference expected) {
        cases += strandCase("FurRoots.fx", {"furNextPiece", std::string(kPieceBody) + "return float4(" + returned + ");"}, arguments, waved,
                            std::move(expected));
    };
    add("piece.end, piece.low", [](In x) { return dvec4(Piece(x).end, Piece(x).low); });
    add("piece.along, piece.reach", [](In x) { return dvec4(Piece(x).along, Piece(x).reach); });
    add("piece.top, piece.bend, piece.bendLow.x", [](In x) { return dvec4(x[1], x.vec2(2), bendAt(Piece(x).low).x); });
    add("piece.begin, piece.bendLow.y", [](In x) { return dvec4(x.vec3(0), bendAt(Piece(x).low).y); });
}

FunctionCase radiance() {
    const auto normalized = [](In x) { return normalize(x.vec3(1) + 2 * x[4] * x.vec3(0)); };
    FunctionCase made = strandCase(
        "FurRoots.fx",
        {"furStrandRadiance", "StrandsVarying v = (StrandsVarying)0; v.lean.xyz = a0; v.toLight.xyz = 250.0 * (dot(a2, a2) > 0.5 ? a2 : "
                              "float3(0, 0, 1)); v.lightClip = float4(2, 0, 0.5, 1); FurSweep s = (FurSweep)0; s.normal = a1; s.view = "
                              "-a3; return float4(furStrandRadiance(v, s, 0.5 * float4(1, a4, a5, a6)), 0);"},
        {linear(-0.5, 0.5, 3), unit(), unit(), unit(), linear(0, 1), linear(0, 1), linear(0.8, 1.2)},
        {64, 8, 1e-3, "sines are roots of differences; the 40th power of a cosine"}, [=](In x) {
            const dvec3 albedo = mix(kFurDark, kFurPale, x[5]) * x[6];
            return strandsInCoat(albedo, normalized(x), x.vec3(1), x.vec3(2), x.vec3(3), x[4]);
        });
    made.domain = [=](In x) {
        return isUnit(x.vec3(1)) && isUnit(x.vec3(2)) && isUnit(x.vec3(3)) && length(x.vec3(1) + 2 * x[4] * x.vec3(0)) > 0.3 &&
               abs(dot(normalized(x), x.vec3(2))) < 0.999;
    };
    return made;
}

struct Rooted {
    dvec3 side, across, lean;
    double spacing = 1 / sqrt(static_cast<double>(kStrandTexel[3]));
    double coat = kLockLength * 90;
    double share, radius, tint;

    explicit Rooted(const dvec3& normal) {
        const dvec3 texel(kStrandTexel[0], kStrandTexel[1], kStrandTexel[2]);
        const double w = kStrandTexel[3];
        const dvec3 random = fract(w * dvec3(1, 256, 65536));
        const double curl = dot(texel, normal);
        const dvec3 flat = random - 0.5 - normal * dot(random - 0.5, normal);
        side = curl * flat / length(flat);
        across = cross(normal, side);
        lean = texel - curl * normal + dvec3(0, -0.25, 0);
        share = max(min(length(texel), w / coat), 0.01);
        radius = w * kFurRootRadius / kStrandTexel[1] * spacing;
        tint = 1 + 0.4 * (random.z - 0.5);
    }
};

void rooted(Cases& cases) {
    const Tolerance plain{16, 8, 1e-5, "sums of up to 10"};
    const auto add = [&](const char* returned, Reference expected) {
        cases += strandCase("FurCoat.fx",
                            {"rootStrand", std::string("TgVertexInput v = (TgVertexInput)0; v.normal = a0; v.uv.y = 5000; "
                                                       "RootStrand s = rootStrand(v, float4(1, 2, 3, 90), 2.0); return float4(") +
                                               returned + ");"},
                            {unit()}, plain, std::move(expected));
        cases.back().domain = [](In x) { return isUnit(x.vec3(0)); };
    };
    add("s.side, s.spacing", [](In x) { return dvec4(Rooted(x.vec3(0)).side, Rooted(x.vec3(0)).spacing); });
    add("s.across, s.coat", [](In x) { return dvec4(Rooted(x.vec3(0)).across, Rooted(x.vec3(0)).coat); });
    add("s.lean, s.share", [](In x) { return dvec4(Rooted(x.vec3(0)).lean, Rooted(x.vec3(0)).share); });
    add("s.radius, s.tint, s.root.xy", [](In x) {
        return values(Rooted(x.vec3(0)).radius, Rooted(x.vec3(0)).tint, static_cast<double>(kStrandTexel[0]),
                      static_cast<double>(kStrandTexel[1]));
    });
    cases += strandCase("FurCoat.fx",
                        {"rootStrandBend",
                         "RootStrand s = (RootStrand)0; s.root = a0; s.normal = a1; s.lean = a2; s.side = a3; s.across = a4; s.coat = "
                         "5.0; s.spacing = 2.0; float3 tuft = a5; return float4(rootStrandBend(s, a6, 2.0, tuft), 0);"},
                        {linear(-40, 40, 3), unit(), linear(-1, 1, 3), linear(-1, 1, 3), linear(-1, 1, 3), linear(-1, 1, 3), linear(0, 1)},
                        {16, 4, 2e-4, "waves of waves, twice"}, [](In x) {
                            const double height = x[6];
                            const dvec2 bend = bendAt(height);
                            const dvec3 stray = bend.x * x.vec3(3) + bend.y * x.vec3(4);
                            dvec3 tuft = x.vec3(5);
                            for (int round = 0; round < 2; ++round) {
                                tuft = 1.5 * height * height * tuftAt((x.vec3(0) / 2.0 + stray - tuft) / 4.0);
                                tuft -= x.vec3(1) * dot(tuft, x.vec3(1));
                            }
                            return 5 * height * (x.vec3(1) + height * x.vec3(2)) + 2.0 * (stray - tuft);
                        });
}

} // namespace

Cases strandPassCases() {
    return together(sweeps, radiance(), rooted);
}

} // namespace tegument::test
