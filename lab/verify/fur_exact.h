#pragma once
// Inside lab: effects/FurRoots.fx beside exact strands in space (lab/reference/fur_exact.h), which is what it
// approximates.

#include "lab/verify/fur_windows.h"
#include "lab/verify/work.h"

namespace tegument::verify {

/// A picture by rays, several to a pixel; pixels in which the shadow map cannot tell do not count.
struct ExactPicture {
    Image picture;
    std::vector<std::uint8_t> counts;
    std::vector<std::uint8_t> covered;
};
[[nodiscard]] ExactPicture drawExact(const FurWindow& window, const VerifyOptions& options);

/// Both techniques through every window.
[[nodiscard]] Result<void> judgeStrands(ModuleReport& report, const Context& context);

} // namespace tegument::verify
