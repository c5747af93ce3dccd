#pragma once
// Files that are dropped on the window of `tegument view`.

#include "tools/cli/job_options.h"

namespace tegument::app {

enum class Dropped { Effect, Mesh, Workspace, Texture };

/// By the file's ending. TG8045 something else.
[[nodiscard]] Result<Dropped> kindOf(const std::filesystem::path& file);

/// The options with the file in the place of what was there: a mesh is framed, a workspace brings its own mesh, an effect keeps the scene
/// that was named but no --set of the other one. A texture goes to the parameter whose name or semantic stands in the file's name, else to
/// the colour map. TG8045 no parameter takes it.
[[nodiscard]] Result<JobOptions> withDropped(JobOptions options, const std::filesystem::path& file, const Effect& shown);

} // namespace tegument::app
