#pragma once
// Small text helpers that several rooms share.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tegument {

[[nodiscard]] bool equalsIgnoreCase(std::string_view a, std::string_view b);
[[nodiscard]] std::string toLower(std::string_view text);
[[nodiscard]] std::string_view trim(std::string_view text);

/// One word of a command line to be copied: in quotes where a shell would read it as several words or more.
[[nodiscard]] std::string shellWord(const std::string& text);

/// The candidate nearest to `name` by edit distance, ignoring case; empty when none is near (more than a third of its letters differ).
[[nodiscard]] std::string nearestName(std::string_view name, std::span<const std::string> candidates);

/// "did you mean 'X'?" for the nearest candidate, else empty.
[[nodiscard]] std::string didYouMean(std::string_view name, std::span<const std::string> candidates);

} // namespace tegument
