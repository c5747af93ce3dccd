#pragma once
// Lights of a comparison beside the one of its workspace: the same for the techniques that draw and for the reference.
// Light by brute force is what a comparison takes longest for. Of many pixels it is kept, in files that any number of processes and
// machines fill together: each is renamed into place when it is whole, and whoever needs one that is missing computes it.

#include "host/support/result.h"
#include "lab/reference/more_light.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tegument::bench {

inline constexpr const char* kKeyAlone = "key";

struct LightSet {
    std::string name = kKeyAlone;
    std::vector<std::pair<std::string, std::string>> defines; // what effects are compiled with
    std::map<std::string, std::vector<double>> parameters{};  // and given
    reference::MoreLight more{};                              // what the reference adds
    double key = 1;                                           // times the colour of the workspace's light
};

/// "key"; "lamps": key, fill and two rims; "surroundings": the studio alone; "both": all of them, the studio at 0.35.
[[nodiscard]] const std::vector<std::string>& lightSetNames();
/// One of them; the key alone for any other name.
[[nodiscard]] LightSet lightSet(const std::string& name);

struct Scene;
/// The scene stands in these lights.
void lightBy(Scene& scene, const LightSet& lights);

/// Fewer points are computed anew each time: they take no longer than reading what decides whether they may be kept.
inline constexpr std::size_t kKeptFrom = 4096;
/// Of one file.
inline constexpr std::size_t kKeptTogether = 1024;

/// Part `index` (1 .. count) of `count`. Every file is in exactly one part.
struct Part {
    std::size_t index = 1;
    std::size_t count = 1;
};

/// "3/100". TG8101 anything else.
[[nodiscard]] Result<Part> partOf(const std::string& text);

struct KeptLight {
    std::filesystem::path folder; // empty: nothing is kept
    std::string key;              // names all that decides the light: scene, pixels, kind of light, program
    Part part;                    // of the files, which are to be computed here
};

/// The light of points [first, last).
using ComputeLight = std::function<std::vector<glm::dvec3>(std::size_t first, std::size_t last)>;

/// Of `count` points: kept files are read, others computed and kept. Of a part only its own files are; the points of those that are
/// nobody's yet are NaN. TG5002 a file cannot be written.
[[nodiscard]] Result<std::vector<glm::dvec3>> keptLight(const KeptLight& kept, std::size_t count, const ComputeLight& compute);

} // namespace tegument::bench
