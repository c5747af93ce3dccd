// hlsl/cull against the definitions of docs/design/skin.md (passes 2, 3).

#include "tests/hlsl/maps.h"

#include <algorithm>
#include <cmath>

namespace tegument::test {

namespace {

bool outside(const glm::dvec4& clip) {
    return clip.w <= 0 || std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w;
}

} // namespace

std::vector<FunctionCase> cullCases() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgCullOutside",
                     .body = "return float4(tgCullOutside(a0) ? 1 : 0, 0, 0, 0);",
                     .arguments = {vector(4, 0.1, 1000)},
                     .expected = [](const Inputs& x) { return values(outside(x.vec4(0)) ? 1 : 0); },
                     .tolerance = {.forward = 0, .backward = 0, .why = "comparisons of given numbers"}});
    cases.push_back({.function = "tgCullOutsideView",
                     .body = "return float4(tgCullOutsideView(a0) ? 1 : 0, 0, 0, 0);",
                     .arguments = {vector(4, 0.1, 1000)},
                     .expected =
                         [](const Inputs& x) {
                             if (x.corrected()) return values(outside(x.vec4(0)) ? 1 : 0);
                             const double w = std::abs(x.scalar(0, 3)) > 1e-6 ? x.scalar(0, 3) : 1e-6;
                             return values(x.scalar(0) / w > 1 || x.scalar(0, 1) / w > 1 ? 1 : 0);
                         },
                     .tolerance = {.forward = 0, .backward = 4, .why = "quotients against a threshold"},
                     .settings = {0, 1, 2}});
    cases.push_back({.function = "tgCullBackFace",
                     .body = "return float4(tgCullBackFace(a0, a1, a2) ? 1 : 0, 0, 0, 0);",
                     .arguments = {unit(), unit(), linear(0, 0.5)},
                     .expected = [](const Inputs& x) { return values(glm::dot(x.vec3(0), x.vec3(1)) < -x.scalar(2) ? 1 : 0); },
                     .tolerance = {.forward = 0, .backward = 4, .why = "a dot product against a threshold"}});
    cases.push_back({.function = "tgCullBlack",
                     .body = "return float4(tgCullBlack(a0) ? 1 : 0, 0, 0, 0);",
                     .arguments = {linear(0, 0.002, 3)},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec3 c = x.vec3(0);
                             return values(std::max({c.x, c.y, c.z}) <= (x.corrected() ? 2 / 255.0 / 12.92 : 0) ? 1 : 0);
                         },
                     .tolerance = {.forward = 0, .backward = 2, .why = "a comparison with a rounded constant"},
                     .settings = {0, 2}});
    return cases;
}

} // namespace tegument::test
