#pragma once
// The program that calls Microsoft's compiler: hlslc.exe in Wine; on Windows this program itself, called with kDriverWord first.

#include "tools/process/process.h"

namespace tegument {

inline constexpr const char* kDriverWord = "--hlslc";

/// What it needs and this machine lacks, the compiler itself apart; empty when nothing.
[[nodiscard]] std::string driverMissing();

/// How to start it (microsoft/hlslc.cpp says with which arguments). What belongs beside it is put into the folder.
[[nodiscard]] Result<ProcessCommand> driverProcess(const std::filesystem::path& folder, std::vector<std::string> arguments);

/// Where the compiler is unless TEGUMENT_D3DCOMPILER says otherwise, and what brings it there.
struct UsualCompiler {
    std::filesystem::path file;
    const char* hint;
};
[[nodiscard]] UsualCompiler usualCompiler();

} // namespace tegument
