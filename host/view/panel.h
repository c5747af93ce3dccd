#pragma once
// What stands on the picture: what is shown, errors, the help, the effect's parameters as sliders. To be called inside Overlay::draw.

#include "host/adopt/adopt.h"
#include "host/effect/model.h"
#include "host/gpu/gpu.h"
#include "host/view/layout.h"
#include "host/view/probe.h"
#include "host/view/source_text.h"
#include "host/view/state.h"

namespace tegument::view {

/// What stands on both sides of the border.
struct BesideText {
    std::string left;
    std::string right;
    std::string error;    // of the right side against the left
    bool colours = false; // the error is what is shown
};

struct PanelText {
    std::vector<std::string> lines; // what is shown
    std::string problem;            // why the picture is not up to date; empty: it is
    std::string notice;             // "wrote out/Main-001.png"
    std::string bindings;           // what each parameter got, by which rule
    std::optional<BesideText> beside;
    float pictureShare = 1; // of the window's width, from the left; the rest is the effect's text
};

/// A target as a small picture.
struct Thumbnail {
    std::string name;  // empty: the picture
    std::string label; // with its size
    gpu::Texture* texture = nullptr;
    bool shown = false;
};

/// What is shown besides text; empty: not asked for.
struct PanelPictures {
    std::vector<Thumbnail> thumbnails;
    std::optional<Histogram> histogram;
};

/// "gWorld  WORLD  by semantic", a line for each parameter; why there is none where there is none.
[[nodiscard]] std::string bindingLines(const std::vector<ParameterBinding>& bindings);

/// What was done in the panels.
struct PanelOutcome {
    bool moved = false;                // a slider, or a preset was chosen: `state.parameters` then holds the values
    std::optional<std::string> opened; // a thumbnail
};

/// Of a parameter without fractions, by its type or because its range and step are whole numbers.
[[nodiscard]] bool isWhole(const Parameter& parameter);

/// What stands in the panel of parameters: those with a UIWidget that make a difference to the frame.
[[nodiscard]] std::vector<const Parameter*> slidersOf(const ViewState& state, const Effect& effect);

/// `start`: what presets are laid over.
[[nodiscard]] PanelOutcome drawPanel(ViewState& state, const ViewState& start, const Effect& effect, const PanelText& text,
                                     const PanelPictures& pictures, SourceText& source);

/// The border over the picture, the names of both sides and their error above `bottom`.
void drawBorder(double border, const BesideText& text, float width, float bottom);

/// The effect's text with line numbers and errors in place; written by Ctrl+S.
void drawSource(SourceText& source, const Area& area);

} // namespace tegument::view
