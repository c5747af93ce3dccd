#pragma once
// What can be compared: techniques of effects in their settings and variants, read from effects/catalogue.json (docs/bench.md).

#include "host/effect/model.h"
#include "host/support/result.h"

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tegument::bench {

/// What a technique claims to integrate, beside the truth that all are held against.
enum class Claim {
    SixGaussians, // the truth itself
    Delta,        // no diffusion: light leaves where it enters
    Burley,       // normalised diffusion with its own distances
    None          // no integral of a profile
};

/// One technique in one setting and variant.
struct Contender {
    std::string technique; // in the effect
    std::string setting;   // "corrected"
    std::string variant;   // "17 samples", or empty
    std::string source;    // the paper
    std::filesystem::path effect;
    std::vector<std::pair<std::string, std::string>> defines; // without the size of the maps
    std::map<std::string, std::vector<double>> parameters;
    Claim claim = Claim::SixGaussians;
    std::array<double, 3> burley{}; // mm

    /// What it is held against besides the truth; empty: nothing. Equal where two claim the same.
    [[nodiscard]] std::string ownDefinition() const;
    /// "SeparableSSS, 17 samples"
    [[nodiscard]] std::string name() const { return variant.empty() ? technique : technique + ", " + variant; }
    /// By the technique or by its name here, ignoring case.
    [[nodiscard]] bool isCalled(const std::string& wanted) const;
};

/// TG8070 where the file does not hold what docs/bench.md describes.
[[nodiscard]] Result<std::vector<Contender>> loadCatalogue(const std::filesystem::path& file);

/// Those whose technique, or "technique, variant", is named, ignoring case; all when nothing is. `settings` likewise. TG8071 a name that
/// chooses nothing.
[[nodiscard]] Result<std::vector<Contender>> choose(const std::vector<Contender>& contenders, const std::vector<std::string>& techniques,
                                                    const std::vector<std::string>& settings);

} // namespace tegument::bench
