#pragma once
// Techniques drawn in turns on one device, and how far each picture is from the truth.

#include "host/gpu/gpu.h"
#include "host/run/run.h"
#include "lab/bench/statistics.h"
#include "lab/bench/truth.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tegument::bench {

struct Frames {
    int warmUp = 0;
    int timed = 1;
};

/// What a pass fetches and moves, by count (traffic.h); of several of one name, their sum.
struct Traffic {
    std::string pass;
    std::uint64_t calls = 0;   // pixels or threads
    std::uint64_t fetches = 0; // look-ups of textures, whatever their filter
    std::uint64_t read = 0;    // bytes: of each texture what is looked up, at most all of its finest level
    std::uint64_t written = 0; // bytes of colour, of depth, and what compute shaders store
};

struct PassTime {
    std::string name;
    double milliseconds = 0; // median
};

/// What drawing cost, and the last picture.
struct Drawn {
    Spread milliseconds;          // of all passes of a frame, without clears
    Spread gross;                 // with them
    std::vector<PassTime> passes; // of one name: together
    std::uint64_t bytes = 0;      // everything the technique holds on the device: targets, textures, mesh
    std::uint64_t targetBytes = 0;
    std::vector<Traffic> traffic; // where it is counted
    Image picture;
};

struct Contest {
    const Scene& scene;
    int width = 0;
    int height = 0;
    int mapSize = 0;
    Compiler compiler = Compiler::Dxc;
    int shadowSize = 0; // texels along each side of the maps seen from the light; 0: as many as mapSize
    MeshAssets assets;  // made for the scene's mesh where an effect asks for them
};

/// The contender's effect with the contest's sizes, and how it is drawn.
[[nodiscard]] Result<Effect> loadContender(const Contest& contest, const Contender& contender);
[[nodiscard]] RunOptions runOptionsOf(const Contest& contest, const Contender& contender);

/// Who is drawn, and on what.
struct Entry {
    Contest contest;
    Contender contender;
};

/// All of them on the same.
[[nodiscard]] std::vector<Entry> entriesOf(const Contest& contest, const std::vector<Contender>& contenders);

/// Each entry's outcome, in their order: one that cannot be drawn does not stop the others. All are alive at once and drawn in turns, frame
/// by frame, so that a clock that changes changes for all. `say`: what is being done.
[[nodiscard]] std::vector<Result<Drawn>> drawInTurns(gpu::Device& device, const std::vector<Entry>& entries, const Frames& frames,
                                                     const std::function<void(const std::string&)>& say);

/// The entry's picture by `grid` x `grid` samples a pixel: drawn so many times as large, each pixel the mean of its own. Not timed.
[[nodiscard]] Result<Image> drawMean(gpu::Device& device, const Entry& entry, int grid);

/// Relative figures are to the mean of the truth over the compared pixels.
struct Errors {
    double relativeL2 = 0;
    double p99 = 0;
    double p999 = 0;
    double largestInterior = 0;
    double bias = 0;
    double psnr = 0; // dB, the peak being the truth's largest value
    std::optional<double> flip;
};
/// TG5261 when the truth is black or the picture holds something that is not finite.
[[nodiscard]] Result<Errors> errorsOf(const Image& picture, const Sample& sample, const std::vector<glm::dvec3>& truth);

} // namespace tegument::bench
