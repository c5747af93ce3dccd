// AMD TressFX 4: .tfx. Strands have equally many points, a power of two of 4 to 64. Bones (.tfxbone) are another file.

#include "meshprep/groom/formats.h"

#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace tegument::groomfile {

namespace {

constexpr std::size_t kTfxHeader = 160;
constexpr std::size_t kMostTfxPoints = 64;
constexpr std::size_t kMostStrands = 1u << 26;

struct Chain {
    std::vector<glm::vec3> points;
    std::vector<glm::vec3> colors;
};

Chain chainOf(const Groom& groom, std::size_t strand, std::size_t count) {
    const std::span<const glm::vec3> points = groom.strand(strand);
    const std::span<const glm::vec3> colors =
        groom.colors.empty() ? std::span<const glm::vec3>() : std::span(groom.colors).subspan(groom.first[strand], points.size());
    Chain chain;
    for (const float place : points.size() <= count ? dividedPlaces(points, count) : evenPlaces(points, count)) {
        chain.points.push_back(atPlace(points, place));
        if (!colors.empty()) chain.colors.push_back(atPlace(colors, place));
    }
    return chain;
}

} // namespace

Result<Groom> readTfx(const Source& source, std::size_t) {
    if (source.bytes.size() < kTfxHeader) return meshfile::truncated(source.atByte(source.bytes.size()), "its header has 160 bytes");
    const auto field = [&](std::size_t number) { return std::size_t{numberAt<std::uint32_t>(source.bytes, 4 * number)}; };
    if (const auto version = numberAt<float>(source.bytes, 0); !(version >= 1 && version < 100))
        return meshfile::malformed(source.atByte(0), "the file has no version of TressFX");
    const std::size_t strands = field(1), each = field(2);
    if (strands == 0 || strands > kMostStrands || each < 2 || each > kMostTfxPoints)
        return meshfile::overclaimed(source.atByte(4), fmt::format("{} strands of {} points", strands, each));
    const auto places = arrayAt<glm::vec4>(source, field(3), strands * each, "points");
    if (!places) return places.error();
    Groom groom;
    groom.points.reserve(places->size());
    for (const glm::vec4& place : *places) {
        groom.points.emplace_back(place);
        if (groom.points.size() % each == 0) groom.endStrand();
    }
    if (field(4) != 0) {
        auto uvs = arrayAt<glm::vec2>(source, field(4), strands, "texture coordinates");
        if (!uvs) return uvs.error();
        groom.rootUvs = *std::move(uvs);
    }
    if (field(6) != 0) {
        const auto widths = arrayAt<float>(source, field(6), strands, "widths");
        if (!widths) return widths.error();
        for (const float width : *widths)
            groom.widths.insert(groom.widths.end(), each, width);
    }
    if (field(7) != 0) {
        const auto colors = arrayAt<glm::vec4>(source, field(7), strands * each, "colours");
        if (!colors) return colors.error();
        for (const glm::vec4& color : *colors)
            groom.colors.emplace_back(color);
    }
    if (field(5) != 0) ignored(groom, source, "the texture coordinates of its points are not read, but for roots'");
    std::error_code code;
    if (std::filesystem::exists(std::filesystem::path(source.path).replace_extension(".tfxbone"), code))
        ignored(groom, source, "the bones beside it (.tfxbone) are not read", "tegument fur pose moves strands with a body that bends");
    return groom;
}

std::string writeTfx(const Groom& groom) {
    std::size_t most = 0;
    for (std::size_t i = 0; i < groom.strands(); ++i)
        most = std::max(most, groom.length(i));
    const std::size_t each = std::clamp(std::bit_ceil(most), std::size_t{4}, kMostTfxPoints);
    std::vector<glm::vec4> points, colors;
    std::vector<float> widths;
    for (std::size_t i = 0; i < groom.strands(); ++i) {
        const Chain chain = chainOf(groom, i, each);
        for (std::size_t k = 0; k < each; ++k)
            points.emplace_back(chain.points[k], k < 2 ? 0.0F : 1.0F); // the first two do not move
        for (const glm::vec3& color : chain.colors)
            colors.emplace_back(color, 1.0F);
        if (!groom.widths.empty()) widths.push_back(groom.widths[groom.first[i]]);
    }
    std::string bytes;
    append(bytes, 4.0F);
    append(bytes, static_cast<std::uint32_t>(groom.strands()));
    append(bytes, static_cast<std::uint32_t>(each));
    std::uint64_t offset = kTfxHeader;
    const auto place = [&](std::size_t size) {
        append(bytes, size == 0 ? std::uint32_t{0} : static_cast<std::uint32_t>(offset));
        offset += (size + 7) / 8 * 8;
    };
    place(16 * points.size());
    place(8 * groom.rootUvs.size());
    place(0); // of points
    place(4 * widths.size());
    place(16 * colors.size());
    if (offset > UINT32_MAX) return {};
    bytes += "Tegument"; // in what is reserved
    bytes.resize(kTfxHeader);
    const auto put = [&](const auto& values) {
        append(bytes, values);
        bytes.resize((bytes.size() + 7) / 8 * 8);
    };
    put(points);
    put(groom.rootUvs);
    put(widths);
    put(colors);
    return bytes;
}

} // namespace tegument::groomfile
