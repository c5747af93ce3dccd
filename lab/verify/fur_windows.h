#pragma once
// Inside lab: what FurRoots is judged on: pieces of a plane, a ball, a torus and a rough surface, so near that pixels are an
// eighth of a spacing of strands, and a ball so far away that they hold several; as the effect sees it, and as strands in space.

#include "lab/reference/fur_exact.h"
#include "lab/verify/fur_roots_scene.h"

#include <optional>

namespace tegument::verify {

/// How far a picture may be from exact strands, and why.
struct WindowLimits {
    double relativeL2 = 0;
    double bias = 0;
    const char* why = "";
    double apart = 0.05; // share of pixels that may be set apart with 256 texels along a side of the shadow map
};

struct FurWindow {
    StrandsScene strands; // what is drawn
    reference::FurStrandShape shape;
    bool lattice = false; // technique Cellular
    int size = 128;       // pixels a side
    int height = 0;       // where it is another; 0: as wide
    bool asks = true;     // which pixels the shadow map can tell; else all count
    int pieces = 12;      // of a strand, each straight
    int samples = 4;      // of the truth, along each side of a pixel
    WindowLimits limits;
};

/// Names of what windows are looked through at; with a mesh in the options that alone.
[[nodiscard]] std::vector<std::string> windowNames(const VerifyOptions& options);

/// What is to be otherwise than usual; lengths in spacings.
struct WindowChange {
    std::optional<int> layers;
    std::optional<double> fewest;
    std::optional<double> scatter;
    std::optional<double> curls;
    std::optional<double> tufts;
    std::optional<double> lean; // share of the coat
    std::optional<double> comb; // likewise, of roots
    std::optional<double> pixel;
    std::optional<double> tilt; // degrees
    std::optional<double> coat;
};
[[nodiscard]] Result<FurWindow> makeWindow(const VerifyOptions& options, const std::string& technique, const std::string& name,
                                           const WindowChange& change = {});

/// The strands that a picture may show.
[[nodiscard]] std::vector<reference::FurGrown> strandsOf(const FurWindow& window, const reference::RayScene& skin,
                                                         const reference::Pinhole& camera);

} // namespace tegument::verify
