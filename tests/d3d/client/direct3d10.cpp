// Direct3D 10 through its effects: values by semantic, scripts from annotations. Sizes of targets come from the job: Wine 8 crashes when a
// numeric annotation is read.

#include "backends.h"
#include "canvas.h"

#include <d3d10.h>
#include <d3d10effect.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace client {

namespace {

ID3D10Device* device() {
    static Com<ID3D10Device> made;
    if (!made) must(D3D10CreateDevice(nullptr, D3D10_DRIVER_TYPE_HARDWARE, nullptr, 0, D3D10_SDK_VERSION, made.put()), "D3D10CreateDevice");
    return made.get();
}

struct Api {
    using Texture = ID3D10Texture2D;
    using ColorView = ID3D10RenderTargetView;
    using DepthView = ID3D10DepthStencilView;
    using ResourceView = ID3D10ShaderResourceView;
    using Buffer = ID3D10Buffer;
    using Layout = ID3D10InputLayout;
    using TextureDesc = D3D10_TEXTURE2D_DESC;
    using DepthViewDesc = D3D10_DEPTH_STENCIL_VIEW_DESC;
    using ResourceViewDesc = D3D10_SHADER_RESOURCE_VIEW_DESC;
    using BufferDesc = D3D10_BUFFER_DESC;
    using Data = D3D10_SUBRESOURCE_DATA;
    using Mapped = D3D10_MAPPED_TEXTURE2D;
    using Viewport = D3D10_VIEWPORT;
    using Element = D3D10_INPUT_ELEMENT_DESC;

    static constexpr UINT kColor = D3D10_BIND_RENDER_TARGET;
    static constexpr UINT kDepth = D3D10_BIND_DEPTH_STENCIL;
    static constexpr UINT kResource = D3D10_BIND_SHADER_RESOURCE;
    static constexpr UINT kStore = 0;
    static constexpr UINT kVertices = D3D10_BIND_VERTEX_BUFFER;
    static constexpr UINT kIndices = D3D10_BIND_INDEX_BUFFER;
    static constexpr UINT kMakeMips = D3D10_RESOURCE_MISC_GENERATE_MIPS;
    static constexpr UINT kCube = D3D10_RESOURCE_MISC_TEXTURECUBE;
    static constexpr auto kPerVertex = D3D10_INPUT_PER_VERTEX_DATA;
    static constexpr auto kTriangles = D3D10_PRIMITIVE_TOPOLOGY_TRIANGLELIST;
    static constexpr UINT kClearDepth = D3D10_CLEAR_DEPTH;
    static constexpr UINT kClearStencil = D3D10_CLEAR_STENCIL;
    static constexpr auto kDepthView2D = D3D10_DSV_DIMENSION_TEXTURE2D;
    static constexpr auto kResourceView2D = D3D10_SRV_DIMENSION_TEXTURE2D;
    static constexpr auto kDefault = D3D10_USAGE_DEFAULT;
    static constexpr auto kStaging = D3D10_USAGE_STAGING;
    static constexpr UINT kRead = D3D10_CPU_ACCESS_READ;

    static ID3D10Device* device() { return client::device(); }
    static ID3D10Device* context() { return client::device(); }
    static Mapped map(Texture* texture) {
        Mapped mapped{};
        must(texture->Map(0, D3D10_MAP_READ, 0, &mapped), "Map");
        return mapped;
    }
    static void unmap(Texture* texture) { texture->Unmap(0); }
};

template <class Owner>
std::string text(Owner* owner, const char* annotation) {
    ID3D10EffectVariable* found = owner->GetAnnotationByName(annotation);
    LPCSTR value = nullptr;
    return found->IsValid() && SUCCEEDED(found->AsString()->GetString(&value)) && value ? value : "";
}

class Direct3D10 final : public Engine {
public:
    explicit Direct3D10(const Job& job) : job_(job), canvas_(job) {
        loadEffect();
        for (const auto& [name, target] : canvas_.targets())
            if (!name.empty() && target.resource) setTexture(name, target.resource.get());
        for (const auto& [name, file] : job.textures)
            setTexture(name, textures_.emplace_back(uploadTexture<Api>(readTexture(job.path(file)))).get());
        setValues();
    }

    std::string techniqueScript() override { return text(technique_, "Script"); }
    std::vector<std::string> passes() override {
        D3D10_TECHNIQUE_DESC technique{};
        must(technique_->GetDesc(&technique), "GetDesc");
        std::vector<std::string> names;
        for (UINT i = 0; i < technique.Passes; ++i) {
            D3D10_PASS_DESC pass{};
            must(technique_->GetPassByIndex(i)->GetDesc(&pass), "GetDesc");
            names.emplace_back(pass.Name);
        }
        return names;
    }
    std::string passScript(const std::string& pass) override { return text(technique_->GetPassByName(pass.c_str()), "Script"); }

    Numbers numbers(const std::string& parameter) override {
        ID3D10EffectVariable* variable = effect_->GetVariableByName(parameter.c_str());
        D3D10_EFFECT_TYPE_DESC type{};
        must(variable->GetType()->GetDesc(&type), "GetDesc " + parameter);
        Numbers values(std::max(type.Columns, 1U));
        must(type.Class == D3D10_SVC_SCALAR ? variable->AsScalar()->GetFloat(values.data())
                                            : variable->AsVector()->GetFloatVector(values.data()),
             "the value of " + parameter);
        return values;
    }
    void setNumber(const std::string& parameter, float value) override {
        must(effect_->GetVariableByName(parameter.c_str())->AsScalar()->SetFloat(value), "SetFloat " + parameter);
    }

    void setTargets(const Bound& bound) override;
    using Engine::clear;
    using Engine::draw;
    void clear(Clear what, const Numbers& value) override { canvas_.clear(what, value); }
    void draw(const std::string& pass, Drawing drawing) override;
    std::vector<std::string> targets() override { return canvas_.names(); }
    Pixels read(const std::string& target) override { return canvas_.read(target); }

private:
    void loadEffect();
    void setValues();
    void setValue(ID3D10EffectVariable* variable);
    void setTexture(const std::string& name, ID3D10ShaderResourceView* view);
    ID3D10InputLayout* layout(const std::string& pass, const D3D10_PASS_DESC& desc);

    const Job& job_;
    Canvas<Api> canvas_;
    Com<ID3D10Effect> effect_;
    ID3D10EffectTechnique* technique_ = nullptr;
    std::vector<Com<ID3D10ShaderResourceView>> textures_;
    std::map<std::string, Com<ID3D10InputLayout>> layouts_;
};

void Direct3D10::loadEffect() {
    std::ifstream in(job_.path(job_.effect), std::ios::binary);
    std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    must(D3D10CreateEffectFromMemory(bytes.data(), bytes.size(), 0, device(), nullptr, effect_.put()), "D3D10CreateEffectFromMemory");
    technique_ = effect_->GetTechniqueByName(job_.technique.c_str());
    if (!technique_->IsValid()) fail("the effect has no technique " + job_.technique);
}

void Direct3D10::setTexture(const std::string& name, ID3D10ShaderResourceView* view) {
    must(effect_->GetVariableByName(name.c_str())->AsShaderResource()->SetResource(view), "SetResource " + name);
}

void Direct3D10::setValue(ID3D10EffectVariable* variable) {
    D3D10_EFFECT_VARIABLE_DESC desc{};
    D3D10_EFFECT_TYPE_DESC type{};
    must(variable->GetDesc(&desc), "GetDesc");
    const std::string name = desc.Name;
    must(variable->GetType()->GetDesc(&type), "GetDesc " + name);
    auto value = job_.valueOf(name, desc.Semantic ? desc.Semantic : "", text(variable, "Object"), type.Columns);
    if (!value) return;
    if (type.Class == D3D10_SVC_SCALAR && type.Elements == 0) return must(variable->AsScalar()->SetFloat(value->at(0)), "SetFloat " + name);
    if (type.Rows == 4) return must(variable->AsMatrix()->SetMatrix(value->data()), "SetMatrix " + name);
    must(variable->SetRawValue(value->data(), 0, static_cast<UINT>(value->size() * sizeof(float))), "SetRawValue " + name);
}

void Direct3D10::setValues() {
    D3D10_EFFECT_DESC effect{};
    must(effect_->GetDesc(&effect), "GetDesc");
    for (UINT i = 0; i < effect.GlobalVariables; ++i)
        setValue(effect_->GetVariableByIndex(i));
}

void Direct3D10::setTargets(const Bound& bound) {
    ID3D10ShaderResourceView* none[16] = {};
    device()->VSSetShaderResources(0, 16, none);
    device()->PSSetShaderResources(0, 16, none);
    Numbers viewport = canvas_.bind(bound);
    if (ID3D10EffectVariable* size = effect_->GetVariableBySemantic("VIEWPORTPIXELSIZE"); size->IsValid())
        must(size->SetRawValue(viewport.data(), 0, 2 * sizeof(float)), "SetRawValue VIEWPORTPIXELSIZE");
}

ID3D10InputLayout* Direct3D10::layout(const std::string& pass, const D3D10_PASS_DESC& desc) {
    Com<ID3D10InputLayout>& made = layouts_[pass];
    if (!made) made = vertexLayout<Api>(desc.pIAInputSignature, desc.IAInputSignatureSize, pass);
    return made.get();
}

void Direct3D10::draw(const std::string& name, Drawing drawing) {
    ID3D10EffectPass* pass = technique_->GetPassByName(name.c_str());
    D3D10_PASS_DESC desc{};
    must(pass->GetDesc(&desc), "GetDesc " + name);
    must(pass->Apply(0), "Apply " + name);
    const std::string instances = text(pass, "Instances");
    canvas_.draw(drawing, name, layout(name, desc), instances.empty() ? 1U : static_cast<UINT>(numbers(instances).at(0)));
}

} // namespace

std::unique_ptr<Engine> openDirect3D10(const Job& job) {
    return std::make_unique<Direct3D10>(job);
}

} // namespace client
