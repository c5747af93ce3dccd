#pragma once
// What stands on the picture: what is shown, errors, the help, the effect's parameters as sliders. To be called inside Overlay::draw.

#include "host/adopt/adopt.h"
#include "host/effect/model.h"
#include "host/gpu/gpu.h"
#include "tools/view/graph.h"
#include "tools/view/layout.h"
#include "tools/view/pass_times.h"
#include "tools/view/probe.h"
#include "tools/view/reading.h"
#include "tools/view/source_text.h"
#include "tools/view/state.h"

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
    std::optional<BesideText> beside;
    float pictureShare = 1; // of the window's width, from the left; the rest is the effect's text
    Area picture;           // where it stands now
};

/// A target as a small picture.
struct Thumbnail {
    std::string name;  // empty: the picture
    std::string label; // with its size
    gpu::Texture* texture = nullptr;
    bool shown = false;
};

/// The picture, or the kept side.
struct TimesOfSide {
    std::string name; // empty: there is one side
    const PassTimes* times = nullptr;
};

/// What is shown besides text; empty: not asked for.
struct PanelPictures {
    std::vector<Thumbnail> thumbnails;
    std::vector<TargetArrow> arrows; // between them
    std::optional<Histogram> histogram;
    std::vector<TimesOfSide> times;
    std::vector<LegendEntry> legend; // of a mesh in false colours
    std::vector<std::string> figures;
    std::vector<SessionTexture> textures;
};

/// What a parameter of another host's effect is to get: AdoptOptions::bind; an empty rule: what its own words say.
struct BindingChoice {
    std::string parameter;
    std::string rule;
};

/// What was done in the panels.
struct PanelOutcome {
    bool moved = false;                // a slider, or a preset was chosen: `state.parameters` then holds the values
    std::optional<std::string> opened; // a thumbnail
    std::optional<BindingChoice> bound;
    std::optional<std::string> baked; // a texture that is to be baked again
    Dock dock;                        // what the panels take of the window
    unsigned docked = 0;              // other panels, or a window of another size: another number
};

/// Of a parameter without fractions, by its type or because its range and step are whole numbers.
[[nodiscard]] bool isWhole(const Parameter& parameter);

/// What stands in the panel of parameters: those with a UIWidget that make a difference to the frame.
[[nodiscard]] std::vector<const Parameter*> slidersOf(const ViewState& state, const Effect& effect);

/// `start`: what presets are laid over.
[[nodiscard]] PanelOutcome drawPanel(ViewState& state, const ViewState& start, const Loaded& loaded, const PanelText& text,
                                     const PanelPictures& pictures, SourceText& source);

[[nodiscard]] PanelSize bindingsSize(const std::vector<ParameterBinding>& bindings);
[[nodiscard]] std::optional<BindingChoice> drawBindings(const std::vector<ParameterBinding>& bindings, const Effect& effect,
                                                        const std::map<std::string, std::string>& binds, const Area& area);

/// The border over the picture, the names of both sides and their error above `bottom`, left of `right`.
void drawBorder(double border, const BesideText& text, const Area& picture, float right, float bottom);

[[nodiscard]] std::string nameOf(const Thumbnail& thumbnail);
[[nodiscard]] PanelSize stripSize(const PanelPictures& pictures);
/// The small pictures and their arrows; the name of the one that was clicked.
[[nodiscard]] std::optional<std::string> drawStrip(const PanelPictures& pictures, const Area& area);

[[nodiscard]] PanelSize legendSize(const PanelPictures& pictures);
void drawLegend(const PanelPictures& pictures, const Area& area);
[[nodiscard]] PanelSize texturesSize(const std::vector<SessionTexture>& textures);
/// "baked in 12 ms"; empty: it is not baked.
[[nodiscard]] std::string bakeText(const SessionTexture& texture);
/// `outcome`: which was clicked, or is to be baked again.
void drawTextures(const std::vector<SessionTexture>& textures, const std::string& shown, const Area& area, PanelOutcome& outcome);

[[nodiscard]] PanelSize timesSize(const std::vector<TimesOfSide>& sides);
void drawTimes(const std::vector<TimesOfSide>& sides, const Area& area);

/// The effect's text with line numbers and errors in place; written by Ctrl+S.
void drawSource(SourceText& source, const Area& area);

} // namespace tegument::view
