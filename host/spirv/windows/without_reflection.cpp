#include "host/spirv/validate.h"

#include "host/spirv/instructions.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

// As ../without_reflection.cpp, without SPIRV-Tools' optimiser, of which that uses one pass out of a hundred: here it is written out.

namespace tegument::spirv {

namespace {

constexpr std::array<std::string_view, 4> kExtensions = {"SPV_GOOGLE_hlsl_functionality1", "SPV_GOOGLE_user_type",
                                                         "SPV_GOOGLE_decorate_string", "SPV_KHR_non_semantic_info"};

using Words = std::span<const std::uint32_t>;

std::uint32_t at(Words words, std::size_t place) {
    return place < words.size() ? words[place] : 0;
}

/// The literal that begins at this word.
std::string_view textAt(Words words, std::size_t place) {
    if (place >= words.size()) return {};
    const std::string_view all(reinterpret_cast<const char*>(&words[place]), (words.size() - place) * sizeof(std::uint32_t));
    return all.substr(0, all.find('\0'));
}

bool isReflection(std::uint32_t decoration) {
    const auto known = static_cast<spv::Decoration>(decoration);
    return known == spv::DecorationHlslSemanticGOOGLE || known == spv::DecorationUserTypeGOOGLE;
}

bool isStripped(spv::Op code, Words words, std::set<std::uint32_t>& sets) {
    switch (code) {
    case spv::OpDecorateStringGOOGLE: return isReflection(at(words, 2));
    case spv::OpMemberDecorateStringGOOGLE: return isReflection(at(words, 3));
    case spv::OpDecorateId: return at(words, 2) == static_cast<std::uint32_t>(spv::DecorationHlslCounterBufferGOOGLE);
    case spv::OpExtension: return std::ranges::find(kExtensions, textAt(words, 1)) != kExtensions.end();
    case spv::OpExtInstImport: return textAt(words, 2).starts_with("NonSemantic.") && sets.insert(at(words, 1)).second;
    case spv::OpExtInst: return sets.contains(at(words, 3));
    default: return false;
    }
}

} // namespace

std::vector<std::uint32_t> withoutReflectionDecorations(std::span<const std::uint32_t> words) {
    if (words.size() < kModuleHeader) return {};
    std::vector<std::uint32_t> stripped(words.begin(), words.begin() + kModuleHeader);
    std::set<std::uint32_t> sets;
    forEachInstruction(words, [&](spv::Op code, Words instruction) {
        if (!isStripped(code, instruction, sets)) stripped.insert(stripped.end(), instruction.begin(), instruction.end());
    });
    return stripped;
}

} // namespace tegument::spirv
