#pragma once
// How cost grows: the time of the passes that a quantity drives, over four sizes of it, and the exponent through them.

#include "lab/bench/bench.h"

#include <string>
#include <vector>

namespace tegument::bench {

struct Growth {
    std::string quantity; // "texels of a map"
    std::string what;     // "ten convolutions, DEonLuebke"
    std::vector<double> x;
    std::vector<double> milliseconds;
    PowerLaw law;
    AffineLaw parts; // a fixed cost and one for each unit: what an exponent below 1 comes from
};

struct GrowthOptions {
    std::filesystem::path effects = "effects";
    std::filesystem::path sceneFolder;
    Compiler compiler = Compiler::Dxc;
    Frames frames;
    bool large = false; // sizes for a graphics card, else for a processor
    bool small = false; // so small that the figures mean nothing: for tests
};

/// Texels, pixels, blurs, layers of fur, faces: all expected to be linear.
[[nodiscard]] Result<std::vector<Growth>> measureGrowth(gpu::Device& device, const GrowthOptions& options, const Say& say);

} // namespace tegument::bench
