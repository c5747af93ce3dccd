#pragma once
// What process.cpp and windows/process.cpp have in common.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace tegument {

/// As the system spells names: 16 bits on Windows.
using NativeView = std::basic_string_view<std::filesystem::path::value_type>;

/// The first folder of a list that holds a program of this name. `asProgram`: the file that a path stands for, if it may be executed.
[[nodiscard]] std::optional<std::filesystem::path>
findInFolders(NativeView folders, std::filesystem::path::value_type separator, const std::filesystem::path& name,
              const std::function<std::optional<std::filesystem::path>(const std::filesystem::path&)>& asProgram);

/// Takes the first whole line away, without its end.
[[nodiscard]] std::optional<std::string> takeLine(std::string& text);

} // namespace tegument
