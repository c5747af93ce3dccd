#pragma once
// JSON by hand: this program is one small Windows file without libraries.

#include <cstdio>
#include <string>

namespace hlslc {

/// Printable ASCII as it is, everything else as \u00XX: messages come in the system's code page.
inline std::string jsonString(const std::string& text) {
    std::string result = "\"";
    for (const char letter : text) {
        const auto byte = static_cast<unsigned char>(letter);
        if (letter == '"' || letter == '\\') result += '\\';
        if (byte >= 0x20 && byte < 0x7f) {
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
