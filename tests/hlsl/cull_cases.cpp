// hlsl/cull against the definitions of docs/design/skin.md (passes 2, 3).

#include "tests/hlsl/maps.h"

namespace tegument::test {

namespace {

bool outside(const dvec4& clip) {
    return clip.w <= 0 || abs(clip.x) > clip.w || abs(clip.y) > clip.w;
}

} // namespace

Cases cullCases() {
    Cases cases;
    cases.add("tgCullOutside(a0) ? 1 : 0", {vector(4, 0.1, 1000)}, {0, 0, 0, "comparisons of given numbers"},
              [](In x) { return outside(x.vec4(0)) ? 1 : 0; });
    cases.add("tgCullOutsideView(a0) ? 1 : 0", {vector(4, 0.1, 1000)}, {0, 4, 0, "quotients against a threshold"}, {.settings = {0, 1, 2}},
              [](In x) {
                  if (x.corrected()) return outside(x.vec4(0)) ? 1 : 0;
                  const double w = abs(x.scalar(0, 3)) > 1e-6 ? x.scalar(0, 3) : 1e-6;
                  return x[0] / w > 1 || x.scalar(0, 1) / w > 1 ? 1 : 0;
              });
    cases.add("tgCullBackFace(a0, a1, a2) ? 1 : 0", {unit(), unit(), linear(0, 0.5)}, {0, 4, 0, "a dot product against a threshold"},
              [](In x) { return dot(x.vec3(0), x.vec3(1)) < -x[2] ? 1 : 0; });
    cases.add("tgCullBlack(a0) ? 1 : 0", {linear(0, 0.002, 3)}, {0, 2, 0, "a comparison with a rounded constant"}, {.settings = {0, 2}},
              [](In x) {
                  const dvec3 c = x.vec3(0);
                  return max({c.x, c.y, c.z}) <= (x.corrected() ? 2 / 255.0 / 12.92 : 0) ? 1 : 0;
              });
    return cases;
}

} // namespace tegument::test
