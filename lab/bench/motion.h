#pragma once
// What flickers and what pops: how the error of a picture changes from one picture to the next, in a slow zoom, on a turning head, under a
// light that moves.

#include "lab/bench/bench.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace tegument::bench {

/// A path through a scene, in small steps.
struct Motion {
    std::string name;                                              // "zoom"
    std::function<Workspace(const Scene& scene, int frame)> stand; // camera and light of a frame
};
/// zoom: 1 % nearer in each frame; turn: the body by half a degree; light: by half a degree around the body.
[[nodiscard]] const std::vector<Motion>& motions();

inline constexpr int kMotionFrames = 8;

/// Relative figures are to the norm of the truth over the same frames.
struct MotionRow {
    std::string motion;
    Contender contender;
    double error = 0;   // of all frames, relative L2
    double flicker = 0; // L2 of what the error changes by from frame to frame
    double largest = 0; // of one step: far above `flicker` where something pops
    double light = 0;   // what the truth itself changes by from frame to frame
};

/// The figures of one path: pixels of each frame, all of the same places, drawn and true.
[[nodiscard]] MotionRow motionRow(std::span<const std::vector<glm::dvec3>> drawn, std::span<const std::vector<glm::dvec3>> truth);

/// On the options' first scene, with their first sizes. The same pixels in every frame: those that show skin in all of them.
[[nodiscard]] Result<std::vector<MotionRow>> measureMotion(gpu::Device& device, const std::vector<Contender>& contenders,
                                                           const BenchOptions& options, const BenchTools& tools);

} // namespace tegument::bench
