#pragma once
// A workspace as a file that reads back as it is.

#include "host/scene/workspace.h"

namespace tegument {

/// JSON for a file at `path`: loadWorkspace() of it gives the same scene. Files are named from there, or from ${TEGUMENT_CACHE}.
[[nodiscard]] std::string workspaceJson(const Workspace& workspace, const std::filesystem::path& path);

/// Values and textures as --set gives them become the workspace's own, and win over those of its objects as they did before. Textures are
/// relative to the current folder.
void settle(Workspace& workspace, const std::map<std::string, std::vector<double>>& parameters,
            const std::map<std::string, std::string>& textures);

} // namespace tegument
