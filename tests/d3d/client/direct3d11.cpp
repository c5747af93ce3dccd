// Direct3D 11 from compiled entry points: offsets, bindings and defaults by reflection; scripts, semantics and states from the job, because
// a compiled shader has lost them.

#include "backends.h"
#include "canvas.h"

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

struct Code {
    std::vector<char> bytes;
    Com<ID3D11ShaderReflection> reflection;
};

enum class Stage { Vertex, Pixel, Compute };

struct Program {
    Code vertexCode;
    Code pixelCode;
    Code computeCode;
    Com<ID3D11ComputeShader> compute;
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

struct Api {
    using Texture = ID3D11Texture2D;
    using ColorView = ID3D11RenderTargetView;
    using DepthView = ID3D11DepthStencilView;
    using ResourceView = ID3D11ShaderResourceView;
    using Buffer = ID3D11Buffer;
    using Layout = ID3D11InputLayout;
    using TextureDesc = D3D11_TEXTURE2D_DESC;
    using DepthViewDesc = D3D11_DEPTH_STENCIL_VIEW_DESC;
    using ResourceViewDesc = D3D11_SHADER_RESOURCE_VIEW_DESC;
    using BufferDesc = D3D11_BUFFER_DESC;
    using Data = D3D11_SUBRESOURCE_DATA;
    using Mapped = D3D11_MAPPED_SUBRESOURCE;
    using Viewport = D3D11_VIEWPORT;
    using Element = D3D11_INPUT_ELEMENT_DESC;

    static constexpr UINT kColor = D3D11_BIND_RENDER_TARGET;
    static constexpr UINT kDepth = D3D11_BIND_DEPTH_STENCIL;
    static constexpr UINT kResource = D3D11_BIND_SHADER_RESOURCE;
    static constexpr UINT kStore = D3D11_BIND_UNORDERED_ACCESS;
    static constexpr UINT kVertices = D3D11_BIND_VERTEX_BUFFER;
    static constexpr UINT kIndices = D3D11_BIND_INDEX_BUFFER;
    static constexpr UINT kMakeMips = D3D11_RESOURCE_MISC_GENERATE_MIPS;
    static constexpr UINT kCube = D3D11_RESOURCE_MISC_TEXTURECUBE;
    static constexpr auto kPerVertex = D3D11_INPUT_PER_VERTEX_DATA;
    static constexpr auto kTriangles = D3D11_PRIMITIVE_TOPOLOGY_TRIANGLELIST;
    static constexpr UINT kClearDepth = D3D11_CLEAR_DEPTH;
    static constexpr UINT kClearStencil = D3D11_CLEAR_STENCIL;
    static constexpr auto kDepthView2D = D3D11_DSV_DIMENSION_TEXTURE2D;
    static constexpr auto kResourceView2D = D3D11_SRV_DIMENSION_TEXTURE2D;
    static constexpr auto kDefault = D3D11_USAGE_DEFAULT;
    static constexpr auto kStaging = D3D11_USAGE_STAGING;
    static constexpr UINT kRead = D3D11_CPU_ACCESS_READ;

    static ID3D11Device* device() { return client::device(); }
    static ID3D11DeviceContext* context() { return client::context(); }
    static Mapped map(Texture* texture) {
        Mapped mapped{};
        must(context()->Map(texture, 0, D3D11_MAP_READ, 0, &mapped), "Map");
        return mapped;
    }
    static void unmap(Texture* texture) { context()->Unmap(texture, 0); }
};

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
void writeVariable(const D3D11_SHADER_VARIABLE_DESC& desc, const D3D11_SHADER_TYPE_DESC& type, const Numbers& value, char* block) {
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
    explicit Direct3D11(const Job& job) : job_(job), canvas_(job), numbers_(job.numbers) {
        for (const auto& [name, file] : job.textures)
            textures_.emplace(name, uploadTexture<Api>(readTexture(job.path(file))));
        for (const auto& [name, info] : job.samplers)
            samplers_.emplace(name, samplerState(info));
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

    void setTargets(const Bound& bound) override;
    using Engine::clear;
    using Engine::draw;
    void clear(Clear what, const Numbers& value) override { canvas_.clear(what, value); }
    void draw(const std::string& pass, Drawing drawing) override;
    std::vector<std::string> targets() override { return canvas_.names(); }
    Pixels read(const std::string& target) override { return canvas_.read(target); }

private:
    const PassInfo& find(const std::string& pass) {
        for (const PassInfo& info : job_.passes)
            if (upper(info.name) == upper(pass)) return info;
        fail("the technique has no pass " + pass);
    }
    Program& program(const PassInfo& pass);
    std::optional<Numbers> valueOf(const std::string& name, unsigned columns);
    Com<ID3D11Buffer> constants(ID3D11ShaderReflectionConstantBuffer* buffer);
    ID3D11ShaderResourceView* resource(const std::string& name);
    void bindStage(const Code& code, Stage stage);
    void bindStored(const Code& code);
    void compute(const PassInfo& pass);

    const Job& job_;
    Canvas<Api> canvas_;
    std::map<std::string, Numbers> numbers_;
    std::map<std::string, Com<ID3D11ShaderResourceView>> textures_;
    std::map<std::string, Com<ID3D11SamplerState>> samplers_;
    std::map<std::string, Program> programs_;
    std::map<std::string, Com<ID3D11UnorderedAccessView>> stored_;
    Numbers viewport_;
};

Program& Direct3D11::program(const PassInfo& pass) {
    Program& result = programs_[pass.name];
    if (result.vertex) return result;
    result.vertexCode = readCode(job_.path(pass.vertexFile));
    result.pixelCode = readCode(job_.path(pass.pixelFile));
    const std::vector<char>& vertex = result.vertexCode.bytes;
    const std::vector<char>& pixel = result.pixelCode.bytes;
    must(device()->CreateVertexShader(vertex.data(), vertex.size(), nullptr, result.vertex.put()), "CreateVertexShader " + pass.name);
    must(device()->CreatePixelShader(pixel.data(), pixel.size(), nullptr, result.pixel.put()), "CreatePixelShader " + pass.name);
    result.layout = vertexLayout<Api>(vertex.data(), vertex.size(), pass.name);
    result.depth = depthState(pass.state.at("depth"));
    result.raster = rasterState(pass.state.at("raster"));
    result.blend = blendState(pass);
    return result;
}

/// None: the effect's default, which is in the compiled shader.
std::optional<Numbers> Direct3D11::valueOf(const std::string& name, unsigned columns) {
    const auto declared = job_.parameters.find(name);
    if (declared == job_.parameters.end()) return job_.valueOf(name, "", "", columns);
    if (declared->second.semantic == "VIEWPORTPIXELSIZE") return viewport_;
    return job_.valueOf(name, declared->second.semantic, declared->second.object, columns);
}

Com<ID3D11Buffer> Direct3D11::constants(ID3D11ShaderReflectionConstantBuffer* buffer) {
    D3D11_SHADER_BUFFER_DESC desc{};
    must(buffer->GetDesc(&desc), "GetDesc of a constant buffer");
    std::vector<char> block(desc.Size);
    for (UINT i = 0; i < desc.Variables; ++i) {
        ID3D11ShaderReflectionVariable* variable = buffer->GetVariableByIndex(i);
        D3D11_SHADER_VARIABLE_DESC variableDesc{};
        D3D11_SHADER_TYPE_DESC type{};
        must(variable->GetDesc(&variableDesc), "GetDesc of a variable");
        must(variable->GetType()->GetDesc(&type), "GetDesc of a type");
        if (const auto value = valueOf(variableDesc.Name, type.Columns))
            writeVariable(variableDesc, type, *value, block.data());
        else if (variableDesc.DefaultValue)
            std::memcpy(block.data() + variableDesc.StartOffset, variableDesc.DefaultValue, variableDesc.Size);
    }
    return makeBuffer<Api>(block.data(), block.size(), D3D11_BIND_CONSTANT_BUFFER);
}

ID3D11ShaderResourceView* Direct3D11::resource(const std::string& name) {
    if (const auto target = canvas_.targets().find(name); target != canvas_.targets().end()) return target->second.resource.get();
    const auto texture = textures_.find(name);
    if (texture == textures_.end()) fail("a shader samples " + name + ", which the scene does not have");
    return texture->second.get();
}

void setConstants(Stage stage, UINT slot, ID3D11Buffer* buffer) {
    if (stage == Stage::Vertex) context()->VSSetConstantBuffers(slot, 1, &buffer);
    if (stage == Stage::Pixel) context()->PSSetConstantBuffers(slot, 1, &buffer);
    if (stage == Stage::Compute) context()->CSSetConstantBuffers(slot, 1, &buffer);
}

void setResource(Stage stage, UINT slot, ID3D11ShaderResourceView* view) {
    if (stage == Stage::Vertex) context()->VSSetShaderResources(slot, 1, &view);
    if (stage == Stage::Pixel) context()->PSSetShaderResources(slot, 1, &view);
    if (stage == Stage::Compute) context()->CSSetShaderResources(slot, 1, &view);
}

void setSampler(Stage stage, UINT slot, ID3D11SamplerState* sampler) {
    if (stage == Stage::Vertex) context()->VSSetSamplers(slot, 1, &sampler);
    if (stage == Stage::Pixel) context()->PSSetSamplers(slot, 1, &sampler);
    if (stage == Stage::Compute) context()->CSSetSamplers(slot, 1, &sampler);
}

void Direct3D11::bindStage(const Code& code, Stage stage) {
    D3D11_SHADER_DESC shader{};
    must(code.reflection->GetDesc(&shader), "GetDesc of a shader");
    for (UINT i = 0; i < shader.BoundResources; ++i) {
        D3D11_SHADER_INPUT_BIND_DESC input{};
        must(code.reflection->GetResourceBindingDesc(i, &input), "GetResourceBindingDesc");
        if (input.Type == D3D_SIT_CBUFFER)
            setConstants(stage, input.BindPoint, constants(code.reflection->GetConstantBufferByName(input.Name)).get());
        else if (input.Type == D3D_SIT_TEXTURE)
            setResource(stage, input.BindPoint, resource(input.Name));
        else if (input.Type == D3D_SIT_SAMPLER)
            setSampler(stage, input.BindPoint, samplers_.at(input.Name).get());
    }
}

/// What a compute shader writes: level 0 of the target behind each name.
void Direct3D11::bindStored(const Code& code) {
    D3D11_SHADER_DESC shader{};
    must(code.reflection->GetDesc(&shader), "GetDesc of a shader");
    for (UINT i = 0; i < shader.BoundResources; ++i) {
        D3D11_SHADER_INPUT_BIND_DESC input{};
        must(code.reflection->GetResourceBindingDesc(i, &input), "GetResourceBindingDesc");
        if (input.Type != D3D_SIT_UAV_RWTYPED) continue;
        Com<ID3D11UnorderedAccessView>& view = stored_[input.Name];
        if (!view)
            must(device()->CreateUnorderedAccessView(canvas_.targets().at(job_.stores.at(input.Name)).texture.get(), nullptr, view.put()),
                 std::string("CreateUnorderedAccessView ") + input.Name);
        ID3D11UnorderedAccessView* const raw = view.get();
        context()->CSSetUnorderedAccessViews(input.BindPoint, 1, &raw, nullptr);
    }
}

void Direct3D11::compute(const PassInfo& pass) {
    Program& program = programs_[pass.name];
    if (!program.compute) {
        program.computeCode = readCode(job_.path(pass.computeFile));
        const std::vector<char>& bytes = program.computeCode.bytes;
        must(device()->CreateComputeShader(bytes.data(), bytes.size(), nullptr, program.compute.put()), "CreateComputeShader " + pass.name);
    }
    viewport_.assign(pass.viewport.begin(), pass.viewport.end());
    context()->ClearState(); // what is written is no target
    context()->CSSetShader(program.compute.get(), nullptr, 0);
    bindStage(program.computeCode, Stage::Compute);
    bindStored(program.computeCode);
    context()->Dispatch(pass.groups[0], pass.groups[1], pass.groups[2]);
}

void Direct3D11::setTargets(const Bound& bound) {
    context()->ClearState(); // no texture stays bound while it is a target
    viewport_ = canvas_.bind(bound);
}

void Direct3D11::draw(const std::string& name, Drawing drawing) {
    const PassInfo& pass = find(name);
    if (drawing == Drawing::Compute) return compute(pass);
    const Program& program = this->program(pass);
    context()->VSSetShader(program.vertex.get(), nullptr, 0);
    context()->PSSetShader(program.pixel.get(), nullptr, 0);
    context()->OMSetDepthStencilState(program.depth.get(), 0);
    context()->OMSetBlendState(program.blend.get(), nullptr, ~0U);
    context()->RSSetState(program.raster.get());
    bindStage(program.vertexCode, Stage::Vertex);
    bindStage(program.pixelCode, Stage::Pixel);
    canvas_.draw(drawing, name, program.layout.get(), pass.instances.empty() ? 1U : static_cast<UINT>(numbers(pass.instances).at(0)));
}

} // namespace

std::unique_ptr<Engine> openDirect3D11(const Job& job) {
    return std::make_unique<Direct3D11>(job);
}

} // namespace client
