#include "host/spirv/compile.h"
#include "host/spirv/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>

namespace tegument {

namespace {

const char* baseName(MemberBase base) {
    switch (base) {
    case MemberBase::Bool: return "bool";
    case MemberBase::Int: return "int";
    case MemberBase::Uint: return "uint";
    case MemberBase::Float: return "float";
    }
    return "";
}

std::string typeName(const StageVariable& variable) {
    return fmt::format("{}{}", baseName(variable.base), variable.components);
}

Result<const StageVariable*> findOutput(const Shader& vertex, const Shader& pixel, const StageVariable& input) {
    const auto found = std::ranges::find(vertex.reflection.outputs, input.semantic, &StageVariable::semantic);
    if (found == vertex.reflection.outputs.end())
        return inputError(
            3004, {.file = pixel.file},
            fmt::format("pixel shader {} reads {}, which vertex shader {} does not write", pixel.entry, input.semantic, vertex.entry),
            "give both the same struct");
    if (found->base != input.base || found->components < input.components)
        return inputError(3005, {.file = pixel.file},
                          fmt::format("pixel shader {} reads {} as {}, vertex shader {} writes it as {}", pixel.entry, input.semantic,
                                      typeName(input), vertex.entry, typeName(*found)),
                          "give both the same struct");
    return &*found;
}

/// New locations of the elements of one input variable, which starts at `first` and takes the inputs up to the next one.
struct Move {
    std::uint32_t from;
    std::uint32_t to;
};

std::uint32_t slots(const spirv_cross::SPIRType& type) {
    return std::accumulate(type.array.begin(), type.array.end(), type.columns, std::multiplies());
}

/// Where an input variable must start for each of its elements to meet its output; nothing when none of its elements is read.
Result<std::optional<std::uint32_t>> newStart(const Shader& pixel, const std::vector<Move>& moves, std::uint32_t first,
                                              std::uint32_t count) {
    std::optional<std::uint32_t> start;
    for (const Move& move : moves) {
        if (move.from < first || move.from >= first + count) continue;
        const std::uint32_t wanted = move.to - (move.from - first);
        if (start && *start != wanted)
            return inputError(
                3005, {.file = pixel.file},
                fmt::format("an array that pixel shader {} reads is written as separate values in another order", pixel.entry),
                "give both the same struct");
        start = wanted;
    }
    return start;
}

/// In the words and in the reflection, or in neither.
Result<void> moveInputs(Shader& pixel, const std::vector<Move>& moves) {
    const spirv_cross::Compiler module(pixel.spirv);
    std::vector<std::uint32_t> words = pixel.spirv;
    for (const spirv_cross::Resource& input : module.get_shader_resources().stage_inputs) {
        const std::uint32_t location = module.get_decoration(input.id, spv::DecorationLocation);
        const auto start = newStart(pixel, moves, location, slots(module.get_type(input.type_id)));
        if (!start) return start.error();
        if (*start) spirv::redecorate(module, words, input.id, spv::DecorationLocation, **start);
    }
    pixel.spirv = std::move(words);
    for (std::size_t i = 0; i < moves.size(); ++i)
        pixel.reflection.inputs[i].location = moves[i].to;
    std::ranges::sort(pixel.reflection.inputs, {}, &StageVariable::location);
    return {};
}

} // namespace

Result<void> linkStages(const Shader& vertex, Shader& pixel) {
    std::vector<Move> moves;
    for (const StageVariable& input : pixel.reflection.inputs) {
        const auto output = findOutput(vertex, pixel, input);
        if (!output) return output.error();
        moves.push_back({input.location, (*output)->location});
    }
    if (std::ranges::all_of(moves, [](const Move& move) { return move.from == move.to; })) return {};
    try {
        return moveInputs(pixel, moves);
    } catch (const spirv_cross::CompilerError& error) {
        return machineError(3003, fmt::format("{}: SPIRV-Cross cannot read the SPIR-V of {}: {}", pixel.file, pixel.entry, error.what()));
    }
}

} // namespace tegument
