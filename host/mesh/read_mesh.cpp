// readMesh: which reader, and what it leaves to be dropped.

#include "host/mesh/read_mesh.h"

#include "host/mesh/mesh_file.h"
#include "host/mesh/triangles.h"
#include "host/support/file.h"
#include "host/support/kept_inputs.h"
#include "host/support/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <ranges>

namespace tegument {

namespace {

using meshfile::Source;
using meshfile::withoutMark;
/// By its first bytes where those tell; the others are text or, like binary STL, may begin with anything, so their file names must help.
const MeshFormat* formatOf(const std::filesystem::path& path, std::string_view bytes) {
    for (const MeshFormat& format : meshFormats())
        for (const std::string_view start : format.starts)
            if (!start.empty() && bytes.starts_with(start)) return &format;
    const MeshFormat* named = meshFormatOf(path);
    return bytes.empty() || (named && !named->starts.front().empty()) ? nullptr : named;
}

template <class Formats>
std::string listed(Formats formats, std::string_view MeshFormat::*field) {
    return fmt::format("{}", fmt::join(formats | std::views::transform(field), ", "));
}

struct Stranger {
    std::string_view start; // in small letters
    std::string_view is;
    std::string_view hint;
};

/// What is often found under a mesh's name.
constexpr std::array<Stranger, 6> kStrangers = {
    {{"\x1f\x8b", "the file is compressed by gzip", "unpack it: gunzip FILE"},
     {"pk\x03\x04", "the file is a zip archive", "unpack it, and name the mesh that is in it"},
     {"version https://git-lfs", "the file is a pointer of Git LFS, not the mesh itself", "git lfs pull fetches the mesh"},
     {"<!doctype html", "the file is a web page, not a mesh", "download the file itself"},
     {"<html", "the file is a web page, not a mesh", "download the file itself"},
     {"kaydara fbx", "the file is FBX, which is not read", "convert it to glb, in Blender or elsewhere"}}};

const Stranger* strangerIn(std::string_view bytes) {
    const std::string start = toLower(bytes.substr(0, 32));
    const auto* found = std::ranges::find_if(kStrangers, [&](const Stranger& one) { return start.starts_with(one.start); });
    return found == kStrangers.end() ? nullptr : found;
}

Error unknownFormat(const std::filesystem::path& path, std::string_view bytes) {
    const MeshFormat* named = meshFormatOf(path);
    const std::span<const MeshFormat> formats = meshFormats();
    std::string text = bytes.empty() ? "the file is empty"
                                     : fmt::format("not a mesh in {} or {} form",
                                                   listed(formats.first(formats.size() - 1), &MeshFormat::name), formats.back().name);
    std::string hint = bytes.empty() ? "fetch or export it again" : "convert it to glb";
    if (!bytes.empty() && named && !named->starts.front().empty()) {
        text = fmt::format("the file is named {} but does not start like one", named->extension);
        hint = "fetch or export it again, or name it by what it is";
    }
    if (const Stranger* stranger = strangerIn(bytes)) {
        text = stranger->is;
        hint = stranger->hint;
    }
    return inputError(5300, {.file = path.string(), .byte = 0}, std::move(text), std::move(hint));
}

/// The vertices stay, at the origin: nothing refers to them any more.
void dropNotFinite(ReadMesh& file) {
    Mesh& mesh = file.mesh;
    if (std::ranges::all_of(mesh.positions, meshfile::isFinite)) return;
    file.counts.notFiniteFaces = keepTriangles(mesh, [&](std::span<const std::uint32_t, 3> corners, std::size_t) {
        return std::ranges::all_of(corners, [&](std::uint32_t index) { return meshfile::isFinite(mesh.positions[index]); });
    });
    for (glm::vec3& position : mesh.positions)
        if (!meshfile::isFinite(position)) position = glm::vec3(0);
}

/// Which vertices triangles use.
std::vector<bool> usedVertices(const Mesh& mesh) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (const std::uint32_t index : mesh.indices)
        used[index] = true;
    return used;
}

template <class Vector>
bool allFinite(const Vector& v) {
    for (glm::length_t i = 0; i < v.length(); ++i)
        if (!std::isfinite(v[i])) return false;
    return true;
}

/// Every stream besides positions leaves the readers here: finite, or as an error. Infinity and NaN become `instead`.
template <class Vector>
std::optional<Error> makeFinite(std::vector<Vector>& values, const Vector& instead, std::string_view what, const Source& source,
                                Mesh& mesh) {
    if (std::ranges::all_of(values, allFinite<Vector>)) return std::nullopt;
    const std::vector<bool> used = usedVertices(mesh);
    std::size_t mended = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (allFinite(values[i])) continue;
        values[i] = instead;
        mended += used[i];
    }
    if (mended == 0) return std::nullopt;
    if (!source.keepNotFinite) return meshfile::notFinite(source.whole(), fmt::format("{} of {} vertices are not finite", what, mended));
    meshfile::warn(mesh, 5335, source.whole(), fmt::format("{} of {} vertices are not finite: {:g} is taken", what, mended, instead[0]));
    return std::nullopt;
}

/// Normals and tangents are made anew where some are not finite; what is missing is found later.
std::optional<Error> makeStreamsFinite(Mesh& mesh, const Source& source) {
    if (auto error = makeFinite(mesh.uvs, glm::vec2(0), "texture coordinates", source, mesh)) return error;
    if (auto error = makeFinite(mesh.colors, glm::vec4(1), "colours", source, mesh)) return error;
    if (!std::ranges::all_of(mesh.tangents, allFinite<glm::vec4>)) mesh.tangents.clear();
    if (std::ranges::all_of(mesh.normals, allFinite<glm::vec3>)) return std::nullopt;
    meshfile::warn(mesh, 5324, source.whole(), "some normals of the file are not finite: all are made anew");
    mesh.normals.clear();
    mesh.tangents.clear();
    return std::nullopt;
}

/// Old Macintosh programs end lines with a carriage return alone: a text that knows no other becomes one of lines. Of a binary PLY only the
/// header is text.
void mendLines(std::string& bytes, const MeshFormat& format) {
    if (bytes.find('\r') == std::string::npos) return;
    const bool ply = format.extension == ".ply";
    if (format.extension == ".stl" && !toLower(trim(std::string_view(bytes).substr(0, 80))).starts_with("solid")) return;
    std::size_t end = bytes.size();
    if (ply && bytes.substr(0, bytes.find("end_header")).find("ascii") == std::string::npos)
        end = std::min(bytes.find("end_header"), bytes.size() - 11) + 11; // the word and what ends its line
    const std::string_view text = std::string_view(bytes).substr(0, end);
    if (text.find('\n') != std::string_view::npos || text.find('\0') != std::string_view::npos) return;
    std::replace(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(end), '\r', '\n');
}

/// Where the size is implausible, the same file with a likely unit, and a warning. What was read in another unit than millimetres is read
/// again, so that each number is rounded once.
std::optional<Diagnostic> takeLikelyUnit(const MeshFormat& format, Source& source, Result<ReadMesh>& file) {
    const Bounds size = meshfile::sizeOf(*file);
    const std::optional<double> likely = likelyUnit(size, source.unitMm);
    if (!likely) return std::nullopt;
    Diagnostic warning = guessedUnit(source.path, size, source.unitMm, *likely);
    const bool inMillimetres = source.unitMm == 1;
    source.unitMm = *likely;
    if (inMillimetres)
        meshfile::changeUnit(*file, *likely);
    else
        file = format.read(source);
    return warning;
}

Result<ReadMesh> read(const std::filesystem::path& path, const ReadOptions& options) {
    Result<std::string> bytes = readFile(path);
    if (!bytes) return bytes.error();
    bytes->erase(0, bytes->size() - withoutMark(*bytes).size());
    const MeshFormat* format = formatOf(path, *bytes);
    if (!format || strangerIn(*bytes)) return unknownFormat(path, *bytes);
    const double unit = options.unitMm.value_or(format->unitMm);
    if (!(unit > 0 && std::isfinite(unit)))
        return usageError(5312, fmt::format("one unit of a mesh cannot be {:g} mm", unit), "give a positive length in millimetres");
    mendLines(*bytes, *format);
    Source source{.path = path,
                  .bytes = *bytes,
                  .unitMm = unit,
                  .dropBadFaces = options.dropBadFaces,
                  .keepNotFinite = options.dropNotFinite,
                  .carryMaterials = options.carryMaterials,
                  .ownCoordinates = options.ownCoordinates,
                  .roots = rootsOf(path, {}, options.roots)};
    Result<ReadMesh> file = format->read(source);
    if (!file) return file;
    if (const auto kept = inputsAreKept(); !kept) return kept.error();
    std::optional<Diagnostic> guessed;
    if (options.guessUnit && !options.unitMm) guessed = takeLikelyUnit(*format, source, file);
    if (!file) return file;
    meshfile::settlePlace(path, *file);
    file->mesh.unitMm = source.unitMm;
    if (guessed) file->mesh.warnings.push_back(std::move(*guessed));
    if (file->mesh.name.empty()) file->mesh.name = path.stem().string();
    if (options.dropNotFinite) dropNotFinite(*file);
    if (auto error = makeStreamsFinite(file->mesh, source)) return *error;
    return file;
}

} // namespace

std::span<const MeshFormat> meshFormats() {
    return meshfile::kFormats;
}

const MeshFormat* meshFormatOf(const std::filesystem::path& path) {
    const std::string ending = toLower(path.extension().string());
    const auto* found = std::ranges::find(meshfile::kFormats, ending, &MeshFormat::extension);
    return found == meshfile::kFormats.end() ? nullptr : found;
}

std::string meshEndings() {
    return listed(meshFormats(), &MeshFormat::extension);
}

std::string meshUps() {
    return fmt::format("z of {} files, else y", listed(meshFormats() | std::views::filter(&MeshFormat::zIsUp), &MeshFormat::name));
}

Result<ReadMesh> readMesh(const std::filesystem::path& path, const ReadOptions& options) {
    try {
        return read(path, options);
    } catch (const std::bad_alloc&) {
        return meshfile::outOfMemory(path);
    }
}

} // namespace tegument
