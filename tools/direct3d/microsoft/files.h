#pragma once
// Files by names in UTF-8.

#include <windows.h>

#include <cstdio>
#include <string>
#include <string_view>

namespace hlslc {

inline std::wstring wide(const std::string& text) {
    const int length = static_cast<int>(text.size());
    std::wstring result(static_cast<std::size_t>(MultiByteToWideChar(CP_UTF8, 0, text.data(), length, nullptr, 0)), L'\0');
    MultiByteToWideChar(CP_UTF8, 0, text.data(), length, result.data(), static_cast<int>(result.size()));
    return result;
}

inline bool save(const std::string& path, std::string_view bytes) {
    FILE* file = _wfopen(wide(path).c_str(), L"wb");
    if (file == nullptr) return false;
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    return std::fclose(file) == 0 && written;
}

inline bool readFile(const std::string& path, std::string& bytes) {
    FILE* file = _wfopen(wide(path).c_str(), L"rb");
    if (file == nullptr) return false;
    char block[4096];
    for (std::size_t count = std::fread(block, 1, sizeof block, file); count > 0; count = std::fread(block, 1, sizeof block, file))
        bytes.append(block, count);
    return std::fclose(file) == 0;
}

} // namespace hlslc
