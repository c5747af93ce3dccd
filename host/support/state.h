#pragma once
// Render and sampler states, independent of the Direct3D version that spelt them. Defaults are Direct3D's.

#include <array>
#include <optional>

namespace tegument {

enum class CompareOp { Never, Less, Equal, LessEqual, Greater, NotEqual, GreaterEqual, Always };
enum class CullMode { None, Front, Back };
enum class FillMode { Solid, Wireframe, Point };
enum class BlendFactor {
    Zero,
    One,
    SrcColor,
    InvSrcColor,
    SrcAlpha,
    InvSrcAlpha,
    DestAlpha,
    InvDestAlpha,
    DestColor,
    InvDestColor,
    SrcAlphaSat,
    BlendFactor,
    InvBlendFactor,
    Src1Color,
    InvSrc1Color,
    Src1Alpha,
    InvSrc1Alpha
};
enum class BlendOp { Add, Subtract, RevSubtract, Min, Max };
enum class StencilOp { Keep, Zero, Replace, IncrSat, DecrSat, Invert, Incr, Decr };

struct StencilFace {
    StencilOp fail = StencilOp::Keep;
    StencilOp depthFail = StencilOp::Keep;
    StencilOp pass = StencilOp::Keep;
    CompareOp compare = CompareOp::Always;
    bool operator==(const StencilFace&) const = default;
};

struct TargetBlend {
    bool enable = false;
    BlendFactor src = BlendFactor::One;
    BlendFactor dst = BlendFactor::Zero;
    BlendOp op = BlendOp::Add;
    BlendFactor srcAlpha = BlendFactor::One;
    BlendFactor dstAlpha = BlendFactor::Zero;
    BlendOp opAlpha = BlendOp::Add;
    unsigned writeMask = 15; // bits R 1, G 2, B 4, A 8
    bool operator==(const TargetBlend&) const = default;
};

struct PipelineState {
    bool depthTest = true;
    bool depthWrite = true;
    CompareOp depthCompare = CompareOp::LessEqual; // Direct3D 10 and 11 default to Less
    bool stencilTest = false;
    StencilFace stencilFront;
    StencilFace stencilBack;
    unsigned stencilReadMask = 255;
    unsigned stencilWriteMask = 255;
    unsigned stencilReference = 0;
    FillMode fill = FillMode::Solid;
    CullMode cull = CullMode::Back;
    bool frontCounterClockwise = false; // Direct3D: front faces are clockwise on screen
    float depthBias = 0;
    float slopeScaledDepthBias = 0;
    bool depthClip = true;
    bool scissorTest = false;
    std::array<TargetBlend, 8> targets;
    std::array<float, 4> blendConstant = {1, 1, 1, 1};
    bool alphaToCoverage = false;
    bool operator==(const PipelineState&) const = default;
};

enum class Filter { Point, Linear, Anisotropic };
enum class Address { Wrap, Mirror, Clamp, Border, MirrorOnce };

struct SamplerState {
    Filter minFilter = Filter::Linear;
    Filter magFilter = Filter::Linear;
    Filter mipFilter = Filter::Linear;
    bool mipmapping = true; // MipFilter = NONE turns it off
    Address addressU = Address::Wrap;
    Address addressV = Address::Wrap;
    Address addressW = Address::Wrap;
    float mipLodBias = 0;
    int maxAnisotropy = 1;
    float minLod = 0;
    float maxLod = 1000;
    std::optional<CompareOp> compare;
    std::array<float, 4> borderColor = {0, 0, 0, 0};
    bool operator==(const SamplerState&) const = default;
};

} // namespace tegument
