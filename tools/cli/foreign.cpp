#include "tools/cli/foreign.h"

#include "tools/cli/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tegument::app {

namespace {

constexpr float kLeast = 0.5F / 255; // a difference that eight bits can show

} // namespace

void printBindings(const std::vector<ParameterBinding>& bindings) {
    if (bindings.empty()) return;
    std::vector<std::vector<std::string>> rows;
    for (const ParameterBinding& binding : bindings)
        rows.push_back({binding.parameter, binding.source, binding.rule});
    fmt::print("\n{}", table({"parameter", "got", "by"}, rows));
}

std::optional<Diagnostic> plainPictureNote(const Image& image, const std::string& effect) {
    const auto channels = static_cast<std::size_t>(image.channels);
    if (image.pixels.size() < channels || channels < 3) return std::nullopt;
    std::array<float, 3> low{};
    std::array<float, 3> high{};
    bool numbers = true;
    for (std::size_t i = 0; i + channels <= image.pixels.size(); i += channels)
        for (std::size_t c = 0; c < 3; ++c) {
            const float value = std::clamp(image.pixels[i + c], 0.0F, 1.0F);
            numbers = numbers && std::isfinite(image.pixels[i + c]);
            low[c] = i == 0 ? value : std::min(low[c], value);
            high[c] = i == 0 ? value : std::max(high[c], value);
        }
    for (std::size_t c = 0; c < 3; ++c)
        if (high[c] - low[c] > kLeast) return std::nullopt;
    const bool black = std::ranges::all_of(high, [](float value) { return value < kLeast; });
    return inputWarning(4070, {.file = effect},
                        black ? std::string("the picture is black")
                              : fmt::format("the picture is one colour, ({:.2f}, {:.2f}, {:.2f})", high[0], high[1], high[2]),
                        numbers ? "look at what the parameters got: --bind NAME=RULE and --set NAME=VALUE change it"
                                : "the shader computes numbers that are not finite");
}

} // namespace tegument::app
