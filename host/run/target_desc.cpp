#include "host/run/target_desc.h"

#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tegument::run {

namespace {

struct NamedFormat {
    std::string_view name;
    PixelFormat format;
};

// The first name of a format is the one reported. D24FS8 is what a device without D24S8 makes instead; effects cannot ask for it.
constexpr std::array kFormats = {
    NamedFormat{"A8R8G8B8", PixelFormat::BGRA8},
    NamedFormat{"X8R8G8B8", PixelFormat::BGRA8},
    NamedFormat{"A8B8G8R8", PixelFormat::RGBA8},
    NamedFormat{"A2B10G10R10", PixelFormat::RGB10A2},
    NamedFormat{"L8", PixelFormat::R8},
    NamedFormat{"R16F", PixelFormat::R16F},
    NamedFormat{"G16R16F", PixelFormat::RG16F},
    NamedFormat{"A16B16G16R16F", PixelFormat::RGBA16F},
    NamedFormat{"A16B16G16R16", PixelFormat::RGBA16},
    NamedFormat{"R32F", PixelFormat::R32F},
    NamedFormat{"G32R32F", PixelFormat::RG32F},
    NamedFormat{"A32B32G32R32F", PixelFormat::RGBA32F},
    NamedFormat{"D16", PixelFormat::D16},
    NamedFormat{"D24S8", PixelFormat::D24S8},
    NamedFormat{"D24X8", PixelFormat::D24S8},
    NamedFormat{"D24S8_SHADOWMAP", PixelFormat::D24S8},
    NamedFormat{"D32F_LOCKABLE", PixelFormat::D32F},
    NamedFormat{"D32F", PixelFormat::D32F},
    NamedFormat{"D24FS8", PixelFormat::D32FS8},
};

Result<PixelFormat> targetFormat(const Parameter& parameter) {
    const bool depth = parameter.hasSemantic(kDepthTarget);
    const Annotation* annotation = parameter.annotations.find("Format");
    if (!annotation) return depth ? PixelFormat::D24S8 : PixelFormat::BGRA8;
    const std::string name = parameter.annotations.string("Format").value_or("");
    const auto format = formatFromD3D(name);
    if (!format)
        return inputError(4020, annotation->at, fmt::format("this host makes no targets of format '{}': {}", name, parameter.name),
                          "docs/running.md lists the formats");
    if (isDepth(*format) != depth)
        return inputError(4022, annotation->at,
                          fmt::format("{} is a {} target, {} is not such a format", parameter.name, depth ? "depth" : "colour", name),
                          depth ? "use D24S8, D16 or D32F_LOCKABLE" : "use A16B16G16R16F, A32B32G32R32F, ...");
    return *format;
}

std::optional<double> firstNumber(const Annotations& annotations, std::string_view name, std::size_t index = 0) {
    const auto numbers = annotations.numbers(name);
    if (!numbers || numbers->size() <= index) return std::nullopt;
    return (*numbers)[index];
}

struct Size {
    double width = 0;
    double height = 0;
    bool own = true;
};

/// ViewportRatio wins over Dimensions, Dimensions over Width and Height.
Size targetSize(const Annotations& annotations, Extent picture) {
    if (const auto x = firstNumber(annotations, "ViewportRatio")) {
        const double y = firstNumber(annotations, "ViewportRatio", 1).value_or(*x);
        return {std::max(1.0, std::floor(*x * picture.width)), std::max(1.0, std::floor(y * picture.height)), false};
    }
    if (const auto x = firstNumber(annotations, "Dimensions")) return {*x, firstNumber(annotations, "Dimensions", 1).value_or(*x)};
    if (const auto x = firstNumber(annotations, "Width")) return {*x, firstNumber(annotations, "Height").value_or(*x)};
    return {static_cast<double>(picture.width), static_cast<double>(picture.height), false};
}

} // namespace

std::optional<PixelFormat> formatFromD3D(std::string_view name) {
    const auto canonical = canonicalFormat(name);
    if (!canonical) return std::nullopt;
    const auto found = std::ranges::find(kFormats, std::string_view(*canonical), &NamedFormat::name);
    return found == kFormats.end() ? std::nullopt : std::optional(found->format);
}

std::string_view d3dName(PixelFormat format) {
    const auto found = std::ranges::find(kFormats, format, &NamedFormat::format);
    return found == kFormats.end() ? tegument::name(format) : found->name;
}

int channelCount(PixelFormat format) {
    switch (format) {
    case PixelFormat::R8:
    case PixelFormat::R16F:
    case PixelFormat::R32F: return 1;
    case PixelFormat::RG8:
    case PixelFormat::RG16F:
    case PixelFormat::RG32F: return 2;
    default: return isDepth(format) ? 1 : 4;
    }
}

Result<TargetDesc> describeTarget(const Parameter& parameter, Extent picture) {
    const auto format = targetFormat(parameter);
    if (!format) return format.error();
    Size size = targetSize(parameter.annotations, picture);
    if (parameter.annotations.find("MostLevels")) size = {std::max(size.width, 1.0), std::max(size.height, 1.0), size.own}; // of ReShade
    for (const double side : {size.width, size.height})
        if (!(side >= 1 && side <= kMaxExtent) || side != std::floor(side))
            return inputError(4021, parameter.at, fmt::format("target {} would be {} x {} texels", parameter.name, size.width, size.height),
                              fmt::format("each side is a whole number from 1 to {}", kMaxExtent));
    if (parameter.type.base != BaseType::Texture2D)
        return inputError(4023, parameter.at, fmt::format("target {} is a {}", parameter.name, parameter.type.name),
                          "targets are Texture2D");
    const double mips = firstNumber(parameter.annotations, "MipLevels").value_or(firstNumber(parameter.annotations, "Levels").value_or(1));
    if (mips < 0 || mips > 15 || mips != std::floor(mips))
        return inputError(4021, parameter.at, fmt::format("target {} would have {} mip levels", parameter.name, mips),
                          "0 means the full chain");
    const Extent extent{static_cast<std::uint32_t>(size.width), static_cast<std::uint32_t>(size.height)};
    const double most = firstNumber(parameter.annotations, "MostLevels").value_or(mips); // as many of them as there are
    return TargetDesc{.extent = extent,
                      .format = *format,
                      .mips = static_cast<std::uint32_t>(
                          most == mips ? mips : std::clamp(most, 1.0, 1 + std::floor(std::log2(std::max(size.width, size.height))))),
                      .ownSize = size.own};
}

} // namespace tegument::run
