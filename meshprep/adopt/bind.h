#pragma once
// Which of the host's values a foreign parameter wants: by DXSAS annotation, semantic, RenderMonkey's and MME's conventions, or its name.

#include "host/effect/model.h"
#include "meshprep/adopt/adopt.h"

#include <optional>
#include <string>
#include <string_view>

namespace tegument::adopt {

/// "WORLDINVERSETRANSPOSE" of its many spellings: gWorldIT, inv_world_transpose, ModelViewProj ... nullopt: no matrix of the host.
[[nodiscard]] std::optional<std::string> matrixName(std::string_view text);

/// Gives the parameter a semantic that host/run binds, or a value where its author gave none; says what and why. `sign`: of a direction,
/// above zero where the code takes it as the way to the light, below where it turns it round, zero where it does not tell.
[[nodiscard]] ParameterBinding bindParameter(Parameter& parameter, const AdoptOptions& options, int sign);
/// Whether the name or the semantic is that of a size of the target, or of its inverse.
[[nodiscard]] bool isTargetSize(std::string_view name, std::string_view semantic);

/// A texture's stand-in where nothing names a file: "checker", "white", "grey", "normal", "ramp", "noise", of cubes "sky" or "normals"
/// (annotation Procedure).
[[nodiscard]] std::string textureStandIn(const Parameter& parameter);

} // namespace tegument::adopt
