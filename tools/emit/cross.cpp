#include "tools/emit/cross.h"

#include <fmt/format.h>
#include <spirv_cross/spirv_glsl.hpp>
#include <spirv_cross/spirv_msl.hpp>

#include <algorithm>

namespace tegument {

namespace {

constexpr int kGlslVersion = 330;
constexpr int kGlslEsVersion = 300;

/// The pixel inputs that are narrower than what the vertex shader writes, by id. GLSL and MSL want both declared alike; SPIR-V and Direct3D
/// let a pixel shader read fewer components.
std::map<std::uint32_t, StageVariable> narrowInputs(const spirv_cross::Compiler& compiler, const Varyings& written) {
    std::map<std::uint32_t, StageVariable> narrow;
    if (compiler.get_execution_model() != spv::ExecutionModelFragment) return narrow;
    for (const auto& input : compiler.get_shader_resources().stage_inputs) {
        const auto found = written.find(compiler.get_decoration(input.id, spv::DecorationLocation));
        const spirv_cross::SPIRType& type = compiler.get_type(input.type_id);
        if (found != written.end() && type.array.empty() && type.columns == 1 && type.vecsize < found->second.components)
            narrow.emplace(input.id, found->second);
    }
    return narrow;
}

/// SPIRV-Cross can widen inputs in MSL, not in GLSL: there declarations and loads are changed where it writes them.
class GlslWithWholeInputs : public spirv_cross::CompilerGLSL {
public:
    GlslWithWholeInputs(const Shader& shader, const Varyings& written)
        : CompilerGLSL(shader.spirv), narrow_(narrowInputs(*this, written)) {}

private:
    std::string variable_decl(const spirv_cross::SPIRType& type, const std::string& name, std::uint32_t id) override {
        spirv_cross::SPIRType whole = type;
        if (const auto found = narrow_.find(id); found != narrow_.end()) whole.vecsize = found->second.components;
        return CompilerGLSL::variable_decl(whole, name, id);
    }
    void cast_from_variable_load(std::uint32_t source, std::string& expression, const spirv_cross::SPIRType& type) override {
        CompilerGLSL::cast_from_variable_load(source, expression, type);
        if (narrow_.contains(source)) expression += std::string_view(".xyzw").substr(0, 1 + type.vecsize);
    }

    std::map<std::uint32_t, StageVariable> narrow_;
};

/// HLSL's name of a texture or sampler as GLSL can have it.
std::string withoutSigns(std::string name) {
    std::ranges::replace_if(
        name, [](char c) { return c != '_' && std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
    return name;
}

/// Stages find each other by the names of varyings before GLSL 410 and GLSL ES 310.
void nameVaryings(spirv_cross::Compiler& compiler, const spirv_cross::SmallVector<spirv_cross::Resource>& variables,
                  const Varyings& written) {
    for (const auto& variable : variables) {
        const std::uint32_t location = compiler.get_decoration(variable.id, spv::DecorationLocation);
        const auto found = written.find(location);
        compiler.set_name(variable.id,
                          found == written.end() ? fmt::format("varying_unwritten{}", location) : "varying_" + found->second.semantic);
    }
}

void nameAttributes(spirv_cross::Compiler& compiler, const spirv_cross::SmallVector<spirv_cross::Resource>& variables,
                    const std::vector<StageVariable>& reflected, std::string_view prefix) {
    for (const auto& variable : variables) {
        const auto found =
            std::ranges::find(reflected, compiler.get_decoration(variable.id, spv::DecorationLocation), &StageVariable::location);
        if (found != reflected.end()) compiler.set_name(variable.id, fmt::format("{}{}", prefix, found->semantic));
    }
}

void nameInterface(spirv_cross::Compiler& compiler, const Shader& shader, const Varyings& written) {
    const spirv_cross::ShaderResources resources = compiler.get_shader_resources();
    const bool vertex = shader.stage == ShaderStage::Vertex;
    if (vertex) nameAttributes(compiler, resources.stage_inputs, shader.reflection.inputs, "attribute_");
    if (shader.stage == ShaderStage::Pixel) nameAttributes(compiler, resources.stage_outputs, shader.reflection.outputs, "output_");
    if (shader.stage != ShaderStage::Compute) nameVaryings(compiler, vertex ? resources.stage_outputs : resources.stage_inputs, written);
}

/// Both stages of a program may hold the block: same name, same members.
std::string nameGlobals(spirv_cross::Compiler& compiler, const Shader& shader) {
    if (!shader.reflection.globals) return {};
    for (const auto& block : compiler.get_shader_resources().uniform_buffers)
        if (compiler.get_decoration(block.id, spv::DecorationBinding) == shader.reflection.globals->binding) {
            compiler.set_name(block.base_type_id, "Globals");
            compiler.set_name(block.id, shader.stage == ShaderStage::Vertex ? "vertex_globals" : "pixel_globals");
            return "Globals";
        }
    return {};
}

/// A combined sampler is named like its sampler, which by convention reads one texture; with the texture's name behind it where it reads
/// several.
std::vector<CombinedSampler> nameSamplers(spirv_cross::Compiler& compiler) {
    std::map<spirv_cross::VariableID, int> texturesOf;
    for (const auto& pair : compiler.get_combined_image_samplers())
        ++texturesOf[pair.sampler_id];
    std::vector<CombinedSampler> combined;
    for (const auto& pair : compiler.get_combined_image_samplers()) {
        CombinedSampler one{.texture = compiler.get_name(pair.image_id), .sampler = compiler.get_name(pair.sampler_id)};
        one.name = withoutSigns(texturesOf[pair.sampler_id] == 1 ? one.sampler : one.sampler + "_" + one.texture);
        combined.push_back(std::move(one));
    }
    std::size_t index = 0;
    for (const auto& pair : compiler.get_combined_image_samplers()) {
        compiler.set_name(pair.sampler_id, "");
        compiler.set_name(pair.combined_id, combined[index++].name);
    }
    std::ranges::sort(combined, {}, &CombinedSampler::name);
    return combined;
}

CrossShader toGlsl(const Shader& shader, bool es, const Varyings& written) {
    GlslWithWholeInputs compiler(shader, written);
    auto options = compiler.get_common_options();
    options.version = es ? kGlslEsVersion : kGlslVersion;
    options.es = es;
    options.enable_420pack_extension = false;
    options.relax_nan_checks = true;                      // max(x, 0.0) as GLSL has it; without NaN in, the effects make none
    options.vertex.fixup_clipspace = true;                // Direct3D's depth 0..1 to -1..1
    options.vertex.flip_vert_y = true;                    // texel row 0 of a target is its top row, as in Direct3D
    options.vertex.support_nonzero_base_instance = false; // layers are instances from 0; gl_BaseInstance would need an extension
    options.fragment.default_float_precision = spirv_cross::CompilerGLSL::Options::Highp;
    compiler.set_common_options(options);
    CrossShader result{.entry = "main"};
    if (const auto dummy = compiler.build_dummy_sampler_for_combined_images(); dummy != 0) compiler.set_name(dummy, "fetch");
    compiler.build_combined_image_samplers();
    nameInterface(compiler, shader, written);
    result.globals = nameGlobals(compiler, shader);
    result.samplers = nameSamplers(compiler);
    result.text = compiler.compile();
    return result;
}

std::map<std::string, std::uint32_t> metalSlots(const spirv_cross::CompilerMSL& compiler,
                                                const spirv_cross::SmallVector<spirv_cross::Resource>& resources) {
    constexpr std::uint32_t kNone = ~0U;
    std::map<std::string, std::uint32_t> slots;
    for (const auto& resource : resources)
        if (const std::uint32_t slot = compiler.get_automatic_msl_resource_binding(resource.id); slot != kNone)
            slots[resource.name.empty() ? compiler.get_name(resource.id) : resource.name] = slot;
    return slots;
}

CrossShader toMsl(const Shader& shader, const Varyings& written) {
    spirv_cross::CompilerMSL compiler(shader.spirv);
    for (const auto& [id, whole] : narrowInputs(compiler, written))
        compiler.add_msl_shader_input({.location = whole.location, .vecsize = whole.components});
    auto options = compiler.get_msl_options();
    options.set_msl_version(2, 0);
    options.pad_fragment_output_components = true;
    compiler.set_msl_options(options);
    nameInterface(compiler, shader, written);
    CrossShader result{.globals = nameGlobals(compiler, shader)};
    result.text = compiler.compile();
    result.entry = compiler.get_cleansed_entry_point_name(shader.entry, compiler.get_execution_model());
    const spirv_cross::ShaderResources resources = compiler.get_shader_resources();
    result.buffers = metalSlots(compiler, resources.uniform_buffers);
    result.textures = metalSlots(compiler, resources.separate_images);
    result.samplerSlots = metalSlots(compiler, resources.separate_samplers);
    return result;
}

} // namespace

Varyings varyingsOf(const Shader& vertex) {
    Varyings varyings;
    for (const StageVariable& output : vertex.reflection.outputs)
        varyings.emplace(output.location, output);
    return varyings;
}

Result<CrossShader> crossCompile(const Shader& shader, Target language, const Varyings& written) {
    try {
        if (language == Target::Msl) return toMsl(shader, written);
        return toGlsl(shader, language == Target::GlslEs, written);
    } catch (const spirv_cross::CompilerError& error) {
        return inputError(3302, {.file = shader.file},
                          fmt::format("{} cannot be written in {}: {}", shader.entry, rowOf(language).language, error.what()),
                          "leave this language out with --emit-kind, or write the code without that construct");
    }
}

} // namespace tegument
