// The messages that all mesh readers share.

#include "host/mesh/mesh_file.h"

#include "host/image/image.h"
#include "host/support/file.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

namespace tegument::meshfile {

Result<std::string> readNamed(const Source& source, const std::filesystem::path& file) {
    std::error_code code;
    if (std::filesystem::exists(file, code) && !source.roots.hold(file)) return Error{Blame::Input, {outsideOfMesh(file, source.path)}};
    return readFile(file);
}

std::string hintFor(const Error& error, const char* otherwise) {
    const Diagnostic& why = error.diagnostics.front();
    return why.code == kOutside ? why.hint : otherwise;
}

Error truncated(SourcePosition at, const std::string& text) {
    return inputError(5301, std::move(at), "the mesh file ends early: " + text, "fetch or export the file again");
}

Error malformed(SourcePosition at, const std::string& text, std::string hint) {
    return inputError(5302, std::move(at), text, std::move(hint));
}

Error notANumber(SourcePosition at, std::string_view word) {
    return malformed(std::move(at), fmt::format("'{}' is not a number", word.substr(0, 40)),
                     word.find(',') != std::string_view::npos ? "write numbers with a decimal point, not a comma"
                                                              : "export the mesh again");
}

Error overclaimed(SourcePosition at, const std::string& text) {
    return inputError(5303, std::move(at), text, "the file is cut off or damaged: fetch or export it again");
}

Error badIndex(SourcePosition at, const std::string& text) {
    return inputError(5304, std::move(at), text, "export the mesh again");
}

Error notFinite(SourcePosition at, const std::string& text) {
    return inputError(5305, std::move(at), text, "tegument prep MESH -o NEW.glb leaves such faces out");
}

Error noTriangles(SourcePosition at) {
    return inputError(5306, std::move(at), "the mesh has no triangles", "points, lines and empty faces cannot be drawn");
}

Error unsupported(SourcePosition at, const std::string& text, std::string hint) {
    return inputError(5307, std::move(at), text, std::move(hint));
}

Error tooLarge(SourcePosition at) {
    return inputError(5310, std::move(at), fmt::format("the mesh has more than {} vertices or {} indices", kMaxVertices, kMaxIndices),
                      "reduce it before use");
}

Error outOfMemory(const std::filesystem::path& path) {
    return machineError(5311, fmt::format("{}: not enough memory for the mesh", path.string()), "reduce it, or give a larger --max-memory");
}

glm::vec4 linearColor(const glm::dvec4& encoded) {
    const auto linear = [](double v) { return srgbToLinear(static_cast<float>(std::clamp(v, 0.0, 1.0))); };
    return {linear(encoded.r), linear(encoded.g), linear(encoded.b), static_cast<float>(std::clamp(encoded.a, 0.0, 1.0))};
}

namespace {

/// As older C libraries of Windows print what is no number: "1.#QNAN", "-1.#IND00", "1.#INF".
std::optional<double> namedNumber(std::string_view word) {
    const double sign = word.starts_with('-') ? -1 : 1;
    if (word.starts_with('-')) word.remove_prefix(1);
    if (!word.starts_with("1.#")) return std::nullopt;
    word.remove_prefix(3);
    if (word.starts_with("INF")) return sign * INFINITY;
    const bool none = word.starts_with("IND") || word.starts_with("QNAN") || word.starts_with("SNAN");
    return none ? std::optional<double>(NAN) : std::nullopt;
}

} // namespace

bool parseReal(std::string_view word, double& value) {
    if (word.starts_with('+')) word.remove_prefix(1);
    if (const auto named = namedNumber(word)) {
        value = *named;
        return true;
    }
    const auto parsed = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || parsed.ptr != word.data() + word.size()) return false;
    if (parsed.ec == std::errc::result_out_of_range) value = std::strtod(std::string(word).c_str(), nullptr); // infinity or next to 0
    return parsed.ec != std::errc::invalid_argument;
}

std::string_view withoutMark(std::string_view text) {
    return text.substr(text.starts_with("\xef\xbb\xbf") ? 3 : 0);
}

std::string_view withoutComment(std::string_view line) {
    std::size_t mark = line.find('#');
    while (mark != std::string_view::npos && mark > 0 && line[mark - 1] == '.') // of "1.#IND"
        mark = line.find('#', mark + 1);
    return line.substr(0, mark);
}

std::string_view nextWord(std::string_view& line) {
    line = trim(line);
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    const std::string_view word = line.substr(0, end);
    line.remove_prefix(end);
    return word;
}

void warn(Mesh& mesh, int code, SourcePosition at, std::string text, std::string hint) {
    mesh.warnings.push_back(inputWarning(code, std::move(at), std::move(text), std::move(hint)));
}

void copyVertex(Mesh& mesh, std::uint32_t vertex) {
    const auto copy = [&](auto& list) {
        if (!list.empty()) list.push_back(typename std::decay_t<decltype(list)>::value_type(list[vertex]));
    };
    copy(mesh.positions);
    copy(mesh.normals);
    copy(mesh.tangents);
    copy(mesh.uvs);
    copy(mesh.colors);
    copy(mesh.motionVertices);
    for (MeshAttribute& attribute : mesh.attributes)
        for (std::size_t c = 0; c < attribute.components; ++c)
            attribute.values.push_back(double{attribute.values[vertex * attribute.components + c]});
}

} // namespace tegument::meshfile
