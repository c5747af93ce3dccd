#pragma once
// Fur: every technique on one coat of strands, timed by the device and held against exact strands by rays (docs/bench.md, "Fur").

#include "lab/bench/bench.h"

#include <string>
#include <vector>

namespace tegument::bench {

/// A place to look from: the workspace's own camera, so many times as far away.
struct FurView {
    std::string name; // behind the scene's
    double away = 1;
    int samples = 4; // of the truth, along each side of a pixel
};
[[nodiscard]] const std::vector<FurView>& furViews();

/// `contenders` on the mesh of every scene, from every view, with the options' first sizes of maps. The mesh gets 70,000 roots of its own,
/// which FurRoots and FurCoat draw; Fur draws the strands of its fur map. Errors are of whole pictures, background included, to rays that
/// meet round strands (lab/reference/fur_exact.h). What verify's windows say about lights and colours holds: workspace parameters.
[[nodiscard]] Result<std::vector<Row>> runFur(gpu::Device& device, const std::vector<Contender>& contenders, const BenchOptions& options,
                                              const BenchTools& tools);

} // namespace tegument::bench
