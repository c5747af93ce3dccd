#include "host/compile/reflect.h"

#include "host/compile/patch.h"
#include "host/compile/usage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <tuple>

namespace tegument::spirv {

namespace {

constexpr std::string_view kGlobals = "$Globals";

bool isDescriptor(const Variable& variable) {
    return variable.storage == spv::StorageClass::UniformConstant || variable.storage == spv::StorageClass::Uniform ||
           variable.storage == spv::StorageClass::StorageBuffer;
}

bool isUniformBlock(const Module& module, const Variable& variable) {
    return variable.storage == spv::StorageClass::Uniform && module.has(variable.pointee, spv::Decoration::Block);
}

/// DXC calls the block's type "type.$Globals", glslang "$Global" and leaves the variable without a name.
std::string descriptorName(const Module& module, const Variable& variable) {
    if (!isUniformBlock(module, variable)) return module.name(variable.id);
    std::string name = module.name(variable.pointee);
    if (name.starts_with("type.")) name.erase(0, 5);
    return name == "$Global" ? std::string(kGlobals) : name;
}

Error notExpressible(const std::string& file, std::string what, std::string hint) {
    return inputError(3006, {.file = file, .byte = {}}, std::move(what), std::move(hint));
}

MemberBase baseOf(const Type& scalar) {
    if (scalar.op == spv::Op::OpTypeBool) return MemberBase::Bool;
    if (scalar.op == spv::Op::OpTypeFloat) return MemberBase::Float;
    return scalar.operands.size() > 1 && scalar.operands[1] != 0 ? MemberBase::Int : MemberBase::Uint;
}

/// A scalar, vector or matrix. HLSL's float3x4 is SPIR-V's matrix of 3 vectors of 4: HLSL rows are SPIR-V columns.
struct Shape {
    MemberBase base = MemberBase::Float;
    std::uint32_t rows = 1;
    std::uint32_t columns = 1;
    bool matrix = false;
};

std::optional<Shape> shapeOf(const Module& module, Id id) {
    const Type& type = module.type(id);
    switch (type.op) {
    case spv::Op::OpTypeBool: return Shape{.base = MemberBase::Bool};
    case spv::Op::OpTypeInt:
    case spv::Op::OpTypeFloat:
        if (type.operands[0] != 32) return {};
        return Shape{.base = baseOf(type)};
    case spv::Op::OpTypeVector: return Shape{.base = baseOf(module.type(type.operands[0])), .columns = type.operands[1]};
    case spv::Op::OpTypeMatrix: {
        const Type& vector = module.type(type.operands[0]);
        return Shape{
            .base = baseOf(module.type(vector.operands[0])), .rows = type.operands[1], .columns = vector.operands[1], .matrix = true};
    }
    default: return {};
    }
}

std::uint32_t valueSize(const Shape& shape, const BlockMember& member) {
    if (!shape.matrix) return 4 * shape.columns;
    const std::uint32_t vectors = member.spirvRowMajor ? shape.columns : shape.rows;
    const std::uint32_t length = member.spirvRowMajor ? shape.rows : shape.columns;
    return (vectors - 1) * member.matrixStride + 4 * length;
}

std::optional<BlockMember> readMember(const Module& module, Id structure, std::uint32_t index, Id typeId) {
    BlockMember member{.name = module.memberName(structure, index)};
    member.offset = module.value(structure, spv::Decoration::Offset, index).value_or(0);
    member.matrixStride = module.value(structure, spv::Decoration::MatrixStride, index).value_or(0);
    member.spirvRowMajor = module.has(structure, spv::Decoration::RowMajor, index);
    Id valueType = typeId;
    if (const Type& type = module.type(typeId); type.op == spv::Op::OpTypeArray) {
        member.elements = module.constant(type.operands[1]).value_or(0);
        member.arrayStride = module.value(typeId, spv::Decoration::ArrayStride).value_or(0);
        valueType = type.operands[0];
    }
    const auto shape = shapeOf(module, valueType);
    if (!shape) return {};
    member.base = shape->base;
    member.rows = shape->rows;
    member.columns = shape->columns;
    member.size = (member.elements == 0 ? 0 : (member.elements - 1) * member.arrayStride) + valueSize(*shape, member);
    return member;
}

std::uint32_t bound(const Module& module, const Variable& variable, spv::Decoration decoration) {
    return module.value(variable.id, decoration).value_or(0);
}

Result<UniformBlock> readBlock(const Module& module, const Variable& variable, const Usage& usage, const std::string& file) {
    UniformBlock block{.name = descriptorName(module, variable),
                       .set = bound(module, variable, spv::Decoration::DescriptorSet),
                       .binding = bound(module, variable, spv::Decoration::Binding),
                       .members = {}};
    const Words members = module.type(variable.pointee).operands;
    std::uint32_t end = 0;
    for (std::uint32_t i = 0; i < members.size(); ++i) {
        auto member = readMember(module, variable.pointee, i, members[i]);
        if (!member)
            return notExpressible(file,
                                  fmt::format("parameter {} is neither a number, a vector, a matrix nor an array of these",
                                              module.memberName(variable.pointee, i)),
                                  "declare the members of a struct as parameters of their own, in 32-bit types");
        member->used = usage.reads(variable.id, i);
        end = std::max(end, member->offset + member->size);
        block.members.push_back(std::move(*member));
    }
    block.size = (end + 15) / 16 * 16;
    return block;
}

std::optional<ResourceKind> imageKind(const Type& image) {
    const auto dimension = static_cast<spv::Dim>(image.operands[1]);
    const bool arrayed = image.operands[3] != 0;
    const bool multisampled = image.operands[4] != 0;
    const bool sampled = image.operands[5] == 1;
    if (arrayed || multisampled || dimension == spv::Dim::Buffer) return {};
    if (!sampled) return ResourceKind::StorageImage;
    switch (dimension) {
    case spv::Dim::Dim1D: return ResourceKind::Texture1D;
    case spv::Dim::Dim2D: return ResourceKind::Texture2D;
    case spv::Dim::Dim3D: return ResourceKind::Texture3D;
    case spv::Dim::Cube: return ResourceKind::TextureCube;
    default: return {};
    }
}

std::optional<ResourceKind> resourceKind(const Module& module, const Variable& variable, const Usage& usage) {
    const Type& type = module.type(variable.pointee);
    switch (type.op) {
    case spv::Op::OpTypeSampler: return usage.comparing.contains(variable.id) ? ResourceKind::CompareSampler : ResourceKind::Sampler;
    case spv::Op::OpTypeImage: return imageKind(type);
    case spv::Op::OpTypeStruct: return ResourceKind::StorageBuffer;
    default: return {};
    }
}

Result<void> readDescriptor(const Module& module, const Variable& variable, const Usage& usage, const std::string& file, Reflection& into) {
    if (isUniformBlock(module, variable)) {
        auto block = readBlock(module, variable, usage, file);
        if (!block) return block.error();
        if (block->name == kGlobals)
            into.globals = std::move(*block);
        else
            into.constantBuffers.push_back(std::move(*block));
        return {};
    }
    const auto kind = resourceKind(module, variable, usage);
    const std::string name = module.name(variable.id);
    if (!kind)
        return notExpressible(file, fmt::format("resource {} has a type that is not supported", name),
                              "supported: Texture1D, 2D, 3D, Cube, samplers, structured buffers, RWTexture");
    into.resources.push_back({.name = name,
                              .kind = *kind,
                              .set = bound(module, variable, spv::Decoration::DescriptorSet),
                              .binding = bound(module, variable, spv::Decoration::Binding),
                              .used = usage.reads(variable.id)});
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
Result<void> readStageVariable(const Module& module, const Variable& variable, const Usage& usage, const std::string& file,
                               Reflection& into) {
    const bool input = variable.storage == spv::StorageClass::Input;
    const std::string written = module.text(variable.id, spv::Decoration::UserSemantic);
    const auto location = module.value(variable.id, spv::Decoration::Location);
    if (!location || isSystemValue(canonicalSemantic(written))) return {};
    Id valueType = variable.pointee;
    std::uint32_t elements = 1;
    if (const Type& type = module.type(valueType); type.op == spv::Op::OpTypeArray) {
        elements = module.constant(type.operands[1]).value_or(1);
        valueType = type.operands[0];
    }
    const auto shape = shapeOf(module, valueType);
    if (!shape || written.empty())
        return notExpressible(file,
                              fmt::format("stage variable {} has no semantic or is no number, vector or matrix", module.name(variable.id)),
                              "write it as a vector with a semantic");
    const std::uint32_t first = flattenedElement(module.name(variable.id)) * shape->rows;
    for (std::uint32_t i = 0; i < elements * shape->rows; ++i) {
        if (input && !usage.reads(variable.id, elements == 1 ? i : i / shape->rows)) continue;
        (input ? into.inputs : into.outputs)
            .push_back({.semantic = canonicalSemantic(written, first + i),
                        .location = *location + i,
                        .components = shape->columns,
                        .base = shape->base});
    }
    return {};
}

void readLocalSize(const Module& module, Reflection& into) {
    forEachInstruction(module.words(), [&](const Instruction& instruction, std::size_t) {
        const Words& w = instruction.words;
        if (instruction.op == spv::Op::OpExecutionMode && static_cast<spv::ExecutionMode>(w[2]) == spv::ExecutionMode::LocalSize)
            std::copy_n(w.begin() + 3, 3, into.localSize);
    });
}

bool isStageVariable(const Module& module, const Variable& variable) {
    return (variable.storage == spv::StorageClass::Input || variable.storage == spv::StorageClass::Output) &&
           !module.has(variable.id, spv::Decoration::BuiltIn);
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

void assignDescriptors(std::vector<std::uint32_t>& words, std::uint32_t set) {
    const Module module(words);
    std::map<std::tuple<int, std::string, Id>, Id> order;
    for (const Variable& variable : module.variables()) {
        if (!isDescriptor(variable)) continue;
        const std::string name = descriptorName(module, variable);
        const int rank = !isUniformBlock(module, variable) ? 2 : name == kGlobals ? 0 : 1;
        order.emplace(std::tuple(rank, name, variable.id), variable.id);
    }
    std::map<Id, std::uint32_t> bindings;
    for (const auto& [key, id] : order)
        bindings.emplace(id, static_cast<std::uint32_t>(bindings.size()));
    replaceDecorations(words, spv::Decoration::Binding, [&](Id id, std::uint32_t) { return bindings.at(id); });
    replaceDecorations(words, spv::Decoration::DescriptorSet, [&](Id, std::uint32_t) { return set; });
}

Result<Reflection> reflect(const Module& module, Stage stage, const std::string& file) {
    const Usage usage = findUsage(module);
    Reflection reflection;
    for (const Variable& variable : module.variables()) {
        Result<void> read;
        if (isDescriptor(variable)) read = readDescriptor(module, variable, usage, file, reflection);
        if (isStageVariable(module, variable)) read = readStageVariable(module, variable, usage, file, reflection);
        if (!read) return read.error();
    }
    if (stage == Stage::Compute) readLocalSize(module, reflection);
    std::ranges::sort(reflection.resources, {}, &Resource::binding);
    std::ranges::sort(reflection.inputs, {}, &StageVariable::location);
    std::ranges::sort(reflection.outputs, {}, &StageVariable::location);
    return reflection;
}

} // namespace tegument::spirv
