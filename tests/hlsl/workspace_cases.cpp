// hlsl/workspace.fxh against docs/conventions.md: places, directions and lengths under any world matrix, in any unit, under both kinds of
// light.

#include "tests/hlsl/function_case.h"

namespace tegument::test {

namespace {

using Numbers = std::vector<double>;
using Globals = std::map<std::string, Numbers>;

/// Rows of the row-vector matrix, as in host/scene/view.h: m[row][column].
dmat4 matrix(const Numbers& rows) {
    dmat4 m;
    for (glm::length_t row = 0; row < 4; ++row)
        for (glm::length_t column = 0; column < 4; ++column)
            m[row][column] = rows[static_cast<std::size_t>(4 * row + column)];
    return m;
}

Numbers rowsOf(const dmat4& m) {
    Numbers rows;
    for (glm::length_t row = 0; row < 4; ++row)
        for (glm::length_t column = 0; column < 4; ++column)
            rows.push_back(static_cast<double>(static_cast<float>(m[row][column])));
    return rows;
}

/// Scaled along its own axes, then turned, then moved: what a host makes of a placement.
dmat4 world(const dvec3& scale) {
    const dvec3 x = normalize(dvec3(0.6, -0.5, 0.3));
    const dvec3 z = normalize(cross(x, dvec3(0.2, 1, -0.4)));
    dmat4 m(1);
    m[0] = dvec4(scale.x * x, 0);
    m[1] = dvec4(scale.y * cross(z, x), 0);
    m[2] = dvec4(scale.z * z, 0);
    m[3] = dvec4(10, -20, 30, 1);
    return m;
}

/// A head in metres in a world of millimetres; the other way round, mirrored; scaled unevenly, mirrored by two axes, which is a rotation.
const std::vector<dvec3> kScales = {{1, 1, 1}, {1000, 1000, 1000}, {-1e-3, 1e-3, 1e-3}, {0.5, 2, -3}, {-1, -1, 2}};

Globals worldGlobals(const dvec3& scale) {
    const dmat4 m = world(scale);
    return {{"gWorld", rowsOf(m)}, {"gWorldInverseTranspose", rowsOf(transpose(inverse(m)))}};
}

/// mul(v, m) of a direction.
dvec3 along(const dvec3& v, const dmat4& m) {
    return v.x * dvec3(m[0]) + v.y * dvec3(m[1]) + v.z * dvec3(m[2]);
}

/// What a surface with this normal has as its normal once the world has been through it: across two of its tangents where they have gone.
dvec3 normalInWorld(const dvec3& normal, const dmat4& m) {
    const dvec3 aside = normalize(cross(normal, abs(normal.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
    const dvec3 across = cross(along(aside, m), along(cross(normal, aside), m));
    return normalize(glm::determinant(dmat3(m)) < 0 ? -across : across);
}

void addWorld(Cases& cases, const dvec3& scale) {
    const Globals globals = worldGlobals(scale);
    const dmat4 m = matrix(globals.at("gWorld"));
    const double size = max({abs(scale.x), abs(scale.y), abs(scale.z)});
    cases.add("tgWorldPosition(a0)", {vector(3, 1e-3, 1e3)},
              {4, 4, 1e-5 + 2e-4 * size, "three products and sums that may cancel against the translation of 30 mm, or each other"},
              {.globals = globals}, [m](In x) { return along(x.vec3(0), m) + dvec3(m[3]); });
    cases.add("tgWorldNormal(a0)", {unit()}, {8, 4, 1e-6, "a rounded inverse; sums that may cancel, normalised"}, {.globals = globals},
              [m](In x) { return normalInWorld(normalize(x.vec3(0)), m); });
    cases.back().domain = [](In x) { return length(x.vec3(0)) > 0.5; };
    cases.add("tgWorldTangent(float4(a0, a1))", {unit(), linear(-1, 1)}, {8, 4, 1e-6, "sums that may cancel, normalised"},
              {.globals = globals}, [m](In x) {
                  const double sign = glm::determinant(dmat3(m)) < 0 ? -1 : 1;
                  return dvec4(normalize(along(x.vec3(0), m)), sign * x[1]);
              });
    cases.back().domain = [](In x) { return length(x.vec3(0)) > 0.5; };
    // A way along the mesh's axes, of the length that it has in the world, comes back as it was.
    cases.add("tgMeshAxes(a0)", {vector(3, 1e-3, 1e3)}, {8, 4, 2e-4, "dot products of up to 1e3 that may cancel"}, {.globals = globals},
              [m](In x) {
                  dvec3 way;
                  for (glm::length_t axis = 0; axis < 3; ++axis)
                      way[axis] = dot(x.vec3(0), normalize(dvec3(m[axis])));
                  return way;
              });
}

struct LightView {
    Globals globals;
    dvec3 right, up, back, position;
    double half; // of the view, for each unit of w
    bool parallel;
};

/// A pyramid of 40 degrees, and a box 120 units wide, from the same place.
LightView lightView(bool parallel) {
    LightView light{.position = {-300, 250, 400}, .half = parallel ? 60 : tan(0.35), .parallel = parallel};
    light.back = normalize(light.position);
    light.right = normalize(cross(dvec3(0, 1, 0), light.back));
    light.up = cross(light.back, light.right);
    const double nearPlane = parallel ? 0 : 300;
    const double farPlane = 800;
    dmat4 view(1);
    for (glm::length_t row = 0; row < 3; ++row)
        view[row] = dvec4(light.right[row], light.up[row], light.back[row], 0);
    view[3] = dvec4(-dot(light.position, light.right), -dot(light.position, light.up), -dot(light.position, light.back), 1);
    dmat4 projection(0);
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

void addLight(Cases& cases, bool parallel) {
    const LightView light = lightView(parallel);
    const auto add = [&](const std::string& function, const std::string& call, Reference expected, double absolute) {
        cases.add({function, "return float4(" + call + ");"}, {vector(3, 1e-2, 300)},
                  {8, 4, absolute, "columns of a product of matrices, rounded; lengths of 500"}, {.globals = light.globals},
                  std::move(expected));
    };
    add(
        "tgLightParallel", "tgLightParallel() ? 1.0 : 0.0, 0, 0, 0", [parallel](In) { return parallel ? 1 : 0; }, 0);
    add(
        "tgLightRays", "tgLightRays(), 0", [light](In) { return -light.back; }, 2e-6);
    add(
        "tgLightRight", "tgLightRight(), 0", [light](In) { return light.right; }, 2e-6);
    add(
        "tgLightUp", "tgLightUp(), 0", [light](In) { return light.up; }, 2e-6);
    add(
        "tgLightSpread", "tgLightSpread(), 0, 0, 0", [light](In) { return 25.4 * light.half; }, 25.4 * light.half * 1e-6);
    add(
        "tgLightVector", "tgLightVector(a0), 0",
        [light](In x) {
            const dvec3 way = light.position - x.vec3(0);
            return light.parallel ? dot(way, light.back) * light.back : way;
        },
        2e-3);
    // Before the plane of parallel light its direction does not turn round.
    add(
        "tgLightDirection", "tgLightDirection(4.0 * a0), 0",
        [light](In x) { return light.parallel ? light.back : normalize(light.position - 4.0 * x.vec3(0)); }, 5e-6);
    cases.back().domain = [light](In x) { return length(light.position - 4.0 * x.vec3(0)) > 50; };
}

} // namespace

Cases workspaceCases() {
    Cases cases;
    for (const dvec3& scale : kScales)
        addWorld(cases, scale);
    for (const bool parallel : {false, true})
        addLight(cases, parallel);
    cases.add({"tgMillimetres", "return float4(tgMillimetres(a0), tgMillimetres(a0.x));"}, {vector(3, 1e-3, 1e3)}, {1, 0, 0, "one product"},
              {.globals = {{"gUnitMm", {1000}}}}, [](In x) { return dvec4(1000.0 * x.vec3(0), 1000 * x[0]); });
    cases.add("tgWorldUnit(a0)", {vector(3, 1e-9, 1e9)}, {6, 2, 0, "a dot product, rsqrt (2 ULP in Vulkan), a product"},
              [](In x) { return x.vec3(0) / max(length(x.vec3(0)), 1e-15); });
    cases.back().domain = [](In x) { return length(x.vec3(0)) > 1e-10; };
    return cases;
}

} // namespace tegument::test
