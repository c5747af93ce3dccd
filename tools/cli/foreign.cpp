#include "tools/cli/foreign.h"

#include "tools/cli/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tegument::app {

namespace {

constexpr int kRings = 64;
constexpr int kSectors = 128;
constexpr float kRadius = 1000;      // mm
constexpr float kLeast = 0.5F / 255; // a difference that eight bits can show

} // namespace

Result<std::map<std::string, std::string>> bindRules(const std::vector<std::string>& given) {
    std::map<std::string, std::string> rules;
    for (const std::string& text : given) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
            return usageError(8011, fmt::format("--bind {} is not NAME=RULE", text), "for example --bind gMatrix=WORLDVIEWPROJECTION");
        rules[text.substr(0, equals)] = text.substr(equals + 1);
    }
    return rules;
}

Mesh ball() {
    Mesh mesh;
    mesh.name = "ball";
    for (int ring = 0; ring <= kRings; ++ring)
        for (int sector = 0; sector <= kSectors; ++sector) {
            const float v = static_cast<float>(ring) / kRings;
            const float u = static_cast<float>(sector) / kSectors;
            const float polar = v * std::numbers::pi_v<float>;
            const float around = u * 2 * std::numbers::pi_v<float>;
            const glm::vec3 normal(std::sin(polar) * std::sin(around), std::cos(polar), std::sin(polar) * std::cos(around));
            mesh.positions.push_back(normal);
            mesh.normals.push_back(normal);
            mesh.tangents.emplace_back(std::cos(around), 0.0F, -std::sin(around), 1.0F);
            mesh.uvs.emplace_back(u, v);
        }
    for (int ring = 0; ring < kRings; ++ring)
        for (int sector = 0; sector < kSectors; ++sector) {
            const auto at = static_cast<std::uint32_t>(ring * (kSectors + 1) + sector);
            const std::uint32_t below = at + kSectors + 1;
            mesh.indices.insert(mesh.indices.end(), {at, below, at + 1, at + 1, below, below + 1});
        }
    computeBounds(mesh);
    return mesh;
}

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
    return Diagnostic{.severity = Severity::Warning,
                      .code = 4070,
                      .at = {.file = effect, .byte = {}},
                      .text = black ? std::string("the picture is black")
                                    : fmt::format("the picture is one colour, ({:.2f}, {:.2f}, {:.2f})", high[0], high[1], high[2]),
                      .hint = numbers ? "look at what the parameters got: --bind NAME=RULE and --set NAME=VALUE change it"
                                      : "the shader computes numbers that are not finite",
                      .sourceLine = {}};
}

} // namespace tegument::app
