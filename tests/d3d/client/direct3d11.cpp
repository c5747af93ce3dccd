// Direct3D 11 from compiled entry points: offsets, bindings and defaults by reflection; scripts, semantics and states from the job, because
// a compiled shader has lost them.

#include "backends.h"
#include "com.h"
#include "dxgi.h"

#include <d3d11.h>
#include <d3d11shader.h>
#include <d3dcompiler.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

namespace client {

namespace {

struct Target {
    TargetShape shape;
    Com<ID3D11Texture2D> texture;
    Com<ID3D11RenderTargetView> color;
    Com<ID3D11DepthStencilView> depth;
    Com<ID3D11ShaderResourceView> resource;
};

struct Mesh {
    Com<ID3D11Buffer> vertices;
    Com<ID3D11Buffer> indices;
    unsigned indexCount = 0;
};

struct Code {
    std::vector<char> bytes;
    Com<ID3D11ShaderReflection> reflection;
};

struct Program {
    Code vertexCode;
    Code pixelCode;
    Com<ID3D11VertexShader> vertex;
    Com<ID3D11PixelShader> pixel;
    Com<ID3D11InputLayout> layout;
    Com<ID3D11DepthStencilState> depth;
    Com<ID3D11BlendState> blend;
    Com<ID3D11RasterizerState> raster;
};

struct Device {
    Com<ID3D11Device> device;
    Com<ID3D11DeviceContext> context;
};

Device& made() {
    static Device opened;
    const D3D_FEATURE_LEVEL level = D3D_FEATURE_LEVEL_11_0; // what shader model 5 needs
    if (!opened.device)
        must(D3D11CreateDevice(nullptr, D3D_DRIVER_TYPE_HARDWARE, nullptr, 0, &level, 1, D3D11_SDK_VERSION, opened.device.put(), nullptr,
                               opened.context.put()),
             "D3D11CreateDevice");
    return opened;
}

ID3D11Device* device() {
    return made().device.get();
}

ID3D11DeviceContext* context() {
    return made().context.get();
}

D3D11_TEXTURE2D_DESC describe(unsigned width, unsigned height, unsigned levels, DXGI_FORMAT format, UINT bind) {
    D3D11_TEXTURE2D_DESC desc{};
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
    const UINT bind = shape.depth ? D3D11_BIND_DEPTH_STENCIL : D3D11_BIND_RENDER_TARGET | D3D11_BIND_SHADER_RESOURCE;
    D3D11_TEXTURE2D_DESC desc = describe(shape.width, shape.height, shape.levels, targetFormat(shape).format, bind);
    if (shape.levels != 1) desc.MiscFlags = D3D11_RESOURCE_MISC_GENERATE_MIPS;
    must(device()->CreateTexture2D(&desc, nullptr, target.texture.put()), "CreateTexture2D");
    if (shape.depth) {
        must(device()->CreateDepthStencilView(target.texture.get(), nullptr, target.depth.put()), "CreateDepthStencilView");
        return target;
    }
    must(device()->CreateRenderTargetView(target.texture.get(), nullptr, target.color.put()), "CreateRenderTargetView");
    must(device()->CreateShaderResourceView(target.texture.get(), nullptr, target.resource.put()), "CreateShaderResourceView");
    return target;
}

Com<ID3D11ShaderResourceView> upload(const TextureFile& file) {
    D3D11_TEXTURE2D_DESC desc = describe(file.width, file.height, file.levels, textureFormat(file.format), D3D11_BIND_SHADER_RESOURCE);
    desc.ArraySize = file.faces;
    if (file.faces == 6) desc.MiscFlags = D3D11_RESOURCE_MISC_TEXTURECUBE;
    std::vector<D3D11_SUBRESOURCE_DATA> data;
    for (unsigned i = 0; i < file.faces * file.levels; ++i)
        data.push_back({file.images[i].data(), file.pitchOf(i % file.levels), 0});
    Com<ID3D11Texture2D> texture;
    Com<ID3D11ShaderResourceView> view;
    must(device()->CreateTexture2D(&desc, data.data(), texture.put()), "CreateTexture2D");
    must(device()->CreateShaderResourceView(texture.get(), nullptr, view.put()), "CreateShaderResourceView");
    return view;
}

Com<ID3D11Buffer> makeBuffer(const void* data, std::size_t bytes, UINT bind) {
    const D3D11_BUFFER_DESC desc{static_cast<UINT>(bytes), D3D11_USAGE_DEFAULT, bind, 0, 0, 0};
    const D3D11_SUBRESOURCE_DATA initial{data, 0, 0};
    Com<ID3D11Buffer> buffer;
    must(device()->CreateBuffer(&desc, &initial, buffer.put()), "CreateBuffer");
    return buffer;
}

Mesh upload(const MeshFile& file) {
    return {makeBuffer(file.vertices.data(), file.vertices.size() * sizeof(float), D3D11_BIND_VERTEX_BUFFER),
            makeBuffer(file.indices.data(), file.indices.size() * sizeof(std::uint32_t), D3D11_BIND_INDEX_BUFFER),
            static_cast<unsigned>(file.indices.size())};
}

Code readCode(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    Code code{{std::istreambuf_iterator<char>(in), {}}, {}};
    // as in Microsoft's header; MinGW's knows another version of the interface
    const GUID reflection = {0x8d536ca1, 0x0cca, 0x4956, {0xa8, 0x37, 0x78, 0x69, 0x63, 0x75, 0x55, 0x84}};
    must(D3DReflect(code.bytes.data(), code.bytes.size(), reflection, reinterpret_cast<void**>(code.reflection.put())),
         "D3DReflect " + path);
    return code;
}

// ---- States. The numbers are those of host/support/state.h.

template <class Enum>
Enum next(float number) {
    return static_cast<Enum>(static_cast<int>(number) + 1); // Direct3D counts from 1
}

D3D11_BLEND blendFactor(float number) {
    constexpr int kConstant = 11; // from the blend constant on Direct3D has a gap of two
    const int index = static_cast<int>(number);
    return static_cast<D3D11_BLEND>(index < kConstant ? index + 1 : index + 3);
}

Com<ID3D11DepthStencilState> depthState(const Numbers& state) {
    D3D11_DEPTH_STENCIL_DESC desc{};
    desc.DepthEnable = state.at(0) != 0;
    desc.DepthWriteMask = state.at(1) != 0 ? D3D11_DEPTH_WRITE_MASK_ALL : D3D11_DEPTH_WRITE_MASK_ZERO;
    desc.DepthFunc = next<D3D11_COMPARISON_FUNC>(state.at(2));
    desc.FrontFace = {D3D11_STENCIL_OP_KEEP, D3D11_STENCIL_OP_KEEP, D3D11_STENCIL_OP_KEEP, D3D11_COMPARISON_ALWAYS};
    desc.BackFace = desc.FrontFace;
    Com<ID3D11DepthStencilState> result;
    must(device()->CreateDepthStencilState(&desc, result.put()), "CreateDepthStencilState");
    return result;
}

Com<ID3D11RasterizerState> rasterState(const Numbers& state) {
    D3D11_RASTERIZER_DESC desc{};
    desc.FillMode = D3D11_FILL_SOLID;
    desc.CullMode = next<D3D11_CULL_MODE>(state.at(0));
    desc.FrontCounterClockwise = state.at(1) != 0;
    desc.DepthClipEnable = TRUE;
    Com<ID3D11RasterizerState> result;
    must(device()->CreateRasterizerState(&desc, result.put()), "CreateRasterizerState");
    return result;
}

Com<ID3D11BlendState> blendState(const PassInfo& pass) {
    D3D11_BLEND_DESC desc{};
    desc.IndependentBlendEnable = TRUE;
    for (unsigned slot = 0; slot < kMaxColors; ++slot) {
        const Numbers& state = pass.state.at("blend" + std::to_string(slot));
        D3D11_RENDER_TARGET_BLEND_DESC& target = desc.RenderTarget[slot];
        target.BlendEnable = state.at(0) != 0;
        target.SrcBlend = blendFactor(state.at(1));
        target.DestBlend = blendFactor(state.at(2));
        target.BlendOp = next<D3D11_BLEND_OP>(state.at(3));
        target.SrcBlendAlpha = blendFactor(state.at(4));
        target.DestBlendAlpha = blendFactor(state.at(5));
        target.BlendOpAlpha = next<D3D11_BLEND_OP>(state.at(6));
        target.RenderTargetWriteMask = static_cast<UINT8>(state.at(7));
    }
    Com<ID3D11BlendState> result;
    must(device()->CreateBlendState(&desc, result.put()), "CreateBlendState");
    return result;
}

Com<ID3D11SamplerState> samplerState(const SamplerInfo& info) {
    constexpr D3D11_FILTER kFilters[] = {D3D11_FILTER_MIN_MAG_MIP_POINT, D3D11_FILTER_MIN_MAG_MIP_LINEAR, D3D11_FILTER_ANISOTROPIC};
    D3D11_SAMPLER_DESC desc{};
    desc.Filter = kFilters[std::stoi(info.filter)];
    desc.AddressU = desc.AddressV = desc.AddressW = next<D3D11_TEXTURE_ADDRESS_MODE>(std::stof(info.address));
    desc.MaxAnisotropy = 1;
    desc.ComparisonFunc = D3D11_COMPARISON_NEVER;
    desc.MaxLOD = D3D11_FLOAT32_MAX;
    Com<ID3D11SamplerState> result;
    must(device()->CreateSamplerState(&desc, result.put()), "CreateSamplerState");
    return result;
}

// ---- Constants

/// A float4x4 lies column after column; elements of arrays start 16 bytes apart; int and bool are 32 bits.
void writeVariable(ID3D11ShaderReflectionVariable* variable, const Numbers& value, char* block) {
    D3D11_SHADER_VARIABLE_DESC desc{};
    D3D11_SHADER_TYPE_DESC type{};
    variable->GetDesc(&desc);
    variable->GetType()->GetDesc(&type);
    const unsigned rows = type.Rows;
    const unsigned columns = type.Columns;
    const unsigned elements = std::max(type.Elements, 1U);
    std::size_t at = 0;
    for (unsigned element = 0; element < elements; ++element)
        for (unsigned row = 0; row < rows; ++row)
            for (unsigned column = 0; column < columns && at < value.size(); ++column, ++at) {
                const unsigned vector = rows > 1 ? element * columns + column : element;
                char* to = block + desc.StartOffset + 16 * vector + 4 * (rows > 1 ? row : column);
                const auto whole = static_cast<int>(value[at]);
                if (type.Type == D3D_SVT_FLOAT)
                    std::memcpy(to, &value[at], 4);
                else
                    std::memcpy(to, &whole, 4);
            }
}

class Direct3D11 final : public Engine {
public:
    explicit Direct3D11(const Job& job) : job_(job), numbers_(job.numbers) {
        targets_.emplace("", makeTarget({false, job.width, job.height, "A32B32G32R32F", 1}));
        pictureDepth_ = makeTarget({true, job.width, job.height, "D24S8", 1});
        for (const auto& [name, shape] : job.targets)
            targets_.emplace(name, makeTarget(shape));
        for (const auto& [name, file] : job.textures)
            textures_.emplace(name, upload(readTexture(job.path(file))));
        for (const auto& [name, info] : job.samplers)
            samplers_.emplace(name, samplerState(info));
        quad_ = upload(fullScreenQuad());
        if (!job.mesh.empty()) mesh_ = upload(readMesh(job.path(job.mesh)));
        clearAll();
    }

    std::string techniqueScript() override { return job_.script; }
    std::vector<std::string> passes() override {
        std::vector<std::string> names;
        for (const PassInfo& pass : job_.passes)
            names.push_back(pass.name);
        return names;
    }
    std::string passScript(const std::string& pass) override { return find(pass).script; }
    Numbers numbers(const std::string& parameter) override {
        const auto found = numbers_.find(parameter);
        if (found == numbers_.end()) fail("the script reads " + parameter + ", which has no value");
        return found->second;
    }
    void setNumber(const std::string& parameter, float value) override { numbers_[parameter] = {value}; }

    void bind(const Bound& bound) override;
    void clear(Clear what, const Numbers& value) override;
    void draw(const std::string& pass, Drawing drawing) override;
    std::vector<std::string> targets() override;
    Pixels read(const std::string& target) override;

private:
    const PassInfo& find(const std::string& pass) {
        for (const PassInfo& info : job_.passes)
            if (upper(info.name) == upper(pass)) return info;
        fail("the technique has no pass " + pass);
    }
    Program& program(const PassInfo& pass);
    const Numbers* valueOf(const std::string& name);
    Com<ID3D11Buffer> constants(ID3D11ShaderReflectionConstantBuffer* buffer);
    ID3D11ShaderResourceView* resource(const std::string& name);
    void bindStage(const Code& code, bool pixel);
    void clearAll();

    const Job& job_;
    std::map<std::string, Numbers> numbers_;
    std::map<std::string, Target> targets_;
    Target pictureDepth_;
    std::map<std::string, Com<ID3D11ShaderResourceView>> textures_;
    std::map<std::string, Com<ID3D11SamplerState>> samplers_;
    std::map<std::string, Program> programs_;
    Mesh mesh_;
    Mesh quad_;
    std::vector<Target*> boundColors_;
    Target* boundDepth_ = nullptr;
    Numbers viewport_;
};

Program& Direct3D11::program(const PassInfo& pass) {
    Program& result = programs_[pass.name];
    if (result.vertex) return result;
    const D3D11_INPUT_ELEMENT_DESC elements[] = {{"POSITION", 0, DXGI_FORMAT_R32G32B32_FLOAT, 0, 0, D3D11_INPUT_PER_VERTEX_DATA, 0},
                                                 {"NORMAL", 0, DXGI_FORMAT_R32G32B32_FLOAT, 0, 12, D3D11_INPUT_PER_VERTEX_DATA, 0},
                                                 {"TANGENT", 0, DXGI_FORMAT_R32G32B32A32_FLOAT, 0, 24, D3D11_INPUT_PER_VERTEX_DATA, 0},
                                                 {"TEXCOORD", 0, DXGI_FORMAT_R32G32_FLOAT, 0, 40, D3D11_INPUT_PER_VERTEX_DATA, 0}};
    result.vertexCode = readCode(job_.path(pass.vertexFile));
    result.pixelCode = readCode(job_.path(pass.pixelFile));
    const std::vector<char>& vertex = result.vertexCode.bytes;
    const std::vector<char>& pixel = result.pixelCode.bytes;
    must(device()->CreateVertexShader(vertex.data(), vertex.size(), nullptr, result.vertex.put()), "CreateVertexShader " + pass.name);
    must(device()->CreatePixelShader(pixel.data(), pixel.size(), nullptr, result.pixel.put()), "CreatePixelShader " + pass.name);
    must(device()->CreateInputLayout(elements, 4, vertex.data(), vertex.size(), result.layout.put()), "CreateInputLayout " + pass.name);
    result.depth = depthState(pass.state.at("depth"));
    result.raster = rasterState(pass.state.at("raster"));
    result.blend = blendState(pass);
    return result;
}

/// A number of the user's, then the scene's, then none: the default of the effect, which is in the compiled shader.
const Numbers* Direct3D11::valueOf(const std::string& name) {
    if (const auto own = job_.values.find(name); own != job_.values.end()) return &own->second;
    const auto declared = job_.parameters.find(name);
    if (declared == job_.parameters.end()) return nullptr;
    if (declared->second.semantic == "VIEWPORTPIXELSIZE") return &viewport_;
    return job_.findScene(declared->second.semantic, declared->second.object);
}

Com<ID3D11Buffer> Direct3D11::constants(ID3D11ShaderReflectionConstantBuffer* buffer) {
    D3D11_SHADER_BUFFER_DESC desc{};
    must(buffer->GetDesc(&desc), "GetDesc of a constant buffer");
    std::vector<char> block(desc.Size);
    for (UINT i = 0; i < desc.Variables; ++i) {
        ID3D11ShaderReflectionVariable* variable = buffer->GetVariableByIndex(i);
        D3D11_SHADER_VARIABLE_DESC variableDesc{};
        must(variable->GetDesc(&variableDesc), "GetDesc of a variable");
        if (const Numbers* value = valueOf(variableDesc.Name))
            writeVariable(variable, *value, block.data());
        else if (variableDesc.DefaultValue)
            std::memcpy(block.data() + variableDesc.StartOffset, variableDesc.DefaultValue, variableDesc.Size);
    }
    return makeBuffer(block.data(), block.size(), D3D11_BIND_CONSTANT_BUFFER);
}

ID3D11ShaderResourceView* Direct3D11::resource(const std::string& name) {
    if (const auto target = targets_.find(name); target != targets_.end()) return target->second.resource.get();
    const auto texture = textures_.find(name);
    if (texture == textures_.end()) fail("a shader samples " + name + ", which the scene does not have");
    return texture->second.get();
}

void Direct3D11::bindStage(const Code& code, bool pixel) {
    D3D11_SHADER_DESC shader{};
    must(code.reflection->GetDesc(&shader), "GetDesc of a shader");
    for (UINT i = 0; i < shader.BoundResources; ++i) {
        D3D11_SHADER_INPUT_BIND_DESC input{};
        must(code.reflection->GetResourceBindingDesc(i, &input), "GetResourceBindingDesc");
        if (input.Type == D3D_SIT_CBUFFER) {
            const Com<ID3D11Buffer> buffer = constants(code.reflection->GetConstantBufferByName(input.Name));
            ID3D11Buffer* const raw = buffer.get();
            pixel ? context()->PSSetConstantBuffers(input.BindPoint, 1, &raw) : context()->VSSetConstantBuffers(input.BindPoint, 1, &raw);
        } else if (input.Type == D3D_SIT_TEXTURE) {
            ID3D11ShaderResourceView* const view = resource(input.Name);
            pixel ? context()->PSSetShaderResources(input.BindPoint, 1, &view) : context()->VSSetShaderResources(input.BindPoint, 1, &view);
        } else if (input.Type == D3D_SIT_SAMPLER) {
            ID3D11SamplerState* const sampler = samplers_.at(input.Name).get();
            pixel ? context()->PSSetSamplers(input.BindPoint, 1, &sampler) : context()->VSSetSamplers(input.BindPoint, 1, &sampler);
        }
    }
}

/// A frame depends on nothing that was there before.
void Direct3D11::clearAll() {
    const auto& rgb = job_.background;
    const float background[] = {rgb[0], rgb[1], rgb[2], 0};
    const float zeros[] = {0, 0, 0, 0};
    for (const auto& [name, target] : targets_)
        if (target.color)
            context()->ClearRenderTargetView(target.color.get(), name.empty() ? background : zeros);
        else
            context()->ClearDepthStencilView(target.depth.get(), D3D11_CLEAR_DEPTH | D3D11_CLEAR_STENCIL, 1, 0);
    context()->ClearDepthStencilView(pictureDepth_.depth.get(), D3D11_CLEAR_DEPTH | D3D11_CLEAR_STENCIL, 1, 0);
}

/// Views of different sizes cannot be bound together: a depth target of another size is left out.
void Direct3D11::bind(const Bound& bound) {
    context()->ClearState(); // no texture stays bound while it is a target
    boundColors_.clear();
    std::vector<ID3D11RenderTargetView*> views;
    for (const auto& name : bound.colors) {
        if (!name) break;
        boundColors_.push_back(&targets_.at(*name));
        views.push_back(boundColors_.back()->color.get());
    }
    const TargetShape& first = boundColors_.at(0)->shape;
    boundDepth_ = !bound.depth ? nullptr : bound.depth->empty() ? &pictureDepth_ : &targets_.at(*bound.depth);
    if (boundDepth_ && (boundDepth_->shape.width != first.width || boundDepth_->shape.height != first.height)) boundDepth_ = nullptr;
    context()->OMSetRenderTargets(static_cast<UINT>(views.size()), views.data(), boundDepth_ ? boundDepth_->depth.get() : nullptr);
    viewport_ = {static_cast<float>(first.width), static_cast<float>(first.height)};
    const D3D11_VIEWPORT viewport{0, 0, viewport_[0], viewport_[1], 0, 1};
    context()->RSSetViewports(1, &viewport);
}

void Direct3D11::clear(Clear what, const Numbers& value) {
    if (what == Clear::Color) {
        for (const Target* target : boundColors_)
            context()->ClearRenderTargetView(target->color.get(), value.data());
    } else if (boundDepth_) {
        const UINT flags = what == Clear::Depth ? D3D11_CLEAR_DEPTH : D3D11_CLEAR_STENCIL;
        context()->ClearDepthStencilView(boundDepth_->depth.get(), flags, value[0], static_cast<UINT8>(value[0]));
    }
}

void Direct3D11::draw(const std::string& name, Drawing drawing) {
    const Program& program = this->program(find(name));
    const Mesh& mesh = drawing == Drawing::Quad ? quad_ : mesh_;
    ID3D11Buffer* const vertices = mesh.vertices.get();
    const UINT stride = kVertexBytes;
    const UINT offset = 0;
    context()->IASetInputLayout(program.layout.get());
    context()->IASetVertexBuffers(0, 1, &vertices, &stride, &offset);
    context()->IASetIndexBuffer(mesh.indices.get(), DXGI_FORMAT_R32_UINT, 0);
    context()->IASetPrimitiveTopology(D3D11_PRIMITIVE_TOPOLOGY_TRIANGLELIST);
    context()->VSSetShader(program.vertex.get(), nullptr, 0);
    context()->PSSetShader(program.pixel.get(), nullptr, 0);
    context()->OMSetDepthStencilState(program.depth.get(), 0);
    context()->OMSetBlendState(program.blend.get(), nullptr, ~0U);
    context()->RSSetState(program.raster.get());
    bindStage(program.vertexCode, false);
    bindStage(program.pixelCode, true);
    const std::string& instances = find(name).instances;
    const auto count = instances.empty() ? 1U : static_cast<UINT>(numbers(instances).at(0));
    context()->DrawIndexedInstanced(mesh.indexCount, count, 0, 0, 0);
    for (const Target* target : boundColors_)
        if (target->shape.levels != 1) context()->GenerateMips(target->resource.get());
}

std::vector<std::string> Direct3D11::targets() {
    std::vector<std::string> names;
    for (const auto& [name, target] : targets_)
        names.push_back(name);
    return names;
}

Pixels Direct3D11::read(const std::string& name) {
    const Target& target = targets_.at(name);
    D3D11_TEXTURE2D_DESC desc =
        describe(target.shape.width, target.shape.height, target.shape.levels, targetFormat(target.shape).format, 0);
    desc.Usage = D3D11_USAGE_STAGING;
    desc.CPUAccessFlags = D3D11_CPU_ACCESS_READ;
    Com<ID3D11Texture2D> copy;
    must(device()->CreateTexture2D(&desc, nullptr, copy.put()), "CreateTexture2D");
    context()->CopyResource(copy.get(), target.texture.get());
    D3D11_MAPPED_SUBRESOURCE mapped{};
    must(context()->Map(copy.get(), 0, D3D11_MAP_READ, 0, &mapped), "Map");
    Pixels pixels = readRows(target.shape, mapped.pData, mapped.RowPitch);
    context()->Unmap(copy.get(), 0);
    return pixels;
}

} // namespace

std::unique_ptr<Engine> openDirect3D11(const Job& job) {
    return std::make_unique<Direct3D11>(job);
}

} // namespace client
