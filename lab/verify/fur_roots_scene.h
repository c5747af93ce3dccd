#pragma once
// Inside lab/verify: coats whose strands grow on the surface, made from formulas, as the effect and as the reference see them.

#include "lab/reference/fur_regression.h"
#include "lab/verify/scene.h"
#include "meshprep/fur/roots/roots.h"

#include <map>
#include <string>
#include <vector>

namespace tegument::verify {

struct StrandsScene {
    std::string name;
    std::string technique;
    Scene scene;
    reference::FurCoat coat;
    reference::FurSwept fur;
    reference::FurStrandsAt strands;
    std::vector<glm::dvec4> grown; // lean of the vertices' tips, share of the density; empty: none, all
    RootSet set;                   // of technique Roots,
    Image roots;                   // and its texture
};

/// Three random numbers of a root, in [0, 1).
[[nodiscard]] glm::dvec3 randomOf(const Root& root);

/// Fills the roots of a scene that has all else.
[[nodiscard]] Result<void> growRoots(StrandsScene& scene, const RootOptions& options);

/// Strands wider than pixels, technique Cellular or Roots, on a torus whose parts shadow each other; or on the options' mesh.
[[nodiscard]] Result<StrandsScene> strandsNearBy(const VerifyOptions& options, const std::string& technique);
/// Strands thinner than pixels, half of them given way to the coverage to expect, on a ball; or on the options' mesh.
[[nodiscard]] Result<StrandsScene> strandsFarAway(const VerifyOptions& options, const std::string& technique);

/// The coat as parameters of FurRoots.fx.
[[nodiscard]] std::map<std::string, std::vector<double>> parametersOf(const StrandsScene& scene);

} // namespace tegument::verify
