#include "lab/bench/kept_light.h"

#include "host/support/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <string_view>

namespace tegument::bench {

namespace fs = std::filesystem;

namespace {

/// Nothing where the file is missing or has another length: both are computed.
bool readInto(const fs::path& file, std::vector<glm::dvec3>& light, std::size_t first, std::size_t last) {
    std::error_code code;
    if (!fs::exists(file, code)) return false;
    const auto bytes = readFile(file);
    if (!bytes || bytes->size() != (last - first) * sizeof(glm::dvec3)) return false;
    std::memcpy(&light[first], bytes->data(), bytes->size());
    return true;
}

std::string_view bytesOf(const std::vector<glm::dvec3>& light) {
    return {reinterpret_cast<const char*>(light.data()), light.size() * sizeof(glm::dvec3)};
}

bool readNumber(std::string_view text, std::size_t& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

} // namespace

Result<Part> partOf(const std::string& text) {
    const std::size_t slash = text.find('/');
    Part part;
    if (slash != std::string::npos && readNumber(std::string_view(text).substr(0, slash), part.index) &&
        readNumber(std::string_view(text).substr(slash + 1), part.count) && part.index >= 1 && part.index <= part.count)
        return part;
    return usageError(8101, fmt::format("'{}' is no part", text), "parts count from 1: 1/8 is the first of eight");
}

Result<std::vector<glm::dvec3>> keptLight(const KeptLight& kept, std::size_t count, const ComputeLight& compute) {
    if (kept.folder.empty() || count < kKeptFrom) return compute(0, count);
    std::vector<glm::dvec3> light(count, glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
    for (std::size_t first = 0; first < count; first += kKeptTogether) {
        const std::size_t last = std::min(first + kKeptTogether, count);
        const std::size_t file = first / kKeptTogether;
        const fs::path path = kept.folder / kept.key / fmt::format("{:05}.f64", file);
        if (readInto(path, light, first, last)) continue;
        if (file % kept.part.count != kept.part.index - 1) continue;
        const std::vector<glm::dvec3> computed = compute(first, last);
        std::ranges::copy(computed, light.begin() + static_cast<std::ptrdiff_t>(first));
        if (auto written = writeFile(path, bytesOf(computed)); !written) return written.error();
    }
    return light;
}

} // namespace tegument::bench
