#pragma once
// GPU milliseconds of each pass, smoothed over the last frames. Needs no window and no GPU.

#include "host/run/session_frame.h"

#include <string>
#include <vector>

namespace tegument::view {

/// Runs of one name in a row count together.
struct PassTime {
    std::string name;
    std::size_t runs = 1;
    double milliseconds = 0; // smoothed over the frames that drew it
    bool kept = false;       // the last frame had no need to draw it
};

class PassTimes {
public:
    /// Other passes than before: what was known of those is gone.
    void note(const SessionFrame& frame);

    [[nodiscard]] const std::vector<PassTime>& passes() const { return passes_; } // in the order of the frame, then the resolve
    /// Smoothed, of what the last frame drew.
    [[nodiscard]] double drawn() const;
    /// Likewise, had it drawn all.
    [[nodiscard]] double all() const;

private:
    std::vector<PassTime> passes_;
};

} // namespace tegument::view
