#include "host/compile/compile.h"
#include "host/compile/patch.h"

#include <fmt/format.h>

#include <algorithm>

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
            3004, {.file = pixel.file, .byte = {}},
            fmt::format("pixel shader {} reads {}, which vertex shader {} does not write", pixel.entry, input.semantic, vertex.entry),
            "give both the same struct");
    if (found->base != input.base || found->components < input.components)
        return inputError(3005, {.file = pixel.file, .byte = {}},
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

std::uint32_t slots(const spirv::Module& module, spirv::Id type) {
    const spirv::Type& t = module.type(type);
    if (t.op == spv::Op::OpTypeArray) return module.constant(t.operands[1]).value_or(1) * slots(module, t.operands[0]);
    return t.op == spv::Op::OpTypeMatrix ? t.operands[1] : 1;
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
                3005, {.file = pixel.file, .byte = {}},
                fmt::format("an array that pixel shader {} reads is written as separate values in another order", pixel.entry),
                "give both the same struct");
        start = wanted;
    }
    return start;
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

    std::map<spirv::Id, std::uint32_t> starts;
    const spirv::Module module(pixel.spirv);
    for (const spirv::Variable& variable : module.variables()) {
        const auto location = module.value(variable.id, spv::Decoration::Location);
        if (variable.storage != spv::StorageClass::Input || !location) continue;
        const auto start = newStart(pixel, moves, *location, slots(module, variable.pointee));
        if (!start) return start.error();
        if (*start) starts.emplace(variable.id, **start);
    }
    spirv::replaceDecorations(pixel.spirv, spv::Decoration::Location, [&](spirv::Id id, std::uint32_t) -> std::optional<std::uint32_t> {
        const auto found = starts.find(id);
        if (found == starts.end()) return {};
        return found->second;
    });
    for (std::size_t i = 0; i < moves.size(); ++i)
        pixel.reflection.inputs[i].location = moves[i].to;
    std::ranges::sort(pixel.reflection.inputs, {}, &StageVariable::location);
    return {};
}

} // namespace tegument
