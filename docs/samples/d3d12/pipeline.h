// States, root signatures and formats of a manifest as Direct3D 12 wants them; and mip levels, which it does not make itself.
#pragma once

#include "../player/manifest.h"
#include "device.h"

#include <d3dcompiler.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>

inline std::string textOf(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error("cannot read " + file);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// The manifest calls states as Direct3D does, which counts them from 1 in this order.
template <class Enum>
Enum byName(std::initializer_list<const char*> names, const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw std::runtime_error("no state " + name);
    return static_cast<Enum>(found - names.begin() + 1);
}
inline D3D12_COMPARISON_FUNC comparison(const std::string& name) {
    return byName<D3D12_COMPARISON_FUNC>({"NEVER", "LESS", "EQUAL", "LESS_EQUAL", "GREATER", "NOT_EQUAL", "GREATER_EQUAL", "ALWAYS"}, name);
}
inline D3D12_BLEND blendFactor(const std::string& name) { // 12 and 13 are free
    return byName<D3D12_BLEND>({"ZERO", "ONE", "SRC_COLOR", "INV_SRC_COLOR", "SRC_ALPHA", "INV_SRC_ALPHA", "DEST_ALPHA", "INV_DEST_ALPHA",
                                "DEST_COLOR", "INV_DEST_COLOR", "SRC_ALPHA_SAT", "", "", "BLEND_FACTOR", "INV_BLEND_FACTOR", "SRC1_COLOR",
                                "INV_SRC1_COLOR", "SRC1_ALPHA", "INV_SRC1_ALPHA"},
                               name);
}
inline D3D12_BLEND_OP blendOp(const std::string& name) {
    return byName<D3D12_BLEND_OP>({"ADD", "SUBTRACT", "REV_SUBTRACT", "MIN", "MAX"}, name);
}
inline D3D12_STENCIL_OP stencilOp(const std::string& name) {
    return byName<D3D12_STENCIL_OP>({"KEEP", "ZERO", "REPLACE", "INCR_SAT", "DECR_SAT", "INVERT", "INCR", "DECR"}, name);
}

inline DXGI_FORMAT targetFormat(const std::string& name) {
    const std::pair<const char*, DXGI_FORMAT> formats[] = {{"R16F", DXGI_FORMAT_R16_FLOAT},
                                                           {"G16R16F", DXGI_FORMAT_R16G16_FLOAT},
                                                           {"A16B16G16R16F", DXGI_FORMAT_R16G16B16A16_FLOAT},
                                                           {"R32F", DXGI_FORMAT_R32_FLOAT},
                                                           {"G32R32F", DXGI_FORMAT_R32G32_FLOAT},
                                                           {"A32B32G32R32F", DXGI_FORMAT_R32G32B32A32_FLOAT},
                                                           {"A8R8G8B8", DXGI_FORMAT_B8G8R8A8_UNORM},
                                                           {"D32F", DXGI_FORMAT_D32_FLOAT},
                                                           {"A16B16G16R16", DXGI_FORMAT_R16G16B16A16_UNORM},
                                                           {"D24S8", DXGI_FORMAT_D24_UNORM_S8_UINT},
                                                           {"A8B8G8R8", DXGI_FORMAT_R8G8B8A8_UNORM}};
    for (const auto& [known, format] : formats)
        if (script_player::detail::upper(name) == known) return format;
    throw std::runtime_error("no format " + name);
}

inline D3D12_BLEND_DESC blendState(const script_player::Json& states) {
    D3D12_BLEND_DESC desc{};
    desc.AlphaToCoverageEnable = states.at("alpha_to_coverage").number() != 0;
    const std::vector<script_player::Json>& targets = states.at("targets").list(); // one: of all
    desc.IndependentBlendEnable = targets.size() > 1;
    for (std::size_t i = 0; i < std::min<std::size_t>(8, targets.size()); ++i) {
        const script_player::Json& from = targets[i];
        D3D12_RENDER_TARGET_BLEND_DESC& to = desc.RenderTarget[i];
        to.RenderTargetWriteMask = static_cast<UINT8>(from.at("write_mask").whole());
        to.BlendEnable = from.at("blend").number() != 0;
        to.SrcBlend = to.SrcBlendAlpha = D3D12_BLEND_ONE;
        to.DestBlend = to.DestBlendAlpha = D3D12_BLEND_ZERO;
        to.BlendOp = to.BlendOpAlpha = D3D12_BLEND_OP_ADD;
        to.LogicOp = D3D12_LOGIC_OP_NOOP;
        if (!to.BlendEnable) continue;
        to.SrcBlend = blendFactor(from.at("src").text());
        to.DestBlend = blendFactor(from.at("dest").text());
        to.BlendOp = blendOp(from.at("op").text());
        to.SrcBlendAlpha = blendFactor(from.at("src_alpha").text());
        to.DestBlendAlpha = blendFactor(from.at("dest_alpha").text());
        to.BlendOpAlpha = blendOp(from.at("op_alpha").text());
    }
    return desc;
}

inline D3D12_DEPTH_STENCIL_DESC depthState(const script_player::Json& states) {
    D3D12_DEPTH_STENCIL_DESC desc{};
    desc.DepthEnable = states.at("depth_test").number() != 0;
    desc.DepthWriteMask = states.at("depth_write").number() != 0 ? D3D12_DEPTH_WRITE_MASK_ALL : D3D12_DEPTH_WRITE_MASK_ZERO;
    desc.DepthFunc = comparison(states.at("depth_compare").text());
    desc.StencilEnable = states.at("stencil_test").number() != 0;
    desc.FrontFace = desc.BackFace = {D3D12_STENCIL_OP_KEEP, D3D12_STENCIL_OP_KEEP, D3D12_STENCIL_OP_KEEP, D3D12_COMPARISON_FUNC_ALWAYS};
    if (!desc.StencilEnable) return desc;
    const auto face = [](const script_player::Json& from) -> D3D12_DEPTH_STENCILOP_DESC {
        return {stencilOp(from.at("fail").text()), stencilOp(from.at("depth_fail").text()), stencilOp(from.at("pass").text()),
                comparison(from.at("compare").text())};
    };
    const script_player::Json& stencil = states.at("stencil");
    desc.FrontFace = face(stencil.at("front"));
    desc.BackFace = face(stencil.at("back"));
    desc.StencilReadMask = static_cast<UINT8>(stencil.at("read_mask").whole());
    desc.StencilWriteMask = static_cast<UINT8>(stencil.at("write_mask").whole());
    return desc;
}

/// The vertex stream of docs/conventions.md; a shader takes what it reads of it.
inline constexpr D3D12_INPUT_ELEMENT_DESC kStream[] = {
    {"POSITION", 0, DXGI_FORMAT_R32G32B32_FLOAT, 0, 0, D3D12_INPUT_CLASSIFICATION_PER_VERTEX_DATA, 0},
    {"NORMAL", 0, DXGI_FORMAT_R32G32B32_FLOAT, 0, 12, D3D12_INPUT_CLASSIFICATION_PER_VERTEX_DATA, 0},
    {"TANGENT", 0, DXGI_FORMAT_R32G32B32A32_FLOAT, 0, 24, D3D12_INPUT_CLASSIFICATION_PER_VERTEX_DATA, 0},
    {"TEXCOORD", 0, DXGI_FORMAT_R32G32_FLOAT, 0, 40, D3D12_INPUT_CLASSIFICATION_PER_VERTEX_DATA, 0}};

/// All but shaders, root signature and formats of targets.
inline D3D12_GRAPHICS_PIPELINE_STATE_DESC graphicsState(const script_player::Json& states) {
    D3D12_GRAPHICS_PIPELINE_STATE_DESC desc{};
    desc.BlendState = blendState(states);
    desc.DepthStencilState = depthState(states);
    desc.SampleMask = ~0U;
    desc.RasterizerState.FillMode = byName<D3D12_FILL_MODE>({"POINT", "WIREFRAME", "SOLID"}, states.at("fill").text());
    desc.RasterizerState.CullMode = byName<D3D12_CULL_MODE>({"NONE", "FRONT", "BACK"}, states.at("cull").text());
    desc.RasterizerState.FrontCounterClockwise = states.at("front_counter_clockwise").number() != 0;
    desc.RasterizerState.DepthBias = static_cast<INT>(states.at("depth_bias").number());
    desc.RasterizerState.SlopeScaledDepthBias = states.at("slope_scaled_depth_bias").small();
    desc.RasterizerState.DepthClipEnable = states.at("depth_clip").number() != 0;
    desc.InputLayout = {kStream, 4};
    desc.PrimitiveTopologyType = D3D12_PRIMITIVE_TOPOLOGY_TYPE_TRIANGLE;
    desc.SampleDesc.Count = 1;
    return desc;
}

inline D3D12_SAMPLER_DESC samplerState(const script_player::Json& states) {
    const auto filter = [&](const char* key) { return states.at(key).text(); };
    const auto linear = [&](const char* key) { return filter(key) == "LINEAR" ? 1U : 0U; };
    const auto address = [&](std::size_t axis) {
        return byName<D3D12_TEXTURE_ADDRESS_MODE>({"WRAP", "MIRROR", "CLAMP", "BORDER", "MIRROR_ONCE"},
                                                  states.at("address").list().at(axis).text());
    };
    D3D12_SAMPLER_DESC desc{};
    const UINT bits = filter("min") == "ANISOTROPIC" ? 0x55U : linear("min") << 4 | linear("mag") << 2 | linear("mip");
    desc.Filter = static_cast<D3D12_FILTER>(bits | (states.find("compare") ? 0x80U : 0U));
    desc.AddressU = address(0);
    desc.AddressV = address(1);
    desc.AddressW = address(2);
    desc.MipLODBias = states.at("mip_lod_bias").small();
    desc.MaxAnisotropy = states.at("max_anisotropy").whole();
    desc.ComparisonFunc = comparison(states.textOr("compare", "NEVER"));
    for (std::size_t i = 0; i < 4; ++i)
        desc.BorderColor[i] = states.at("border").list().at(i).small();
    desc.MinLOD = states.at("lod").list().at(0).small();
    desc.MaxLOD = filter("mip") == "NONE" ? desc.MinLOD : states.at("lod").list().at(1).small();
    return desc;
}

/// A target's side in texels: docs/running.md, "Targets".
inline UINT targetSize(const script_player::Json& said, std::size_t axis, const char* name, UINT picture) {
    const auto of = [&](const script_player::Json& sizes) -> const script_player::Json& {
        return sizes.kind == script_player::Json::Kind::Array ? sizes.items.at(std::min(axis, sizes.items.size() - 1)) : sizes;
    };
    if (const script_player::Json* ratio = said.find("ViewportRatio"))
        return static_cast<UINT>(std::clamp(of(*ratio).number() * picture, 1.0, double{D3D12_REQ_TEXTURE2D_U_OR_V_DIMENSION}));
    if (const script_player::Json* sizes = said.find("Dimensions")) return of(*sizes).whole();
    if (const script_player::Json* size = said.find(said.find(name) ? name : "Width")) return size->whole();
    return picture;
}

/// A parameter that says how many.
inline UINT countOf(float number) {
    return static_cast<UINT>(std::clamp(number, 0.0F, 4294967040.0F)); // the largest float that fits
}

/// What Direct3D 12 keeps beside the pipeline.
inline void setBlendAndStencil(ID3D12GraphicsCommandList* list, const script_player::Json& states) {
    float factor[4];
    for (std::size_t i = 0; i < 4; ++i)
        factor[i] = states.at("blend_constant").list().at(i).small();
    list->OMSetBlendFactor(factor);
    if (const script_player::Json* stencil = states.find("stencil")) list->OMSetStencilRef(stencil->at("reference").whole());
}

/// A member of a block of constants: vectors begin 16 bytes apart in arrays and matrices, whose columns lie one behind the other.
inline void writeMember(const script_player::Json& member, const std::vector<float>& value, std::vector<char>& block) {
    const auto count = [&](const char* key) { return std::size_t{member.find(key) ? member.at(key).whole() : 1}; };
    const std::size_t rows = count("rows"), columns = count("columns"), offset = member.at("offset").whole();
    const bool turned = rows > 1 && member.at("column_major").number() != 0;
    for (std::size_t i = 0; i < std::min(value.size(), count("elements") * rows * columns); ++i) {
        const std::size_t element = i / (rows * columns), row = i / columns % rows, column = i % columns;
        const std::size_t vector = turned ? element * columns + column : element * rows + row;
        const std::size_t to = offset + 16 * vector + 4 * (turned ? row : column);
        const auto whole = static_cast<std::int32_t>(value[i]);
        if (to + 4 <= block.size())
            std::memcpy(&block[to], member.at("type").text() == "float" ? static_cast<const void*>(&value[i]) : &whole, 4);
    }
}

struct RootSignature {
    ComPtr<ID3D12RootSignature> signature;
    ComPtr<ID3D12RootSignatureDeserializer> reader;
    const D3D12_ROOT_SIGNATURE_DESC* desc() const { return reader->GetRootSignatureDesc(); }
};

inline ComPtr<ID3DBlob> compiled(const std::string& code, const char* entry, const char* profile) {
    ComPtr<ID3DBlob> made, messages;
    const HRESULT result = D3DCompile(code.data(), code.size(), nullptr, nullptr, nullptr, entry, profile, 0, 0, &made, &messages);
    if (FAILED(result) && messages) throw std::runtime_error(static_cast<const char*>(messages->GetBufferPointer()));
    check(result, "D3DCompile");
    return made;
}

/// From Microsoft's language, as the manifest has it; an engine keeps the blob.
inline RootSignature rootSignature(Device& device, const std::string& text) {
    const ComPtr<ID3DBlob> blob = compiled("#define RS \"" + text + "\"\n", "RS", "rootsig_1_0");
    RootSignature made;
    check(device->CreateRootSignature(0, blob->GetBufferPointer(), blob->GetBufferSize(), IID_PPV_ARGS(&made.signature)), text);
    check(D3D12CreateRootSignatureDeserializer(blob->GetBufferPointer(), blob->GetBufferSize(), IID_PPV_ARGS(&made.reader)), text);
    return made;
}

inline void readView(Device& device, const Texture& texture, UINT level, UINT levels, D3D12_CPU_DESCRIPTOR_HANDLE place) {
    D3D12_SHADER_RESOURCE_VIEW_DESC view{};
    view.Format = texture.shape.readFormat();
    view.Shader4ComponentMapping = D3D12_DEFAULT_SHADER_4_COMPONENT_MAPPING;
    view.ViewDimension = texture.shape.faces == 6 ? D3D12_SRV_DIMENSION_TEXTURECUBE : D3D12_SRV_DIMENSION_TEXTURE2D;
    view.Texture2D.MostDetailedMip = level; // of a cube at the same place
    view.Texture2D.MipLevels = levels;
    device->CreateShaderResourceView(texture.resource.Get(), &view, place);
}
inline void readNothing(Device& device, D3D12_CPU_DESCRIPTOR_HANDLE place) {
    Texture none;
    none.shape.format = DXGI_FORMAT_R8G8B8A8_UNORM;
    readView(device, none, 0, 1, place);
}

/// The levels of a target below its first: each the mean of four texels above.
class MipMaker {
public:
    void make(Device& device, Texture& texture) {
        ComPtr<ID3D12PipelineState>& state = states_[texture.shape.format]; // kept: lists that have not run name it
        if (!state) state = opened(device, texture.shape.format);
        const auto before = texture.state;
        for (UINT level = 1; level < texture.shape.levels; ++level) {
            device.barrier(texture, before, kRead, level - 1);
            if (before != D3D12_RESOURCE_STATE_RENDER_TARGET) device.barrier(texture, before, D3D12_RESOURCE_STATE_RENDER_TARGET, level);
            device.beginDraw();
            draw(device, texture, level, state.Get());
            device.barrier(texture, kRead, before, level - 1);
            if (before != D3D12_RESOURCE_STATE_RENDER_TARGET) device.barrier(texture, D3D12_RESOURCE_STATE_RENDER_TARGET, before, level);
        }
    }

private:
    ComPtr<ID3D12PipelineState> opened(Device& device, DXGI_FORMAT format) {
        const std::string code =
            "Texture2D t : register(t0); SamplerState s : register(s0);\n"
            "float4 VS(uint i : SV_VertexID, out float2 uv : TEXCOORD) : SV_Position {\n"
            "    uv = float2(i & 1, i >> 1) * 2; return float4(uv * float2(2, -2) + float2(-1, 1), 0, 1); }\n"
            "float4 PS(float4 p : SV_Position, float2 uv : TEXCOORD) : SV_Target { return t.SampleLevel(s, uv, 0); }\n";
        if (!root_.signature)
            root_ = rootSignature(device, "DescriptorTable(SRV(t0)), StaticSampler(s0, filter=FILTER_MIN_MAG_LINEAR_MIP_POINT, "
                                          "addressU=TEXTURE_ADDRESS_CLAMP, addressV=TEXTURE_ADDRESS_CLAMP)");
        const ComPtr<ID3DBlob> vertex = compiled(code, "VS", "vs_5_0"), pixel = compiled(code, "PS", "ps_5_0");
        D3D12_GRAPHICS_PIPELINE_STATE_DESC desc{};
        desc.pRootSignature = root_.signature.Get();
        desc.VS = {vertex->GetBufferPointer(), vertex->GetBufferSize()};
        desc.PS = {pixel->GetBufferPointer(), pixel->GetBufferSize()};
        desc.BlendState.RenderTarget[0].RenderTargetWriteMask = D3D12_COLOR_WRITE_ENABLE_ALL;
        desc.SampleMask = ~0U;
        desc.RasterizerState.FillMode = D3D12_FILL_MODE_SOLID;
        desc.RasterizerState.CullMode = D3D12_CULL_MODE_NONE;
        desc.PrimitiveTopologyType = D3D12_PRIMITIVE_TOPOLOGY_TYPE_TRIANGLE;
        desc.NumRenderTargets = 1;
        desc.RTVFormats[0] = format;
        desc.SampleDesc.Count = 1;
        ComPtr<ID3D12PipelineState> state;
        check(device->CreateGraphicsPipelineState(&desc, IID_PPV_ARGS(&state)), "the pipeline of mip levels");
        return state;
    }

    void draw(Device& device, const Texture& texture, UINT level, ID3D12PipelineState* state) {
        ID3D12GraphicsCommandList* const list = device.list();
        const UINT width = std::max(1U, texture.shape.width >> level), height = std::max(1U, texture.shape.height >> level);
        const D3D12_VIEWPORT viewport{0, 0, static_cast<float>(width), static_cast<float>(height), 0, 1};
        const D3D12_RECT all{0, 0, static_cast<LONG>(width), static_cast<LONG>(height)};
        const Device::Table table = device.table(false, 1);
        readView(device, texture, level - 1, 1, table.cpu);
        list->SetPipelineState(state);
        list->SetGraphicsRootSignature(root_.signature.Get());
        list->SetGraphicsRootDescriptorTable(0, table.gpu);
        list->OMSetRenderTargets(1, &texture.levels[level], FALSE, nullptr);
        list->RSSetViewports(1, &viewport);
        list->RSSetScissorRects(1, &all);
        list->IASetPrimitiveTopology(D3D_PRIMITIVE_TOPOLOGY_TRIANGLELIST);
        list->DrawInstanced(3, 1, 0, 0);
    }

    RootSignature root_;
    std::map<DXGI_FORMAT, ComPtr<ID3D12PipelineState>> states_;
};
