#include "host/spirv/reflect.h"

#include "host/spirv/instructions.h"

#include "host/spirv/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <tuple>

namespace tegument::spirv {

namespace {

using spirv_cross::SPIRType;
using Declared = spirv_cross::Resource;

constexpr std::string_view kGlobals = "$Globals";

/// What is bound through a descriptor; a uniform block has no kind of resource.
struct Descriptor {
    Declared declared;
    std::string name;
    bool block = false;
    std::uint32_t set = 0;
    std::uint32_t binding = 0;

    /// $Globals, then constant buffers, then all else, each by name.
    [[nodiscard]] auto order() const {
        return std::tuple(!block ? 2 : name == kGlobals ? 0 : 1, name, static_cast<std::uint32_t>(declared.id));
    }
};

/// DXC calls the block's type "type.$Globals", glslang "$Global" and leaves the variable without a name.
std::string blockName(const Reader& module, const Declared& block) {
    std::string name = module.get_name(block.base_type_id);
    if (name.starts_with("type.")) name.erase(0, 5);
    return name == "$Global" ? std::string(kGlobals) : name;
}

std::vector<Descriptor> descriptors(const Reader& module) {
    const spirv_cross::ShaderResources all = module.get_shader_resources();
    std::vector<Descriptor> found;
    for (const Declared& block : all.uniform_buffers)
        found.push_back({.declared = block, .name = blockName(module, block), .block = true});
    for (const auto* kind : {&all.storage_buffers, &all.storage_images, &all.separate_images, &all.separate_samplers, &all.sampled_images,
                             &all.subpass_inputs, &all.acceleration_structures})
        for (const Declared& resource : *kind)
            found.push_back({.declared = resource, .name = module.get_name(resource.id)});
    return found;
}

void number(const Reader& module, std::vector<Descriptor>& descriptors, std::uint32_t set, std::vector<std::uint32_t>& words) {
    std::ranges::sort(descriptors, {}, &Descriptor::order);
    for (std::uint32_t i = 0; i < descriptors.size(); ++i) {
        descriptors[i].set = set;
        descriptors[i].binding = i;
        redecorate(module, words, descriptors[i].declared.id, spv::DecorationDescriptorSet, set);
        redecorate(module, words, descriptors[i].declared.id, spv::DecorationBinding, i);
    }
}

Error notExpressible(const std::string& file, std::string what, std::string hint) {
    return inputError(3006, {.file = file}, std::move(what), std::move(hint));
}

std::optional<MemberBase> baseOf(const SPIRType& type) {
    switch (type.basetype) {
    case SPIRType::Boolean: return MemberBase::Bool;
    case SPIRType::Int: return MemberBase::Int;
    case SPIRType::UInt: return MemberBase::Uint;
    case SPIRType::Float: return MemberBase::Float;
    default: return {};
    }
}

/// Of a value that is no array. HLSL's float3x4 is SPIR-V's matrix of 3 vectors of 4: HLSL rows are SPIR-V columns.
std::uint32_t valueSize(const BlockMember& member) {
    if (member.rows == 1) return 4 * member.columns;
    const std::uint32_t vectors = member.spirvRowMajor ? member.columns : member.rows;
    const std::uint32_t length = member.spirvRowMajor ? member.rows : member.columns;
    return (vectors - 1) * member.matrixStride + 4 * length;
}

std::optional<BlockMember> readMember(const Reader& module, spirv_cross::TypeID structure, std::uint32_t index) {
    const SPIRType& block = module.get_type(structure);
    const SPIRType& type = module.get_type(block.member_types[index]);
    const auto base = baseOf(type);
    if (!base) return {};
    BlockMember member{.name = module.get_member_name(structure, index),
                       .base = *base,
                       .offset = module.type_struct_member_offset(block, index),
                       .rows = type.columns,
                       .columns = type.vecsize,
                       .spirvRowMajor = module.has_member_decoration(structure, index, spv::DecorationRowMajor)};
    if (type.columns > 1) member.matrixStride = module.type_struct_member_matrix_stride(block, index);
    member.size = valueSize(member);
    if (type.array.empty()) return member;
    member.elements = type.array[0];
    member.arrayStride = module.type_struct_member_array_stride(block, index);
    for (std::size_t i = 1; i < type.array.size(); ++i) { // arrays of arrays lie one behind the other
        member.arrayStride /= type.array[i - 1];
        member.elements *= type.array[i];
    }
    member.size += (member.elements - 1) * member.arrayStride;
    return member;
}

Result<UniformBlock> readBlock(const Reader& module, const Descriptor& descriptor, const std::string& file) {
    UniformBlock block{.name = descriptor.name, .set = descriptor.set, .binding = descriptor.binding};
    const spirv_cross::TypeID structure = descriptor.declared.base_type_id;
    std::uint32_t end = 0;
    for (std::uint32_t i = 0; i < module.get_type(structure).member_types.size(); ++i) {
        auto member = readMember(module, structure, i);
        if (!member)
            return notExpressible(file,
                                  fmt::format("parameter {} is neither a number, a vector, a matrix nor an array of these",
                                              module.get_member_name(structure, i)),
                                  "declare the members of a struct as parameters of their own, in 32-bit types");
        member->used = module.reads(descriptor.declared.id, i);
        end = std::max(end, member->offset + member->size);
        block.members.push_back(std::move(*member));
    }
    block.size = (end + 15) / 16 * 16;
    return block;
}

std::optional<ResourceKind> imageKind(const SPIRType::ImageType& image) {
    if (image.arrayed || image.ms || image.dim == spv::DimBuffer) return {};
    if (image.sampled != 1) return ResourceKind::StorageImage;
    switch (image.dim) {
    case spv::Dim1D: return ResourceKind::Texture1D;
    case spv::Dim2D: return ResourceKind::Texture2D;
    case spv::Dim3D: return ResourceKind::Texture3D;
    case spv::DimCube: return ResourceKind::TextureCube;
    default: return {};
    }
}

std::optional<ResourceKind> resourceKind(const Reader& module, const Declared& declared) {
    const SPIRType& type = module.get_type(declared.type_id);
    if (!type.array.empty()) return {};
    switch (type.basetype) {
    case SPIRType::Sampler: return module.compares(declared.id) ? ResourceKind::CompareSampler : ResourceKind::Sampler;
    case SPIRType::Image: return imageKind(type.image);
    case SPIRType::Struct: return ResourceKind::StorageBuffer;
    default: return {};
    }
}

Result<void> readDescriptor(const Reader& module, const Descriptor& descriptor, const std::string& file, Reflection& into) {
    if (descriptor.block) {
        auto block = readBlock(module, descriptor, file);
        if (!block) return block.error();
        if (block->name == kGlobals)
            into.globals = std::move(*block);
        else
            into.constantBuffers.push_back(std::move(*block));
        return {};
    }
    const auto kind = resourceKind(module, descriptor.declared);
    if (!kind)
        return notExpressible(file, fmt::format("resource {} has a type that is not supported", descriptor.name),
                              "supported: Texture1D, 2D, 3D, Cube, samplers, structured buffers, RWTexture");
    into.resources.push_back({.name = descriptor.name,
                              .kind = *kind,
                              .set = descriptor.set,
                              .binding = descriptor.binding,
                              .used = module.reads(descriptor.declared.id)});
    return {};
}

bool isSystemValue(std::string_view canonical) {
    return canonical.starts_with("SV_") && !canonical.starts_with("SV_TARGET");
}

/// glslang splits an array of varyings into variables named "uv[0]", "uv[1]", all with the semantic of the array.
std::uint32_t flattenedElement(const std::string& name) {
    const std::size_t open = name.rfind('[');
    if (open == std::string::npos || !name.ends_with(']')) return 0;
    std::uint32_t element = 0;
    std::from_chars(name.data() + open + 1, name.data() + name.size() - 1, element);
    return element;
}

/// Appends one entry per location that the variable takes and the code reads (every one, for outputs).
Result<void> readStageVariable(const Reader& module, const Declared& variable, bool input, const std::string& file,
                               std::vector<StageVariable>& into) {
    const std::string& written = module.get_decoration_string(variable.id, spv::DecorationUserSemantic);
    if (!module.has_decoration(variable.id, spv::DecorationLocation) || isSystemValue(canonicalSemantic(written))) return {};
    const SPIRType& type = module.get_type(variable.type_id);
    const auto base = baseOf(type);
    const std::string& name = module.get_name(variable.id);
    if (!base || type.array.size() > 1 || written.empty())
        return notExpressible(file, fmt::format("stage variable {} has no semantic or is no number, vector or matrix", name),
                              "write it as a vector with a semantic");
    const std::uint32_t elements = type.array.empty() ? 1 : type.array[0];
    const std::uint32_t first = flattenedElement(name) * type.columns;
    for (std::uint32_t i = 0; i < elements * type.columns; ++i) {
        if (input && !module.reads(variable.id, elements == 1 ? i : i / type.columns)) continue;
        into.push_back({.semantic = canonicalSemantic(written, first + i),
                        .location = module.get_decoration(variable.id, spv::DecorationLocation) + i,
                        .components = type.vecsize,
                        .base = *base});
    }
    return {};
}

Result<Reflection> readAll(const Reader& module, const std::vector<Descriptor>& descriptors, ShaderStage stage, const std::string& file) {
    Reflection reflection;
    for (const Descriptor& descriptor : descriptors)
        if (const auto read = readDescriptor(module, descriptor, file, reflection); !read) return read.error();
    const spirv_cross::ShaderResources all = module.get_shader_resources();
    for (const Declared& input : all.stage_inputs)
        if (const auto read = readStageVariable(module, input, true, file, reflection.inputs); !read) return read.error();
    for (const Declared& output : all.stage_outputs)
        if (const auto read = readStageVariable(module, output, false, file, reflection.outputs); !read) return read.error();
    for (std::uint32_t i = 0; stage == ShaderStage::Compute && i < 3; ++i)
        reflection.localSize[i] = module.get_execution_mode_argument(spv::ExecutionModeLocalSize, i);
    std::ranges::sort(reflection.inputs, {}, &StageVariable::location);
    std::ranges::sort(reflection.outputs, {}, &StageVariable::location);
    return reflection;
}

} // namespace

std::string canonicalSemantic(std::string_view written, std::uint32_t element) {
    const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
    std::size_t digits = 0;
    while (digits < written.size() && digits < 4 && isDigit(written[written.size() - 1 - digits]))
        ++digits;
    const std::string_view stem = written.substr(0, written.size() - digits);
    const auto index = digits == 0 ? 0U : static_cast<std::uint32_t>(std::stoul(std::string(written.substr(stem.size()))));
    std::string name(stem);
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return fmt::format("{}{}", name, index + element);
}

Result<Reflection> reflect(std::vector<std::uint32_t>& words, ShaderStage stage, std::uint32_t set, const std::string& file) {
    try {
        const Reader module(words);
        std::vector<Descriptor> found = descriptors(module);
        number(module, found, set, words);
        return readAll(module, found, stage, file);
    } catch (const spirv_cross::CompilerError& error) {
        return machineError(3003, fmt::format("{}: SPIRV-Cross cannot read the SPIR-V: {}", file, error.what()),
                            "this is a fault of the compiler: try the other one (--compiler) or another spelling");
    }
}

bool writesPosition(std::span<const std::uint32_t> words) {
    try {
        const spirv_cross::Compiler module(words.data(), words.size());
        return std::ranges::any_of(module.get_shader_resources().builtin_outputs,
                                   [](const auto& output) { return output.builtin == spv::BuiltInPosition; });
    } catch (const spirv_cross::CompilerError&) {
        return false;
    }
}

std::set<std::pair<std::uint32_t, std::uint32_t>> comparedPictures(std::span<const std::uint32_t> words) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> found;
    try {
        const Reader module(words);
        for (const auto& picture : module.get_shader_resources().separate_images)
            if (module.compares(picture.id))
                found.emplace(module.get_decoration(picture.id, spv::DecorationDescriptorSet),
                              module.get_decoration(picture.id, spv::DecorationBinding));
    } catch (const spirv_cross::CompilerError&) {
        return {}; // it was read before
    }
    return found;
}

bool readsByGradient(std::span<const std::uint32_t> words) {
    bool found = false;
    forEachInstruction(words, [&](spv::Op op, std::span<const std::uint32_t> instruction) {
        constexpr std::size_t kOperands = 5; // behind the word, the type, the result, the picture and the place
        const bool explicitly = op == spv::OpImageSampleExplicitLod || op == spv::OpImageSampleProjExplicitLod;
        if (explicitly && instruction.size() > kOperands) found = found || (instruction[kOperands] & spv::ImageOperandsGradMask) != 0;
    });
    return found;
}

} // namespace tegument::spirv
