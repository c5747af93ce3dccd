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

/// Of a parameter without fractions, by its type or because its range and step are whole numbers.
[[nodiscard]] bool isWhole(const Parameter& parameter);

/// What stands in the panel of parameters: those with a UIWidget that make a difference to the frame.
[[nodiscard]] std::vector<const Parameter*> slidersOf(const ViewState& state, const Effect& effect);

/// True when a slider moved or a preset was chosen: `state.parameters` then holds the values. `start`: what presets are laid over.
[[nodiscard]] bool drawPanel(ViewState& state, const ViewState& start, const Effect& effect, const PanelText& text);

} // namespace tegument::view
