// Effects of other hosts as Microsoft's compiler has made them: drawn by ID3DXEffect, step by step as the Vulkan host draws them, with the
// same values. What a mesh of theirs would have and ours has not is made here too: binormals, white colours, the first bone.

#include "backends.h"
#include "direct3d9_device.h"

#include <d3dx9.h>

#include <algorithm>
#include <array>

namespace client {

namespace {

using nine::device;

constexpr unsigned kMadeFloats = 28; // BINORMAL, COLOR, zeros, the identity
constexpr WORD kZeros = 32;          // bytes
constexpr WORD kIdentity = 48;
constexpr BYTE kMoreUvs = 8; // TEXCOORD1 and so on are the first

/// The mesh's stream and the one beside it.
struct Streams {
    nine::Mesh mesh;
    Com<IDirect3DVertexBuffer9> made;
};

Streams uploadStreams(const MeshFile& file) {
    Streams streams{nine::upload(file), {}};
    std::vector<float> made;
    for (std::size_t i = 0; i + kVertexFloats <= file.vertices.size(); i += kVertexFloats) {
        const float* n = &file.vertices[i + 3];
        const float* t = &file.vertices[i + 6];
        const std::array<float, 6> binormal = {
            (n[1] * t[2] - n[2] * t[1]) * t[3], (n[2] * t[0] - n[0] * t[2]) * t[3], (n[0] * t[1] - n[1] * t[0]) * t[3], 1, 1, 1};
        made.insert(made.end(), binormal.begin(), binormal.end());
        made.resize(made.size() + kMadeFloats - binormal.size());
        float* last = &made[made.size() - kMadeFloats];
        last[6] = last[7] = 1; // white
        for (unsigned k = 0; k < 4; ++k)
            last[kIdentity / sizeof(float) + 5 * k] = 1;
    }
    const std::size_t bytes = made.size() * sizeof(float);
    must(device()->CreateVertexBuffer(static_cast<UINT>(bytes), 0, 0, D3DPOOL_MANAGED, streams.made.put(), nullptr), "CreateVertexBuffer");
    nine::fillBuffer(streams.made.get(), made.data(), bytes);
    return streams;
}

Com<IDirect3DVertexDeclaration9> declare(const Job& job) {
    std::vector<D3DVERTEXELEMENT9> elements = {{0, 0, D3DDECLTYPE_FLOAT3, 0, D3DDECLUSAGE_POSITION, 0},
                                               {0, 12, D3DDECLTYPE_FLOAT3, 0, D3DDECLUSAGE_NORMAL, 0},
                                               {0, 24, D3DDECLTYPE_FLOAT4, 0, D3DDECLUSAGE_TANGENT, 0},
                                               {1, 0, D3DDECLTYPE_FLOAT3, 0, D3DDECLUSAGE_BINORMAL, 0},
                                               {1, 16, D3DDECLTYPE_FLOAT4, 0, D3DDECLUSAGE_COLOR, 0},
                                               {1, 16, D3DDECLTYPE_FLOAT4, 0, D3DDECLUSAGE_COLOR, 1},
                                               {1, kIdentity, D3DDECLTYPE_FLOAT4, 0, D3DDECLUSAGE_BLENDWEIGHT, 0}, // all of the first bone
                                               {1, kZeros, D3DDECLTYPE_FLOAT4, 0, D3DDECLUSAGE_BLENDINDICES, 0}};
    for (BYTE i = 0; i < kMoreUvs; ++i)
        elements.push_back({0, 40, D3DDECLTYPE_FLOAT2, 0, D3DDECLUSAGE_TEXCOORD, i});
    const std::map<std::string, D3DDECLUSAGE> usages = {{"POSITION", D3DDECLUSAGE_POSITION}, {"NORMAL", D3DDECLUSAGE_NORMAL},
                                                        {"TEXCOORD", D3DDECLUSAGE_TEXCOORD}, {"BLENDWEIGHT", D3DDECLUSAGE_BLENDWEIGHT},
                                                        {"TANGENT", D3DDECLUSAGE_TANGENT},   {"BLENDINDICES", D3DDECLUSAGE_BLENDINDICES}};
    for (const auto& [kind, name] : job.streams) {
        const std::size_t digits = name.find_last_not_of("0123456789") + 1;
        const auto usage = usages.find(name.substr(0, digits));
        if (usage == usages.end()) continue; // of Direct3D 10
        for (int row = 0; row < (kind == "matrix" ? 4 : 1); ++row) {
            const auto index = static_cast<BYTE>(std::atoi(name.c_str() + digits) + row);
            elements.erase(std::remove_if(elements.begin(), elements.end(),
                                          [&](const auto& e) { return e.Usage == usage->second && e.UsageIndex == index; }),
                           elements.end());
            const int offset = kind == "matrix" ? kIdentity + 16 * row : kZeros;
            elements.push_back({1, static_cast<WORD>(offset), D3DDECLTYPE_FLOAT4, 0, static_cast<BYTE>(usage->second), index});
        }
    }
    elements.push_back(D3DDECL_END());
    Com<IDirect3DVertexDeclaration9> declaration;
    must(device()->CreateVertexDeclaration(elements.data(), declaration.put()), "CreateVertexDeclaration");
    return declaration;
}

class Foreign {
public:
    explicit Foreign(const Job& job) : job_(job), declaration_(declare(job)) {
        load();
        targets_["-"] = nine::makeTarget({false, job.width, job.height, "A8R8G8B8", 1});
        depths_["-"] = nine::makeTarget({true, job.width, job.height, "D24S8", 1});
        for (const auto& [name, shape] : job.targets)
            (shape.depth ? depths_ : targets_)[name] = nine::makeTarget(shape);
        setParameters();
        for (const auto& [name, file] : job.textures)
            unnamed_[name] = textures_.emplace_back(nine::upload(readTexture(job.path(file)))).get();
        for (const auto& [name, texture] : unnamed_)
            setTexture(name, texture);
        for (const auto* targets : {&targets_, &depths_})
            for (const auto& [name, target] : *targets)
                setTexture(name, target.texture.get());
        if (job.mesh.empty()) return;
        MeshFile mesh = readMesh(job.path(job.mesh));
        for (std::size_t i = 0; i + 2 < mesh.indices.size();
             i += 3) // the view is right-handed, and front faces are those of a left-handed one
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
        mesh_ = uploadStreams(mesh);
    }

    Pixels run() {
        for (const std::vector<std::string>& step : job_.steps)
            execute(step);
        return picture();
    }

private:
    void load() {
        Com<ID3DXBuffer> messages;
        const HRESULT result = D3DXCreateEffectFromFileA(device(), job_.path(job_.effect).c_str(), nullptr, nullptr, 0, nullptr,
                                                         effect_.put(), messages.put());
        if (FAILED(result) && messages) fail(static_cast<const char*>(messages->GetBufferPointer()));
        must(result, "D3DXCreateEffectFromFile");
        technique_ = effect_->GetTechniqueByName(job_.technique.c_str());
        if (!technique_) fail("the effect has no technique " + job_.technique);
        must(effect_->SetTechnique(technique_), "SetTechnique");
    }

    void setTexture(const std::string& name, IDirect3DBaseTexture9* texture) {
        if (const D3DXHANDLE handle = effect_->GetParameterByName(nullptr, name.c_str())) effect_->SetTexture(handle, texture);
    }

    void setParameters() {
        D3DXEFFECT_DESC effect{};
        must(effect_->GetDesc(&effect), "GetDesc");
        for (UINT i = 0; i < effect.Parameters; ++i)
            setParameter(effect_->GetParameter(nullptr, i), "");
    }

    /// Members of structures go by `lamp_0_colour`, as the host calls them.
    void setParameter(D3DXHANDLE parameter, const std::string& outer) {
        D3DXPARAMETER_DESC desc{};
        if (!parameter || FAILED(effect_->GetParameterDesc(parameter, &desc))) return;
        const std::string name = outer + (desc.Name ? desc.Name : "");
        if (desc.Class != D3DXPC_STRUCT) return setValue(parameter, desc, name);
        for (UINT element = 0; element < (desc.Elements > 0 ? desc.Elements : 1); ++element) {
            const D3DXHANDLE one = desc.Elements > 0 ? effect_->GetParameterElement(parameter, element) : parameter;
            const std::string path = name + (desc.Elements > 0 ? "_" + std::to_string(element) : "") + "_";
            for (UINT member = 0; member < desc.StructMembers; ++member)
                setParameter(effect_->GetParameter(one, member), path);
        }
    }

    void setValue(D3DXHANDLE parameter, const D3DXPARAMETER_DESC& desc, const std::string& name) {
        const auto value = job_.values.find(name);
        if (value == job_.values.end() || desc.Class == D3DXPC_OBJECT) return;
        const Numbers& numbers = value->second;
        const std::size_t one = std::size_t{desc.Rows} * desc.Columns;
        const bool matrices = desc.Rows == 4 && desc.Columns == 4 && numbers.size() == one * (desc.Elements > 0 ? desc.Elements : 1);
        if (matrices && desc.Elements > 0)
            effect_->SetMatrixArray(parameter, reinterpret_cast<const D3DXMATRIX*>(numbers.data()), desc.Elements);
        else if (matrices)
            effect_->SetMatrix(parameter, reinterpret_cast<const D3DXMATRIX*>(numbers.data()));
        else
            effect_->SetFloatArray(parameter, numbers.data(), static_cast<UINT>(numbers.size()));
    }

    const nine::Target* depthNamed(const std::string& name) {
        const auto found = depths_.find(name);
        return found == depths_.end() ? nullptr : &found->second;
    }

    /// A target that is sampled must not be bound.
    void bind(const nine::Target* color, unsigned slot) {
        must(device()->SetRenderTarget(slot, color ? color->surface.get() : nullptr), "SetRenderTarget");
    }

    void bindAll(const std::vector<std::string>& step) {
        for (DWORD stage = 0; stage < 16; ++stage)
            device()->SetTexture(stage, nullptr);
        must(device()->SetDepthStencilSurface(nullptr), "SetDepthStencilSurface");
        for (unsigned slot = 0; slot < kMaxColors; ++slot) {
            const nine::Target* target = step.size() > slot + 2 ? &targets_.at(step[slot + 2]) : nullptr;
            if (slot == 0 && target) shape_ = target->shape;
            if (slot > 0 || target) bind(target, slot);
        }
        if (const nine::Target* depth = depthNamed(step[1]))
            must(device()->SetDepthStencilSurface(depth->surface.get()), "SetDepthStencilSurface");
        const float size[] = {static_cast<float>(shape_.width), static_cast<float>(shape_.height), 0, 0};
        for (const std::string& name : job_.sized)
            if (const D3DXHANDLE parameter = effect_->GetParameterByName(nullptr, name.c_str())) {
                D3DXPARAMETER_DESC desc{};
                must(effect_->GetParameterDesc(parameter, &desc), "GetParameterDesc");
                effect_->SetFloatArray(parameter, size, desc.Columns);
            }
    }

    void clearColor(const std::vector<std::string>& step) {
        must(device()->SetDepthStencilSurface(nullptr), "SetDepthStencilSurface");
        for (unsigned slot = 0; slot < kMaxColors; ++slot)
            bind(slot == 0 ? &targets_.at(step[1]) : nullptr, slot);
        const auto channel = [&](std::size_t i) { return std::min(std::max(std::stof(step[i]), 0.0F), 1.0F); };
        must(device()->Clear(0, nullptr, D3DCLEAR_TARGET, D3DCOLOR_COLORVALUE(channel(2), channel(3), channel(4), channel(5)), 1, 0),
             "Clear");
    }

    /// The viewport limits what is cleared: it follows a colour target as large.
    void clearDepth(const std::vector<std::string>& step, bool stencil) {
        const nine::Target& depth = depths_.at(step[1]);
        nine::Target& beside = targets_["beside " + step[1]];
        if (!beside.surface) beside = nine::makeTarget({false, depth.shape.width, depth.shape.height, "A8R8G8B8", 1});
        for (unsigned slot = kMaxColors; slot-- > 0;)
            bind(slot == 0 ? &beside : nullptr, slot);
        must(device()->SetDepthStencilSurface(depth.surface.get()), "SetDepthStencilSurface");
        const float value = std::stof(step[2]);
        must(device()->Clear(0, nullptr, stencil ? D3DCLEAR_STENCIL : D3DCLEAR_ZBUFFER, 0, stencil ? 1 : value,
                             stencil ? static_cast<DWORD>(value) : 0),
             "Clear");
    }

    /// For passes without a vertex shader.
    void placeFixed(bool covers) {
        D3DXMATRIX matrix;
        D3DXMatrixIdentity(&matrix);
        for (const D3DTRANSFORMSTATETYPE which : {D3DTS_WORLD, D3DTS_VIEW, D3DTS_PROJECTION})
            device()->SetTransform(which, &matrix);
        if (const auto place = job_.values.find("placed"); !covers && place != job_.values.end())
            device()->SetTransform(D3DTS_PROJECTION, reinterpret_cast<const D3DXMATRIX*>(place->second.data()));
        if (covers) { // as programs place such corners: a pixel's centre is a whole number in Direct3D 9
            D3DXMatrixTranslation(&matrix, -1.0F / static_cast<float>(shape_.width), 1.0F / static_cast<float>(shape_.height), 0);
            device()->SetTransform(D3DTS_PROJECTION, &matrix);
        }
        device()->SetRenderState(D3DRS_LIGHTING, FALSE);
        device()->SetRenderState(D3DRS_ZENABLE, D3DZB_TRUE); // as on a device with a depth buffer of its own
    }

    /// Pixel shaders of model 3 meet no fixed function: programs that draw sprites by them bring a shader that does the same.
    void setSpriteShader(UINT pass) {
        D3DXPASS_DESC desc{};
        must(effect_->GetPassDesc(effect_->GetPass(technique_, pass), &desc), "GetPassDesc");
        const bool meets = !desc.pPixelShaderFunction || D3DXGetShaderVersion(desc.pPixelShaderFunction) < D3DPS_VERSION(3, 0);
        if (desc.pVertexShaderFunction || meets) return;
        const std::string source = "float4x4 m : register(c0); struct V { float4 p : POSITION; float4 c : COLOR0; float2 t0 : TEXCOORD0; "
                                   "float2 t1 : TEXCOORD1; float2 t2 : TEXCOORD2; float2 t3 : TEXCOORD3; }; "
                                   "V main(V v) { v.p = mul(v.p, m); return v; }";
        Com<ID3DXBuffer> code;
        must(D3DXCompileShader(source.data(), static_cast<UINT>(source.size()), nullptr, nullptr, "main", "vs_3_0", 0, code.put(), nullptr,
                               nullptr),
             "D3DXCompileShader");
        Com<IDirect3DVertexShader9> shader;
        must(device()->CreateVertexShader(static_cast<const DWORD*>(code->GetBufferPointer()), shader.put()), "CreateVertexShader");
        D3DXMATRIX placed;
        device()->GetTransform(D3DTS_PROJECTION, &placed);
        D3DXMatrixTranspose(&placed, &placed);
        device()->SetVertexShader(shader.get());
        device()->SetVertexShaderConstantF(0, &placed.m[0][0], 4);
    }

    /// Samplers that name no texture read what a program puts there.
    void setStages(UINT pass) {
        D3DXPASS_DESC desc{};
        must(effect_->GetPassDesc(effect_->GetPass(technique_, pass), &desc), "GetPassDesc");
        Com<ID3DXConstantTable> table;
        if (!desc.pPixelShaderFunction || FAILED(D3DXGetShaderConstantTable(desc.pPixelShaderFunction, table.put()))) return;
        D3DXCONSTANTTABLE_DESC all{};
        must(table->GetDesc(&all), "GetDesc");
        for (UINT i = 0; i < all.Constants; ++i) {
            D3DXCONSTANT_DESC constant{};
            UINT count = 1;
            table->GetConstantDesc(table->GetConstant(nullptr, i), &constant, &count);
            const auto texture =
                constant.RegisterSet == D3DXRS_SAMPLER ? unnamed_.find(std::string(constant.Name) + "_texture") : unnamed_.end();
            if (texture != unnamed_.end()) device()->SetTexture(constant.RegisterIndex, texture->second);
        }
    }

    void draw(UINT pass, const Streams& streams, bool covers) {
        UINT count = 0;
        must(device()->BeginScene(), "BeginScene");
        placeFixed(covers);
        must(effect_->Begin(&count, 0), "Begin");
        must(effect_->BeginPass(pass), "BeginPass");
        DWORD cull = D3DCULL_NONE;
        device()->GetRenderState(D3DRS_CULLMODE, &cull);
        if (covers) device()->SetRenderState(D3DRS_CULLMODE, D3DCULL_NONE);
        setStages(pass);
        setSpriteShader(pass);
        must(device()->SetVertexDeclaration(declaration_.get()), "SetVertexDeclaration");
        must(device()->SetStreamSource(0, streams.mesh.vertices.get(), 0, kVertexBytes), "SetStreamSource");
        must(device()->SetStreamSource(1, streams.made.get(), 0, kMadeFloats * sizeof(float)), "SetStreamSource");
        must(device()->SetIndices(streams.mesh.indices.get()), "SetIndices");
        must(device()->DrawIndexedPrimitive(D3DPT_TRIANGLELIST, 0, 0, streams.mesh.vertexCount, 0, streams.mesh.triangleCount),
             "DrawIndexedPrimitive");
        device()->SetRenderState(D3DRS_CULLMODE, cull); // End() restores what the effect has set, and no more
        must(effect_->EndPass(), "EndPass");
        must(effect_->End(), "End");
        device()->SetVertexShader(nullptr);
        must(device()->EndScene(), "EndScene");
    }

    void execute(const std::vector<std::string>& step) {
        const std::string& what = step.at(0);
        if (what == "bind") return bindAll(step);
        if (what == "color") return clearColor(step);
        if (what == "depth" || what == "stencil") return clearDepth(step, what == "stencil");
        if (what == "sample") return setTexture(step.at(1), targets_.at(step.at(2)).texture.get());
        if (what == "number") {
            if (const D3DXHANDLE parameter = effect_->GetParameterByName(nullptr, step.at(1).c_str()))
                effect_->SetFloat(parameter, std::stof(step.at(2)));
            return;
        }
        if (what == "copy")
            return must(device()->StretchRect(targets_.at(step.at(1)).surface.get(), nullptr, targets_.at(step.at(2)).surface.get(),
                                              nullptr, D3DTEXF_NONE),
                        "StretchRect");
        const auto pass = static_cast<UINT>(std::stoul(step.at(1)));
        if (what == "mesh") return draw(pass, mesh_, false);
        if (what == "quad") return draw(pass, quad_, true);
        MeshFile corners = fullScreenQuad();
        for (std::size_t i = 0; i < corners.vertices.size(); i += kVertexFloats) {
            corners.vertices[i] = (corners.vertices[i] * 0.5F + 0.5F) * static_cast<float>(shape_.width);
            corners.vertices[i + 1] = (0.5F - corners.vertices[i + 1] * 0.5F) * static_cast<float>(shape_.height);
        }
        draw(pass, uploadStreams(corners), true);
    }

    Pixels picture() {
        const nine::Target& target = targets_.at("-");
        Com<IDirect3DSurface9> copy;
        must(device()->CreateOffscreenPlainSurface(target.shape.width, target.shape.height, D3DFMT_A8R8G8B8, D3DPOOL_SYSTEMMEM, copy.put(),
                                                   nullptr),
             "CreateOffscreenPlainSurface");
        must(device()->GetRenderTargetData(target.surface.get(), copy.get()), "GetRenderTargetData");
        D3DLOCKED_RECT locked{};
        must(copy->LockRect(&locked, nullptr, D3DLOCK_READONLY), "LockRect");
        Pixels pixels{target.shape.width, target.shape.height, 4, {}};
        for (unsigned y = 0; y < pixels.height; ++y) {
            const auto* row = static_cast<const std::uint8_t*>(locked.pBits) + static_cast<std::size_t>(locked.Pitch) * y;
            for (unsigned x = 0; x < pixels.width; ++x)
                for (const unsigned channel : {2U, 1U, 0U, 3U}) // blue comes first
                    pixels.values.push_back(static_cast<float>(row[4 * x + channel]) / 255.0F);
        }
        copy->UnlockRect();
        return pixels;
    }

    const Job& job_;
    Com<IDirect3DVertexDeclaration9> declaration_;
    Com<ID3DXEffect> effect_;
    D3DXHANDLE technique_ = nullptr;
    std::map<std::string, nine::Target> targets_; // "-": the application's
    std::map<std::string, nine::Target> depths_;
    std::vector<Com<IDirect3DBaseTexture9>> textures_;
    std::map<std::string, IDirect3DBaseTexture9*> unnamed_; // all of them; some are those of samplers that name none
    Streams quad_ = uploadStreams(fullScreenQuad());
    Streams mesh_;
    TargetShape shape_;
};

} // namespace

Pixels drawForeign(const Job& job) {
    return Foreign(job).run();
}

} // namespace client
