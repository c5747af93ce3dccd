#include "host/effect/states.h"

#include "host/effect/vocabularies.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>

namespace tegument {

namespace {

// Direct3D 9 gives the depth bias in units of depth, Vulkan and Direct3D 10 in smallest resolvable steps: 2^-24 for D24, and for D32F near
// the far plane.
constexpr double kStepsOfDepth = 16777216.0;

using Entry = StateEntry<States>;

template <auto Face>
StencilFace& face(States& states) {
    return states.pipeline.*Face;
}

constexpr auto kFront = &PipelineState::stencilFront;
constexpr auto kBack = &PipelineState::stencilBack;

template <auto Face, auto Member>
void setStencilOp(States& states, int, Numbers v) {
    face<Face>(states).*Member = static_cast<StencilOp>(v[0] - 1);
}

template <auto Face>
void setStencilCompare(States& states, int, Numbers v) {
    face<Face>(states).compare = static_cast<CompareOp>(v[0] - 1);
}

template <auto Member>
void setBool(States& states, int, Numbers v) {
    states.pipeline.*Member = v[0] != 0;
}

template <auto Member>
void setUnsigned(States& states, int, Numbers v) {
    states.pipeline.*Member = static_cast<unsigned>(static_cast<std::int64_t>(v[0]));
}

template <auto Member>
void setFloat(States& states, int, Numbers v) {
    states.pipeline.*Member = static_cast<float>(v[0]);
}

void setDepthCompare(States& states, int, Numbers v) {
    states.pipeline.depthCompare = static_cast<CompareOp>(v[0] - 1);
}

/// The targets that an indexed state means: one, or all of them without an index.
std::span<TargetBlend> targets(States& states, int index) {
    std::span<TargetBlend> all = states.pipeline.targets;
    return index < 0 ? all : all.subspan(static_cast<std::size_t>(index), 1);
}

void setBlendEnable(States& states, int index, Numbers v) {
    for (TargetBlend& target : targets(states, index))
        target.enable = v[0] != 0;
}

template <auto Member>
void setFactor(States& states, int index, Numbers v) {
    for (TargetBlend& target : targets(states, index))
        target.*Member = kBlendFactors[static_cast<std::size_t>(v[0]) - 1];
}

template <auto Member>
void setBlendOp(States& states, int index, Numbers v) {
    for (TargetBlend& target : targets(states, index))
        target.*Member = static_cast<BlendOp>(v[0] - 1);
}

template <int Target>
void setWriteMask(States& states, int index, Numbers v) {
    for (TargetBlend& target : targets(states, Target >= 0 ? Target : index))
        target.writeMask = static_cast<unsigned>(v[0]) & 15u;
}

constexpr Vocabulary kNumber{};

constexpr std::array<Entry, 39> kDirect3D9{{
    {"ZEnable", kDepthBuffer, setBool<&PipelineState::depthTest>},
    {"ZWriteEnable", kBool, setBool<&PipelineState::depthWrite>},
    {"ZFunc", kCompare, setDepthCompare},
    {"AlphaBlendEnable", kBool, setBlendEnable},
    {"SrcBlend", kBlend9, setFactor<&TargetBlend::src>},
    {"DestBlend", kBlend9, setFactor<&TargetBlend::dst>},
    {"BlendOp", kBlendOp, setBlendOp<&TargetBlend::op>},
    {"SeparateAlphaBlendEnable", kBool, [](States& s, int, Numbers v) { s.separateAlpha = v[0] != 0; }},
    {"SrcBlendAlpha", kBlend9, setFactor<&TargetBlend::srcAlpha>},
    {"DestBlendAlpha", kBlend9, setFactor<&TargetBlend::dstAlpha>},
    {"BlendOpAlpha", kBlendOp, setBlendOp<&TargetBlend::opAlpha>},
    {"BlendFactor", kNumber, [](States& s, int, Numbers v) { s.pipeline.blendConstant = colorValue(v); }},
    {"ColorWriteEnable", kWriteMask, setWriteMask<-1>},
    {"ColorWriteEnable1", kWriteMask, setWriteMask<1>},
    {"ColorWriteEnable2", kWriteMask, setWriteMask<2>},
    {"ColorWriteEnable3", kWriteMask, setWriteMask<3>},
    {"CullMode", kCull9,
     [](States& s, int, Numbers v) { s.pipeline.cull = v[0] == 1   ? CullMode::None
                                                       : v[0] == 2 ? CullMode::Front
                                                                   : CullMode::Back; }},
    {"FillMode", kFill9,
     [](States& s, int, Numbers v) { s.pipeline.fill = v[0] == 1   ? FillMode::Point
                                                       : v[0] == 2 ? FillMode::Wireframe
                                                                   : FillMode::Solid; }},
    {"StencilEnable", kBool, setBool<&PipelineState::stencilTest>},
    {"StencilFail", kStencilOp, setStencilOp<kFront, &StencilFace::fail>},
    {"StencilZFail", kStencilOp, setStencilOp<kFront, &StencilFace::depthFail>},
    {"StencilPass", kStencilOp, setStencilOp<kFront, &StencilFace::pass>},
    {"StencilFunc", kCompare, setStencilCompare<kFront>},
    {"StencilRef", kNumber, setUnsigned<&PipelineState::stencilReference>},
    {"StencilMask", kNumber, setUnsigned<&PipelineState::stencilReadMask>},
    {"StencilWriteMask", kNumber, setUnsigned<&PipelineState::stencilWriteMask>},
    {"TwoSidedStencilMode", kBool, [](States& s, int, Numbers v) { s.twoSidedStencil = v[0] != 0; }},
    {"CCW_StencilFail", kStencilOp, setStencilOp<kBack, &StencilFace::fail>},
    {"CCW_StencilZFail", kStencilOp, setStencilOp<kBack, &StencilFace::depthFail>},
    {"CCW_StencilPass", kStencilOp, setStencilOp<kBack, &StencilFace::pass>},
    {"CCW_StencilFunc", kCompare, setStencilCompare<kBack>},
    {"DepthBias", kNumber, [](States& s, int, Numbers v) { s.pipeline.depthBias = static_cast<float>(v[0] * kStepsOfDepth); }},
    {"SlopeScaleDepthBias", kNumber, setFloat<&PipelineState::slopeScaledDepthBias>},
    {"ScissorTestEnable", kBool, setBool<&PipelineState::scissorTest>},
    {"AlphaTestEnable", kBool, nullptr, 0, "write clip() in the pixel shader"},
    {"AlphaFunc", kCompare, nullptr, 8, "write clip() in the pixel shader"},
    {"AlphaRef", kNumber, nullptr, 0, "write clip() in the pixel shader"},
    {"SRGBWriteEnable", kBool, nullptr, 0, "encode in the pixel shader"},
    {"ClipPlaneEnable", kNumber, nullptr, 0, "write SV_ClipDistance in the vertex shader"},
}};

constexpr std::array<Entry, 14> kDepthStencil{{
    {"DepthEnable", kBool, setBool<&PipelineState::depthTest>},
    {"DepthWriteMask", kDepthWriteMask, setBool<&PipelineState::depthWrite>},
    {"DepthFunc", kCompare, setDepthCompare},
    {"StencilEnable", kBool, setBool<&PipelineState::stencilTest>},
    {"StencilReadMask", kNumber, setUnsigned<&PipelineState::stencilReadMask>},
    {"StencilWriteMask", kNumber, setUnsigned<&PipelineState::stencilWriteMask>},
    {"FrontFaceStencilFail", kStencilOp, setStencilOp<kFront, &StencilFace::fail>},
    {"FrontFaceStencilDepthFail", kStencilOp, setStencilOp<kFront, &StencilFace::depthFail>},
    {"FrontFaceStencilPass", kStencilOp, setStencilOp<kFront, &StencilFace::pass>},
    {"FrontFaceStencilFunc", kCompare, setStencilCompare<kFront>},
    {"BackFaceStencilFail", kStencilOp, setStencilOp<kBack, &StencilFace::fail>},
    {"BackFaceStencilDepthFail", kStencilOp, setStencilOp<kBack, &StencilFace::depthFail>},
    {"BackFaceStencilPass", kStencilOp, setStencilOp<kBack, &StencilFace::pass>},
    {"BackFaceStencilFunc", kCompare, setStencilCompare<kBack>},
}};

constexpr std::array<Entry, 10> kBlendState{{
    {"AlphaToCoverageEnable", kBool, setBool<&PipelineState::alphaToCoverage>},
    {"IndependentBlendEnable", kBool, [](States& s, int, Numbers v) { s.independentBlend = v[0] != 0; }},
    {"BlendEnable", kBool, setBlendEnable},
    {"SrcBlend", kBlend10, setFactor<&TargetBlend::src>},
    {"DestBlend", kBlend10, setFactor<&TargetBlend::dst>},
    {"BlendOp", kBlendOp, setBlendOp<&TargetBlend::op>},
    {"SrcBlendAlpha", kBlend10, setFactor<&TargetBlend::srcAlpha>},
    {"DestBlendAlpha", kBlend10, setFactor<&TargetBlend::dstAlpha>},
    {"BlendOpAlpha", kBlendOp, setBlendOp<&TargetBlend::opAlpha>},
    {"RenderTargetWriteMask", kWriteMask, setWriteMask<-1>},
}};

constexpr std::array<Entry, 10> kRasterizer{{
    {"FillMode", kFill10, [](States& s, int, Numbers v) { s.pipeline.fill = v[0] == 2 ? FillMode::Wireframe : FillMode::Solid; }},
    {"CullMode", kCull10, [](States& s, int, Numbers v) { s.pipeline.cull = static_cast<CullMode>(v[0] - 1); }},
    {"FrontCounterClockwise", kBool, setBool<&PipelineState::frontCounterClockwise>},
    {"DepthBias", kNumber, setFloat<&PipelineState::depthBias>},
    {"SlopeScaledDepthBias", kNumber, setFloat<&PipelineState::slopeScaledDepthBias>},
    {"DepthClipEnable", kBool, setBool<&PipelineState::depthClip>},
    {"ScissorEnable", kBool, setBool<&PipelineState::scissorTest>},
    {"DepthBiasClamp", kNumber, nullptr, 0, "clamp the bias in the shader"},
    {"MultisampleEnable", kBool, nullptr, 0, "targets have one sample"},
    {"AntialiasedLineEnable", kBool, nullptr, 0, "targets have one sample"},
}};

/// Families of names: every name that starts so.
constexpr std::array<std::string_view, 55> kFixedFunction{"Lighting",
                                                          "Fog",
                                                          "RangeFog",
                                                          "SpecularEnable",
                                                          "Ambient",
                                                          "ColorVertex",
                                                          "LocalViewer",
                                                          "NormalizeNormals",
                                                          "DiffuseMaterial",
                                                          "SpecularMaterial",
                                                          "AmbientMaterial",
                                                          "EmissiveMaterial",
                                                          "Material",
                                                          "VertexBlend",
                                                          "IndexedVertexBlend",
                                                          "TweenFactor",
                                                          "ShadeMode",
                                                          "TextureFactor",
                                                          "Light",
                                                          "ClipPlane",
                                                          "ColorOp",
                                                          "ColorArg",
                                                          "AlphaOp",
                                                          "AlphaArg",
                                                          "ResultArg",
                                                          "BumpEnv",
                                                          "TexCoordIndex",
                                                          "TextureTransform",
                                                          "WorldTransform",
                                                          "ViewTransform",
                                                          "ProjectionTransform",
                                                          "PointSize",
                                                          "PointScale",
                                                          "PointSprite",
                                                          "Wrap",
                                                          "Clipping",
                                                          "PatchEdge",
                                                          "PositionDegree",
                                                          "NormalDegree",
                                                          "AdaptiveTess",
                                                          "LastPixel",
                                                          "DitherEnable",
                                                          "AntialiasedLine",
                                                          "Multisample",
                                                          "FVF",
                                                          "Constant",
                                                          "VertexShaderConstant",
                                                          "PixelShaderConstant",
                                                          "PatchSegments",
                                                          "EnableAdaptiveTessellation",
                                                          "MinTessellationLevel",
                                                          "MaxTessellationLevel",
                                                          "NPatchMode",
                                                          "DebugMonitor",
                                                          "StateBlock"};

std::string comparable(std::string_view name) {
    std::string text;
    for (const char c : name)
        if (c != '_') text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

} // namespace

bool sameStateName(std::string_view a, std::string_view b) {
    return comparable(a) == comparable(b);
}

bool isFixedFunction(std::string_view name) {
    const std::string text = comparable(name);
    return std::ranges::any_of(kFixedFunction, [&](std::string_view family) { return text.starts_with(comparable(family)); });
}

std::span<const StateEntry<States>> direct3D9States() {
    return kDirect3D9;
}

std::span<const StateEntry<States>> depthStencilStates() {
    return kDepthStencil;
}

std::span<const StateEntry<States>> blendStates() {
    return kBlendState;
}

std::span<const StateEntry<States>> rasterizerStates() {
    return kRasterizer;
}

PipelineState direct3D9Defaults() {
    return {};
}

PipelineState direct3D10Defaults() {
    return {.depthCompare = CompareOp::Less};
}

void finishDirect3D9(States& states) {
    if (!states.twoSidedStencil) states.pipeline.stencilBack = states.pipeline.stencilFront;
    if (states.separateAlpha) return;
    for (TargetBlend& target : states.pipeline.targets) {
        target.srcAlpha = target.src;
        target.dstAlpha = target.dst;
        target.opAlpha = target.op;
    }
}

void finishBlend(States& states) {
    if (!states.independentBlend) states.pipeline.targets.fill(states.pipeline.targets[0]);
}

} // namespace tegument
