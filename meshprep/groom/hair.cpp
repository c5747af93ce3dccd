// Cem Yuksel's .hair (cyHair): a header of 128 bytes, then arrays: segments of strands, points, thickness, transparency, colours.

#include "meshprep/groom/formats.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::groomfile {

namespace {

constexpr std::size_t kHairHeader = 128;
constexpr std::size_t kInformation = 88; // bytes of text at its end
enum Arrays : std::uint32_t { kSegments = 1, kPoints = 2, kThickness = 4, kTransparency = 8, kColors = 16 };

/// How many points each strand has; their sum is the header's.
Result<std::vector<std::uint32_t>> readCounts(const Source& source, std::uint32_t arrays, std::size_t strands, std::size_t points) {
    const auto segments = static_cast<std::size_t>(numberAt<std::uint32_t>(source.bytes, 16));
    std::vector<std::uint32_t> first{0};
    if ((arrays & kSegments) == 0) {
        if (segments >= points || strands != points / (segments + 1) || points % (segments + 1) != 0)
            return meshfile::overclaimed(source.atByte(4),
                                         fmt::format("{} strands of {} segments are not {} points", strands, segments, points));
        first.resize(strands + 1);
        for (std::size_t i = 1; i <= strands; ++i)
            first[i] = static_cast<std::uint32_t>(i * (segments + 1));
        return first;
    }
    const auto each = arrayAt<std::uint16_t>(source, kHairHeader, strands, "strands");
    if (!each) return each.error();
    first.reserve(strands + 1);
    std::size_t sum = 0;
    for (const std::uint16_t count : *each) {
        sum += count + std::size_t{1};
        if (sum > points) break;
        first.push_back(static_cast<std::uint32_t>(sum));
    }
    if (sum != points)
        return meshfile::overclaimed(source.atByte(kHairHeader),
                                     fmt::format("the strands have other points than the {} of the header", points));
    return first;
}

} // namespace

Result<Groom> readHair(const Source& source, std::size_t) {
    if (!source.bytes.starts_with("HAIR")) return meshfile::malformed(source.atByte(0), "the file does not start with HAIR");
    if (source.bytes.size() < kHairHeader) return meshfile::truncated(source.atByte(source.bytes.size()), "its header has 128 bytes");
    const std::size_t strands = numberAt<std::uint32_t>(source.bytes, 4);
    const std::size_t points = numberAt<std::uint32_t>(source.bytes, 8);
    const auto arrays = numberAt<std::uint32_t>(source.bytes, 12);
    if ((arrays & kPoints) == 0) return meshfile::malformed(source.atByte(12), "the file has no points");
    if (points > source.bytes.size() / sizeof(glm::vec3)) // before memory is taken for strands that share their number of points
        return meshfile::overclaimed(source.atByte(8),
                                     fmt::format("{} points cannot be held by a file of {} bytes", points, source.bytes.size()));
    Groom groom;
    auto first = readCounts(source, arrays, strands, points);
    if (!first) return first.error();
    groom.first = *std::move(first);
    std::size_t offset = kHairHeader + ((arrays & kSegments) != 0 ? 2 * strands : 0);
    auto places = arrayAt<glm::vec3>(source, offset, points, "points");
    if (!places) return places.error();
    groom.points = *std::move(places);
    offset += 12 * points;
    if ((arrays & kThickness) != 0) {
        auto widths = arrayAt<float>(source, offset, points, "widths");
        if (!widths) return widths.error();
        groom.widths = *std::move(widths);
        offset += 4 * points;
    } else if (const auto width = numberAt<float>(source.bytes, 20); width > 0) {
        groom.widths.assign(points, width);
    }
    if ((arrays & kTransparency) != 0) {
        ignored(groom, source, "its transparency is not read");
        offset += 4 * points;
    }
    if ((arrays & kColors) != 0) {
        auto colors = arrayAt<glm::vec3>(source, offset, points, "colours");
        if (!colors) return colors.error();
        groom.colors = *std::move(colors);
    } else if (const auto color = numberAt<glm::vec3>(source.bytes, 28); color != glm::vec3(0)) {
        groom.colors.assign(points, color);
    }
    return groom;
}

std::string writeHair(const Groom& groom) {
    std::uint32_t arrays = kSegments | kPoints;
    if (!groom.widths.empty()) arrays |= kThickness;
    if (!groom.colors.empty()) arrays |= kColors;
    std::string bytes = "HAIR";
    append(bytes, static_cast<std::uint32_t>(groom.strands()));
    append(bytes, static_cast<std::uint32_t>(groom.points.size()));
    append(bytes, arrays);
    append(bytes, std::uint32_t{0});
    append(bytes, glm::vec2(0)); // of strands without an array: thickness, transparency,
    append(bytes, glm::vec3(0)); // colour
    std::string information = "Tegument";
    information.resize(kInformation);
    bytes += information;
    for (std::size_t i = 0; i < groom.strands(); ++i) {
        if (groom.length(i) - 1 > UINT16_MAX) return {};
        append(bytes, static_cast<std::uint16_t>(groom.length(i) - 1));
    }
    append(bytes, groom.points);
    append(bytes, groom.widths);
    append(bytes, groom.colors);
    return bytes;
}

} // namespace tegument::groomfile
