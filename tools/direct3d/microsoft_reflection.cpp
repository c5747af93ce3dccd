#include "tools/direct3d/microsoft_reflection.h"

#include "host/spirv/reflect.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <stdexcept>

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

constexpr std::int64_t kMostScalars = 4 * 4096; // a constant buffer has 4,096 registers

/// nlohmann takes any number for any other, whether it fits or not.
template <class Number>
Number whole(const json& number, std::int64_t most = std::numeric_limits<Number>::max()) {
    const auto value = number.get_ref<const json::number_integer_t&>();
    if (value < 0 || value > most) throw std::out_of_range("no number of a reflection");
    return static_cast<Number>(value);
}

std::vector<std::uint32_t> wordsOf(const json& list) {
    std::vector<std::uint32_t> words;
    for (const json& word : list)
        words.push_back(whole<std::uint32_t>(word));
    return words;
}

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
                       .base = baseOf(whole<int>(variable.at("type"))),
                       .offset = whole<std::uint32_t>(variable.at("offset")),
                       .size = whole<std::uint32_t>(variable.at("size")),
                       .rows = whole<std::uint32_t>(variable.at("rows"), kMostScalars),
                       .columns = whole<std::uint32_t>(variable.at("columns"), kMostScalars),
                       .elements = whole<std::uint32_t>(variable.at("elements"), kMostScalars),
                       .used = variable.at("used").get<bool>()};
    if (std::int64_t{member.rows} * member.columns * std::max(member.elements, 1U) > kMostScalars)
        throw std::out_of_range("a member is larger than a buffer");
    const bool byRows = whole<int>(variable.at("class")) == kClassMatrixRows;
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
    UniformBlock block{.name = buffer.at("name").get<std::string>(), .size = whole<std::uint32_t>(buffer.at("size"))};
    for (const json& variable : buffer.at("members")) {
        block.members.push_back(readMember(variable));
        const json& words = variable.at("default");
        if (words.is_array()) into.defaults[block.members.back().name] = readDefault(block.members.back(), wordsOf(words));
    }
    return block;
}

void readResource(const json& bound, Reflection& into) {
    const std::string name = bound.at("name").get<std::string>();
    const auto slot = whole<std::uint32_t>(bound.at("slot"));
    const int type = whole<int>(bound.at("type"));
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
        kind = (whole<int>(bound.at("flags")) & kFlagComparison) != 0 ? ResourceKind::CompareSampler : ResourceKind::Sampler;
    if (type == kInputImage) kind = ResourceKind::StorageImage;
    for (const auto& [dimension, texture] : kTextures)
        if (type == kInputTexture && whole<int>(bound.at("dimension")) == dimension) kind = texture;
    into.resources.push_back({.name = name, .kind = kind, .binding = slot});
}

std::string semanticOf(const json& element) {
    std::string name = spirv::canonicalSemantic(element.at("semantic").get<std::string>());
    name.pop_back(); // the 0 that it put behind the name: Direct3D keeps name and index apart
    return name + std::to_string(whole<int>(element.at("index")));
}

std::vector<StageVariable> readSignature(const json& list, bool input) {
    std::vector<StageVariable> variables;
    for (const json& element : list) {
        const int system = whole<int>(element.at("system"));
        if ((system != 0 && system != kNameTarget) || (input && whole<int>(element.at("read")) == 0)) continue;
        variables.push_back({.semantic = semanticOf(element),
                             .location = whole<std::uint32_t>(element.at("register")),
                             .components = static_cast<std::uint32_t>(std::popcount(whole<std::uint32_t>(element.at("mask")))),
                             .base = componentBase(whole<int>(element.at("type")))});
    }
    return variables;
}

void readOutputs(const json& list, Sm5Reflection& into) {
    into.reflection.outputs = readSignature(list, false);
    for (const json& element : list) {
        if (whole<int>(element.at("system")) == kNamePosition) into.writesPosition = true;
        const int mask = whole<int>(element.at("mask"));
        // Of an output this is the mask of what is never written.
        if ((whole<int>(element.at("read")) & mask) == mask) into.unwritten.push_back(semanticOf(element));
    }
}

Sm5Reflection read(const json& from) {
    Sm5Reflection result;
    for (const auto& buffer : from.at("buffers")) {
        UniformBlock block = readBlock(buffer, result);
        if (block.name == "$Globals")
            result.reflection.globals = std::move(block);
        else if (whole<int>(buffer.at("kind")) == 0)
            result.reflection.constantBuffers.push_back(std::move(block));
    }
    for (const auto& bound : from.at("resources"))
        readResource(bound, result.reflection);
    result.reflection.inputs = readSignature(from.at("inputs"), true);
    readOutputs(from.at("outputs"), result);
    const auto& threads = from.at("threads");
    for (std::size_t i = 0; i < 3 && whole<std::uint32_t>(threads.at(0)) != 0; ++i)
        result.reflection.localSize[i] = whole<std::uint32_t>(threads.at(i));
    return result;
}

} // namespace

std::optional<Sm5Reflection> readSm5Reflection(const json& from) {
    try {
        return read(from);
    } catch (const json::exception&) {
        return {};
    } catch (const std::out_of_range&) {
        return {};
    }
}

} // namespace tegument
