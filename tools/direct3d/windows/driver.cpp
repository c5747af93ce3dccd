#include "tools/direct3d/driver.h"

#include "host/support/system.h"
#include "tools/direct3d/microsoft.h"
#include "tools/direct3d/microsoft_messages.h"
#include "tools/direct3d/windows/own_driver.h"

#include <cstdlib>
#include <string>
#include <system_error>

#include <windows.h>

#include <shellapi.h>

int hlslcMain(int count, wchar_t** arguments); // microsoft/hlslc.cpp's wmain

namespace tegument {

namespace fs = std::filesystem;

std::string driverMissing() {
    return {};
}

Result<ProcessCommand> driverProcess(const fs::path&, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {programFile().string(), kDriverWord});
    return ProcessCommand{.arguments = std::move(arguments),
                          // In Wine: Microsoft's compiler instead of Wine's own. Windows does not know the variable.
                          .environment = {{"WINEDLLOVERRIDES", "d3dcompiler_47=n"}}};
}

/// Beside the program, else Windows' own (Wine's answers to the same name, and compiles no effects).
UsualCompiler usualCompiler() {
    constexpr const char* kName = "d3dcompiler_47.dll";
    const fs::path beside = programFile().parent_path() / kName;
    std::error_code code;
    wchar_t system[MAX_PATH] = {};
    if (!fs::is_regular_file(beside, code) && ::GetSystemDirectoryW(system, MAX_PATH) > 0)
        return {fs::path(system) / kName, "it comes with Windows"};
    return {beside, "put it beside tegument.exe"};
}

fs::path unixPath(std::string_view written) {
    return fs::path(written).lexically_normal();
}

std::string windowsPath(const fs::path& absolute) {
    return absolute.lexically_normal().make_preferred().string();
}

void driveWhereAsked() {
    int count = 0;
    wchar_t** arguments = ::CommandLineToArgvW(::GetCommandLineW(), &count);
    const std::string word(kDriverWord);
    if (arguments == nullptr || count < 2 || std::wstring(word.begin(), word.end()) != arguments[1]) return;
    ::LoadLibraryW(microsoftCompilerLibrary().c_str()); // whoever asks for its name later gets this one
    std::_Exit(hlslcMain(count - 1, arguments + 1));
}

} // namespace tegument
