#include "host/direct3d/microsoft_reflection.h"

#include "host/spirv/reflect.h"

#include <nlohmann/json.hpp>

#include <bit>
#include <cstring>

namespace tegument {

namespace {

using nlohmann::json;

// Values of d3dcommon.h.
constexpr int kClassMatrixRows = 2;
constexpr int kTypeBool = 1;
constexpr int kTypeInt = 2;
constexpr int kTypeUint = 19;
constexpr int kInputConstants = 0;
constexpr int kInputTexture = 2;
constexpr int kInputSampler = 3;
constexpr int kInputImage = 4;
constexpr int kFlagComparison = 2;
constexpr int kNamePosition = 1;
constexpr int kNameTarget = 64;
constexpr int kComponentUint = 1;
constexpr int kComponentInt = 2;

MemberBase baseOf(int type) {
    switch (type) {
    case kTypeBool: return MemberBase::Bool;
    case kTypeInt: return MemberBase::Int;
    case kTypeUint: return MemberBase::Uint;
    default: return MemberBase::Float;
    }
}

MemberBase componentBase(int type) {
    if (type == kComponentUint) return MemberBase::Uint;
    return type == kComponentInt ? MemberBase::Int : MemberBase::Float;
}

BlockMember readMember(const json& variable) {
    BlockMember member{.name = variable.at("name").get<std::string>(),
                       .base = baseOf(variable.at("type").get<int>()),
                       .offset = variable.at("offset").get<std::uint32_t>(),
                       .size = variable.at("size").get<std::uint32_t>(),
                       .rows = variable.at("rows").get<std::uint32_t>(),
                       .columns = variable.at("columns").get<std::uint32_t>(),
                       .elements = variable.at("elements").get<std::uint32_t>(),
                       .used = variable.at("used").get<bool>()};
    const bool byRows = variable.at("class").get<int>() == kClassMatrixRows;
    if (member.rows > 1) member.matrixStride = 16;
    member.spirvRowMajor = member.rows > 1 && !byRows; // as compile.h says of a column_major matrix
    const std::uint32_t vectors = member.rows == 1 ? 1 : byRows ? member.rows : member.columns;
    if (member.elements > 0) member.arrayStride = 16 * vectors; // each element starts a register
    return member;
}

double scalarOf(std::uint32_t word, MemberBase base) {
    switch (base) {
    case MemberBase::Bool: return word != 0 ? 1 : 0;
    case MemberBase::Int: return std::bit_cast<std::int32_t>(word);
    case MemberBase::Uint: return word;
    case MemberBase::Float: return std::bit_cast<float>(word);
    }
    return 0;
}

/// Numbers in row order from the words of the buffer.
std::vector<double> readDefault(const BlockMember& member, const std::vector<std::uint32_t>& words) {
    std::vector<double> numbers;
    const bool transposed = member.spirvRowMajor;
    for (std::uint32_t element = 0; element < std::max(member.elements, 1U); ++element)
        for (std::uint32_t row = 0; row < member.rows; ++row)
            for (std::uint32_t column = 0; column < member.columns; ++column) {
                const std::size_t inElement = transposed ? 4 * column + row : 4 * row + column;
                const std::size_t at = element * member.arrayStride / 4 + inElement;
                numbers.push_back(at < words.size() ? scalarOf(words[at], member.base) : 0);
            }
    return numbers;
}

UniformBlock readBlock(const json& buffer, Sm5Reflection& into) {
    UniformBlock block{.name = buffer.at("name").get<std::string>(), .size = buffer.at("size").get<std::uint32_t>(), .members = {}};
    for (const json& variable : buffer.at("members")) {
        block.members.push_back(readMember(variable));
        const json& words = variable.at("default");
        if (words.is_array())
            into.defaults[block.members.back().name] = readDefault(block.members.back(), words.get<std::vector<std::uint32_t>>());
    }
    return block;
}

void readResource(const json& bound, Reflection& into) {
    const std::string name = bound.at("name").get<std::string>();
    const auto slot = bound.at("slot").get<std::uint32_t>();
    const int type = bound.at("type").get<int>();
    if (type == kInputConstants) {
        if (into.globals && into.globals->name == name) into.globals->binding = slot;
        for (UniformBlock& block : into.constantBuffers)
            if (block.name == name) block.binding = slot;
        return;
    }
    static constexpr std::pair<int, ResourceKind> kTextures[] = {
        {2, ResourceKind::Texture1D}, {4, ResourceKind::Texture2D}, {8, ResourceKind::Texture3D}, {9, ResourceKind::TextureCube}};
    ResourceKind kind = ResourceKind::StorageBuffer;
    if (type == kInputSampler)
        kind = (bound.at("flags").get<int>() & kFlagComparison) != 0 ? ResourceKind::CompareSampler : ResourceKind::Sampler;
    if (type == kInputImage) kind = ResourceKind::StorageImage;
    for (const auto& [dimension, texture] : kTextures)
        if (type == kInputTexture && bound.at("dimension").get<int>() == dimension) kind = texture;
    into.resources.push_back({.name = name, .kind = kind, .binding = slot});
}

std::string semanticOf(const json& element) {
    std::string name = spirv::canonicalSemantic(element.at("semantic").get<std::string>());
    name.pop_back(); // the 0 that it put behind the name: Direct3D keeps name and index apart
    return name + std::to_string(element.at("index").get<int>());
}

std::vector<StageVariable> readSignature(const json& list, bool input) {
    std::vector<StageVariable> variables;
    for (const json& element : list) {
        const int system = element.at("system").get<int>();
        if ((system != 0 && system != kNameTarget) || (input && element.at("read").get<int>() == 0)) continue;
        variables.push_back({.semantic = semanticOf(element),
                             .location = element.at("register").get<std::uint32_t>(),
                             .components = static_cast<std::uint32_t>(std::popcount(element.at("mask").get<std::uint32_t>())),
                             .base = componentBase(element.at("type").get<int>())});
    }
    return variables;
}

void readOutputs(const json& list, Sm5Reflection& into) {
    into.reflection.outputs = readSignature(list, false);
    for (const json& element : list) {
        if (element.at("system").get<int>() == kNamePosition) into.writesPosition = true;
        const int mask = element.at("mask").get<int>();
        // Of an output this is the mask of what is never written.
        if ((element.at("read").get<int>() & mask) == mask) into.unwritten.push_back(semanticOf(element));
    }
}

Sm5Reflection read(const json& from) {
    Sm5Reflection result;
    for (const auto& buffer : from.at("buffers")) {
        UniformBlock block = readBlock(buffer, result);
        if (block.name == "$Globals")
            result.reflection.globals = std::move(block);
        else if (buffer.at("kind").get<int>() == 0)
            result.reflection.constantBuffers.push_back(std::move(block));
    }
    for (const auto& bound : from.at("resources"))
        readResource(bound, result.reflection);
    result.reflection.inputs = readSignature(from.at("inputs"), true);
    readOutputs(from.at("outputs"), result);
    const auto& threads = from.at("threads");
    for (std::size_t i = 0; i < 3 && threads.at(0).get<std::uint32_t>() != 0; ++i)
        result.reflection.localSize[i] = threads.at(i).get<std::uint32_t>();
    return result;
}

} // namespace

std::optional<Sm5Reflection> readSm5Reflection(const json& from) {
    try {
        return read(from);
    } catch (const json::exception&) {
        return {};
    }
}

} // namespace tegument
