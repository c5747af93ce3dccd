#pragma once
// Effects, workspaces and other files as the command line names them. What does not exist is the command line's fault, and the nearest name
// is said.

#include "host/effect/model.h"
#include "host/support/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tegument::assets {

/// Where effects, hlsl and workspaces lie for a program that is not ours but has our library in it, such as Python: looked at first.
void setOwnFolder(std::filesystem::path folder);

/// Where a file of ours lies: as named, or below share/tegument beside the installed program, or in the tree that it was built from.
[[nodiscard]] std::filesystem::path ownFile(const std::filesystem::path& named);

/// `Main`, `Main.fx`, `effects/Main.fx`, `Separable`: an effect as named, or one of ours, from any folder. TG8006 it does not exist, or is
/// a mesh, a picture or anything else that is no text.
[[nodiscard]] Result<std::filesystem::path> findEffect(const std::string& named);

/// `bunny`, `bunny.json`: a workspace as named, or of the folder `workspaces` beside the effect, or one of ours. TG8007.
[[nodiscard]] Result<std::filesystem::path> findWorkspace(const std::string& named, const std::filesystem::path& effect);

/// Our own, and those in the current folder's `effects/` and `effects/workspaces/` where it has them: each name once, in the order in
/// which names are found.
[[nodiscard]] std::vector<std::filesystem::path> knownEffects();
[[nodiscard]] std::vector<std::filesystem::path> knownWorkspaces();

/// TG8008 when no such file exists; `what` says what it was named for. The nearest name is one of the files beside it, or of `others`.
[[nodiscard]] Result<void> fileExists(const std::string& named, const std::string& what, const std::vector<std::string>& others = {});

/// TG8009 when the effect has no such technique; an empty name is its default one.
[[nodiscard]] Result<void> techniqueExists(const Effect& effect, const std::string& named);

/// The effects that share workspaces with this one: of its folder and the folder `peers` below it; of a peer also those above.
[[nodiscard]] std::vector<std::filesystem::path> effectsBeside(const std::filesystem::path& effect);

} // namespace tegument::assets
