#pragma once
// Inside lab/verify: what fur is verified on, made from formulas.

#include "lab/reference/fur.h"
#include "lab/verify/scene.h"

#include <map>
#include <string>
#include <vector>

namespace tegument::verify {

struct FurScene {
    std::string name;
    Scene scene;
    reference::FurCoat coat;
};

/// A torus whose parts shadow each other, layers blended from the skin outwards; or the options' mesh.
[[nodiscard]] FurScene furTorus(const VerifyOptions& options);
/// The torus, where a pixel holds about half of the variance of the map's heights.
[[nodiscard]] FurScene furAfar(const VerifyOptions& options);
/// The torus from the side, in two rounds: its near side's fringe before the coat of its far side.
[[nodiscard]] FurScene furBefore(const VerifyOptions& options);
/// A ball, opaque layers from the outermost inwards; or the options' mesh.
[[nodiscard]] FurScene furBall(const VerifyOptions& options);

/// Of 80 mm, and a torus of 60 and 22 mm, with so many quads around and from pole to pole, or along the tube's circle.
[[nodiscard]] Mesh verificationBall(int around, int down);
[[nodiscard]] Mesh verificationTorus(int around, int across);

/// The coat as parameters of Fur.fx.
[[nodiscard]] std::map<std::string, std::vector<double>> parametersOf(const reference::FurCoat& coat);

/// Cones of random lengths, one in each square of four texels: alpha is the height over each texel.
[[nodiscard]] Image furPattern(int size, int seed);

} // namespace tegument::verify
