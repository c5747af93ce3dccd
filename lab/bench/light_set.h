#pragma once
// Lights of a comparison beside the one of its workspace: the same for the techniques that draw and for the reference.

#include "lab/reference/more_light.h"

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

} // namespace tegument::bench
