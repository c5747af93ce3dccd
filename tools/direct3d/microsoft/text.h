#pragma once
// JSON by hand: this program is one small Windows file without libraries.

#include <cstdio>
#include <string>

#include <windows.h>

namespace hlslc {

inline bool isUtf8(const std::string& text) {
    return MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, text.data(), static_cast<int>(text.size()), nullptr, 0) > 0;
}

/// Printable ASCII and UTF-8 (names of files) as they are, everything else as \u00XX: messages come in the system's code page.
inline std::string jsonString(const std::string& text) {
    const bool utf8 = isUtf8(text);
    std::string result = "\"";
    for (const char letter : text) {
        const auto byte = static_cast<unsigned char>(letter);
        if (letter == '"' || letter == '\\') result += '\\';
        if (byte >= 0x20 && byte != 0x7f && (byte < 0x80 || utf8)) {
            result += letter;
            continue;
        }
        char escaped[8];
        std::snprintf(escaped, sizeof escaped, "\\u%04x", byte);
        result += escaped;
    }
    return result + '"';
}

} // namespace hlslc
