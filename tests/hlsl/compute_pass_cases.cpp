// What compute shaders of effects work out for themselves (effects/passes/pyramid_compute.fxh, fur_compute.fxh) in double precision.

#include "tests/hlsl/pass_case.h"

namespace tegument::test {

namespace {

FunctionCase computed(const char* effect, Call call, Arguments arguments, Tolerance tolerance, Reference expected) {
    return passCase(effect,
                    {{"gViewportSize", {640, 480}},
                     {"gViewProjectionInverse", {2, 0, 0.5, 0, 0, 3, 0, 0.1, 0.2, 0, 4, -0.5, 5, 6, 7, 2}},
                     {"gCoatSegments", {6}}},
                    std::move(call), std::move(arguments), std::move(tolerance), std::move(expected));
}

/// Where the ray along a direction meets |x| + |y| + |z| = 1; what is below goes over the nearest edge of the square and comes to lie
/// outside.
dvec2 onOctahedron(const dvec3& n) {
    const dvec3 p = n / (abs(n.x) + abs(n.y) + abs(n.z));
    if (p.z >= 0) return {p.x, p.y};
    return {std::copysign(1 - abs(p.y), p.x), std::copysign(1 - abs(p.x), p.y)};
}

bool isDirection(const dvec3& n) {
    return abs(length(n) - 1) < 1e-3 && min({abs(n.x), abs(n.y), abs(n.z)}) > 1e-4;
}

double stepSquared(const dvec2& after, const dvec2& before) {
    const double least = min(dot(after, after), dot(before, before));
    const double most = max(dot(after, after), dot(before, before));
    if (most < 2 * least) return dot(after - before, after - before) / 4;
    return least < 1 ? least : 0;
}

void places(Cases& cases) {
    const Tolerance plain{8, 4, 1e-6, "quotients of sums of up to 3"};
    cases += computed("Pyramid.fx", "octahedral(a0)", {unit()}, plain, [](In x) { return onOctahedron(x.vec3(0)); });
    cases.back().domain = [](In x) { return isDirection(x.vec3(0)); };
    cases += computed("Pyramid.fx", "fromOctahedral(octahedral(a0))", {unit()}, plain, [](In x) { return normalize(x.vec3(0)); });
    cases.back().domain = [](In x) { return isDirection(x.vec3(0)); };
    cases += computed("Pyramid.fx", "stepBetween(a0, a1)", {linear(-1.2, 1.2, 2), linear(-1.2, 1.2, 2)}, plain,
                      [](In x) { return stepSquared(x.vec2(0), x.vec2(1)); });
    cases.back().domain = [](In x) {
        const double a = dot(x.vec2(0), x.vec2(0));
        const double b = dot(x.vec2(1), x.vec2(1));
        return abs(max(a, b) - 2 * min(a, b)) > 1e-4 && abs(min(a, b) - 1) > 1e-4;
    };
    cases += computed("Pyramid.fx", "placeWorld(uint2(a0, a1), a2)", {whole(0, 639), whole(0, 479), linear(0, 1)},
                      {8, 4, 1e-5, "sums of up to 12, a quotient"}, [](In x) {
                          const double u = (2 * round(x[0]) + 1) / 640 - 1;
                          const double v = 1 - (2 * round(x[1]) + 1) / 480;
                          const double d = x[2];
                          const double w = 0.1 * v - 0.5 * d + 2;
                          return dvec3(2 * u + 0.2 * d + 5, 3 * v + 6, 0.5 * u + 4 * d + 7) / w;
                      });
}

/// Rows of a strand's vertices stand closer at its tip: a parabola, in whole parts of 31.
double alongRow(double row, double segments) {
    const double t = row / segments;
    return floor(31 * (1.25 * t - 0.25 * t * t) + 0.5) / 31;
}

void rows(Cases& cases) {
    for (const int segments : {6, 15}) { // of 15 a row lies just below the middle between two parts
        cases += computed("FurCoat.fx", {"ribbonAlong", "return float4(ribbonAlong(a0), ribbonSegments(), 0, 0);"}, {whole(0, segments)},
                          {4, 0, 0, "whole parts of 31"}, [segments](In x) { return values(alongRow(round(x[0]), segments), segments); });
        cases.back().globals["gCoatSegments"] = {static_cast<double>(segments)};
    }
    // the row that is nearest there
    cases += computed("FurCoat.fx", "ribbonRow(a0 / 31.0)", {whole(0, 31)}, {0, 0, 0, "whole numbers"}, [](In x) {
        const double along = round(x[0]) / 31;
        return round((2.5 - sqrt(6.25 - 4 * along)) * 6);
    });
    cases += computed("FurCoat.fx", "ribbonRow(ribbonAlong(a0))", {whole(0, 6)}, {0, 0, 0, "the reverse of each other"},
                      [](In x) { return round(x[0]); });
}

} // namespace

Cases computePassCases() {
    return together(places, rows);
}

} // namespace tegument::test
