#include "host/compile/module.h"

namespace tegument::spirv {

std::string literalString(Words words) {
    std::string text;
    for (const std::uint32_t word : words)
        for (unsigned shift = 0; shift < 32; shift += 8) {
            const char letter = static_cast<char>((word >> shift) & 0xffU);
            if (letter == '\0') return text;
            text += letter;
        }
    return text;
}

Module::Module(Words words) : words_(words) {
    forEachInstruction(words, [&](const Instruction& instruction, std::size_t) { read(instruction); });
}

void Module::read(const Instruction& instruction) {
    const Words& w = instruction.words;
    switch (instruction.op) {
    case spv::Op::OpName: names_[{w[1], kWhole}] = literalString(w.subspan(2)); break;
    case spv::Op::OpMemberName: names_[{w[1], w[2]}] = literalString(w.subspan(3)); break;
    case spv::Op::OpDecorate:
    case spv::Op::OpDecorateString:
    case spv::Op::OpMemberDecorate: readDecoration(instruction); break;
    default: readDefinition(instruction);
    }
}

void Module::readDecoration(const Instruction& instruction) {
    const Words& w = instruction.words;
    if (instruction.op == spv::Op::OpMemberDecorate)
        decorations_[{w[1], w[2], static_cast<spv::Decoration>(w[3])}] = w.subspan(4);
    else
        decorations_[{w[1], kWhole, static_cast<spv::Decoration>(w[2])}] = w.subspan(3);
}

void Module::readDefinition(const Instruction& instruction) {
    const Words& w = instruction.words;
    switch (instruction.op) {
    case spv::Op::OpTypeBool:
    case spv::Op::OpTypeInt:
    case spv::Op::OpTypeFloat:
    case spv::Op::OpTypeVector:
    case spv::Op::OpTypeMatrix:
    case spv::Op::OpTypeArray:
    case spv::Op::OpTypeRuntimeArray:
    case spv::Op::OpTypeStruct:
    case spv::Op::OpTypePointer:
    case spv::Op::OpTypeImage:
    case spv::Op::OpTypeSampler:
    case spv::Op::OpTypeSampledImage: types_[w[1]] = {instruction.op, w.subspan(2)}; break;
    case spv::Op::OpConstant: constants_[w[2]] = w[3]; break;
    case spv::Op::OpVariable: {
        const Type& pointer = type(w[1]);
        if (pointer.op == spv::Op::OpTypePointer) variables_.push_back({w[2], pointer.operands[1], static_cast<spv::StorageClass>(w[3])});
        break;
    }
    default: break;
    }
}

const Type& Module::type(Id id) const {
    static const Type kNone;
    const auto found = types_.find(id);
    return found == types_.end() ? kNone : found->second;
}

std::string Module::name(Id id) const {
    return memberName(id, kWhole);
}

std::string Module::memberName(Id structure, std::uint32_t member) const {
    const auto found = names_.find({structure, member});
    return found == names_.end() ? std::string() : found->second;
}

std::optional<std::uint32_t> Module::constant(Id id) const {
    const auto found = constants_.find(id);
    if (found == constants_.end()) return {};
    return found->second;
}

bool Module::has(Id id, spv::Decoration decoration, std::uint32_t member) const {
    return decorations_.contains({id, member, decoration});
}

std::optional<std::uint32_t> Module::value(Id id, spv::Decoration decoration, std::uint32_t member) const {
    const auto found = decorations_.find({id, member, decoration});
    if (found == decorations_.end() || found->second.empty()) return {};
    return found->second[0];
}

std::string Module::text(Id id, spv::Decoration decoration) const {
    const auto found = decorations_.find({id, kWhole, decoration});
    return found == decorations_.end() ? std::string() : literalString(found->second);
}

bool writesPosition(Words module) {
    bool found = false;
    constexpr auto kBuiltIn = static_cast<std::uint32_t>(spv::Decoration::BuiltIn);
    constexpr auto kPosition = static_cast<std::uint32_t>(spv::BuiltIn::Position);
    forEachInstruction(module, [&](const Instruction& instruction, std::size_t) {
        const Words& w = instruction.words;
        const bool object = instruction.op == spv::Op::OpDecorate && w.size() > 3 && w[2] == kBuiltIn && w[3] == kPosition;
        const bool member = instruction.op == spv::Op::OpMemberDecorate && w.size() > 4 && w[3] == kBuiltIn && w[4] == kPosition;
        found = found || object || member;
    });
    return found;
}

} // namespace tegument::spirv
