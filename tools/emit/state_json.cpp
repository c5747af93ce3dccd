#include "tools/emit/effect_json.h"

#include <array>
#include <string_view>

namespace tegument {

namespace {

// Direct3D 11's names, in the order of the enumerations of host/support/state.h.
constexpr std::array<std::string_view, 8> kCompare = {"NEVER",   "LESS",      "EQUAL",         "LESS_EQUAL",
                                                      "GREATER", "NOT_EQUAL", "GREATER_EQUAL", "ALWAYS"};
constexpr std::array<std::string_view, 3> kCull = {"NONE", "FRONT", "BACK"};
constexpr std::array<std::string_view, 3> kFill = {"SOLID", "WIREFRAME", "POINT"};
constexpr std::array<std::string_view, 17> kBlend = {
    "ZERO",           "ONE",        "SRC_COLOR",      "INV_SRC_COLOR", "SRC_ALPHA",    "INV_SRC_ALPHA",    "DEST_ALPHA",
    "INV_DEST_ALPHA", "DEST_COLOR", "INV_DEST_COLOR", "SRC_ALPHA_SAT", "BLEND_FACTOR", "INV_BLEND_FACTOR", "SRC1_COLOR",
    "INV_SRC1_COLOR", "SRC1_ALPHA", "INV_SRC1_ALPHA"};
constexpr std::array<std::string_view, 5> kBlendOp = {"ADD", "SUBTRACT", "REV_SUBTRACT", "MIN", "MAX"};
constexpr std::array<std::string_view, 8> kStencil = {"KEEP", "ZERO", "REPLACE", "INCR_SAT", "DECR_SAT", "INVERT", "INCR", "DECR"};
constexpr std::array<std::string_view, 3> kFilter = {"POINT", "LINEAR", "ANISOTROPIC"};
constexpr std::array<std::string_view, 5> kAddress = {"WRAP", "MIRROR", "CLAMP", "BORDER", "MIRROR_ONCE"};

template <std::size_t N, class Enum>
std::string_view named(const std::array<std::string_view, N>& names, Enum value) {
    return names.at(static_cast<std::size_t>(value));
}

Json faceJson(const StencilFace& face) {
    return {{"fail", named(kStencil, face.fail)},
            {"depth_fail", named(kStencil, face.depthFail)},
            {"pass", named(kStencil, face.pass)},
            {"compare", named(kCompare, face.compare)}};
}

Json targetJson(const TargetBlend& target) {
    Json json{{"write_mask", target.writeMask}, {"blend", target.enable}};
    if (!target.enable) return json;
    json["src"] = named(kBlend, target.src);
    json["dest"] = named(kBlend, target.dst);
    json["op"] = named(kBlendOp, target.op);
    json["src_alpha"] = named(kBlend, target.srcAlpha);
    json["dest_alpha"] = named(kBlend, target.dstAlpha);
    json["op_alpha"] = named(kBlendOp, target.opAlpha);
    return json;
}

/// One entry when all targets are alike, else one for each.
Json targetsJson(const std::array<TargetBlend, 8>& targets) {
    Json list = Json::array();
    list.push_back(targetJson(targets[0]));
    bool alike = true;
    for (const TargetBlend& target : targets)
        alike = alike && target == targets[0];
    for (std::size_t i = 1; i < targets.size() && !alike; ++i)
        list.push_back(targetJson(targets.at(i)));
    return list;
}

} // namespace

Json toJson(const PipelineState& state) {
    Json json{{"depth_test", state.depthTest}, {"depth_write", state.depthWrite}, {"depth_compare", named(kCompare, state.depthCompare)}};
    json["stencil_test"] = state.stencilTest;
    if (state.stencilTest)
        json["stencil"] = {{"front", faceJson(state.stencilFront)},
                           {"back", faceJson(state.stencilBack)},
                           {"read_mask", state.stencilReadMask},
                           {"write_mask", state.stencilWriteMask},
                           {"reference", state.stencilReference}};
    json["fill"] = named(kFill, state.fill);
    json["cull"] = named(kCull, state.cull);
    json["front_counter_clockwise"] = state.frontCounterClockwise;
    json["depth_bias"] = state.depthBias;
    json["slope_scaled_depth_bias"] = state.slopeScaledDepthBias;
    json["depth_clip"] = state.depthClip;
    json["scissor_test"] = state.scissorTest;
    json["alpha_to_coverage"] = state.alphaToCoverage;
    json["blend_constant"] = state.blendConstant;
    json["targets"] = targetsJson(state.targets);
    return json;
}

Json toJson(const SamplerState& state) {
    Json json{{"min", named(kFilter, state.minFilter)},
              {"mag", named(kFilter, state.magFilter)},
              {"mip", state.mipmapping ? named(kFilter, state.mipFilter) : "NONE"},
              {"address", {named(kAddress, state.addressU), named(kAddress, state.addressV), named(kAddress, state.addressW)}},
              {"mip_lod_bias", state.mipLodBias},
              {"max_anisotropy", state.maxAnisotropy},
              {"lod", {state.minLod, state.maxLod}},
              {"border", state.borderColor}};
    if (state.compare) json["compare"] = named(kCompare, *state.compare);
    return json;
}

} // namespace tegument
