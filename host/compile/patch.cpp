#include "host/compile/patch.h"

namespace tegument::spirv {

namespace {

bool onlyForReflection(const Instruction& instruction) {
    const Words& w = instruction.words;
    const auto is = [](std::uint32_t word, spv::Decoration decoration) { return static_cast<spv::Decoration>(word) == decoration; };
    switch (instruction.op) {
    case spv::Op::OpExtension: {
        const std::string name = literalString(w.subspan(1));
        return name == "SPV_GOOGLE_hlsl_functionality1" || name == "SPV_GOOGLE_user_type" || name == "SPV_GOOGLE_decorate_string";
    }
    case spv::Op::OpDecorateString: return is(w[2], spv::Decoration::UserSemantic) || is(w[2], spv::Decoration::UserTypeGOOGLE);
    case spv::Op::OpMemberDecorateString: return is(w[3], spv::Decoration::UserSemantic) || is(w[3], spv::Decoration::UserTypeGOOGLE);
    case spv::Op::OpDecorateId: return is(w[2], spv::Decoration::CounterBuffer);
    default: return false;
    }
}

} // namespace

void replaceDecorations(std::vector<std::uint32_t>& words, spv::Decoration decoration,
                        const std::function<std::optional<std::uint32_t>(Id, std::uint32_t)>& replace) {
    std::vector<std::pair<std::size_t, std::uint32_t>> edits;
    forEachInstruction(words, [&](const Instruction& instruction, std::size_t at) {
        const Words& w = instruction.words;
        if (instruction.op != spv::Op::OpDecorate || w.size() != 4 || static_cast<spv::Decoration>(w[2]) != decoration) return;
        if (const auto value = replace(w[1], w[3])) edits.emplace_back(at + 3, *value);
    });
    for (const auto& [at, value] : edits)
        words[at] = value;
}

std::vector<std::uint32_t> withoutReflectionDecorations(Words words) {
    std::vector<std::uint32_t> kept(words.begin(), words.begin() + kHeaderWords);
    forEachInstruction(words, [&](const Instruction& instruction, std::size_t) {
        if (!onlyForReflection(instruction)) kept.insert(kept.end(), instruction.words.begin(), instruction.words.end());
    });
    return kept;
}

} // namespace tegument::spirv
