// Direct3D 10 through its effects: values by semantic, scripts from annotations. Sizes of targets come from the job: Wine 8 crashes when a
// numeric annotation is read.

#include "backends.h"
#include "com.h"
#include "dxgi.h"

#include <d3d10.h>
#include <d3d10effect.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace client {

namespace {

struct Target {
    TargetShape shape;
    Com<ID3D10Texture2D> texture;
    Com<ID3D10RenderTargetView> color;
    Com<ID3D10DepthStencilView> depth;
    Com<ID3D10ShaderResourceView> resource;
};

struct Mesh {
    Com<ID3D10Buffer> vertices;
    Com<ID3D10Buffer> indices;
    unsigned indexCount = 0;
};

ID3D10Device* device() {
    static Com<ID3D10Device> made;
    if (!made) must(D3D10CreateDevice(nullptr, D3D10_DRIVER_TYPE_HARDWARE, nullptr, 0, D3D10_SDK_VERSION, made.put()), "D3D10CreateDevice");
    return made.get();
}

D3D10_TEXTURE2D_DESC describe(unsigned width, unsigned height, unsigned levels, DXGI_FORMAT format, UINT bind) {
    D3D10_TEXTURE2D_DESC desc{};
    desc.Width = width;
    desc.Height = height;
    desc.MipLevels = levels;
    desc.ArraySize = 1;
    desc.Format = format;
    desc.SampleDesc.Count = 1;
    desc.BindFlags = bind;
    return desc;
}

Target makeTarget(const TargetShape& shape) {
    Target target{shape, {}, {}, {}, {}};
    const UINT bind = shape.depth ? D3D10_BIND_DEPTH_STENCIL : D3D10_BIND_RENDER_TARGET | D3D10_BIND_SHADER_RESOURCE;
    D3D10_TEXTURE2D_DESC desc = describe(shape.width, shape.height, shape.levels, targetFormat(shape).format, bind);
    if (shape.levels != 1) desc.MiscFlags = D3D10_RESOURCE_MISC_GENERATE_MIPS;
    must(device()->CreateTexture2D(&desc, nullptr, target.texture.put()), "CreateTexture2D");
    if (shape.depth) {
        must(device()->CreateDepthStencilView(target.texture.get(), nullptr, target.depth.put()), "CreateDepthStencilView");
        return target;
    }
    must(device()->CreateRenderTargetView(target.texture.get(), nullptr, target.color.put()), "CreateRenderTargetView");
    must(device()->CreateShaderResourceView(target.texture.get(), nullptr, target.resource.put()), "CreateShaderResourceView");
    return target;
}

Com<ID3D10ShaderResourceView> upload(const TextureFile& file) {
    D3D10_TEXTURE2D_DESC desc = describe(file.width, file.height, file.levels, textureFormat(file.format), D3D10_BIND_SHADER_RESOURCE);
    desc.ArraySize = file.faces;
    if (file.faces == 6) desc.MiscFlags = D3D10_RESOURCE_MISC_TEXTURECUBE;
    std::vector<D3D10_SUBRESOURCE_DATA> data;
    for (unsigned i = 0; i < file.faces * file.levels; ++i)
        data.push_back({file.images[i].data(), file.pitchOf(i % file.levels), 0});
    Com<ID3D10Texture2D> texture;
    Com<ID3D10ShaderResourceView> view;
    must(device()->CreateTexture2D(&desc, data.data(), texture.put()), "CreateTexture2D");
    must(device()->CreateShaderResourceView(texture.get(), nullptr, view.put()), "CreateShaderResourceView");
    return view;
}

Com<ID3D10Buffer> makeBuffer(const void* data, std::size_t bytes, UINT bind) {
    const D3D10_BUFFER_DESC desc{static_cast<UINT>(bytes), D3D10_USAGE_DEFAULT, bind, 0, 0};
    const D3D10_SUBRESOURCE_DATA initial{data, 0, 0};
    Com<ID3D10Buffer> buffer;
    must(device()->CreateBuffer(&desc, &initial, buffer.put()), "CreateBuffer");
    return buffer;
}

Mesh upload(const MeshFile& file) {
    return {makeBuffer(file.vertices.data(), file.vertices.size() * sizeof(float), D3D10_BIND_VERTEX_BUFFER),
            makeBuffer(file.indices.data(), file.indices.size() * sizeof(std::uint32_t), D3D10_BIND_INDEX_BUFFER),
            static_cast<unsigned>(file.indices.size())};
}

template <class Owner>
std::string text(Owner* owner, const char* annotation) {
    ID3D10EffectVariable* found = owner->GetAnnotationByName(annotation);
    LPCSTR value = nullptr;
    return found->IsValid() && SUCCEEDED(found->AsString()->GetString(&value)) && value ? value : "";
}

class Direct3D10 final : public Engine {
public:
    explicit Direct3D10(const Job& job) : job_(job) {
        loadEffect();
        targets_.emplace("", makeTarget({false, job.width, job.height, "A32B32G32R32F", 1}));
        pictureDepth_ = makeTarget({true, job.width, job.height, "D24S8", 1});
        for (const auto& [name, shape] : job.targets) {
            const Target& target = targets_.emplace(name, makeTarget(shape)).first->second;
            if (!shape.depth) setTexture(name, target.resource.get());
        }
        for (const auto& [name, file] : job.textures)
            setTexture(name, textures_.emplace_back(upload(readTexture(job.path(file)))).get());
        setValues();
        quad_ = upload(fullScreenQuad());
        if (!job.mesh.empty()) mesh_ = upload(readMesh(job.path(job.mesh)));
        clearAll();
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

    void bind(const Bound& bound) override;
    void clear(Clear what, const Numbers& value) override;
    void draw(const std::string& pass, Drawing drawing) override;
    std::vector<std::string> targets() override;
    Pixels read(const std::string& target) override;

private:
    void loadEffect();
    void setValues();
    void setValue(ID3D10EffectVariable* variable, const std::string& name, Numbers value);
    void setTexture(const std::string& name, ID3D10ShaderResourceView* view);
    void clearAll();
    ID3D10InputLayout* layout(const std::string& pass, const D3D10_PASS_DESC& desc);

    const Job& job_;
    Com<ID3D10Effect> effect_;
    ID3D10EffectTechnique* technique_ = nullptr;
    std::map<std::string, Target> targets_;
    Target pictureDepth_;
    std::vector<Com<ID3D10ShaderResourceView>> textures_;
    std::map<std::string, Com<ID3D10InputLayout>> layouts_;
    Mesh mesh_;
    Mesh quad_;
    std::vector<Target*> boundColors_;
    Target* boundDepth_ = nullptr;
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

void Direct3D10::setValue(ID3D10EffectVariable* variable, const std::string& name, Numbers value) {
    D3D10_EFFECT_TYPE_DESC type{};
    must(variable->GetType()->GetDesc(&type), "GetDesc " + name);
    if (type.Class == D3D10_SVC_SCALAR && type.Elements == 0) return must(variable->AsScalar()->SetFloat(value[0]), "SetFloat " + name);
    if (type.Rows == 4) return must(variable->AsMatrix()->SetMatrix(value.data()), "SetMatrix " + name);
    if (value.size() == 3 && type.Columns == 4) value.push_back(1); // a position's w, a colour's alpha
    must(variable->SetRawValue(value.data(), 0, static_cast<UINT>(value.size() * sizeof(float))), "SetRawValue " + name);
}

void Direct3D10::setValues() {
    D3D10_EFFECT_DESC effect{};
    must(effect_->GetDesc(&effect), "GetDesc");
    for (UINT i = 0; i < effect.GlobalVariables; ++i) {
        ID3D10EffectVariable* variable = effect_->GetVariableByIndex(i);
        D3D10_EFFECT_VARIABLE_DESC desc{};
        must(variable->GetDesc(&desc), "GetDesc");
        const Numbers* value = desc.Semantic ? job_.findScene(desc.Semantic, text(variable, "Object")) : nullptr;
        if (value) setValue(variable, desc.Name, *value);
        if (const auto own = job_.values.find(desc.Name); own != job_.values.end()) setValue(variable, desc.Name, own->second);
    }
}

/// A frame depends on nothing that was there before.
void Direct3D10::clearAll() {
    const auto& rgb = job_.background;
    const float background[] = {rgb[0], rgb[1], rgb[2], 0};
    const float zeros[] = {0, 0, 0, 0};
    for (const auto& [name, target] : targets_)
        if (target.color)
            device()->ClearRenderTargetView(target.color.get(), name.empty() ? background : zeros);
        else
            device()->ClearDepthStencilView(target.depth.get(), D3D10_CLEAR_DEPTH | D3D10_CLEAR_STENCIL, 1, 0);
    device()->ClearDepthStencilView(pictureDepth_.depth.get(), D3D10_CLEAR_DEPTH | D3D10_CLEAR_STENCIL, 1, 0);
}

/// Views of different sizes cannot be bound together: a depth target of another size is left out.
void Direct3D10::bind(const Bound& bound) {
    ID3D10ShaderResourceView* none[16] = {};
    device()->VSSetShaderResources(0, 16, none);
    device()->PSSetShaderResources(0, 16, none);
    boundColors_.clear();
    std::vector<ID3D10RenderTargetView*> views;
    for (const auto& name : bound.colors) {
        if (!name) break;
        boundColors_.push_back(&targets_.at(*name));
        views.push_back(boundColors_.back()->color.get());
    }
    const TargetShape& first = boundColors_.at(0)->shape;
    boundDepth_ = !bound.depth ? nullptr : bound.depth->empty() ? &pictureDepth_ : &targets_.at(*bound.depth);
    if (boundDepth_ && (boundDepth_->shape.width != first.width || boundDepth_->shape.height != first.height)) boundDepth_ = nullptr;
    device()->OMSetRenderTargets(static_cast<UINT>(views.size()), views.data(), boundDepth_ ? boundDepth_->depth.get() : nullptr);
    const D3D10_VIEWPORT viewport{0, 0, first.width, first.height, 0, 1};
    device()->RSSetViewports(1, &viewport);
    ID3D10EffectVariable* size = effect_->GetVariableBySemantic("VIEWPORTPIXELSIZE");
    if (size->IsValid()) setValue(size, "VIEWPORTPIXELSIZE", {static_cast<float>(first.width), static_cast<float>(first.height)});
}

void Direct3D10::clear(Clear what, const Numbers& value) {
    if (what == Clear::Color) {
        for (const Target* target : boundColors_)
            device()->ClearRenderTargetView(target->color.get(), value.data());
    } else if (boundDepth_) {
        const UINT flags = what == Clear::Depth ? D3D10_CLEAR_DEPTH : D3D10_CLEAR_STENCIL;
        device()->ClearDepthStencilView(boundDepth_->depth.get(), flags, value[0], static_cast<UINT8>(value[0]));
    }
}

ID3D10InputLayout* Direct3D10::layout(const std::string& pass, const D3D10_PASS_DESC& desc) {
    const D3D10_INPUT_ELEMENT_DESC elements[] = {{"POSITION", 0, DXGI_FORMAT_R32G32B32_FLOAT, 0, 0, D3D10_INPUT_PER_VERTEX_DATA, 0},
                                                 {"NORMAL", 0, DXGI_FORMAT_R32G32B32_FLOAT, 0, 12, D3D10_INPUT_PER_VERTEX_DATA, 0},
                                                 {"TANGENT", 0, DXGI_FORMAT_R32G32B32A32_FLOAT, 0, 24, D3D10_INPUT_PER_VERTEX_DATA, 0},
                                                 {"TEXCOORD", 0, DXGI_FORMAT_R32G32_FLOAT, 0, 40, D3D10_INPUT_PER_VERTEX_DATA, 0}};
    Com<ID3D10InputLayout>& made = layouts_[pass];
    if (!made)
        must(device()->CreateInputLayout(elements, 4, desc.pIAInputSignature, desc.IAInputSignatureSize, made.put()), "CreateInputLayout");
    return made.get();
}

void Direct3D10::draw(const std::string& name, Drawing drawing) {
    ID3D10EffectPass* pass = technique_->GetPassByName(name.c_str());
    D3D10_PASS_DESC desc{};
    must(pass->GetDesc(&desc), "GetDesc " + name);
    const Mesh& mesh = drawing == Drawing::Quad ? quad_ : mesh_;
    ID3D10Buffer* vertices = mesh.vertices.get();
    const UINT stride = kVertexBytes;
    const UINT offset = 0;
    device()->IASetInputLayout(layout(name, desc));
    device()->IASetVertexBuffers(0, 1, &vertices, &stride, &offset);
    device()->IASetIndexBuffer(mesh.indices.get(), DXGI_FORMAT_R32_UINT, 0);
    device()->IASetPrimitiveTopology(D3D10_PRIMITIVE_TOPOLOGY_TRIANGLELIST);
    must(pass->Apply(0), "Apply " + name);
    const std::string instances = text(pass, "Instances");
    const auto count = instances.empty() ? 1U : static_cast<UINT>(numbers(instances).at(0));
    device()->DrawIndexedInstanced(mesh.indexCount, count, 0, 0, 0);
    for (const Target* target : boundColors_)
        if (target->shape.levels != 1) device()->GenerateMips(target->resource.get());
}

std::vector<std::string> Direct3D10::targets() {
    std::vector<std::string> names;
    for (const auto& [name, target] : targets_)
        names.push_back(name);
    return names;
}

Pixels Direct3D10::read(const std::string& name) {
    const Target& target = targets_.at(name);
    D3D10_TEXTURE2D_DESC desc =
        describe(target.shape.width, target.shape.height, target.shape.levels, targetFormat(target.shape).format, 0);
    desc.Usage = D3D10_USAGE_STAGING;
    desc.CPUAccessFlags = D3D10_CPU_ACCESS_READ;
    Com<ID3D10Texture2D> copy;
    must(device()->CreateTexture2D(&desc, nullptr, copy.put()), "CreateTexture2D");
    device()->CopyResource(copy.get(), target.texture.get());
    D3D10_MAPPED_TEXTURE2D mapped{};
    must(copy->Map(0, D3D10_MAP_READ, 0, &mapped), "Map");
    Pixels pixels = readRows(target.shape, mapped.pData, mapped.RowPitch);
    copy->Unmap(0);
    return pixels;
}

} // namespace

std::unique_ptr<Engine> openDirect3D10(const Job& job) {
    return std::make_unique<Direct3D10>(job);
}

} // namespace client
