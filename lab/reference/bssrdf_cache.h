#pragma once
// Results of the surface integral on disk, by content: hours of work must not be done twice, nor a result outlive what it was made from.

#include "lab/reference/bssrdf.h"

#include <optional>
#include <string>

namespace tegument::reference {

/// Of everything that D depends on: mesh, maps, light, settings, profile, quadrature, points.
[[nodiscard]] std::string diffusedKey(const SkinScene& scene, std::span<const ShadedPoint> points, const BssrdfOptions& options);

/// None where the file is absent, cut short, changed, or does not hold `count` points.
[[nodiscard]] std::optional<std::vector<Diffused>> loadDiffused(const std::string& key, std::size_t count);
/// A full disk only costs the next run its time: failures are ignored.
void storeDiffused(const std::string& key, const std::vector<Diffused>& diffused);

} // namespace tegument::reference
