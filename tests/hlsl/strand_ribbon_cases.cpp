// Strands on roots as ribbons (effects/passes/fur_root_strands.fxh): how they are lit, where they run, which are drawn, in double
// precision.

#include "tests/hlsl/strand_roots.h"

#include <algorithm>

namespace tegument::test {

namespace {

/// Arguments: normal, lean, (share, tint, along), way to the eye, way to the light, offset.
struct LitStrand {
    glm::dvec3 normal, axis, toEye, toLight, albedo;
    double height;

    explicit LitStrand(const Inputs& x)
        : normal(x.vec3(0)), toEye(glm::normalize(x.vec3(3) - x.vec3(5))), toLight(glm::normalize(x.vec3(4) - x.vec3(5))),
          albedo(glm::mix(kFurDark, kFurPale, x.scalar(2, 2)) * x.scalar(2, 1)), height(x.scalar(2) * x.scalar(2, 2)) {
        axis = glm::normalize(normal + 2 * height * x.vec3(1));
    }
    [[nodiscard]] glm::dvec3 by(const glm::dvec3& light, const glm::dvec3& colour) const {
        return strandsLit(albedo, axis, light, toEye) * colour * coatLeaves(height, glm::dot(normal, light));
    }
    [[nodiscard]] glm::dvec3 radiance() const { return strandsInCoat(albedo, axis, normal, toLight, toEye, height); }
};

std::vector<FunctionCase> colours() {
    const char* body = "RootStrand s = (RootStrand)0; s.normal = a0; s.lean = a1; s.share = a2.x; s.tint = a2.y; RibbonFrame f = "
                       "(RibbonFrame)0; f.toEye = a3; f.toLight = a4; return float4(rootStrandColor(s, f, a5, a2.z, (TgVertexInput)0), 0);";
    std::vector<FunctionCase> cases;
    for (const bool lamps : {false, true}) {
        cases.push_back(
            strandRootCase("rootStrandColor", body,
                           {unit(), linear(-0.5, 0.5, 3), linear(0.3, 1, 3), vector(3, 20, 90), vector(3, 20, 90), linear(-5, 5, 3)},
                           [=](const Inputs& x) {
                               const LitStrand s(x);
                               glm::dvec3 sum = s.radiance();
                               for (std::size_t i = 0; lamps && i < kFurLampWays.size(); ++i)
                                   sum += s.by(furTurnedBack(kFurLampWays[i]), kFurLampColours[i]);
                               return values(sum);
                           },
                           {.forward = 64,
                            .backward = 8,
                            .absolute = lamps ? 4e-3 : 1e-3,
                            .why = "sines are roots of differences; the 40th power of a cosine; of each lamp, too"}));
        if (lamps) addLamps(cases.back());
        cases.back().domain = [](const Inputs& x) {
            return isUnit(x.vec3(0)) && glm::length(x.vec3(0) + 2 * x.scalar(2) * x.scalar(2, 2) * x.vec3(1)) > 0.3 &&
                   glm::length(x.vec3(3) - x.vec3(5)) > 1 && glm::length(x.vec3(4) - x.vec3(5)) > 1 &&
                   std::abs(glm::dot(LitStrand(x).axis, LitStrand(x).toLight)) < 0.999;
        };
    }
    return cases;
}

constexpr double kCoat = 5; // mm, as the spacing
constexpr double kSpacing = 2;
constexpr double kPerMm = 1.6;

/// Arguments: normal, lean, side, (share, along), way to the eye.
glm::dvec3 axisAt(const Inputs& x, double height) {
    const glm::dvec3 across = glm::cross(x.vec3(0), x.vec3(2));
    const glm::dvec2 turn(wave(1.3 * height), wave(1.3 * height + 0.75));
    const glm::dvec3 stray = height * ((0.4 * height + 0.15 * turn.x) * x.vec3(2) + 0.15 * turn.y * across);
    return kCoat * height * (x.vec3(0) + height * x.vec3(1)) + kSpacing * stray;
}

std::vector<FunctionCase> places() {
    const char* body = "RootStrand s = (RootStrand)0; s.normal = a0; s.lean = a1; s.side = a2; s.across = cross(a0, a2); s.share = a3.x; "
                       "s.coat = 5.0; s.spacing = 2.0; RibbonFrame f = (RibbonFrame)0; f.toEye = a4; f.perMm = 1.6; "
                       "RibbonPlace p = strandPlace(s, f, a3.y); ";
    const auto add = [&](const char* returned, std::function<Values(const Inputs&)> expected) {
        FunctionCase made =
            strandRootCase("strandPlace", std::string(body) + "return float4(" + returned + ", 0);",
                           {unit(), linear(-1, 1, 3), linear(-1, 1, 3), linear(0.3, 1, 2), vector(3, 400, 4000)}, std::move(expected),
                           {.forward = 16, .backward = 4, .absolute = 2e-4, .why = "differences of 5 to 4e-7, by 0.1"});
        made.globals["gFurTufts"] = {0};
        made.domain = [](const Inputs& x) { return isUnit(x.vec3(0)) && glm::length(x.vec3(4)) > 1; };
        return made;
    };
    std::vector<FunctionCase> cases;
    cases.push_back(add("p.offset", [](const Inputs& x) { return values(kPerMm * axisAt(x, x.scalar(3) * x.scalar(3, 1))); }));
    cases.push_back(add("p.tangent", [](const Inputs& x) { // of few pixels: partly its chord, so that a ribbon does not turn over
        const double height = x.scalar(3) * x.scalar(3, 1);
        const glm::dvec3 tangent = (axisAt(x, height) - axisAt(x, height - 0.02)) / (0.02 * kCoat);
        const glm::dvec3 chord = x.vec3(0) + x.scalar(3) * x.vec3(1);
        const double pixels = kCoat * x.scalar(3) * kPerMm / glm::length(x.vec3(4)) / kFurPixel;
        return values(glm::mix(tangent, chord, 0.6 * std::clamp(2 - pixels / 4, 0.0, 1.0)));
    }));
    return cases;
}

std::vector<FunctionCase> vertices() {
    std::vector<FunctionCase> cases;
    for (const bool core : {false, true}) {
        const auto distance = [](const Inputs& x) { return glm::length(kFurEye - furWorld(x.vec3(0))); };
        cases.push_back(strandRootCase(
            "strandVarying",
            std::string("TgVertexInput i = (TgVertexInput)0; i.normal = float3(0, 0, 1); i.position = a0; i.tangent.w = a2 > 0.5 ? 1 : -1; "
                        "i.uv = float2(a3 / 32.0, a1); RibbonVarying v = strandVarying(i, ") +
                (core ? "true" : "false") + "); return float4(v.edge, v.color.w, 0);",
            {linear(-1500, 1500, 3), whole(4000, 8000), whole(0, 1), whole(0, 31)},
            [=](const Inputs& x) {
                const double address = std::round(x.scalar(1));
                const double pixel = kFurPixel * distance(x);
                const bool thin = 2 * strandWidest() < 0.7 * pixel;
                if (address < 4096 || rootRank(address) >= kStrandShare || (core && thin)) return values(0);
                const double radius = strandRadius(address, 0) * (1 - std::round(x.scalar(3)) / 31) / pixel;
                const double half = std::max(radius, 0.5);
                return values((x.scalar(2) > 0.5 ? 1 : -1) * (half + 0.4), half, radius / half);
            },
            {.forward = 32, .backward = 2, .absolute = 1e-4, .why = "a coat of 1e-5 mm beside distances of up to 4,000"}));
        flattenStrands(cases.back());
        cases.back().domain = [=](const Inputs& x) {
            return std::abs(rootRank(std::round(x.scalar(1))) - kStrandShare) > 2e-3 &&
                   std::abs(2 * strandWidest() / (0.7 * kFurPixel * distance(x)) - 1) > 1e-4;
        };
    }
    return cases;
}

} // namespace

std::vector<FunctionCase> strandRibbonCases() {
    return together(colours(), places(), vertices());
}

} // namespace tegument::test
