// Direct3D 9 through D3DX: everything comes from the effect file, as an engine would have it: targets from annotations, values by semantic.

#include "backends.h"
#include "direct3d9_device.h"

#include <d3dx9.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace client {

namespace {

using nine::device;
using nine::makeTarget;
using nine::Mesh;
using nine::Target;
using nine::upload;

bool sameSize(const Target& a, const Target& b) {
    return a.shape.width == b.shape.width && a.shape.height == b.shape.height;
}

class Direct3D9 final : public Engine {
public:
    explicit Direct3D9(const Job& job) : job_(job) {
        loadEffect();
        colors_[""] = makeTarget({false, job.width, job.height, "A32B32G32R32F", 1});
        depths_[""] = makeTarget({true, job.width, job.height, "D24S8", 1});
        readParameters();
        for (const auto& [name, file] : job.textures)
            setTexture(name, textures_.emplace_back(upload(readTexture(job.path(file)))).get());
        quad_ = upload(fullScreenQuad());
        if (!job.mesh.empty()) mesh_ = upload(readMesh(job.path(job.mesh)));
        declareVertices();
        clearAll();
    }

    std::string techniqueScript() override { return text(technique_, "Script"); }
    std::vector<std::string> passes() override {
        D3DXTECHNIQUE_DESC technique{};
        must(effect_->GetTechniqueDesc(technique_, &technique), "GetTechniqueDesc");
        std::vector<std::string> names;
        for (UINT i = 0; i < technique.Passes; ++i) {
            D3DXPASS_DESC pass{};
            must(effect_->GetPassDesc(effect_->GetPass(technique_, i), &pass), "GetPassDesc");
            names.emplace_back(pass.Name);
        }
        return names;
    }
    std::string passScript(const std::string& pass) override { return text(effect_->GetPassByName(technique_, pass.c_str()), "Script"); }

    Numbers numbers(const std::string& parameter) override {
        const D3DXHANDLE handle = effect_->GetParameterByName(nullptr, parameter.c_str());
        D3DXPARAMETER_DESC desc{};
        must(effect_->GetParameterDesc(handle, &desc), "GetParameterDesc " + parameter);
        Numbers values(std::size_t{desc.Rows} * desc.Columns);
        must(effect_->GetFloatArray(handle, values.data(), static_cast<UINT>(values.size())), "GetFloatArray " + parameter);
        return values;
    }
    void setNumber(const std::string& parameter, float value) override {
        must(effect_->SetFloat(parameter.c_str(), value), "SetFloat " + parameter);
    }

    void setTargets(const Bound& bound) override;
    using Engine::clear;
    using Engine::draw;
    void clear(Clear what, const Numbers& value) override;
    void draw(const std::string& pass, Drawing drawing) override;
    std::vector<std::string> targets() override;
    Pixels read(const std::string& target) override;

private:
    void loadEffect();
    void readParameters();
    void makeTargets(D3DXHANDLE parameter, const D3DXPARAMETER_DESC& desc);
    void setValue(D3DXHANDLE parameter, const D3DXPARAMETER_DESC& desc);
    void declareVertices();
    void clearAll();

    std::string text(D3DXHANDLE owner, const char* annotation) {
        LPCSTR value = nullptr;
        const D3DXHANDLE handle = effect_->GetAnnotationByName(owner, annotation);
        return handle && SUCCEEDED(effect_->GetString(handle, &value)) && value ? value : "";
    }
    unsigned number(D3DXHANDLE owner, const char* annotation, unsigned otherwise) {
        INT value = 0;
        const D3DXHANDLE handle = effect_->GetAnnotationByName(owner, annotation);
        return handle && SUCCEEDED(effect_->GetInt(handle, &value)) ? static_cast<unsigned>(value) : otherwise;
    }
    void setTexture(const std::string& name, IDirect3DBaseTexture9* texture) {
        must(effect_->SetTexture(name.c_str(), texture), "SetTexture " + name);
    }

    const Job& job_;
    Com<ID3DXEffect> effect_;
    D3DXHANDLE technique_ = nullptr;
    std::map<std::string, Target> colors_;
    std::map<std::string, Target> depths_;
    std::vector<Com<IDirect3DBaseTexture9>> textures_;
    Com<IDirect3DVertexDeclaration9> declaration_;
    Mesh mesh_;
    Mesh quad_;
    bool depthBound_ = false;
};

void Direct3D9::loadEffect() {
    Com<ID3DXBuffer> messages;
    const HRESULT result =
        D3DXCreateEffectFromFileA(device(), job_.path(job_.effect).c_str(), nullptr, nullptr, 0, nullptr, effect_.put(), messages.put());
    if (FAILED(result) && messages) fail(static_cast<const char*>(messages->GetBufferPointer()));
    must(result, "D3DXCreateEffectFromFile");
    technique_ = effect_->GetTechniqueByName(job_.technique.c_str());
    if (!technique_) fail("the effect has no technique " + job_.technique);
    must(effect_->ValidateTechnique(technique_), "ValidateTechnique " + job_.technique);
    must(effect_->SetTechnique(technique_), "SetTechnique");
}

void Direct3D9::makeTargets(D3DXHANDLE parameter, const D3DXPARAMETER_DESC& desc) {
    const std::string semantic = upper(desc.Semantic ? desc.Semantic : "");
    const bool depth = semantic == "RENDERDEPTHSTENCILTARGET";
    if (!depth && semantic != "RENDERCOLORTARGET") return;
    float ratio[2] = {1, 1};
    if (const D3DXHANDLE handle = effect_->GetAnnotationByName(parameter, "ViewportRatio"))
        must(effect_->GetFloatArray(handle, ratio, 2), "GetFloatArray ViewportRatio");
    Target target = makeTarget({depth, number(parameter, "Width", static_cast<unsigned>(ratio[0] * static_cast<float>(job_.width))),
                                number(parameter, "Height", static_cast<unsigned>(ratio[1] * static_cast<float>(job_.height))),
                                text(parameter, "Format"), number(parameter, "MipLevels", 1)});
    if (!depth) setTexture(desc.Name, target.texture.get());
    (depth ? depths_ : colors_)[desc.Name] = std::move(target);
}

void Direct3D9::setValue(D3DXHANDLE parameter, const D3DXPARAMETER_DESC& desc) {
    const std::string name = desc.Name;
    const auto value = job_.valueOf(name, desc.Semantic ? desc.Semantic : "", text(parameter, "Object"), desc.Columns);
    if (!value) return;
    if (value->size() == 16 && desc.Elements == 0)
        must(effect_->SetMatrix(parameter, reinterpret_cast<const D3DXMATRIX*>(value->data())), "SetMatrix " + name);
    else
        must(effect_->SetFloatArray(parameter, value->data(), static_cast<UINT>(value->size())), "SetFloatArray " + name);
}

void Direct3D9::readParameters() {
    D3DXEFFECT_DESC effect{};
    must(effect_->GetDesc(&effect), "GetDesc");
    for (UINT i = 0; i < effect.Parameters; ++i) {
        const D3DXHANDLE parameter = effect_->GetParameter(nullptr, i);
        D3DXPARAMETER_DESC desc{};
        must(effect_->GetParameterDesc(parameter, &desc), "GetParameterDesc");
        if (desc.Class == D3DXPC_OBJECT)
            makeTargets(parameter, desc);
        else
            setValue(parameter, desc);
    }
}

void Direct3D9::declareVertices() {
    const D3DVERTEXELEMENT9 elements[] = {{0, 0, D3DDECLTYPE_FLOAT3, 0, D3DDECLUSAGE_POSITION, 0},
                                          {0, 12, D3DDECLTYPE_FLOAT3, 0, D3DDECLUSAGE_NORMAL, 0},
                                          {0, 24, D3DDECLTYPE_FLOAT4, 0, D3DDECLUSAGE_TANGENT, 0},
                                          {0, 40, D3DDECLTYPE_FLOAT2, 0, D3DDECLUSAGE_TEXCOORD, 0},
                                          D3DDECL_END()};
    must(device()->CreateVertexDeclaration(elements, declaration_.put()), "CreateVertexDeclaration");
}

/// A frame depends on nothing that was there before.
void Direct3D9::clearAll() {
    for (const auto& [name, target] : colors_) {
        setTargets({.colors = {name}, .depth = std::nullopt});
        clear(Clear::Color, job_.emptyColor(name));
    }
    for (const auto& [depthName, depth] : depths_)
        for (const auto& [name, color] : colors_) {
            if (!sameSize(color, depth)) continue; // the viewport limits what is cleared
            setTargets({.colors = {name}, .depth = depthName});
            clear(Clear::Depth, {1});
            clear(Clear::Stencil, {0});
        }
}

void Direct3D9::setTargets(const Bound& bound) {
    for (DWORD stage = 0; stage < 16; ++stage) // a target must not be sampled while it is one
        device()->SetTexture(stage, nullptr);
    const Target& first = colors_.at(bound.colors[0].value_or(""));
    for (DWORD slot = 0; slot < kMaxColors; ++slot) {
        const auto& name = bound.colors[slot];
        if (name || slot > 0) must(device()->SetRenderTarget(slot, name ? colors_.at(*name).surface.get() : nullptr), "SetRenderTarget");
    }
    const Target* depth = bound.depth ? &depths_.at(*bound.depth) : nullptr;
    depthBound_ = depth && sameSize(*depth, first);
    must(device()->SetDepthStencilSurface(depthBound_ ? depth->surface.get() : nullptr), "SetDepthStencilSurface");
    const float size[] = {static_cast<float>(first.shape.width), static_cast<float>(first.shape.height)};
    if (const D3DXHANDLE parameter = effect_->GetParameterBySemantic(nullptr, "VIEWPORTPIXELSIZE"))
        must(effect_->SetFloatArray(parameter, size, 2), "SetFloatArray VIEWPORTPIXELSIZE");
}

/// Direct3D 9 clears to bytes.
void Direct3D9::clear(Clear what, const Numbers& value) {
    if (what == Clear::Color) {
        for (const float channel : value)
            if (channel < 0 || channel > 1) fail("the script clears to a value that Direct3D 9 cannot: " + std::to_string(channel));
        must(device()->Clear(0, nullptr, D3DCLEAR_TARGET, D3DCOLOR_COLORVALUE(value[0], value[1], value[2], value[3]), 1, 0), "Clear");
    } else if (what == Clear::Depth) {
        must(device()->Clear(0, nullptr, D3DCLEAR_ZBUFFER, 0, value[0], 0), "Clear");
    } else {
        must(device()->Clear(0, nullptr, D3DCLEAR_STENCIL, 0, 1, static_cast<DWORD>(value[0])), "Clear");
    }
}

void Direct3D9::draw(const std::string& pass, Drawing drawing) {
    const std::vector<std::string> names = passes();
    const auto index = static_cast<UINT>(std::find(names.begin(), names.end(), pass) - names.begin());
    const Mesh& mesh = drawing == Drawing::Quad ? quad_ : mesh_;
    UINT count = 0;
    must(device()->BeginScene(), "BeginScene");
    must(effect_->Begin(&count, 0), "Begin");
    must(effect_->BeginPass(index), "BeginPass " + pass);
    must(device()->SetVertexDeclaration(declaration_.get()), "SetVertexDeclaration");
    must(device()->SetStreamSource(0, mesh.vertices.get(), 0, kVertexBytes), "SetStreamSource");
    must(device()->SetIndices(mesh.indices.get()), "SetIndices");
    const IndexRange all{0, 3 * mesh.triangleCount};
    const IndexRange range = drawing == Drawing::Quad ? all : job_.rangeOf(pass, all.count);
    must(device()->DrawIndexedPrimitive(D3DPT_TRIANGLELIST, 0, 0, mesh.vertexCount, range.first, range.count / 3), "DrawIndexedPrimitive");
    must(effect_->EndPass(), "EndPass");
    must(effect_->End(), "End");
    must(device()->EndScene(), "EndScene");
}

std::vector<std::string> Direct3D9::targets() {
    std::vector<std::string> names;
    for (const auto& [name, target] : colors_)
        names.push_back(name);
    return names;
}

Pixels Direct3D9::read(const std::string& name) {
    const Target& target = colors_.at(name);
    Com<IDirect3DSurface9> copy;
    must(device()->CreateOffscreenPlainSurface(target.shape.width, target.shape.height, targetFormat(target.shape).d3d, D3DPOOL_SYSTEMMEM,
                                               copy.put(), nullptr),
         "CreateOffscreenPlainSurface");
    must(device()->GetRenderTargetData(target.surface.get(), copy.get()), "GetRenderTargetData");
    D3DLOCKED_RECT locked{};
    must(copy->LockRect(&locked, nullptr, D3DLOCK_READONLY), "LockRect");
    Pixels pixels = readRows(target.shape, locked.pBits, static_cast<unsigned>(locked.Pitch));
    copy->UnlockRect();
    return pixels;
}

} // namespace

std::unique_ptr<Engine> openDirect3D9(const Job& job) {
    return std::make_unique<Direct3D9>(job);
}

} // namespace client
