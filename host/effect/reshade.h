#pragma once
// ReShade FX, the language of post-processing effects, rewritten as effect syntax of this host: the same tokens at the same places.

#include "host/effect/preprocess.h"

#include <string_view>
#include <utility>
#include <vector>

namespace tegument {

/// Draws the picture that such an effect works on, and nothing else.
inline constexpr const char* kPictureTechnique = "<picture>";

/// Definitions by which a caller says what that picture is; docs/your-effect.md.
inline constexpr const char* kPictureIn = "TEGUMENT_PICTURE_IN"; // the texture tgPictureIn; otherwise a scene of this host's own
inline constexpr const char* kDepthIn = "TEGUMENT_DEPTH_IN";     // the texture tgDepthIn
inline constexpr const char* kMeshIn = "TEGUMENT_MESH_IN";       // the mesh is drawn over both

/// What ReShade defines before it reads a file, where nobody has defined it.
void defineReshade(std::vector<std::pair<std::string, std::string>>& defines);

/// Whether a pass names a function of the file as its vertex or compute shader, as no other dialect does.
[[nodiscard]] bool isReshade(const std::vector<Token>& tokens);

/// Rewrites the tokens; warnings say which pictures are missing. `effect` is the file, for what lies beside it. An error: TG1102 for a
/// bracket without its other half, TG1101 for what is no declaration, TG2003 for what cannot be drawn.
[[nodiscard]] Result<void> rewriteReshade(const std::filesystem::path& effect, const PreprocessOptions& options, Preprocessed& view,
                                          Sources& sources);

} // namespace tegument
