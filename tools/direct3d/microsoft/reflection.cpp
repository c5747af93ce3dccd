#include "reflection.h"

#include "text.h"

#include <d3d11shader.h>

#include <cstring>
#include <utility>
#include <vector>

namespace hlslc {

namespace {

/// IID_ID3D11ShaderReflection of d3dcompiler_47; the import libraries of MinGW lack it.
constexpr GUID kReflectionId{0x8d536ca1, 0x0cca, 0x4956, {0xa8, 0x37, 0x78, 0x69, 0x63, 0x75, 0x55, 0x84}};

using Fields = std::vector<std::pair<const char*, std::string>>;

std::string object(const Fields& fields) {
    std::string text;
    for (const auto& [name, value] : fields)
        text += (text.empty() ? "{" : ",") + jsonString(name) + ":" + value;
    return text + "}";
}

std::string list(const std::vector<std::string>& items) {
    std::string text = "[";
    for (const std::string& item : items)
        text += (text.size() > 1 ? "," : "") + item;
    return text + "]";
}

template <class Number>
std::string number(Number value) {
    return std::to_string(static_cast<long long>(value));
}

/// The default value as 32-bit words, as it would lie in the buffer.
std::string words(const void* bytes, UINT size) {
    if (bytes == nullptr) return "null";
    std::vector<std::string> items;
    for (UINT at = 0; at + 4 <= size; at += 4) {
        unsigned word = 0;
        std::memcpy(&word, static_cast<const char*>(bytes) + at, sizeof word);
        items.push_back(number(word));
    }
    return list(items);
}

std::string member(ID3D11ShaderReflectionVariable& variable) {
    D3D11_SHADER_VARIABLE_DESC desc{};
    D3D11_SHADER_TYPE_DESC type{};
    variable.GetDesc(&desc);
    variable.GetType()->GetDesc(&type);
    return object({{"name", jsonString(desc.Name)},
                   {"offset", number(desc.StartOffset)},
                   {"size", number(desc.Size)},
                   {"used", (desc.uFlags & D3D_SVF_USED) != 0 ? "true" : "false"},
                   {"class", number(type.Class)},
                   {"type", number(type.Type)},
                   {"rows", number(type.Rows)},
                   {"columns", number(type.Columns)},
                   {"elements", number(type.Elements)},
                   {"default", words(desc.DefaultValue, desc.Size)}});
}

std::string buffer(ID3D11ShaderReflectionConstantBuffer& constants) {
    D3D11_SHADER_BUFFER_DESC desc{};
    constants.GetDesc(&desc);
    std::vector<std::string> members;
    for (UINT i = 0; i < desc.Variables; ++i)
        members.push_back(member(*constants.GetVariableByIndex(i)));
    return object({{"name", jsonString(desc.Name)}, {"size", number(desc.Size)}, {"kind", number(desc.Type)}, {"members", list(members)}});
}

std::string resource(const D3D11_SHADER_INPUT_BIND_DESC& desc) {
    return object({{"name", jsonString(desc.Name)},
                   {"type", number(desc.Type)},
                   {"dimension", number(desc.Dimension)},
                   {"flags", number(desc.uFlags)},
                   {"slot", number(desc.BindPoint)},
                   {"count", number(desc.BindCount)}});
}

std::string signature(const D3D11_SIGNATURE_PARAMETER_DESC& desc) {
    return object({{"semantic", jsonString(desc.SemanticName)},
                   {"index", number(desc.SemanticIndex)},
                   {"register", number(desc.Register)},
                   {"system", number(desc.SystemValueType)},
                   {"type", number(desc.ComponentType)},
                   {"mask", number(desc.Mask)},
                   {"read", number(desc.ReadWriteMask)}});
}

template <class Describe>
std::string signatures(UINT count, Describe&& describe) {
    std::vector<std::string> items;
    for (UINT i = 0; i < count; ++i) {
        D3D11_SIGNATURE_PARAMETER_DESC desc{};
        describe(i, desc);
        items.push_back(signature(desc));
    }
    return list(items);
}

std::string describe(ID3D11ShaderReflection& shader) {
    D3D11_SHADER_DESC desc{};
    shader.GetDesc(&desc);
    std::vector<std::string> buffers;
    for (UINT i = 0; i < desc.ConstantBuffers; ++i)
        buffers.push_back(buffer(*shader.GetConstantBufferByIndex(i)));
    std::vector<std::string> resources;
    for (UINT i = 0; i < desc.BoundResources; ++i) {
        D3D11_SHADER_INPUT_BIND_DESC bound{};
        shader.GetResourceBindingDesc(i, &bound);
        resources.push_back(resource(bound));
    }
    UINT threads[3] = {0, 0, 0};
    shader.GetThreadGroupSize(&threads[0], &threads[1], &threads[2]);
    return object({{"buffers", list(buffers)},
                   {"resources", list(resources)},
                   {"inputs", signatures(desc.InputParameters, [&](UINT i, auto& to) { shader.GetInputParameterDesc(i, &to); })},
                   {"outputs", signatures(desc.OutputParameters, [&](UINT i, auto& to) { shader.GetOutputParameterDesc(i, &to); })},
                   {"threads", list({number(threads[0]), number(threads[1]), number(threads[2])})}});
}

} // namespace

std::string reflection(Reflect reflect, ID3DBlob& shader) {
    void* found = nullptr;
    if (reflect == nullptr || FAILED(reflect(shader.GetBufferPointer(), shader.GetBufferSize(), kReflectionId, &found))) return "null";
    auto* reflected = static_cast<ID3D11ShaderReflection*>(found);
    std::string text = describe(*reflected);
    reflected->Release();
    return text;
}

} // namespace hlslc
