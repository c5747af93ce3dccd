// Strands on roots (effects/passes/fur_strands.fxh, fur_root_strands.fxh) in double precision.

#include "tests/hlsl/fur_light.h"
#include "tests/hlsl/lock_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument::test {

namespace {

/// The texture of roots, and every other map, is one texel.
constexpr std::array<float, 4> kStrandTexel = {0.5F, -3.0F, 2.0F, 0.07032865F};

FunctionCase strandCase(const char* effect, const char* function, std::string body, std::vector<Argument> arguments,
                        std::function<Values(const Inputs&)> expected, Tolerance tolerance) {
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
    FunctionCase made = passCase(effect, with(kLockScene, more), function, std::move(body), std::move(arguments), std::move(expected),
                                 std::move(tolerance));
    made.map = &kMaps;
    return made;
}

glm::dvec2 bendAt(double height) {
    const glm::dvec2 turn(wave(1.3 * height), wave(1.3 * height + 0.75));
    return {0.4 * height * height + 0.15 * height * turn.x, 0.15 * height * turn.y};
}

glm::dvec3 tuftAt(const glm::dvec3& p) {
    return waves(0.31 * glm::dvec3(p.y, p.z, p.x) + 0.4 * waves(0.19 * glm::dvec3(p.z, p.x, p.y)));
}

FunctionCase expectedCoverage() {
    FunctionCase made = strandCase("FurRoots.fx", "furExpect", "return furExpect(a0, a1, a2, a3, 2.0 / (1.0 + a3), a4, a5);",
                                   {linear(0, 1, 4), linear(0, 1), linear(0, 2), linear(0.3, 0.9), linear(0, 1, 2), linear(0, 4)},
                                   [](const Inputs& x) {
                                       const glm::dvec4 met = (1 - x.scalar(1)) * x.vec4(0);
                                       return values(strandsExpected(met, x.scalar(2), x.scalar(3), x.vec2(4), x.scalar(5)));
                                   },
                                   {.forward = 16, .backward = 4, .absolute = 1e-3, .why = "a sum over 400 lengths"});
    made.domain = [](const Inputs& x) { return x.scalar(4) + x.scalar(4, 1) < 1.9; }; // where strands are left
    return made;
}

constexpr const char* kPieceBody =
    "FurPiece last = furFirstPiece(); last.end = a0; last.low = a1; last.bendLow = a2; FurSweep s = (FurSweep)0; s.place = a3; "
    "s.path.travel = a4; s.path.turn = a5; s.step = a6.x; s.end = a6.y; s.height = 0.5 + 0.5 * a6.z; s.path.bow = a6.w; s.normal = a7; "
    "s.width = 0.3; FurPiece piece = furNextPiece(last, s, a8); ";

struct Piece {
    double low, top, reach;
    glm::dvec3 end, along;

    explicit Piece(const Inputs& x) {
        const double drop = std::min(x.scalar(8) * x.scalar(6), x.scalar(6, 1));
        const double bow = std::max(x.scalar(6, 3), 1e-3);
        const double fallen = drop < 1 / bow ? drop - bow * drop * drop / 2 : 0.5 / bow;
        low = 0.5 + 0.5 * x.scalar(6, 2) - fallen;
        top = x.scalar(1);
        const glm::dvec3 normal = x.vec3(7);
        const glm::dvec3 place = x.vec3(3) + drop * x.vec3(4);
        const glm::dvec3 tuft = 1.5 * low * low * tuftAt(place / 4.0);
        end = place + tuft - normal * glm::dot(tuft, normal) - normal * (0.5 * drop * drop * glm::dot(x.vec3(4), x.vec3(5)));
        along = end - x.vec3(0);
        along -= normal * glm::dot(along, normal);
        reach = kFurRootRadius * (1 - low) + top * (0.4 * top + 0.15) + 0.3 + glm::length(along) / 2;
    }
};

std::vector<FunctionCase> sweeps() {
    const Tolerance waved{.forward = 16, .backward = 4, .absolute = 1e-4, .why = "waves of waves, 1.5 times; sums of up to 20"};
    std::vector<FunctionCase> cases;
    cases.push_back(
        strandCase("FurRoots.fx", "furBend", "return float4(furBend(a0), furFade(4.0 * a0), 0);", {linear(0, 1)},
                   [](const Inputs& x) { return values(glm::dvec4(bendAt(x.scalar(0)), std::clamp(4 * x.scalar(0) - 1, 0.0, 1.0), 0)); },
                   {.forward = 8, .backward = 2, .absolute = 1e-6, .why = "products, a wave"}));
    cases.push_back(expectedCoverage());
    const std::vector<Argument> arguments = {linear(-9, 9, 3), linear(0, 1),    linear(-1, 1, 2), linear(-9, 9, 3), linear(-2, 2, 3),
                                             linear(-1, 1, 3), linear(0, 1, 4), unit(),           whole(0, 4)};
    const auto add = [&](const char* returned, std::function<Values(const Inputs&)> expected) {
        cases.push_back(strandCase("FurRoots.fx", "furNextPiece", std::string(kPieceBody) + "return float4(" + returned + ");", arguments,
                                   std::move(expected), waved));
    };
    add("piece.end, piece.low", [](const Inputs& x) { return values(glm::dvec4(Piece(x).end, Piece(x).low)); });
    add("piece.along, piece.reach", [](const Inputs& x) { return values(glm::dvec4(Piece(x).along, Piece(x).reach)); });
    add("piece.top, piece.bend, piece.bendLow.x",
        [](const Inputs& x) { return values(glm::dvec4(x.scalar(1), x.vec2(2), bendAt(Piece(x).low).x)); });
    add("piece.begin, piece.bendLow.y", [](const Inputs& x) { return values(glm::dvec4(x.vec3(0), bendAt(Piece(x).low).y)); });
    return cases;
}

FunctionCase radiance() {
    const auto normalized = [](const Inputs& x) { return glm::normalize(x.vec3(1) + 2 * x.scalar(4) * x.vec3(0)); };
    FunctionCase made =
        strandCase("FurRoots.fx", "furStrandRadiance",
                   "StrandsVarying v = (StrandsVarying)0; v.lean.xyz = a0; v.toLight.xyz = 250.0 * (dot(a2, a2) > 0.5 ? a2 : float3(0, 0, "
                   "1)); v.lightClip = float4(2, 0, 0.5, 1); "
                   "FurSweep s = (FurSweep)0; s.normal = a1; s.view = -a3; "
                   "return float4(furStrandRadiance(v, s, 0.5 * float4(1, a4, a5, a6)), 0);",
                   {linear(-0.5, 0.5, 3), unit(), unit(), unit(), linear(0, 1), linear(0, 1), linear(0.8, 1.2)},
                   [=](const Inputs& x) {
                       const glm::dvec3 albedo = glm::mix(kFurDark, kFurPale, x.scalar(5)) * x.scalar(6);
                       return values(strandsInCoat(albedo, normalized(x), x.vec3(1), x.vec3(2), x.vec3(3), x.scalar(4)));
                   },
                   {.forward = 64, .backward = 8, .absolute = 1e-3, .why = "sines are roots of differences; the 40th power of a cosine"});
    made.domain = [=](const Inputs& x) {
        return isUnit(x.vec3(1)) && isUnit(x.vec3(2)) && isUnit(x.vec3(3)) && glm::length(x.vec3(1) + 2 * x.scalar(4) * x.vec3(0)) > 0.3 &&
               std::abs(glm::dot(normalized(x), x.vec3(2))) < 0.999;
    };
    return made;
}

struct Rooted {
    glm::dvec3 side, across, lean;
    double spacing = 1 / std::sqrt(static_cast<double>(kStrandTexel[3]));
    double coat = kLockLength * 90;
    double share, radius, tint;

    explicit Rooted(const glm::dvec3& normal) {
        const glm::dvec3 texel(kStrandTexel[0], kStrandTexel[1], kStrandTexel[2]);
        const double w = kStrandTexel[3];
        const glm::dvec3 random = glm::fract(w * glm::dvec3(1, 256, 65536));
        const double curl = glm::dot(texel, normal);
        const glm::dvec3 flat = random - 0.5 - normal * glm::dot(random - 0.5, normal);
        side = curl * flat / glm::length(flat);
        across = glm::cross(normal, side);
        lean = texel - curl * normal + glm::dvec3(0, -0.25, 0);
        share = std::max(std::min(glm::length(texel), w / coat), 0.01);
        radius = w * kFurRootRadius / kStrandTexel[1] * spacing;
        tint = 1 + 0.4 * (random.z - 0.5);
    }
};

std::vector<FunctionCase> rooted() {
    const Tolerance plain{.forward = 16, .backward = 8, .absolute = 1e-5, .why = "sums of up to 10"};
    std::vector<FunctionCase> cases;
    const auto add = [&](const char* returned, std::function<Values(const Inputs&)> expected) {
        cases.push_back(strandCase("FurCoat.fx", "rootStrand",
                                   std::string("TgVertexInput v = (TgVertexInput)0; v.normal = a0; v.uv.y = 5000; "
                                               "RootStrand s = rootStrand(v, float4(1, 2, 3, 90), 2.0); return float4(") +
                                       returned + ");",
                                   {unit()}, std::move(expected), plain));
        cases.back().domain = [](const Inputs& x) { return isUnit(x.vec3(0)); };
    };
    add("s.side, s.spacing", [](const Inputs& x) { return values(glm::dvec4(Rooted(x.vec3(0)).side, Rooted(x.vec3(0)).spacing)); });
    add("s.across, s.coat", [](const Inputs& x) { return values(glm::dvec4(Rooted(x.vec3(0)).across, Rooted(x.vec3(0)).coat)); });
    add("s.lean, s.share", [](const Inputs& x) { return values(glm::dvec4(Rooted(x.vec3(0)).lean, Rooted(x.vec3(0)).share)); });
    add("s.radius, s.tint, s.root.xy", [](const Inputs& x) {
        return values(Rooted(x.vec3(0)).radius, Rooted(x.vec3(0)).tint, static_cast<double>(kStrandTexel[0]),
                      static_cast<double>(kStrandTexel[1]));
    });
    cases.push_back(strandCase(
        "FurCoat.fx", "rootStrandBend",
        "RootStrand s = (RootStrand)0; s.root = a0; s.normal = a1; s.lean = a2; s.side = a3; s.across = a4; s.coat = 5.0; s.spacing = 2.0; "
        "float3 tuft = a5; return float4(rootStrandBend(s, a6, 2.0, tuft), 0);",
        {linear(-40, 40, 3), unit(), linear(-1, 1, 3), linear(-1, 1, 3), linear(-1, 1, 3), linear(-1, 1, 3), linear(0, 1)},
        [](const Inputs& x) {
            const double height = x.scalar(6);
            const glm::dvec2 bend = bendAt(height);
            const glm::dvec3 stray = bend.x * x.vec3(3) + bend.y * x.vec3(4);
            glm::dvec3 tuft = x.vec3(5);
            for (int round = 0; round < 2; ++round) {
                tuft = 1.5 * height * height * tuftAt((x.vec3(0) / 2.0 + stray - tuft) / 4.0);
                tuft -= x.vec3(1) * glm::dot(tuft, x.vec3(1));
            }
            return values(5 * height * (x.vec3(1) + height * x.vec3(2)) + 2.0 * (stray - tuft));
        },
        {.forward = 16, .backward = 4, .absolute = 2e-4, .why = "waves of waves, twice"}));
    return cases;
}

} // namespace

std::vector<FunctionCase> strandPassCases() {
    return together(sweeps(), radiance(), rooted());
}

} // namespace tegument::test
