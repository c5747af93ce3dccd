#pragma once
// What of a frame is drawn from what: the arrows between the small pictures. Needs no window and no GPU.

#include "host/run/session_frame.h"

#include <string>
#include <vector>

namespace tegument::view {

/// Something drew into `to` while it sampled `from`; the picture has an empty name. `from` is `to` where a pass samples what was there.
struct TargetArrow {
    std::string from;
    std::string to;
    std::vector<std::string> passes; // that do so, each once, in the order of the frame
    std::size_t times = 0;           // with loops and objects
    bool operator==(const TargetArrow&) const = default;
};

/// One for each pair, in the order in which they come first.
[[nodiscard]] std::vector<TargetArrow> arrowsOf(const SessionFrame& frame);

/// The frame's targets in the order in which they are first written, the picture last: most arrows then point right. What no pass writes,
/// or reads, stands in front.
[[nodiscard]] std::vector<std::string> inOrderOfFlow(const SessionFrame& frame);

/// "from gSkyMap by BlurU, 2 times", "for the picture by Final", a line each; empty: nothing reads it, and it is drawn from no target.
[[nodiscard]] std::string arrowText(const std::vector<TargetArrow>& arrows, const std::string& target);

} // namespace tegument::view
