#include "tools/emit/products.h"

#include <algorithm>

namespace tegument::emit {

namespace {

int find(const Products& products, const LinkedShader& shader) {
    const auto words = [](const std::optional<Shader>& s) { return s ? s->spirv : std::vector<std::uint32_t>{}; };
    const auto alike = [](const Varyings& a, const Varyings& b) {
        return std::ranges::equal(a, b, [](const auto& x, const auto& y) {
            return x.first == y.first && x.second.semantic == y.second.semantic && x.second.components == y.second.components;
        });
    };
    const auto found = std::ranges::find_if(products.shaders, [&](const LinkedShader& other) {
        return other.entry == shader.entry && words(other.dxc) == words(shader.dxc) && words(other.glslang) == words(shader.glslang) &&
               alike(other.written, shader.written);
    });
    return found == products.shaders.end() ? -1 : static_cast<int>(found - products.shaders.begin());
}

int add(Products& products, LinkedShader shader) {
    if (const int known = find(products, shader); known >= 0) return known;
    const auto same = std::ranges::count(products.shaders, shader.entry, &LinkedShader::entry);
    shader.name = same == 0 ? shader.entry->name : shader.entry->name + "-" + std::to_string(same + 1);
    products.shaders.push_back(std::move(shader));
    return static_cast<int>(products.shaders.size()) - 1;
}

const EntryPoint* entryOf(const FileReport& report, const std::optional<ShaderReference>& shader, ShaderStage stage) {
    if (!shader) return nullptr;
    const auto found =
        std::ranges::find_if(report.entries, [&](const EntryPoint& e) { return e.name == shader->entry && e.stage == stage; });
    return found == report.entries.end() ? nullptr : &*found;
}

LinkedShader linked(const EntryPoint& entry) {
    LinkedShader shader{.entry = &entry, .dxc = entry.dxc, .glslang = entry.glslang};
    if (entry.stage == ShaderStage::Vertex && shader.spirv() != nullptr) shader.written = varyingsOf(*shader.spirv());
    return shader;
}

void linkOne(const std::optional<Shader>& vertex, std::optional<Shader>& pixel) {
    if (vertex && pixel && !linkStages(*vertex, *pixel)) pixel.reset(); // the check has said so
}

LinkedShader linkedPixel(const EntryPoint& pixel, const EntryPoint* vertex) {
    LinkedShader shader = linked(pixel);
    if (vertex == nullptr) return shader;
    linkOne(vertex->dxc, shader.dxc);
    linkOne(vertex->glslang, shader.glslang);
    const Shader* source = vertex->dxc ? &*vertex->dxc : vertex->glslang ? &*vertex->glslang : nullptr;
    if (source == nullptr || shader.spirv() == nullptr) return shader;
    for (const auto& [location, variable] : varyingsOf(*source)) {
        const auto& inputs = shader.spirv()->reflection.inputs;
        if (std::ranges::find(inputs, location, &StageVariable::location) != inputs.end()) shader.written.emplace(location, variable);
    }
    return shader;
}

PassShaders addPass(const FileReport& report, const Pass& pass, Products& products) {
    PassShaders shaders;
    const EntryPoint* vertex = entryOf(report, pass.vertexShader, ShaderStage::Vertex);
    const EntryPoint* geometry = entryOf(report, pass.geometryShader, ShaderStage::Geometry);
    if (vertex != nullptr) shaders.vertex = add(products, linked(*vertex));
    if (geometry != nullptr) shaders.geometry = add(products, linked(*geometry));
    if (const EntryPoint* pixel = entryOf(report, pass.pixelShader, ShaderStage::Pixel))
        shaders.pixel = add(products, linkedPixel(*pixel, geometry == nullptr ? vertex : nullptr));
    if (const EntryPoint* compute = entryOf(report, pass.computeShader, ShaderStage::Compute))
        shaders.compute = add(products, linked(*compute));
    return shaders;
}

} // namespace

Form formOf(const LinkedShader& shader, Target target) {
    const EntryPoint& entry = *shader.entry;
    const auto spirv = [](const std::optional<Shader>& made) {
        return made ? Form{{reinterpret_cast<const char*>(made->spirv.data()), 4 * made->spirv.size()}, &made->reflection} : Form{};
    };
    switch (target) {
    case Target::Sm5: return {entry.sm5, entry.sm5Reflection ? &entry.sm5Reflection->reflection : nullptr};
    case Target::Dxil: return entry.dxil ? Form{entry.dxil->container, &entry.dxil->reflection} : Form{};
    case Target::SpirvDxc: return spirv(shader.dxc);
    case Target::SpirvGlslang: return spirv(shader.glslang);
    default: return {};
    }
}

Products linkShaders(const FileReport& report) {
    Products products;
    for (const Technique& technique : report.effect.techniques) {
        std::vector<PassShaders> passes;
        for (const Pass& pass : technique.passes)
            passes.push_back(addPass(report, pass, products));
        products.passes.push_back(std::move(passes));
    }
    return products;
}

} // namespace tegument::emit
