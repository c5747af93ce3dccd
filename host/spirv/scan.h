#pragma once
// Reading what other programs print.

#include "host/support/text.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

namespace tegument {

/// Calls visit for each line, without blanks around it.
template <class Visit>
void forEachLine(std::string_view text, Visit&& visit) {
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        visit(trim(text.substr(0, end)));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

/// The number that the whole text is.
[[nodiscard]] inline std::optional<int> wholeNumber(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc() || end != text.data() + text.size()) return {};
    return value;
}

} // namespace tegument
