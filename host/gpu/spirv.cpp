#include "host/gpu/spirv.h"

#include "host/gpu/error.h"
#include "host/spirv/instructions.h"

#include <fmt/format.h>
#include <spirv-tools/libspirv.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <string_view>

namespace tegument::gpu::detail {

namespace {

using spirv::forEachInstruction;

constexpr spv_target_env kEnvironment = SPV_ENV_VULKAN_1_3;

constexpr std::uint32_t kSpirv14 = 0x00010400; // from here on the interface lists variables of all storage classes

struct Outputs {
    std::map<std::uint32_t, std::uint32_t> pointees; // of pointer types to outputs
    std::map<std::uint32_t, std::uint32_t> types;    // of variables that are outputs
    std::set<std::uint32_t> beyond;                  // variables whose location no target has
};

Outputs outputsOf(std::uint32_t targets, std::span<const std::uint32_t> words) {
    Outputs found;
    forEachInstruction(words, [&](spv::Op op, std::span<const std::uint32_t> w) {
        if (op == spv::OpTypePointer && w[2] == spv::StorageClassOutput) found.pointees[w[1]] = w[3];
        if (op == spv::OpVariable && w[3] == spv::StorageClassOutput) found.types[w[2]] = w[1];
        if (op == spv::OpDecorate && w.size() > 3 && w[2] == spv::DecorationLocation && w[3] >= targets) found.beyond.insert(w[1]);
    });
    std::erase_if(found.beyond, [&](std::uint32_t id) { return !found.types.contains(id); }); // inputs have locations, too
    return found;
}

/// Where the first id of an entry point's interface is: behind the words of its name.
std::size_t interfaceAt(std::span<const std::uint32_t> entry) {
    std::size_t at = 3;
    while (at < entry.size() && (entry[at] >> 24U) != 0)
        ++at;
    return at + 1;
}

/// A variable that is read, or stored to by its parts, has pointers of its own type behind it.
bool onlyStoredTo(const std::set<std::uint32_t>& ids, std::span<const std::uint32_t> words) {
    struct Search {
        const std::set<std::uint32_t>& ids;
        bool only = true;
    } search{ids};
    const auto visit = [](void* into, const spv_parsed_instruction_t* instruction) {
        auto& wanted = *static_cast<Search*>(into);
        constexpr std::array<std::uint16_t, 5> kMay = {spv::OpName, spv::OpDecorate, spv::OpVariable, spv::OpEntryPoint, spv::OpStore};
        if (std::ranges::find(kMay, instruction->opcode) != kMay.end()) return SPV_SUCCESS;
        for (const spv_parsed_operand_t& operand : std::span(instruction->operands, instruction->num_operands))
            wanted.only = wanted.only && !(operand.type == SPV_OPERAND_TYPE_ID && wanted.ids.contains(instruction->words[operand.offset]));
        return SPV_SUCCESS;
    };
    const spvtools::Context context(kEnvironment);
    return spvBinaryParse(context.CContext(), &search, words.data(), words.size(), nullptr, visit, nullptr) == SPV_SUCCESS && search.only;
}

void append(std::vector<std::uint32_t>& into, std::span<const std::uint32_t> words) {
    into.insert(into.end(), words.begin(), words.end());
}

void appendEntry(std::vector<std::uint32_t>& into, std::span<const std::uint32_t> entry, const std::set<std::uint32_t>& gone) {
    const std::size_t begin = into.size();
    const std::size_t interface = std::min(interfaceAt(entry), entry.size());
    append(into, entry.first(interface));
    std::ranges::copy_if(entry.subspan(interface), std::back_inserter(into), [&](std::uint32_t id) { return !gone.contains(id); });
    into[begin] = static_cast<std::uint32_t>(into.size() - begin) << spv::WordCountShift | spv::OpEntryPoint;
}

} // namespace

Result<void> checkShader(std::span<const std::uint32_t> words, const std::string& entry, ShaderStage stage, const std::string& pipeline) {
    struct Search {
        std::uint32_t model;
        std::string_view name;
        bool found = false;
    } search{stageNames(stage).model, entry};
    const auto visit = [](void* into, const spv_parsed_instruction_t* instruction) {
        auto& wanted = *static_cast<Search*>(into);
        const std::uint32_t* w = instruction->words; // strings end within their instruction
        wanted.found |=
            instruction->opcode == spv::OpEntryPoint && w[1] == wanted.model && wanted.name == reinterpret_cast<const char*>(w + 3);
        return SPV_SUCCESS;
    };
    std::string why = "it cannot be read";
    spvtools::Context context(kEnvironment);
    context.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&, const char* text) { why = text; });
    if (spvBinaryParse(context.CContext(), &search, words.data(), words.size(), nullptr, visit, nullptr) != SPV_SUCCESS)
        return requestError(6020,
                            fmt::format("pipeline '{}': the {} shader is not a SPIR-V module: {}", pipeline, stageNames(stage).name, why));
    if (!search.found)
        return requestError(6021, fmt::format("pipeline '{}': the module has no {} shader '{}'", pipeline, stageNames(stage).name, entry));
    return {};
}

std::vector<std::uint32_t> withoutOutputsFrom(std::uint32_t targets, std::span<const std::uint32_t> words) {
    if (words.size() < spirv::kModuleHeader) return {};
    const Outputs outputs = outputsOf(targets, words);
    if (outputs.beyond.empty() || !onlyStoredTo(outputs.beyond, words)) return {};
    std::vector<std::uint32_t> made(words.begin(), words.begin() + spirv::kModuleHeader);
    forEachInstruction(words, [&](spv::Op op, std::span<const std::uint32_t> w) {
        if (op == spv::OpEntryPoint && words[1] < kSpirv14) {
            appendEntry(made, w, outputs.beyond);
        } else if (op == spv::OpVariable && outputs.beyond.contains(w[2])) {
            const std::uint32_t type = made[spirv::kModuleBound]++; // the bound: one more id
            append(made, std::to_array<std::uint32_t>({4U << spv::WordCountShift | spv::OpTypePointer, type, spv::StorageClassPrivate,
                                                       outputs.pointees.at(outputs.types.at(w[2]))}));
            append(made, std::to_array<std::uint32_t>({4U << spv::WordCountShift | spv::OpVariable, type, w[2], spv::StorageClassPrivate}));
        } else if (!(op == spv::OpDecorate && outputs.beyond.contains(w[1]))) {
            append(made, w);
        }
    });
    return made;
}

} // namespace tegument::gpu::detail
