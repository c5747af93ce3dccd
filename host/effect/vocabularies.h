#pragma once
// What the values of states are called, with their numbers in the Direct3D headers.

#include "host/effect/states.h"

#include <array>

namespace tegument {

inline constexpr std::array<NamedValue, 2> kBool{{{"FALSE", 0}, {"TRUE", 1}}};
inline constexpr std::array<NamedValue, 3> kDepthBuffer{{{"FALSE", 0}, {"TRUE", 1}, {"USEW", 2}}};
inline constexpr std::array<NamedValue, 2> kDepthWriteMask{{{"ZERO", 0}, {"ALL", 1}}};
inline constexpr std::array<NamedValue, 8> kCompare{
    {{"NEVER", 1}, {"LESS", 2}, {"EQUAL", 3}, {"LESSEQUAL", 4}, {"GREATER", 5}, {"NOTEQUAL", 6}, {"GREATEREQUAL", 7}, {"ALWAYS", 8}}};
inline constexpr std::array<NamedValue, 15> kBlend9{{{"ZERO", 1},
                                                     {"ONE", 2},
                                                     {"SRCCOLOR", 3},
                                                     {"INVSRCCOLOR", 4},
                                                     {"SRCALPHA", 5},
                                                     {"INVSRCALPHA", 6},
                                                     {"DESTALPHA", 7},
                                                     {"INVDESTALPHA", 8},
                                                     {"DESTCOLOR", 9},
                                                     {"INVDESTCOLOR", 10},
                                                     {"SRCALPHASAT", 11},
                                                     {"BLENDFACTOR", 14},
                                                     {"INVBLENDFACTOR", 15},
                                                     {"SRCCOLOR2", 16},
                                                     {"INVSRCCOLOR2", 17}}};
inline constexpr std::array<NamedValue, 17> kBlend10{{{"ZERO", 1},
                                                      {"ONE", 2},
                                                      {"SRC_COLOR", 3},
                                                      {"INV_SRC_COLOR", 4},
                                                      {"SRC_ALPHA", 5},
                                                      {"INV_SRC_ALPHA", 6},
                                                      {"DEST_ALPHA", 7},
                                                      {"INV_DEST_ALPHA", 8},
                                                      {"DEST_COLOR", 9},
                                                      {"INV_DEST_COLOR", 10},
                                                      {"SRC_ALPHA_SAT", 11},
                                                      {"BLEND_FACTOR", 14},
                                                      {"INV_BLEND_FACTOR", 15},
                                                      {"SRC1_COLOR", 16},
                                                      {"INV_SRC1_COLOR", 17},
                                                      {"SRC1_ALPHA", 18},
                                                      {"INV_SRC1_ALPHA", 19}}};
/// By Direct3D's number less one; 12 and 13 (BOTHSRCALPHA) have no name here, because no device has them.
inline constexpr std::array<BlendFactor, 19> kBlendFactors{
    BlendFactor::Zero,        BlendFactor::One,          BlendFactor::SrcColor,     BlendFactor::InvSrcColor, BlendFactor::SrcAlpha,
    BlendFactor::InvSrcAlpha, BlendFactor::DestAlpha,    BlendFactor::InvDestAlpha, BlendFactor::DestColor,   BlendFactor::InvDestColor,
    BlendFactor::SrcAlphaSat, BlendFactor::Zero,         BlendFactor::Zero,         BlendFactor::BlendFactor, BlendFactor::InvBlendFactor,
    BlendFactor::Src1Color,   BlendFactor::InvSrc1Color, BlendFactor::Src1Alpha,    BlendFactor::InvSrc1Alpha};
inline constexpr std::array<NamedValue, 5> kBlendOp{{{"ADD", 1}, {"SUBTRACT", 2}, {"REVSUBTRACT", 3}, {"MIN", 4}, {"MAX", 5}}};
inline constexpr std::array<NamedValue, 8> kStencilOp{
    {{"KEEP", 1}, {"ZERO", 2}, {"REPLACE", 3}, {"INCRSAT", 4}, {"DECRSAT", 5}, {"INVERT", 6}, {"INCR", 7}, {"DECR", 8}}};
inline constexpr std::array<NamedValue, 3> kCull9{{{"NONE", 1}, {"CW", 2}, {"CCW", 3}}};
inline constexpr std::array<NamedValue, 3> kCull10{{{"NONE", 1}, {"FRONT", 2}, {"BACK", 3}}};
inline constexpr std::array<NamedValue, 3> kFill9{{{"POINT", 1}, {"WIREFRAME", 2}, {"SOLID", 3}}};
inline constexpr std::array<NamedValue, 2> kFill10{{{"WIREFRAME", 2}, {"SOLID", 3}}};
/// Bits: combined with '|', numbers 0 to 15.
inline constexpr std::array<NamedValue, 4> kWriteMask{{{"RED", 1}, {"GREEN", 2}, {"BLUE", 4}, {"ALPHA", 8}}};
inline constexpr std::array<NamedValue, 4> kFilter9{{{"NONE", 0}, {"POINT", 1}, {"LINEAR", 2}, {"ANISOTROPIC", 3}}};
inline constexpr std::array<NamedValue, 5> kAddress{{{"WRAP", 1}, {"MIRROR", 2}, {"CLAMP", 3}, {"BORDER", 4}, {"MIRRORONCE", 5}}};
/// D3D10_FILTER: bit 0 mip linear, 2 magnification linear, 4 minification linear, 0x55 anisotropic, 0x80 comparison.
inline constexpr std::array<NamedValue, 18> kFilter10{{{"MIN_MAG_MIP_POINT", 0x00},
                                                       {"MIN_MAG_POINT_MIP_LINEAR", 0x01},
                                                       {"MIN_POINT_MAG_LINEAR_MIP_POINT", 0x04},
                                                       {"MIN_POINT_MAG_MIP_LINEAR", 0x05},
                                                       {"MIN_LINEAR_MAG_MIP_POINT", 0x10},
                                                       {"MIN_LINEAR_MAG_POINT_MIP_LINEAR", 0x11},
                                                       {"MIN_MAG_LINEAR_MIP_POINT", 0x14},
                                                       {"MIN_MAG_MIP_LINEAR", 0x15},
                                                       {"ANISOTROPIC", 0x55},
                                                       {"COMPARISON_MIN_MAG_MIP_POINT", 0x80},
                                                       {"COMPARISON_MIN_MAG_POINT_MIP_LINEAR", 0x81},
                                                       {"COMPARISON_MIN_POINT_MAG_LINEAR_MIP_POINT", 0x84},
                                                       {"COMPARISON_MIN_POINT_MAG_MIP_LINEAR", 0x85},
                                                       {"COMPARISON_MIN_LINEAR_MAG_MIP_POINT", 0x90},
                                                       {"COMPARISON_MIN_LINEAR_MAG_POINT_MIP_LINEAR", 0x91},
                                                       {"COMPARISON_MIN_MAG_LINEAR_MIP_POINT", 0x94},
                                                       {"COMPARISON_MIN_MAG_MIP_LINEAR", 0x95},
                                                       {"COMPARISON_ANISOTROPIC", 0xd5}}};

/// A colour given as one Direct3D 9 word 0xAARRGGBB, or as three or four floats.
[[nodiscard]] std::array<float, 4> colorValue(Numbers v);

} // namespace tegument
