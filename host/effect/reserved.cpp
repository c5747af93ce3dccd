#include "host/effect/reserved.h"

#include "host/effect/types.h"
#include "host/support/text.h"

#include <algorithm>
#include <string>

namespace tegument {

namespace {

constexpr std::string_view kReservedWords =
    " AppendStructuredBuffer asm_fragment BlendState break Buffer ByteAddressBuffer case catch cbuffer centroid class "
    "column_major compile compile_fragment CompileShader ComputeShader const const_cast ConsumeStructuredBuffer continue "
    "default delete DepthStencilState DepthStencilView discard do DomainShader dynamic_cast else enum explicit export extern "
    "false for friend fxgroup GeometryShader goto groupshared HullShader if in inline inout InputPatch interface line lineadj "
    "linear LineStream matrix mutable namespace new nointerpolation noperspective NULL operator out OutputPatch packoffset "
    "pixelfragment PixelShader pixelshader point PointStream private protected public RasterizerState register "
    "reinterpret_cast RenderTargetView return row_major RWBuffer RWByteAddressBuffer RWStructuredBuffer RWTexture1D "
    "RWTexture1DArray RWTexture2D RWTexture2DArray RWTexture3D sampler sampler1D sampler2D sampler3D sampler_state "
    "SamplerComparisonState samplerCUBE SamplerState shared signed sizeof snorm stateblock stateblock_state static "
    "static_cast String string struct StructuredBuffer switch tbuffer technique10 technique11 template texture texture1D "
    "texture2D texture3D textureCUBE throw triangle triangleadj TriangleStream true try typedef typename uniform union unorm "
    "unsigned using vector vertexfragment VertexShader vertexshader virtual void volatile while ";

/// Texture1D, Texture2DMSArray ...
bool isTextureType(std::string_view word) {
    const auto type = word.starts_with("Texture") && word != "Texture" && word != "TextureBuffer" ? builtInType(word) : std::nullopt;
    return type && type->name == word;
}

} // namespace

bool isReserved(std::string_view word) {
    for (const std::string_view any : {"asm", "pass", "technique"}) // the only ones whose case does not count
        if (equalsIgnoreCase(word, any)) return true;
    return kReservedWords.find(' ' + std::string(word) + ' ') != std::string_view::npos || isTextureType(word);
}

bool isNumericType(std::string_view word) {
    const auto isUpper = [](char c) { return c >= 'A' && c <= 'Z'; };
    if (word.ends_with("_t") || std::ranges::any_of(word, isUpper)) return false; // float16_t, DWORD: names like any other there
    const auto type = builtInType(word);
    return type && type->isNumeric();
}

} // namespace tegument
