#include "tools/emit/root_signature.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace tegument::emit {

namespace {

bool isSampler(const Resource& resource) {
    return resource.kind == ResourceKind::Sampler || resource.kind == ResourceKind::CompareSampler;
}

bool isStore(const Resource& resource) {
    return resource.kind == ResourceKind::StorageImage;
}

bool isTexture(const Resource& resource) {
    return !isSampler(resource) && !isStore(resource);
}

/// "SRV(t0, numDescriptors=3)": from the first to the last register of a kind; empty without any.
template <class Wanted>
std::string range(const RootStage& stage, std::string_view word, char letter, Wanted wanted) {
    std::vector<std::uint32_t> registers;
    for (const Reflection* reflection : stage.reflections)
        for (const Resource& resource : reflection->resources)
            if (wanted(resource)) registers.push_back(resource.binding);
    if (registers.empty()) return {};
    const auto [first, last] = std::ranges::minmax(registers);
    return fmt::format("{}({}{}, numDescriptors={})", word, letter, first, last - first + 1);
}

void addTable(std::vector<std::string>& parts, const std::vector<std::string>& ranges, std::string_view visibility) {
    std::vector<std::string> filled;
    std::ranges::copy_if(ranges, std::back_inserter(filled), [](const std::string& text) { return !text.empty(); });
    if (!filled.empty())
        parts.push_back(fmt::format("DescriptorTable({}, visibility=SHADER_VISIBILITY_{})", fmt::join(filled, ", "), visibility));
}

void addStage(std::vector<std::string>& parts, const RootStage& stage) {
    const auto block = [&](const UniformBlock& one) {
        const std::string part = fmt::format("CBV(b{}, visibility=SHADER_VISIBILITY_{})", one.binding, stage.visibility);
        if (std::ranges::find(parts, part) == parts.end()) parts.push_back(part);
    };
    for (const Reflection* reflection : stage.reflections) {
        if (reflection->globals) block(*reflection->globals);
        std::ranges::for_each(reflection->constantBuffers, block);
    }
    addTable(parts, {range(stage, "SRV", 't', isTexture), range(stage, "UAV", 'u', isStore)}, stage.visibility);
    addTable(parts, {range(stage, "Sampler", 's', isSampler)}, stage.visibility);
}

} // namespace

std::string rootSignature(const std::vector<RootStage>& stages) {
    std::vector<std::string> parts;
    if (std::ranges::any_of(stages, [](const RootStage& stage) { return stage.visibility == "VERTEX"; }))
        parts.emplace_back("RootFlags(ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT)");
    for (const RootStage& stage : stages)
        addStage(parts, stage);
    return fmt::format("{}", fmt::join(parts, ", "));
}

} // namespace tegument::emit
