#pragma once
// Which files another file may name: what a stranger's effect includes must not be any file of the machine.

#include "host/support/result.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tegument {

/// Folders, with all that lies below them. Symbolic links are followed first: what counts is where a file is, not how it is written.
struct Roots {
    std::vector<std::filesystem::path> folders;
    bool anywhere = false; // every file of the machine

    /// Whether the file lies below one of the folders.
    [[nodiscard]] bool hold(const std::filesystem::path& file) const;
};

/// What `file` may name, besides `more` and the folders that the user names: its own folder (where a link to it stands, and where it is
/// itself), the project around it (the nearest folder above that holds .tegument-root; without one .git, .hg or .svn; never the home
/// folder), and this library where it is part of it (the nearest folder above that holds hlsl/platform.fxh).
[[nodiscard]] Roots rootsOf(const std::filesystem::path& file, const std::vector<std::filesystem::path>& named, const Roots& more = {});

/// What an effect may name. Where there is neither a project nor `more`: also what lies below the common parent of the files that it and
/// its includes name relatively and that are there, as in an unpacked archive, and below the working directory if the effect lies there;
/// never the home folder, one of all users, or what only a symbolic link reaches.
[[nodiscard]] Roots rootsOfEffect(const std::filesystem::path& file, const std::vector<std::filesystem::path>& named,
                                  const Roots& more = {});

/// The folder, to be named by -I, in which an include of this name would be found: within the roots, then in up to three folders above the
/// effect. Looks at a bounded number of files.
[[nodiscard]] std::optional<std::filesystem::path> folderOfInclude(const std::string& name, const std::filesystem::path& effect,
                                                                   const Roots& roots);

/// TG1014, with a hint that says how it may be read all the same.
[[nodiscard]] Diagnostic outsideOf(const std::filesystem::path& file, SourcePosition at);
/// The same of a file that the mesh file at that place names: most commands that read meshes know no -I, but all know projects.
[[nodiscard]] Diagnostic outsideOfMesh(const std::filesystem::path& file, const std::filesystem::path& mesh);

} // namespace tegument
