#pragma once
// What the viewer shows, as keys and mouse change it. Knows no window and no GPU.

#include "host/effect/model.h"
#include "host/run/run_options.h"
#include "host/run/session_frame.h"
#include "host/scene/presets.h"
#include "tools/view/input.h"
#include "tools/view/keys.h"
#include "tools/view/mesh_figures.h"

#include <string>
#include <vector>

namespace tegument::view {

enum class Show { Picture, Pass, Target };

/// What a command asks of the viewer besides the changed state.
enum class Request { None, Draw, Move, Levels, Load, Save, SaveWorkspace, CopyCommand, Keep, Quit };

struct ViewState {
    Workspace workspace; // in world millimetres
    std::map<std::string, std::vector<double>> parameters;
    std::vector<Preset> presets;   // of the effect
    std::string preset;            // what was chosen last; empty: as at the start
    std::vector<std::string> read; // parameters that make a difference to the last frame
    std::vector<std::string> techniques;
    std::string technique;
    std::vector<std::string> settings; // of the effect
    std::string setting;
    Show show = Show::Picture;
    std::size_t pass = 0;
    std::string target;
    std::vector<std::string> passes; // of the last frame
    std::vector<std::string> targets;
    std::vector<std::string> sampled; // textures that are no targets
    double stops = 0;
    int channel = 0; // 0: as the target has them
    int level = 0;   // of the mip chain
    int levels = 1;  // that what is shown has
    float zoom = 1;
    glm::dvec2 zoomAt{0.5};                   // share of the picture that stays where it is
    glm::dvec2 cursor{0.5};                   // likewise, of the picture as it is seen; where `zoom` goes
    std::map<std::string, std::string> binds; // of a foreign effect's parameters: AdoptOptions::bind
    bool help = false;                        // the sheet of keys
    bool controls = true;
    bool information = true; // menus, line of state, lights as handles
    bool probe = false;
    bool strip = false;
    bool times = false;
    bool textures = false;
    MeshShow mesh = MeshShow::None;
    bool fur = false; // roots are known, whose density can be shown
    bool bindings = false;
    bool errors = false; // against what is beside, in false colours
    bool source = false; // text beside the picture
    double border = 0.5; // share of the picture's width that is what was kept
};

/// `start`: what Command::Reset goes back to.
[[nodiscard]] Request apply(ViewState& state, Command command, const ViewState& start);
/// What a key turns on and off; none: it does something else.
[[nodiscard]] bool* switchOf(ViewState& state, Command command);
/// The parameters as `start` has them, with those of the preset of this name; none for an empty name.
void choosePreset(ViewState& state, const std::string& name, const ViewState& start);
/// Whether what is shown has surroundings that can be turned.
[[nodiscard]] bool hasSurroundings(const ViewState& state);
/// Or its surroundings.
[[nodiscard]] bool movesLight(const Input& input);
/// Whether camera or light moved.
[[nodiscard]] bool apply(ViewState& state, const Input& input);
/// Passes, targets and techniques of what was drawn or loaded; what is shown stays where it can.
void adopt(ViewState& state, const SessionFrame& frame);
void adopt(ViewState& state, const Effect& effect);
/// `asked` where the effect has it, else its default one; empty: it has none.
[[nodiscard]] std::string techniqueOf(const Effect& effect, const std::string& asked);

/// Shows this target of the whole frame; the picture for an empty name.
[[nodiscard]] Request showTarget(ViewState& state, const std::string& name);

/// What the parameter has now: as it was set, as the scene or its default has it; empty: no numbers.
[[nodiscard]] std::vector<double> valueOf(const ViewState& state, const Parameter& parameter);

/// Where on the whole picture a place lies that is seen at `seen`; both shares from the left top.
[[nodiscard]] glm::dvec2 placeSeenAt(const ViewState& state, glm::dvec2 seen);

/// How many passes are to be drawn.
[[nodiscard]] std::size_t passCount(const ViewState& state);
/// The target to be shown of a frame; empty: the picture.
[[nodiscard]] std::string shownTarget(const ViewState& state, const SessionFrame& frame);
/// "pass 4 of 13, Irradiance -> gIrradianceMap"
[[nodiscard]] std::string shownText(const ViewState& state, const SessionFrame& frame);

} // namespace tegument::view
