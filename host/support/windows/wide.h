#pragma once
// Windows names things in UTF-16; this program's strings are UTF-8.

#include <string>
#include <string_view>

namespace tegument {

[[nodiscard]] std::wstring wideOf(std::string_view text);
[[nodiscard]] std::string narrowOf(std::wstring_view text);
/// What GetLastError says, in words.
[[nodiscard]] std::string lastFailure();

} // namespace tegument
