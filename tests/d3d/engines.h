#pragma once
// Microsoft's compiler and the Direct3D clients, run in Wine over all cases.

#include "tests/d3d/cases.h"

#include <string>
#include <vector>

namespace tegument::test {

/// Empty when the clients can run; otherwise what is missing.
[[nodiscard]] std::string clientsMissing();

/// The client with Microsoft's compiler beside it, linked into the folder: Wine takes a native library from there, and d3dx9_43 wants one.
[[nodiscard]] Result<std::filesystem::path> clientIn(const std::filesystem::path& folder);

/// Makes what the cases' job files name: fx_2_0, fx_4_0, and every entry point alone. One message for each file that was refused.
[[nodiscard]] Result<std::vector<std::string>> compileAll(const std::vector<Case>& cases);

/// Runs one client over the job files, in one process as long as it lives, and writes the cases' status files.
[[nodiscard]] Result<void> drawAll(Engine engine, const std::vector<Case>& cases, const std::vector<std::string>& jobFiles);

} // namespace tegument::test
