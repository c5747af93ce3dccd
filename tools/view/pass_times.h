#pragma once
// GPU milliseconds of each pass over the last frames, from the times that every frame brings. Needs no window and no GPU.

#include "host/run/session_frame.h"

#include <deque>
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
    static constexpr std::size_t kMostFrames = 96;

    /// Other passes than before: what was known of those is gone.
    void note(const SessionFrame& frame);

    [[nodiscard]] const std::vector<PassTime>& passes() const { return passes_; } // in the order of the frame, then the resolve
    /// The oldest first: a time for each of passes(), 0 where it was kept.
    [[nodiscard]] const std::deque<std::vector<double>>& frames() const { return frames_; }
    /// Smoothed, of what the last frame drew.
    [[nodiscard]] double drawn() const;
    /// Likewise, had it drawn all.
    [[nodiscard]] double all() const;

private:
    std::vector<PassTime> passes_;
    std::deque<std::vector<double>> frames_;
};

} // namespace tegument::view
