// Fur on a body that bends (effects/passes/fur_pose.fxh), and how far it has moved since the frame before (fur_motion.fxh), in double
// precision: turns by quaternions of their own, and places before and after.

#include "tests/hlsl/lock_scene.h"
#include "tests/hlsl/maps.h"

#include <glm/gtc/quaternion.hpp>

namespace tegument::test {

namespace {

const dvec3 kMovedBy = {4, -3, 2}; // of the mesh in the frame before
const dvec3 kEye = {0, 0, 600};
const dvec3 kBlownMore = {0.2, 0.1, -0.15};
const dvec3 kBlown = {0.3, -0.2, 0.1};

FunctionCase bodyCase(Call call, Arguments arguments, Tolerance tolerance, Reference expected) {
    const Globals more = {
        {"gPreviousWorld", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, kMovedBy.x, kMovedBy.y, kMovedBy.z, 1}}, // a quarter turn about z
        {"gPreviousViewProjection", {1.2, 0, 0, 0, 0, 1.4, 0, 0, 0, 0, -1.1, -1, 9, 6, 300, 410}},
        {"gCameraPosition", numbersOf(kEye)}};
    return passCase("FurCoat.fx", with(with(kLockScene, kFurView), more), std::move(call), std::move(arguments), std::move(tolerance),
                    std::move(expected));
}

/// How roots have moved and turned: whole texels of numbers that are no rule's.
const TestMap& poseMap() {
    static const TestMap kMap = [] {
        TestMap map{.size = 4096, .texels = std::vector<std::array<float, 4>>(2 * 4096), .height = 2};
        for (std::size_t at = 0; at < map.texels.size(); ++at) {
            const auto i = static_cast<double>(at);
            const glm::dquat turn = normalize(glm::dquat(sin(i) + 1.5, sin(2 * i), cos(3 * i), sin(5 * i)));
            map.texels[at] = texelOf(turn.x, turn.y, turn.z, turn.w);
        }
        return map;
    }();
    return kMap;
}

dvec4 poseAt(double address, std::size_t number) {
    if (address < 4096) return dvec4(0); // skin comes posed
    const auto& texel = poseMap().texels[static_cast<std::size_t>(std::llround(address)) + number];
    return {texel[0], texel[1], texel[2], texel[3]};
}

dvec3 turnedBy(const dvec4& turn, const dvec3& v) {
    if (length(turn) < 0.5) return v; // zeros turn nothing
    return glm::dquat(turn.w, turn.x, turn.y, turn.z) * v;
}

void poses(Cases& cases) {
    static const TestMap kHeader = oneTexel(2); // rows of the texture
    const Tolerance plain{8, 4, 2e-6, "two vector products of numbers up to 1"};
    const Arguments arguments = {whole(4000, 8000), linear(-1, 1, 3)};
    const auto add = [&](Call call, Reference expected) {
        cases += bodyCase(std::move(call), arguments, plain, std::move(expected));
        cases.back().map = &kHeader;
        cases.back().maps["gFurPoseMap"] = &poseMap();
        cases.back().defines.emplace_back("TEGUMENT_FUR_POSE", "1");
    };
    add({"furPoseTexel", "return furPoseTexel(gFurPoseMap, gFurPose, a0, 1.0);"}, [](In x) { return poseAt(x[0], 1); });
    add({"furPoseTexel", "return furPoseTexel(gFurPoseMap, gFurPose, a0, 0.0);"}, [](In x) { return poseAt(x[0], 0); });
    add({"furPoseTurned", "return float4(furPoseTurned(a1, furPoseTexel(gFurPoseMap, gFurPose, a0, 1.0)), 0);"},
        [](In x) { return turnedBy(poseAt(x[0], 1), x.vec3(1)); });
    add({"furPoseMatrix", "return float4(mul(a1, furPoseMatrix(gFurPoseMap, gFurPose, a0)), 0);"},
        [](In x) { return turnedBy(poseAt(x[0], 1), x.vec3(1)); });
    const char* vertex = "TgVertexInput i = (TgVertexInput)0; i.position = a1; i.normal = a1.yzx; i.tangent = float4(a1.zxy, 0.5); "
                         "i.uv = float2(3, a0); TgMeshInput m = meshVertex(i); ";
    add({"furPosed", std::string(vertex) + "return float4(m.position, m.uv.x);"},
        [](In x) { return dvec4(x.vec3(1) + dvec3(poseAt(x[0], 0)), 3); });
    add({"furPosed", std::string(vertex) + "return float4(m.normal, 0);"}, [](In x) {
        const dvec3 v = x.vec3(1);
        return turnedBy(poseAt(x[0], 1), {v.y, v.z, v.x});
    });
    add({"furPosed", std::string(vertex) + "return m.tangent;"}, [](In x) {
        const dvec3 v = x.vec3(1);
        return dvec4(turnedBy(poseAt(x[0], 1), {v.z, v.x, v.y}), 0.5);
    });
}

dvec4 clipBefore(const dvec3& p) {
    return {1.2 * p.x + 9, 1.4 * p.y + 6, -1.1 * p.z + 300, -p.z + 410};
}

dvec3 turnedBefore(const dvec3& v) {
    return {-v.y, v.x, v.z};
}

/// Pixels, right and down.
dvec2 moved(const dvec4& now, const dvec4& before) {
    const dvec2 way(now.x / now.w - before.x / before.w, now.y / now.w - before.y / before.w);
    return way * dvec2(320, -240);
}

void motions(Cases& cases) {
    const Tolerance pictures{16, 2, 1e-3, "differences of places in a picture of 640 pixels"};
    const auto add = [&](Call call, Arguments arguments, Reference expected) {
        cases += bodyCase(std::move(call), std::move(arguments), pictures, std::move(expected));
        cases.back().defines.emplace_back("TEGUMENT_MOTION", "1");
    };
    add({"motionOf", "return float4(motionOf(float4(a0, 0, a1), float4(a2, 0, a3)), 0, 0);"},
        {linear(-1, 1, 2), linear(1, 3), linear(-1, 1, 2), linear(1, 3)},
        [](In x) { return moved(dvec4(x.vec2(0), 0, x[1]), dvec4(x.vec2(2), 0, x[3])); });
    const char* vertex = "TgVertexInput i = (TgVertexInput)0; i.position = a0; ";
    add({"SkinMotionVS", std::string(vertex) + "return SkinMotionVS(i).now;"}, {linear(-80, 80, 3)},
        [](In x) { return furClip(x.vec3(0)); });
    add({"SkinMotionVS", std::string(vertex) + "return SkinMotionVS(i).before;"}, {linear(-80, 80, 3)},
        [](In x) { return clipBefore(turnedBefore(x.vec3(0)) + kMovedBy); });
    add({"SkinMotionPS", std::string(vertex) + "return SkinMotionPS(SkinMotionVS(i));"}, {linear(-80, 80, 3)},
        [](In x) { return dvec4(moved(furClip(x.vec3(0)), clipBefore(turnedBefore(x.vec3(0)) + kMovedBy)), 0, 1); });
    add({"ribbonWorldBefore", std::string(vertex) + "return float4(ribbonWorldBefore(a1, i), 0);"}, {linear(-80, 80, 3), linear(-9, 9, 3)},
        [](In x) { return turnedBefore(x.vec3(0) + x.vec3(1)) + kMovedBy; });
}

/// A lock's strand that stands upright, without waves and curls, blown aside. Arguments: position, address, row of 31, child.
struct BlownStrand {
    dvec3 position;
    double address, child;
    LockShare drawn;
    double along, height, radius;

    explicit BlownStrand(In x)
        : position(x.vec3(0)), address(round(x[1])), child(round(x[3])),
          drawn(kFurPixel * length(kEye - position), 0.7, 4, child + rootRank(address)), along(max(round(x[2]) / 31, drawn.begin)),
          radius(drawn.width * lockRadius(address, child, false, along)) {
        const dvec3 random = lockNumbers(address, child);
        height = kLockLength * kLockMesh * (0.75 + 0.3 * lockMore(random).x + (random.z <= 0.5 ? 0.35 : 0));
    }
    /// Of the axis from the root, with the wind that was there; across the normal z only.
    [[nodiscard]] dvec3 offset(const dvec3& wind) const { return height * (dvec3(0, 0, along) + dvec3(wind.x, wind.y, 0) * along * along); }
};

Cases locks() {
    FunctionCase made =
        bodyCase({"LocksMotionVS",
                  "TgVertexInput i = (TgVertexInput)0; i.normal = float3(0, 0, 1); i.position = a0; i.tangent.w = 1; i.uv = float2(a2 / "
                  "32.0, a1); RibbonVarying v = LocksMotionVS(i, (uint)a3); return float4(v.color.rg / 100.0, v.edge);"},
                 {linear(-150, 150, 3), whole(4096, 4000000), whole(0, 31), whole(0, 3)},
                 {32, 2, 2e-3, "ranks of addresses to 1e-3, eight times"}, [](In x) {
                     const BlownStrand s(x);
                     if (s.drawn.rank >= s.drawn.share) return values(0);
                     const dvec3 before =
                         turnedBefore(s.position + s.offset(turnedBefore(turnedBefore(turnedBefore(kBlown - kBlownMore))))) + kMovedBy;
                     const dvec3 offset = s.offset(kBlown);
                     const dvec2 motion = moved(furClip(s.position + offset), clipBefore(before));
                     const double pixel = kFurPixel * length(kEye - s.position - offset);
                     const double half = max(s.radius / pixel, 0.5);
                     return values(motion.x / 100, motion.y / 100, half + 0.4, half);
                 });
    made.defines.emplace_back("TEGUMENT_MOTION", "1");
    straighten(made);
    made.globals["gCoatGusts"] = {0, 0.7, 0.8};
    made.globals["gCoatGuard"] = {0.5};
    made.globals["gCoatWind"] = numbersOf(kBlown);
    made.globals["gCoatWindChange"] = numbersOf(kBlownMore);
    made.globals["gFurEdge"] = {0.4};
    made.globals["gTimeStep"] = {0.1};
    made.domain = [](In x) {
        const BlownStrand s(x);
        const double fraction = rootRank(s.address);
        return abs(s.drawn.rank - s.drawn.share) > 2e-3 && min(fraction, 1 - fraction) > 2e-3;
    };
    return {made};
}

} // namespace

Cases furMotionCases() {
    return together(poses, motions, locks());
}

} // namespace tegument::test
