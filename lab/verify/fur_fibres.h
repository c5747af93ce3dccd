#pragma once
// Inside lab/verify: technique CoatChance of FurCoat against light on paths through the very strands that it draws.

#include "lab/reference/fibre_paths.h"
#include "lab/verify/work.h"

#include <vector>

namespace tegument::verify {

/// A ball in a coat of locks, of one colour in each channel, and its strands as the effect has them in space.
struct FibreStage {
    Mesh skin;  // the layer below the strands
    Mesh furry; // with ribbons
    Image roots;
    Workspace workspace;
    std::map<std::string, std::vector<double>> parameters;
    std::vector<reference::FibreAxis> strands;
};
[[nodiscard]] Result<FibreStage> makeFibreStage(const Context& context);

/// Parallel light at this angle from the direction to the eye, degrees.
[[nodiscard]] reference::FibreLight lightAtPhase(double phase);

/// By paths; what has been traced once is kept in the cache, and an interrupted trace goes on.
[[nodiscard]] Result<reference::FibreSums> traceStage(const FibreStage& stage, double phase, int size, int samples);

/// As the effect draws it, four times as large a side and averaged.
[[nodiscard]] Result<Image> drawStage(const Context& context, const FibreStage& stage, const std::string& technique, double phase,
                                      int size);

/// Means over the picture, drawn over traced, of each channel; and the relative L2 of blocks of eight pixels a side, less the truth's
/// noise.
struct FibreError {
    glm::dvec3 ratio{0};
    double blocks = 0;
    double noise = 0;
};
[[nodiscard]] FibreError fibreError(const Image& drawn, const reference::FibreSums& truth);

/// Metrics of the phases, and their pictures.
[[nodiscard]] Result<void> judgeFibres(ModuleReport& report, const Context& context);

} // namespace tegument::verify
