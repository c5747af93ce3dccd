#pragma once
// The instructions of a SPIR-V module, one after the other. Inside host, and for those that count.

#include <spirv.hpp>

#include <algorithm>
#include <cstdint>
#include <span>

namespace tegument::spirv {

inline constexpr std::size_t kModuleHeader = 5; // words
inline constexpr std::size_t kModuleBound = 3;  // the word that is larger than every id

/// visit(op, words) for each instruction, its first word among them; `Word` may be const.
template <class Word, class Visit>
void forEachInstruction(std::span<Word> words, const Visit& visit) {
    for (std::size_t at = kModuleHeader; at < words.size();) {
        const std::size_t length = std::max<std::size_t>(1, words[at] >> spv::WordCountShift);
        if (at + length > words.size()) return;
        visit(static_cast<spv::Op>(words[at] & spv::OpCodeMask), words.subspan(at, length));
        at += length;
    }
}

} // namespace tegument::spirv
