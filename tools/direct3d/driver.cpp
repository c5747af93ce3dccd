#include "tools/direct3d/driver.h"

#include "host/support/file.h"
#include "host/support/system.h"
#include "tools/direct3d/microsoft.h"
#include "tools/direct3d/microsoft_messages.h"
#include "tools/direct3d/wine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace tegument {

namespace fs = std::filesystem;

namespace {

/// Beside the program, where it was installed, where it was built.
fs::path driver() {
    std::error_code code;
    const fs::path here = programFile().parent_path();
    const fs::path built(TEGUMENT_HLSLC); // below the build's folder
    const auto build = folderAboveProgramWith(built);
    for (const fs::path& candidate : {here / "hlslc.exe", here / "../lib/tegument/hlslc.exe", build ? *build / built : fs::path()})
        if (!candidate.empty() && fs::is_regular_file(candidate, code)) return candidate;
    return {};
}

} // namespace

std::string driverMissing() {
    if (std::string missing = wineMissing(); !missing.empty()) return missing;
    if (driver().empty())
        return "hlslc.exe was not built: g++-mingw-w64-x86-64 was not installed (./bootstrap test installs it and builds again)";
    return {};
}

/// Wine looks for a "native" library beside the program.
// NOLINTNEXTLINE(performance-unnecessary-value-param): windows/driver.cpp takes them over
Result<ProcessCommand> driverProcess(const fs::path& folder, std::vector<std::string> arguments) {
    std::error_code code;
    fs::create_symlink(fs::absolute(driver(), code), folder / "hlslc.exe", code);
    if (!code) fs::create_symlink(microsoftCompilerLibrary(), folder / "d3dcompiler_47.dll", code);
    if (code) return machineError(3104, fmt::format("cannot link the compiler into {}: {}", folder.string(), code.message()));
    return wineProcess(folder / "hlslc.exe", arguments);
}

UsualCompiler usualCompiler() {
    return {cacheFolder() / "tools/microsoft/d3dcompiler_47.dll", "./bootstrap test fetches it"};
}

fs::path unixPath(std::string_view written) {
    std::string path(written);
    std::ranges::replace(path, '\\', '/');
    const bool drive = path.size() > 2 && std::isalpha(static_cast<unsigned char>(path[0])) != 0 && path[1] == ':';
    return fs::path(drive ? path.substr(2) : path).lexically_normal();
}

std::string windowsPath(const fs::path& absolute) {
    std::string path = "Z:" + absolute.lexically_normal().string();
    std::ranges::replace(path, '/', '\\');
    return path;
}

} // namespace tegument
