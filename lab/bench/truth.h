#pragma once
// What the pixels of a scene should show: skin that the camera sees, and its light by brute force (lab/reference/bssrdf.h).

#include "lab/bench/catalogue.h"
#include "lab/bench/scenes.h"
#include "lab/reference/bssrdf.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tegument::bench {

/// The pixels that are compared.
struct Sample {
    std::vector<reference::ShadedPoint> points;
    std::vector<std::uint8_t> interior;        // of each point: 1 where the eight neighbours show the same piece of surface
    double coverage = 0;                       // share of the picture that shows skin
    bool whole = false;                        // every pixel that can be compared
    std::string id;                            // names scene, camera and pixels
    std::vector<reference::ShadedPoint> parts; // what light is computed at: the points, or those of a grid in each of their pixels that see
                                               // the mesh
    std::vector<std::uint32_t> partOf;         // of each part its pixel among the points
    int grid = 1;                              // parts along each side of a pixel
    glm::dvec3 background{0};                  // what a part shows that sees nothing
};

/// The scene as the references see it.
struct TruthScene {
    reference::Pinhole camera;
    reference::SkinScene skin;
};
[[nodiscard]] TruthScene truthScene(const Scene& scene, int width, int height);

/// Pixels that show skin (alpha of the colour map 1) and whose eight neighbours show the mesh too: at the outline a rasteriser, which snaps
/// vertices to 1/256 pixel, may see the background. `count` of them, spread evenly; 0: all. Of each `grid` x `grid` samples, whose mean is
/// its light: with 1 what its centre sees.
[[nodiscard]] Sample samplePixels(const Scene& scene, const TruthScene& truth, std::size_t count, int grid = 1);

using Progress = std::function<void(std::size_t done, std::size_t total)>;

/// How many points' light is kept together (lab/reference/bssrdf.h): what any number of processes and machines fill together.
inline constexpr std::size_t kKeptTogether = 1024;

/// Part `index` (1 .. count) of `count`, of what is kept together.
struct Part {
    std::size_t index = 1;
    std::size_t count = 1;
};
/// "3/100". TG8101 anything else.
[[nodiscard]] Result<Part> partOf(const std::string& text);

/// Light of each point by the six Gaussians; black where it is another part's.
[[nodiscard]] std::vector<glm::dvec3> trueLight(const TruthScene& truth, const Sample& sample, Part part, const Progress& progress);
/// Of a contender that has a definition of its own.
[[nodiscard]] std::vector<glm::dvec3> claimedLight(const TruthScene& truth, const Sample& sample, const Contender& contender, Part part,
                                                   const Progress& progress);

} // namespace tegument::bench
