#pragma once
// What stands beside the picture: menus, controls, sheets of figures, targets as small pictures, the effect's text; and on it the lights'
// handles. To be called inside Overlay::draw.

#include "host/effect/model.h"
#include "host/gpu/gpu.h"
#include "meshprep/adopt/adopt.h"
#include "tools/view/file_dialog.h"
#include "tools/view/graph.h"
#include "tools/view/layout.h"
#include "tools/view/pass_times.h"
#include "tools/view/probe.h"
#include "tools/view/reading.h"
#include "tools/view/source_text.h"
#include "tools/view/state.h"
#include "tools/view/window.h"

namespace tegument::view {

/// What stands on both sides of the border.
struct BesideText {
    std::string left;
    std::string right;
    std::string error;    // of the right side against the left
    bool colours = false; // the error is what is shown
};

struct PanelText {
    std::string status;              // the line at the bottom
    std::vector<std::string> lines;  // what is shown, and by what
    std::vector<std::string> values; // under the cursor
    std::string problem;             // why the picture is not up to date; empty: it is
    std::optional<BesideText> beside;
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
    std::optional<Moving> moved;       // `state` then holds what was set
    bool painted = false;              // how it is shown, not the picture
    std::optional<Command> command;    // of a menu or a button
    std::optional<Wanted> wanted;      // another technique or setting
    std::optional<std::string> opened; // a thumbnail, or a texture
    std::optional<BindingChoice> bound;
    std::optional<std::string> baked; // a texture that is to be baked again
    std::optional<Opening> asked;     // of the application
    std::filesystem::path saved;      // where the picture (.png), or the workspace, is to be written; empty: nowhere
};

/// What of the panels outlives a frame.
struct PanelMemory {
    std::string search;
    FileDialog dialog;
};

/// What the panels are about.
struct PanelScene {
    const ViewState& start; // what presets are laid over
    const Loaded& loaded;
    const ViewRequest& request;
    Workspace seen; // with the camera of the picture
    const Layout& layout;
    PixelSize size; // of the picture
};

/// Of a parameter without fractions, by its type or because its range and step are whole numbers.
[[nodiscard]] bool isWhole(const Parameter& parameter);

/// What stands among the controls: those with a UIWidget that make a difference to the frame.
[[nodiscard]] std::vector<const Parameter*> slidersOf(const ViewState& state, const Effect& effect);
/// Likewise, what a search alone finds: other numbers.
[[nodiscard]] std::vector<const Parameter*> othersOf(const ViewState& state, const Effect& effect);
/// UIGroup, or the file that has it: "skin parameters".
[[nodiscard]] std::string groupOf(const Parameter& parameter);

/// What the problem's text takes; 0: there is none.
[[nodiscard]] float problemHeight(const std::string& problem, float width, float em);

[[nodiscard]] PanelOutcome drawPanel(ViewState& state, PanelMemory& memory, const PanelScene& scene, const PanelText& text,
                                     const PanelPictures& pictures, SourceText& source);

/// panel_controls.cpp
void drawControls(ViewState& state, PanelMemory& memory, const PanelScene& scene, PanelOutcome& outcome);
/// panel_menus.cpp
void drawMenus(ViewState& state, PanelMemory& memory, const PanelScene& scene, PanelOutcome& outcome);
/// The dialog, if one is open.
void drawDialog(FileDialog& dialog, PanelOutcome& outcome);
/// A light is turned by its disc.
void drawLightHandles(ViewState& state, const PanelScene& scene, PanelOutcome& outcome);

/// Parts of the column of sheets.
[[nodiscard]] std::optional<BindingChoice> drawBindings(const std::vector<ParameterBinding>& bindings, const Effect& effect,
                                                        const std::map<std::string, std::string>& binds);
void drawLegend(const PanelPictures& pictures);
/// `outcome`: which was clicked, or is to be baked again.
void drawTextures(const std::vector<SessionTexture>& textures, const std::string& shown, PanelOutcome& outcome);
void drawTimes(const std::vector<TimesOfSide>& sides);
/// "baked in 12 ms"; empty: it is not baked.
[[nodiscard]] std::string bakeText(const SessionTexture& texture);

/// The border over the picture, the names of both sides and their error.
void drawBorder(double border, const BesideText& text, const Area& picture);

[[nodiscard]] std::string nameOf(const Thumbnail& thumbnail);
/// The small pictures and their arrows; the name of the one that was clicked.
[[nodiscard]] std::optional<std::string> drawStrip(const PanelPictures& pictures, const Area& area);

/// The effect's text with line numbers and errors in place; written by Ctrl+S.
void drawSource(SourceText& source, const Area& area);

} // namespace tegument::view
