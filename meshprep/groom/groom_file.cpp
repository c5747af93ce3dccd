#include "meshprep/groom/groom_file.h"

#include "host/support/file.h"
#include "host/support/text.h"
#include "meshprep/groom/formats.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>

namespace tegument {

using namespace groomfile;

namespace {

/// Alembic and .hair do not say their unit: centimetres, as Maya and Unreal have. AMD's own .tfx are in metres.
constexpr std::array<GroomFormat, 8> kGrooms = {
    {{".abc", "Alembic", readAlembic, writeAlembic, 10, {true, true, true, true, true, false}},
     {".usda", "USD text", readUsda, writeUsda, 10, {true, true, true, true, true, true}},
     {".hair", "hair", readHair, writeHair, 10, {true, true, false, false, false, false}},
     {".tfx", "TressFX", readTfx, writeTfx, 1000, {true, true, true, false, false, false}},
     {".glb", "glb", readGltfLines, writeGltfLines, 1000, {true, true, true, true, false, false}},
     {".gltf", "glTF", readGltfLines, nullptr, 1000, {}},
     {".ply", "PLY", readPlyEdges, writePlyEdges, 1, {true, true, true, true, false, false}},
     {".obj", "OBJ", readObjLines, writeObjLines, 1, {false, true, true, false, false, false}}}};

const GroomFormat* formatOf(const std::filesystem::path& path) {
    const std::string ending = toLower(path.extension().string());
    const auto* found = std::ranges::find(kGrooms, ending, &GroomFormat::extension);
    return found == kGrooms.end() ? nullptr : found;
}

Error unknown(const std::filesystem::path& path) {
    const std::string ending = toLower(path.extension().string());
    std::string hint = "convert it to .abc or .usda";
    if (ending == ".tfxbone") hint = "bones are not read: give the .tfx beside it";
    if (ending == ".usd" || ending == ".usdc" || ending == ".usdz") hint = "write it as text: usdcat FILE -o FILE.usda";
    return inputError(5340, {.file = path.string()}, fmt::format("no file of a groom: those end in {}", fmt::join(groomEndings(), ", ")),
                      std::move(hint));
}

/// Holds what a reader has made against what a groom promises.
Result<Groom> checked(Groom groom, const Source& source) {
    const std::size_t least = leastPoints(groom.spline) - (groom.pinned ? 2 : 0);
    for (const auto* list : {&groom.points, &groom.colors})
        if (!std::ranges::all_of(*list, meshfile::isFinite)) return meshfile::notFinite(source.whole(), "a point or colour is not finite");
    if (!std::ranges::all_of(groom.widths, [](float w) { return std::isfinite(w) && w >= 0; }))
        return meshfile::notFinite(source.whole(), "a width is not finite, or below 0");
    if (!std::ranges::all_of(groom.rootUvs, [](const glm::vec2& uv) { return std::isfinite(uv.x + uv.y); }))
        return meshfile::notFinite(source.whole(), "a texture coordinate is not finite");
    const auto isStrand = [&](std::size_t i) {
        const std::span<const glm::vec3> points = groom.strand(i);
        return points.size() >= least && std::ranges::any_of(points, [&](const glm::vec3& p) { return p != points.front(); });
    };
    std::size_t strands = 0;
    for (std::size_t i = 0; i < groom.strands(); ++i)
        strands += isStrand(i);
    if (strands == 0)
        return inputError(5341, source.whole(), "the file holds no strand: none of its curves has a length",
                          "tegument fur import reads curves, lines and edges; tegument fur strands MESH grows strands on a mesh");
    if (strands == groom.strands()) return groom;
    ignored(groom, source,
            fmt::format("{} strands of less than {} points, or of no length, are left out", groom.strands() - strands, least));
    return strandsOf(groom, isStrand);
}

Result<Groom> read(const std::filesystem::path& path, const GroomOptions& options) {
    const GroomFormat* format = formatOf(path);
    if (!format) return unknown(path);
    const double unit = options.unitMm.value_or(format->unitMm);
    if (!(unit > 0 && std::isfinite(unit)))
        return usageError(5312, fmt::format("one unit of a groom cannot be {:g} mm", unit), "give a positive length in millimetres");
    const Result<std::string> bytes = readFile(path);
    if (!bytes) return bytes.error();
    const Source source{.path = path, .bytes = *bytes, .unitMm = 1, .roots = rootsOf(path, {}, {})};
    if (bytes->empty()) return inputError(5340, source.atByte(0), "the file is empty", "fetch or export it again");
    Result<Groom> groom = format->read(source, options.frame);
    if (!groom) return groom;
    if (!format->holds.units || options.unitMm) groom->unitMm = unit;
    if (options.zIsUp) groom->zIsUp = *options.zIsUp;
    return checked(*std::move(groom), source);
}

} // namespace

namespace groomfile {

void ignored(Groom& groom, const Source& source, std::string text, std::string hint) {
    groom.warnings.push_back(inputWarning(5323, source.whole(), std::move(text), std::move(hint)));
}

std::size_t spanEnds(const Groom& groom, std::size_t strand) {
    const std::size_t points = groom.length(strand);
    if (groom.spline == Spline::Linear || groom.pinned) return points;
    if (groom.spline == Spline::Bezier) return points < 4 ? 1 : (points - 1) / 3 + 1;
    return points < 4 ? 1 : points - 2;
}

void transform(Groom& groom, const glm::dmat4& matrix) {
    if (matrix == glm::dmat4(1)) return;
    for (glm::vec3& p : groom.points)
        p = glm::vec3(matrix * glm::dvec4(p, 1));
    const auto scale = static_cast<float>(std::cbrt(std::abs(glm::determinant(glm::dmat3(matrix)))));
    for (float& width : groom.widths)
        width *= scale;
}

void merge(Groom& groom, Groom other, const Source& source) {
    if (groom.strands() == 0) {
        other.unitMm = groom.unitMm;
        other.zIsUp = groom.zIsUp;
        other.warnings.insert(other.warnings.begin(), groom.warnings.begin(), groom.warnings.end());
        groom = std::move(other);
        return;
    }
    if (groom.spline != other.spline || groom.pinned != other.pinned) {
        groom = evaluated(std::move(groom));
        other = evaluated(std::move(other));
    }
    std::vector<std::string> lost;
    const auto join = [&](auto& list, const auto& more, const char* what) {
        if (list.empty() != more.empty()) lost.emplace_back(what);
        if (list.empty() || more.empty())
            list.clear();
        else
            list.insert(list.end(), more.begin(), more.end());
    };
    const auto before = static_cast<std::uint32_t>(groom.points.size());
    groom.points.insert(groom.points.end(), other.points.begin(), other.points.end());
    for (std::size_t i = 1; i < other.first.size(); ++i)
        groom.first.push_back(before + other.first[i]);
    join(groom.widths, other.widths, "widths");
    join(groom.colors, other.colors, "colours");
    join(groom.rootUvs, other.rootUvs, "texture coordinates");
    join(groom.ids, other.ids, "ids");
    join(groom.guides, other.guides, "guides");
    join(groom.clumps, other.clumps, "clumps");
    std::ranges::move(other.warnings, std::back_inserter(groom.warnings));
    if (!lost.empty()) ignored(groom, source, fmt::format("some of its curves have {}, others not: none is read", fmt::join(lost, ", ")));
}

} // namespace groomfile

bool isGroom(const std::filesystem::path& path) {
    constexpr std::array<std::string_view, 4> kBeside = {".usd", ".usdc", ".usdz", ".tfxbone"};
    return formatOf(path) != nullptr || std::ranges::find(kBeside, toLower(path.extension().string())) != kBeside.end();
}

std::vector<std::string> groomEndings() {
    std::vector<std::string> endings;
    for (const GroomFormat& format : kGrooms)
        if (format.write) endings.emplace_back(format.extension);
    return endings;
}

Result<Groom> readGroom(const std::filesystem::path& path, const GroomOptions& options) {
    try {
        return read(path, options);
    } catch (const std::bad_alloc&) {
        return meshfile::outOfMemory(path);
    }
}

Result<std::vector<Diagnostic>> writeGroom(const std::filesystem::path& path, const Groom& groom, const GroomOptions& options) {
    const GroomFormat* format = formatOf(path);
    if (!format || !format->write) return unknown(path);
    const Holds& holds = format->holds;
    std::vector<std::string> lost;
    const auto lose = [&](bool held, bool there, const char* what) {
        if (!held && there) lost.emplace_back(what);
    };
    lose(holds.widths, !groom.widths.empty(), "widths");
    lose(holds.colors, !groom.colors.empty(), "colours");
    lose(holds.rootUvs, !groom.rootUvs.empty(), "texture coordinates of roots");
    lose(holds.numbers, !groom.ids.empty(), "ids");
    lose(holds.numbers, !groom.guides.empty(), "which strands are guides");
    lose(holds.numbers, !groom.clumps.empty(), "clumps");
    lose(holds.splines, groom.spline != Spline::Linear, "splines, which become chains of points");
    Groom written = holds.splines ? groom : evaluated(groom);
    const double unit = options.unitMm.value_or(holds.units ? groom.unitMm : format->unitMm);
    if (!(unit > 0 && std::isfinite(unit)))
        return usageError(5312, fmt::format("one unit of a groom cannot be {:g} mm", unit), "give a positive length in millimetres");
    written = inUnits(std::move(written), unit, options.zIsUp.value_or(holds.units && groom.zIsUp));
    const std::string bytes = format->write(written);
    if (bytes.empty()) return inputError(5310, {.file = path.string()}, "the groom is too large for this format", "write it as .abc");
    if (const auto wrote = writeFile(path, bytes); !wrote) return wrote.error();
    std::vector<Diagnostic> warnings;
    if (!lost.empty())
        warnings.push_back(inputWarning(5342, {.file = path.string()},
                                        fmt::format("{} does not hold {}", format->name, fmt::join(lost, ", ")),
                                        "an .abc or .usda file holds them"));
    return warnings;
}

} // namespace tegument
