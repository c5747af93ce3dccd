#include "host/emit/widen.h"

#include "host/compile/module.h"

#include <algorithm>
#include <optional>

namespace tegument {

namespace {

using spirv::Id;
using spirv::Instruction;
using spirv::Module;
using Words = std::vector<std::uint32_t>;

constexpr std::size_t kBoundWord = 3; // of the header: one more than the largest id

struct Input {
    Id scalar = 0;  // the component's type
    Id narrow = 0;  // what the code reads
    Id wide = 0;    // new
    Id pointer = 0; // new
    std::uint32_t components = 1;
    std::uint32_t wanted = 1;
};

std::uint32_t head(spv::Op op, std::size_t words) {
    return static_cast<std::uint32_t>(words << 16U) | static_cast<std::uint32_t>(op);
}

void append(Words& into, spv::Op op, std::initializer_list<std::uint32_t> operands) {
    into.push_back(head(op, operands.size() + 1));
    into.insert(into.end(), operands);
}

std::map<Id, Input> narrowInputs(const Module& module, const Varyings& written, std::uint32_t& bound) {
    std::map<Id, Input> inputs;
    for (const spirv::Variable& variable : module.variables()) {
        const auto location = module.value(variable.id, spv::Decoration::Location);
        if (variable.storage != spv::StorageClass::Input || !location || !written.contains(*location)) continue;
        const spirv::Type& type = module.type(variable.pointee);
        const bool vector = type.op == spv::Op::OpTypeVector;
        if (!vector && type.op != spv::Op::OpTypeFloat) continue;
        Input input{.scalar = vector ? type.operands[0] : variable.pointee,
                    .narrow = variable.pointee,
                    .components = vector ? type.operands[1] : 1,
                    .wanted = written.at(*location).components};
        if (input.components >= input.wanted) continue;
        input.wide = bound++;
        input.pointer = bound++;
        inputs.emplace(variable.id, input);
    }
    return inputs;
}

/// A vector type that exists already must not be declared again.
std::optional<Id> existingVector(const Module& module, Id scalar, std::uint32_t components) {
    std::optional<Id> found;
    spirv::forEachInstruction(module.words(), [&](const Instruction& instruction, std::size_t) {
        const auto& w = instruction.words;
        if (instruction.op == spv::Op::OpTypeVector && w[2] == scalar && w[3] == components) found = w[1];
    });
    return found;
}

/// Each wide type is declared once, before the first variable.
void declare(const Module& module, std::map<Id, Input>& inputs, Words& into) {
    std::map<std::pair<Id, std::uint32_t>, std::pair<Id, Id>> declared; // vector, pointer
    for (auto& [id, input] : inputs) {
        const auto [found, isNew] = declared.try_emplace({input.scalar, input.wanted}, input.wide, input.pointer);
        const auto existing = existingVector(module, input.scalar, input.wanted);
        if (existing) found->second.first = *existing;
        input.wide = found->second.first;
        input.pointer = found->second.second;
        if (!isNew) continue;
        if (!existing) append(into, spv::Op::OpTypeVector, {input.wide, input.scalar, input.wanted});
        append(into, spv::Op::OpTypePointer, {input.pointer, static_cast<std::uint32_t>(spv::StorageClass::Input), input.wide});
    }
}

/// %id = OpLoad %narrow %variable: the whole value, then its first components.
void load(const Instruction& instruction, const Input& input, std::uint32_t& bound, Words& into) {
    const Id whole = bound++;
    const Id result = instruction.words[2];
    append(into, spv::Op::OpLoad, {input.wide, whole, instruction.words[3]});
    if (input.components == 1) return append(into, spv::Op::OpCompositeExtract, {input.narrow, result, whole, 0});
    into.push_back(head(spv::Op::OpVectorShuffle, 5 + input.components));
    into.insert(into.end(), {input.narrow, result, whole, whole});
    for (std::uint32_t i = 0; i < input.components; ++i)
        into.push_back(i);
}

} // namespace

std::vector<std::uint32_t> withWholeInputs(const std::vector<std::uint32_t>& words, const Varyings& written) {
    const Module module(words);
    std::uint32_t bound = words[kBoundWord];
    std::map<Id, Input> inputs = narrowInputs(module, written, bound);
    if (inputs.empty()) return words;
    Words result(words.begin(), words.begin() + spirv::kHeaderWords);
    bool declared = false;
    spirv::forEachInstruction(words, [&](const Instruction& instruction, std::size_t) {
        const auto& w = instruction.words;
        if (instruction.op == spv::Op::OpVariable && !declared) {
            declare(module, inputs, result);
            declared = true;
        }
        const Id subject = instruction.op == spv::Op::OpVariable ? w[2] : instruction.op == spv::Op::OpLoad ? w[3] : 0;
        const auto found = inputs.find(subject);
        if (found != inputs.end() && instruction.op == spv::Op::OpLoad) return load(instruction, found->second, bound, result);
        result.insert(result.end(), w.begin(), w.end());
        if (found != inputs.end()) result[result.size() - w.size() + 1] = found->second.pointer;
    });
    result[kBoundWord] = bound;
    return result;
}

} // namespace tegument
