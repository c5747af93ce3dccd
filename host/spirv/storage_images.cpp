#include "host/spirv/storage_images.h"

#include "host/spirv/instructions.h"

#include <set>

namespace tegument::spirv {

namespace {

constexpr std::size_t kSampled = 7; // words of OpTypeImage: 2 means written and read without a sampler
constexpr std::size_t kFormat = 8;

void addCapability(std::vector<std::uint32_t>& words, spv::Capability capability) {
    const std::uint32_t head = 2U << spv::WordCountShift | spv::OpCapability;
    words.insert(words.begin() + kModuleHeader, {head, static_cast<std::uint32_t>(capability)});
}

} // namespace

bool forgetStorageFormats(std::vector<std::uint32_t>& words) {
    std::vector<std::uint32_t> changed = words;
    std::set<std::vector<std::uint32_t>> types; // without their results
    bool any = false;
    bool reads = false;
    bool writes = false;
    bool twice = false;
    forEachInstruction(std::span(changed), [&](spv::Op op, std::span<std::uint32_t> instruction) {
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
