#pragma once
// Speed against error: techniques on scenes, timed by the device and held against brute force (docs/bench.md).

#include "lab/bench/light_set.h"
#include "lab/bench/measure.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tegument::bench {

struct BenchOptions {
    std::filesystem::path effects = "effects"; // holds catalogue.json
    std::filesystem::path sceneFolder;         // empty: in the cache
    std::vector<std::string> scenes = {"head"};
    int width = 0;
    int height = 0;
    std::vector<int> mapSizes;
    std::vector<int> shadowSizes = {0}; // 0: as many texels as the maps
    Frames frames;
    Compiler compiler = Compiler::Dxc;
    std::size_t pixels = 1024;      // of the reference; 0: all
    int grid = 1;                   // samples along each side of a pixel whose mean is held against the truth's
    std::filesystem::path pictures; // folder for the truth and what each technique draws of it, as EXR; empty: none
    bool count = false;             // what each frame fetches and moves, too (traffic.h)
    MeshAssets assets;
    std::string lights = kKeyAlone; // of every scene (light_set.h)
};

/// One contender on one scene with one size of maps.
struct Row {
    Contender contender;
    std::string scene;
    std::filesystem::path workspace;
    std::string mesh;
    int width = 0;
    int height = 0;
    int mapSize = 0;
    int shadowSize = 0;
    double coverage = 0;
    Drawn drawn; // without the picture
    Errors errors;
    std::optional<Errors> own; // against what it claims, where that is something else
    std::string referenceId;
    std::size_t referencePixels = 0;
    int samples = 1; // of each of them
    bool wholeReference = false;
    std::optional<Error> failure; // then the figures above have no meaning
};

/// What is being done now, for whoever waits.
using Say = std::function<void(const std::string&)>;

/// FLIP of pictures against one reference, in their order; empty where it cannot be measured.
using FlipMeter = std::function<std::vector<double>(const Image& reference, const std::vector<const Image*>& pictures, const Image& mask)>;

struct BenchTools {
    Say say;
    FlipMeter flip; // null: not measured
};

/// Computes and keeps this part of the references that `contenders` on every scene need, and draws nothing. How many pixels they have.
[[nodiscard]] Result<std::size_t> keepReferences(const std::vector<Contender>& contenders, const BenchOptions& options, Part part,
                                                 const Say& say);

/// `contenders` on every scene, with every size of maps.
[[nodiscard]] Result<std::vector<Row>> runBench(gpu::Device& device, const std::vector<Contender>& contenders, const BenchOptions& options,
                                                const BenchTools& tools);

} // namespace tegument::bench
