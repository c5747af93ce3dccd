#pragma once
// Where the texture of a parameter comes from, in the order of docs/running.md: --set, workspace, mesh, ResourceName, Producer, Generator,
// Fallback, Procedure.

#include "host/effect/model.h"
#include "host/image/dds.h"
#include "host/mesh/mesh.h"
#include "host/run/run_options.h"
#include "host/scene/workspace.h"

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <variant>

namespace tegument::run {

inline constexpr const char* kResourceName = "ResourceName"; // an annotation, and who names such a file

struct FileSource {
    std::filesystem::path path;
    std::string namedBy; // "--set", "workspace file.json", kResourceName
};
/// Another effect renders it.
struct ProducerSource {
    std::filesystem::path effect;
    std::string target;
};
/// It is made from the mesh.
struct GeneratorSource {
    std::string generator;
};
using ConstantSource = std::array<float, 4>;
/// A plain picture of that name, for textures whose files are not there: annotation Procedure (host/run/procedures.h).
struct ProcedureSource {
    std::string name;
};
using TextureSource = std::variant<FileSource, const EmbeddedTexture*, ProducerSource, GeneratorSource, ConstantSource, ProcedureSource>;

/// TG1014 the effect names a file outside of its roots; TG4030 nothing gives it a texture; TG4033 the Producer annotation is not
/// "File.fx/target".
[[nodiscard]] Result<TextureSource> findTexture(const Parameter& parameter, const Effect& effect, const RunOptions& options,
                                                const Workspace& workspace, const Mesh* mesh);

/// The error with a note that says whose texture it is and who named the file: TG4031.
[[nodiscard]] Error namedBy(const std::string& who, const Parameter& parameter, Error error);

/// A DDS file with all its faces and levels, any other as one face with one level. Named files must exist: what cannot be read is an error
/// with a note that names the parameter (TG4031). TG4038 a cube map for a Texture2D or a picture for a TextureCube.
struct LoadedFile {
    DdsTexture texture;
    Image picture; // when it was no DDS file; `texture` then has no images
};
[[nodiscard]] Result<LoadedFile> loadNamed(const Parameter& parameter, const FileSource& source);

} // namespace tegument::run
