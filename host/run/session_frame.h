#pragma once
// What a drawn frame consists of. Needs no GPU.

#include "host/support/result.h"

#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tegument {

inline constexpr std::size_t kAllPasses = std::numeric_limits<std::size_t>::max();

struct SessionPass {
    std::string name;                 // "ConvolutionU" ...; a pass run several times: one entry per run, in order
    int object = 0;                   // which of the scene's objects it drew
    std::vector<std::string> targets; // colours, then depth; empty name: the caller's
    std::vector<std::string> reads;   // targets of the effect that it samples
    std::vector<std::string> writes;  // colours and textures that its shaders write; where there is none, the depth
    double milliseconds = 0;          // median over the frames; 0 for passes that were not drawn
    bool kept = false;                // not drawn: its targets hold what it would draw (RunOptions::keepUnchanged)
};

/// How a texture came to be that another effect draws, or that is made from the mesh.
struct Bake {
    double milliseconds = 0;      // for drawing it, or for making its file; for finding that where it was there
    bool fromCache = false;       // its file was there
    double once = 0;              // milliseconds that making that file took; 0: nobody wrote them down
    std::filesystem::path file{}; // of what is made from the mesh
};

/// A texture that the frame samples and does not draw.
struct SessionTexture {
    std::string name;   // of its parameter
    std::string source; // "Stretch.fx draws gStretchMap", "file head.png", ...
    int width = 0;
    int height = 0;
    std::string format;
    bool cube = false;
    std::optional<Bake> bake{}; // the last one; of what is baked
};

struct SessionFrame {
    std::string technique;
    std::vector<SessionPass> passes;           // of the whole frame, in order
    double clearMilliseconds = 0;              // where clears are timed apart
    std::optional<double> resolveMilliseconds; // where a pixel of the caller's targets has several samples
    std::vector<std::string>
        produced; // effect files that had to draw a texture for this frame, in order; none where nothing they read changed
    std::vector<SessionTexture> textures;        // of the effect's parameters, by name
    std::vector<std::string> targets;            // of the effect, that the frame uses
    std::vector<std::string> parameters;         // of the effect, numeric, that make a difference to the frame; sorted
    std::map<std::string, std::string> metadata; // as a picture of it carries
    std::vector<Diagnostic> warnings;
    bool givenUp = false; // RunOptions::pieces: parts of it are drawn; targets hold what they held, or are drawn anew next time
};

} // namespace tegument
