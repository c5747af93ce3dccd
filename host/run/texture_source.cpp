#include "host/run/texture_source.h"

#include "host/support/file.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <optional>
#include <span>
#include <string_view>

namespace tegument::run {

namespace fs = std::filesystem;

namespace {

const std::string* byNameOrSemantic(const std::map<std::string, std::string>& files, const Parameter& parameter) {
    if (const auto found = files.find(parameter.name); found != files.end()) return &found->second;
    if (parameter.semantic.empty()) return nullptr;
    const auto found = std::ranges::find_if(files, [&](const auto& entry) { return equalsIgnoreCase(entry.first, parameter.semantic); });
    return found == files.end() ? nullptr : &found->second;
}

/// Semantics name what mesh files call roles: two of DXSAS, and any other by the role itself, ignoring case.
std::string_view roleOf(const Parameter& parameter) {
    if (equalsIgnoreCase(parameter.semantic, "DIFFUSE")) return "color";
    if (equalsIgnoreCase(parameter.semantic, "NORMAL")) return "normal";
    return parameter.semantic;
}

const EmbeddedTexture* embedded(const Parameter& parameter, const Mesh* mesh) {
    const std::string_view role = roleOf(parameter);
    if (!mesh || role.empty()) return nullptr;
    const auto found = std::ranges::find_if(mesh->textures, [&](const auto& texture) { return equalsIgnoreCase(texture.role, role); });
    return found == mesh->textures.end() ? nullptr : &*found;
}

/// ResourceName is a suggestion: effects name files that their authors had.
std::optional<fs::path> resource(const Parameter& parameter, const Effect& effect) {
    const auto name = parameter.annotations.string("ResourceName");
    if (!name || name->empty()) return std::nullopt;
    return findInAnyCase(effect.file.parent_path(), *name);
}

/// What the effect itself names, as opposed to who draws it.
Result<TextureSource> within(const Parameter& parameter, const Effect& effect, const fs::path& file, TextureSource source) {
    if (effect.roots.hold(file)) return source;
    return namedBy("the effect", parameter, {Blame::Input, {outsideOf(file.lexically_normal(), parameter.at)}});
}

Result<TextureSource> producer(const Parameter& parameter, const Effect& effect) {
    const Annotation* annotation = parameter.annotations.find("Producer");
    const std::string text = parameter.annotations.string("Producer").value_or("");
    const std::size_t slash = text.rfind('/');
    if (slash == std::string::npos || slash == 0 || slash + 1 == text.size())
        return inputError(4033, annotation->at, fmt::format("Producer \"{}\" of {} names no target", text, parameter.name),
                          "write \"Stretch.fx/gStretchMap\"");
    const fs::path file = effect.file.parent_path() / text.substr(0, slash);
    return within(parameter, effect, file, ProducerSource{file, text.substr(slash + 1)});
}

TextureSource fallback(const Parameter& parameter) {
    const auto numbers = parameter.annotations.numbers("Fallback");
    assert(numbers && numbers->size() == 4); // host/effect has checked the annotation
    ConstantSource constant{};
    for (std::size_t i = 0; i < constant.size(); ++i)
        constant[i] = static_cast<float>((*numbers)[i]);
    return constant;
}

Error notFound(const Parameter& parameter, const Mesh* mesh) {
    std::string looked = "--set, the workspace";
    if (const std::string_view role = roleOf(parameter); mesh && !role.empty()) looked += fmt::format(", the mesh's {} texture", role);
    if (const auto name = parameter.annotations.string("ResourceName"); name && !name->empty())
        looked += fmt::format(", the file {}", *name);
    if (parameter.annotations.find("Function")) looked += " (this host fills textures of two dimensions by a Function)";
    return inputError(4030, parameter.at, fmt::format("no texture for {}: looked in {}", parameter.name, looked),
                      fmt::format("give a file: --set {}=FILE", parameter.name));
}

Result<LoadedFile> load(const fs::path& path) {
    const auto bytes = readFile(path);
    if (!bytes) return bytes.error();
    const auto view = std::as_bytes(std::span(*bytes));
    LoadedFile file;
    if (isDds(view)) {
        auto texture = decodeDds(view, path.string());
        if (!texture) return texture.error();
        file.texture = std::move(*texture);
        return file;
    }
    auto picture = decodeImage(view, path.string());
    if (!picture) return picture.error();
    file.picture = std::move(*picture);
    return file;
}

} // namespace

Result<TextureSource> findTexture(const Parameter& parameter, const Effect& effect, const RunOptions& options, const Workspace& workspace,
                                  const Mesh* mesh) {
    if (const std::string* file = byNameOrSemantic(options.textures, parameter)) return TextureSource(FileSource{*file, "--set"});
    if (const std::string* file = byNameOrSemantic(workspace.textures, parameter))
        return TextureSource(FileSource{workspace.file.parent_path() / *file, fmt::format("the workspace {}", workspace.file.string())});
    if (const EmbeddedTexture* texture = embedded(parameter, mesh)) return TextureSource(texture);
    if (const auto path = resource(parameter, effect)) return within(parameter, effect, *path, FileSource{*path, kResourceName});
    if (parameter.annotations.find("Producer")) return producer(parameter, effect);
    if (const auto generator = parameter.annotations.string("Generator"); generator && mesh && options.assets.make)
        return TextureSource(GeneratorSource{*generator});
    if (parameter.annotations.find("Fallback")) return fallback(parameter);
    if (auto name = parameter.annotations.string("Procedure")) return TextureSource(ProcedureSource{std::move(*name)});
    return notFound(parameter, mesh);
}

Error namedBy(const std::string& who, const Parameter& parameter, Error error) {
    error.diagnostics.push_back({.severity = Severity::Note,
                                 .code = 4031,
                                 .at = parameter.at,
                                 .text = fmt::format("it is the texture of {}, named by {}", parameter.name, who)});
    return error;
}

Result<LoadedFile> loadNamed(const Parameter& parameter, const FileSource& source) {
    auto file = load(source.path);
    if (!file) return namedBy(source.namedBy, parameter, file.error());
    const bool cube = file->texture.isCube();
    if (cube == (parameter.type.base == BaseType::TextureCube)) return file;
    const char* what = cube ? "the file is a cube map" : "the file is no cube map";
    return namedBy(source.namedBy, parameter,
                   inputError(4038, {.file = source.path.string()},
                              fmt::format("{} is a {}; {}", parameter.name, parameter.type.name, what),
                              cube ? "give a picture" : "give a DDS file with six faces"));
}

} // namespace tegument::run
