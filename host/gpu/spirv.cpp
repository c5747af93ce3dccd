#include "host/gpu/spirv.h"

#include "host/gpu/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace tegument::gpu::detail {

namespace {

// SPIR-V specification, 2.3 "Physical Layout of a SPIR-V Module and Instruction".
constexpr std::uint32_t kMagic = 0x07230203;
constexpr std::size_t kHeaderWords = 5;
constexpr std::uint32_t kOpEntryPoint = 15;

struct EntryPoint {
    std::uint32_t model = 0;
    std::string name;
};

/// A literal string: UTF-8, low byte first, ended by a zero byte.
std::string literal(std::span<const std::uint32_t> words) {
    std::string text;
    for (const std::uint32_t word : words)
        for (unsigned shift = 0; shift < 32; shift += 8) {
            const char letter = static_cast<char>(word >> shift & 0xffu);
            if (letter == 0) return text;
            text += letter;
        }
    return text;
}

/// Empty when the instructions' lengths do not add up to the module's.
std::optional<std::vector<EntryPoint>> entryPoints(std::span<const std::uint32_t> words) {
    std::vector<EntryPoint> found;
    for (std::size_t at = kHeaderWords; at < words.size();) {
        const std::size_t length = words[at] >> 16;
        if (length == 0 || length > words.size() - at) return std::nullopt;
        if ((words[at] & 0xffffu) == kOpEntryPoint && length > 3)
            found.push_back({words[at + 1], literal(words.subspan(at + 3, length - 3))});
        at += length;
    }
    return found;
}

std::string_view stageName(ShaderStage stage) {
    switch (stage) {
    case ShaderStage::Vertex: return "vertex";
    case ShaderStage::Pixel: return "pixel";
    case ShaderStage::Compute: return "compute";
    }
    return "";
}

} // namespace

Result<void> checkShader(std::span<const std::uint32_t> words, const std::string& entry, ShaderStage stage, const std::string& pipeline) {
    const bool header = words.size() > kHeaderWords && words[0] == kMagic;
    const auto entries = header ? entryPoints(words) : std::nullopt;
    if (!entries) return requestError(6020, fmt::format("pipeline '{}': the {} shader is not a SPIR-V module", pipeline, stageName(stage)));
    const bool found = std::ranges::any_of(
        *entries, [&](const EntryPoint& point) { return point.model == static_cast<std::uint32_t>(stage) && point.name == entry; });
    if (!found)
        return requestError(6021, fmt::format("pipeline '{}': the module has no {} shader '{}'", pipeline, stageName(stage), entry));
    return {};
}

} // namespace tegument::gpu::detail
