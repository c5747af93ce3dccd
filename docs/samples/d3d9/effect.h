// An effect of this project in a Direct3D 9 engine: loads the .fx with D3DX, makes the targets that it declares, runs its script by
// the script player.
#pragma once

#include <windows.h>

#include <d3d9.h>
#include <d3dx9.h>
#include <wrl/client.h>

#include "../player/script_player.h"

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>

using Microsoft::WRL::ComPtr;

inline void check(HRESULT result, const std::string& what) {
    if (FAILED(result)) throw std::runtime_error(what + " failed");
}

struct Target {
    ComPtr<IDirect3DTexture9> texture; // none: a depth target
    ComPtr<IDirect3DSurface9> surface;
    UINT width = 0, height = 0;
};

inline Target makeTarget(IDirect3DDevice9* device, UINT width, UINT height, D3DFORMAT format, UINT levels) {
    Target target{nullptr, nullptr, width, height};
    if (format == D3DFMT_D24S8) {
        check(device->CreateDepthStencilSurface(width, height, format, D3DMULTISAMPLE_NONE, 0, FALSE, &target.surface, nullptr),
              "a depth target");
        return target;
    }
    const DWORD usage = D3DUSAGE_RENDERTARGET | (levels == 1 ? 0 : D3DUSAGE_AUTOGENMIPMAP);
    check(device->CreateTexture(width, height, levels, usage, format, D3DPOOL_DEFAULT, &target.texture, nullptr), "a target");
    check(target.texture->GetSurfaceLevel(0, &target.surface), "GetSurfaceLevel");
    return target;
}

class Effect : script_player::Engine {
public:
    using Draw = std::function<void(bool mesh)>; // the mesh, or a full-screen quad

    Effect(IDirect3DDevice9* device, const std::string& file) : device_(device) {
        const D3DXMACRO macros[] = {{"TEGUMENT_MAP_SIZE", "512"}, {nullptr, nullptr}};
        ComPtr<ID3DXBuffer> messages;
        const HRESULT result = D3DXCreateEffectFromFileA(device, file.c_str(), macros, nullptr, 0, nullptr, &effect_, &messages);
        if (FAILED(result) && messages) throw std::runtime_error(static_cast<const char*>(messages->GetBufferPointer()));
        check(result, file);
    }

    ID3DXEffect* operator->() const { return effect_.Get(); }
    IDirect3DTexture9* target(const std::string& name) const { return targets_.at(name).texture.Get(); }

    // Targets live in D3DPOOL_DEFAULT: they go before IDirect3DDevice9::Reset and are made again after it.
    void lose() {
        for (const auto& [name, target] : targets_)
            if (target.texture) check(effect_->SetTexture(name.c_str(), nullptr), name);
        targets_.clear();
        check(effect_->OnLostDevice(), "OnLostDevice");
    }

    void makeTargets() {
        const std::map<std::string, D3DFORMAT> formats = {{"A16B16G16R16F", D3DFMT_A16B16G16R16F},
                                                          {"A32B32G32R32F", D3DFMT_A32B32G32R32F},
                                                          {"R16F", D3DFMT_R16F},
                                                          {"G16R16F", D3DFMT_G16R16F},
                                                          {"R32F", D3DFMT_R32F},
                                                          {"G32R32F", D3DFMT_G32R32F},
                                                          {"D24S8", D3DFMT_D24S8}};
        forEachParameter([&](D3DXHANDLE parameter, const D3DXPARAMETER_DESC& desc) {
            const std::string semantic = desc.Semantic ? desc.Semantic : "";
            if (semantic != "RENDERCOLORTARGET" && semantic != "RENDERDEPTHSTENCILTARGET") return;
            Target& target = targets_[desc.Name] = makeTarget(device_, number(parameter, "Width", 512), number(parameter, "Height", 512),
                                                              formats.at(text(parameter, "Format")), number(parameter, "MipLevels", 1));
            if (target.texture) check(effect_->SetTexture(parameter, target.texture.Get()), desc.Name);
        });
    }

    // Everything that the effect asks for by semantic; `value` gives null for what the scene does not have.
    template <class Value>
    void setValues(const Value& value) {
        forEachParameter([&](D3DXHANDLE parameter, const D3DXPARAMETER_DESC& desc) {
            const float* numbers = desc.Semantic && desc.Class != D3DXPC_OBJECT ? value(desc.Semantic, text(parameter, "Object")) : nullptr;
            if (!numbers) return;
            // SetMatrix takes the matrix of row vectors, mul(v, M), and lays it out as the shader wants it
            check(desc.Rows == 4 ? effect_->SetMatrix(parameter, reinterpret_cast<const D3DXMATRIX*>(numbers))
                                 : effect_->SetFloatArray(parameter, numbers, desc.Columns),
                  desc.Name);
        });
    }

    void run(const char* technique, const Target& picture, const Target& depth, const Draw& draw) {
        picture_ = picture;
        depth_ = depth;
        draw_ = &draw;
        check(effect_->SetTechnique(technique), technique);
        const D3DXHANDLE handle = effect_->GetTechniqueByName(technique);
        script_player::Technique steps{technique, scriptOf(handle), {}};
        D3DXPASS_DESC desc{};
        for (UINT i = 0; const D3DXHANDLE pass = effect_->GetPass(handle, i); ++i)
            if (SUCCEEDED(effect_->GetPassDesc(pass, &desc))) steps.passes.push_back({desc.Name, scriptOf(pass)});
        script_player::play(steps, *this);
        picture_ = depth_ = {}; // they must go before a reset
    }

private:
    template <class Visit>
    void forEachParameter(const Visit& visit) {
        D3DXPARAMETER_DESC desc{};
        for (UINT i = 0; const D3DXHANDLE parameter = effect_->GetParameter(nullptr, i); ++i)
            if (SUCCEEDED(effect_->GetParameterDesc(parameter, &desc))) visit(parameter, desc);
    }
    std::string text(D3DXHANDLE owner, const char* annotation) {
        LPCSTR value = nullptr;
        const D3DXHANDLE handle = effect_->GetAnnotationByName(owner, annotation);
        return handle && SUCCEEDED(effect_->GetString(handle, &value)) ? value : "";
    }
    std::optional<std::string> scriptOf(D3DXHANDLE owner) {
        return effect_->GetAnnotationByName(owner, "Script") ? std::optional(text(owner, "Script")) : std::nullopt;
    }
    UINT number(D3DXHANDLE owner, const char* annotation, UINT otherwise) {
        INT value = 0;
        const D3DXHANDLE handle = effect_->GetAnnotationByName(owner, annotation);
        return handle && SUCCEEDED(effect_->GetInt(handle, &value)) ? static_cast<UINT>(value) : otherwise;
    }

    // What scripts ask for.
    void setTargets(const script_player::Targets& targets) override {
        const Target& color = targets.colors[0]->empty() ? picture_ : targets_.at(*targets.colors[0]);
        const Target& depth = targets.depth->empty() ? depth_ : targets_.at(*targets.depth);
        for (DWORD stage = 0; stage < 16; ++stage) // what becomes a target now was a texture before
            check(device_->SetTexture(stage, nullptr), "SetTexture");
        check(device_->SetRenderTarget(0, color.surface.Get()), "SetRenderTarget");
        const bool fits = depth.width == color.width && depth.height == color.height; // passes without depth test leave another size bound
        check(device_->SetDepthStencilSurface(fits ? depth.surface.Get() : nullptr), "SetDepthStencilSurface");
        // The half pixel: vertex shaders move everything by 1 / size of the target that is bound now.
        const float size[] = {static_cast<float>(color.width), static_cast<float>(color.height)};
        if (const D3DXHANDLE parameter = effect_->GetParameterBySemantic(nullptr, "VIEWPORTPIXELSIZE"))
            check(effect_->SetFloatArray(parameter, size, 2), "VIEWPORTPIXELSIZE");
    }

    void clear(script_player::Clear what, std::optional<std::size_t>, const std::vector<float>& value) override {
        const bool color = what == script_player::Clear::Color; // eight bits a channel
        check(device_->Clear(0, nullptr, color ? D3DCLEAR_TARGET : D3DCLEAR_ZBUFFER,
                             color ? D3DCOLOR_COLORVALUE(value[0], value[1], value[2], value[3]) : 0, color ? 1 : value[0], 0),
              "a clear");
    }

    script_player::Value value(const std::string& parameter) override {
        D3DXPARAMETER_DESC desc{};
        check(effect_->GetParameterDesc(parameter.c_str(), &desc), parameter);
        script_player::Value value{std::vector<float>(desc.Columns), desc.Type == D3DXPT_BOOL};
        check(effect_->GetFloatArray(parameter.c_str(), value.numbers.data(), desc.Columns), parameter);
        return value;
    }

    void setNumber(const std::string& parameter, float number) override { check(effect_->SetFloat(parameter.c_str(), number), parameter); }

    void draw(const script_player::Pass& pass, script_player::Draw what) override {
        const D3DXHANDLE technique = effect_->GetCurrentTechnique();
        UINT count = 0, index = 0;
        while (effect_->GetPass(technique, index) != effect_->GetPassByName(technique, pass.name.c_str()))
            ++index;
        check(effect_->Begin(&count, 0), "Begin");
        check(effect_->BeginPass(index), "BeginPass");
        (*draw_)(what == script_player::Draw::Mesh);
        check(effect_->EndPass(), "EndPass");
        check(effect_->End(), "End");
    }

    IDirect3DDevice9* device_;
    ComPtr<ID3DXEffect> effect_;
    std::map<std::string, Target> targets_;
    Target picture_, depth_; // the application's
    const Draw* draw_ = nullptr;
};
