#include "host/support/system.h"

#include "host/support/file.h"
#include "host/support/windows/wide.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <thread>

#include <io.h>
#include <windows.h>

namespace tegument {

namespace fs = std::filesystem;

namespace {

fs::path folderIn(const wchar_t* variable) {
    const wchar_t* value = ::_wgetenv(variable);
    return value == nullptr ? fs::path() : fs::path(value);
}

bool fits(std::string_view pattern, std::string_view name) {
    if (pattern.empty()) return name.empty();
    if (pattern[0] == '*') return fits(pattern.substr(1), name) || (!name.empty() && fits(pattern, name.substr(1)));
    return !name.empty() && (pattern[0] == '?' || pattern[0] == name[0]) && fits(pattern.substr(1), name.substr(1));
}

} // namespace

std::wstring wideOf(std::string_view text) {
    const int length = static_cast<int>(text.size());
    std::wstring result(static_cast<std::size_t>(::MultiByteToWideChar(CP_UTF8, 0, text.data(), length, nullptr, 0)), L'\0');
    ::MultiByteToWideChar(CP_UTF8, 0, text.data(), length, result.data(), static_cast<int>(result.size()));
    return result;
}

std::string narrowOf(std::wstring_view text) {
    const int length = static_cast<int>(text.size());
    std::string result(static_cast<std::size_t>(::WideCharToMultiByte(CP_UTF8, 0, text.data(), length, nullptr, 0, nullptr, nullptr)),
                       '\0');
    ::WideCharToMultiByte(CP_UTF8, 0, text.data(), length, result.data(), static_cast<int>(result.size()), nullptr, nullptr);
    return result;
}

std::string lastFailure() {
    return std::system_category().message(static_cast<int>(::GetLastError()));
}

bool isTerminal(int descriptor) {
    return ::_isatty(descriptor) != 0;
}

/// Pipes are asked again and again: Windows waits for other things only.
bool inputWaits(int descriptor, int milliseconds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(milliseconds);
    auto* const handle = reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor));
    for (;;) {
        DWORD count = 0;
        if (::PeekNamedPipe(handle, nullptr, 0, nullptr, &count, nullptr) == 0 || count > 0) return true;
        if (std::chrono::steady_clock::now() >= end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

std::string signalName(int signal) {
    return "signal " + std::to_string(signal);
}

unsigned long processNumber() {
    return ::GetCurrentProcessId();
}

std::string hostName() {
    std::array<wchar_t, 256> name{};
    auto size = static_cast<DWORD>(name.size());
    return ::GetComputerNameW(name.data(), &size) != 0 ? narrowOf({name.data(), size}) : "";
}

fs::path programFile() {
    constexpr std::size_t kLongestPath = 32768;
    std::wstring path(kLongestPath, L'\0');
    path.resize(::GetModuleFileNameW(nullptr, path.data(), static_cast<DWORD>(path.size())));
    return path;
}

fs::path homeFolder() {
    return folderIn(L"USERPROFILE");
}

fs::path usualCacheFolder() {
    const fs::path local = folderIn(L"LOCALAPPDATA");
    std::error_code code;
    return (local.empty() ? fs::temp_directory_path(code) : local) / "tegument";
}

fs::path newTemporaryFolder() {
    std::error_code code;
    const fs::path base = fs::temp_directory_path(code);
    for (unsigned count = 0; !code && count < 1000; ++count) {
        LARGE_INTEGER now;
        ::QueryPerformanceCounter(&now);
        const fs::path folder = base / ("tegument-" + std::to_string(processNumber()) + "-" + std::to_string(now.QuadPart));
        if (fs::create_directory(folder, code)) return folder;
    }
    return {};
}

bool exchangeFolders(const fs::path&, const fs::path&) {
    return false;
}

bool sameName(const fs::path& a, const fs::path& b) {
    return ::CompareStringOrdinal(a.c_str(), -1, b.c_str(), -1, TRUE) == CSTR_EQUAL;
}

std::vector<std::string> filesLike(const std::string& pattern) {
    const fs::path folder = fs::path(pattern).parent_path();
    const std::string last = fs::path(pattern).filename().string();
    std::vector<std::string> all;
    std::error_code code;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? fs::path(".") : folder, code))
        if (fits(last, entry.path().filename().string())) all.push_back((folder / entry.path().filename()).generic_string());
    std::ranges::sort(all);
    return all;
}

std::string contentHashOfFile(const fs::path& path) {
    const auto bytes = readFile(path);
    return bytes ? contentHash(*bytes) : std::string();
}

std::string libraryName(const std::string& name) {
    return name + ".dll";
}

void* openLibrary(const fs::path& path, std::string& why) {
    auto* const library = ::LoadLibraryW(path.c_str());
    if (library == nullptr) why = path.string() + ": " + lastFailure();
    return library;
}

void* functionOf(void* library, const char* name) {
    return reinterpret_cast<void*>(::GetProcAddress(static_cast<HMODULE>(library), name));
}

} // namespace tegument
