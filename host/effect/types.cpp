#include "host/effect/types.h"

#include "host/support/text.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tegument {

namespace {

using Entry = std::pair<std::string_view, BaseType>;

constexpr std::array<Entry, 15> kScalars{{{"bool", BaseType::Bool},
                                          {"int", BaseType::Int},
                                          {"uint", BaseType::Uint},
                                          {"dword", BaseType::Uint},
                                          {"float", BaseType::Float},
                                          {"half", BaseType::Float},
                                          {"double", BaseType::Float},
                                          {"min16float", BaseType::Float},
                                          {"min10float", BaseType::Float},
                                          {"min16int", BaseType::Int},
                                          {"min12int", BaseType::Int},
                                          {"min16uint", BaseType::Uint},
                                          {"float16_t", BaseType::Float},
                                          {"int16_t", BaseType::Int},
                                          {"uint16_t", BaseType::Uint}}};

constexpr std::array<Entry, 18> kObjects{{{"string", BaseType::String},
                                          {"texture", BaseType::Texture2D},
                                          {"Texture", BaseType::Texture2D},
                                          {"texture1D", BaseType::Texture1D},
                                          {"Texture1D", BaseType::Texture1D},
                                          {"texture2D", BaseType::Texture2D},
                                          {"Texture2D", BaseType::Texture2D},
                                          {"texture3D", BaseType::Texture3D},
                                          {"Texture3D", BaseType::Texture3D},
                                          {"textureCUBE", BaseType::TextureCube},
                                          {"TextureCube", BaseType::TextureCube},
                                          {"sampler", BaseType::Sampler},
                                          {"sampler1D", BaseType::Sampler},
                                          {"sampler2D", BaseType::Sampler},
                                          {"sampler3D", BaseType::Sampler},
                                          {"samplerCUBE", BaseType::Sampler},
                                          {"SamplerState", BaseType::Sampler},
                                          {"SamplerComparisonState", BaseType::Sampler}}};

constexpr std::array<std::string_view, 30> kOthers{"void",
                                                   "Texture1DArray",
                                                   "Texture2DArray",
                                                   "TextureCubeArray",
                                                   "Texture2DMS",
                                                   "Texture2DMSArray",
                                                   "Buffer",
                                                   "StructuredBuffer",
                                                   "ByteAddressBuffer",
                                                   "ConstantBuffer",
                                                   "TextureBuffer",
                                                   "RWTexture1D",
                                                   "RWTexture1DArray",
                                                   "RWTexture2D",
                                                   "RWTexture2DArray",
                                                   "RWTexture3D",
                                                   "RWBuffer",
                                                   "RWStructuredBuffer",
                                                   "RWByteAddressBuffer",
                                                   "AppendStructuredBuffer",
                                                   "ConsumeStructuredBuffer",
                                                   "InputPatch",
                                                   "OutputPatch",
                                                   "PointStream",
                                                   "LineStream",
                                                   "TriangleStream",
                                                   "RenderTargetView",
                                                   "DepthStencilView",
                                                   "sampler_state",
                                                   "RaytracingAccelerationStructure"};

bool isDimension(char c) {
    return c >= '1' && c <= '4';
}

/// "", "3" or "3x4" behind a scalar's name.
bool readDimensions(std::string_view text, Type& type) {
    if (text.empty()) return true;
    if (text.size() == 1 && isDimension(text[0])) {
        type.columns = text[0] - '0';
        return true;
    }
    if (text.size() != 3 || !isDimension(text[0]) || text[1] != 'x' || !isDimension(text[2])) return false;
    type.rows = text[0] - '0';
    type.columns = text[2] - '0';
    return true;
}

/// Microsoft's compiler takes the names of effect types in any case: STRING, Sampler2D, Matrix.
std::optional<Type> inAnyCase(std::string_view name) {
    for (const auto& [text, base] : kObjects)
        if (equalsIgnoreCase(text, name)) return Type{.base = base, .name = std::string(text)};
    if (equalsIgnoreCase(name, "dword")) return Type{.base = BaseType::Uint, .name = "dword"};
    if (equalsIgnoreCase(name, "vector")) return Type{.columns = 4, .name = "vector"};
    if (equalsIgnoreCase(name, "matrix")) return Type{.rows = 4, .columns = 4, .name = "matrix"};
    return std::nullopt;
}

} // namespace

std::optional<Type> builtInType(std::string_view name) {
    for (const auto& [text, base] : kObjects)
        if (text == name) return Type{.base = base, .name = std::string(name)};
    if (std::ranges::find(kOthers, name) != kOthers.end()) return Type{.base = BaseType::Other, .name = std::string(name)};
    if (name == "vector") return Type{.columns = 4, .name = std::string(name)};
    if (name == "matrix") return Type{.rows = 4, .columns = 4, .name = std::string(name)};
    for (const auto& [text, base] : kScalars) {
        Type type{.base = base, .name = std::string(name)};
        if (name.starts_with(text) && readDimensions(name.substr(text.size()), type)) return type;
    }
    return inAnyCase(name);
}

int samplerDimension(std::string_view name) {
    if (name == "sampler1D") return 1;
    if (name == "sampler2D") return 2;
    if (name == "sampler3D") return 3;
    return name == "samplerCUBE" ? 6 : 0;
}

bool isDirect3D9Sampler(std::string_view name) {
    return name.starts_with("sampler");
}

std::span<const std::string> commonTypeNames() {
    static const std::array<std::string, 21> kNames{"bool",      "int",         "int2",        "int3",      "int4",        "uint",
                                                    "float",     "float2",      "float3",      "float4",    "float3x3",    "float4x4",
                                                    "half4",     "string",      "texture",     "Texture2D", "TextureCube", "sampler2D",
                                                    "Texture3D", "samplerCUBE", "SamplerState"};
    return kNames;
}

} // namespace tegument
