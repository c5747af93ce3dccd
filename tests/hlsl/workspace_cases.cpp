// hlsl/workspace.fxh against docs/conventions.md: places, directions and lengths under any world matrix, in any unit, under both kinds of
// light.

#include "tests/hlsl/function_case.h"

#include <algorithm>
#include <cmath>

namespace tegument::test {

namespace {

using Numbers = std::vector<double>;
using Globals = std::map<std::string, Numbers>;

/// Rows of the row-vector matrix, as in host/scene/view.h: m[row][column].
glm::dmat4 matrix(const Numbers& rows) {
    glm::dmat4 m;
    for (glm::length_t row = 0; row < 4; ++row)
        for (glm::length_t column = 0; column < 4; ++column)
            m[row][column] = rows[static_cast<std::size_t>(4 * row + column)];
    return m;
}

Numbers rowsOf(const glm::dmat4& m) {
    Numbers rows;
    for (glm::length_t row = 0; row < 4; ++row)
        for (glm::length_t column = 0; column < 4; ++column)
            rows.push_back(static_cast<double>(static_cast<float>(m[row][column])));
    return rows;
}

/// Scaled along its own axes, then turned, then moved: what a host makes of a placement.
glm::dmat4 world(const glm::dvec3& scale) {
    const glm::dvec3 x = glm::normalize(glm::dvec3(0.6, -0.5, 0.3));
    const glm::dvec3 z = glm::normalize(glm::cross(x, glm::dvec3(0.2, 1, -0.4)));
    glm::dmat4 m(1);
    m[0] = glm::dvec4(scale.x * x, 0);
    m[1] = glm::dvec4(scale.y * glm::cross(z, x), 0);
    m[2] = glm::dvec4(scale.z * z, 0);
    m[3] = glm::dvec4(10, -20, 30, 1);
    return m;
}

/// A head in metres in a world of millimetres; the other way round, mirrored; scaled unevenly, mirrored by two axes, which is a rotation.
const std::vector<glm::dvec3> kScales = {{1, 1, 1}, {1000, 1000, 1000}, {-1e-3, 1e-3, 1e-3}, {0.5, 2, -3}, {-1, -1, 2}};

Globals worldGlobals(const glm::dvec3& scale) {
    const glm::dmat4 m = world(scale);
    return {{"gWorld", rowsOf(m)}, {"gWorldInverseTranspose", rowsOf(glm::transpose(glm::inverse(m)))}};
}

/// mul(v, m) of a direction.
glm::dvec3 along(const glm::dvec3& v, const glm::dmat4& m) {
    return v.x * glm::dvec3(m[0]) + v.y * glm::dvec3(m[1]) + v.z * glm::dvec3(m[2]);
}

/// What a surface with this normal has as its normal once the world has been through it: across two of its tangents where they have gone.
glm::dvec3 normalInWorld(const glm::dvec3& normal, const glm::dmat4& m) {
    const glm::dvec3 aside = glm::normalize(glm::cross(normal, std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 across = glm::cross(along(aside, m), along(glm::cross(normal, aside), m));
    return glm::normalize(glm::determinant(glm::dmat3(m)) < 0 ? -across : across);
}

void addWorld(std::vector<FunctionCase>& cases, const glm::dvec3& scale) {
    const Globals globals = worldGlobals(scale);
    const glm::dmat4 m = matrix(globals.at("gWorld"));
    const double size = std::max({std::abs(scale.x), std::abs(scale.y), std::abs(scale.z)});
    cases.push_back({.function = "tgWorldPosition",
                     .body = "return float4(tgWorldPosition(a0), 0);",
                     .arguments = {vector(3, 1e-3, 1e3)},
                     .expected = [m](const Inputs& x) { return values(along(x.vec3(0), m) + glm::dvec3(m[3])); },
                     .tolerance = {.forward = 4,
                                   .backward = 4,
                                   .absolute = 1e-5 + 2e-4 * size,
                                   .why = "three products and sums that may cancel against the translation of 30 mm, or each other"},
                     .globals = globals});
    cases.push_back(
        {.function = "tgWorldNormal",
         .body = "return float4(tgWorldNormal(a0), 0);",
         .arguments = {unit()},
         .expected = [m](const Inputs& x) { return values(normalInWorld(glm::normalize(x.vec3(0)), m)); },
         .tolerance = {.forward = 8, .backward = 4, .absolute = 1e-6, .why = "a rounded inverse; sums that may cancel, normalised"},
         .globals = globals,
         .domain = [](const Inputs& x) { return glm::length(x.vec3(0)) > 0.5; }});
    cases.push_back({.function = "tgWorldTangent",
                     .body = "return tgWorldTangent(float4(a0, a1));",
                     .arguments = {unit(), linear(-1, 1)},
                     .expected =
                         [m](const Inputs& x) {
                             const double sign = glm::determinant(glm::dmat3(m)) < 0 ? -1 : 1;
                             return values(glm::dvec4(glm::normalize(along(x.vec3(0), m)), sign * x.scalar(1)));
                         },
                     .tolerance = {.forward = 8, .backward = 4, .absolute = 1e-6, .why = "sums that may cancel, normalised"},
                     .globals = globals,
                     .domain = [](const Inputs& x) { return glm::length(x.vec3(0)) > 0.5; }});
    // A way along the mesh's axes, of the length that it has in the world, comes back as it was.
    cases.push_back({.function = "tgMeshAxes",
                     .body = "return float4(tgMeshAxes(a0), 0);",
                     .arguments = {vector(3, 1e-3, 1e3)},
                     .expected =
                         [m](const Inputs& x) {
                             glm::dvec3 way;
                             for (glm::length_t axis = 0; axis < 3; ++axis)
                                 way[axis] = glm::dot(x.vec3(0), glm::normalize(glm::dvec3(m[axis])));
                             return values(way);
                         },
                     .tolerance = {.forward = 8, .backward = 4, .absolute = 2e-4, .why = "dot products of up to 1e3 that may cancel"},
                     .globals = globals});
}

struct LightView {
    Globals globals;
    glm::dvec3 right, up, back, position;
    double half; // of the view, for each unit of w
    bool parallel;
};

/// A pyramid of 40 degrees, and a box 120 units wide, from the same place.
LightView lightView(bool parallel) {
    LightView light{.position = {-300, 250, 400}, .half = parallel ? 60 : std::tan(0.35), .parallel = parallel};
    light.back = glm::normalize(light.position);
    light.right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), light.back));
    light.up = glm::cross(light.back, light.right);
    const double nearPlane = parallel ? 0 : 300;
    const double farPlane = 800;
    glm::dmat4 view(1);
    for (glm::length_t row = 0; row < 3; ++row)
        view[row] = glm::dvec4(light.right[row], light.up[row], light.back[row], 0);
    view[3] =
        glm::dvec4(-glm::dot(light.position, light.right), -glm::dot(light.position, light.up), -glm::dot(light.position, light.back), 1);
    glm::dmat4 projection(0);
    projection[0][0] = projection[1][1] = 1 / light.half;
    projection[2][2] = parallel ? 1 / (nearPlane - farPlane) : farPlane / (nearPlane - farPlane);
    projection[2][3] = parallel ? 0 : -1;
    projection[3][2] = parallel ? 0 : nearPlane * farPlane / (nearPlane - farPlane);
    projection[3][3] = parallel ? 1 : 0;
    light.globals = {{"gLightViewProjection", rowsOf(projection * view)},
                     {"gLightPosition", {light.position.x, light.position.y, light.position.z}},
                     {"gUnitMm", {25.4}}};
    return light;
}

void addLight(std::vector<FunctionCase>& cases, bool parallel) {
    const LightView light = lightView(parallel);
    const auto add = [&](const std::string& function, const std::string& call, std::function<Values(const Inputs&)> expected,
                         double absolute) {
        cases.push_back({.function = function,
                         .body = "return float4(" + call + ");",
                         .arguments = {vector(3, 1e-2, 300)},
                         .expected = std::move(expected),
                         .tolerance = {.forward = 8,
                                       .backward = 4,
                                       .absolute = absolute,
                                       .why = "columns of a product of matrices, rounded; lengths of 500"},
                         .globals = light.globals});
    };
    add(
        "tgLightParallel", "tgLightParallel() ? 1.0 : 0.0, 0, 0, 0", [parallel](const Inputs&) { return values(parallel ? 1 : 0); }, 0);
    add(
        "tgLightRays", "tgLightRays(), 0", [light](const Inputs&) { return values(-light.back); }, 2e-6);
    add(
        "tgLightRight", "tgLightRight(), 0", [light](const Inputs&) { return values(light.right); }, 2e-6);
    add(
        "tgLightUp", "tgLightUp(), 0", [light](const Inputs&) { return values(light.up); }, 2e-6);
    add(
        "tgLightSpread", "tgLightSpread(), 0, 0, 0", [light](const Inputs&) { return values(25.4 * light.half); },
        25.4 * light.half * 1e-6);
    add(
        "tgLightVector", "tgLightVector(a0), 0",
        [light](const Inputs& x) {
            const glm::dvec3 way = light.position - x.vec3(0);
            return values(light.parallel ? glm::dot(way, light.back) * light.back : way);
        },
        2e-3);
    // Before the plane of parallel light its direction does not turn round.
    add(
        "tgLightDirection", "tgLightDirection(4.0 * a0), 0",
        [light](const Inputs& x) { return values(light.parallel ? light.back : glm::normalize(light.position - 4.0 * x.vec3(0))); }, 5e-6);
    cases.back().domain = [light](const Inputs& x) { return glm::length(light.position - 4.0 * x.vec3(0)) > 50; };
}

} // namespace

std::vector<FunctionCase> workspaceCases() {
    std::vector<FunctionCase> cases;
    for (const glm::dvec3& scale : kScales)
        addWorld(cases, scale);
    for (const bool parallel : {false, true})
        addLight(cases, parallel);
    cases.push_back({.function = "tgMillimetres",
                     .body = "return float4(tgMillimetres(a0), tgMillimetres(a0.x));",
                     .arguments = {vector(3, 1e-3, 1e3)},
                     .expected = [](const Inputs& x) { return values(glm::dvec4(1000.0 * x.vec3(0), 1000 * x.scalar(0))); },
                     .tolerance = {.forward = 1, .backward = 0, .why = "one product"},
                     .globals = {{"gUnitMm", {1000}}}});
    cases.push_back({.function = "tgWorldUnit",
                     .body = "return float4(tgWorldUnit(a0), 0);",
                     .arguments = {vector(3, 1e-9, 1e9)},
                     .expected = [](const Inputs& x) { return values(x.vec3(0) / std::max(glm::length(x.vec3(0)), 1e-15)); },
                     .tolerance = {.forward = 6, .backward = 2, .why = "a dot product, rsqrt (2 ULP in Vulkan), a product"},
                     .domain = [](const Inputs& x) { return glm::length(x.vec3(0)) > 1e-10; }});
    return cases;
}

} // namespace tegument::test
