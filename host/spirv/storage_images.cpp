#include "host/spirv/storage_images.h"

#include <spirv.hpp>

#include <algorithm>
#include <set>
#include <span>

namespace tegument::spirv {

namespace {

constexpr std::size_t kHeader = 5;  // words
constexpr std::size_t kSampled = 7; // words of OpTypeImage: 2 means written and read without a sampler
constexpr std::size_t kFormat = 8;

template <class Visit>
void forEachInstruction(std::vector<std::uint32_t>& words, const Visit& visit) {
    for (std::size_t at = kHeader; at < words.size();) {
        const std::size_t length = std::max<std::size_t>(1, words[at] >> spv::WordCountShift);
        if (at + length > words.size()) return;
        visit(static_cast<spv::Op>(words[at] & spv::OpCodeMask), std::span(words).subspan(at, length));
        at += length;
    }
}

void addCapability(std::vector<std::uint32_t>& words, spv::Capability capability) {
    const std::uint32_t head = 2U << spv::WordCountShift | spv::OpCapability;
    words.insert(words.begin() + kHeader, {head, static_cast<std::uint32_t>(capability)});
}

} // namespace

bool forgetStorageFormats(std::vector<std::uint32_t>& words) {
    std::vector<std::uint32_t> changed = words;
    std::set<std::vector<std::uint32_t>> types; // without their results
    bool any = false;
    bool reads = false;
    bool writes = false;
    bool twice = false;
    forEachInstruction(changed, [&](spv::Op op, std::span<std::uint32_t> instruction) {
        reads = reads || op == spv::OpImageRead;
        writes = writes || op == spv::OpImageWrite;
        if (op != spv::OpTypeImage || instruction.size() <= kFormat) return;
        if (instruction[kSampled] == 2) {
            instruction[kFormat] = spv::ImageFormatUnknown;
            any = true;
        }
        twice = twice || !types.emplace(instruction.begin() + 2, instruction.end()).second;
    });
    if (!any) return true;
    if (twice) return false;
    if (reads) addCapability(changed, spv::CapabilityStorageImageReadWithoutFormat);
    if (writes) addCapability(changed, spv::CapabilityStorageImageWriteWithoutFormat);
    words = std::move(changed);
    return true;
}

} // namespace tegument::spirv
