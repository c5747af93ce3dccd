#pragma once
// Which of the host's values a foreign parameter wants: by DXSAS annotation, semantic, RenderMonkey's and MME's conventions, or its name.

#include "host/adopt/adopt.h"
#include "host/effect/model.h"

#include <optional>
#include <string>
#include <string_view>

namespace tegument::adopt {

/// "WORLDINVERSETRANSPOSE" of its many spellings: gWorldIT, inv_world_transpose, ModelViewProj ... nullopt: no matrix of the host.
[[nodiscard]] std::optional<std::string> matrixName(std::string_view text);

/// Gives the parameter a semantic that host/run binds, or a value where its author gave none; says what and why. `negated`: somewhere in
/// the code a '-' stands before its name, which tells a direction that light goes from one that it comes from.
[[nodiscard]] ParameterBinding bindParameter(Parameter& parameter, const AdoptOptions& options, bool negated);

/// A texture's stand-in where nothing names a file: "checker", "white", "grey", "normal", "ramp", "noise", of cubes "sky" or "normals"
/// (annotation Procedure).
[[nodiscard]] std::string textureStandIn(const Parameter& parameter);

} // namespace tegument::adopt
