#include "host/spirv/dxil.h"

#include "host/spirv/scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <sstream>

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
                            .base = word(4) == 1   ? MemberBase::Uint
                                    : word(4) == 2 ? MemberBase::Int
                                                   : MemberBase::Float,
                            .mask = static_cast<std::uint8_t>(mask),
                            .used = static_cast<std::uint8_t>(mask & (output ? ~second : second))};
}

/// Name, type, format, dimension, place, register ("cb0", "t3"), count. Names have no blanks in them.
std::vector<std::string> columnsOf(std::string_view line) {
    std::istringstream words{std::string(line)};
    return {std::istream_iterator<std::string>(words), {}};
}

ResourceKind textureKind(std::string_view dimension) {
    if (dimension == "1d") return ResourceKind::Texture1D;
    if (dimension == "3d") return ResourceKind::Texture3D;
    return dimension == "cube" ? ResourceKind::TextureCube : ResourceKind::Texture2D;
}

void addBinding(Reflection& reflection, const std::vector<std::string>& columns) {
    const std::string& name = columns[0];
    const std::string& type = columns[1];
    const std::string& place = columns[5];
    const auto binding = static_cast<std::uint32_t>(std::strtoul(place.substr(place.find_first_of("0123456789")).c_str(), nullptr, 10));
    if (type == "cbuffer") {
        const UniformBlock block{.name = name, .set = 0, .binding = binding, .size = 0};
        if (name == "$Globals")
            reflection.globals = block;
        else
            reflection.constantBuffers.push_back(block);
        return;
    }
    const ResourceKind kind = type == "sampler"     ? ResourceKind::Sampler
                              : type == "UAV"       ? ResourceKind::StorageImage
                              : columns[3] == "r/o" ? ResourceKind::StorageBuffer
                                                    : textureKind(columns[3]);
    reflection.resources.push_back({.name = name, .kind = kind, .set = 0, .binding = binding});
}

} // namespace

std::vector<StageVariable> variablesOf(const std::vector<SignatureElement>& signature) {
    std::vector<StageVariable> variables;
    for (const SignatureElement& element : signature)
        if (!element.systemValue || element.semantic.starts_with("SV_TARGET"))
            variables.push_back({.semantic = element.semantic,
                                 .location = element.location,
                                 .components = static_cast<std::uint32_t>(std::popcount(element.mask)),
                                 .base = element.base});
    return variables;
}

Reflection readBindings(std::string_view listing) {
    Reflection reflection;
    bool inside = false;
    forEachLine(listing, [&](std::string_view line) {
        if (line.starts_with("; Resource Bindings:")) inside = true;
        if (!line.starts_with(";")) inside = false;
        const std::vector<std::string> columns = inside ? columnsOf(line.substr(1)) : std::vector<std::string>{};
        if (columns.size() == 7 && columns[5].find_first_of("0123456789") != std::string::npos) addBinding(reflection, columns);
    });
    return reflection;
}

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
