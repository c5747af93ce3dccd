#pragma once
// The flat patch of lab/reference/fur_patch.h, drawn by effects/Fur.fx: what its shells show beside exact rays against the cones.

#include "host/gpu/gpu.h"
#include "host/run/run.h"
#include "lab/reference/fur_patch.h"

#include <filesystem>
#include <memory>

namespace tegument::measure {

class FlatFur {
public:
    /// Writes the patch's fur map to a folder of its own, which goes with the object.
    [[nodiscard]] static Result<FlatFur> create(gpu::Device& device, const reference::FurPatch& patch);
    FlatFur(FlatFur&&) noexcept;
    FlatFur& operator=(FlatFur&&) noexcept;
    ~FlatFur();

    /// Brightness of each pixel as the effect draws it: 0.05 skin, 0.15 to 1 strands from root to tip. `spread`: heights are (l /
    /// n)^spread.
    [[nodiscard]] Result<std::vector<double>> draw(const reference::FurView& view, int layers, double spread = 1) const;

    /// By exact rays through the same pixels.
    [[nodiscard]] std::vector<double> truth(const reference::FurView& view) const;

private:
    FlatFur(gpu::Device& device, const reference::FurPatch& patch);

    gpu::Device* device_;
    reference::FurPatch patch_;
    std::filesystem::path folder_;
};

} // namespace tegument::measure
