#pragma once
// What stands on the picture: what is shown, errors, the help, the effect's parameters as sliders. To be called inside Overlay::draw.

#include "host/effect/model.h"
#include "host/view/state.h"

namespace tegument::view {

struct PanelText {
    std::vector<std::string> lines; // what is shown
    std::string problem;            // why the picture is not up to date; empty: it is
    std::string notice;             // "wrote out/Main-001.png"
};

/// True when a slider moved: `state.parameters` then holds its value.
[[nodiscard]] bool drawPanel(ViewState& state, const Effect& effect, const PanelText& text);

} // namespace tegument::view
