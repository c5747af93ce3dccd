#include "host/spirv/dxil.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstring>

namespace tegument {

namespace {

std::optional<std::uint32_t> wordAt(std::string_view bytes, std::size_t at) {
    std::uint32_t word = 0;
    if (at > bytes.size() || bytes.size() - at < sizeof word) return {};
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}

constexpr std::size_t kPartCount = 28; // behind the magic number, a hash of 16 bytes, the version and the size
constexpr std::size_t kElementSize = 32;

/// The bytes of a part, without its name and its size.
std::optional<std::string_view> partOf(std::string_view container, std::string_view name) {
    if (!container.starts_with("DXBC")) return {};
    const std::uint32_t count = wordAt(container, kPartCount).value_or(0);
    for (std::size_t i = 0; i < count; ++i) {
        const auto at = wordAt(container, kPartCount + 4 * (i + 1));
        if (!at || *at > container.size()) return {};
        const std::string_view part = container.substr(*at);
        const auto size = wordAt(part, 4);
        if (!size || part.size() - 8 < *size) return {};
        if (part.starts_with(name)) return part.substr(8, *size);
    }
    return {};
}

std::optional<std::string> semanticAt(std::string_view part, std::uint32_t nameAt, std::uint32_t index) {
    const std::size_t end = nameAt < part.size() ? part.find('\0', nameAt) : std::string_view::npos;
    if (end == std::string_view::npos) return {};
    std::string name(part.substr(nameAt, end - nameAt));
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return name + fmt::format("{}", index);
}

/// Stream, name, index, system value, component type, register, masks, least precision: four bytes each. Of the masks the first byte is
/// the components', the second those that are always read; or, of an output, never written.
std::optional<SignatureElement> elementAt(std::string_view part, std::size_t at, bool output) {
    if (at > part.size() || part.size() - at < kElementSize) return {};
    const auto word = [&](std::size_t i) { return *wordAt(part, at + 4 * i); };
    auto semantic = semanticAt(part, word(1), word(2));
    if (!semantic) return {};
    const std::uint32_t mask = word(6) & 0xffU;
    const std::uint32_t second = word(6) >> 8U;
    return SignatureElement{.semantic = std::move(*semantic),
                            .systemValue = word(3) != 0,
                            .location = word(5),
                            .mask = static_cast<std::uint8_t>(mask),
                            .used = static_cast<std::uint8_t>(mask & (output ? ~second : second))};
}

} // namespace

std::optional<std::vector<SignatureElement>> readSignature(std::string_view container, std::string_view part) {
    const auto bytes = partOf(container, part);
    if (!bytes) return {};
    const auto count = wordAt(*bytes, 0);
    const auto first = wordAt(*bytes, 4);
    if (!count || !first || *count > bytes->size() / kElementSize) return {};
    std::vector<SignatureElement> elements;
    for (std::size_t i = 0; i < *count; ++i) {
        auto element = elementAt(*bytes, *first + i * kElementSize, part == "OSG1");
        if (!element) return {};
        elements.push_back(std::move(*element));
    }
    return elements;
}

} // namespace tegument
