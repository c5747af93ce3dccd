#pragma once
// Inside lab/verify: effects/FurRoots.fx beside itself in double precision (lab/reference/fur_regression.h). A regression check:
// it knows the effect's approximations, and finds what changes in them, in their arithmetic, or on a device.

#include "lab/verify/fur_roots_scene.h"
#include "lab/verify/work.h"

namespace tegument::verify {

/// A picture, and per pixel whether it says what the effect draws there.
struct SweptPicture {
    Image picture;
    std::vector<std::uint8_t> counts;
    std::vector<std::uint8_t> covered; // by any layer, or the skin
};

/// `grid`: pixels to which the device moves corners before it interpolates (corner_grid.h).
[[nodiscard]] SweptPicture drawSwept(const StrandsScene& scene, const VerifyOptions& options, double grid);

/// The scene by the effect; `mesh`: with ribbons, for effects that draw them.
struct StrandsBy {
    std::string effect = "FurRoots.fx";
    std::string technique; // empty: the scene's
    const Mesh* mesh = nullptr;
};
[[nodiscard]] Result<Image> renderStrands(const Context& context, const StrandsScene& scene, const StrandsBy& by = {});

/// The share of pixels near where light is cut off grows with the texels of the shadow map: `share` of those at 256 along a side.
[[nodiscard]] double mostApart(double share, const VerifyOptions& options);

/// Both techniques, near by and far away.
[[nodiscard]] Result<void> checkSwept(ModuleReport& report, const Context& context);

} // namespace tegument::verify
