#pragma once
// DXC's own output, DXIL, which the host has no use for.

#include <filesystem>
#include <string>

namespace tegument::test {

/// Compiles entry point `main` of `source` for `profile`. Empty when it compiles; else the compiler's messages, or why it cannot be asked.
/// Not signed, and not validated: that takes a library of Microsoft's which is not on every machine.
[[nodiscard]] std::string compileDxil(const std::filesystem::path& source, const std::string& profile);

/// Empty when DXC is there.
[[nodiscard]] std::string dxilMissing();

} // namespace tegument::test
