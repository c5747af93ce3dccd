#include "host/gpu/spirv.h"

#include "host/gpu/error.h"

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

constexpr spv_target_env kEnvironment = SPV_ENV_VULKAN_1_3;

// SPIR-V specification, 2.3 "Physical Layout of a SPIR-V Module" and 3.42 "Instructions".
constexpr std::size_t kHeaderWords = 5;
constexpr std::uint32_t kSpirv14 = 0x00010400; // from here on the interface lists variables of all storage classes
constexpr std::uint16_t kOpName = 5;
constexpr std::uint16_t kOpEntry = 15;
constexpr std::uint16_t kOpTypePointer = 32;
constexpr std::uint16_t kOpVariable = 59;
constexpr std::uint16_t kOpStore = 62;
constexpr std::uint16_t kOpDecorate = 71;
constexpr std::uint32_t kLocation = 30; // a decoration
constexpr std::uint32_t kOutput = 3;    // storage classes
constexpr std::uint32_t kPrivate = 6;

struct Outputs {
    std::map<std::uint32_t, std::uint32_t> pointees; // of pointer types to outputs
    std::map<std::uint32_t, std::uint32_t> types;    // of variables that are outputs
    std::set<std::uint32_t> beyond;                  // variables whose location no target has
};

template <class Visit>
void forEach(std::span<const std::uint32_t> words, const Visit& visit) {
    for (std::size_t at = kHeaderWords; at < words.size();) {
        const std::size_t length = std::max<std::size_t>(1, words[at] >> 16U);
        if (at + length > words.size()) return;
        visit(words[at] & 0xffffU, words.subspan(at, length));
        at += length;
    }
}

Outputs outputsOf(std::uint32_t targets, std::span<const std::uint32_t> words) {
    Outputs found;
    forEach(words, [&](std::uint32_t op, std::span<const std::uint32_t> w) {
        if (op == kOpTypePointer && w[2] == kOutput) found.pointees[w[1]] = w[3];
        if (op == kOpVariable && w[3] == kOutput) found.types[w[2]] = w[1];
        if (op == kOpDecorate && w.size() > 3 && w[2] == kLocation && w[3] >= targets) found.beyond.insert(w[1]);
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
        constexpr std::array kMay = {kOpName, kOpDecorate, kOpVariable, kOpEntry, kOpStore};
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
    into[begin] = static_cast<std::uint32_t>(into.size() - begin) << 16U | kOpEntry;
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
        wanted.found |= instruction->opcode == kOpEntry && w[1] == wanted.model && wanted.name == reinterpret_cast<const char*>(w + 3);
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
    if (words.size() < kHeaderWords) return {};
    const Outputs outputs = outputsOf(targets, words);
    if (outputs.beyond.empty() || !onlyStoredTo(outputs.beyond, words)) return {};
    std::vector<std::uint32_t> made(words.begin(), words.begin() + kHeaderWords);
    forEach(words, [&](std::uint32_t op, std::span<const std::uint32_t> w) {
        if (op == kOpEntry && words[1] < kSpirv14) {
            appendEntry(made, w, outputs.beyond);
        } else if (op == kOpVariable && outputs.beyond.contains(w[2])) {
            const std::uint32_t type = made[3]++; // the bound: one more id
            append(made,
                   std::to_array<std::uint32_t>({4U << 16U | kOpTypePointer, type, kPrivate, outputs.pointees.at(outputs.types.at(w[2]))}));
            append(made, std::to_array<std::uint32_t>({4U << 16U | kOpVariable, type, w[2], kPrivate}));
        } else if (!(op == kOpDecorate && outputs.beyond.contains(w[1]))) {
            append(made, w);
        }
    });
    return made;
}

} // namespace tegument::gpu::detail
