#include "host/support/text.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace tegument {

namespace {

char lower(char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

/// Levenshtein distance, two rows.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> previous(b.size() + 1);
    std::vector<std::size_t> current(b.size() + 1);
    std::iota(previous.begin(), previous.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        current[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replace = previous[j] + (lower(a[i]) != lower(b[j]));
            current[j + 1] = std::min({replace, previous[j + 1] + 1, current[j] + 1});
        }
        std::swap(previous, current);
    }
    return previous[b.size()];
}

} // namespace

bool equalsIgnoreCase(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b, {}, lower, lower);
}

std::string toLower(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), lower);
    return result;
}

std::string_view trim(std::string_view text) {
    constexpr std::string_view kSpace = " \t\r\n\f\v";
    const std::size_t first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::string shellWord(const std::string& text) {
    const bool plain =
        text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,/@:") == std::string::npos;
    if (plain && !text.empty()) return text;
    std::string quoted = "'";
    for (const char letter : text)
        quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    return quoted + "'";
}

std::string nearestName(std::string_view name, std::span<const std::string> candidates) {
    std::string nearest;
    std::size_t best = name.size() / 3 + 1;
    for (const std::string& candidate : candidates) {
        const std::size_t distance = editDistance(name, candidate);
        if (distance > best || (distance == best && !nearest.empty())) continue;
        best = distance;
        nearest = candidate;
    }
    return nearest;
}

std::string didYouMean(std::string_view name, std::span<const std::string> candidates) {
    const std::string nearest = nearestName(name, candidates);
    return nearest.empty() ? std::string() : "did you mean '" + nearest + "'?";
}

} // namespace tegument
