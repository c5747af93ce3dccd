#pragma once
// What stands to the left of the border: the effect as it was kept, with its technique, setting and values, drawn with the camera and light
// of now; or a saved picture. And how far the picture is from it.

#include "host/image/compare.h"
#include "tools/view/pass_times.h"
#include "tools/view/reading.h"
#include "tools/view/sharpness.h"

#include <map>
#include <optional>
#include <string>

namespace tegument::view {

struct Beside {
    std::string name;
    std::unique_ptr<Loaded> loaded; // none: a saved picture
    std::unique_ptr<Loaded> draft;  // with fewer texels in its maps, while the light moves; none: there is none
    bool drafting = false;          // that is what was drawn
    std::string technique;
    std::map<std::string, std::vector<double>> parameters;
    bool display = false; // `values` are a display's light, as 8-bit files hold it
    Image values;         // of what is shown
    int level = 0;        // of the mip chain, that these and the error are of
    gpu::Texture stored;  // a saved picture's
    gpu::Texture picture; // as it is shown
    gpu::Texture errors;  // in false colours
    PassTimes times;
    PassCosts costs;         // of the last frame
    std::string error;       // a line; empty: not measured yet
    bool drawn = false;      // from this frame; false: there is nothing to hold the picture against
    bool haveErrors = false; // of this frame
    RehearsalCosts moves;    // once it was rehearsed
    bool rehearsed = false;  // a small picture was drawn, and the next one is quick
    bool draftDrawn = false; // likewise, with fewer texels in its maps

    /// Of what was drawn.
    [[nodiscard]] EffectSession& session() { return (drafting ? draft : loaded)->session; }
};

/// A stored picture as light: 8-bit values without their sRGB curve; four channels.
[[nodiscard]] Image lightOf(const Image& stored);

/// What a display shows of this radiance, as light of 0 to 1: to be held against lightOf(an 8-bit file).
[[nodiscard]] Image displayLight(const Image& radiance);

/// "relative L2 0.0123, 99 % within 0.05, bias -0.001, largest 1.2 at (30, 40)", or why there is none.
[[nodiscard]] std::string errorLine(const Result<Difference>& difference);

/// The largest channel's difference over the reference's mean as a colour: black at a thousandth and below, then blue, green, yellow, red
/// at 1 and above, by its logarithm; magenta where a value is not finite. Opaque; the sizes must agree.
[[nodiscard]] Image falseColours(const Image& image, const Image& reference);

} // namespace tegument::view
