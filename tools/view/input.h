#pragma once
// What keys and mouse ask for. Needs no GPU and no window.

#include <glm/glm.hpp>

#include <filesystem>
#include <optional>
#include <vector>

namespace tegument::view {

/// What happened since it was last asked. Drags in shares of the window's height, right and up.
struct Input {
    std::vector<char32_t> keys; // characters, and the keys of keys.h
    glm::dvec2 camera{0};
    glm::dvec2 pan{0};
    double dolly = 0; // nearer is positive
    glm::dvec2 light{0};
    double surroundings = 0;      // about the vertical
    std::optional<double> border; // where it was dragged to: share of the window's width
    double wheel = 0;             // notches; up is positive
    double lightWheel = 0;
    std::vector<std::filesystem::path> dropped; // files
    glm::dvec2 cursor{-1};                      // share of the window from its left top; outside it: beyond 0 and 1
    bool clicked = false;                       // where the overlay has the mouse
    bool any = false;                           // something that the overlay may want to know
    bool closed = false;
};

/// For more than where the cursor is.
[[nodiscard]] inline bool asks(const Input& input) {
    const glm::dvec2 none(0);
    return !input.keys.empty() || !input.dropped.empty() || input.camera != none || input.pan != none || input.dolly != 0 ||
           input.light != none || input.surroundings != 0 || input.wheel != 0 || input.lightWheel != 0 || input.border;
}

} // namespace tegument::view
