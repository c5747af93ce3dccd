#pragma once
// Microsoft's compiler and the Direct3D clients, run in Wine over all cases.

#include "tests/d3d/cases.h"
#include "tools/process/process.h"

#include <string>
#include <vector>

namespace tegument::test {

/// Runs a Windows program with all that Direct3D 12 wants of this machine: tests/d3d/layer/layer.cpp says what. Others ask for none of it.
[[nodiscard]] Result<ProcessResult> runInWine12(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                                                double seconds);

/// Makes what the cases' job files name: fx_2_0, fx_4_0, and every entry point alone. One message for each file that was refused.
[[nodiscard]] Result<std::vector<std::string>> compileAll(const std::vector<Case>& cases);

/// Writes each effect as `check --emit` does, for Direct3D 12.
[[nodiscard]] Result<void> emitAll(const std::vector<Case>& cases);

/// Runs one client over the job files, in one process as long as it lives, and writes the cases' status files.
[[nodiscard]] Result<void> drawAll(Engine engine, const std::vector<Case>& cases, const std::vector<std::string>& jobFiles);

} // namespace tegument::test
