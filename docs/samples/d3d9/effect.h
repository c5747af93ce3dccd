// An effect of this project in a Direct3D 9 engine: loads the .fx with D3DX, makes the targets that it declares, runs its script.
#pragma once

#include <windows.h>

#include <d3d9.h>
#include <d3dx9.h>
#include <wrl/client.h>

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

class Effect {
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
        targets_["<picture>"] = picture;
        targets_["<depth>"] = depth;
        draw_ = &draw;
        check(effect_->SetTechnique(technique), technique);
        runScript(effect_->GetTechniqueByName(technique), {});
        targets_.erase("<picture>");
        targets_.erase("<depth>");
    }

private:
    struct State {
        std::string color = "<picture>", depth = "<depth>"; // what an empty name in a script means
        D3DCOLOR clearColor = 0;
        float clearDepth = 1;
    };

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
    UINT number(D3DXHANDLE owner, const char* annotation, UINT otherwise) {
        INT value = 0;
        const D3DXHANDLE handle = effect_->GetAnnotationByName(owner, annotation);
        return handle && SUCCEEDED(effect_->GetInt(handle, &value)) ? static_cast<UINT>(value) : otherwise;
    }

    // "Name=value; Name=value;": docs/scripts.md has the whole language.
    void runScript(D3DXHANDLE owner, State state) {
        std::string script = text(owner, "Script");
        std::erase(script, ' ');
        for (std::size_t at = 0; at < script.size();) {
            const std::size_t end = std::min(script.find(';', at), script.size()), equals = std::min(script.find('=', at), end);
            const std::string name = script.substr(at, equals - at),
                              value = equals < end ? script.substr(equals + 1, end - equals - 1) : "";
            at = end + 1;
            INT count = 1; // LoopByCount as a switch: its body runs once or not at all
            if (name == "LoopByCount") check(effect_->GetInt(value.c_str(), &count), value);
            if (count == 0) at = script.find(';', script.find("LoopEnd", at)) + 1;
            execute(name, value, owner, state);
        }
    }

    void execute(const std::string& name, const std::string& value, D3DXHANDLE owner, State& state) {
        float rgba[4] = {};
        if (name == "RenderColorTarget0")
            state.color = value.empty() ? "<picture>" : value;
        else if (name == "RenderDepthStencilTarget")
            state.depth = value.empty() ? "<depth>" : value;
        else if (name == "ClearSetColor" && SUCCEEDED(effect_->GetFloatArray(value.c_str(), rgba, 4)))
            state.clearColor = D3DCOLOR_COLORVALUE(rgba[0], rgba[1], rgba[2], rgba[3]); // eight bits a channel
        else if (name == "ClearSetDepth")
            check(effect_->GetFloat(value.c_str(), &state.clearDepth), value);
        else if (name == "Pass")
            runScript(effect_->GetPassByName(owner, value.c_str()), state);
        else if (name == "Clear" || name == "Draw")
            bind(state);
        if (name == "Clear")
            check(device_->Clear(0, nullptr, value == "Color" ? D3DCLEAR_TARGET : D3DCLEAR_ZBUFFER, state.clearColor, state.clearDepth, 0),
                  name);
        if (name == "Draw") drawPass(owner, value == "Geometry");
    }

    void bind(const State& state) {
        const Target &color = targets_.at(state.color), &depth = targets_.at(state.depth);
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

    void drawPass(D3DXHANDLE pass, bool mesh) {
        UINT count = 0, index = 0;
        while (effect_->GetPass(effect_->GetCurrentTechnique(), index) != pass)
            ++index;
        check(effect_->Begin(&count, 0), "Begin");
        check(effect_->BeginPass(index), "BeginPass");
        (*draw_)(mesh);
        check(effect_->EndPass(), "EndPass");
        check(effect_->End(), "End");
    }

    IDirect3DDevice9* device_;
    ComPtr<ID3DXEffect> effect_;
    std::map<std::string, Target> targets_;
    const Draw* draw_ = nullptr;
};
